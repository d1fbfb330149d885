//! Answers: the page that describes their format, reading them back, and what they say checked by others.

#![allow(clippy::unwrap_used, reason = "in tests a failed unwrap is the failed assertion")]

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use hssh::answer::{
    Answer, AnswerError, AnswerWarning, AnsweredBuilding, AnsweredEvidence, AnsweredMap, AnsweredPassage,
    AnsweredRegion, AnsweredStay, AnsweredVisit, Assumption, CorrectionKind, CostItem, CostSheet,
    EndReference, EndState, Explanation, Finding, FoundCounts, InputKind, MapDifference, PartingVisit,
    PlacedPose, ReadingAccount, ReadingCorrection, SearchObjective, SearchOrder, Spot, StopReason,
    TestTravels, Verdict, VerdictKind, VisitRecord, WarningKind, Worth,
};
use hssh::causal::Exploration;
use hssh::pipeline::{Input, Mapped, MappingOptions, Monitor, SearchMethod, map};
use hssh::topology::Measure;
use serde::Serialize;
use serde_json::Value;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn page() -> String {
    std::fs::read_to_string(root().join("docs/answer-format.md")).unwrap()
}

fn exploration(name: &str) -> Exploration {
    let text = std::fs::read_to_string(root().join("fixtures").join(name)).unwrap();
    Exploration::from_ron(&text).unwrap()
}

fn mapped(name: &str, options: &MappingOptions) -> Mapped {
    let input = Input::exploration(name, exploration(name));
    map(&input, options, &Arc::<Monitor>::default()).unwrap()
}

fn options(method: SearchMethod) -> MappingOptions {
    let mut options = MappingOptions { listed: None, ..MappingOptions::default() };
    options.search.method = Some(method);
    options
}

/// An answer that leaves nothing out.
fn full() -> Answer {
    let mut answer = mapped("aces.ron", &MappingOptions::default()).answer;
    let end = || EndReference { place: 1, end: "0+".to_owned() };
    let pose = PlacedPose { x: 0.1, y: 1.0 / 3.0, theta: -1e-17, covariance: Some([[0.1; 3]; 3]) };
    answer.input.scans = Some(3);
    answer.input.scans_used = Some(2);
    answer.input.evidence =
        Some(AnsweredEvidence { returns: 3, contradicted: 1, unconfirmed: 2, lost: 1, probability: 0.875 });
    answer.search.found =
        FoundCounts { nearly_closed: Some(1), perpendicular: Some(1), ..answer.search.found };
    answer.search.removals = Some(hssh::topology::Removals::default());
    answer.verdict.lost_at_travel = Some(2);
    answer.certificate.open = Some(Worth::Measure(answer.maps[0].measure));
    let first = &mut answer.maps[0];
    first.costs =
        Some(CostSheet { total: 0.3, items: vec![CostItem { item: "bend".to_owned(), nats: 0.3 }] });
    first.places[0].ends[0].label = Some("door".to_owned());
    first.places[0].ends[0].gateway = Some([[1.5, 0.7], [1.5, -0.7]]);
    first.links[0].way = vec![[0.0, 0.0], [1.0 / 3.0, 0.1], [7.0, 0.0]];
    first.trajectory = vec![[12.5, 0.0, 0.1, -0.2]];
    first.visits[0] =
        AnsweredVisit { entry: Some("0-".to_owned()), robot: Some(pose), ..first.visits[0].clone() };
    first.difference = Some(MapDifference {
        sentence: "in much.".to_owned(),
        parting: Some(PartingVisit { visit: 1, first_place: 0, first_rotation: 0, place: 1, rotation: 2 }),
        test: Some(TestTravels { exits: vec![end()], first_arrival: Some(end()), arrival: Some(end()) }),
    });
    first.places[0].region = Some(0);
    let region = AnsweredRegion {
        kind: "room".to_owned(),
        area: 12.5,
        width: 1.0 / 3.0,
        explored: 0.9,
        stays: 1,
        places: vec![0],
        passages: vec![0],
        outline: vec![vec![[0.1, 0.0], [1.0, 0.0], [0.0, 1.0 / 3.0]]],
        holes: vec![vec![[0.1, 0.1], [0.1, 0.2], [0.2, 0.1]]],
    };
    let passage = AnsweredPassage {
        kind: "door".to_owned(),
        door_probability: 0.75,
        regions: [0, 1],
        width: 0.9,
        line: [[0.1, 0.2], [1.0, 0.2]],
    };
    answer.building = Some(AnsweredBuilding {
        regions: vec![region],
        passages: vec![passage],
        stays: vec![AnsweredStay { region: 0, scans: [0, 7] }],
    });
    answer.visits[0] = VisitRecord {
        region: Some(0),
        scan: Some(7),
        scans: Some([5, 9]),
        times: Some([1.5, 2.5]),
        ..answer.visits[0].clone()
    };
    answer.readings = Some(ReadingAccount {
        nats: 9.5,
        nats_of_errors: 3.0,
        at_most: 0.9,
        proved: false,
        found: 1,
        corrections: vec![ReadingCorrection {
            kind: CorrectionKind::Missed,
            visit: 1,
            place: Some(0),
            ends: vec!["0+".to_owned()],
            sentence: "visit 2 missed 1 gateway".to_owned(),
        }],
        visits: vec![[0, 0]],
    });
    let spots = vec![Spot::Line(1), Spot::Scan(2), Spot::Visit(3), Spot::Map(4)];
    let (kind, sentence) = (WarningKind::NoPoses, "somewhere".to_owned());
    answer.warnings.push(AnswerWarning { kind, count: 4, sentence, spots });
    answer
}

/// The paths of all values in a JSON text, `a.b[].c`; a list of numbers or texts is one value.
fn paths(value: &Value, path: &str, found: &mut BTreeSet<String>) {
    match value {
        Value::Object(fields) => {
            for (name, value) in fields {
                let below = if path.is_empty() { name.clone() } else { format!("{path}.{name}") };
                paths(value, &below, found);
            }
        }
        Value::Array(values) if values.iter().any(Value::is_object) => {
            values.iter().for_each(|value| paths(value, &format!("{path}[]"), found));
        }
        _ => _ = found.insert(path.to_owned()),
    }
}

/// The page names exactly the fields that there are.
#[test]
fn every_field_is_documented() {
    let mut written = BTreeSet::new();
    paths(&serde_json::to_value(full()).unwrap(), "", &mut written);
    let page = page();
    let mut documented: BTreeSet<String> = page
        .lines()
        .filter_map(|line| Some(line.strip_prefix("| `")?.split_once("` |")?.0.to_owned()))
        .collect();
    // What the page says once for all measures and for all values of `Worth`.
    written.retain(|path| !path.contains(".measure.") || path.starts_with("maps"));
    documented.retain(|path| !path.ends_with(".open.nats") && !path.ends_with(".measure"));
    for parent in ["certificate.best", "certificate.open", "search.removals"] {
        documented.remove(parent);
    }
    assert_eq!(documented, written);
}

#[test]
fn every_word_is_documented() {
    let page = page();
    let documented = |words: Vec<Value>| {
        for word in words {
            assert!(page.contains(&format!("`{}`", word.as_str().unwrap())), "{word}");
        }
    };
    documented(words([InputKind::Exploration, InputKind::LaserLog]));
    documented(words([SearchObjective::Preference, SearchObjective::Posterior]));
    documented(words([EndState::Closed, EndState::Pending, EndState::Linked]));
    documented(words([Finding::Start, Finding::Predicted, Finding::NewPlace, Finding::Closure]));
    documented(words([
        SearchOrder::BreadthFirst,
        SearchOrder::BestFirst,
        SearchOrder::Proof,
        SearchOrder::Count,
    ]));
    documented(words([
        StopReason::NotSearched,
        StopReason::Exhausted,
        StopReason::Found,
        StopReason::Proved,
        StopReason::NodeLimit,
        StopReason::TimeLimit,
        StopReason::MemoryLimit,
        StopReason::Interrupted,
    ]));
    documented(words([
        VerdictKind::OneBest,
        VerdictKind::SeveralBest,
        VerdictKind::Unproved,
        VerdictKind::StoppedEarly,
        VerdictKind::NoneYet,
        VerdictKind::NoClosedMap,
        VerdictKind::NoMap,
    ]));
    documented(words([
        Assumption::Perception,
        Assumption::Covariances,
        Assumption::LinearEstimates,
        Assumption::Layouts,
    ]));
    documented(words([
        WarningKind::MessageLeftOut,
        WarningKind::BreaksOff,
        WarningKind::ContradictedReturn,
        WarningKind::UnconfirmedReturn,
        WarningKind::ImprobableTravel,
        WarningKind::Lost,
        WarningKind::NoOdometry,
        WarningKind::NoPoses,
        WarningKind::NoBuilding,
        WarningKind::FewerThreads,
    ]));
}

fn words<const N: usize>(values: [impl Serialize; N]) -> Vec<Value> {
    values.iter().map(|value| serde_json::to_value(value).unwrap()).collect()
}

/// The code blocks of the page in a language.
fn blocks(page: &str, language: &str) -> Vec<String> {
    let opening = format!("```{language}\n");
    let blocks = page.split(opening.as_str()).skip(1);
    blocks.map(|block| block.split("```").next().unwrap().to_owned()).collect()
}

#[test]
fn the_example_on_the_page_is_what_is_answered() {
    let page = page();
    let input = Input::from_ron("corridor.ron", &blocks(&page, "ron")[0]).unwrap();
    let mut answer = map(&input, &MappingOptions::default(), &Arc::default()).unwrap().answer;
    let shown = Answer::from_json(&blocks(&page, "json")[0]).unwrap();
    answer.search.seconds = shown.search.seconds;
    assert_eq!(answer, shown);
}

#[test]
fn what_is_written_is_read_back() {
    let answer = full();
    let text = answer.to_json();
    assert_eq!(Answer::from_json(&text).unwrap(), answer);
    assert!(!text.contains("null"));
    for method in [SearchMethod::BreadthFirst, SearchMethod::Count, SearchMethod::Posterior] {
        let answer = mapped("aces.ron", &options(method)).answer;
        let text = answer.to_json();
        assert!(!text.contains("null"), "{method:?}");
        assert_eq!(Answer::from_json(&text).unwrap(), answer, "{method:?}");
    }
}

#[test]
fn other_formats_and_versions_are_refused() {
    let later = full().to_json().replacen("\"version\": 1", "\"version\": 2", 1);
    assert!(matches!(Answer::from_json(&later), Err(AnswerError::OtherVersion(2))));
    let other = r#"{"format": "something-else", "version": 1}"#;
    assert!(matches!(Answer::from_json(other), Err(AnswerError::OtherFormat(_))));
    assert!(matches!(Answer::from_json("{}"), Err(AnswerError::Json(_))));
    let more = full().to_json().replacen("{", "{\"new\": 1,", 1);
    assert_eq!(Answer::from_json(&more).unwrap(), full_but_for_time(&more));
}

/// An answer with a field more reads as the same one without it.
fn full_but_for_time(text: &str) -> Answer {
    Answer::from_json(&text.replacen("\"new\": 1,", "", 1)).unwrap()
}

#[test]
fn equal_input_gives_equal_answers() {
    for method in [SearchMethod::BreadthFirst, SearchMethod::Proof, SearchMethod::Posterior] {
        let answered = |threads| {
            let mut options = options(method);
            options.search.threads = threads;
            let mut answer = mapped("aces.ron", &options).answer;
            answer.search.seconds = 0.0;
            answer.to_json()
        };
        assert_eq!(answered(1), answered(3), "{method:?}");
    }
}

/// Every map, of every search, stands up to the independent checker, and can be rebuilt from its visits.
#[test]
fn every_map_explains_what_it_says() {
    let cases = [
        ("aces.ron", SearchMethod::BreadthFirst),
        ("aces.ron", SearchMethod::Posterior),
        ("aces.ron", SearchMethod::PosteriorBestFirst),
        ("figure-2-4.ron", SearchMethod::BreadthFirst),
        ("figure-2-4.ron", SearchMethod::Proof),
    ];
    for (name, method) in cases {
        let options = options(method);
        let answer = mapped(name, &options).answer;
        assert!(!answer.maps.is_empty());
        for map in &answer.maps {
            Explanation::new(&answer, map.rank as usize, &exploration(name), &options.axioms).unwrap();
            let rebuilt = map.rebuild().unwrap().map;
            let measure = Measure::of(&rebuilt);
            assert_eq!(
                (measure.undetermined_boundaries, measure.paths, measure.places, measure.genus),
                (
                    map.measure.undetermined_boundaries,
                    map.measure.paths,
                    map.measure.places,
                    map.measure.genus
                )
            );
            assert_eq!(map.places.len(), measure.places as usize);
            assert_eq!(map.paths.len(), measure.paths as usize);
            assert_eq!(map.closed, rebuilt.is_closed());
            links_lead_both_ways(map);
            paths_go_straight_on(map);
        }
    }
}

fn links_lead_both_ways(map: &AnsweredMap) {
    let end = |end: &EndReference| {
        let ends = &map.places[end.place as usize].ends;
        ends.iter().find(|other| other.name == end.end).unwrap()
    };
    for link in &map.links {
        assert_eq!(end(&link.from).leads_to.as_ref(), Some(&link.to));
        assert_eq!(end(&link.to).leads_to.as_ref(), Some(&link.from));
    }
    let linked = map.places.iter().flat_map(|place| &place.ends).filter(|end| end.state == EndState::Linked);
    assert_eq!(linked.count(), 2 * map.links.len());
}

/// Whoever leaves a place by the end ahead comes to the next one, and by that end which looks back.
fn paths_go_straight_on(map: &AnsweredMap) {
    let leads_to = |place: u32, name: &str| {
        let ends = &map.places[place as usize].ends;
        ends.iter().find(|end| end.name == name).unwrap().leads_to.clone()
    };
    let back = |name: &str| match name.strip_suffix('+') {
        Some(number) => format!("{number}-"),
        None => name.replace('-', "+"),
    };
    let mut local_paths = 0;
    for path in &map.paths {
        local_paths += path.places.len();
        for (index, (&place, ahead)) in path.places.iter().zip(&path.ahead).enumerate() {
            let next = leads_to(place, ahead);
            match path.places.get(index + 1) {
                Some(&place) => {
                    assert_eq!(next, Some(EndReference { place, end: back(&path.ahead[index + 1]) }));
                }
                None => assert_eq!(next.is_some(), path.circular),
            }
        }
    }
    let ends: usize = map.places.iter().map(|place| place.ends.len()).sum();
    assert_eq!(2 * local_paths, ends, "every local path lies on one path");
}

/// A wrong map is found out.
#[test]
fn a_map_that_is_tampered_with_is_refused() {
    let options = MappingOptions::default();
    let answer = mapped("aces.ron", &options).answer;
    let refused = |spoil: &dyn Fn(&mut AnsweredMap)| {
        let mut answer = answer.clone();
        spoil(&mut answer.maps[0]);
        let refusal = Explanation::new(&answer, 1, &exploration("aces.ron"), &options.axioms);
        refusal.unwrap_err().to_string()
    };
    refused(&|map| _ = map.links.pop());
    refused(&|map| map.visits[3].place = 0);
    refused(&|map| map.visits[8].finding = Finding::Predicted);
    assert_eq!(refused(&|map| map.links[0].to.end = "7+".to_owned()), "place 1 has no end `7+`");
    let mut spoiled = answer.maps[0].clone();
    spoiled.visits[2].exit = Some("0+".to_owned());
    assert!(spoiled.rebuild().is_err());
}

/// The first place is the frame of all others; what is known of a place is a covariance.
#[test]
fn poses_are_in_the_frame_of_the_first_place() {
    let answer = mapped("aces.ron", &MappingOptions::default()).answer;
    let poses: Vec<PlacedPose> = answer.maps[0].places.iter().map(|place| place.pose.unwrap()).collect();
    let first = poses[0];
    assert_eq!((first.x, first.y, first.theta, first.covariance), (0.0, 0.0, 0.0, Some([[0.0; 3]; 3])));
    for pose in &poses[1..] {
        let rows = pose.covariance.unwrap();
        let matrix = nalgebra::Matrix3::from_fn(|row, column| rows[row][column]);
        assert_eq!(matrix, matrix.transpose());
        assert!(matrix.symmetric_eigenvalues().min() > 0.0);
    }
    let without = mapped("figure-2-4.ron", &MappingOptions::default()).answer;
    assert!(without.maps[0].places.iter().all(|place| place.pose.is_none()));
}

/// What an answer rests on comes first.
#[test]
fn the_verdict_says_what_it_rests_on() {
    let mut options = options(SearchMethod::BreadthFirst);
    options.limits.travels = Some(8);
    let verdict = mapped("aces.ron", &options).answer.verdict;
    assert!(verdict.sentence.starts_with("Only the first 8 of 14 travels: "), "{}", verdict.sentence);
    options.limits.travels = None;
    options.axioms.max_places = Some(3);
    let Verdict { kind, lost_at_travel, .. } = mapped("aces.ron", &options).answer.verdict;
    assert_eq!((kind, lost_at_travel), (VerdictKind::NoMap, Some(2)));
}

#[test]
fn useless_threads_are_not_started() {
    let mut options = options(SearchMethod::BreadthFirst);
    options.search.threads = 1_000_000;
    let warnings = mapped("aces.ron", &options).answer.warnings;
    assert_eq!(warnings.len(), 1);
    assert_eq!(warnings[0].kind, WarningKind::FewerThreads);
}
