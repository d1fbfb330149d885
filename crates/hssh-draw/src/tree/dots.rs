//! A search tree too large for little maps: nodes as dots, steps as lines of two kinds.

use hssh_topology::Derivation;
use nalgebra::vector;

use super::SearchTree;
use super::arrangement::Arrangement;
use super::legend::{draw_levels, draw_notes, signs_note, text_size};
use super::mark::draw_dot;
use crate::svg::Canvas;

/// The room for a leaf, in pixels: little if there are very many.
fn column_width(leaves: usize) -> f64 {
    match leaves {
        0..=60 => 20.0,
        61..=200 => 13.0,
        201..=800 => 8.0,
        _ => 5.0,
    }
}

pub(super) fn draw_dots(canvas: &mut Canvas, tree: &SearchTree, arrangement: &Arrangement) {
    let column = column_width(arrangement.width);
    let width = column * arrangement.width as f64;
    let levels = arrangement.depth() + 1;
    let row = (0.5 * width / levels as f64).clamp(30.0, 150.0);
    let radius = 0.26 * column.min(14.0);
    let ring = radius + text_size(width) / 3.0;
    let at = |node: usize| vector![arrangement.columns[node] * column, arrangement.levels[node] as f64 * row];

    let bands: Vec<(f64, f64)> = (0..levels).map(|level| (level as f64 * row, 0.5 * row)).collect();
    draw_levels(canvas, tree.observations, &bands, -column, width);
    for (index, node) in tree.nodes.iter().enumerate() {
        if let Some((parent, step)) = node.parent {
            let attributes = match step {
                Derivation::NewPlace | Derivation::Closure(_) => r##"stroke="#777777" stroke-width="0.8""##,
                Derivation::Predicted => r##"stroke="#0072b2" stroke-width="1" stroke-dasharray="3 2""##,
            };
            canvas.line(at(parent), at(index), attributes);
        }
    }
    for (index, node) in tree.nodes.iter().enumerate() {
        draw_dot(canvas, at(index), (radius, ring), node);
    }
    draw_notes(canvas, &signs_note(tree));
}
