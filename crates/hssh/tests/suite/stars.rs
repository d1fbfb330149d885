//! `hssh stars` on a small floor: what it prints, draws and refuses.

use std::process::Output;

use super::common::{hssh, text};

fn stars(file: &str, arguments: &[&str]) -> Output {
    hssh(&[&["stars", &format!("fixtures/grids/{file}")], arguments].concat())
}

/// The floor is a ring with four corners, a middle corridor with two T junctions and a rotunda, a corridor
/// from there to the ring, and a room that its door makes a dead end; its niche is no place.
#[test]
fn the_floor_has_the_places_it_was_drawn_with() {
    let output = stars("floor.yaml", &["--json"]);
    assert!(output.status.success());
    let report: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let places = report["places"].as_array().unwrap();
    let count = |kind: &str| places.iter().filter(|place| place["kind"] == kind).count();
    assert_eq!((count("corner"), count("junction"), count("dead end")), (4, 5, 1));
    assert_eq!(report["connections"].as_array().unwrap().len(), 12);
}

/// The room's door hides the room from the corridor; what is narrow elsewhere hides little.
#[test]
fn constrictions_say_how_much_they_hide() {
    let output = stars("floor.yaml", &["--json"]);
    let report: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let constrictions = report["constrictions"].as_array().unwrap();
    assert!(!constrictions.is_empty());
    for found in constrictions {
        let is_door = found["width"].as_f64() <= Some(1.1) && found["hidden_area"].as_f64() >= Some(20.0);
        assert_eq!(found["is_door"], is_door, "{found}");
    }
}

#[test]
fn the_rotunda_is_a_t() {
    let output = stars("floor.yaml", &["--at=12.2,8"]);
    insta::assert_snapshot!(text(&output.stdout));
}

#[test]
fn the_picture_shows_every_place() {
    let file = std::env::temp_dir().join(format!("hssh-stars-{}.svg", std::process::id()));
    let output = stars("floor.yaml", &["--svg", file.to_str().unwrap()]);
    assert!(output.status.success());
    let picture = std::fs::read_to_string(&file).unwrap();
    std::fs::remove_file(&file).unwrap();
    assert!(picture.contains("data:image/png;base64,iVBORw0KGgo"));
    assert_eq!(picture.matches("<text").count(), 10);
}

#[test]
fn what_is_missing_is_said() {
    let refusal = |file: &str, arguments: &[&str]| {
        let output = stars(file, arguments);
        assert_eq!(output.status.code(), Some(2));
        text(&output.stderr)
    };
    assert!(refusal("floor.png", &[]).contains("add --resolution"));
    assert!(refusal("floor.yaml", &["--resolution", "0.1"]).contains("leave out --resolution"));
    assert!(refusal("nowhere.yaml", &[]).contains("nowhere.yaml"));
    assert!(refusal("floor.yaml", &["--at=99,99"]).contains("(99, 99) is not on the map"));
    assert!(refusal("floor.yaml", &["--narrowest", "9"]).contains("9 m wide"));
}
