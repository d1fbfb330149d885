//! How much two local maps look like one place: the full matching of local perceptual maps that decides
//! where stars cannot (section 2.4).

use hssh_metrics::Pose;
use hssh_topology::Isomorphism;
use nalgebra::{Vector2, vector};

use super::turn::turn;
use super::visit::Visit;
use crate::distance::DistanceField;
use crate::grid::{Occupancy, OccupancyGrid};

/// Only this far around the center, in metres, places are compared: corridors look alike.
const REACH: f64 = 8.0;
/// A wall is where the other map has it if it is no farther off than this, in metres.
const TOLERANCE: f64 = 0.15;
/// How many walls seen twice are where they were, if it is the same place…
const FAITHFUL: f64 = 0.85;
/// …and how many neighboring cells of a wall err together.
const CELLS_PER_OBSERVATION: f64 = 12.0;
/// Centers and headings of visits differ a little: steps of the search in metres and radians, and how
/// many to each side.
const STEP: (f64, f64) = (0.15, 0.025);
const STEPS: (i32, i32) = (4, 3);

/// How two local maps compare.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Resemblance {
    /// ln of how much more probable the two maps are if the visits were to one place than if they were
    /// to places that have nothing to do with one another; nats.
    pub log_likelihood_ratio: f64,
    /// Which part of the walls of each that the other has seen are where the other has them.
    pub agreement: f64,
    /// The frame of the second visit in that of the first, where they fit best.
    pub placed: Pose,
}

/// Compares two visits under the hypothesis that they were to one place, `phi` taking the ends of the
/// second star to those of the first. `None` if the maps have seen nothing of each other's walls.
#[must_use]
pub fn resemblance(first: &Visit, second: &Visit, phi: Isomorphism) -> Option<Resemblance> {
    let (one, other) = (Walls::new(first), Walls::new(second));
    let heading = turn(&second.star, &first.star, phi);
    let mut best: Option<Resemblance> = None;
    let (across, around) = STEPS;
    for turn in -around..=around {
        for (row, column) in (-across..=across).flat_map(|row| (-across..=across).map(move |c| (row, c))) {
            let shift = vector![f64::from(column), f64::from(row)] * STEP.0;
            let placed = Pose::new(shift.x, shift.y, heading + f64::from(turn) * STEP.1);
            let found = fit(&one, &other, placed);
            if let Some(found) = found
                && best.is_none_or(|best| found.log_likelihood_ratio > best.log_likelihood_ratio)
            {
                best = Some(found);
            }
        }
    }
    best
}

/// What a local map says about walls, with points in the frame of its place.
struct Walls<'a> {
    grid: &'a OccupancyGrid,
    frame: Pose,
    points: Vec<Vector2<f64>>,
    to_wall: DistanceField,
    /// Which part of what was seen is near a wall: how often a random point would agree.
    chance: f64,
}

impl<'a> Walls<'a> {
    fn new(visit: &'a Visit) -> Self {
        let (grid, frame) = (&visit.grid, visit.frame);
        let lattice = *grid.lattice();
        let to_wall = DistanceField::new(lattice, |index| grid.cells()[index] == Occupancy::Occupied);
        let (mut points, mut near, mut seen) = (Vec::new(), 0.0, 0.0);
        for cell in lattice.cells() {
            let [x, y] = lattice.center(cell);
            let point = frame.between(Pose::new(x, y, 0.0)).translation();
            if point.norm() > REACH || grid.get(cell) == Occupancy::Unknown {
                continue;
            }
            seen += 1.0;
            near += f64::from(u8::from(to_wall.clearance(cell) <= TOLERANCE));
            if grid.get(cell) == Occupancy::Occupied {
                points.push(point);
            }
        }
        let chance = f64::clamp(near / f64::max(seen, 1.0), 0.02, 0.8);
        Walls { grid, frame, points, to_wall, chance }
    }

    /// Of the points, how many lie where this map has seen something, and how many of these near a wall.
    fn agreeing(&self, points: impl Iterator<Item = Vector2<f64>>) -> (f64, f64) {
        let (rotation, origin) = (self.frame.rotation(), self.frame.translation());
        let (mut seen, mut near) = (0.0, 0.0);
        for point in points.filter(|point| point.norm() <= REACH) {
            let at = origin + rotation * point;
            let Some(cell) = self.grid.lattice().cell_at([at.x, at.y]) else { continue };
            let is_near = self.to_wall.clearance(cell) <= TOLERANCE;
            if is_near || self.grid.get(cell) != Occupancy::Unknown {
                seen += 1.0;
                near += f64::from(u8::from(is_near));
            }
        }
        (seen, near)
    }
}

/// Both ways: the walls of each against what the other has seen.
fn fit(one: &Walls<'_>, other: &Walls<'_>, placed: Pose) -> Option<Resemblance> {
    let (rotation, back) = (placed.rotation(), placed.inverse());
    let (rotation_back, shift, shift_back) = (back.rotation(), placed.translation(), back.translation());
    let forward = one.agreeing(other.points.iter().map(|point| shift + rotation * point));
    let backward = other.agreeing(one.points.iter().map(|point| shift_back + rotation_back * point));
    let evidence = |(seen, near): (f64, f64), chance: f64| {
        (near * (FAITHFUL / chance).ln() + (seen - near) * ((1.0 - FAITHFUL) / (1.0 - chance)).ln())
            / CELLS_PER_OBSERVATION
    };
    let seen = forward.0 + backward.0;
    (seen > 0.0).then(|| Resemblance {
        // The two ways tell the same thing twice.
        log_likelihood_ratio: 0.5 * (evidence(forward, one.chance) + evidence(backward, other.chance)),
        agreement: (forward.1 + backward.1) / seen,
        placed,
    })
}
