//! The deepest complete level of a tree, grown all at once (section 2.3.1).

use std::ops::Range;
use std::time::{Duration, Instant};

use hssh_topology::{Measure, Outcome, Preference, Removals};
use serde::{Deserialize, Serialize};

use crate::context::Context;
use crate::limits::StopReason;
use crate::report::{FinalCounts, LevelCounts, RankedMap};
use crate::steps::step_all;
use crate::tally::Tally;
use crate::tree::{NodeId, Tree};

/// Nodes that one thread takes at a time.
const PIECE: u32 = 512;

/// Pieces between two looks at the limits.
const PIECES_AT_ONCE: usize = 64;

/// How long, and how many pieces at a time, are looked at to say how long a level takes.
const SAMPLING: Duration = Duration::from_millis(30);
const PIECES_A_SAMPLE: usize = 8;

/// The deepest complete level of a tree.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Fringe {
    pub(crate) nodes: Range<u32>,
    /// How many travels it explains.
    pub(crate) depth: usize,
    /// The level after it, if a limit came before that was complete.
    begun: Option<Begun>,
}

/// A level that is not complete.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct Begun {
    /// How many nodes and maps there were before it.
    nodes: usize,
    maps: usize,
    /// The first node of the fringe that has not had its turn.
    next: u32,
    refuted: u64,
    removals: Removals,
}

impl Default for Fringe {
    fn default() -> Self {
        Fringe::new(0..1, 0)
    }
}

impl Fringe {
    /// Those nodes, which explain so many travels.
    pub(crate) fn new(nodes: Range<u32>, depth: usize) -> Self {
        Fringe { nodes, depth, begun: None }
    }

    /// Grows a tree by one level. A limit leaves the level incomplete: the next call goes on with it, unless it is
    /// [given up](Self::give_up).
    pub(crate) fn grow(
        &mut self,
        tree: &mut Tree,
        context: Context<'_>,
        tally: &mut Tally,
    ) -> Result<(), StopReason> {
        let next = self.nodes.start;
        let mut begun = self.begun.take().unwrap_or_else(|| Begun {
            nodes: tree.len(),
            maps: tree.map_count(),
            next,
            refuted: 0,
            removals: Removals::default(),
        });
        while begun.next < self.nodes.end {
            let stop = context.watch.interruption();
            if let Some(reason) = stop.or_else(|| context.watch.excess(tree.len() as u64, tree.bytes())) {
                self.begun = Some(begun);
                return Err(reason);
            }
            let together = pieces(begun.next..self.nodes.end, PIECES_AT_ONCE);
            for stepped in step_all(&together, tree, context) {
                for outcome in stepped.outcomes {
                    tree.set_outcome(NodeId::new(begun.next), outcome);
                    begun.refuted += u64::from(outcome == Outcome::Refuted);
                    begun.next += 1;
                }
                context.watch.add_nodes(stepped.children.len() as u64);
                for child in stepped.children {
                    tree.push(child);
                }
                begun.removals += stepped.removals;
            }
        }
        if let Some(reason) = context.watch.excess(tree.len() as u64, tree.bytes()) {
            self.begun = Some(begun);
            return Err(reason);
        }
        tally.removals += begun.removals;
        tally.expanded += self.nodes.len() as u64;
        if let Some(level) = tally.levels.last_mut() {
            level.refuted = begun.refuted;
        }
        let made = ((tree.len() - begun.nodes) as u64, (tree.map_count() - begun.maps) as u64);
        tally.levels.push(LevelCounts { nodes: made.0, maps: made.1, refuted: 0 });
        self.advance(tree, begun.nodes, context);
        Ok(())
    }

    /// Forgets the level that was begun, if there is one.
    pub(crate) fn give_up(&mut self, tree: &mut Tree, context: Context<'_>) {
        if let Some(Begun { nodes, maps, .. }) = self.begun.take() {
            self.forget(tree, nodes, maps, context);
        }
    }

    /// The level that begins with that node is complete.
    pub(crate) fn advance(&mut self, tree: &Tree, nodes: usize, context: Context<'_>) {
        self.nodes = nodes as u32..tree.len() as u32;
        self.depth += 1;
        context.watch.explained(self.depth);
    }

    /// Forgets a level before which there were so many nodes and maps.
    pub(crate) fn forget(&self, tree: &mut Tree, nodes: usize, maps: usize, context: Context<'_>) {
        for node in self.nodes.clone() {
            tree.set_outcome(NodeId::new(node), Outcome::Open);
        }
        tree.truncate(nodes, maps);
        context.crew.recall();
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

    /// The deepest complete level that can be looked through in that time: this one, if it is small enough.
    pub(crate) fn showable(
        &self,
        tree: &Tree,
        context: Context<'_>,
        levels: &[LevelCounts],
        within: Duration,
    ) -> Fringe {
        let per_node = self.seconds_per_node(tree, context);
        let ends = levels.iter().scan(0, |end, level| {
            *end += level.nodes as u32;
            Some((*end - level.nodes as u32)..*end)
        });
        let complete = ends.take(self.depth + 1).enumerate();
        let is_small =
            |(_, nodes): &(usize, Range<u32>)| nodes.len() as f64 * per_node <= within.as_secs_f64();
        let deepest = complete.filter(is_small).last();
        deepest.map_or_else(Fringe::default, |(depth, nodes)| Fringe::new(nodes, depth))
    }

    /// How long it takes to look at a map of this level, by a sample.
    fn seconds_per_node(&self, tree: &Tree, context: Context<'_>) -> f64 {
        let started = Instant::now();
        let mut looked_at = 0;
        for together in self.pieces().chunks(PIECES_A_SAMPLE) {
            let (first, last) = (together[0].start, together[together.len() - 1].end);
            let sample = Fringe::new(first..last, self.depth);
            sample.survey(tree, context, Preference::default(), 1);
            looked_at += sample.nodes.len();
            if started.elapsed() > SAMPLING {
                break;
            }
        }
        started.elapsed().as_secs_f64() / looked_at.max(1) as f64
    }

    fn pieces(&self) -> Vec<Range<u32>> {
        pieces(self.nodes.clone(), usize::MAX)
    }
}

/// Nodes cut into pieces, at most so many.
fn pieces(nodes: Range<u32>, most: usize) -> Vec<Range<u32>> {
    let starts = nodes.clone().step_by(PIECE as usize).take(most);
    starts.map(|start| start..nodes.end.min(start.saturating_add(PIECE))).collect()
}
