//! What a robot perceives of the small-scale space around it, in its own frame (section 2.2.1).

use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// A percept. Points and bearings are in the robot's frame: x ahead, y to the left, metres and radians
/// counterclockwise.
#[derive(Clone, PartialEq, Debug, Default)]
pub struct Percept {
    /// Metres to what is in the way, at equal angles all around, counterclockwise from straight ahead;
    /// infinite where nothing is in sight.
    pub ranges: Vec<f64>,
    /// The place-neighborhood that the robot is in; none in a corridor.
    pub neighborhood: Option<Vicinity>,
}

/// A place-neighborhood as the robot's local perceptual model shows it.
#[derive(Clone, PartialEq, Debug)]
pub struct Vicinity {
    /// Tells this neighborhood from the one before and the one after: neighborhoods are counted as the
    /// robot comes into them.
    pub number: u32,
    /// Its center, where it is known.
    pub center: Option<[f64; 2]>,
    /// The ways out.
    pub gateways: Vec<Exit>,
}

/// A gateway as the robot perceives it.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Exit {
    /// Its middle.
    pub position: [f64; 2],
    /// The outward direction.
    pub bearing: f64,
    /// How wide it is.
    pub width: f64,
}

impl Percept {
    /// The least distance to anything in the left half of the plane, not counting what is nearly ahead or
    /// behind.
    #[must_use]
    pub fn left(&self) -> f64 {
        self.beside(1.0)
    }

    /// As [`Percept::left`], in the right half.
    #[must_use]
    pub fn right(&self) -> f64 {
        self.beside(-1.0)
    }

    /// How far a disc of `radius` gets straight ahead before its center is beside an obstacle that is in its way.
    #[must_use]
    pub fn ahead(&self, radius: f64) -> f64 {
        let in_the_way = self.obstacles().filter(|&[x, y]| x > 0.0 && y.abs() <= radius);
        in_the_way.map(|[x, _]| x).fold(f64::INFINITY, f64::min)
    }

    fn beside(&self, side: f64) -> f64 {
        /// Sixty degrees about a right angle.
        const SECTOR: f64 = PI / 6.0;
        let ranges = (0..self.ranges.len()).filter(|&index| {
            let off = self.bearing(index) * side - FRAC_PI_2;
            off.abs() <= SECTOR
        });
        ranges.map(|index| self.ranges[index]).fold(f64::INFINITY, f64::min)
    }

    /// The bearing of a range, in (−π, π].
    fn bearing(&self, index: usize) -> f64 {
        let turned = TAU * index as f64 / self.ranges.len() as f64;
        if turned > PI { turned - TAU } else { turned }
    }

    /// The points that are in the way, counterclockwise.
    pub(super) fn obstacles(&self) -> impl Iterator<Item = [f64; 2]> + '_ {
        let in_sight = self.ranges.iter().enumerate().filter(|(_, range)| range.is_finite());
        in_sight.map(|(index, range)| {
            let (sin, cos) = self.bearing(index).sin_cos();
            [range * cos, range * sin]
        })
    }
}
