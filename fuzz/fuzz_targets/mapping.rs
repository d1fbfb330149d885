//! Any bytes as an exploration that is mapped within small limits: what comes out is finite, and reads back.

#![no_main]

use hssh::answer::Answer;
use hssh::pipeline::{Input, MappingOptions, map};
use libfuzzer_sys::fuzz_target;

/// So little that thousands of runs fit into an hour.
const OPTIONS: &str = "(search: (threads: 1), limits: (travels: 12, nodes: 300, seconds: 1, mebibytes: 64))";

fuzz_target!(|text: &str| {
    let options = MappingOptions::from_ron(OPTIONS).expect("these are options");
    let Ok(input) = Input::from_ron("fuzz", text) else { return };
    if let Ok(mapped) = map(&input, &options, &Default::default()) {
        let json = mapped.answer.to_json();
        // JSON has no word for what is not finite: such a number would have become null.
        assert!(!json.contains("null"), "{json}");
        assert_eq!(Answer::from_json(&json).expect("an answer reads back").to_json(), json);
    }
});
