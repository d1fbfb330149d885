//! What is counted of a part of the tree, and who counts it.

use std::ops::ControlFlow;

use hssh_topology::{Hypothesis, Observation, Preference, Removals};
use serde::{Deserialize, Serialize};

use crate::depth_first::Visitor;
use crate::limits::{StopReason, Watch};
use crate::report::{FinalCounts, LevelCounts};

/// Nodes between two looks at the limits.
const LOOK: u64 = 1 << 14;

/// What is counted of a part of the tree.
#[derive(Clone, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
pub(super) struct Counts {
    /// By number of travels explained.
    pub(super) levels: Vec<LevelCounts>,
    pub(super) finals: FinalCounts,
    pub(super) removals: Removals,
    /// Nodes that the recursive step was applied to.
    pub(super) steps: u64,
}

impl Counts {
    pub(super) fn nodes(&self) -> u64 {
        self.levels.iter().map(|level| level.nodes).sum()
    }

    /// Adds what was counted of another part.
    pub(super) fn merge(&mut self, other: &Counts, preference: Preference) {
        let levels = self.levels.len().max(other.levels.len());
        self.levels.resize(levels, LevelCounts::default());
        for (level, counted) in self.levels.iter_mut().zip(&other.levels) {
            *level += *counted;
        }
        self.finals.merge(&other.finals, preference);
        self.removals += other.removals;
        self.steps += other.steps;
    }

    fn level(&mut self, depth: usize) -> &mut LevelCounts {
        if depth >= self.levels.len() {
            self.levels.resize(depth + 1, LevelCounts::default());
        }
        &mut self.levels[depth]
    }
}

/// Counts what a walk comes by, until a limit breaks it.
pub(super) struct Counting<'a> {
    pub(super) counts: Counts,
    pub(super) stop: Option<StopReason>,
    preference: Preference,
    watch: &'a Watch,
    until_look: u64,
}

impl<'a> Counting<'a> {
    /// Goes on from what was counted.
    pub(super) fn new(counts: Counts, preference: Preference, watch: &'a Watch) -> Self {
        Counting { counts, stop: None, preference, watch, until_look: LOOK }
    }

    /// Tells the monitor of the nodes that it was not told of yet.
    pub(super) fn tell(&self) {
        self.watch.add_nodes(LOOK - self.until_look);
    }
}

impl Visitor for Counting<'_> {
    fn node(&mut self, depth: usize, new_map: bool) -> ControlFlow<()> {
        let level = self.counts.level(depth);
        level.nodes += 1;
        level.maps += u64::from(new_map);
        self.until_look -= 1;
        if self.until_look == 0 {
            self.until_look = LOOK;
            self.watch.add_nodes(LOOK);
            self.stop = self.watch.interruption().or_else(|| self.watch.excess(self.counts.nodes(), 0));
            if self.stop.is_some() {
                return ControlFlow::Break(());
            }
        }
        ControlFlow::Continue(())
    }

    fn step(&mut self, _: &Hypothesis, _: Observation) {
        self.counts.steps += 1;
    }

    fn refuted(&mut self, depth: usize) {
        self.counts.level(depth).refuted += 1;
    }

    fn last(&mut self, hypothesis: &Hypothesis) {
        self.counts.finals.record(&hypothesis.map, self.preference);
    }
}
