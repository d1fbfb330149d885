//! The recursive step applied to many nodes, by the threads of this process and by those that help it.

use std::ops::Range;
use std::time::Duration;

use hssh_topology::{Outcome, Removals, Step};
use serde::{Deserialize, Serialize};

use crate::context::Context;
use crate::cursor::Cursor;
use crate::helpers::{Asked, read, written};
use crate::paths::{Choice, Paths, Prefixes};
use crate::step::{Look, successors};
use crate::tree::{Child, NodeId, Tree};

/// About how long it takes to apply the step to a piece of a level.
const TIME: Duration = Duration::from_millis(1);

/// What the step makes of some nodes in a row.
pub(crate) struct Stepped {
    pub(crate) outcomes: Vec<Outcome>,
    pub(crate) children: Vec<Child>,
    pub(crate) removals: Removals,
}

/// The same, told to somebody: by node what became of it, and its choices.
#[derive(Serialize, Deserialize)]
struct Told(Vec<(Outcome, Vec<Choice>)>, Removals);

impl Stepped {
    /// Applies the step.
    fn to(
        nodes: impl Iterator<Item = NodeId>,
        tree: &Tree,
        cursor: &mut Cursor,
        context: Context<'_>,
    ) -> Self {
        let (mut children, mut step) = (Vec::new(), Step::default());
        let mut grow = |node| {
            let keep = |child, _: &_| children.push(child);
            successors(cursor, node, tree, context, &mut step, Look::Outside, keep)
        };
        let outcomes = nodes.map(&mut grow).collect();
        Stepped { outcomes, children, removals: step.removals }
    }
}

/// Applies the step to pieces of a level; what came of them, in their order, several of them together where somebody else did it.
pub(crate) fn step_all(pieces: &[Range<u32>], tree: &Tree, context: Context<'_>) -> Vec<Stepped> {
    let nodes = |piece: &Range<u32>| piece.clone().map(NodeId::new);
    let here = |pieces: &[Range<u32>]| {
        context
            .crew
            .map(pieces, context.experience, |cursor, piece| Stepped::to(nodes(piece), tree, cursor, context))
    };
    let request = |pieces: &[Range<u32>]| {
        written(vec![Asked::Steps as u8], &Paths::to(pieces.iter().flat_map(nodes), tree))
    };
    let hear = |pieces: &[Range<u32>], answer: &[u8]| {
        let Told(told, removals) = read(answer)?;
        let all: Vec<NodeId> = pieces.iter().flat_map(nodes).collect();
        if told.len() != all.len() {
            return None;
        }
        let mut stepped = Stepped { outcomes: Vec::new(), children: Vec::new(), removals };
        for (parent, (outcome, choices)) in all.into_iter().zip(told) {
            let child = |(derivation, exit, arrival)| Child { parent, derivation, exit, arrival };
            stepped.outcomes.push(outcome);
            stepped.children.extend(choices.into_iter().map(child));
        }
        Some(vec![stepped])
    };
    context.share(pieces, TIME, request, here, hear)
}

/// Applies the step to nodes that somebody asks for.
pub(crate) fn answer(paths: &Paths, prefixes: &mut Prefixes, context: Context<'_>) -> Option<Vec<u8>> {
    let nodes = prefixes.find(paths, context.experience)?;
    let (tree, cursor) = prefixes.at(0, context.experience);
    let Stepped { outcomes, children, removals } = Stepped::to(nodes.iter().copied(), tree, cursor, context);
    let mut children = children.into_iter().peekable();
    let told = nodes.into_iter().zip(outcomes).map(|(node, outcome)| {
        let own = std::iter::from_fn(|| children.next_if(|child| child.parent == node));
        (outcome, own.map(|child| (child.derivation, child.exit, child.arrival)).collect())
    });
    Some(written(Vec::new(), &Told(told.collect(), removals)))
}
