//! The queue of open hypotheses, expanded ahead of their turn by idle threads.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BinaryHeap};

use hssh_topology::{Axioms, Measure, Rank, Removals};

use crate::crew::{Crew, expand};
use crate::experience::Experience;
use crate::tree::{Child, Cursor, NodeId, Outcome, Tree};

/// Nodes per thread that are expanded ahead of their turn.
const AHEAD: usize = 16;

/// An open hypothesis: the lower its rank the sooner its turn, then the deeper, then the older.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Debug)]
pub(crate) struct Turn {
    pub(crate) rank: Rank,
    pub(crate) depth: Reverse<u32>,
    pub(crate) node: NodeId,
    pub(crate) closed: bool,
}

/// A successor with what decides its turn.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scored {
    pub(crate) child: Child,
    pub(crate) measure: Measure,
    pub(crate) bound: Measure,
    pub(crate) closed: bool,
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
#[derive(Debug, Default)]
pub(crate) struct Frontier {
    queue: BinaryHeap<Reverse<Turn>>,
    ahead: BTreeMap<NodeId, Expansion>,
}

impl Frontier {
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

    /// The expansion of a node that has just been popped.
    pub(crate) fn expansion(
        &mut self,
        node: NodeId,
        tree: &Tree,
        (experience, axioms): (&Experience, &Axioms),
        crew: &Crew,
    ) -> Expansion {
        if let Some(expansion) = self.ahead.remove(&node) {
            return expansion;
        }
        let travels = experience.observations.len();
        let mut nodes = vec![node];
        if crew.threads() > 1 {
            // The first entries of a heap are among its best.
            let soon = self
                .queue
                .iter()
                .map(|Reverse(turn)| turn)
                .filter(|turn| (turn.depth.0 as usize) < travels && !self.ahead.contains_key(&turn.node));
            nodes.extend(soon.map(|turn| turn.node).take(AHEAD * crew.threads() - 1));
        }
        let expansions = crew
            .map(&nodes, experience, |cursor, &node| expansion_of(cursor, node, tree, experience, axioms));
        self.ahead.extend(nodes.iter().copied().zip(expansions));
        self.ahead.remove(&node).expect("the node itself is the first of those expanded")
    }
}

fn expansion_of(
    cursor: &mut Cursor,
    node: NodeId,
    tree: &Tree,
    experience: &Experience,
    axioms: &Axioms,
) -> Expansion {
    let travels_left = (experience.observations.len() - tree.depth(node) - 1) as u32;
    let (mut successors, mut removals) = (Vec::new(), Removals::default());
    let scratch = (&mut Vec::new(), &mut removals);
    let outcome = expand(cursor, node, (tree, experience, axioms), scratch, true, |child, hypothesis| {
        let map = &hypothesis.map;
        successors.push(Scored {
            child,
            measure: Measure::of(map),
            bound: Measure::bound(map, travels_left),
            closed: map.is_closed(),
        });
    });
    Expansion { outcome, successors, removals }
}
