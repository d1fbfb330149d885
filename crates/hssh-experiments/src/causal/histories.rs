//! All hypotheses of the basic SSH with their past: in which state, at which place, the robot was at every moment.

use hssh_causal::schema::{Action, Trace, View, numbered_views};
use hssh_topology::Passability;

use super::hypothesis::{Glance, Hypothesis, PlaceId, StateId};

/// Distinctive state and place at every moment, by one hypothesis.
pub(crate) type History = Vec<(StateId, PlaceId)>;

/// The histories that explain a trace, breadth-first, unless there are more than `most` after some action.
pub(crate) fn histories(trace: &Trace, most: usize) -> Option<Vec<History>> {
    let actions: Vec<Action> = trace.steps().iter().map(|step| step.action).collect();
    explaining(&glances(trace), &actions, most)
}

/// The histories that explain actions and what was seen before and after them.
pub(super) fn explaining(glances: &[Glance], actions: &[Action], most: usize) -> Option<Vec<History>> {
    let root = Hypothesis::root(glances[0]);
    let mut all = vec![(vec![root.here()], root)];
    for (&action, &glance) in actions.iter().zip(&glances[1..]) {
        let mut grown = Vec::new();
        for (past, hypothesis) in &all {
            let children = hypothesis.step(action, glance).into_iter();
            grown.extend(children.map(|child| ([past.clone(), vec![child.here()]].concat(), child)));
            if grown.len() > most {
                return None;
            }
        }
        all = grown;
    }
    Some(all.into_iter().map(|(past, _)| past).collect())
}

/// The views of a trace as numbers, one per moment.
pub(super) fn glances(trace: &Trace) -> Vec<Glance> {
    let numbers = numbered_views(trace);
    let glance =
        |view: &View| Glance { view: numbers[view], travelable: view.ahead().0 == Passability::Travelable };
    trace.views().map(glance).collect()
}
