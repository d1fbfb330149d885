//! `hssh map --readings`: explorations in which perception erred.

use super::common::{hssh, scratch, session, text};

#[test]
fn what_was_misread_is_said_visit_by_visit() {
    insta::assert_snapshot!(session(&["map", "fixtures/misread.ron", "--planar", "--readings"]));
}

/// Without readings no map explains it, or one that is no map of the place.
#[test]
fn every_star_being_certain_the_same_exploration_has_another_map() {
    let places = |arguments: &[&str]| {
        let output = hssh(&[&["map", "fixtures/misread.ron", "--planar", "--json"], arguments].concat());
        let answer: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        answer["maps"][0]["measure"]["places"].as_u64()
    };
    assert_eq!(places(&["--readings"]), Some(9));
    assert_ne!(places(&[]), Some(9));
}

#[test]
fn the_exploration_as_it_must_have_been_needs_no_readings() {
    let file = scratch("corrected").join("corrected.ron").to_string_lossy().into_owned();
    let output =
        hssh(&["map", "fixtures/misread.ron", "--planar", "--readings", "--json", "--corrected", &file]);
    let answer: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let readings = &answer["readings"];
    assert_eq!(readings["corrections"].as_array().unwrap().len(), 4);
    assert_eq!(readings["corrections"][0]["kind"], "turned_back");
    let visits = readings["visits"].as_array().unwrap();
    assert_eq!((&visits[0], visits.len()), (&serde_json::json!([0, 0]), 15), "one was a turn on the way");
    assert_eq!(
        answer["certificate"]["proved"], false,
        "what the account does not prove, the map does not either"
    );
    let exact = hssh(&["map", &file, "--planar", "--json"]);
    let exact: serde_json::Value = serde_json::from_slice(&exact.stdout).unwrap();
    assert_eq!(exact["maps"][0]["measure"], answer["maps"][0]["measure"]);
    assert_eq!(exact["certificate"]["proved"], true);
}

#[test]
fn the_map_is_explained_travel_by_travel() {
    let output = hssh(&["explain", "fixtures/misread.ron", "--planar", "--readings"]);
    assert!(text(&output.stdout).contains("place 8"), "{}", text(&output.stderr));
}

#[test]
fn readings_need_measured_travels_and_no_log() {
    let output = hssh(&["map", "fixtures/figure-2-4.ron", "--readings"]);
    assert!(!output.status.success());
    assert!(text(&output.stderr).contains("no odometry"), "{}", text(&output.stderr));
    let output = hssh(&["map", "fixtures/misread.ron", "--corrected", "x.ron"]);
    assert!(!output.status.success(), "there is nothing to write without --readings");
}
