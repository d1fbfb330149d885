//! The turns of open hypotheses, taken by the threads of this process and by those that help it.

use std::time::Duration;

use hssh_metrics::SolveError;
use hssh_topology::{Outcome, Removals};
use serde::{Deserialize, Serialize};

use crate::context::Context;
use crate::cursor::Cursor;
use crate::helpers::{Asked, read, written};
use crate::leaf::{Appraise, Grown, Growth, Leaf, matters};
use crate::pack::{Pack, PackedLeaf};
use crate::paths::{Choice, Paths, Prefixes};
use crate::tree::{Child, NodeId, Tree};

/// A hypothesis whose turn it is: it is settled, if it is not, and grown, if something that matters may come of it.
#[derive(Debug)]
pub(crate) struct Turn<A: Appraise> {
    pub(crate) leaf: Leaf<A>,
    /// What still matters.
    pub(crate) reach: Option<A::Key>,
    /// The key and the arrival of the next one at its level: it goes first if it is better once this one is settled.
    pub(crate) next: Option<(A::Key, u32)>,
    /// Turns of one front go through one part of the tree, one after the other.
    pub(crate) front: usize,
}

/// What came of a turn.
#[derive(Debug)]
pub(crate) struct Taken<A: Appraise> {
    /// As it is after its turn.
    pub(crate) leaf: Leaf<A>,
    /// The bytes that it took before.
    pub(crate) bytes: u64,
    /// Whether a layout was looked for.
    pub(crate) solved: bool,
    /// By what factor its key rose of what was promised, where that was relied on.
    pub(crate) factor: Option<f64>,
    pub(crate) end: End<A>,
}

/// How a turn ended.
#[derive(Debug)]
pub(crate) enum End<A: Appraise> {
    /// It has no layout.
    Unsolvable(SolveError),
    /// Nothing that matters comes of it.
    Beyond,
    /// The next one of its level is better.
    Overtaken,
    /// It is settled, and something that matters may come of it.
    Settled,
    /// It was grown.
    Grown(Growth<A>),
}

impl<A: Appraise> Turn<A> {
    /// Settles the hypothesis.
    pub(crate) fn settle(
        &self,
        appraiser: &A,
        cursor: &mut Cursor,
        tree: &Tree,
        context: Context<'_>,
    ) -> Taken<A> {
        let Turn { ref leaf, reach, next, .. } = *self;
        let bytes = appraiser.bytes(leaf);
        let mut taken = Taken { leaf: leaf.clone(), bytes, solved: false, factor: None, end: End::Beyond };
        let leaf = &mut taken.leaf;
        if matters(appraiser, leaf, reach) && !appraiser.is_settled(leaf) {
            taken.solved = true;
            match appraiser.settle(leaf, cursor, tree, context) {
                Ok(factor) => taken.factor = factor,
                Err(problem) => {
                    taken.end = End::Unsolvable(problem);
                    return taken;
                }
            }
        }
        if matters(appraiser, leaf, reach) {
            let is_overtaken = next.is_some_and(|next| next < (leaf.key, leaf.arrival));
            taken.end = if is_overtaken { End::Overtaken } else { End::Settled };
        }
        taken
    }

    /// Takes it: settles the hypothesis, and grows it.
    pub(crate) fn take(
        &self,
        appraiser: &A,
        cursor: &mut Cursor,
        tree: &Tree,
        context: Context<'_>,
    ) -> Taken<A> {
        let mut taken = self.settle(appraiser, cursor, tree, context);
        if matches!(taken.end, End::Settled) {
            taken.end = End::Grown(appraiser.grow(&taken.leaf, cursor, tree, context));
        }
        taken
    }
}

/// About how long a turn takes by preference, and by posterior.
const TIMES: [Duration; 2] = [Duration::from_micros(3), Duration::from_micros(500)];

/// What came of turns, as it is read.
type Answer<A> = (<A as Pack>::Read, Vec<PackedTaken<<A as Appraise>::Key, <A as Pack>::Packed>>);

/// Takes turns; what came of each, in their order. `here` takes those that fall to this process.
pub(crate) fn take_all<A: Pack>(
    turns: &[Turn<A>],
    tree: &Tree,
    context: Context<'_>,
    here: impl FnMut(&[Turn<A>]) -> Vec<Taken<A>>,
) -> Vec<Taken<A>> {
    let request = |turns: &[Turn<A>]| {
        let paths = Paths::to(turns.iter().map(|turn| turn.leaf.node), tree);
        let shared = A::share(turns.iter().map(|turn| &turn.leaf.load));
        let packed: Vec<PackedTurn<A::Key, A::Packed>> = turns
            .iter()
            .map(|turn| PackedTurn(PackedLeaf::of(&turn.leaf, &shared), turn.reach, turn.next, turn.front))
            .collect();
        written(vec![Asked::Turns as u8], &(paths, &shared, packed))
    };
    let hear = |turns: &[Turn<A>], answer: &[u8]| {
        let (shared, packed): Answer<A> = read(answer)?;
        if packed.len() != turns.len() {
            return None;
        }
        let taken = packed.into_iter().zip(turns);
        taken.map(|(packed, turn)| packed.unpack(turn.leaf.node, &shared, context)).collect()
    };
    context.share(turns, TIMES[usize::from(A::WEIGHS)], request, here, hear)
}

/// Takes turns that somebody asks for; `None` if they are none of this search.
pub(crate) fn answer<A: Pack>(
    request: &[u8],
    appraiser: &A,
    prefixes: &mut Prefixes,
    context: Context<'_>,
) -> Option<Vec<u8>> {
    type Request<A> = (Paths, <A as Pack>::Read, Vec<PackedTurn<<A as Appraise>::Key, <A as Pack>::Packed>>);
    let (paths, shared, packed): Request<A> = read(request)?;
    let nodes = prefixes.find(&paths, context.experience)?;
    if nodes.len() != packed.len() {
        return None;
    }
    let mut all: Vec<Taken<A>> = Vec::with_capacity(packed.len());
    for (node, PackedTurn(leaf, reach, next, front)) in nodes.into_iter().zip(packed) {
        let leaf = Leaf { node, ..leaf.unpack(&shared, context.axioms)? };
        if prefixes.tree.depth(node) != leaf.depth() {
            return None;
        }
        let (tree, cursor) = prefixes.at(front, context.experience);
        all.push(Turn { leaf, reach, next, front }.take(appraiser, cursor, tree, context));
    }
    let shared = A::share(all.iter().flat_map(Taken::leaves).map(|leaf| &leaf.load));
    let packed: Vec<PackedTaken<A::Key, A::Packed>> =
        all.iter().map(|taken| PackedTaken::of(taken, &shared)).collect();
    Some(written(Vec::new(), &(&shared, packed)))
}

impl<A: Appraise> Taken<A> {
    /// All leaves in it.
    fn leaves(&self) -> impl Iterator<Item = &Leaf<A>> {
        let grown = match &self.end {
            End::Grown(Ok(grown)) => Some(grown),
            _ => None,
        };
        let successors = grown.into_iter().flat_map(|grown| &grown.successors).map(|(_, leaf)| leaf);
        std::iter::once(&self.leaf).chain(successors).chain(grown.and_then(|grown| grown.rest.as_ref()))
    }
}

/// A turn as it is written.
#[derive(Serialize, Deserialize)]
struct PackedTurn<K, L>(PackedLeaf<K, L>, Option<K>, Option<(K, u32)>, usize);

/// What came of a turn, as it is written.
#[derive(Serialize, Deserialize)]
struct PackedTaken<K, L> {
    leaf: PackedLeaf<K, L>,
    bytes: u64,
    solved: bool,
    factor: Option<f64>,
    end: PackedEnd<K, L>,
}

#[derive(Serialize, Deserialize)]
enum PackedEnd<K, L> {
    Unsolvable(SolveError),
    Beyond,
    Overtaken,
    Settled,
    NotGrown(SolveError),
    Grown(Outcome, Removals, Vec<(Choice, PackedLeaf<K, L>)>, Option<PackedLeaf<K, L>>),
}

impl<K: Copy, L> PackedTaken<K, L> {
    fn of<A: Pack<Key = K, Packed = L>>(taken: &Taken<A>, shared: &A::Shared<'_>) -> Self {
        let Taken { ref leaf, bytes, solved, factor, ref end } = *taken;
        let packed = |leaf: &Leaf<A>| PackedLeaf::of(leaf, shared);
        let end = match end {
            &End::Unsolvable(problem) => PackedEnd::Unsolvable(problem),
            End::Beyond => PackedEnd::Beyond,
            End::Overtaken => PackedEnd::Overtaken,
            End::Settled => PackedEnd::Settled,
            &End::Grown(Err(problem)) => PackedEnd::NotGrown(problem),
            End::Grown(Ok(Grown { outcome, removals, successors, rest })) => {
                let successor = |(child, leaf): &(Child, Leaf<A>)| {
                    ((child.derivation, child.exit, child.arrival), packed(leaf))
                };
                let successors = successors.iter().map(successor).collect();
                PackedEnd::Grown(*outcome, *removals, successors, rest.as_ref().map(packed))
            }
        };
        PackedTaken { leaf: packed(leaf), bytes, solved, factor, end }
    }

    /// The same again, of that node. `None` if it refers to what is not there.
    fn unpack<A: Pack<Key = K, Packed = L>>(
        self,
        node: NodeId,
        shared: &A::Read,
        context: Context<'_>,
    ) -> Option<Taken<A>> {
        let unpack = |leaf: PackedLeaf<K, L>| Some(Leaf { node, ..leaf.unpack(shared, context.axioms)? });
        let PackedTaken { leaf, bytes, solved, factor, end } = self;
        let end = match end {
            PackedEnd::Unsolvable(problem) => End::Unsolvable(problem),
            PackedEnd::Beyond => End::Beyond,
            PackedEnd::Overtaken => End::Overtaken,
            PackedEnd::Settled => End::Settled,
            PackedEnd::NotGrown(problem) => End::Grown(Err(problem)),
            PackedEnd::Grown(outcome, removals, successors, rest) => {
                let successor = |((derivation, exit, arrival), leaf)| {
                    Some((Child { parent: node, derivation, exit, arrival }, unpack(leaf)?))
                };
                let successors = successors.into_iter().map(successor).collect::<Option<_>>()?;
                let rest = match rest {
                    Some(rest) => Some(unpack(rest)?),
                    None => None,
                };
                End::Grown(Ok(Grown { outcome, removals, successors, rest }))
            }
        };
        Some(Taken { leaf: unpack(leaf)?, bytes, solved, factor, end })
    }
}
