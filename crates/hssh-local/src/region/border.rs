//! Where pieces touch: the gaps between them, and the walls that they share.

use std::collections::BTreeMap;
use std::f64::consts::FRAC_PI_2;

use rustc_hash::FxHashSet;

use super::flood::{NO_PIECE, around};
use super::ground::Ground;
use super::island::Islands;
use super::options::RegionOptions;
use crate::distance::DistanceField;
use crate::place::gateway_at;
use crate::skeleton::AxisPoint;

/// How far from the end of a gap there is wall at the latest, in cells.
const BESIDE: i32 = 2;

/// A pair of pieces, the one with the lower number first.
pub(super) type Pair = (u32, u32);

/// What lies between two pieces; lengths in metres.
#[derive(Clone, Debug, Default)]
pub(super) struct Border {
    /// The openings, each a connected part of the line where the pieces touch.
    pub(super) gaps: Vec<Gap>,
    /// How much wall has the one on this side and the other on that.
    pub(super) wall: f64,
}

/// An opening between two pieces.
#[derive(Clone, Copy, Debug)]
pub(super) struct Gap {
    /// The index of the cell in its middle.
    pub(super) cell: u32,
    /// How wide it is, in metres; at least, if it is not between walls.
    pub(super) width: f64,
    /// Whether there is wall on both sides, and not space that was never seen.
    pub(super) is_between_walls: bool,
    /// How large the smaller of the things is that it lies between: see [`Islands::smaller`].
    pub(super) between: f64,
}

impl Border {
    /// How wide all gaps are together.
    pub(super) fn open(&self) -> f64 {
        self.gaps.iter().map(|gap| gap.width).sum()
    }

    /// How wide the widest gap is between sides of that width: as wide as these, at least, where no wall limits it.
    pub(super) fn widest(&self, sides: f64) -> f64 {
        let width = |gap: &Gap| if gap.is_between_walls { gap.width } else { gap.width.max(sides) };
        self.gaps.iter().map(width).fold(0.0, f64::max)
    }

    /// How large the smaller of the things is that its widest gap lies between.
    pub(super) fn between(&self) -> f64 {
        let widest = self.gaps.iter().max_by(|a, b| a.width.total_cmp(&b.width));
        widest.map_or(1.0, |gap| gap.between)
    }

    /// Takes in what was another border.
    pub(super) fn extend(&mut self, other: Border) {
        self.gaps.extend(other.gaps);
        self.wall += other.wall;
    }
}

/// All borders.
pub(super) fn borders(
    labels: &[u32],
    ground: &Ground,
    islands: &mut Islands<'_>,
    options: &RegionOptions,
) -> BTreeMap<Pair, Border> {
    let field = ground.field();
    let mut borders: BTreeMap<Pair, Border> = BTreeMap::new();
    let cell = field.lattice().resolution();
    for (pair, cells) in contacts(labels, field) {
        let border = borders.entry(pair).or_default();
        border.gaps = connected(&cells, field)
            .into_iter()
            .map(|group| {
                let middle = *group
                    .iter()
                    .max_by_key(|&&index| (field.squared_at(index as usize), std::cmp::Reverse(index)))
                    .expect("a group has a cell");
                let ends = ends(middle as usize, field);
                Gap {
                    cell: middle,
                    width: 2.0 * field.clearance_at(middle as usize) + cell,
                    is_between_walls: ends.is_some_and(|ends| is_between_walls(ends, ground)),
                    between: ends.map_or(1.0, |ends| islands.smaller(ends)),
                }
            })
            .collect();
    }
    for (pair, cells) in walls(labels, ground, options.thickest_wall) {
        if let Some(border) = borders.get_mut(&pair) {
            border.wall = f64::from(cells) * cell;
        }
    }
    borders
}

/// The nearest obstacles on both sides of a cell.
fn ends(index: usize, field: &DistanceField) -> Option<[[f64; 2]; 2]> {
    let lattice = field.lattice();
    let cell = lattice.cell(index);
    let at = AxisPoint { cell, point: lattice.center(cell), clearance: field.clearance(cell) };
    let [x, y] = lattice.center(field.nearest(cell)?);
    let along = (y - at.point[1]).atan2(x - at.point[0]);
    Some(gateway_at(&at, along + FRAC_PI_2, field).line)
}

/// Whether there is wall at both ends of a line across a gap.
fn is_between_walls(ends: [[f64; 2]; 2], ground: &Ground) -> bool {
    let cell = ground.field().lattice().resolution();
    let reach = || (-BESIDE..=BESIDE).map(|steps| f64::from(steps) * cell);
    let is_wall =
        |end: [f64; 2]| reach().any(|dx| reach().any(|dy| ground.is_wall_at([end[0] + dx, end[1] + dy])));
    ends.into_iter().all(is_wall)
}

fn pair(a: u32, b: u32) -> Pair {
    (a.min(b), a.max(b))
}

/// For each pair of pieces that touch, the cells of the one with the lower number that touch the other.
fn contacts(labels: &[u32], field: &DistanceField) -> BTreeMap<Pair, Vec<u32>> {
    let lattice = field.lattice();
    let width = lattice.width() as usize;
    let mut contacts: BTreeMap<Pair, Vec<u32>> = BTreeMap::new();
    let mut touch = |here: usize, there: usize| {
        let (a, b) = (labels[here], labels[there]);
        if a != b && a != NO_PIECE && b != NO_PIECE {
            let cells = contacts.entry(pair(a, b)).or_default();
            cells.push(if a < b { here } else { there } as u32);
        }
    };
    for index in 0..labels.len() {
        let (has_right, has_up) = ((index + 1) % width > 0, index + width < labels.len());
        if has_right {
            touch(index, index + 1);
        }
        if has_up {
            touch(index, index + width);
        }
        if has_right && has_up {
            touch(index, index + width + 1);
            touch(index + 1, index + width);
        }
    }
    contacts
}

/// The groups of cells that touch one another.
fn connected(cells: &[u32], field: &DistanceField) -> Vec<Vec<u32>> {
    let mut rest: FxHashSet<u32> = cells.iter().copied().collect();
    let mut groups = Vec::new();
    for &start in cells {
        if !rest.remove(&start) {
            continue;
        }
        let mut group = vec![start];
        let mut at = 0;
        while at < group.len() {
            for near in around(field.lattice(), group[at] as usize) {
                if rest.remove(&(near as u32)) {
                    group.push(near as u32);
                }
            }
            at += 1;
        }
        groups.push(group);
    }
    groups
}

/// How many cells along rows and columns pairs of pieces share walls, up to a thickness in metres.
pub(super) fn walls(labels: &[u32], ground: &Ground, thickest: f64) -> BTreeMap<Pair, u32> {
    let lattice = ground.field().lattice();
    let (width, height) = (lattice.width() as usize, lattice.height() as usize);
    let most = (thickest / lattice.resolution()).round() as usize;
    let mut walls = BTreeMap::new();
    // The last cell with a label in a line so far, with the position of the next one.
    let mut look = |last: &mut Option<(usize, u32)>, position: usize, index: usize, step: usize| {
        let label = labels[index];
        if label == NO_PIECE {
            return;
        }
        if let Some((before, other)) = *last
            && other != label
            && (2..=most + 1).contains(&(position - before))
            && (1..position - before).any(|back| ground.is_wall(index - back * step))
        {
            *walls.entry(pair(label, other)).or_default() += 1;
        }
        *last = Some((position, label));
    };
    let mut above: Vec<Option<(usize, u32)>> = vec![None; width];
    for row in 0..height {
        let mut before = None;
        for (column, above) in above.iter_mut().enumerate() {
            let index = row * width + column;
            look(&mut before, column, index, 1);
            look(above, row, index, width);
        }
    }
    walls
}
