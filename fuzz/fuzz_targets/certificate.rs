//! Any bytes as a certificate of a small exploration: it is confirmed or refused, never a panic.

#![no_main]

use hssh_causal::Exploration;
use hssh_verify::{report, verify};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|certificate: &str| {
    let exploration = Exploration::from_ron(include_str!("../../fixtures/figure-2-4.ron"));
    let exploration = exploration.expect("the fixture is an exploration");
    if let Ok(verdict) = verify(certificate, &exploration) {
        assert!(!report(&verdict).is_empty());
    }
});
