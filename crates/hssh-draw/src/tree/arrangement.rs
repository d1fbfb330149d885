//! Where the nodes of a tree stand: level by level, leaves side by side, parents over their children.

use super::SearchTree;

/// A tree's nodes in columns and levels.
pub(super) struct Arrangement {
    /// By node: the column of its middle, counted in leaves from 0.
    pub(super) columns: Vec<f64>,
    /// By node: how many steps it is from the root.
    pub(super) levels: Vec<usize>,
    /// How many leaves there are.
    pub(super) width: usize,
}

impl Arrangement {
    /// Arranges a tree whose parents come before their children.
    pub(super) fn of(tree: &SearchTree) -> Self {
        let mut children = vec![Vec::new(); tree.nodes.len()];
        let mut levels = vec![0; tree.nodes.len()];
        for (index, node) in tree.nodes.iter().enumerate() {
            if let Some((parent, _)) = node.parent {
                children[parent].push(index);
                levels[index] = levels[parent] + 1;
            }
        }
        let mut columns = vec![0.0; tree.nodes.len()];
        let width = place_leaves(&children, &mut columns);
        // Children come after their parents: backwards, every parent finds its children placed.
        for (index, children) in children.iter().enumerate().rev() {
            if let (Some(&first), Some(&last)) = (children.first(), children.last()) {
                columns[index] = (columns[first] + columns[last]) / 2.0;
            }
        }
        Arrangement { columns, levels, width }
    }

    /// The deepest level.
    pub(super) fn depth(&self) -> usize {
        self.levels.iter().copied().max().unwrap_or(0)
    }
}

/// Gives the leaves their columns, from left to right; how many there are.
fn place_leaves(children: &[Vec<usize>], columns: &mut [f64]) -> usize {
    let mut leaves = 0;
    let mut open = vec![0];
    while let Some(node) = open.pop() {
        if children[node].is_empty() {
            columns[node] = leaves as f64;
            leaves += 1;
        }
        open.extend(children[node].iter().rev());
    }
    leaves
}
