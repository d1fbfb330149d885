//! The recursive step applied to a node of a tree.

use hssh_topology::{Hypothesis, MapOlp, Outcome, PlaceId, Rules, Step};

use crate::context::Context;
use crate::cursor::Cursor;
use crate::experience::Experience;
use crate::tree::{Child, NodeId, Tree};

/// Which map [`successors`] shows with a successor.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Look {
    /// The parent's.
    Outside,
    /// The successor's own, with the robot where it arrived.
    Inside,
}

/// Applies the recursive step to a node of the tree and hands each successor to `each`, together
/// with the hypothesis before or after the travel. What became of the node; `step` adds up what the axioms remove.
pub(crate) fn successors(
    cursor: &mut Cursor,
    node: NodeId,
    tree: &Tree,
    context: Context<'_>,
    step: &mut Step,
    look: Look,
    mut each: impl FnMut(Child, &Hypothesis),
) -> Outcome {
    let experience = context.experience;
    let observation = experience.observations[tree.depth(node)];
    let hypothesis = cursor.go_to(node, tree, experience);
    let rules = Rules { catalog: &experience.catalog, axioms: context.axioms };
    hypothesis.step(observation, rules, step);
    keep_allowed(hypothesis, node, tree, experience, step);
    let exit = hypothesis.exit(observation);
    for &derivation in &step.derivations {
        let arrival = hypothesis.arrival(observation, derivation);
        let child = Child { parent: node, derivation, exit, arrival };
        match look {
            Look::Outside => each(child, hypothesis),
            Look::Inside => {
                let footprint = hypothesis.follow(observation, derivation, rules.catalog);
                each(child, hypothesis);
                hypothesis.take_back(footprint);
            }
        }
    }
    step.outcome
}

/// Strikes the successors out that are known from elsewhere to be wrong.
fn keep_allowed(
    hypothesis: &Hypothesis,
    node: NodeId,
    tree: &Tree,
    experience: &Experience,
    step: &mut Step,
) {
    let visit = tree.depth(node) + 1;
    if !experience.constraints.concern(visit) {
        return;
    }
    let map = &hypothesis.map;
    let place_of = |olp: MapOlp| (olp.index() < map.olp_count() as usize).then(|| map.place(olp));
    let branch = tree.branch(node);
    let place_at = |visit: usize| match tree.arrival(branch[visit]) {
        Some(arrival) => place_of(arrival),
        None => Some(PlaceId::new(0)),
    };
    let observation = experience.observations[visit - 1];
    step.derivations.retain(|&derivation| {
        let place = place_of(hypothesis.arrival(observation, derivation));
        experience.constraints.allow(visit, |earlier| place.is_some() && place_at(earlier) == place)
    });
    if step.outcome == Outcome::Predicted && step.derivations.is_empty() {
        step.outcome = Outcome::Refuted;
    }
}
