//! A search tree as a Graphviz graph.

use std::fmt::Write;

use super::{Fate, SearchTree, TreeError, TreeOptions, abbreviation};
use crate::map::quoted;

/// A search tree in Graphviz's language, for `dot`: nodes by number, edges with their letters, refuted
/// nodes ending in `p-nc !`, those without any successor that the axioms admit in `e ∅`.
///
/// # Errors
/// If the tree is empty or too large, or if a parent does not come before its children.
pub fn tree_to_dot(tree: &SearchTree, options: &TreeOptions) -> Result<String, TreeError> {
    tree.check(options)?;
    let mut levels = vec![0; tree.nodes.len()];
    let mut dot = String::from("digraph tree {\n");
    let _ = writeln!(
        dot,
        "  graph [label={}, fontname=\"Helvetica\"];",
        quoted(options.title.as_deref().unwrap_or(""))
    );
    dot.push_str("  node [shape=circle, fontname=\"Helvetica\", fontsize=10];\n");
    dot.push_str("  edge [arrowhead=none, fontname=\"Helvetica\", fontsize=9];\n");
    for (index, node) in tree.nodes.iter().enumerate() {
        if let Some((parent, _)) = node.parent {
            levels[index] = levels[parent] + 1;
        }
        let is_final = levels[index] == tree.observations;
        let fill = if is_final { ", style=filled, fillcolor=\"#eaf3ec\"" } else { "" };
        let frame = if node.is_optimal { ", shape=doublecircle, color=\"#117733\"" } else { "" };
        let _ = writeln!(dot, "  n{index} [label=\"{index}\"{fill}{frame}];");
        if let Some((parent, step)) = node.parent {
            let _ = writeln!(dot, "  n{parent} -> n{index} [label=\"{}\"];", abbreviation(step));
        }
        let (step, sign) = match node.fate {
            Fate::Alive => continue,
            Fate::Refuted => ("p-nc", "!"),
            Fate::Removed => ("e", "∅"),
        };
        let _ = writeln!(dot, "  s{index} [shape=plaintext, label=\"{sign}\"];");
        let _ = writeln!(dot, "  n{index} -> s{index} [label=\"{step}\"];");
    }
    dot.push_str("}\n");
    Ok(dot)
}
