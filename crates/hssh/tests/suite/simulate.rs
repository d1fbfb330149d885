//! `hssh simulate`: a log that `hssh explore` and `hssh map` make the true map of, and clear refusals.

use super::common::hssh;

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
    assert!(hssh(&["explore", &log, "-o", &exploration]).status.success());
    let mapped = hssh(&["map", &exploration, "--json"]);
    let mapped: serde_json::Value = serde_json::from_slice(&mapped.stdout).expect("the report is JSON");
    let best = &mapped["ranking"][0];
    assert!(best["f3"] == 4 && best["closed"] == true, "{mapped}");
    let _ = std::fs::remove_dir_all(folder);
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
