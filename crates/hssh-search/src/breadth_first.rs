//! Breadth-first: the complete fringe after every observation, as in the thesis (section 2.3.1).

use std::ops::Range;

use hssh_topology::{Preference, Removals};

use crate::context::Context;
use crate::crew::{Crew, Look, Scratch, expand};
use crate::experience::Experience;
use crate::limits::StopReason;
use crate::mapper::RankedMap;
use crate::report::{FinalCounts, LevelCounts, Tally};
use crate::tree::{Child, NodeId, Outcome, Tree};

/// Nodes that one thread takes at a time.
const PIECE: u32 = 512;

/// Pieces between two looks at the limits.
const PIECES_AT_ONCE: usize = 256;

/// The deepest complete level of the tree.
#[derive(Clone, Debug)]
pub(crate) struct BreadthFirst {
    pub(crate) fringe: Range<u32>,
    /// How many travels the fringe explains.
    pub(crate) depth: usize,
}

/// The successors of one piece of the fringe.
struct Grown {
    children: Vec<Child>,
    outcomes: Vec<Outcome>,
    removals: Removals,
}

impl Default for BreadthFirst {
    fn default() -> Self {
        BreadthFirst { fringe: 0..1, depth: 0 }
    }
}

impl BreadthFirst {
    /// Grows the tree by one level. A limit leaves the tree as it was.
    pub(crate) fn grow(
        &mut self,
        tree: &mut Tree,
        context: Context<'_>,
        tally: &mut Tally,
    ) -> Result<(), StopReason> {
        let (nodes, maps) = (tree.len(), tree.map_count());
        let mut removed = Removals::default();
        let mut refuted = 0;
        let pieces = pieces(&self.fringe);
        let mut stop = None;
        for together in pieces.chunks(PIECES_AT_ONCE) {
            stop = stop.or_else(|| context.watch.interruption());
            if stop.is_some() {
                break;
            }
            let before: &Tree = tree;
            let grown = context.crew.map(together, context.experience, |cursor, piece| {
                let (mut children, mut scratch) = (Vec::new(), Scratch::default());
                let mut grow = |node| {
                    let keep = |child, _: &_| children.push(child);
                    expand(cursor, node, before, context, &mut scratch, Look::Outside, keep)
                };
                let outcomes = piece.clone().map(|node| grow(NodeId(node))).collect();
                Grown { children, outcomes, removals: scratch.removals }
            });
            for (piece, grown) in together.iter().zip(grown) {
                for (node, outcome) in piece.clone().zip(grown.outcomes) {
                    tree.set_outcome(NodeId(node), outcome);
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
            for node in self.fringe.clone() {
                tree.set_outcome(NodeId(node), Outcome::Open);
            }
            tree.truncate(nodes, maps);
            context.crew.recall();
            return Err(reason);
        }
        tally.removals += removed;
        tally.expanded += self.fringe.len() as u64;
        if let Some(level) = tally.levels.last_mut() {
            level.refuted = refuted;
        }
        let made = ((tree.len() - nodes) as u64, (tree.map_count() - maps) as u64);
        tally.levels.push(LevelCounts { nodes: made.0, maps: made.1, refuted: 0 });
        self.fringe = nodes as u32..tree.len() as u32;
        self.depth += 1;
        context.watch.explained(self.depth);
        Ok(())
    }

    /// Counts over the maps of the fringe, and the best of them in order of preference.
    pub(crate) fn survey(
        &self,
        tree: &Tree,
        experience: &Experience,
        crew: &Crew,
        preference: Preference,
        keep: usize,
    ) -> (FinalCounts, Vec<RankedMap>) {
        let surveyed = crew.map(&pieces(&self.fringe), experience, |cursor, piece| {
            let mut counts = FinalCounts::default();
            let mut best: Vec<RankedMap> = Vec::new();
            for node in piece.clone().map(NodeId) {
                let map = &cursor.go_to(node, tree, experience).map;
                counts.record(map, preference);
                if keep > 0 {
                    best.push(RankedMap::of(node, map));
                }
            }
            best.sort_by_key(|map| (preference.rank(map.measure), map.node));
            best.truncate(keep);
            (counts, best)
        });
        let mut counts = FinalCounts::default();
        let mut best = Vec::new();
        for (of_piece, best_of_piece) in surveyed {
            counts.merge(&of_piece, preference);
            best.extend(best_of_piece);
        }
        best.sort_by_key(|map| (preference.rank(map.measure), map.node));
        best.truncate(keep);
        (counts, best)
    }
}

fn pieces(fringe: &Range<u32>) -> Vec<Range<u32>> {
    let starts = fringe.clone().step_by(PIECE as usize);
    starts.map(|start| start..fringe.end.min(start.saturating_add(PIECE))).collect()
}
