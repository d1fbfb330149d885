//! `hssh export`, and `--export` of `map` and `stars`: the same files on either way, and what is refused.

use std::process::Output;

use super::common::{hssh, scratch, text};

/// A file in the folder of one test.
fn file(test: &str, name: &str) -> String {
    scratch(&format!("export-{test}")).join(name).to_string_lossy().into_owned()
}

fn read(file: &str) -> String {
    std::fs::read_to_string(file).unwrap()
}

/// What `hssh map --json` or `hssh stars --json` prints, in a file.
fn answered(test: &str, arguments: &[&str]) -> String {
    let answer = file(test, "answer.json");
    let output = hssh(&[arguments, &["--json"]].concat());
    assert!(output.status.success(), "{}", text(&output.stderr));
    std::fs::write(&answer, output.stdout).unwrap();
    answer
}

fn refusal(output: &Output) -> String {
    assert_eq!(output.status.code(), Some(2), "{}", text(&output.stdout));
    text(&output.stderr)
}

/// Straight from the search and by way of the answer's JSON, an exploration gives the same files.
#[test]
fn an_answer_is_exported_as_the_search_exports_it() {
    let input = ["map", "fixtures/aces.ron", "--planar"];
    let answer = answered("same", &input);
    let kinds = ["nav2", "open-rmf", "tmap", "graphml", "geojson"];
    let straight: Vec<String> = kinds.iter().map(|kind| file("same", &format!("straight.{kind}"))).collect();
    let flags: Vec<String> =
        kinds.iter().zip(&straight).map(|(kind, file)| format!("--export={kind}={file}")).collect();
    let flags: Vec<&str> = flags.iter().map(String::as_str).collect();
    assert!(hssh(&[&input[..], &flags].concat()).status.success());
    for (kind, straight) in kinds.iter().zip(&straight) {
        let detour = file("same", &format!("detour.{kind}"));
        let output = hssh(&["export", &answer, "--to", kind, "-o", &detour]);
        assert!(output.status.success(), "{kind}: {}", text(&output.stderr));
        assert_eq!(read(straight), read(&detour), "{kind}");
        assert_eq!(text(&hssh(&["export", &answer, "--to", kind]).stdout), read(&detour), "{kind}");
    }
    let g2o = [file("same", "a.g2o"), file("same", "b.g2o")];
    let export = format!("g2o={}", g2o[1]);
    assert!(hssh(&[&input[..], &["--g2o", &g2o[0], "--export", &export]].concat()).status.success());
    assert_eq!(read(&g2o[0]), read(&g2o[1]));
    // Nothing tells how wide the places are, and no scan was taken.
    let tell = |kind| refusal(&hssh(&["export", &answer, "--to", kind]));
    assert!(tell("osmag").contains("only laser logs and grid maps"));
    assert!(tell("tum").contains("--with-trajectory"));
    assert!(tell("g2o").contains("hssh map fixtures/aces.ron --g2o FILE"));
}

/// The second map is written for those who ask for it, and says that it is the second.
#[test]
fn another_map_of_the_ranking_says_so() {
    let answer = answered("rank", &["map", "fixtures/aces.ron", "--planar"]);
    let output = hssh(&["export", &answer, "--to", "nav2", "--rank", "2"]);
    assert!(output.status.success());
    assert!(text(&output.stderr).contains("this is map 2 of the ranking"));
    assert!(text(&output.stdout).contains("\"rank\":2"));
    let none = hssh(&["export", &answer, "--to", "nav2", "--rank", "99"]);
    assert!(refusal(&none).contains("there is no map number 99"));
}

/// Several maps are as good as one another, and nobody measured anything.
#[test]
fn without_one_best_map_or_positions_robots_get_nothing() {
    let ambiguous = ["map", "fixtures/aces.ron", "--search", "breadth-first"];
    let answer = answered("ambiguous", &ambiguous);
    assert!(refusal(&hssh(&["export", &answer, "--to", "nav2"])).contains("no robot should be sent"));
    let forced = hssh(&["export", &answer, "--to", "nav2", "--rank", "1"]);
    assert!(forced.status.success() && text(&forced.stderr).contains("warning"));
    assert!(hssh(&["export", &answer, "--to", "graphml"]).status.success());
    // The search has its answer all the same.
    let nav2 = format!("nav2={}", file("ambiguous", "never.geojson"));
    let output = hssh(&[&ambiguous[..], &["--export", &nav2]].concat());
    assert!(text(&output.stdout).contains("optimal") && refusal(&output).contains("--rank 1"));

    let unmeasured = answered("unmeasured", &["map", "fixtures/figure-2-4.ron"]);
    let output = hssh(&["export", &unmeasured, "--to", "open-rmf", "--rank", "1"]);
    assert!(refusal(&output).contains("only graphml needs none"));
    assert!(hssh(&["export", &unmeasured, "--to", "graphml"]).status.success());
}

/// A log's ways are as the robot drove; the trajectory is there if it was asked for.
#[test]
fn a_log_is_exported_with_its_ways() {
    let log = file("log", "ring.log");
    assert!(hssh(&["simulate", "--floor", "ring", "-o", &log]).status.success());
    let tum = file("log", "straight.tum");
    let export = format!("tum={tum}");
    let answer = answered("log", &["map", &log, "--planar", "--with-trajectory", "--export", &export]);
    assert_eq!(text(&hssh(&["export", &answer, "--to", "tum"]).stdout), read(&tum));
    let told: serde_json::Value = serde_json::from_str(&read(&answer)).unwrap();
    let best = &told["maps"][0];
    assert_eq!(best["trajectory"].as_array().unwrap().len() as u64, told["input"]["scans"].as_u64().unwrap());
    let links = best["links"].as_array().unwrap();
    for link in links {
        let way = link["way"].as_array().unwrap();
        let place = |end: &str| &best["places"][link[end]["place"].as_u64().unwrap() as usize]["pose"];
        for (corner, pose) in [(&way[0], place("from")), (&way[way.len() - 1], place("to"))] {
            assert_eq!((&corner[0], &corner[1]), (&pose["x"], &pose["y"]));
        }
    }
    let nav2 = hssh(&["export", &answer, "--to", "nav2", "--spacing", "0.5"]);
    let graph: serde_json::Value = serde_json::from_slice(&nav2.stdout).unwrap();
    for feature in graph["features"].as_array().unwrap() {
        assert!(feature["properties"]["cost"].as_f64().is_none_or(|metres| metres <= 0.5 + 1e-9));
    }
    let areas = text(&hssh(&["export", &answer, "--to", "osmag"]).stdout);
    assert_eq!(areas.matches("v=\"passage\"").count(), 2 * links.len());
    // Without the trajectory, what to do.
    let answer = answered("log", &["map", &log, "--planar"]);
    assert!(refusal(&hssh(&["export", &answer, "--to", "tum"])).contains("--trajectory FILE"));
}

/// The places of a grid map by way of their JSON, too.
#[test]
fn a_grid_map_is_exported_as_stars_exports_it() {
    let answer = answered("grid", &["stars", "fixtures/grids/floor.yaml"]);
    let kinds = ["nav2", "open-rmf", "tmap", "osmag", "graphml", "geojson", "regions"];
    for kind in kinds {
        let straight = file("grid", kind);
        let export = format!("{kind}={straight}");
        let output = hssh(&["stars", "fixtures/grids/floor.yaml", "--export", &export]);
        assert!(output.status.success(), "{kind}: {}", text(&output.stderr));
        assert_eq!(text(&hssh(&["export", &answer, "--to", kind]).stdout), read(&straight), "{kind}");
    }
    assert!(refusal(&hssh(&["export", &answer, "--to", "labels"])).contains("hssh stars MAP"));
    assert!(refusal(&hssh(&["export", &answer, "--to", "tum"])).contains("hssh map LOG"));
    assert!(refusal(&hssh(&["export", &answer, "--to", "nav2", "--rank", "2"])).contains("no ranking"));
    let tum = format!("tum={}", file("grid", "never.tum"));
    let output = hssh(&["stars", "fixtures/grids/floor.yaml", "--export", &tum]);
    assert!(refusal(&output).contains("hssh map LOG"));
}

#[test]
fn what_is_no_answer_is_refused_by_name() {
    let answer = answered("other", &["map", "fixtures/aces.ron", "--planar"]);
    let later = file("other", "later.json");
    std::fs::write(&later, read(&answer).replacen("\"version\": 1", "\"version\": 9", 1)).unwrap();
    let cut = file("other", "cut.json");
    std::fs::write(&cut, &read(&answer)[..2000]).unwrap();
    let foreign = file("other", "foreign.json");
    std::fs::write(&foreign, "{\"format\": \"something\"}").unwrap();
    let explanation = file("other", "explanation.json");
    let explained = hssh(&["explain", "fixtures/aces.ron", "--planar", "--json"]);
    std::fs::write(&explanation, explained.stdout).unwrap();
    let cases: [(&str, &str); 6] = [
        (&later, "version 9"),
        (&cut, "no answer"),
        (&foreign, "JSON"),
        (&explanation, "hssh-explanation"),
        ("fixtures/aces.ron", "an exploration"),
        ("fixtures/grids/floor.yaml", "a grid map"),
    ];
    for (file, expected) in cases {
        let said = refusal(&hssh(&["export", file, "--to", "graphml"]));
        assert!(said.contains(file) && said.contains(expected), "{said}");
    }
    let said = refusal(&hssh(&["export", &answer, "--to", "graphml", "-o", &answer]));
    assert!(said.contains("is the input"));
    assert!(refusal(&hssh(&["export", &answer, "--to", "nav3"])).contains("nav2"));
    assert!(
        refusal(&hssh(&["export", &answer, "--to", "nav2", "--spacing", "0"])).contains("number of metres")
    );
}
