//! The SVG figure of a search tree, in the manner of Figure 2.5.

use nalgebra::vector;

use super::arrangement::Arrangement;
use super::legend::{draw_levels, draw_notes, letters_note, text_size};
use super::thumbnail::Thumbnail;
use super::{Fate, SearchTree, TreeError, TreeOptions, abbreviation, dots};
use crate::drawing::Drawing;
use crate::svg::{Anchor, Canvas, Point};

/// The room for the step between two levels, in pixels: its letters have to fit in.
const STEP_HEIGHT: f64 = 44.0;
/// The room between two maps of a level.
const GAP: f64 = 10.0;
const MARGIN: f64 = 20.0;
const LETTER_SIZE: f64 = 11.0;

/// A search tree as an SVG document, level by level.
///
/// If the tree is small and has its maps, every node is a little map with an arrow at the current place,
/// and every edge carries its letters: e or p-c. A map that was refuted ends in `p-nc !`, one whose
/// successors were all removed by axioms in `e ∅`. Otherwise the nodes are dots. The final level is
/// shaded, and preferred hypotheses are framed.
///
/// # Errors
/// If the tree is empty or too large, if a parent does not come before its children, or if the bearings
/// contradict the stars.
pub fn draw_tree(tree: &SearchTree, options: &TreeOptions) -> Result<String, TreeError> {
    tree.check(options)?;
    let arrangement = Arrangement::of(tree);
    let mut canvas = Canvas::default();
    match thumbnails(tree, options)? {
        Some(thumbnails) => draw_maps(&mut canvas, tree, &arrangement, &thumbnails),
        None => dots::draw_dots(&mut canvas, tree, &arrangement),
    }
    if let Some(title) = &options.title {
        let (low, high) = canvas.bounds();
        let size = 1.3 * text_size(high.x - low.x);
        let at = vector![(low.x + high.x) / 2.0, low.y - 1.5 * size];
        canvas.text(at, size, Anchor::Middle, title, r##"class="title" fill="#111111" font-weight="bold""##);
    }
    Ok(canvas.finish(MARGIN, options.title.as_deref().unwrap_or("Search tree")))
}

/// The nodes as little maps; `None` if the tree is too large for that, or has not all of them.
fn thumbnails<'a>(
    tree: &'a SearchTree,
    options: &TreeOptions,
) -> Result<Option<Vec<Thumbnail<'a>>>, TreeError> {
    if tree.nodes.len() > options.most_maps || tree.nodes.iter().any(|node| node.picture.is_none()) {
        return Ok(None);
    }
    let pictures = tree.nodes.iter().filter_map(|node| node.picture.as_ref());
    let thumbnail = |(node, (map, place)): (usize, &'a (_, _))| {
        let drawing = Drawing::schematic(map, &options.bearings)
            .map_err(|problem| TreeError::Drawing { node, problem })?;
        Ok(Thumbnail::new(map, *place, drawing))
    };
    pictures.enumerate().map(thumbnail).collect::<Result<Vec<_>, _>>().map(Some)
}

fn draw_maps(canvas: &mut Canvas, tree: &SearchTree, arrangement: &Arrangement, thumbnails: &[Thumbnail]) {
    let cell = thumbnails.iter().map(Thumbnail::size).fold(Point::zeros(), |a, b| a.sup(&b));
    let heights = level_heights(arrangement, thumbnails);
    // The middle of each level.
    let mut middles = Vec::with_capacity(heights.len());
    let mut top = 0.0;
    for height in &heights {
        middles.push(top + height / 2.0);
        top += height + STEP_HEIGHT;
    }
    let middle =
        |node: usize| vector![arrangement.columns[node] * (cell.x + GAP), middles[arrangement.levels[node]]];
    let half_height = |node: usize| thumbnails[node].size().y / 2.0;

    let right = (arrangement.width - 1) as f64 * (cell.x + GAP) + cell.x / 2.0 + GAP;
    let bands: Vec<(f64, f64)> =
        middles.iter().zip(&heights).map(|(&middle, &height)| (middle, height)).collect();
    draw_levels(canvas, tree.observations, &bands, -cell.x / 2.0 - GAP, right);

    for (index, node) in tree.nodes.iter().enumerate() {
        if let Some((parent, step)) = node.parent {
            let from = middle(parent) + vector![0.0, half_height(parent)];
            let to = middle(index) - vector![0.0, half_height(index)];
            canvas.line(from, to, r##"stroke="#555555" stroke-width="1.1""##);
            letters(canvas, from + (to - from) * 0.55, abbreviation(step));
        }
        let below = middle(index) + vector![0.0, half_height(index)];
        match node.fate {
            Fate::Alive => {}
            Fate::Refuted => draw_stop(canvas, below, "p-nc", "!", "#c0392b"),
            Fate::Removed => draw_stop(canvas, below, "e", "∅", "#8a6d00"),
        }
    }
    for (index, (node, thumbnail)) in tree.nodes.iter().zip(thumbnails).enumerate() {
        canvas.open(&format!(r#"class="node" data-node="{index}""#));
        if node.is_optimal {
            let half = thumbnail.size() / 2.0 + vector![3.0, 3.0];
            let frame = r##"fill="#ffffff" stroke="#117733" stroke-width="2.2" rx="5""##;
            canvas.rectangle(middle(index) - half, middle(index) + half, frame);
        }
        thumbnail.draw(canvas, middle(index));
        canvas.close();
    }
    draw_notes(canvas, &letters_note(tree));
}

/// For each level the height of its tallest map.
fn level_heights(arrangement: &Arrangement, thumbnails: &[Thumbnail]) -> Vec<f64> {
    let mut heights = vec![0.0; arrangement.depth() + 1];
    for (&level, thumbnail) in arrangement.levels.iter().zip(thumbnails) {
        heights[level] = f64::max(heights[level], thumbnail.size().y);
    }
    heights
}

/// The letters of a step, on the middle of its edge.
fn letters(canvas: &mut Canvas, at: Point, text: &str) {
    let halo = r##"fill="#222222" stroke="#ffffff" stroke-width="4" paint-order="stroke""##;
    canvas.text(at, LETTER_SIZE, Anchor::Middle, text, halo);
}

/// The end of a branch: a short edge with its letters, and a sign below it.
fn draw_stop(canvas: &mut Canvas, from: Point, step: &str, sign: &str, color: &str) {
    let to = from + vector![0.0, 22.0];
    canvas.line(from, to, &format!(r#"stroke="{color}" stroke-width="1.1""#));
    letters(canvas, from + vector![0.0, 11.0], step);
    let bold = format!(r#"fill="{color}" font-weight="bold""#);
    canvas.text(to + vector![0.0, 8.0], 15.0, Anchor::Middle, sign, &bold);
}
