//! The queue of open hypotheses.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use hssh_topology::{Measure, Preference, Rank};

use crate::context::Context;
use crate::crew::{Look, Scratch, Step, expand};
use crate::report::Tally;
use crate::tree::{Child, Cursor, NodeId, Tree};

/// Nodes that one thread takes at a time.
const PIECE: usize = 64;

/// An open hypothesis: the lower its rank the sooner its turn, then the deeper, then the older.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(crate) struct Turn {
    pub(crate) rank: Rank,
    pub(crate) depth: Reverse<u32>,
    pub(crate) node: NodeId,
    pub(crate) closed: bool,
}

/// Which number of an open hypothesis decides its turn.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Order {
    /// What its map measures.
    Measure,
    /// The least that any map grown from it can measure.
    Bound,
}

/// A successor with what decides its turn.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scored {
    pub(crate) child: Child,
    /// Its measure if it explains everything or the order is that of measures, else its bound.
    pub(crate) score: Measure,
    pub(crate) closed: bool,
    /// Whether the travels that are left can use up its pending gateways.
    pub(crate) closable: bool,
}

/// What the recursive step makes of a node.
#[derive(Clone, Debug)]
struct Expansion {
    step: Step,
    successors: Vec<Scored>,
}

/// Open hypotheses in the order of their turns.
#[derive(Debug)]
pub(crate) struct Frontier {
    order: Order,
    queue: BinaryHeap<Reverse<Turn>>,
}

impl Frontier {
    /// The queue that starts at the root.
    pub(crate) fn from_root(order: Order, preference: Preference) -> Self {
        let mut frontier = Frontier { order, queue: BinaryHeap::new() };
        let rank = preference.rank(Measure::default());
        frontier.push(Turn { rank, depth: Reverse(0), node: NodeId::ROOT, closed: false });
        frontier
    }

    pub(crate) fn push(&mut self, turn: Turn) {
        self.queue.push(Reverse(turn));
    }

    pub(crate) fn pop(&mut self) -> Option<Turn> {
        self.queue.pop().map(|Reverse(turn)| turn)
    }

    pub(crate) fn peek(&self) -> Option<&Turn> {
        self.queue.peek().map(|Reverse(turn)| turn)
    }

    pub(crate) fn bytes(&self) -> u64 {
        (self.queue.len() * size_of::<Turn>()) as u64
    }

    /// Takes the next hypotheses of the least rank there is, at most that many, by age.
    pub(crate) fn pop_equals(&mut self, most: usize) -> Vec<Turn> {
        let mut turns: Vec<Turn> = self.pop().into_iter().collect();
        while turns.len() < most && self.peek().is_some_and(|turn| turn.rank == turns[0].rank) {
            turns.extend(self.pop());
        }
        turns.sort_unstable_by_key(|turn| turn.node);
        turns
    }

    /// Expands hypotheses that have been taken: the successors of each, which are in the tree then.
    pub(crate) fn expand(
        &self,
        turns: &[Turn],
        tree: &mut Tree,
        context: Context<'_>,
        tally: &mut Tally,
    ) -> Vec<(NodeId, Scored)> {
        let (order, before): (Order, &Tree) = (self.order, tree);
        let pieces: Vec<&[Turn]> = turns.chunks(PIECE).collect();
        let expansions = context.crew.map(&pieces, context.experience, |cursor, piece| {
            let expansion = |turn: &Turn| expansion_of(cursor, turn.node, order, before, context);
            piece.iter().map(expansion).collect::<Vec<_>>()
        });
        let mut successors = Vec::new();
        for (turn, expansion) in turns.iter().zip(expansions.into_iter().flatten()) {
            let children = expansion.successors.iter().map(|scored| &scored.child);
            tally.enter(turn.node, &expansion.step, children, tree);
            context.watch.add_nodes(expansion.successors.len() as u64);
            context.watch.explained(turn.depth.0 as usize);
            successors
                .extend(expansion.successors.into_iter().map(|scored| (tree.push(scored.child), scored)));
        }
        successors
    }
}

fn expansion_of(
    cursor: &mut Cursor,
    node: NodeId,
    order: Order,
    tree: &Tree,
    context: Context<'_>,
) -> Expansion {
    let travels_left = (context.travels() - tree.depth(node) - 1) as u32;
    let (mut successors, mut scratch) = (Vec::new(), Scratch::default());
    let outcome = expand(cursor, node, tree, context, &mut scratch, Look::Inside, |child, hypothesis| {
        let map = &hypothesis.map;
        let score = match order {
            Order::Bound if travels_left > 0 => Measure::bound(map, travels_left),
            Order::Bound | Order::Measure => Measure::of(map),
        };
        let closable = map.pending_count() <= 2 * travels_left;
        successors.push(Scored { child, score, closed: map.is_closed(), closable });
    });
    Expansion { step: Step { outcome, removals: scratch.removals }, successors }
}
