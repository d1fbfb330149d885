//! The outlines of regions as polygons.

use std::collections::BTreeMap;

use super::flood::NO_PIECE;
use crate::grid::Lattice;
use crate::skeleton::distance;

/// The outline of a region: closed rings in metres, without the first corner repeated. Rings around the region run
/// counterclockwise, the largest first; those around what is cut out of it run clockwise.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Outline {
    /// The rings around the region.
    pub around: Vec<Vec<[f64; 2]>>,
    /// The rings around holes in it.
    pub holes: Vec<Vec<[f64; 2]>>,
}

/// A corner between cells: column and row of its upper right cell.
type Corner = [u32; 2];

/// The outlines of all regions, straightened where they move by no more than `off` metres.
pub(super) fn outlines(labels: &[u32], lattice: &Lattice, regions: usize, off: f64) -> Vec<Outline> {
    let mut outlines = vec![Outline::default(); regions];
    for (outline, sides) in outlines.iter_mut().zip(sides(labels, lattice, regions)) {
        for ring in rings(sides) {
            let points: Vec<[f64; 2]> =
                ring.iter().map(|corner| lattice.point(corner.map(f64::from))).collect();
            let area = signed_area(&points);
            let ring = straightened_apart(points, off);
            if ring.len() > 2 {
                if area > 0.0 { outline.around.push(ring) } else { outline.holes.push(ring) }
            }
        }
        outline.around.sort_by(|a, b| signed_area(b).total_cmp(&signed_area(a)));
    }
    outlines
}

/// The sides of cells that part each region from the rest, each with the region to its left.
fn sides(labels: &[u32], lattice: &Lattice, regions: usize) -> Vec<BTreeMap<Corner, Vec<Corner>>> {
    let (width, height) = (lattice.width(), lattice.height());
    let mut sides: Vec<BTreeMap<Corner, Vec<Corner>>> = vec![BTreeMap::new(); regions];
    let label = |column: u32, row: u32| {
        let is_on = column < width && row < height;
        if is_on { labels[row as usize * width as usize + column as usize] } else { NO_PIECE }
    };
    for row in 0..height {
        for column in 0..width {
            let here = label(column, row);
            if here == NO_PIECE {
                continue;
            }
            let (right, up) = (column + 1, row + 1);
            for (near, from, to) in [
                (label(column, row.wrapping_sub(1)), [column, row], [right, row]),
                (label(right, row), [right, row], [right, up]),
                (label(column, up), [right, up], [column, up]),
                (label(column.wrapping_sub(1), row), [column, up], [column, row]),
            ] {
                if near != here {
                    sides[here as usize].entry(from).or_default().push(to);
                }
            }
        }
    }
    sides
}

/// Sides joined to closed rings; where two rings touch in a corner, each turns left, so that cells that only touch in a
/// corner are apart.
fn rings(mut sides: BTreeMap<Corner, Vec<Corner>>) -> Vec<Vec<Corner>> {
    let mut rings = Vec::new();
    while let Some((&start, _)) = sides.first_key_value() {
        let mut ring = vec![start];
        let mut before: Option<Corner> = None;
        let mut here = start;
        while let Some(choices) = sides.get_mut(&here) {
            let at = match before {
                Some(before) if choices.len() > 1 => {
                    choices.iter().position(|&next| is_left_turn(before, here, next)).unwrap_or(0)
                }
                _ => 0,
            };
            let next = choices.swap_remove(at);
            if choices.is_empty() {
                sides.remove(&here);
            }
            if next == start {
                break;
            }
            ring.push(next);
            (before, here) = (Some(here), next);
        }
        rings.extend(without_touches(ring));
    }
    rings
}

/// A ring that comes to a corner twice as rings that do not: what it encloses between two cells that touch there is a hole.
fn without_touches(ring: Vec<Corner>) -> Vec<Vec<Corner>> {
    let mut rings = Vec::new();
    let mut open: Vec<Corner> = Vec::with_capacity(ring.len());
    let mut places: BTreeMap<Corner, usize> = BTreeMap::new();
    for corner in ring {
        if let Some(&place) = places.get(&corner) {
            let inner = open.split_off(place);
            for corner in &inner {
                places.remove(corner);
            }
            rings.push(inner);
        }
        places.insert(corner, open.len());
        open.push(corner);
    }
    rings.push(open);
    rings
}

fn is_left_turn(before: Corner, here: Corner, next: Corner) -> bool {
    let step = |a: Corner, b: Corner| [0, 1].map(|axis| i64::from(b[axis]) - i64::from(a[axis]));
    let (come, go) = (step(before, here), step(here, next));
    come[0] * go[1] - come[1] * go[0] > 0
}

fn signed_area(ring: &[[f64; 2]]) -> f64 {
    let twice = (0..ring.len()).map(|at| {
        let ([ax, ay], [bx, by]) = (ring[at], ring[(at + 1) % ring.len()]);
        ax * by - ay * bx
    });
    twice.sum::<f64>() / 2.0
}

/// A ring that does not touch itself, with fewer corners: straightened as far as it still does not.
fn straightened_apart(ring: Vec<[f64; 2]>, mut off: f64) -> Vec<[f64; 2]> {
    const TRIES: usize = 4;
    for _ in 0..TRIES {
        let straight = straightened(ring.clone(), off);
        if !touches_itself(&straight) {
            return straight;
        }
        off /= 2.0;
    }
    straightened(ring, 0.0)
}

/// Whether two sides of a ring that do not follow one another meet. They are gone through from left to right, so that only those are compared
/// that lie above one another.
fn touches_itself(ring: &[[f64; 2]]) -> bool {
    let count = ring.len();
    let side = |at: usize| [ring[at], ring[(at + 1) % count]];
    let (left, right) =
        (|at: usize| side(at)[0][0].min(side(at)[1][0]), |at: usize| side(at)[0][0].max(side(at)[1][0]));
    let follow = |one: usize, other: usize| (one + 1) % count == other || (other + 1) % count == one;
    let mut order: Vec<usize> = (0..count).collect();
    order.sort_by(|&one, &other| left(one).total_cmp(&left(other)));
    order.iter().enumerate().any(|(place, &one)| {
        let above = order[place + 1..].iter().take_while(|&&other| left(other) <= right(one));
        above.filter(|&&other| !follow(one, other)).any(|&other| meet(side(one), side(other)))
    })
}

/// Whether two lines have a point in common.
fn meet([a, b]: [[f64; 2]; 2], [c, d]: [[f64; 2]; 2]) -> bool {
    /// Less is what is lost of a product of lengths.
    const NOTHING: f64 = 1e-9;
    let is_apart = |axis: usize| {
        a[axis].max(b[axis]) < c[axis].min(d[axis]) || c[axis].max(d[axis]) < a[axis].min(b[axis])
    };
    if is_apart(0) || is_apart(1) {
        return false;
    }
    let side =
        |a: [f64; 2], b: [f64; 2], p: [f64; 2]| (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
    let is_between =
        |one: f64, other: f64| !(one > NOTHING && other > NOTHING || one < -NOTHING && other < -NOTHING);
    is_between(side(a, b, c), side(a, b, d)) && is_between(side(c, d, a), side(c, d, b))
}

/// A ring with fewer corners: between the two that are farthest apart, as Douglas and Peucker have it.
fn straightened(mut ring: Vec<[f64; 2]>, off: f64) -> Vec<[f64; 2]> {
    let first = ring[0];
    let far = |&at: &usize| distance(first, ring[at]);
    let Some(split) = (1..ring.len()).max_by(|a, b| far(a).total_cmp(&far(b))) else { return ring };
    ring.push(first);
    let mut straight = vec![first];
    straighten(&ring[..=split], off, &mut straight);
    straighten(&ring[split..], off, &mut straight);
    straight.pop();
    straight
}

/// Adds what is left of a line behind its first corner.
fn straighten(line: &[[f64; 2]], off: f64, straight: &mut Vec<[f64; 2]>) {
    let [first, .., last] = *line else { return };
    let length = distance(first, last).max(f64::MIN_POSITIVE);
    let away = |point: [f64; 2]| {
        ((last[0] - first[0]) * (point[1] - first[1]) - (last[1] - first[1]) * (point[0] - first[0])).abs()
            / length
    };
    let inner = (1..line.len() - 1).max_by(|&a, &b| away(line[a]).total_cmp(&away(line[b])));
    match inner {
        Some(at) if away(line[at]) > off => {
            straighten(&line[..=at], off, straight);
            straighten(&line[at..], off, straight);
        }
        _ => straight.push(last),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// However coarsely a ring is straightened, it does not come to touch itself.
    #[test]
    fn what_is_straightened_stays_apart() {
        let ring = |points: &[[f64; 2]]| touches_itself(points);
        assert!(!ring(&[[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]]));
        assert!(ring(&[[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [2.0, 0.0], [0.0, 4.0]]), "a corner on a side");
        assert!(ring(&[[0.0, 0.0], [4.0, 4.0], [4.0, 0.0], [0.0, 4.0]]), "two sides that cross");
        let spiral = vec![
            [0.0, 0.0],
            [9.0, 0.0],
            [9.0, 4.0],
            [5.0, 4.0],
            [5.0, 1.0],
            [4.0, 1.0],
            [4.0, 4.0],
            [0.0, 4.0],
        ];
        let straight = straightened_apart(spiral.clone(), 3.5);
        assert!(!touches_itself(&straight) && straight.len() >= 4, "{straight:?}");
        assert!(!touches_itself(&straightened_apart(spiral, 0.0)));
    }

    /// Cells around a hole that the last two close off only by touching in a corner.
    #[test]
    fn no_ring_touches_itself() {
        let lattice = Lattice::new(3, 3, 1.0, [0.0, 0.0]).unwrap();
        let is_in = |column: u32, row: u32| (column, row) != (1, 1) && (column, row) != (2, 2);
        let labels: Vec<u32> =
            lattice.cells().map(|cell| if is_in(cell.column, cell.row) { 0 } else { NO_PIECE }).collect();
        let [outline] = &outlines(&labels, &lattice, 1, 0.0)[..] else { panic!("one region") };
        let areas = |rings: &[Vec<[f64; 2]>]| rings.iter().map(|ring| signed_area(ring)).collect::<Vec<_>>();
        assert_eq!((areas(&outline.around), areas(&outline.holes)), (vec![8.0], vec![-1.0]));
    }

    /// A ring of cells around a hole, and a cell that touches it in a corner.
    #[test]
    fn a_hole_runs_the_other_way_and_a_corner_joins_nothing() {
        let lattice = Lattice::new(5, 5, 0.5, [1.0, 2.0]).unwrap();
        let is_in = |column: u32, row: u32| {
            (column < 3 && row < 3 && (column, row) != (1, 1)) || (column, row) == (3, 3)
        };
        let labels: Vec<u32> =
            lattice.cells().map(|cell| if is_in(cell.column, cell.row) { 0 } else { NO_PIECE }).collect();
        let [outline] = &outlines(&labels, &lattice, 1, 0.0)[..] else { panic!("one region") };
        let areas = |rings: &[Vec<[f64; 2]>]| rings.iter().map(|ring| signed_area(ring)).collect::<Vec<_>>();
        assert_eq!(areas(&outline.around), [2.25, 0.25]);
        assert_eq!(areas(&outline.holes), [-0.25]);
        assert_eq!(outline.around[0].len(), 4);
    }
}
