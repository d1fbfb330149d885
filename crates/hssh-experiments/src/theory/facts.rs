//! Explorations, traces and axioms as the facts of the theory (theory/individuals.lp, theory/axioms.lp).

use std::collections::BTreeMap;
use std::fmt::Write;

use hssh_causal::Exploration;
use hssh_causal::schema::{Action, Sight, Trace, View, numbered_views};
use hssh_topology::{Axioms, Olp, Passability};

use super::model::Moment;

/// The number of the first moment of every stay of an exploration: one moment for each end of a star.
pub(super) fn openings(exploration: &Exploration) -> Vec<Moment> {
    let degrees = exploration.visits().map(|star| exploration.star(star).degree());
    degrees
        .scan(0, |next, degree| {
            *next += degree;
            Some(*next - degree)
        })
        .collect()
}

/// An exploration in which every stay shows the whole star.
///
/// Every end that a stay shows is a moment, with the virtual turns that lead from one to another (section 2.2.2).
pub(super) fn of_exploration(exploration: &Exploration) -> String {
    let openings = openings(exploration);
    let moment = |stay: usize, end: Olp| openings[stay] + end.number();
    let mut numbers: BTreeMap<View, usize> = BTreeMap::new();
    let mut facts = String::from("stars.\n");
    for (stay, star) in exploration.visits().map(|star| exploration.star(star)).enumerate() {
        for end in star.olps() {
            let next_number = numbers.len();
            let view = *numbers.entry(View::of(star, end, Sight::Place)).or_insert(next_number);
            let here = moment(stay, end);
            say(&mut facts, here, view, star.is_travelable(end));
            say_schema(&mut facts, here, "turn", moment(stay, star.next(end)));
            say_schema(&mut facts, here, "around", moment(stay, star.opposite(end)));
        }
    }
    for (stay, travel) in exploration.travels().iter().enumerate() {
        let ahead = exploration.star(travel.star).opposite(travel.entry);
        say_schema(&mut facts, moment(stay, travel.exit), "travel", moment(stay + 1, ahead));
    }
    facts
}

/// A trace of a robot that turns from each oriented local path to the next, or around.
pub(super) fn of_trace(trace: &Trace) -> String {
    let numbers = numbered_views(trace);
    let mut facts = String::new();
    for (here, view) in (0..).zip(trace.views()) {
        say(&mut facts, here, numbers[view] as usize, view.ahead().0 == Passability::Travelable);
    }
    for (here, step) in (0..).zip(trace.steps()) {
        let action = match step.action {
            Action::Turn { .. } => "turn",
            Action::TurnAround => "around",
            Action::Travel => "travel",
        };
        say_schema(&mut facts, here, action, here + 1);
    }
    facts
}

/// The axioms that hold.
pub(super) fn of_axioms(axioms: &Axioms) -> String {
    let Axioms { no_self_intersection, no_circular_path, perpendicular, consistent_boundaries, .. } = *axioms;
    let switches = [
        (no_self_intersection, "no_self_intersection".to_owned()),
        (no_circular_path, "no_circular_path".to_owned()),
        (perpendicular, "perpendicular".to_owned()),
        (consistent_boundaries, "consistent_boundaries".to_owned()),
    ];
    let places = axioms.max_places.map(|most| (true, format!("max_places({most})")));
    let genus = axioms.max_genus.map(|most| (true, format!("max_genus({most})")));
    let held = switches.into_iter().chain(places).chain(genus).filter(|(holds, _)| *holds);
    held.map(|(_, axiom)| format!("axiom({axiom}).\n")).collect()
}

fn say(facts: &mut String, moment: Moment, view: usize, is_travelable: bool) {
    let ahead = if is_travelable { format!(" travelable({moment}).") } else { String::new() };
    let _ = writeln!(facts, "view({moment},{view}).{ahead}");
}

fn say_schema(facts: &mut String, from: Moment, action: &str, to: Moment) {
    let _ = writeln!(facts, "schema({from},{action},{to}).");
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A corridor with a dead end on either side, walked to the end and back.
    fn corridor() -> Exploration {
        let text = r#"(
            stars: {"west": ["0+", "0- closed"], "east": ["0+ closed", "0-"]},
            start: "west",
            travels: [(exit: "0+", entry: "0-", star: "east"), (exit: "0-", entry: "0+", star: "west")],
        )"#;
        Exploration::from_ron(text).unwrap()
    }

    /// Both dead ends are one star, seen from different ends first.
    #[test]
    fn an_exploration_is_told_end_by_end() {
        assert_eq!(openings(&corridor()), [0, 2, 4]);
        insta::assert_snapshot!(of_exploration(&corridor()));
    }

    #[test]
    fn a_trace_is_told_moment_by_moment() {
        let trace = Trace::of(&corridor(), Sight::Ahead, hssh_causal::schema::Turning::Stepwise).unwrap();
        insta::assert_snapshot!(of_trace(&trace));
    }

    #[test]
    fn axioms_that_do_not_hold_are_not_told() {
        let axioms = Axioms { no_circular_path: false, max_genus: Some(0), ..Axioms::default() };
        assert_eq!(of_axioms(&axioms), "axiom(no_self_intersection).\naxiom(max_genus(0)).\n");
    }
}
