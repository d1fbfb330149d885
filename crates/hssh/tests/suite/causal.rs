//! `hssh check --schemas`: an exploration at the causal level, as text, JSON and DOT.

use super::common::{hssh, text};

fn check(file: &str, arguments: &[&str]) -> std::process::Output {
    hssh(&[&["check", file], arguments].concat())
}

/// The text from the views on: what comes before is printed without `--schemas`, too.
#[test]
fn schemas_of_two_blocks() {
    let answer = text(&check("fixtures/figure-2-4.ron", &["--schemas"]).stdout);
    insta::assert_snapshot!(&answer[answer.find("views").unwrap()..]);
}

/// The robot goes around the ring of corridors, looking the same at every corner and every T, and then across.
#[test]
fn schemas_of_a_floor_with_odometry() {
    let answer = text(&check("fixtures/aces.ron", &["--schemas"]).stdout);
    insta::assert_snapshot!(&answer[answer.find("views").unwrap()..]);
}

#[test]
fn json_and_dot_say_the_same() {
    let file = std::env::temp_dir().join(format!("hssh-views-{}.dot", std::process::id()));
    let output = check("fixtures/figure-2-4.ron", &["--schemas", "--json", "--dot", file.to_str().unwrap()]);
    let answer: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let dot = std::fs::read_to_string(&file).unwrap();
    std::fs::remove_file(&file).unwrap();
    let schemas = answer["causal"]["schemas"].as_array().unwrap();
    assert_eq!(schemas.len(), 11);
    for schema in schemas {
        let edge = format!(
            "v{} -> v{} [label=\"{}",
            schema["from"],
            schema["to"],
            schema["action"].as_str().unwrap()
        );
        assert!(dot.contains(&edge), "{edge}");
    }
}

#[test]
fn without_travels_there_are_no_schemas() {
    let file = std::env::temp_dir().join(format!("hssh-still-{}.ron", std::process::id()));
    std::fs::write(&file, r#"(stars: {"end": ["0+", "0- closed"]}, start: "end", travels: [])"#).unwrap();
    let output = check(file.to_str().unwrap(), &["--schemas"]);
    std::fs::remove_file(&file).unwrap();
    assert!(!output.status.success());
    assert!(text(&output.stderr).contains("need an exploration with travels"));
}
