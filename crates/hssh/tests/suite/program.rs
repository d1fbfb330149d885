//! The program as a user runs it: what it prints, what it writes, how it exits.

use super::common::{hssh, hssh_reading, root, scratch, session, text};

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
    let bend = &answer["maps"][0]["costs"]["items"][0];
    assert_eq!(bend["item"], "bend");
    let bend = bend["nats"].as_f64().unwrap();
    assert!((2.0 * bend - graph["chi2"].as_f64().unwrap()).abs() < 1e-5, "{graph}");
}

#[test]
fn every_search_has_the_same_optimum() {
    for search in ["breadth-first", "proof", "count"] {
        let output = hssh(&["map", "fixtures/aces.ron", "--search", search, "--json"]);
        let answer: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        assert_eq!(answer["search"]["found"]["tied"], 2, "{search}");
        let best = &answer["certificate"]["best"]["measure"];
        assert_eq!(best["undetermined_boundaries"], 0, "{search}");
        assert_eq!((&best["paths"], &best["places"]), (&6.into(), &9.into()), "{search}");
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
        answer["search"]["seconds"] = 0.into();
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

/// Options come from a file, flags override it, and the file that is printed changes nothing.
#[test]
fn options_come_from_a_file() {
    let folder = scratch("options");
    let file = |name: &str, text: &str| {
        std::fs::write(folder.join(name), text).unwrap();
        folder.join(name).to_string_lossy().into_owned()
    };
    let answer = |arguments: &[&str]| {
        let output = hssh(&[&["map", "fixtures/aces.ron", "--json"], arguments].concat());
        let mut answer: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        answer["search"]["seconds"] = 0.into();
        answer
    };
    let printed = hssh(&["options"]).stdout;
    let usual = file("usual.ron", &String::from_utf8(printed).unwrap());
    assert_eq!(answer(&["--options", &usual]), answer(&[]));
    let planar = file("planar.ron", "(search: (method: breadth_first), axioms: (max_genus: 0), listed: 3)");
    let flags = ["--search", "breadth-first", "--planar", "--top", "3"];
    assert_eq!(answer(&["--options", &planar]), answer(&flags));
    let overridden = answer(&["--options", &planar, "--search", "posterior", "--top", "1"]);
    assert_eq!(overridden, answer(&["--planar", "--top", "1"]));

    let wrong = file("wrong.ron", "(\n    limits: (hours: 1),\n)\n");
    let output = hssh(&["map", "fixtures/aces.ron", "--options", &wrong]);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert_eq!(output.status.code(), Some(2));
    assert!(said.contains("wrong.ron:2:14: ") && said.contains("`hours`"), "{said}");
}

/// The story of a map as JSON is made of a map of the answer.
#[test]
fn explanations_are_of_answered_maps() {
    let explained = hssh(&["explain", "fixtures/aces.ron", "--planar", "--rank", "2", "--json"]);
    let explained: serde_json::Value = serde_json::from_slice(&explained.stdout).unwrap();
    let answer = hssh(&["map", "fixtures/aces.ron", "--planar", "--json"]);
    let answer: serde_json::Value = serde_json::from_slice(&answer.stdout).unwrap();
    assert_eq!(explained["map"], answer["maps"][1]);
    assert_eq!(explained["story"].as_array().map(Vec::len), Some(15));
}

/// Whatever a command prints as JSON, the library's types read back, and nothing is lost.
#[test]
fn what_is_printed_is_read_back() {
    fn read_back<T: serde::Serialize + serde::de::DeserializeOwned>(format: &str, arguments: &[&str]) {
        let output = hssh(&[arguments, &["--json"]].concat());
        let text = String::from_utf8(output.stdout).unwrap();
        let read: T = serde_json::from_str(&text).unwrap();
        assert_eq!(serde_json::to_string_pretty(&read).unwrap() + "\n", text, "{arguments:?}");
        assert!(text.contains(&format!("\"format\": \"{format}\"")), "{arguments:?}");
        assert!(!text.contains("null"), "{arguments:?}");
    }
    read_back::<hssh::answer::Answer>("hssh-answer", &["map", "fixtures/aces.ron"]);
    read_back::<hssh::answer::Explanation>("hssh-explanation", &["explain", "fixtures/aces.ron"]);
    read_back::<hssh::account::ContentsAccount>(
        "hssh-contents",
        &["check", "fixtures/aces.ron", "--schemas"],
    );
    let graph = "fixtures/graphs/two-wrong-closures.g2o";
    read_back::<hssh::account::PoseGraphAccount>("hssh-pose-graph", &["graph", graph, "--graduated"]);
    read_back::<hssh::account::PlacesAccount>("hssh-places", &["stars", "fixtures/grids/floor.yaml"]);
    let log = scratch("printed").join("ring.log").to_string_lossy().into_owned();
    read_back::<hssh::account::DriveAccount>("hssh-drive", &["simulate", "--floor", "ring", "-o", &log]);
    read_back::<hssh::account::SurveyAccount>("hssh-survey", &["explore", &log]);
    read_back::<hssh::account::TrackAccount>("hssh-track", &["track", &log]);
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

/// What is possible and hardly meant is asked about, by name, wherever the exploration is read.
#[test]
fn degrees_are_asked_about() {
    let file = scratch("radians").join("turns.ron");
    let travel = |theta: &str| {
        format!(
            "(exit: \"0+\", entry: \"0-\", star: \"+\", odometry: (x: 8, y: 0, theta: {theta}, covariance: [0.04, 0.04, 0.001])),"
        )
    };
    let stars = "Exploration(stars: {\"+\": [\"0+\", \"1+\", \"0-\", \"1-\"]}, start: \"+\", travels: [";
    let write = |theta: &str| {
        std::fs::write(&file, format!("{stars}{}{}])", travel("0.1"), travel(theta))).unwrap();
    };
    let file = file.to_str().unwrap();
    write("90");
    let said = |command: &str| {
        let output = hssh(&[command, file]);
        text(&output.stdout) + &text(&output.stderr)
    };
    for command in ["check", "map", "explain"] {
        let said = said(command);
        assert!(
            said.contains("travel 2: theta is 90, more than a full circle") && said.contains("degrees"),
            "{said}"
        );
    }
    write("1.57");
    assert!(!said("check").contains("question") && !said("map").contains("warning"));
    write("1e308");
    assert!(said("map").contains("travel 2") || said("map").contains("no robot"), "{}", said("map"));
    assert_eq!(hssh(&["map", file]).status.code(), Some(2));
}

/// An option that does nothing, or a number that means nothing, is refused.
#[test]
fn useless_options_are_refused() {
    for (arguments, expected) in [
        (&["--weights", "0,2,1"][..], "--prior simplicity"),
        (&["--prior", "flat", "--weights", "0,2,1"], "--prior simplicity"),
        (&["--prior", "simplicity", "--weights", "1,2"], "three numbers"),
        (&["--prior", "simplicity", "--weights", "1,-2,0"], "not negative"),
        (&["--prior", "simplicity", "--weights", "1,nan,0"], "not negative"),
        (&["--likeness=nan"], "not negative"),
        (&["--likeness=-1"], "not negative"),
        (&["--likeness=inf"], "not negative"),
    ] {
        let output = hssh(&[&["map", "fixtures/aces.ron"], arguments].concat());
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(text(&output.stderr).contains(expected), "{arguments:?}: {}", text(&output.stderr));
    }
}
