//! The hypotheses of the basic SSH by their definition: all ways to partition moments into states and places.

use hssh_causal::schema::Action;

use super::hypothesis::Glance;

/// A set of pairs of states.
type Relation = Vec<(usize, usize)>;

/// All ways to say which moments are the same state, and which states are at the same place, that explain
/// actions and what was seen.
pub(super) fn explanations(glances: &[Glance], actions: &[Action]) -> Vec<(Vec<usize>, Vec<usize>)> {
    let mut all = Vec::new();
    for states in partitions(glances.len()) {
        let count = states.iter().max().map_or(0, |most| most + 1);
        for places in partitions(count) {
            if explains(glances, actions, &states, &places) {
                all.push((states.clone(), states.iter().map(|&state| places[state]).collect()));
            }
        }
    }
    all
}

/// All partitions of so many things, each as the number of the part of every thing.
fn partitions(things: usize) -> Vec<Vec<usize>> {
    let mut all = vec![Vec::new()];
    for _ in 0..things {
        let grown = |parts: &Vec<usize>| {
            let next = parts.iter().max().map_or(0, |most| most + 1);
            (0..=next).map(|part| [parts.clone(), vec![part]].concat()).collect::<Vec<_>>()
        };
        all = all.iter().flat_map(grown).collect();
    }
    all
}

fn explains(glances: &[Glance], actions: &[Action], states: &[usize], places: &[usize]) -> bool {
    let count = places.len();
    let glance = |state: usize| glances[states.iter().position(|&other| other == state).unwrap()];
    if (0..glances.len()).any(|moment| glances[moment] != glance(states[moment])) {
        return false;
    }
    let made = |wanted: fn(&Action) -> bool| -> Relation {
        let moments = (0..actions.len()).filter(|&moment| wanted(&actions[moment]));
        moments.map(|moment| (states[moment], states[moment + 1])).collect()
    };
    let next = made(|action| matches!(action, Action::Turn { .. }));
    let mut opposite = made(|action| *action == Action::TurnAround);
    let mut travel = made(|action| action.is_travel());
    while let Some((is_travel, pair)) = missing(&opposite, &travel) {
        if is_travel { travel.push(pair) } else { opposite.push(pair) }
    }
    let one_to_one = |relation: &Relation| {
        let agree = |&(a, b): &(usize, usize)| relation.iter().all(|&(c, d)| (a == c) == (b == d));
        relation.iter().all(agree)
    };
    let same_place = |&(one, other): &(usize, usize)| places[one] == places[other];
    [&next, &opposite, &travel].into_iter().all(one_to_one)
        && next.iter().chain(&opposite).all(same_place)
        && !travel.iter().any(same_place)
        && opposite.iter().all(|(one, other)| one != other)
        && travel.iter().all(|&(from, _)| glance(from).travelable)
        && travel
            .iter()
            .all(|&(_, to)| opposite.iter().all(|&(one, out)| one != to || glance(out).travelable))
        && (0..count).all(|state| circle_is_whole(state, &next, places))
        && (0..count).all(|state| never_returns(state, &travel, places))
}

/// A pair that follows from others but is not there: is it a travel, and which.
fn missing(opposite: &Relation, travel: &Relation) -> Option<(bool, (usize, usize))> {
    let turned = opposite.iter().map(|&(one, other)| (false, (other, one)));
    let mut follow: Vec<(bool, (usize, usize))> = turned.collect();
    for &(from, to) in travel {
        for &(to_again, out) in opposite.iter().filter(|&&(one, _)| one == to) {
            let homes = opposite.iter().filter(|&&(one, _)| one == from);
            follow.extend(homes.map(|&(_, home)| (true, (out, home))));
            let ends = travel.iter().filter(|&&(start, _)| start == out);
            follow.extend(ends.map(|&(_, home)| (false, (from, home))));
            debug_assert_eq!(to, to_again);
        }
        for &(_, home) in opposite.iter().filter(|&&(one, _)| one == from) {
            let starts = travel.iter().filter(|&&(_, end)| end == home);
            follow.extend(starts.map(|&(out, _)| (false, (to, out))));
        }
    }
    follow.into_iter().find(
        |&(is_travel, pair)| {
            if is_travel { !travel.contains(&pair) } else { !opposite.contains(&pair) }
        },
    )
}

/// If turning comes back to a state, it has faced every state of the place, an even number.
fn circle_is_whole(start: usize, next: &Relation, places: &[usize]) -> bool {
    let onward = |state: usize| next.iter().find(|&&(from, _)| from == state).map(|&(_, to)| to);
    let mut faced = vec![start];
    let mut state = start;
    while let Some(to) = onward(state) {
        if to == start {
            let all = places.iter().filter(|&&place| place == places[start]).count();
            return faced.len() == all && all % 2 == 0;
        }
        if faced.contains(&to) {
            return false;
        }
        faced.push(to);
        state = to;
    }
    true
}

/// Axioms 1 and 2.
fn never_returns(start: usize, travel: &Relation, places: &[usize]) -> bool {
    let mut met = vec![places[start]];
    let mut state = start;
    while let Some(&(_, to)) = travel.iter().find(|&&(from, _)| from == state) {
        if met.contains(&places[to]) {
            return false;
        }
        met.push(places[to]);
        state = to;
    }
    true
}
