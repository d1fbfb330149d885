//! The whole state of a search, but what follows from its exploration and options.

use std::io;
use std::ops::Range;

use hssh_metrics::SolveError;
use serde::{Deserialize, Serialize};

use super::error::CheckpointError;
use super::seal::{Pen, Unsealed};
use crate::context::Context;
use crate::elsewhere::{Elsewhere, unwritten};
use crate::engine::{Engine, Found, GrowingLevel, Sweep};
use crate::fringe::Fringe;
use crate::frontier::Told;
use crate::leaf::Leaf;
use crate::pack::{Pack, PackedLeaf};
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
    let Some(elsewhere) = &engine.frontier.elsewhere else { return pen.put(&0_usize) };
    pen.put(&engine.frontier.pages().count())?;
    for (part, page) in engine.frontier.pages() {
        pen.put(&(part, page.bytes))?;
        pen.put(&elsewhere.written(page)?)?;
    }
    Ok(())
}

/// The state of a search that was written down.
pub(crate) struct State<A: Pack> {
    tree: Tree,
    small: Small<A::Key>,
    /// By where they are.
    leaves: [Vec<Leaf<A>>; 5],
    /// Those that were elsewhere, and are again.
    pages: Vec<Told<A>>,
}

impl<A: Pack> State<A> {
    /// Reads the state of a search.
    ///
    /// # Errors
    /// If it is none.
    pub(crate) fn read(
        unsealed: &mut Unsealed<'_>,
        elsewhere: Option<&Elsewhere>,
        context: Context<'_>,
    ) -> Result<Self, CheckpointError> {
        let travels = context.travels();
        let tree: Tree = unsealed.take()?;
        if !tree.is_sound(travels) {
            return Err(CheckpointError::Damaged);
        }
        let small: Small<A::Key> = unsealed.take()?;
        let shared: A::Read = unsealed.take()?;
        let is_there =
            |leaf: &Leaf<A>| leaf.node.index() < tree.len() && tree.depth(leaf.node) == leaf.depth();
        let mut leaves: [Vec<Leaf<A>>; 5] = Default::default();
        for leaves in &mut leaves {
            *leaves = unsealed.take_all(|packed: PackedLeaf<A::Key, A::Packed>| {
                packed.unpack(&shared, context.axioms).filter(is_there)
            })?;
        }
        let mut pages = Vec::new();
        let mut parked = Vec::new();
        let count: usize = unsealed.take()?;
        for _ in 0..count {
            let (part, bytes): (Option<(u32, u32)>, u64) = unsealed.take()?;
            let written: Vec<u8> = unsealed.take()?;
            let read = unwritten::<A>(&written, context.axioms).filter(|leaves| leaves.iter().all(is_there));
            let own = read.ok_or(CheckpointError::Damaged)?;
            if part.is_some_and(|(depth, _)| own.iter().any(|leaf| leaf.depth != depth)) {
                return Err(CheckpointError::Damaged);
            }
            match elsewhere.filter(|_| parked.is_empty()).and_then(|elsewhere| elsewhere.keep(&own, bytes)) {
                Some(page) => pages.push(Told { part, page }),
                None if part.is_some() => leaves[0].extend(own),
                None => parked.extend(own),
            }
        }
        // What was elsewhere was set aside before what was not.
        parked.append(&mut leaves[1]);
        leaves[1] = parked;
        let state = State { tree, small, leaves, pages };
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
        engine.frontier.restore(queued, parked, arrivals, self.pages);
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
