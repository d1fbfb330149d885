//! Floors to be driven through: those that every experiment has, some with parts that repeat, and random ones.

use std::error::Error;

use hssh_world::{
    Crossing, OfficePlan, Point, Street, StreetNetwork, World, floors, grid, offices, random_planar,
};

/// How wide corridors are, in metres.
const WIDTH: f64 = 2.4;

/// A floor.
pub(super) struct Ground {
    pub(super) world: World,
    pub(super) width: f64,
}

/// A floor, or why it cannot be built.
type Made = Result<World, Box<dyn Error>>;

/// How a floor is made, and how another one for each seed.
type Plan = fn() -> Made;
type RandomPlan = fn(u64) -> Made;

/// Floors with parts that look the same, and how they are made.
const REPEATED: [(&str, Plan); 4] =
    [("ladder", ladder), ("wings", wings), ("offices-alike", offices_alike), ("halls-alike", halls_alike)];
/// Floors that are another one for each seed.
const RANDOM: [(&str, RandomPlan); 2] = [("any-office", any_office), ("any-planar", any_planar)];

/// The names of all kinds of floors.
pub(super) fn names() -> Vec<String> {
    let built = floors().into_iter().map(|floor| floor.name.to_owned());
    let repeated = REPEATED.iter().map(|(name, _)| (*name).to_owned());
    let random = RANDOM.iter().map(|(name, _)| (*name).to_owned());
    built.chain(repeated).chain(random).collect()
}

/// The floor of that name; the seed counts for random ones only.
pub(super) fn ground(name: &str, seed: u64) -> Result<Ground, Box<dyn Error>> {
    if let Some(floor) = floors().into_iter().find(|floor| floor.name == name) {
        return Ok(Ground { world: floor.world, width: floor.width });
    }
    let repeated = REPEATED.iter().find(|(known, _)| *known == name).map(|(_, make)| make());
    let random = || RANDOM.iter().find(|(known, _)| *known == name).map(|(_, make)| make(seed));
    let world = repeated.or_else(random).ok_or("there is no such floor")??;
    Ok(Ground { world, width: WIDTH })
}

/// Two corridors with six rungs between them, all alike.
fn ladder() -> Made {
    Ok(grid(2, 6, 13.0)?)
}

/// A corridor on which two wings lie, each a ring with a spur, which look the same.
fn wings() -> Made {
    let wing = |x: f64| [(x, 0.0), (x + 18.0, 0.0), (x + 18.0, 14.0), (x, 14.0), (x, 26.0)];
    let points: Vec<(f64, f64)> =
        [(-13.0, 0.0)].into_iter().chain(wing(0.0)).chain(wing(36.0)).chain([(67.0, 0.0)]).collect();
    let corridors = [
        [0, 1],
        [1, 2],
        [2, 3],
        [3, 4],
        [4, 1],
        [4, 5],
        [2, 6],
        [6, 7],
        [7, 8],
        [8, 9],
        [9, 6],
        [9, 10],
        [7, 11],
    ];
    network(&points, &corridors)
}

/// A ring on whose long side lie four offices with doors all alike.
fn offices_alike() -> Made {
    let mut points: Vec<(f64, f64)> = (0..6).map(|door| (f64::from(door) * 12.0, 0.0)).collect();
    points.extend((1..5).map(|door| (f64::from(door) * 12.0, -11.0)));
    points.extend([(60.0, 15.0), (0.0, 15.0)]);
    let along = (0..5).map(|door| [door, door + 1]);
    let into = (1..5).map(|door| [door, door + 5]);
    let corridors: Vec<[usize; 2]> = along.chain(into).chain([[5, 10], [10, 11], [11, 0]]).collect();
    network(&points, &corridors)
}

/// Three square rings in a row, joined by corridors as long as their sides: turned by right angles all is alike.
fn halls_alike() -> Made {
    let mut points = Vec::new();
    let mut corridors = Vec::new();
    for hall in 0..3_usize {
        let (x, first) = (28.0 * hall as f64, 4 * hall);
        points.extend([(x, 0.0), (x + 14.0, 0.0), (x + 14.0, 14.0), (x, 14.0)]);
        corridors.extend([[0, 1], [1, 2], [2, 3], [3, 0]].map(|ends| ends.map(|corner| first + corner)));
        corridors.extend((hall > 0).then(|| [first - 3, first]));
    }
    network(&points, &corridors)
}

fn any_office(seed: u64) -> Made {
    let plan = OfficePlan { rows: 3, columns: 3, loops: 0.6, doors: 0, spacing: 16.0 };
    Ok(offices(&plan, seed)?)
}

fn any_planar(seed: u64) -> Made {
    Ok(random_planar(7, 0.4, 24.0, seed)?)
}

/// Straight corridors between points.
fn network(points: &[(f64, f64)], corridors: &[[usize; 2]]) -> Made {
    let crossing = |(index, &(x, y)): (usize, &(f64, f64))| Crossing {
        name: index.to_string(),
        position: Point::new(x, y),
    };
    let street = |&ends: &[usize; 2]| Street { ends, bends: Vec::new() };
    let crossings = points.iter().enumerate().map(crossing).collect();
    let network = StreetNetwork { crossings, streets: corridors.iter().map(street).collect() };
    Ok(network.to_world()?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_floor_can_be_built() {
        for name in names() {
            let ground = ground(&name, 1).unwrap();
            assert!(ground.world.places().len() >= 4, "{name}");
        }
    }

    #[test]
    fn unknown_floors_are_refused() {
        assert!(ground("cellar", 1).is_err());
    }
}
