//! What stands around a search tree: the levels' numbers, the shade of the final level, and notes on signs.

use nalgebra::vector;

use super::mark::draw_dot;
use super::{Fate, SearchTree, TreeNode};
use crate::svg::{Anchor, Canvas, text_width};

/// The size of texts around a tree of that width, in pixels: a wide picture will be seen from far away.
pub(super) fn text_size(width: f64) -> f64 {
    (width / 130.0).clamp(12.0, 48.0)
}

/// Numbers the levels at the left and shades the final one; `bands` are middle and height of each level.
pub(super) fn draw_levels(
    canvas: &mut Canvas,
    observations: usize,
    bands: &[(f64, f64)],
    left: f64,
    right: f64,
) {
    let size = text_size(right - left);
    for (level, &(middle, height)) in bands.iter().enumerate() {
        if level == observations {
            let half = height / 2.0 + 6.0;
            let (low, high) = (vector![left, middle - half], vector![right, middle + half]);
            canvas.rectangle(low, high, r##"class="final" fill="#eaf3ec" rx="6""##);
        }
        let number = level.to_string();
        canvas.text(vector![left - 1.2 * size, middle], size, Anchor::Middle, &number, r##"fill="#888888""##);
    }
}

/// How a sign is drawn, and what it means.
pub(super) enum Note {
    /// Letters as they stand in the picture.
    Letters(&'static str, &'static str),
    /// A dot as it stands in the picture.
    Dot(Fate, bool, &'static str),
    /// A line as it stands in the picture.
    Line(&'static str, &'static str),
    /// Words only.
    Words(String),
}

fn summary(tree: &SearchTree) -> Note {
    let nodes = tree.nodes.len();
    let plural = |count: usize| if count == 1 { "" } else { "s" };
    let observations = tree.observations;
    Note::Words(format!("{nodes} node{}, {observations} travel{}", plural(nodes), plural(observations)))
}

fn occurs(tree: &SearchTree, fate: Fate) -> bool {
    tree.nodes.iter().any(|node| node.fate == fate)
}

/// The notes for a tree of little maps.
pub(super) fn letters_note(tree: &SearchTree) -> Vec<Note> {
    let mut notes =
        vec![summary(tree), Note::Letters("e", "expand"), Note::Letters("p-c", "predicted-consistent")];
    if occurs(tree, Fate::Refuted) {
        notes.push(Note::Letters("p-nc !", "predicted-inconsistent"));
    }
    if occurs(tree, Fate::Removed) {
        notes.push(Note::Letters("e ∅", "all successors removed by axioms"));
    }
    if tree.nodes.iter().any(|node| node.is_optimal) {
        notes.push(Note::Words("framed: preferred".to_owned()));
    }
    notes
}

/// The notes for a tree of dots.
pub(super) fn signs_note(tree: &SearchTree) -> Vec<Note> {
    let mut notes = vec![
        summary(tree),
        Note::Line(r##"stroke="#777777" stroke-width="1""##, "e"),
        Note::Line(r##"stroke="#0072b2" stroke-width="1.2" stroke-dasharray="3 2""##, "p-c"),
    ];
    if occurs(tree, Fate::Refuted) {
        notes.push(Note::Dot(Fate::Refuted, false, "p-nc !"));
    }
    if occurs(tree, Fate::Removed) {
        notes.push(Note::Dot(Fate::Removed, false, "all successors removed by axioms"));
    }
    if tree.nodes.iter().any(|node| node.is_optimal) {
        notes.push(Note::Dot(Fate::Alive, true, "preferred"));
    }
    notes
}

/// Writes the notes below the tree, in as many rows as its width asks for.
pub(super) fn draw_notes(canvas: &mut Canvas, notes: &[Note]) {
    let (low, high) = canvas.bounds();
    let size = text_size(high.x - low.x);
    let right = high.x.max(low.x + 290.0);
    let mut at = vector![low.x, high.y + 2.5 * size];
    for note in notes {
        let (sign_width, words) = match note {
            Note::Letters(letters, words) => (text_width(letters, size) + 0.7 * size, *words),
            Note::Dot(_, _, words) => (1.5 * size, *words),
            Note::Line(_, words) => (2.8 * size, *words),
            Note::Words(words) => (0.0, words.as_str()),
        };
        let width = sign_width + text_width(words, size);
        if at.x > low.x && at.x + width > right {
            at = vector![low.x, at.y + 1.6 * size];
        }
        match note {
            Note::Letters(letters, _) => {
                let bold = r##"fill="#111111" font-weight="bold""##;
                canvas.text(at, size, Anchor::Start, letters, bold);
            }
            &Note::Dot(fate, is_optimal, _) => {
                let node = TreeNode { parent: None, fate, is_optimal, picture: None };
                draw_dot(canvas, at + vector![0.5 * size, 0.0], (0.3 * size, 0.63 * size), &node);
            }
            Note::Line(attributes, _) => canvas.line(at, at + vector![2.2 * size, 0.0], attributes),
            Note::Words(_) => {}
        }
        canvas.text(at + vector![sign_width, 0.0], size, Anchor::Start, words, r##"fill="#444444""##);
        at.x += width + 2.0 * size;
    }
}
