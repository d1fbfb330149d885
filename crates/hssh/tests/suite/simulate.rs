//! `hssh simulate`: a log that `hssh explore` and `hssh map` make the true map of, and clear refusals.

use super::common::{hssh, scratch};

#[test]
fn from_a_floor_to_its_map() {
    let folder = std::env::temp_dir().join(format!("hssh-simulate-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("the folder for temporary files is writable");
    let file = |name: &str| folder.join(name).display().to_string();
    let [log, truth, svg, exploration] = ["ring.log", "ring.json", "ring.svg", "ring.ron"].map(file);
    let simulated = hssh(&["simulate", "--floor", "ring", "-o", &log, "--truth", &truth, "--svg", &svg]);
    let said = String::from_utf8_lossy(&simulated.stdout).into_owned();
    assert!(simulated.status.success() && said.starts_with("ring: 4 places, 4 travels, "), "{said}");
    let truth = std::fs::read_to_string(truth).expect("the truth was written");
    let truth: serde_json::Value = serde_json::from_str(&truth).expect("the truth is JSON");
    assert_eq!(truth["stops"].as_array().map(Vec::len), Some(5));
    assert_eq!(truth["stops"][0]["place"], truth["stops"][4]["place"]);
    let explored = hssh(&["explore", &log, "-o", &exploration, "--json"]);
    let explored: serde_json::Value = serde_json::from_slice(&explored.stdout).expect("the account is JSON");
    assert_eq!(explored["visits"].as_array().map(Vec::len), Some(5));
    assert_eq!(explored["travels"].as_array().map(Vec::len), Some(4));
    assert_eq!(explored["visits"][0]["exit"].is_string(), explored["visits"][4]["entry"].is_string());
    scans_are_counted_among_all(&log, &explored);
    let mapped = hssh(&["map", &exploration, "--json"]);
    let mapped: serde_json::Value = serde_json::from_slice(&mapped.stdout).expect("the report is JSON");
    let best = &mapped["maps"][0];
    assert!(best["measure"]["places"] == 4 && best["closed"] == true, "{mapped}");
    let _ = std::fs::remove_dir_all(folder);
}

/// All scans are in the trajectory and in the graph, with loops if loops are closed, and the graph is read back as solved.
#[test]
fn the_way_is_written() {
    let folder = scratch("way");
    let file = |name: &str| folder.join(name).display().to_string();
    let [log, way, graph, grid] = ["eight.log", "way.tum", "way.g2o", "way.yaml"].map(file);
    assert!(hssh(&["simulate", "--floor", "figure-eight", "-o", &log]).status.success());
    let scans = std::fs::read_to_string(&log).unwrap().matches("\nFLASER ").count();
    for command in ["track", "map"] {
        let done = hssh(&[command, &log, "--trajectory", &way, "--g2o", &graph, "--grid", &grid]);
        assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
        let lines = std::fs::read_to_string(&way).expect("the trajectory was written").lines().count();
        assert_eq!(lines, scans);
        let found = hssh(&["graph", &graph, "--json"]);
        let found: serde_json::Value = serde_json::from_slice(&found.stdout).expect("the account is JSON");
        assert_eq!(found["poses"].as_array().map(Vec::len), Some(scans));
        assert_eq!(found["closures"].as_u64() > Some(0), command == "map", "{command}");
        let [before, after] = ["file_chi2", "chi2"].map(|chi2| found[chi2].as_f64().unwrap());
        assert!(before - after < 1e-4 * (1.0 + after), "{command}: {before} {after}");
        let places = hssh(&["stars", &grid]);
        assert!(places.status.success(), "{}", String::from_utf8_lossy(&places.stderr));
    }
}

/// A scan that cannot be used moves the numbers of those after it, and nothing else.
fn scans_are_counted_among_all(log: &str, explored: &serde_json::Value) {
    let text = std::fs::read_to_string(log).expect("the log was written");
    std::fs::write(log, format!("FLASER 2 1.0 broken\n{text}")).expect("it can be written again");
    let again = hssh(&["explore", log, "--json"]);
    let mut again: serde_json::Value = serde_json::from_slice(&again.stdout).expect("the account is JSON");
    assert_eq!(again["scans"].as_u64(), explored["scans"].as_u64().map(|scans| scans + 1));
    assert_eq!(again["warnings"][0]["where"][0]["line"], 1);
    for (visit, before) in again["visits"].as_array_mut().into_iter().flatten().zip(0..) {
        let before = &explored["visits"][before];
        assert_eq!(visit["scan"].as_u64(), before["scan"].as_u64().map(|scan| scan + 1));
        assert_eq!(visit["scans"][1].as_u64(), before["scans"][1].as_u64().map(|scan| scan + 1));
        (visit["scan"], visit["scans"]) = (before["scan"].clone(), before["scans"].clone());
        assert_eq!(*visit, *before);
    }
}

/// A drive that was cut short says so, in words and by its exit code: `--travels` is a limit like any other.
#[test]
fn a_drive_that_is_not_done_says_so() {
    let log =
        std::env::temp_dir().join(format!("hssh-short-{}.log", std::process::id())).display().to_string();
    let drive = |options: &[&str]| {
        let output = hssh(&[&["simulate", "--floor", "ring", "-o", &log], options].concat());
        (output.status.code(), String::from_utf8_lossy(&output.stdout).into_owned())
    };
    let (code, said) = drive(&["--travels", "2"]);
    assert!(code == Some(3) && said.contains("are used up, and 2 more were asked for"), "{said}");
    let (code, said) = drive(&["--travels", "1", "--visit", "0,1,0,3"]);
    assert!(code == Some(3) && said.contains("are used up, and 2 more were asked for"), "{said}");
    // What the last travel completes is done, and to wander is never more than that.
    for done in
        [&["--travels", "4"][..], &["--travels", "2", "--visit", "0,1,0"], &["--travels", "2", "--wander"]]
    {
        let (code, said) = drive(done);
        assert!(code == Some(0) && said.contains("everything that was asked for was done"), "{said}");
    }
    let _ = std::fs::remove_file(log);
}

#[test]
fn what_cannot_be_driven_through_is_said() {
    let refusal = |arguments: &[&str]| {
        let output = hssh(&[&["simulate", "-o", "never-written.log"], arguments].concat());
        assert_eq!(output.status.code(), Some(2));
        String::from_utf8_lossy(&output.stderr).into_owned()
    };
    assert!(
        refusal(&[])
            .contains("give the YAML file of a map, or --floor with one of ring, spurs, figure-eight")
    );
    assert!(refusal(&["--floor", "nowhere"]).contains("there is no floor `nowhere`"));
    assert!(refusal(&["--floor", "ring", "--start=13,-7"]).contains("it is in a wall or unknown space"));
    assert!(refusal(&["--floor", "ring", "--start=99,0"]).contains("is not on the map, which reaches from"));
    assert!(
        refusal(&["--floor", "ring", "--visit", "7"])
            .contains("there is no place 7: the map has places 0 to 3")
    );
}
