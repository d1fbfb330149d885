//! Preference at work: the lexicographic order of section 2.3.2, with a bound that no map below a hypothesis beats.
//!
//! Along one branch neither the genus, nor the number of places, nor that of closed ends ever falls
//! (see `Measure::bound`), so that every map below a node ranks no better than the node's bound.

use hssh_metrics::SolveError;
use hssh_topology::{Axioms, Measure, Preference, Rank, Step, TopologicalMap};

use crate::context::Context;
use crate::cursor::Cursor;
use crate::leaf::{Appraise, Grown, Growth, Leaf};
use crate::limits::StopReason;
use crate::order::Order;
use crate::pack::Pack;
use crate::report::Score;
use crate::step::{Look, successors};
use crate::tree::{NodeId, Tree};
use crate::visit::MeasurementError;

/// Appraises by preference.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ByPreference {
    pub(crate) preference: Preference,
    /// The thesis's best-first goes by what maps measure, all others by what they can come to.
    pub(crate) order: Order,
}

impl ByPreference {
    /// The key of a hypothesis with that map, and so many travels left to explain.
    fn key(self, map: &TopologicalMap, travels_left: usize) -> Rank {
        let is_bound = self.order != Order::BestFirst && travels_left > 0;
        let measure = if is_bound { Measure::bound(map, travels_left as u32) } else { Measure::of(map) };
        self.preference.rank(measure)
    }

    fn leaf(self, map: &TopologicalMap, node: NodeId, depth: usize, context: Context<'_>) -> Leaf<Self> {
        let key = self.key(map, context.travels() - depth);
        Leaf::new(key, node, depth, map.pending_count(), map.closed_end_count())
    }
}

impl Appraise for ByPreference {
    type Key = Rank;
    /// Closed ends.
    type Load = u32;

    const WEIGHS: bool = false;

    fn observe(&mut self, _: Context<'_>, _: &Tree) -> Result<Option<StopReason>, MeasurementError> {
        Ok(None)
    }

    fn renew(
        &self,
        leaf: &mut Leaf<Self>,
        before: usize,
        cursor: &mut Cursor,
        tree: &Tree,
        context: Context<'_>,
    ) {
        if self.order == Order::BestFirst {
            return;
        }
        let left = context.travels() - leaf.depth();
        if leaf.depth() == before {
            let map = &cursor.go_to(leaf.node, tree, context.experience).map;
            leaf.key = self.key(map, left);
        } else {
            // Of the bound only the number of paths looks ahead.
            let bound = self.preference.measure(leaf.key);
            let paths = Measure::least_paths(leaf.load, leaf.pending, left as u32);
            leaf.key = self.preference.rank(Measure { paths, ..bound });
        }
    }

    fn root(&self, context: Context<'_>) -> Leaf<Self> {
        self.leaf(&context.experience.root().map, NodeId::ROOT, 0, context)
    }

    fn grow(
        &self,
        leaf: &Leaf<Self>,
        cursor: &mut Cursor,
        tree: &Tree,
        context: Context<'_>,
    ) -> Growth<Self> {
        let (mut grown, mut step) = (Vec::new(), Step::default());
        let outcome =
            successors(cursor, leaf.node, tree, context, &mut step, Look::Inside, |child, hypothesis| {
                grown.push((child, self.leaf(&hypothesis.map, child.parent, leaf.depth() + 1, context)));
            });
        Ok(Grown { outcome, removals: step.removals, successors: grown, rest: None })
    }

    fn is_settled(&self, _: &Leaf<Self>) -> bool {
        true
    }

    fn settle(
        &self,
        _: &mut Leaf<Self>,
        _: &mut Cursor,
        _: &Tree,
        _: Context<'_>,
    ) -> Result<Option<f64>, SolveError> {
        Ok(None)
    }

    fn bound(&self, leaf: &Leaf<Self>) -> Option<Rank> {
        (self.order != Order::BestFirst).then_some(leaf.key)
    }

    fn reach(&self, key: Rank, _: f64) -> Rank {
        key
    }

    fn nats(&self, _: Rank) -> f64 {
        0.0
    }

    fn log_mass(&self, _: &Leaf<Self>) -> f64 {
        0.0
    }

    fn turns_down_early(&self) -> bool {
        self.order != Order::BestFirst
    }

    fn score(&self, key: Rank) -> Score {
        Score::Measure(self.preference.measure(key))
    }

    fn bytes(&self, _: &Leaf<Self>) -> u64 {
        size_of::<Leaf<Self>>() as u64
    }
}

impl Pack for ByPreference {
    type Shared<'a> = ();
    type Read = ();
    type Packed = u32;

    fn share<'a>(_: impl Iterator<Item = &'a u32>) {}

    fn pack(closed_ends: &u32, (): &()) -> u32 {
        *closed_ends
    }

    fn unpack(closed_ends: u32, (): &(), _: &Axioms) -> Option<u32> {
        Some(closed_ends)
    }
}
