//! What a laser meets: walls and discs, found by where they are.

use std::collections::BTreeMap;

use hssh_metrics::Pose;
use nalgebra::{Vector2, vector};

/// Side of the squares by which things are found, in metres.
const SQUARE: f64 = 8.0;

/// A wall from one point to another, in metres.
pub(super) type Wall = [[f64; 2]; 2];

/// A pillar, a tree or a leg: its middle and its radius in metres.
#[derive(Clone, Copy, Debug)]
pub(super) struct Disc {
    pub(super) middle: [f64; 2],
    pub(super) radius: f64,
}

/// Everything that stands still.
#[derive(Default)]
pub(super) struct Surroundings {
    walls: Vec<Wall>,
    discs: Vec<Disc>,
    /// Which walls and which discs touch a square.
    squares: BTreeMap<(i64, i64), (Vec<usize>, Vec<usize>)>,
}

impl Surroundings {
    pub(super) fn new(walls: Vec<Wall>, discs: Vec<Disc>) -> Self {
        let mut squares: BTreeMap<(i64, i64), (Vec<usize>, Vec<usize>)> = BTreeMap::new();
        for (index, [a, b]) in walls.iter().enumerate() {
            let steps = (length([*a, *b]) / (SQUARE / 4.0)).ceil().max(1.0);
            for step in 0..=steps as u32 {
                let part = f64::from(step) / steps;
                let at = [0, 1].map(|axis| a[axis] + part * (b[axis] - a[axis]));
                let (walls, _) = squares.entry(square(at)).or_default();
                if walls.last() != Some(&index) {
                    walls.push(index);
                }
            }
        }
        for (index, disc) in discs.iter().enumerate() {
            squares.entry(square(disc.middle)).or_default().1.push(index);
        }
        Surroundings { walls, discs, squares }
    }

    /// The ranges along bearings from a pose, among what stands still and some discs that do not; infinite beyond `reach`
    /// metres.
    pub(super) fn ranges(&self, pose: Pose, bearings: &[f64], reach: f64, moving: &[Disc]) -> Vec<f64> {
        let squares = (reach / SQUARE).ceil() as i64 + 1;
        let (column, row) = square([pose.x, pose.y]);
        let (mut walls, mut discs) = (Vec::new(), moving.to_vec());
        for (_, (of_square, standing)) in self
            .squares
            .range((column - squares, i64::MIN)..=(column + squares, i64::MAX))
            .filter(|((_, other), _)| (other - row).abs() <= squares)
        {
            walls.extend_from_slice(of_square);
            discs.extend(standing.iter().map(|&disc| self.discs[disc]));
        }
        walls.sort_unstable();
        walls.dedup();
        let from = pose.translation();
        let range = |bearing: &f64| {
            let (sin, cos) = (pose.theta + bearing).sin_cos();
            let way = vector![cos, sin];
            let at_walls = walls.iter().filter_map(|&wall| to_wall(from, way, self.walls[wall]));
            let at_discs = discs.iter().filter_map(|disc| to_disc(from, way, disc));
            let nearest = at_walls.chain(at_discs).fold(f64::INFINITY, f64::min);
            if nearest < reach { nearest } else { f64::INFINITY }
        };
        bearings.iter().map(range).collect()
    }
}

fn square([x, y]: [f64; 2]) -> (i64, i64) {
    ((x / SQUARE).floor() as i64, (y / SQUARE).floor() as i64)
}

fn length([a, b]: Wall) -> f64 {
    (b[0] - a[0]).hypot(b[1] - a[1])
}

/// The distance along a ray to a wall.
fn to_wall(from: Vector2<f64>, way: Vector2<f64>, [a, b]: Wall) -> Option<f64> {
    let (along, to_a) = (vector![b[0] - a[0], b[1] - a[1]], vector![a[0], a[1]] - from);
    let determinant = way.perp(&along);
    if determinant.abs() < 1e-12 {
        return None;
    }
    let (range, part) = (to_a.perp(&along) / determinant, to_a.perp(&way) / determinant);
    (range > 0.0 && (-1e-9..=1.0 + 1e-9).contains(&part)).then_some(range)
}

/// The distance along a ray to a disc.
fn to_disc(from: Vector2<f64>, way: Vector2<f64>, disc: &Disc) -> Option<f64> {
    let to = vector![disc.middle[0], disc.middle[1]] - from;
    let (along, aside) = (way.dot(&to), way.perp(&to));
    let half = (disc.radius * disc.radius - aside * aside).max(-1.0);
    (half >= 0.0 && along > half.sqrt()).then(|| along - half.sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ray_ends_at_what_is_nearest() {
        let wall = [[5.0, -1.0], [5.0, 1.0]];
        let far = Disc { middle: [-40.0, 0.0], radius: 0.5 };
        let person = Disc { middle: [0.0, 3.0], radius: 0.25 };
        let surroundings = Surroundings::new(vec![wall, [[9.0, -9.0], [9.0, 9.0]]], vec![far]);
        let bearings = [0.0, 0.5, 90_f64.to_radians(), 180_f64.to_radians()];
        let ranges = |reach: f64| surroundings.ranges(Pose::IDENTITY, &bearings, reach, &[person]);
        let [ahead, aside, left, behind] = ranges(50.0)[..] else { panic!("one range a beam") };
        assert!((ahead - 5.0).abs() < 1e-9 && (aside - 9.0 / 0.5_f64.cos()).abs() < 1e-9, "{ahead} {aside}");
        assert!((left - 2.75).abs() < 1e-9 && (behind - 39.5).abs() < 1e-9, "{left} {behind}");
        assert_eq!(ranges(8.0)[3], f64::INFINITY);
    }
}
