//! Laws of the RON text: printing and parsing are inverse, and no text makes the parser panic.

use std::f64::consts::TAU;

use hssh_causal::{Exploration, NamedStar, Odometry, StarType, Travel};
use hssh_topology::{Olp, OlpName, Sign, Star, StarEnd};
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::Index;
use proptest::test_runner::RngSeed;

const VALID: [&str; 3] =
    [include_str!("data/block.ron"), include_str!("data/measured.ron"), include_str!("data/corridors.ron")];

#[test]
fn examples_parse_print_and_parse_again() {
    for text in VALID {
        let exploration =
            Exploration::from_ron(text).unwrap_or_else(|error| panic!("{}", error.render("example", text)));
        assert_eq!(Exploration::from_ron(&exploration.to_ron()).unwrap(), exploration);
        assert_eq!(text.parse::<Exploration>().unwrap(), exploration);
        ron::from_str::<ron::Value>(text).unwrap();
        assert_eq!(Exploration::from_ron_bytes(text.as_bytes()).unwrap(), exploration);
    }
}

#[test]
fn what_is_written_is_what_is_read() {
    let exploration = Exploration::from_ron(VALID[1]).unwrap();
    let room = &exploration.star_types()[exploration.start().index()];
    assert_eq!(room.name, "部屋");
    assert_eq!(room.star.ends()[0].label.as_deref(), Some("the \"green\" door # 3"));
    assert_eq!(room.bearings, [Some(12.5_f64.to_radians()), Some((-167.5_f64).to_radians())]);
    let [first, second] = exploration.travels() else { panic!("two travels") };
    assert_eq!((first.exit, first.entry, &first.odometry), (Olp::new(0), Olp::new(3), &None));
    assert_eq!(exploration.star_types()[first.star.index()].bearings[0], Some(std::f64::consts::FRAC_PI_2));
    let odometry = second.odometry.unwrap();
    assert_eq!((odometry.x, odometry.y, odometry.theta), (7.9, 0.1, -1.57));
    assert_eq!(odometry.covariance, [[0.04, 0.001, 0.0], [0.001, 0.04, 0.0], [0.0, 0.0, 0.0001]]);
}

#[test]
fn a_byte_order_mark_and_windows_line_ends_are_no_problem() {
    let text = format!("\u{feff}{}", VALID[0].replace('\n', "\r\n"));
    assert_eq!(Exploration::from_ron(&text), Exploration::from_ron(VALID[0]));
    let broken = text.replace("\"corner\",\r\n    travels", "\"coner\",\r\n    travels");
    let error = Exploration::from_ron(&broken).unwrap_err();
    assert_eq!((error.line(), error.column()), (7, 12));
}

#[test]
fn many_problems_are_cut_to_a_readable_number() {
    let travels = "(exit: \"9+\", entry: \"0-\", star: \"L\"),\n".repeat(1000);
    let text = format!("(stars: {{\"L\": [\"0+\", \"0-\"]}}, start: \"L\", travels: [\n{travels}])");
    let error = Exploration::from_ron(&text).unwrap_err();
    assert_eq!((error.problems().len(), error.unlisted()), (20, 980));
    assert!(error.to_string().ends_with("and 980 more problems"));
}

#[test]
fn messages_quote_hostile_text_safely() {
    let text =
        format!(r#"(stars: {{"L": ["0+", "0-"]}}, start: "\u{{1b}}[2J{}", travels: [])"#, "x".repeat(10_000));
    let error = Exploration::from_ron(&text).unwrap_err();
    let rendered = error.render("file.ron", &text);
    assert!(!rendered.contains('\u{1b}') && rendered.len() < 2_000, "{rendered}");
}

/// Distinct names in pairs, shuffled, with closed ends, labels and bearings.
fn star() -> impl Strategy<Value = (Star, Vec<Option<f64>>)> {
    (1..5_u32)
        .prop_flat_map(|local_paths| {
            let names: Vec<OlpName> = (0..local_paths)
                .flat_map(|local_path| [Sign::Plus, Sign::Minus].map(|sign| OlpName { local_path, sign }))
                .collect();
            let ends = names.len();
            let label = proptest::option::of("[a-z\"\\\\#@é\n]( ?[a-z#\t]){0,4}");
            (
                Just(names).prop_shuffle(),
                vec(any::<bool>(), ends),
                vec(label.prop_map(|label| label.filter(|label| label.trim() == label)), ends),
                vec(any::<bool>(), ends),
                -3.0..3.0_f64,
                vec(0.1..1.0_f64, ends),
            )
        })
        .prop_map(|(names, closed, labels, measured, first, gaps)| {
            let turn = TAU / (gaps.iter().sum::<f64>() + 0.1);
            let mut bearing = first;
            let mut bearings = Vec::new();
            for (measured, gap) in measured.into_iter().zip(gaps) {
                bearings.push(measured.then_some(bearing));
                bearing -= gap * turn;
                bearing = if bearing < -3.0 { bearing + TAU } else { bearing };
            }
            let end = |((name, closed), label)| {
                let passability = if closed {
                    hssh_topology::Passability::Closed
                } else {
                    hssh_topology::Passability::Travelable
                };
                StarEnd { name, passability, label }
            };
            (
                Star::new(names.into_iter().zip(closed).zip(labels).map(end))
                    .expect("every end has its opposite"),
                bearings,
            )
        })
}

/// A covariance L Lᵀ, exactly symmetric, sometimes diagonal.
fn odometry() -> impl Strategy<Value = Odometry> {
    let off_diagonal = prop_oneof![Just(0.0), -1.0..1.0_f64];
    let finite = proptest::num::f64::ZERO | proptest::num::f64::SUBNORMAL;
    // Every power of two that may occur, down to none; larger numbers are out of proportion.
    let finite =
        prop_oneof![finite, (-1e4..1e4_f64, -300..1_i32).prop_map(|(x, power)| x * 2_f64.powi(power))];
    (vec(finite, 3), vec(0.01..2.0_f64, 3), vec(off_diagonal, 3)).prop_map(|(pose, d, l)| {
        let rows = [[d[0], 0.0, 0.0], [l[0], d[1], 0.0], [l[1], l[2], d[2]]];
        let entry = |i: usize, j: usize| (0..3).map(|k| rows[i][k] * rows[j][k]).sum::<f64>();
        let covariance = std::array::from_fn(|i| std::array::from_fn(|j| entry(i.min(j), i.max(j))));
        Odometry { x: pose[0], y: pose[1], theta: pose[2], covariance }
    })
}

/// Star types under odd names and a walk among those that have a gateway.
fn exploration() -> impl Strategy<Value = Exploration> {
    let step = (any::<Index>(), any::<Index>(), any::<Index>(), proptest::option::of(odometry()));
    (vec(("\\PC{0,6}", star()), 1..4), any::<Index>(), vec(step, 0..8)).prop_map(|(stars, start, steps)| {
        let named = |(index, (name, (star, bearings))): (usize, (String, _))| NamedStar {
            name: format!("{name}{index}"),
            star,
            bearings,
        };
        let star_types: Vec<NamedStar> = stars.into_iter().enumerate().map(named).collect();
        let mut here = start.index(star_types.len());
        let start = StarType(here as u32);
        let mut travels = Vec::new();
        for (there, exit, entry, odometry) in steps {
            let there = there.index(star_types.len());
            let gateways = |index: usize| star_types[index].star.gateways().collect::<Vec<_>>();
            let (exits, entries) = (gateways(here), gateways(there));
            if exits.is_empty() || entries.is_empty() {
                continue;
            }
            let (exit, entry) = (*exit.get(&exits), *entry.get(&entries));
            travels.push(Travel { exit, entry, star: StarType(there as u32), odometry });
            here = there;
        }
        Exploration::new(star_types, start, travels).expect("the walk uses gateways")
    })
}

/// The same cases in every run.
fn fixed_cases() -> ProptestConfig {
    ProptestConfig {
        cases: 512,
        rng_seed: RngSeed::Fixed(2005),
        failure_persistence: None,
        ..ProptestConfig::default()
    }
}

proptest! {
    #![proptest_config(fixed_cases())]

    #[test]
    fn printing_and_parsing_are_inverse(exploration in exploration()) {
        let text = exploration.to_ron();
        let read = Exploration::from_ron(&text).map_err(|error| TestCaseError::fail(error.render("printed", &text)))?;
        // `{:?}` tells -0.0 from 0.0, which `==` does not.
        prop_assert_eq!(format!("{read:?}"), format!("{exploration:?}"));
        prop_assert_eq!(read.to_ron(), text);
    }

    #[test]
    fn what_is_printed_is_ron(exploration in exploration()) {
        ron::from_str::<ron::Value>(&exploration.to_ron()).unwrap();
    }

    #[test]
    fn mutilated_texts_are_refused_in_place_or_read(
        source in 0..VALID.len(),
        edits in vec((any::<Index>(), any::<u8>(), 0..3_u8), 1..6),
    ) {
        let mut bytes = VALID[source].as_bytes().to_vec();
        for (at, byte, kind) in edits {
            let at = at.index(bytes.len());
            match kind {
                0 => bytes[at] = byte,
                1 => bytes.insert(at, byte),
                _ => bytes.truncate(at.max(1)),
            }
        }
        check_any_bytes(&bytes);
    }

    #[test]
    fn tokens_in_any_order_are_refused_in_place_or_read(
        tokens in vec(proptest::sample::select(vec![
            "(", ")", "[", "]", "{", "}", ",", ":", "\"L\"", "\"0+\"", "\"0-\"", "exit", "entry", "star", "stars",
            "start", "travels", "odometry", "x", "covariance", "1.5", "-", "// ", "\n", "/*", "*/", "Some", "é",
        ]), 0..40),
    ) {
        check_any_bytes(tokens.concat().as_bytes());
    }
}

/// Whatever the bytes are: an exploration that `ron` takes for RON too, or an error whose place
/// exists.
fn check_any_bytes(bytes: &[u8]) {
    let text = String::from_utf8_lossy(bytes);
    match Exploration::from_ron_bytes(bytes) {
        Ok(exploration) => {
            ron::from_str::<ron::Value>(&text).expect("what is read is RON");
            assert_eq!(Exploration::from_ron(&exploration.to_ron()), Ok(exploration));
        }
        Err(error) => {
            let lines: Vec<&str> = text.split('\n').collect();
            for problem in error.problems() {
                let line = lines[problem.line() - 1];
                assert!((1..=line.chars().count() + 1).contains(&problem.column()), "{problem}");
                assert!(problem.column() - 1 + problem.length() <= line.chars().count() + 1, "{problem}");
                assert!(!problem.message().is_empty() && !problem.help().is_empty());
            }
            assert!(error.render("file.ron", &text).contains("file.ron:"));
        }
    }
}
