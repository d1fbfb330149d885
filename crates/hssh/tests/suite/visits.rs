//! `--same` and `--different`: what somebody knows of visits.

use super::common::{hssh, scratch, text};

fn places_of_visits(arguments: &[&str]) -> Vec<u64> {
    let output = hssh(&[&["map", "fixtures/figure-2-4.ron", "--json"], arguments].concat());
    let answer: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let visits = answer["maps"][0]["visits"].as_array().unwrap();
    visits.iter().map(|visit| visit["place"].as_u64().unwrap()).collect()
}

#[test]
fn the_best_map_is_the_best_of_those_that_agree() {
    let free = places_of_visits(&[]);
    assert_eq!(free[0], free[4]);
    assert_eq!(
        places_of_visits(&["--same", "4,0"]),
        free,
        "what is true of the best map anyway changes nothing"
    );
    let told = places_of_visits(&["--different", "0,4"]);
    assert_ne!(told[0], told[4]);
}

#[test]
fn the_proof_names_what_was_said_and_the_checker_asks_for_it() {
    let folder = scratch("visits");
    let certificate = folder.join("told.txt");
    let path = certificate.to_str().unwrap();
    let arguments = ["map", "fixtures/figure-2-4.ron", "--search", "cyclic", "--different", "0,4"];
    let output = hssh(&[&arguments[..], &["--certificate", path, "--json"]].concat());
    let answer: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let trusted = answer["certificate"]["trusted"].as_array().unwrap();
    assert!(trusted.iter().any(|trusted| trusted["assumption"] == "visits"), "{trusted:?}");

    let verify = |path: &str| hssh(&["verify", path, "fixtures/figure-2-4.ron"]);
    let accepted = verify(path);
    assert!(accepted.status.success(), "{}{}", text(&accepted.stdout), text(&accepted.stderr));
    let written = std::fs::read_to_string(&certificate).unwrap();
    assert!(written.contains("\ndifferent 0 4\n"), "{written}");
    let without = folder.join("without.txt");
    std::fs::write(&without, written.replace("different 0 4\n", "")).unwrap();
    assert!(!verify(without.to_str().unwrap()).status.success(), "without it, other maps are as good");
}

#[test]
fn what_cannot_be_is_refused_by_its_visits() {
    let refused = |arguments: &[&str], words: &str| {
        let output = hssh(&[&["map", "fixtures/figure-2-4.ron"], arguments].concat());
        assert_eq!(output.status.code(), Some(2));
        assert!(text(&output.stderr).contains(words), "{}", text(&output.stderr));
    };
    refused(&["--same", "0,4", "--same", "4,6", "--different", "0,6"], "visits 0 and 6");
    refused(&["--same", "0,44"], "error: there is no visit 44: the visits are 0, the start, to 6");
    refused(&["--same", "3,3"], "visit 3 stands twice");
    refused(&["--different", "3"], "like 3,17");
    refused(&["--different", "0,4", "--search", "count"], "leave out --same and --different");
}
