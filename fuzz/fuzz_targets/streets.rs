//! Any bytes as a street network, in both forms: reading it does not panic, nor does what it is turned into.

#![no_main]

use hssh_world::{graphml, momepy};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    for network in [graphml::read(text), momepy::read(text)] {
        if let Ok(world) = network.map_err(drop).and_then(|network| network.to_world().map_err(drop)) {
            assert!(world.places().iter().all(|place| place.position.x.is_finite() && place.position.y.is_finite()));
        }
    }
});
