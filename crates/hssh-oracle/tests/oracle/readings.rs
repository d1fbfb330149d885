//! Explanations with errors, small enough to price by hand.

use hssh_causal::{Exploration, NamedStar, StarType, Travel};
use hssh_oracle::{ReadHypothesis, ReadingModel, Rules, enumerate_readings};
use hssh_topology::{Olp, Star};

const DEAD_END: &str = "0+ (0-)";
const CORRIDOR: &str = "0+ 0-";

/// From a star on travels ⟨exit, entry, star⟩; ends by their position in the star.
pub(crate) fn walk(start: &str, travels: &[(u32, u32, &str)]) -> Exploration {
    let mut texts: Vec<&str> = vec![start];
    for &(_, _, text) in travels {
        if !texts.contains(&text) {
            texts.push(text);
        }
    }
    let named = |text: &&str| {
        let star: Star = text.parse().unwrap();
        NamedStar { name: (*text).to_owned(), bearings: vec![None; star.ends().len()], star }
    };
    let star = |text: &str| StarType(texts.iter().position(|&other| other == text).unwrap() as u32);
    let travel = |&(exit, entry, text): &(u32, u32, &str)| Travel {
        exit: Olp::new(exit),
        entry: Olp::new(entry),
        star: star(text),
        odometry: None,
    };
    let travels = travels.iter().map(travel).collect();
    Exploration::new(texts.iter().map(named).collect(), StarType(0), travels).unwrap()
}

fn readings(exploration: &Exploration) -> Vec<ReadHypothesis> {
    enumerate_readings(exploration, &Rules::planar(), &ReadingModel::default())
}

fn nats(probability: f64) -> f64 {
    -probability.ln()
}

/// −ln(r / (r + g)) of an end shown once: what it costs to leave by it for the first time.
fn leaving() -> f64 {
    nats(0.97 * 0.9 / (0.97 * 0.9 + 0.03))
}

/// Shown again of a travelled end.
fn seen() -> f64 {
    nats(0.9)
}

/// The costs of those with these visits, places, links and pending gateways.
fn costs(hypotheses: &[ReadHypothesis], visits: &[Option<usize>], counts: (usize, usize, usize)) -> Vec<f64> {
    hypotheses
        .iter()
        .filter(|h| h.visits == visits && (h.places, h.links, h.pending) == counts)
        .map(|h| h.cost)
        .collect()
}

fn assert_close(costs: &[f64], expected: &[f64]) {
    assert_eq!(costs.len(), expected.len(), "{costs:?} {expected:?}");
    for (cost, expected) in std::iter::zip(costs, expected) {
        assert!((cost - expected).abs() < 1e-9, "{costs:?} {expected:?}");
    }
}

/// From a dead end to a dead end: a new place, a false visit, or a turn on the way.
#[test]
fn one_travel_has_three_explanations() {
    let hypotheses = readings(&walk(DEAD_END, &[(0, 0, DEAD_END)]));
    let all: Vec<_> = hypotheses.iter().map(|h| (h.visits[1], h.places, h.links, h.pending)).collect();
    assert_eq!(all, [(Some(1), 2, 1, 0), (None, 1, 0, 1), (Some(0), 1, 0, 1)]);
    let costs: Vec<f64> = hypotheses.iter().map(|h| h.cost).collect();
    let c = leaving();
    assert_close(&costs, &[c, c + nats(0.05), c + nats(0.05) + seen()]);
}

/// On the second visit the side gateway of a T is missed.
#[test]
fn a_missed_gateway() {
    let tee = "0+ 1+ 0- (1-)";
    let exploration = walk(DEAD_END, &[(0, 2, tee), (2, 0, DEAD_END), (0, 1, CORRIDOR)]);
    let (r, g) = (0.97 * 0.9, 0.03);
    let ahead = nats((r * 0.9 + g * 0.2) / (r + g));
    let side = nats((r * 0.1 + g * 0.8) / (r + g));
    let expected = leaving() + seen() + seen() + ahead + side;
    let found = costs(&readings(&exploration), &[Some(0), Some(1), Some(0), Some(1)], (2, 1, 2));
    assert_close(&found[..1], &[expected]);
    assert!(found.iter().skip(1).all(|&cost| cost > expected));
}

/// Two dead ends with a corridor between them, passed without a report on the way back.
#[test]
fn a_passed_place() {
    let exploration = walk(DEAD_END, &[(0, 1, CORRIDOR), (0, 0, DEAD_END), (0, 0, DEAD_END)]);
    let found = costs(&readings(&exploration), &[Some(0), Some(1), Some(2), Some(0)], (3, 2, 0));
    assert_close(&found, &[2.0 * leaving() + nats(0.1) + seen()]);
}

/// There and back between dead ends, and then a crossing comes: it lies past a junction, left or right, or on
/// the way itself, with one of its three other ends ahead.
#[test]
fn a_branch_and_an_inserted_place() {
    let crossing = "0+ 1+ 0- 1-";
    let exploration = walk(DEAD_END, &[(0, 0, DEAD_END), (0, 0, DEAD_END), (0, 2, crossing)]);
    let hypotheses = readings(&exploration);
    let visits = [Some(0), Some(1), Some(0), Some(3)];
    let before = leaving() + seen();
    let branched = before + 3.0 * nats(0.1) + nats(0.1);
    assert_close(&costs(&hypotheses, &visits, (4, 3, 3)), &[branched; 2]);
    let inserted = before + 2.0 * nats(0.1);
    assert_close(&costs(&hypotheses, &visits, (3, 2, 2)), &[inserted; 3]);
}

/// A report of no place, gone on from or turned at.
#[test]
fn a_false_visit() {
    let on = walk(DEAD_END, &[(0, 1, CORRIDOR), (0, 0, DEAD_END)]);
    let found = costs(&readings(&on), &[Some(0), None, Some(2)], (2, 1, 0));
    assert_close(&found, &[leaving() + nats(0.05)]);

    let back = walk(DEAD_END, &[(0, 1, CORRIDOR), (1, 0, DEAD_END)]);
    let hypotheses = readings(&back);
    let after_false: Vec<&ReadHypothesis> = hypotheses.iter().filter(|h| h.visits[1].is_none()).collect();
    assert_eq!(after_false.len(), 1);
    assert_eq!(after_false[0].visits, [Some(0), None, Some(0)]);
    assert_close(&[after_false[0].cost], &[leaving() + nats(0.05) + seen()]);
}

/// Out of a T by its stem and back by it, all three gateways seen again.
#[test]
fn a_turned_back_travel() {
    let tee = "0+ 1+ 0- (1-)";
    let hypotheses = readings(&walk(tee, &[(1, 1, tee)]));
    let (r, g) = (0.97 * 0.9, 0.03);
    let again = nats((r * 0.9 + g * 0.2) / (r + g));
    let found = costs(&hypotheses, &[Some(0), Some(0)], (1, 0, 3));
    assert_close(&found[..1], &[leaving() + nats(0.05) + seen() + 2.0 * again]);
}

/// From a crossing back to a corridor's way by a side that no visit has shown: a closure by a new end.
#[test]
fn a_closure_by_a_new_end() {
    let tee = "0+ 1+ 0- (1-)";
    let exploration = walk(CORRIDOR, &[(0, 1, CORRIDOR), (0, 1, tee)]);
    let rules = Rules { no_self_intersection: false, no_circular_path: false, ..Rules::default() };
    let hypotheses = enumerate_readings(&exploration, &rules, &ReadingModel::default());
    // At the start (travelled ahead, not behind), in both directions: the side is new, with m = 1.
    let (r, g) = (0.97 * 0.9, 0.03);
    let again = nats((r * 0.9 + g * 0.2) / (r + g));
    let expected = 2.0 * leaving() + seen() + again + nats(0.1);
    let found = costs(&hypotheses, &[Some(0), Some(1), Some(0)], (2, 2, 1));
    let as_expected = found.iter().filter(|&&cost| (cost - expected).abs() < 1e-9).count();
    assert_eq!(as_expected, 2, "{found:?}");
}
