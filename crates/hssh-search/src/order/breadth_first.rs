//! Breadth-first: the complete fringe after every observation, as in the thesis (section 2.3.1).

use std::ops::Range;

use hssh_metrics::SolveError;
use hssh_topology::{Measure, Outcome, Preference, Removals, Step};

use crate::context::Context;
use crate::engine::Engine;
use crate::leaf::{Appraise, Grown, Leaf};
use crate::limits::StopReason;
use crate::report::{FinalCounts, LevelCounts, RankedMap, Tally};
use crate::step::{Look, successors};
use crate::tree::{Child, NodeId, Tree};

/// Nodes that one thread takes at a time.
const PIECE: u32 = 512;

/// Pieces between two looks at the limits.
const PIECES_AT_ONCE: usize = 256;

/// The deepest complete level of a tree.
#[derive(Clone, Debug)]
pub(crate) struct Fringe {
    pub(crate) nodes: Range<u32>,
    /// How many travels it explains.
    pub(crate) depth: usize,
}

impl Default for Fringe {
    fn default() -> Self {
        Fringe { nodes: 0..1, depth: 0 }
    }
}

/// The successors of one piece of the fringe.
struct Piece {
    children: Vec<Child>,
    outcomes: Vec<Outcome>,
    removals: Removals,
}

impl Fringe {
    /// Grows a tree by one level. A limit leaves the tree as it was.
    pub(crate) fn grow(
        &mut self,
        tree: &mut Tree,
        context: Context<'_>,
        tally: &mut Tally,
    ) -> Result<(), StopReason> {
        let (nodes, maps) = (tree.len(), tree.map_count());
        let mut removed = Removals::default();
        let mut refuted = 0;
        let pieces = self.pieces();
        let mut stop = None;
        for together in pieces.chunks(PIECES_AT_ONCE) {
            stop = stop.or_else(|| context.watch.interruption());
            if stop.is_some() {
                break;
            }
            let before: &Tree = tree;
            let grown = context.crew.map(together, context.experience, |cursor, piece| {
                let (mut children, mut step) = (Vec::new(), Step::default());
                let mut grow = |node| {
                    let keep = |child, _: &_| children.push(child);
                    successors(cursor, node, before, context, &mut step, Look::Outside, keep)
                };
                let outcomes = piece.clone().map(|node| grow(NodeId::new(node))).collect();
                Piece { children, outcomes, removals: step.removals }
            });
            for (piece, grown) in together.iter().zip(grown) {
                for (node, outcome) in piece.clone().zip(grown.outcomes) {
                    tree.set_outcome(NodeId::new(node), outcome);
                    refuted += u64::from(outcome == Outcome::Refuted);
                }
                context.watch.add_nodes(grown.children.len() as u64);
                for child in grown.children {
                    tree.push(child);
                }
                removed += grown.removals;
            }
            stop = context.watch.excess(tree.len() as u64, tree.bytes());
        }
        if let Some(reason) = stop {
            self.give_up(tree, nodes, maps);
            context.crew.recall();
            return Err(reason);
        }
        tally.removals += removed;
        tally.expanded += self.nodes.len() as u64;
        if let Some(level) = tally.levels.last_mut() {
            level.refuted = refuted;
        }
        let made = ((tree.len() - nodes) as u64, (tree.map_count() - maps) as u64);
        tally.levels.push(LevelCounts { nodes: made.0, maps: made.1, refuted: 0 });
        self.advance(tree, nodes, context);
        Ok(())
    }

    /// The level that begins with that node is complete.
    fn advance(&mut self, tree: &Tree, nodes: usize, context: Context<'_>) {
        self.nodes = nodes as u32..tree.len() as u32;
        self.depth += 1;
        context.watch.explained(self.depth);
    }

    /// Forgets a level that was begun.
    fn give_up(&self, tree: &mut Tree, nodes: usize, maps: usize) {
        for node in self.nodes.clone() {
            tree.set_outcome(NodeId::new(node), Outcome::Open);
        }
        tree.truncate(nodes, maps);
    }

    /// Counts over the maps of the fringe, and the best of them in order of preference.
    pub(crate) fn survey(
        &self,
        tree: &Tree,
        context: Context<'_>,
        preference: Preference,
        keep: usize,
    ) -> (FinalCounts, Vec<RankedMap>) {
        let surveyed = context.crew.map(&self.pieces(), context.experience, |cursor, piece| {
            let mut counts = FinalCounts::default();
            let mut best = Vec::new();
            for node in piece.clone().map(NodeId::new) {
                let map = &cursor.go_to(node, tree, context.experience).map;
                counts.record(map, preference);
                if keep > 0 {
                    best.push((preference.rank(Measure::of(map)), node));
                }
            }
            best.sort_unstable();
            best.truncate(keep);
            best.shrink_to_fit();
            (counts, best)
        });
        let mut counts = FinalCounts::default();
        let mut best = Vec::new();
        for (of_piece, best_of_piece) in surveyed {
            counts.merge(&of_piece, preference);
            best.extend(best_of_piece);
        }
        // In a fringe the order of creation is that of branches.
        best.sort_unstable();
        best.truncate(keep);
        let ranked = context.crew.map(&best, context.experience, |cursor, &(_, node)| {
            RankedMap::of(node, &cursor.go_to(node, tree, context.experience).map)
        });
        (counts, ranked)
    }

    fn pieces(&self) -> Vec<Range<u32>> {
        let starts = self.nodes.clone().step_by(PIECE as usize);
        starts.map(|start| start..self.nodes.end.min(start.saturating_add(PIECE))).collect()
    }
}

impl<A: Appraise> Engine<A> {
    /// Grows the tree level by level to the last travel.
    pub(crate) fn breadth_first(&mut self, context: Context<'_>) -> StopReason {
        while self.fringe.depth < context.travels() {
            let grown = if A::WEIGHS {
                self.grow_appraised(context)
            } else {
                self.fringe.grow(&mut self.tree, context, &mut self.tally)
            };
            tracing::debug!(explained = self.fringe.depth, fringe = self.fringe.nodes.len(), "level");
            if let Err(reason) = grown {
                return reason;
            }
        }
        if A::WEIGHS {
            self.find_fringe(context);
        }
        StopReason::Exhausted
    }

    /// Grows the tree by one level whose hypotheses are all appraised. A limit leaves the tree as it was.
    fn grow_appraised(&mut self, context: Context<'_>) -> Result<(), StopReason> {
        let (nodes, maps) = (self.tree.len(), self.tree.map_count());
        let depth = self.fringe.depth;
        let tally = self.tally.clone();
        let mut leaves: Vec<Leaf<A>> = std::iter::from_fn(|| self.frontier.levels[depth].pop()).collect();
        leaves.sort_unstable_by_key(|leaf| leaf.node);
        let mut stop = None;
        let mut level = Vec::new();
        for together in leaves.chunks(PIECES_AT_ONCE) {
            stop = stop.or_else(|| self.stop(context));
            if stop.is_some() {
                break;
            }
            let (appraiser, tree) = (&self.appraiser, &self.tree);
            type Result<A> = std::result::Result<(Grown<A>, bool), SolveError>;
            let grown = context.crew.map(together, context.experience, |cursor, leaf| -> Result<A> {
                let mut leaf = leaf.clone();
                let is_open = !appraiser.is_settled(&leaf);
                appraiser.settle(&mut leaf, cursor, tree, context)?;
                Ok((appraiser.grow(&leaf, cursor, tree, context)?, is_open))
            });
            for (leaf, grown) in together.iter().zip(grown) {
                self.solved += u64::from(grown.as_ref().is_ok_and(|(_, is_open)| *is_open));
                level.extend(self.plant(leaf, grown.map(|(grown, _)| grown), context));
            }
        }
        if let Some(reason) = stop {
            self.fringe.give_up(&mut self.tree, nodes, maps);
            self.tally = tally;
            context.crew.recall();
            leaves.into_iter().for_each(|leaf| self.frontier.push(leaf));
            return Err(reason);
        }
        self.bytes -= leaves.iter().map(|leaf| self.appraiser.bytes(leaf)).sum::<u64>();
        level.into_iter().for_each(|leaf| self.push(leaf));
        self.tally.make_level(depth + 1);
        self.fringe.advance(&self.tree, nodes, context);
        Ok(())
    }

    /// All hypotheses of the complete fringe are maps that were found.
    fn find_fringe(&mut self, context: Context<'_>) {
        let mut cursor = self.lend_cursor(context);
        while let Some(mut leaf) = self.frontier.levels[context.travels()].pop() {
            self.bytes -= self.appraiser.bytes(&leaf);
            if self.appraiser.is_settled(&leaf) || self.settle(&mut leaf, &mut cursor, context) {
                self.arrive(leaf);
            }
        }
        self.cursors.push(cursor);
    }
}
