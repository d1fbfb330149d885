//! `hssh stars` on a small floor: what it prints, draws, writes and refuses.

use std::process::Output;

use super::common::{hssh, text};

/// A folder for the files of one test.
fn scratch(name: &str) -> std::path::PathBuf {
    let folder = std::env::temp_dir().join(format!("hssh-stars-{name}-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

fn stars(file: &str, arguments: &[&str]) -> Output {
    hssh(&[&["stars", &format!("fixtures/grids/{file}")], arguments].concat())
}

/// The floor is a corridor with four junctions and a room with a door. What is joined in the list of connections is joined in
/// the stars, on the ways, and in the picture.
#[test]
fn the_floor_is_a_corridor_and_a_room() {
    let output = stars("floor.yaml", &["--json"]);
    assert!(output.status.success());
    let report: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let list = |name: &str| report[name].as_array().unwrap();
    let kinds: Vec<&str> = list("regions").iter().map(|region| region["kind"].as_str().unwrap()).collect();
    assert_eq!(kinds, ["corridor", "room"]);
    assert_eq!((list("places").len(), list("connections").len(), list("passages").len()), (5, 7, 1));
    assert_eq!(report["passages"][0]["kind"], "door");
    let ways = report["roadmap"]["ways"].as_array().unwrap();
    for connection in list("connections") {
        let driven = connection["ways"].as_array().unwrap().iter();
        let length: f64 =
            driven.map(|way| ways[way.as_u64().unwrap() as usize]["length"].as_f64().unwrap()).sum();
        assert!((length - connection["length"].as_f64().unwrap()).abs() < 1e-6);
        for end in connection["ends"].as_array().unwrap() {
            let place = &list("places")[end["place"].as_u64().unwrap() as usize];
            let ends = place["ends"].as_array().unwrap();
            assert!(ends.iter().any(|other| other["name"] == end["end"] && other["gateway"].is_object()));
        }
    }
}

/// Everything that is written for other programs, with names for the regions.
#[test]
fn the_floor_is_written_for_other_programs() {
    let folder = scratch("exports");
    let names = folder.join("names.csv");
    std::fs::write(&names, "x,y,name\n6,8,\"the <lab>\"\n").unwrap();
    let file = |name: &str| folder.join(name).to_string_lossy().into_owned();
    let exports: Vec<String> = [
        ("nav2", "a.geojson"),
        ("open-rmf", "b.yaml"),
        ("tmap", "c.yaml"),
        ("osmag", "d.osm"),
        ("regions", "e.geojson"),
        ("labels", "f.png"),
    ]
    .iter()
    .map(|(kind, name)| format!("--export={kind}={}", file(name)))
    .collect();
    let mut arguments: Vec<&str> = exports.iter().map(String::as_str).collect();
    let names = names.to_string_lossy().into_owned();
    arguments.extend(["--names", &names]);
    let output = stars("floor.yaml", &arguments);
    assert!(output.status.success(), "{}", text(&output.stderr));
    assert!(text(&output.stdout).contains("the <lab>"));
    let read = |name: &str| std::fs::read_to_string(file(name)).unwrap();
    let graph: serde_json::Value = serde_json::from_str(&read("a.geojson")).unwrap();
    let features = graph["features"].as_array().unwrap();
    let mut ids: Vec<u64> =
        features.iter().map(|feature| feature["properties"]["id"].as_u64().unwrap()).collect();
    let edges = features.iter().filter(|feature| feature["properties"]["startid"].is_u64()).count();
    assert!(edges > 0 && edges % 2 == 0);
    ids.dedup();
    assert_eq!(ids, (0..features.len() as u64).collect::<Vec<_>>());
    assert!(read("b.yaml").contains("door_name: \"door 0\""));
    assert!(read("c.yaml").contains("action: NavigateToPose"));
    assert!(read("d.osm").contains("v=\"the &lt;lab&gt;\""));
    assert!(read("e.geojson").contains("MultiPolygon"));
    assert!(std::fs::read(file("f.png")).unwrap().starts_with(b"\x89PNG"));
    std::fs::remove_dir_all(&folder).unwrap();
}

/// The floor is a ring with four corners, a middle corridor with two T junctions and a rotunda, a corridor
/// from there to the ring, and a room that its door makes a dead end; its niche is no place.
#[test]
fn the_floor_has_the_places_it_was_drawn_with() {
    let output = stars("floor.yaml", &["--detail", "--json"]);
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
    let output = stars("floor.yaml", &["--detail", "--json"]);
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
    for (arguments, places) in [(&["--detail"][..], 10), (&[], 5)] {
        let output = stars("floor.yaml", &[arguments, &["--svg", file.to_str().unwrap()]].concat());
        assert!(output.status.success());
        let picture = std::fs::read_to_string(&file).unwrap();
        std::fs::remove_file(&file).unwrap();
        assert!(picture.contains("data:image/png;base64,iVBORw0KGgo"));
        assert_eq!(picture.matches("<text").count(), places);
    }
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
    assert!(refusal("floor.yaml", &["--at=12.2,8", "--detail"]).contains("--detail is for the regions"));
    assert!(refusal("floor.yaml", &["--export", "nav3=a"]).contains("nav2, open-rmf"));
    assert!(refusal("floor.yaml", &["--names", "floor.png"]).contains("floor.png"));
    assert!(refusal("floor.yaml", &["--narrowest", "9"]).contains("9 m wide"));
}
