//! The tree depth-first, by growing one map and taking it back: memory does not grow with the nodes.

use std::ops::ControlFlow;

use hssh_topology::{Axioms, Derivation, Footprint, Hypothesis, Observation, Outcome, Removals, Rules, Step};

use crate::experience::Experience;

/// What is done at the nodes of a [`depth_first`] walk. Every method does nothing unless overridden.
pub trait Visitor {
    /// A node that explains the first `depth` travels; `new_map` unless it shares its parent's map.
    /// To break ends the walk: no further node is visited.
    fn node(&mut self, depth: usize, new_map: bool) -> ControlFlow<()> {
        let _ = (depth, new_map);
        ControlFlow::Continue(())
    }

    /// The recursive step is about to be applied to a node.
    fn step(&mut self, hypothesis: &Hypothesis, observation: Observation) {
        let _ = (hypothesis, observation);
    }

    /// The observation after `depth` travels refutes the node (p-nc).
    fn refuted(&mut self, depth: usize) {
        let _ = depth;
    }

    /// The node explains all travels.
    fn last(&mut self, hypothesis: &Hypothesis) {
        let _ = hypothesis;
    }
}

/// A node that the walk is below of.
struct Frame {
    /// In which ways the travel after the node follows from it. The walk goes into each in turn.
    step: Step,
    /// How many of them it went into.
    next: usize,
    /// How to come back from the last one.
    footprint: Option<Footprint>,
}

/// Visits every node from `hypothesis` down, which explains the first `depth` travels, in the order
/// of creation of a breadth-first search cut down to one branch. The hypothesis is left as it was. The
/// number of successors that each axiom removed.
pub fn depth_first(
    hypothesis: &mut Hypothesis,
    depth: usize,
    experience: &Experience,
    axioms: &Axioms,
    visitor: &mut impl Visitor,
) -> Removals {
    walk_on(hypothesis, depth, &[], experience, axioms, visitor).removals
}

/// What came of a walk.
pub(crate) struct Walk {
    /// How many successors each axiom removed.
    pub(crate) removals: Removals,
    /// Where the visitor broke it: by level, into how many successors it went. Nothing if it came to its end.
    pub(crate) broken_at: Option<Vec<u32>>,
}

/// The same from where another walk was broken, whose last node was visited but not gone on from; nothing from there up is visited or
/// counted once more. A walk from the beginning was broken at the first node.
pub(crate) fn walk_on(
    hypothesis: &mut Hypothesis,
    depth: usize,
    broken_at: &[u32],
    experience: &Experience,
    axioms: &Axioms,
    visitor: &mut impl Visitor,
) -> Walk {
    let Experience { catalog, observations, .. } = experience;
    let rules = Rules { catalog, axioms };
    let levels = observations.len().saturating_sub(depth);
    let mut frames: Vec<Frame> = Vec::new();
    frames.resize_with(levels, || Frame { step: Step::default(), next: 0, footprint: None });
    for (level, (frame, &next)) in frames.iter_mut().zip(broken_at).enumerate() {
        let observation = observations[depth + level];
        hypothesis.step(observation, rules, &mut frame.step);
        frame.step.removals = Removals::default();
        frame.next = next as usize;
        let entered = frame.step.derivations[frame.next - 1];
        frame.footprint = Some(hypothesis.follow(observation, entered, catalog));
    }
    // The walk is below the first `level` frames.
    let (mut level, mut is_new, mut broken) = (broken_at.len(), true, None);
    loop {
        if let Some(frame) = frames.get_mut(level) {
            let observation = observations[depth + level];
            if std::mem::take(&mut is_new) {
                visitor.step(hypothesis, observation);
                hypothesis.step(observation, rules, &mut frame.step);
                frame.next = 0;
                if frame.step.outcome == Outcome::Refuted {
                    visitor.refuted(depth + level);
                }
            }
            if let Some(&derivation) = frame.step.derivations.get(frame.next).filter(|_| broken.is_none()) {
                frame.next += 1;
                frame.footprint = Some(hypothesis.follow(observation, derivation, catalog));
                level += 1;
                is_new = visitor.node(depth + level, derivation != Derivation::Predicted).is_continue();
                if !is_new {
                    broken = Some(frames[..level].iter().map(|frame| frame.next as u32).collect());
                }
                continue;
            }
        } else if std::mem::take(&mut is_new) {
            visitor.last(hypothesis);
        }
        // Nothing is left to do here: back up.
        let Some(above) = level.checked_sub(1) else { break };
        level = above;
        if let Some(footprint) = frames[level].footprint.take() {
            hypothesis.take_back(footprint);
        }
    }
    let mut removals = Removals::default();
    frames.iter().for_each(|frame| removals += frame.step.removals);
    Walk { removals, broken_at: broken }
}
