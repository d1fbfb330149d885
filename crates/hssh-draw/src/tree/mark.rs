//! The mark that stands for a node of a search tree: what became of it, and whether it is preferred.

use nalgebra::vector;

use super::{Fate, TreeNode};
use crate::svg::{Canvas, Point, number};

/// A node: a solid dot, a cross if it was refuted, an open square if axioms left it no successor, with a
/// ring of its own radius around it if it is preferred.
pub(super) fn draw_dot(canvas: &mut Canvas, at: Point, (radius, ring): (f64, f64), node: &TreeNode) {
    match node.fate {
        Fate::Alive => canvas.circle(at, radius, r##"fill="#222222""##),
        Fate::Refuted => {
            for corner in [vector![radius, radius], vector![radius, -radius]] {
                canvas.line(at - corner, at + corner, r##"stroke="#c0392b" stroke-width="1.6""##);
            }
        }
        Fate::Removed => {
            let corner = vector![radius, radius];
            let attributes = r##"fill="#ffffff" stroke="#8a6d00" stroke-width="1.3""##;
            canvas.rectangle(at - corner, at + corner, attributes);
        }
    }
    if node.is_optimal {
        let width = number((ring - radius) * 0.55);
        canvas.circle(at, ring, &format!(r##"stroke="#117733" stroke-width="{width}""##));
    }
}
