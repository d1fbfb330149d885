//! The whole state of a search, but what follows from its exploration and options.

use std::io;
use std::ops::Range;

use hssh_metrics::SolveError;
use serde::{Deserialize, Serialize};

use super::error::CheckpointError;
use super::pack::{Pack, PackedLeaf};
use super::seal::{Pen, Unsealed};
use crate::context::Context;
use crate::engine::{Engine, Found, GrowingLevel, Sweep};
use crate::fringe::Fringe;
use crate::leaf::Leaf;
use crate::tally::Tally;
use crate::tree::Tree;

/// What is small.
#[derive(Serialize, Deserialize)]
struct Small<K> {
    tally: Tally,
    fringe: Fringe,
    sweep: Sweep,
    solved: u64,
    factors: Vec<(Option<K>, f64)>,
    unsolvable: Option<(usize, SolveError)>,
    reach: Option<K>,
    bytes: u64,
    /// How many hypotheses came to each level.
    arrivals: Vec<u32>,
    growing: Option<Growing>,
}

/// A level of appraised hypotheses that is not complete.
#[derive(Serialize, Deserialize)]
struct Growing {
    nodes: usize,
    maps: usize,
    tally: Tally,
    next: usize,
}

/// The leaves of a search by where they are, in an order that a search cannot tell from that which they had.
fn leaves<A: Pack>(engine: &Engine<A>) -> [Vec<&Leaf<A>>; 5] {
    let growing = engine.growing.as_ref().map_or(&[][..], |growing| &growing.leaves);
    [
        engine.frontier.queued().collect(),
        engine.frontier.parked().collect(),
        engine.found.iter().map(|found| &found.leaf).collect(),
        engine.rejected.iter().collect(),
        growing.iter().collect(),
    ]
}

/// Writes the state of a search.
pub(crate) fn write_state<A: Pack>(engine: &Engine<A>, pen: &mut Pen<'_>) -> io::Result<()> {
    pen.put(&engine.tree)?;
    let growing = engine.growing.as_ref();
    pen.put(&Small {
        tally: engine.tally.clone(),
        fringe: engine.fringe.clone(),
        sweep: engine.sweep,
        solved: engine.solved,
        factors: engine.factors.clone(),
        unsolvable: engine.unsolvable,
        reach: engine.reach,
        bytes: engine.bytes,
        arrivals: engine.frontier.arrivals().collect(),
        growing: growing.map(|&GrowingLevel { nodes, maps, ref tally, next, .. }| Growing {
            nodes,
            maps,
            tally: tally.clone(),
            next,
        }),
    })?;
    let leaves = leaves(engine);
    let shared = A::share(leaves.iter().flatten().map(|leaf| &leaf.load));
    pen.put(&shared)?;
    for leaves in leaves {
        pen.put_all(leaves.into_iter().map(|leaf| PackedLeaf::of(leaf, &shared)))?;
    }
    Ok(())
}

/// The state of a search that was written down.
pub(crate) struct State<A: Pack> {
    tree: Tree,
    small: Small<A::Key>,
    /// By where they are.
    leaves: [Vec<Leaf<A>>; 5],
}

impl<A: Pack> State<A> {
    /// Reads the state of a search.
    ///
    /// # Errors
    /// If it is none.
    pub(crate) fn read(unsealed: &mut Unsealed<'_>, context: Context<'_>) -> Result<Self, CheckpointError> {
        let travels = context.travels();
        let tree: Tree = unsealed.take()?;
        if !tree.is_sound(travels) {
            return Err(CheckpointError::Damaged);
        }
        let small: Small<A::Key> = unsealed.take()?;
        let shared: A::Read = unsealed.take()?;
        let mut leaves: [Vec<Leaf<A>>; 5] = Default::default();
        for leaves in &mut leaves {
            *leaves = unsealed.take_all(|packed: PackedLeaf<A::Key, A::Packed>| {
                let leaf: Leaf<A> = packed.unpack(&shared, context.axioms)?;
                let is_there = leaf.node.index() < tree.len() && tree.depth(leaf.node) == leaf.depth();
                is_there.then_some(leaf)
            })?;
        }
        let state = State { tree, small, leaves };
        if state.is_sound(travels) { Ok(state) } else { Err(CheckpointError::Damaged) }
    }

    /// How many hypotheses were made.
    pub(crate) fn nodes(&self) -> u64 {
        self.tree.len() as u64
    }

    /// Whether whatever is pointed to is there.
    fn is_sound(&self, travels: usize) -> bool {
        let Small { fringe, tally, growing, arrivals, .. } = &self.small;
        let Range { start, end } = fringe.nodes;
        let is_within = |growing: &Growing| {
            growing.nodes <= self.tree.len()
                && growing.maps <= self.tree.map_count()
                && growing.next <= self.leaves[4].len()
                && fringe.depth < travels
        };
        start <= end
            && end as usize <= self.tree.len()
            && fringe.depth <= travels
            && arrivals.len() == travels + 1
            && !tally.levels.is_empty()
            && growing.as_ref().is_none_or(is_within)
            && (growing.is_some() || self.leaves[4].is_empty())
    }

    /// Puts the state in the place of that of a search that has just begun.
    pub(crate) fn restore(self, engine: &mut Engine<A>) {
        let Small { tally, fringe, sweep, solved, factors, unsolvable, reach, bytes, arrivals, growing } =
            self.small;
        let [queued, parked, found, rejected, growing_leaves] = self.leaves;
        engine.tree = self.tree;
        engine.frontier.restore(queued, parked, arrivals);
        let found = found.into_iter();
        engine.found = found.map(|leaf| Found { branch: engine.tree.choices(leaf.node), leaf }).collect();
        engine.rejected = rejected;
        engine.growing = growing.map(|Growing { nodes, maps, tally, next }| GrowingLevel {
            nodes,
            maps,
            tally,
            leaves: growing_leaves,
            next,
        });
        (engine.tally, engine.fringe, engine.sweep) = (tally, fringe, sweep);
        (engine.solved, engine.factors, engine.unsolvable) = (solved, factors, unsolvable);
        (engine.reach, engine.bytes) = (reach, bytes);
    }
}
