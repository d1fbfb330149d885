//! Any bytes as a laser log in which places are sought: all poses that come of it are finite.

#![no_main]

use hssh::pipeline::{Input, MappingOptions};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    if let Ok(input) = Input::from_log("fuzz", bytes, &MappingOptions::default()) {
        let surveyed = input.as_surveyed().expect("it was made of a log");
        assert!(surveyed.survey.track.scans.iter().all(|scan| scan.pose.is_finite()));
    }
});
