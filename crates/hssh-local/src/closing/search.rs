//! Where one submap lies best on another: every pose of a window, without trying all (branch and bound; after
//! Olson 2009 and Hess, Kohler, Rapp, Andor 2016).

use hssh_metrics::Pose;
use nalgebra::Vector2;

use super::field::Field;
use super::submap::CELL;

/// Radians between the headings that are tried.
const TURN: f64 = 0.02;

/// The poses that are tried: around a pose, so many metres and radians to each side.
#[derive(Clone, Copy)]
pub(super) struct Window {
    pub(super) center: Pose,
    pub(super) across: f64,
    pub(super) around: f64,
}

/// A pose of a submap in the frame of another one, and how well it fits: at most 1.
#[derive(Clone, Copy)]
pub(super) struct Fit {
    pub(super) pose: Pose,
    pub(super) score: f64,
}

/// A block of poses with one heading: shifts from `shift` on, a block of the level wide.
struct Block {
    heading: usize,
    shift: (i32, i32),
    level: usize,
    bound: f64,
}

/// The best pose in the window with a score above `threshold`; poses within `apart` metres of `but` do not count.
pub(super) fn search(
    field: &Field,
    walls: &[Vector2<f64>],
    window: &Window,
    threshold: f64,
    but: Option<(Pose, f64)>,
) -> Option<Fit> {
    let steps = (window.around / TURN).ceil() as i32;
    let headings: Vec<f64> =
        (-steps..=steps).map(|step| window.center.theta + f64::from(step) * TURN).collect();
    let cells: Vec<Vec<(i32, i32)>> = headings
        .iter()
        .map(|&theta| {
            let at = Pose { theta, ..window.center };
            let rotation = at.rotation();
            walls.iter().map(|wall| field.cell(at.translation() + rotation * wall)).collect()
        })
        .collect();
    let across = (window.across / CELL).ceil() as i32;
    let top = (0..=Field::TOP).rev().find(|&level| (1 << level) <= across.max(1)).unwrap_or(0);
    let mut blocks: Vec<Block> = Vec::new();
    for heading in 0..headings.len() {
        for row in (-across..=across).step_by(1 << top) {
            for column in (-across..=across).step_by(1 << top) {
                let shift = (column, row);
                blocks.push(Block {
                    heading,
                    shift,
                    level: top,
                    bound: field.score(&cells[heading], shift, top),
                });
            }
        }
    }
    let pose = |block: &Block| {
        let shift = Vector2::new(f64::from(block.shift.0), f64::from(block.shift.1)) * CELL;
        Pose::new(window.center.x + shift.x, window.center.y + shift.y, headings[block.heading])
    };
    let is_excluded = |block: &Block| {
        but.is_some_and(|(pose_but, apart)| {
            let size = f64::from((1 << block.level) - 1) * CELL;
            let middle = pose(block).translation() + Vector2::new(size, size) / 2.0;
            (middle - pose_but.translation()).norm() + size * 0.7072 < apart
        })
    };
    let mut best: Option<Fit> = None;
    let mut least = threshold;
    blocks.sort_by(|a, b| a.bound.total_cmp(&b.bound));
    while let Some(block) = blocks.pop() {
        if block.bound <= least {
            continue;
        }
        if is_excluded(&block) {
            continue;
        }
        if block.level == 0 {
            least = block.bound;
            best = Some(Fit { pose: pose(&block), score: block.bound });
            continue;
        }
        let level = block.level - 1;
        let half = 1 << level;
        let mut children = [(0, 0), (half, 0), (0, half), (half, half)].map(|(column, row)| {
            let shift = (block.shift.0 + column, block.shift.1 + row);
            Block {
                heading: block.heading,
                shift,
                level,
                bound: field.score(&cells[block.heading], shift, level),
            }
        });
        children.sort_by(|a, b| a.bound.total_cmp(&b.bound));
        blocks.extend(children.into_iter().filter(|child| child.bound > least));
    }
    best
}
