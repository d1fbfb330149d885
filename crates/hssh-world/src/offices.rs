//! Office floors: corridors that meet at right angles in several loops, with rooms hanging off them as dead ends.

use rand::seq::SliceRandom;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use crate::geometry::Point;
use crate::random::thin_out;
use crate::streets::{Crossing, Street, StreetNetwork};
use crate::world::{World, WorldError};

/// What an office floor is like.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct OfficePlan {
    /// Junctions of corridors from north to south.
    pub rows: u32,
    /// Junctions of corridors from west to east.
    pub columns: u32,
    /// Which part of the corridors that no junction needs to be reached is there: each makes one more loop.
    pub loops: f64,
    /// The most doors along one corridor; how many there are is random.
    pub doors: u32,
    /// The mean distance of junctions, in metres; single ones vary by three tenths.
    pub spacing: f64,
}

/// Twelve junctions 16 m apart, four loops or so, up to three doors a corridor.
impl Default for OfficePlan {
    fn default() -> Self {
        OfficePlan { rows: 3, columns: 4, loops: 0.6, doors: 3, spacing: 16.0 }
    }
}

/// How far a room's middle is from its door, in parts of the spacing: less than any door is from a junction, so that
/// rooms around a corner do not overlap.
const ROOM_DEPTH: f64 = 0.12;

/// A connected planar world of corridors and rooms. Places are the junctions, the doors and the rooms.
///
/// Every door leads from its corridor into one room, or into two that face each other; a room has no other door. All
/// bearings are multiples of a right angle, so that places look alike everywhere. The same arguments give the same
/// world.
///
/// # Errors
/// If there are fewer than two junctions, the part of loops is not in \[0, 1\] or the spacing is not positive.
pub fn offices(plan: &OfficePlan, seed: u64) -> Result<World, WorldError> {
    let OfficePlan { rows, columns, loops, doors, spacing } = *plan;
    let junctions = rows as usize * columns as usize;
    if junctions < 2 {
        return Err(WorldError::TooSmall { needed: 2, given: junctions });
    }
    if !(0.0..=1.0).contains(&loops) {
        let range = "between 0 and 1";
        return Err(WorldError::Parameter { parameter: "the part of loops", value: loops, range });
    }
    if !(spacing > 0.0 && spacing.is_finite()) {
        return Err(WorldError::Parameter { parameter: "the spacing", value: spacing, range: "positive" });
    }
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let (eastings, northings) = (lines(columns, spacing, &mut random), lines(rows, spacing, &mut random));
    let junction = |row: u32, column: u32| row as usize * columns as usize + column as usize;
    let mut floor = StreetNetwork::default();
    let mut corridors = Vec::new();
    for row in 0..rows {
        for column in 0..columns {
            let position = Point::new(eastings[column as usize], -northings[row as usize]);
            floor.crossings.push(Crossing { name: format!("junction {row},{column}"), position });
            if column + 1 < columns {
                corridors.push([junction(row, column), junction(row, column + 1)]);
            }
            if row + 1 < rows {
                corridors.push([junction(row, column), junction(row + 1, column)]);
            }
        }
    }
    corridors.shuffle(&mut random);
    for corridor in thin_out(junctions, &corridors, loops) {
        let doors = random.random_range(0..=doors);
        build_corridor(&mut floor, corridor, doors, ROOM_DEPTH * spacing, &mut random);
    }
    floor.to_world()
}

/// Where the lines of a grid are, the first at 0.
fn lines(count: u32, spacing: f64, random: &mut ChaCha8Rng) -> Vec<f64> {
    let mut position = 0.0;
    let next = |_| {
        let here = position;
        position += spacing * random.random_range(0.7..1.3);
        here
    };
    (0..count).map(next).collect()
}

/// Adds a corridor between two junctions, with doors along its middle half and a room or two behind each.
fn build_corridor(
    floor: &mut StreetNetwork,
    [from, to]: [usize; 2],
    doors: u32,
    depth: f64,
    random: &mut ChaCha8Rng,
) {
    let (start, end) = (floor.crossings[from].position, floor.crossings[to].position);
    let (across_x, across_y) = if start.y == end.y { (0.0, depth) } else { (depth, 0.0) };
    let mut before = from;
    for door in 0..doors {
        let jitter = random.random_range(-0.3..0.3);
        let part = 0.25 + 0.5 * (f64::from(door) + 0.5 + jitter) / f64::from(doors);
        let here = Point::new(start.x + part * (end.x - start.x), start.y + part * (end.y - start.y));
        let place = add_place(floor, "door", here);
        join(floor, before, place);
        before = place;
        let sides: &[f64] = [&[1.0][..], &[-1.0], &[1.0, -1.0]][random.random_range(0..3)];
        for side in sides {
            let room =
                add_place(floor, "room", Point::new(here.x + side * across_x, here.y + side * across_y));
            join(floor, place, room);
        }
    }
    join(floor, before, to);
}

fn add_place(floor: &mut StreetNetwork, kind: &str, position: Point) -> usize {
    let index = floor.crossings.len();
    floor.crossings.push(Crossing { name: format!("{kind} {index}"), position });
    index
}

fn join(floor: &mut StreetNetwork, from: usize, to: usize) {
    floor.streets.push(Street { ends: [from, to], bends: Vec::new() });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rooms_are_dead_ends_behind_doors_and_all_bearings_are_right_angles() {
        for seed in 0..30 {
            let world = offices(&OfficePlan::default(), seed).unwrap();
            for place in world.place_ids() {
                let there = world.place(place);
                let neighbors: Vec<_> = world
                    .gateways_of(place)
                    .map(|gateway| &world.place(world.neighbor(gateway).unwrap().place).name)
                    .collect();
                if there.name.starts_with("room") {
                    assert!(neighbors.len() == 1 && neighbors[0].starts_with("door"), "{neighbors:?}");
                } else if there.name.starts_with("door") {
                    let rooms = neighbors.iter().filter(|name| name.starts_with("room")).count();
                    assert!((1..=2).contains(&rooms) && neighbors.len() == rooms + 2, "{neighbors:?}");
                }
                for bearing in &there.bearings {
                    let quarters = bearing / std::f64::consts::FRAC_PI_2;
                    assert!((quarters - quarters.round()).abs() < 1e-9, "{bearing}");
                }
            }
            assert!(world.has_simple_paths());
        }
    }

    /// Rooms and doors add no loop: what is left is the corridors that the spanning tree does not need.
    #[test]
    fn the_plan_decides_how_many_loops_there_are() {
        for (loops, expected) in [(0.0, 0), (0.5, 3), (1.0, 6)] {
            for seed in 0..10 {
                let world = offices(&OfficePlan { loops, ..OfficePlan::default() }, seed).unwrap();
                assert_eq!(world.links().len() + 1 - world.places().len(), expected);
            }
        }
    }

    #[test]
    fn refuses_what_is_no_plan() {
        let error = |plan: OfficePlan| offices(&plan, 0).unwrap_err().to_string();
        let plan = OfficePlan::default();
        assert_eq!(
            error(OfficePlan { rows: 0, ..plan }),
            "a world needs at least 2 place(s), this one has 0"
        );
        assert!(error(OfficePlan { loops: 1.5, ..plan }).starts_with("the part of loops is 1.5"));
        assert!(error(OfficePlan { spacing: f64::NAN, ..plan }).starts_with("the spacing is NaN"));
        assert!(offices(&OfficePlan { doors: 0, ..plan }, 0).is_ok());
    }
}
