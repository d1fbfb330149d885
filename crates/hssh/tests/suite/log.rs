//! The way from a laser log to the map of the building, on a real log and on bad ones.

use std::path::Path;

use super::common::{hssh, scratch};

/// Section 2.4 on the same floor: nine places, six paths, drawn and written as a grid.
#[test]
fn a_log_becomes_the_map_of_its_building() {
    let Some(data) = std::env::var_os("HSSH_DATA") else {
        println!("skipped: set HSSH_DATA to the folder that holds logs/aces.log.gz");
        return;
    };
    let log = Path::new(&data).join("logs/aces.log.gz").to_string_lossy().into_owned();
    let (grid, svg) = (scratch("log").join("aces.yaml"), scratch("log").join("aces.svg"));
    let files = ["--grid", &grid.to_string_lossy(), "--svg", &svg.to_string_lossy()].map(str::to_owned);
    let [a, b, c, d] = files.each_ref().map(String::as_str);
    let stages = scratch("log").join("stages");
    let folder = stages.to_string_lossy().into_owned();
    let likeness = ["--likeness", "0.02", "--debug-dir", &folder];
    let output = hssh(&[&["map", &log, "--planar", "--json"], &likeness[..], &[a, b, c, d]].concat());
    for stage in
        ["1-odometry.svg", "2-track.svg", "3-visit-015.svg", "3-visit-015.png", "4-map.svg", "5-building.png"]
    {
        assert!(stages.join(stage).is_file(), "{stage}");
    }
    let answer: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let best = &answer["maps"][0];
    assert_eq!(answer["verdict"]["kind"], "one_best");
    let measure = &best["measure"];
    let numbers = ["undetermined_boundaries", "paths", "places"].map(|number| measure[number].as_u64());
    assert_eq!(numbers, [Some(0), Some(6), Some(9)]);
    assert_eq!(best["closed"], true);
    visits_are_of_scans(&answer);
    assert!(best["probability"][0].as_f64().unwrap() > 0.8, "{}", best["probability"]);
    assert!(std::fs::read_to_string(&svg).unwrap().contains("<svg"));
    assert_eq!(
        hssh(&["stars", a.replace("--grid", &grid.to_string_lossy()).as_str()]).status.code(),
        Some(0)
    );
}

/// What scores an answer against the corrected poses asks for: of each visit the scan nearest to the place, and the place.
fn visits_are_of_scans(answer: &serde_json::Value) {
    let visits = answer["visits"].as_array().unwrap();
    assert_eq!(visits.len() as u64, answer["input"]["travels"].as_u64().unwrap() + 1);
    let mut since = 0;
    for (visit, told) in visits.iter().zip(answer["maps"][0]["visits"].as_array().unwrap()) {
        let [scan, first, last] =
            [&visit["scan"], &visit["scans"][0], &visit["scans"][1]].map(|scan| scan.as_u64().unwrap());
        assert!(since <= first && first <= scan && scan <= last, "{visit}");
        assert!(visit["times"][0].as_f64() <= visit["times"][1].as_f64(), "{visit}");
        assert!(visit["place"].as_u64() < answer["maps"][0]["measure"]["places"].as_u64());
        assert_eq!(visit["place"], told["place"]);
        assert!(told["robot"]["x"].is_f64());
        since = first;
    }
    assert!(since < answer["input"]["scans"].as_u64().unwrap());
}

#[test]
fn what_is_no_usable_log_is_refused() {
    let cases: [(&str, &[u8], &str); 4] = [
        ("odometry-only.log", b"PARAM robot_width 1\nODOM 0 0 0 0 0 0 0 host 0\n", "no usable laser scan"),
        ("cut.log.gz", &[0x1f, 0x8b, 8, 0, 0, 0, 0, 0, 0, 3, 1], "cut off or damaged"),
        ("short.log", b"FLASER 180 1.0 2.0\n", "FLASER"),
        ("one.log", b"FLASER 3 1 1 1 0 0 0 0 0 0 0.5 host 0.5\n", ""),
    ];
    for (name, bytes, expected) in cases {
        let file = scratch("log").join(name);
        std::fs::write(&file, bytes).unwrap();
        let output = hssh(&["map", &file.to_string_lossy()]);
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{name}: {said}");
        assert!(said.contains(expected) && said.contains(name), "{name}: {said}");
    }
}

#[test]
fn grids_come_from_logs_only() {
    for option in [["--grid", "grid.png"], ["--debug-dir", "folder"], ["--shallowest", "5"]] {
        let output = hssh(&[&["map", "fixtures/aces.ron"], &option[..]].concat());
        assert_eq!(output.status.code(), Some(2));
        assert!(String::from_utf8_lossy(&output.stderr).contains("need a laser log"));
    }
}

/// What is missing of a log is told in the first line, or refused.
#[test]
fn a_log_that_is_used_in_part_says_so_first() {
    let whole = scratch("partial").join("ring.log").to_string_lossy().into_owned();
    assert_eq!(hssh(&["simulate", "--floor", "ring", "-o", &whole]).status.code(), Some(0));
    let text = std::fs::read_to_string(&whole).unwrap();
    let mut scans = 0;
    let damaged = |line: &str| {
        scans += u32::from(line.starts_with("FLASER"));
        let is_cut = line.starts_with("FLASER") && scans % 5 == 0;
        if is_cut { format!("{}\n", &line[..line.len() / 2]) } else { format!("{line}\n") }
    };
    let file = scratch("partial").join("damaged.log").to_string_lossy().into_owned();
    std::fs::write(&file, text.lines().map(damaged).collect::<String>()).unwrap();
    let said = String::from_utf8(hssh(&["map", &file, "--planar"]).stdout).unwrap();
    let first = said.lines().next().unwrap();
    assert!(
        first.starts_with("PARTIAL: ") && first.ends_with("scans of the log could not be used"),
        "{said}"
    );
    for command in ["map", "explore"] {
        assert_eq!(hssh(&[command, &file, "--strict"]).status.code(), Some(2), "{command}");
        assert_eq!(hssh(&[command, &whole, "--strict"]).status.code(), Some(0), "{command}");
    }
}
