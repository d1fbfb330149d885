//! The queue of open hypotheses, expanded ahead of their turn by idle threads.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BinaryHeap};

use hssh_topology::{Measure, Preference, Rank, Removals};

use crate::context::Context;
use crate::crew::{Look, Scratch, expand};
use crate::report::Tally;
use crate::tree::{Child, Cursor, NodeId, Outcome, Tree};

/// Nodes per thread that are expanded ahead of their turn.
const AHEAD: usize = 16;

/// Expansions per thread that wait for their turn at most.
const WAITING: usize = 64 * AHEAD;

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
pub(crate) struct Expansion {
    pub(crate) outcome: Outcome,
    pub(crate) successors: Vec<Scored>,
    pub(crate) removals: Removals,
}

/// Open hypotheses in the order of their turns.
///
/// The order in which they are taken is that of one thread; more threads only compute in advance
/// what will be asked for.
#[derive(Debug)]
pub(crate) struct Frontier {
    order: Order,
    queue: BinaryHeap<Reverse<Turn>>,
    ahead: BTreeMap<NodeId, Expansion>,
}

impl Frontier {
    /// The queue that starts at the root.
    pub(crate) fn from_root(order: Order, preference: Preference) -> Self {
        let mut frontier = Frontier { order, queue: BinaryHeap::new(), ahead: BTreeMap::new() };
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

    /// Expands a node that has just been popped: its successors, which are in the tree then.
    pub(crate) fn expand(
        &mut self,
        turn: Turn,
        tree: &mut Tree,
        context: Context<'_>,
        tally: &mut Tally,
    ) -> Vec<(NodeId, Scored)> {
        let expansion = self.expansion(turn.node, tree, context);
        tally.enter(turn.node, &expansion, tree);
        context.watch.add_nodes(expansion.successors.len() as u64);
        context.watch.explained(turn.depth.0 as usize);
        expansion.successors.into_iter().map(|scored| (tree.push(scored.child), scored)).collect()
    }

    fn expansion(&mut self, node: NodeId, tree: &Tree, context: Context<'_>) -> Expansion {
        if let Some(expansion) = self.ahead.remove(&node) {
            return expansion;
        }
        let mut nodes = vec![node];
        let threads = context.crew.threads();
        if threads > 1 {
            // The first entries of a heap are among its best.
            let most = AHEAD * threads;
            let head = self.queue.iter().take(2 * most).map(|Reverse(turn)| turn);
            let soon = head.filter(|turn| {
                (turn.depth.0 as usize) < context.travels() && !self.ahead.contains_key(&turn.node)
            });
            nodes.extend(soon.map(|turn| turn.node).take(most - 1));
        }
        let order = self.order;
        let expansions = context.crew.map(&nodes, context.experience, |cursor, &node| {
            expansion_of(cursor, node, order, tree, context)
        });
        if self.ahead.len() > WAITING * threads {
            self.ahead.clear(); // whatever is needed again is expanded again
        }
        self.ahead.extend(nodes.iter().copied().zip(expansions));
        self.ahead.remove(&node).expect("the node itself is the first of those expanded")
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
    Expansion { outcome, successors, removals: scratch.removals }
}
