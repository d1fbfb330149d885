//! Complete certificates of small explorations are accepted, and count what was published.
#![allow(clippy::unwrap_used, reason = "in tests a failed unwrap is the failed assertion")]

mod naive;
mod support;

use hssh_topology::Axioms;
use hssh_verify::{Best, report, verify};
use hssh_world::{DriftModel, PlaceId, grid, snake, thesis_3x4};
use naive::costs::Terms;
use naive::{Objective, Question};
use support::{accepts, fixture};

fn snake_3x3(noise: bool) -> hssh_causal::Exploration {
    let world = grid(3, 3, 8.0).unwrap();
    let route = world.route_through(&snake(3, 3)).unwrap();
    if noise {
        return world.explore_with_odometry(&route, &DriftModel::default(), 7).unwrap();
    }
    world.explore(&route).unwrap()
}

/// Figure 3.3 of the thesis.
#[test]
fn the_3x3_snake_has_the_published_tree() {
    let exploration = snake_3x3(false);
    let published: [(Option<u32>, [u64; 17], u64); 2] = [
        (None, [1, 1, 1, 1, 1, 2, 2, 4, 4, 7, 7, 11, 21, 45, 56, 65, 88], 317),
        (Some(0), [1, 1, 1, 1, 1, 2, 2, 4, 4, 7, 7, 11, 18, 32, 41, 45, 62], 240),
    ];
    for (max_genus, levels, nodes) in published {
        for prune in [false, true] {
            let mut question = Question::new(&exploration, Objective::Preference("last"));
            question.axioms.max_genus = max_genus;
            question.prune = prune;
            let verdict = accepts(&question.prove().text, &exploration);
            assert_eq!(verdict.best, Best::Rank([0, 6, 9, 0]));
            if prune {
                assert!(verdict.expanded + verdict.open + verdict.maps <= nodes);
                continue;
            }
            assert_eq!(verdict.levels, levels);
            assert_eq!(verdict.expanded + verdict.maps, nodes);
            assert_eq!(verdict.maps, levels[16]);
            assert_eq!(verdict.open, 0);
        }
    }
}

/// Figure 3.3 again, where the tree is larger.
#[test]
fn larger_snakes_have_the_published_trees() {
    let explore = |rows, columns, route: &[PlaceId]| {
        let world = grid(rows, columns, 8.0).unwrap();
        world.explore(&world.route_through(route).unwrap()).unwrap()
    };
    let (narrow, square) = (explore(3, 4, &thesis_3x4()), explore(4, 4, &snake(4, 4)));
    let published = [
        (&narrow, None, None, 4_239, 1_465, [0, 7, 12, 0]),
        (&narrow, Some(0), None, 1_722, 507, [0, 7, 12, 0]),
        (&square, Some(0), Some(16), 8_452, 545, [0, 6, 12, 0]),
    ];
    for (exploration, max_genus, max_places, nodes, maps, best) in published {
        let mut question = Question::new(exploration, Objective::Preference("last"));
        question.axioms = Axioms { max_genus, max_places, ..Axioms::default() };
        let text = question.prove().text;
        let verdict = accepts(&text, exploration);
        assert_eq!(verdict.expanded + verdict.maps, nodes);
        assert_eq!((verdict.maps, verdict.best), (maps, Best::Rank(best)));
    }
}

#[test]
fn all_axioms_and_orders_agree_with_the_naive_prover() {
    let sources = [fixture("figure-2-4.ron"), fixture("aces.ron").prefix(10), snake_3x3(false)];
    let axioms = [
        Axioms::default(),
        Axioms { perpendicular: true, ..Axioms::default() },
        Axioms { consistent_boundaries: true, ..Axioms::default() },
        Axioms { max_places: Some(8), max_genus: Some(1), ..Axioms::default() },
        Axioms { no_self_intersection: false, max_genus: Some(0), max_places: Some(7), ..Axioms::default() },
        Axioms { no_circular_path: false, max_genus: Some(0), ..Axioms::default() },
    ];
    for exploration in &sources {
        for axioms in axioms {
            for (index, genus) in ["ignored", "first", "last"].into_iter().enumerate() {
                let mut question = Question::new(exploration, Objective::Preference(genus));
                question.axioms = axioms;
                question.prune = index > 0;
                question.closed = index > 1;
                let proof = question.prove();
                let verdict = accepts(&proof.text, exploration);
                assert_eq!((verdict.maps, verdict.levels), (proof.maps, proof.levels));
                assert_eq!(verdict.best == Best::None, proof.best.is_none());
            }
        }
    }
}

#[test]
fn posterior_certificates_agree_with_the_naive_prover() {
    let corridor = "evidence corridor 8.0 0.5 0.15 0.1";
    let cases = [
        ("ignored", "simplicity 1.0 2.0 1.0"),
        ("ignored", "choices"),
        ("likelihood", "simplicity 0.0 2.0 1.0"),
        ("likelihood", "simplicity 0.5 2.0 1.0"),
        ("evidence uniform 600.0", "flat"),
        (corridor, "flat"),
        (corridor, "choices"),
        (corridor, "simplicity 0.3 2.0 1.0"),
    ];
    let sources = [fixture("aces.ron").prefix(9), snake_3x3(true).prefix(12)];
    for exploration in &sources {
        for (index, (metrical, prior)) in cases.into_iter().enumerate() {
            for prune in [false, true] {
                let mut terms = Terms::new(metrical, prior);
                if index % 2 == 1 {
                    terms.appearance.insert((8, 0, 0), 2.5);
                    terms.appearance.insert((8, 1, 2), -1.0);
                    terms.appearance.insert((5, 1, 0), -0.5);
                }
                let mut question = Question::new(exploration, Objective::Posterior(terms));
                question.prune = prune;
                question.closed = index == 2;
                let proof = question.prove();
                let verdict = accepts(&proof.text, exploration);
                assert_eq!(verdict.maps, proof.maps);
                assert_eq!(verdict.on_trust.is_empty(), metrical == "ignored" && index % 2 == 0);
            }
        }
    }
}

#[test]
fn an_exploration_that_nothing_explains_has_no_best() {
    // Back through the door that the robot came by, to a place that was no door before.
    let exploration = hssh_causal::Exploration::from_ron(
        r#"(stars: {"door": ["0+", "0-"], "end": ["0+", "0- closed"]}, start: "door",
            travels: [(exit: "0+", entry: "0-", star: "door"), (exit: "0-", entry: "0+", star: "end")])"#,
    )
    .unwrap();
    let proof = Question::new(&exploration, Objective::Preference("ignored")).prove();
    let verdict = accepts(&proof.text, &exploration);
    assert_eq!((verdict.best, verdict.maps, verdict.expanded), (Best::None, 0, 2));
    assert!(report(&verdict).contains("none"));
}

#[test]
fn a_report_names_the_claim_and_what_is_on_trust() {
    let exploration = fixture("aces.ron").prefix(6);
    let mut terms = Terms::new("likelihood", "flat");
    terms.appearance.insert((2, 1, 0), 0.5);
    let text = Question::new(&exploration, Objective::Posterior(terms)).prove().text;
    let report = report(&accepts(&text, &exploration));
    for part in ["The certificate holds", "posterior probability", "all others", "lowest minimum", "1 ratios"]
    {
        assert!(report.contains(part), "{part} in {report}");
    }
}

#[test]
fn the_certificate_shown_in_the_documentation_holds() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/certificate.md");
    let page = std::fs::read_to_string(path).unwrap();
    let shown = page.split("```text\n").nth(1).and_then(|rest| rest.split("```").next()).unwrap();
    let exploration = hssh_causal::Exploration::from_ron(
        r#"(stars: {"door": ["0+", "0-"]}, start: "door", travels: [(exit: "0+", entry: "0-", star: "door")])"#,
    )
    .unwrap();
    let verdict = accepts(shown, &exploration);
    assert_eq!((verdict.best, verdict.maps, verdict.expanded), (Best::Rank([0, 1, 2, 0]), 1, 1));
}

/// For every node of a whole tree: a bound above the best map below it is too high.
fn no_bound_above_the_maps_below(
    question: &Question<'_>,
    above: impl Fn(&[f64]) -> Vec<f64>,
    lowest: impl Fn(&str, &[f64]) -> Option<String>,
) -> usize {
    let proof = question.prove();
    let lines: Vec<&str> = proof.text.lines().collect();
    let best = lines.iter().position(|line| line.starts_with("best")).unwrap();
    let mut tried = 0;
    for (line, least) in &proof.least_below {
        let Some(least) = least.as_ref().filter(|_| lines[line - 1].starts_with('e')) else { continue };
        let Some(lowest) = lowest(lines[best], least) else { continue };
        let (head, tail) = (lines[..best].join("\n"), lines[best + 1..line - 1].join("\n"));
        let before = format!("{head}\n{lowest}\n{tail}");
        let text = format!("{before}\no {}\n", question.write(&above(least)));
        let refusal = verify(&text, question.exploration).unwrap_err();
        assert_eq!(refusal.line, *line, "{refusal}");
        assert!(refusal.reason.contains("too high"), "{refusal}");
        tried += 1;
    }
    tried
}

#[test]
fn bounds_of_preference_are_below_all_maps() {
    let sources = [fixture("figure-2-4.ron"), fixture("aces.ron"), snake_3x3(false)];
    let relaxed = Axioms { no_self_intersection: false, no_circular_path: false, ..Axioms::default() };
    let mut tried = 0;
    for exploration in &sources {
        for genus in ["first", "last"] {
            let short = exploration.prefix(8);
            let mut question = Question::new(exploration, Objective::Preference(genus));
            tried +=
                no_bound_above_the_maps_below(&question, next_rank, |_, _| Some("best 0 0 0 0".to_owned()));
            question.closed = true;
            tried +=
                no_bound_above_the_maps_below(&question, next_rank, |_, _| Some("best 0 0 0 0".to_owned()));
            question = Question::new(&short, Objective::Preference(genus));
            question.axioms = Axioms { max_genus: Some(0), ..relaxed };
            tried +=
                no_bound_above_the_maps_below(&question, next_rank, |_, _| Some("best 0 0 0 0".to_owned()));
        }
    }
    assert!(tried > 500);
}

/// The line of the best value, for what is not hopeless beside it: of all else the checker only confirms that it is.
fn near_best(line: &str, least: &[f64]) -> Option<String> {
    let best: f64 = line.strip_prefix("best ").unwrap().parse().unwrap();
    (least[0] < best + 20.0).then(|| line.to_owned())
}

/// The next rank in the order.
fn next_rank(rank: &[f64]) -> Vec<f64> {
    let mut next = rank.to_vec();
    *next.last_mut().unwrap() += 1.0;
    next
}

#[test]
fn bounds_of_posteriors_are_below_all_maps() {
    let corridor = "evidence corridor 8.0 0.5 0.15 0.1";
    let cases = [
        ("ignored", "simplicity 1.0 2.0 1.0"),
        ("likelihood", "simplicity 0.5 2.0 1.0"),
        ("evidence uniform 600.0", "choices"),
        ("evidence uniform 1e-9", "flat"),
        (corridor, "simplicity 0.3 2.0 1.0"),
    ];
    let mut tried = 0;
    for exploration in [fixture("aces.ron").prefix(9), snake_3x3(true).prefix(13)] {
        for (metrical, prior) in cases {
            let mut terms = Terms::new(metrical, prior);
            terms.appearance.insert((8, 0, 0), 2.5);
            terms.appearance.insert((7, 1, 2), -1.0);
            let question = Question::new(&exploration, Objective::Posterior(terms));
            let above = |least: &[f64]| vec![least[0] + 1e-4 * (1.0 + least[0].abs())];
            tried += no_bound_above_the_maps_below(&question, above, near_best);
        }
    }
    assert!(tried > 60, "{tried}");
}
