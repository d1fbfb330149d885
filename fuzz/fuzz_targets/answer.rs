//! Any bytes: reading an answer does not panic, it is written as it was read, and its maps are drawn or refused.

#![no_main]

use hssh::answer::{Answer, MapPicture};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    if let Ok(answer) = Answer::from_json(text) {
        let written = answer.to_json();
        assert_eq!(Answer::from_json(&written).expect("what is written can be read").to_json(), written);
        for map in &answer.maps {
            if let Ok(picture) = MapPicture::new(map, None) {
                let svg = picture.to_svg();
                assert!(!svg.contains("NaN") && !svg.contains("inf"), "{svg}");
            }
        }
    }
});
