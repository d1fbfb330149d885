//! A tree cut into branches, each counted by itself, as far as they were counted.

use std::collections::VecDeque;
use std::io;

use hssh_topology::Preference;
use serde::{Deserialize, Serialize};

use super::counts::{Counting, Counts};
use crate::checkpoint::{CheckpointError, Pen, Unsealed};
use crate::context::Context;
use crate::cursor::Cursor;
use crate::depth_first::walk_on;
use crate::fringe::Fringe;
use crate::limits::{StopReason, Watch};
use crate::report::LevelCounts;
use crate::tally::Tally;
use crate::tree::{NodeId, Tree};

/// The tree is cut below the first level with that many nodes.
const BRANCHES: usize = 2048;

/// How many branches are counted between two looks at a limit on nodes: beyond it they would be counted in vain.
const BRANCHES_UNDER_LIMIT: usize = 64;

/// The first levels of a tree, down to where it is cut.
#[derive(Debug)]
pub(super) struct Top {
    pub(super) tree: Tree,
    cut: Fringe,
}

/// A branch of a tree, as far as it was counted. Whoever knows the exploration and the axioms can count on.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct CountedBranch {
    /// Where it begins, in the top.
    pub(super) root: NodeId,
    counts: Counts,
    /// Where counting was broken off; nothing if it came to its end.
    broken_at: Option<Vec<u32>>,
}

/// A count under way.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct Progress {
    /// Of the top, and of the first branches.
    pub(super) total: Counts,
    /// All others, in order.
    rest: VecDeque<CountedBranch>,
}

impl Top {
    /// Grows the first levels, and counts them; if a limit ends it, only what was counted of complete levels, and the reason.
    pub(super) fn grow(context: Context<'_>) -> Result<(Self, Progress), Box<(Counts, StopReason)>> {
        let (mut tree, mut cut, mut tally) = (Tree::new(), Fringe::default(), Tally::new());
        let mut stop = None;
        while stop.is_none() && cut.depth < context.travels() && cut.nodes.len() < BRANCHES {
            stop = cut.grow(&mut tree, context, &mut tally).err();
        }
        let Tally { mut levels, removals, expanded: steps } = tally;
        levels.resize(context.travels() + 1, LevelCounts::default());
        let total = Counts { levels, removals, steps, ..Counts::default() };
        if let Some(reason) = stop {
            return Err(Box::new((total, reason)));
        }
        let whole = |root| CountedBranch { root, counts: Counts::default(), broken_at: Some(Vec::new()) };
        let rest = cut.nodes.clone().map(NodeId::new).map(whole).collect();
        Ok((Top { tree, cut }, Progress { total, rest }))
    }
}

impl CountedBranch {
    /// Whether it can be a branch of a tree with that top, of so many travels.
    pub(super) fn is_of(&self, top: &Top, travels: usize) -> bool {
        let path = self.broken_at.as_deref().unwrap_or_default();
        top.cut.nodes.contains(&(self.root.index() as u32))
            && path.len() + top.cut.depth <= travels
            && path.iter().all(|&entered| entered > 0)
    }

    /// Counts on from where it was broken off, until it ends or something breaks it off again; then why.
    pub(super) fn count_on(
        &self,
        cursor: &mut Cursor,
        top: &Top,
        preference: Preference,
        context: Context<'_>,
    ) -> (CountedBranch, Option<StopReason>) {
        let Context { experience, axioms, watch, .. } = context;
        if let Some(reason) = watch.interruption() {
            return (self.clone(), Some(reason));
        }
        let from = self.broken_at.as_deref().unwrap_or_default();
        let mut counting = Counting::new(self.counts.clone(), preference, watch);
        let hypothesis = cursor.go_to(self.root, &top.tree, experience);
        let walk = walk_on(hypothesis, top.cut.depth, from, experience, axioms, &mut counting);
        counting.tell();
        let Counting { mut counts, stop, .. } = counting;
        counts.removals += walk.removals;
        (CountedBranch { root: self.root, counts, broken_at: walk.broken_at }, stop)
    }
}

impl Progress {
    /// Counts on until everything is counted, or a limit ends it.
    pub(super) fn advance(&mut self, top: &Top, preference: Preference, context: Context<'_>) -> StopReason {
        loop {
            if let Some(reason) = self.take_first(preference, context.watch) {
                return reason;
            }
            if self.rest.is_empty() {
                return StopReason::Exhausted;
            }
            let at_once = if context.watch.limits_nodes() { BRANCHES_UNDER_LIMIT } else { self.rest.len() };
            let broken = self.rest.iter_mut().take(at_once).filter(|branch| branch.broken_at.is_some());
            let mut together: Vec<&mut CountedBranch> = broken.collect();
            let counted = {
                let pieces: Vec<&CountedBranch> = together.iter().map(|branch| &**branch).collect();
                context.crew.map(&pieces, context.experience, |cursor, branch| {
                    branch.count_on(cursor, top, preference, context)
                })
            };
            let mut stop = None;
            for (branch, (counted, reason)) in together.iter_mut().zip(counted) {
                **branch = counted;
                stop = stop.or(reason);
            }
            if let Some(reason) = self.take_first(preference, context.watch).or(stop) {
                return reason;
            }
        }
    }

    /// The first branch that is not counted to its end, of those that `is_free`.
    pub(super) fn next(&self, is_free: impl Fn(NodeId) -> bool) -> Option<&CountedBranch> {
        self.rest.iter().find(|branch| branch.broken_at.is_some() && is_free(branch.root))
    }

    /// Puts a branch that was counted on into its place; whether there is one.
    pub(super) fn put(&mut self, branch: CountedBranch) -> bool {
        let place = self.rest.binary_search_by_key(&branch.root, |other| other.root);
        if let Ok(place) = place {
            self.rest[place] = branch;
        }
        place.is_ok()
    }

    /// Whether everything was counted.
    pub(super) fn is_complete(&self) -> bool {
        self.rest.is_empty()
    }

    /// Takes over what was counted of the first branches, as far as they were counted to their end and limits allow.
    pub(super) fn take_first(&mut self, preference: Preference, watch: &Watch) -> Option<StopReason> {
        while let Some(branch) = self.rest.front().filter(|branch| branch.broken_at.is_none()) {
            let nodes = self.total.nodes() + branch.counts.nodes();
            if let Some(reason) = watch.excess(nodes, 0) {
                return Some(reason);
            }
            self.total.merge(&branch.counts, preference);
            self.rest.pop_front();
        }
        None
    }

    /// How many nodes were counted, those of branches that are not at their end among them.
    pub(super) fn nodes(&self) -> u64 {
        self.total.nodes() + self.rest.iter().map(|branch| branch.counts.nodes()).sum::<u64>()
    }

    /// Writes it down.
    pub(super) fn write(&self, pen: &mut Pen<'_>) -> io::Result<()> {
        pen.put(self)
    }

    /// Reads one of a count with that top.
    ///
    /// # Errors
    /// If it is none.
    pub(super) fn read(
        unsealed: &mut Unsealed<'_>,
        top: &Top,
        travels: usize,
    ) -> Result<Self, CheckpointError> {
        let progress: Progress = unsealed.take()?;
        let is_sound = progress.total.levels.len() == travels + 1
            && progress.rest.iter().all(|branch| branch.is_of(top, travels));
        if is_sound { Ok(progress) } else { Err(CheckpointError::Damaged) }
    }
}
