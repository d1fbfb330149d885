//! How far the bound sees: along one branch, what its map truly costs from each step on, beside what the look-ahead knows of that.

use hssh_metrics::SolveError;

use crate::context::Context;
use crate::cursor::Cursor;
use crate::leaf::{Appraise, Leaf};
use crate::posterior::by_posterior::ByPosterior;
use crate::posterior::cost::Cost;
use crate::tree::{NodeId, Tree};

/// A prefix of a branch: what it costs, and what is known there of the travels that are left.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Horizon {
    /// How many travels it explains.
    pub explained: usize,
    /// What the prefix costs by itself, laid out.
    pub cost: Cost,
    /// What every map that comes of it costs at least, by the bound that the search goes by: nats.
    pub bound: f64,
    /// Of the other ways in which the travel to here could follow, laid out: the least bound. Nothing if there is no other.
    pub alternative: Option<f64>,
}

/// The horizons of a branch of the tree whose nodes are all expanded but the last one, the root's first.
///
/// # Errors
/// If a layout cannot be computed.
pub(crate) fn horizons(
    appraiser: &ByPosterior,
    tree: &Tree,
    node: NodeId,
    context: Context<'_>,
) -> Result<Vec<Horizon>, SolveError> {
    let horizon = |leaf: &Leaf<ByPosterior>, alternative| Horizon {
        explained: leaf.depth(),
        cost: leaf.load.cost,
        bound: leaf.load.bound.0,
        alternative,
    };
    let branch = tree.branch(node);
    let children = children(tree, &branch);
    let mut cursor = Cursor::new(context.experience);
    let mut leaf = appraiser.root(context);
    let mut horizons = vec![horizon(&leaf, None)];
    for (&next, children) in branch[1..].iter().zip(&children) {
        let grown = appraiser.grow(&leaf, &mut cursor, tree, context)?;
        let mut alternative: Option<f64> = None;
        for (child, mut successor) in grown.successors {
            let made = |&&node: &&NodeId| tree.derivation(node) == Some(child.derivation);
            let Some(&node) = children.iter().find(made) else { continue };
            successor.node = node;
            appraiser.settle(&mut successor, &mut cursor, tree, context)?;
            if node == next {
                leaf = successor;
            } else {
                let bound = successor.load.bound.0;
                alternative = Some(alternative.map_or(bound, |least| least.min(bound)));
            }
        }
        horizons.push(horizon(&leaf, alternative));
    }
    Ok(horizons)
}

/// By node of a branch: its successors in the tree.
fn children(tree: &Tree, branch: &[NodeId]) -> Vec<Vec<NodeId>> {
    let mut children = vec![Vec::new(); branch.len()];
    for node in tree.nodes() {
        let Some(parent) = tree.parent(node) else { continue };
        if branch.get(tree.depth(parent)) == Some(&parent) {
            children[tree.depth(parent)].push(node);
        }
    }
    children
}
