//! Laws of explanations with errors: without errors they are the maps, and bounds only take away.

use hssh_causal::Exploration;
use hssh_oracle::{Node, ReadHypothesis, ReadingModel, Rules, Step, enumerate_readings};

use crate::grid::{exploration, snake};
use crate::readings::walk;

/// What both enumerations say: visits, places, links and pending gateways.
type Facts = (Vec<Option<usize>>, usize, usize, usize);

/// The hypotheses of the recursive step, each with the places of its visits.
fn exact(exploration: &Exploration, rules: &Rules) -> Vec<Facts> {
    let mut nodes = vec![(Node::root(exploration), vec![0])];
    for travel in exploration.travels() {
        let mut next = Vec::new();
        for (node, visits) in nodes {
            let children = match node.step(travel) {
                Step::Predicted(child) => vec![child],
                Step::Refuted => Vec::new(),
                Step::Expanded { candidates, .. } => candidates,
            };
            for child in children.into_iter().filter(|child| rules.first_violation(&child.map).is_none()) {
                let visits = [visits.as_slice(), &[child.current]].concat();
                next.push((child, visits));
            }
        }
        nodes = next;
    }
    let facts = |(node, visits): (Node, Vec<usize>)| {
        let first = |place| visits.iter().position(|visit| visit == place);
        let map = &node.map;
        let numbered = visits.iter().map(first).collect();
        (numbered, map.places.len(), map.links.len(), map.pending_gateways().len())
    };
    let mut all: Vec<Facts> = nodes.into_iter().map(facts).collect();
    all.sort();
    all
}

fn facts(hypotheses: &[ReadHypothesis]) -> Vec<Facts> {
    let facts = |h: &ReadHypothesis| (h.visits.clone(), h.places, h.links, h.pending);
    let mut all: Vec<Facts> = hypotheses.iter().map(facts).collect();
    all.sort();
    all
}

fn without_errors_is_exact(exploration: &Exploration, rules: &Rules, maps: usize) {
    let hypotheses = enumerate_readings(exploration, rules, &ReadingModel::EXACT);
    assert_eq!(hypotheses.len(), maps);
    assert!(hypotheses.iter().all(|hypothesis| hypothesis.cost == 0.0));
    assert_eq!(facts(&hypotheses), exact(exploration, rules));
}

#[test]
fn without_errors_the_explanations_are_the_published_maps() {
    let grid = exploration(3, 3, &snake(3, 3));
    without_errors_is_exact(&grid, &Rules::default(), 88);
    without_errors_is_exact(&grid, &Rules::planar(), 62);
}

#[test]
fn without_errors_symmetric_stars_agree_too() {
    let crossing = "0+ 1+ 0- 1-";
    let travels = [(0, 0, crossing), (2, 0, crossing), (1, 0, crossing), (3, 0, crossing)];
    let all = Rules { no_self_intersection: false, no_circular_path: false, ..Rules::default() };
    let walked = walk(crossing, &travels);
    let strict = Rules { sides: true, perpendicular: true, ..Rules::planar() };
    for (rules, maps) in [(all, 86), (strict, 1)] {
        assert_eq!(exact(&walked, &rules).len(), maps);
        without_errors_is_exact(&walked, &rules, maps);
    }
}

/// Prices are never negative; a higher limit, and one more place to pass, only add explanations.
#[test]
fn bounds_only_take_away() {
    let tee = "0+ 1+ 0- (1-)";
    let walked = walk(tee, &[(1, 0, "0+ 0-"), (1, 2, tee), (0, 1, tee)]);
    let count = |limit: f64, most_passed: u32| {
        let model = ReadingModel { limit, most_passed, ..ReadingModel::default() };
        let hypotheses = enumerate_readings(&walked, &Rules::planar(), &model);
        assert!(hypotheses.iter().all(|h| h.cost >= 0.0 && h.cost <= 3.0 * limit));
        assert!(hypotheses.is_sorted_by(|a, b| a.cost <= b.cost));
        hypotheses
    };
    let mut less = count(0.0, 2);
    assert!(less.is_empty());
    for limit in [2.0, 4.0, 6.0] {
        let more = count(limit, 2);
        assert!(more.len() > less.len());
        assert_included(&less, &more);
        less = more;
    }
    assert_included(&count(6.0, 0), &count(6.0, 1));
    assert_included(&count(6.0, 1), &count(6.0, 2));
}

/// Every hypothesis of `less` is in `more`, as often at least.
fn assert_included(less: &[ReadHypothesis], more: &[ReadHypothesis]) {
    let mut more = more.to_vec();
    for hypothesis in less {
        let found = more.iter().position(|other| other == hypothesis);
        more.swap_remove(found.unwrap_or_else(|| panic!("{hypothesis:?} is lost")));
    }
}

#[test]
fn it_is_deterministic() {
    let walked = walk("0+ 1+ 0- 1-", &[(1, 0, "0+ 0-"), (1, 2, "0+ 1+ 0- (1-)")]);
    let model = ReadingModel { limit: 8.0, ..ReadingModel::default() };
    let run = || enumerate_readings(&walked, &Rules::default(), &model);
    assert_eq!(run(), run());
}
