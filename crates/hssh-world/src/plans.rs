//! Seven floors with loops: worlds that are fit to be built, driven through and mapped again.

use crate::geometry::Point;
use crate::grid::grid;
use crate::offices::{OfficePlan, offices};
use crate::random::random_planar;
use crate::streets::{Crossing, Street, StreetNetwork};
use crate::world::World;

/// A floor.
#[derive(Clone, PartialEq, Debug)]
pub struct Floor {
    /// What people call it.
    pub name: &'static str,
    /// Its places and corridors.
    pub world: World,
    /// How wide the corridors are, in metres.
    pub width: f64,
}

/// How wide the corridors of [`floors`] are, in metres.
const WIDTH: f64 = 2.4;
/// Seeds whose worlds are as [`floors`] says.
const OFFICE: u64 = 65;
const RANDOM: u64 = 142_781;

/// A ring of four corners, the same with two spurs, a figure eight, grids of three and four rows, an office floor, and
/// random corridors.
///
/// Every place is a crossing, a clear turn or a dead end, and places are some 11 m apart or more.
#[must_use]
pub fn floors() -> Vec<Floor> {
    let square = |rows| grid(rows, rows, 14.0).expect("a grid with rows and columns is a world");
    let office = OfficePlan { rows: 3, columns: 4, loops: 0.6, doors: 0, spacing: 16.0 };
    [
        (
            "ring",
            network(
                &[(0.0, 0.0), (26.0, 0.0), (26.0, -15.0), (0.0, -15.0)],
                &[[0, 1], [1, 2], [2, 3], [3, 0]],
            ),
        ),
        (
            "spurs",
            network(
                &[
                    (0.0, 0.0),
                    (13.0, 0.0),
                    (26.0, 0.0),
                    (26.0, -15.0),
                    (0.0, -15.0),
                    (13.0, 14.0),
                    (40.0, -15.0),
                ],
                &[[0, 1], [1, 2], [2, 3], [3, 4], [4, 0], [1, 5], [3, 6]],
            ),
        ),
        ("figure-eight", figure_eight()),
        ("grid-3x3", square(3)),
        ("grid-4x4", square(4)),
        ("office", offices(&office, OFFICE).expect("twelve junctions make a world")),
        ("random-planar", random_planar(7, 0.4, 24.0, RANDOM).expect("seven places make a world")),
    ]
    .into_iter()
    .map(|(name, world)| Floor { name, world, width: WIDTH })
    .collect()
}

/// Two loops of corridors that meet at one crossing.
fn figure_eight() -> World {
    let corners =
        [(0.0, 0.0), (18.0, 0.0), (18.0, 14.0), (0.0, 14.0), (-18.0, 0.0), (-18.0, -14.0), (0.0, -14.0)];
    network(&corners, &[[0, 1], [1, 2], [2, 3], [3, 0], [0, 4], [4, 5], [5, 6], [6, 0]])
}

/// Straight corridors between points.
fn network(points: &[(f64, f64)], corridors: &[[usize; 2]]) -> World {
    let crossing = |(index, &(x, y)): (usize, &(f64, f64))| Crossing {
        name: index.to_string(),
        position: Point::new(x, y),
    };
    let street = |&ends: &[usize; 2]| Street { ends, bends: Vec::new() };
    StreetNetwork {
        crossings: points.iter().enumerate().map(crossing).collect(),
        streets: corridors.iter().map(street).collect(),
    }
    .to_world()
    .expect("the corridors of a corner leave it by different bearings")
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;
    use crate::geometry::wrap;
    use crate::world::PlaceId;

    /// How far apart places are at least, in metres.
    const APART: f64 = 11.0;

    #[test]
    fn all_floors_are_fit_and_have_loops() {
        let floors = floors();
        let sizes: Vec<_> = floors
            .iter()
            .map(|floor| (floor.name, floor.world.places().len(), floor.world.links().len()))
            .collect();
        assert_eq!(
            sizes[..5],
            [
                ("ring", 4, 4),
                ("spurs", 7, 7),
                ("figure-eight", 7, 8),
                ("grid-3x3", 9, 12),
                ("grid-4x4", 16, 24)
            ]
        );
        for floor in floors {
            assert!(is_fit(&floor.world), "{}", floor.name);
        }
    }

    /// Whether a world leaves no room for opinions of what its places and paths are.
    fn is_fit(world: &World) -> bool {
        world.has_simple_paths()
            && world.links().len() >= world.places().len()
            && world.place_ids().all(|place| is_apart(world, place) && is_clear_cut(world, place))
    }

    /// Whether other places, and corridors between them, are far enough away.
    fn is_apart(world: &World, place: PlaceId) -> bool {
        let here = world.place(place).position;
        let others = world.place_ids().filter(|&other| other != place);
        let mut points: Vec<Point> = others.map(|other| world.place(other).position).collect();
        for link in world.links() {
            let ends = link.ends.map(|end| end.place);
            if !ends.contains(&place) {
                let [from, to] = ends.map(|end| world.place(end).position);
                points.push(Point::new((from.x + to.x) / 2.0, (from.y + to.y) / 2.0));
            }
        }
        points.into_iter().all(|point| here.distance_to(point) >= APART)
    }

    /// Whether a place has a choice, a clear turn or an end, ways that are well apart, and each two of them either
    /// continue one another or clearly do not.
    fn is_clear_cut(world: &World, place: PlaceId) -> bool {
        let bearings: Vec<f64> = world
            .gateways_of(place)
            .map(|gateway| world.place(place).bearings[gateway.olp.index()])
            .collect();
        let mut turns = (0..bearings.len())
            .flat_map(|a| (0..a).map(move |b| (a, b)))
            .map(|(a, b)| (PI - wrap(bearings[a] - bearings[b]).abs()).to_degrees());
        let is_clear = |turn: f64| (turn < 20.0 && bearings.len() > 2) || (50.0..130.0).contains(&turn);
        !bearings.is_empty() && turns.all(is_clear)
    }
}
