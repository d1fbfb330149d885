//! Any bytes: the parser does not panic, an error has a place, and what it reads it writes back.

#![no_main]

use hssh_causal::Exploration;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    match Exploration::from_ron_bytes(bytes) {
        Ok(exploration) => {
            let again = Exploration::from_ron(&exploration.to_ron()).expect("what is written can be read");
            // `{:?}` tells -0.0 from 0.0, which `==` does not.
            assert_eq!(format!("{again:?}"), format!("{exploration:?}"));
        }
        Err(error) => {
            assert!(error.line() >= 1 && error.column() >= 1);
            assert!(!error.render("fuzz", &String::from_utf8_lossy(bytes)).is_empty());
        }
    }
});
