//! Any bytes: reading options does not panic, and what passes their check is finite.

#![no_main]

use hssh::pipeline::MappingOptions;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    if let Ok(options) = MappingOptions::from_ron(text)
        && options.check().is_ok()
    {
        assert!(options.posterior.rest.is_finite() && options.posterior.rest > 0.0);
        assert!(options.limits.seconds.is_none_or(|seconds| seconds.is_finite() && seconds >= 0.0));
    }
});
