//! The program as a user runs it: what it prints, what it writes, how it exits.

use super::common::{hssh, hssh_reading, root, scratch, session};

#[test]
fn the_main_job() {
    insta::assert_snapshot!(session(&["map", "fixtures/aces.ron", "--planar"]));
    insta::assert_snapshot!(session(&["map", "fixtures/aces.ron", "--planar", "--search", "breadth-first"]));
}

/// The thesis's search and its posterior, and measurements ignored, so that two maps are equally good.
#[test]
fn other_posteriors() {
    let thesis = ["--search", "posterior-best-first", "--score", "likelihood", "--closed", "--planar"];
    insta::assert_snapshot!(session(&[&["map", "fixtures/aces.ron"], thesis.as_slice()].concat()));
    let blind = ["--search", "posterior", "--score", "ignored", "--closed", "--rest", "1"];
    insta::assert_snapshot!(session(&[&["map", "fixtures/aces.ron"], blind.as_slice()].concat()));
}

#[test]
fn the_pose_graph_of_the_map_can_be_solved_again() {
    let file = scratch("pose-graph").join("aces.g2o").to_string_lossy().into_owned();
    let answer = hssh(&["map", "fixtures/aces.ron", "--json", "--top", "1", "--g2o", &file]);
    let answer: serde_json::Value = serde_json::from_slice(&answer.stdout).unwrap();
    let graph: serde_json::Value = serde_json::from_slice(&hssh(&["graph", &file, "--json"]).stdout).unwrap();
    let bend = answer["ranking"][0]["cost"]["bend"].as_f64().unwrap();
    assert!((2.0 * bend - graph["chi2"].as_f64().unwrap()).abs() < 1e-5, "{graph}");
}

#[test]
fn every_search_has_the_same_optimum() {
    for search in ["breadth-first", "proof", "count"] {
        let output = hssh(&["map", "fixtures/aces.ron", "--search", search, "--json"]);
        let answer: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        assert_eq!(answer["optimal"], 2, "{search}");
        assert_eq!(answer["best"]["f1"], 0, "{search}");
        assert_eq!((&answer["best"]["f2"], &answer["best"]["f3"]), (&6.into(), &9.into()), "{search}");
    }
}

#[test]
fn threads_change_nothing() {
    let answer = |threads: &str| {
        let output = hssh(&[
            "map",
            "fixtures/aces.ron",
            "--search",
            "breadth-first",
            "--json",
            "--all",
            "--threads",
            threads,
        ]);
        let mut answer: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        answer["seconds"] = 0.into();
        answer
    };
    assert_eq!(answer("1"), answer("3"));
}

#[test]
fn explains_and_checks() {
    insta::assert_snapshot!(session(&["explain", "fixtures/aces.ron", "--planar"]));
    insta::assert_snapshot!(session(&["check", "fixtures/aces.ron"]));
}

#[test]
fn says_what_is_wrong() {
    let cases: &[&[&str]] = &[
        &["map", "no-such-file.ron"],
        &["map", "fixtures"],
        &["check", "fixtures/malformed/unknown_star_near_miss.ron"],
        &["explain", "fixtures/aces.ron", "--planar", "--rank", "1000"],
        &["map", "fixtures/aces.ron", "--search", "count", "--svg", "map.svg"],
        &["map", "fixtures/aces.ron", "--max-time", "soon"],
        &["map", "fixtures/aces.ron", "--svg", "no/such/folder/map.svg", "--top", "1"],
        &["map", "fixtures/aces.ron", "--max-places", "3"],
        &["map", "fixtures/aces.ron", "--search", "breadth-first", "--max-nodes", "20"],
        &["map", "fixtures/aces.ron", "--max-nodes", "20"],
        &["map", "fixtures/figure-2-4.ron", "--search", "posterior"],
        &["map", "fixtures/figure-2-4.ron", "--g2o", "no.g2o"],
        &["map", "fixtures/aces.ron", "--prior", "simplicity", "--weights", "0,2,0"],
        &["map", "fixtures/aces.ron", "--search", "posterior", "--genus", "first"],
        &["map", "fixtures/aces.ron", "--search", "count", "--max-nodes", "20"],
        &["map", "fixtures/aces.ron", "--search", "proof", "--max-time", "0"],
        &["map", "fixtures/aces.ron", "--travels", "1", "--search", "best-first", "--closed"],
        &["map", "fixtures/aces.ron", "--travels", "1", "--search", "proof", "--closed"],
        &["map", "fixtures/aces.ron", "--search", "breadth-first", "--closed"],
        &["explain", "fixtures/aces.ron", "--max-places", "3"],
    ];
    insta::assert_snapshot!(cases.iter().map(|case| session(case)).collect::<Vec<_>>().join("\n"));
}

#[test]
fn writes_pictures() {
    let folder = scratch("pictures");
    let file = |name: &str| folder.join(name).to_string_lossy().into_owned();
    let (svg, dot) = (file("map.svg"), file("map.dot"));
    let output = hssh(&[
        "map",
        "fixtures/aces.ron",
        "--search",
        "breadth-first",
        "--svg",
        &svg,
        "--dot",
        &dot,
        "--tree",
        &file("tree.svg"),
    ]);
    assert_eq!(output.status.code(), Some(0));
    for name in ["map.svg", "map-2.svg", "tree.svg"] {
        let text = std::fs::read_to_string(folder.join(name)).unwrap();
        assert!(text.contains("<svg") && text.trim_end().ends_with("</svg>"), "{name}");
    }
    for name in ["map.dot", "map-2.dot"] {
        assert!(std::fs::read_to_string(folder.join(name)).unwrap().contains("graph"), "{name}");
    }
    assert!(!folder.join("map-3.svg").exists());
}

#[test]
fn reads_standard_input() {
    let program = hssh_reading("fixtures/aces.ron", &["check", "-", "--json"]);
    let contents: serde_json::Value = serde_json::from_slice(&program.stdout).unwrap();
    assert_eq!((&contents["travels"], &contents["travels_with_odometry"]), (&14.into(), &14.into()));
}

#[test]
fn the_pictures_in_the_documents_are_those_it_makes() {
    let folder = scratch("readme");
    let drawn = |name: &str| folder.join(name).to_string_lossy().into_owned();
    let (map, tree) = (drawn("aces.svg"), drawn("aces-tree.svg"));
    hssh(&["map", "fixtures/aces.ron", "--planar", "--svg", &map]);
    hssh(&["map", "fixtures/aces.ron", "--planar", "--search", "breadth-first", "--tree", &tree]);
    hssh(&["map", "fixtures/figure-2-4.ron", "--tree", &drawn("figure-2-4-tree.svg")]);
    for name in ["aces.svg", "aces-tree.svg", "figure-2-4-tree.svg"] {
        let shown = std::fs::read_to_string(root().join("docs/images").join(name)).unwrap();
        assert_eq!(
            std::fs::read_to_string(folder.join(name)).unwrap(),
            shown,
            "docs/images/{name} is out of date"
        );
    }
}
