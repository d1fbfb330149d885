//! The enumeration of hypotheses against all partitions of moments, and against what section 2.3.3 says.

use hssh_causal::schema::Action::{self, Travel, TurnAround};
use hssh_causal::schema::{Sight, Trace, Turning};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::histories::explaining;
use super::hypothesis::Glance;
use super::oracle::explanations;

const TURN: Action = Action::Turn { clockwise: 1 };

/// All hypotheses that explain actions and glances, each as the states and the places of all moments.
fn enumerated(glances: &[Glance], actions: &[Action]) -> Vec<(Vec<usize>, Vec<usize>)> {
    let all = explaining(glances, actions, usize::MAX).unwrap();
    let partitions = all.into_iter().map(|history| {
        let (states, places): (Vec<_>, Vec<_>) = history.into_iter().unzip();
        (in_order(&states), in_order(&places))
    });
    let mut all: Vec<_> = partitions.collect();
    all.sort();
    all
}

/// The same partition with its parts numbered in the order of first members.
fn in_order<T: Copy + PartialEq>(parts: &[T]) -> Vec<usize> {
    let mut seen: Vec<T> = Vec::new();
    let number = |&part: &T| {
        seen.iter().position(|&other| other == part).unwrap_or_else(|| {
            seen.push(part);
            seen.len() - 1
        })
    };
    parts.iter().map(number).collect()
}

fn open() -> Glance {
    Glance { view: 0, travelable: true }
}

/// Random actions and glances, most of them alike: what can never be is as good as what can.
#[test]
fn all_hypotheses_and_no_others() {
    let mut random = ChaCha8Rng::seed_from_u64(1);
    let mut explained = 0;
    for _ in 0..400 {
        let length = random.random_range(1..=6);
        let mut glances = vec![open()];
        let mut actions = Vec::new();
        for _ in 0..length {
            let can_travel = glances.last().unwrap().travelable;
            let action = [TURN, TurnAround, Travel][random.random_range(0..if can_travel { 3 } else { 2 })];
            actions.push(action);
            let closed = Glance { view: 1, travelable: false };
            glances.push(if random.random_range(0..6) == 0 { closed } else { open() });
        }
        let mut expected: Vec<_> = explanations(&glances, &actions);
        expected.iter_mut().for_each(|(_, places)| *places = in_order(places));
        expected.sort();
        explained += expected.len();
        assert_eq!(enumerated(&glances, &actions), expected, "{actions:?} {glances:?}");
    }
    assert!(explained > 500, "the test has something to compare: {explained}");
}

/// "Consider a robot that performs successive turn actions at a + intersection …: there is no way to
/// figure out whether the intersection has more than just two intersecting paths."
#[test]
fn identical_views_leave_every_even_circle() {
    for turns in 0..12 {
        let count = enumerated(&vec![open(); turns + 1], &vec![TURN; turns]).len();
        // Still going round, or a circle of 2, 4, … that is complete by now.
        assert_eq!(count, 1 + turns / 2);
    }
}

/// "Even if some views differ at a place, every model that is equivalent to the correct one up to a modulo
/// operation on the circular sequence of views is legitimate": a T, turned around three times.
#[test]
fn different_views_leave_a_modulo() {
    let glance = |turn: usize| Glance { view: u32::from(turn % 4 == 1), travelable: turn % 4 != 1 };
    let glances: Vec<Glance> = (0..=12).map(glance).collect();
    // Circles of 4, of 8 and of 12, and 13 different states so far.
    assert_eq!(enumerated(&glances, &[TURN; 12]).len(), 4);
}

/// Whatever the robot turns and sees, one of the hypotheses is what truly happened.
#[test]
fn the_truth_is_among_them() {
    let worlds = super::explorations().unwrap();
    let (name, exploration) = &worlds[0];
    assert_eq!(name, "2×2");
    // Three corridors of the block, and the fourth back to the start.
    let (exploration, corners) = (exploration.prefix(4), [0, 1, 3, 2, 0]);
    for sight in [Sight::Ahead, Sight::Place] {
        let trace = Trace::of(&exploration, sight, Turning::Stepwise).unwrap();
        let mut truth = vec![(corners[0], exploration.travels()[0].exit)];
        let mut visit = 0;
        for step in trace.steps() {
            let (corner, facing) = truth[truth.len() - 1];
            let star = exploration.star(exploration.visits().nth(visit).unwrap());
            truth.push(match step.action {
                Action::Turn { clockwise } => (corner, facing.turned(clockwise, star.degree())),
                TurnAround => (corner, star.opposite(facing)),
                Travel => {
                    visit += 1;
                    let travel = &exploration.travels()[visit - 1];
                    (corners[visit], exploration.star(travel.star).opposite(travel.entry))
                }
            });
        }
        let actions: Vec<Action> = trace.steps().iter().map(|step| step.action).collect();
        let states: Vec<usize> =
            truth.iter().map(|state| truth.iter().position(|other| other == state).unwrap()).collect();
        let places: Vec<usize> = truth.iter().map(|(corner, _)| *corner).collect();
        let truth = (in_order(&states), in_order(&places));
        let hypotheses = enumerated(&super::glances(&trace), &actions);
        assert_eq!(hypotheses.iter().filter(|&hypothesis| *hypothesis == truth).count(), 1);
    }
}

/// A travel may lead to a new place or, turned around, back to where the robot came from, for sure.
#[test]
fn the_way_back_is_known() {
    let actions = [TurnAround, TurnAround, Travel, TurnAround, Travel];
    let hypotheses = enumerated(&[open(); 6], &actions);
    assert_eq!(hypotheses, [(vec![0, 1, 0, 2, 3, 1], vec![0, 0, 0, 1, 1, 0])]);
}
