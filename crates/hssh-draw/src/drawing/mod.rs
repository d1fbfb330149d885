//! Where the places of a map are drawn and which way the ends of their stars point.

mod directions;
mod relax;
mod schematic;
mod spring;
mod unfold;

use std::collections::BTreeMap;

pub use directions::Bearings;

use hssh_metrics::{Pose, SolveError};
use hssh_topology::{MapOlp, PlaceId, StarId, TopologicalMap};
use nalgebra::{Matrix2, vector};

use crate::graph::ellipse_95;
use crate::svg::Point;

/// A pose for each place of a map and a direction for each end of its stars.
///
/// x points right and y up, angles are radians, counterclockwise from the x axis. The unit of length is
/// the caller's for a measured drawing; in a schematic one a link is about 1 long.
#[derive(Clone, PartialEq, Debug)]
pub struct Drawing {
    /// By place.
    poses: Vec<Pose>,
    /// By oriented local path: the place it belongs to and its direction in that place's frame.
    ends: Vec<(PlaceId, f64)>,
    unit: f64,
    /// By place, where known: m², along the drawing's axes.
    covariances: Vec<Matrix2<f64>>,
    /// The lines that links follow, where known, by the end at which the line begins.
    ways: BTreeMap<MapOlp, Vec<Point>>,
}

/// Why there is no drawing.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
pub enum DrawingError {
    /// Another number of poses than places.
    #[error("{given} poses were given for a map of {places} places: give one for each place, in order")]
    PoseCount {
        /// How many were given.
        given: usize,
        /// How many places there are.
        places: usize,
    },
    /// NaN or infinite.
    #[error("the pose given for place {place} is not finite: {pose:?}")]
    NotFinite {
        /// The place.
        place: PlaceId,
        /// Its pose.
        pose: Pose,
    },
    /// Another number of bearings than ends.
    #[error(
        "star {star} has {ends} ends but {given} bearings: give one for each end, clockwise, `None` if unknown"
    )]
    BearingCount {
        /// The star.
        star: StarId,
        /// How many ends it has.
        ends: usize,
        /// How many bearings were given.
        given: usize,
    },
    /// Bearings that are no clockwise order.
    #[error(
        "the bearings of star {star} do not go around clockwise, each end at a direction of its own: {bearings:?}"
    )]
    NotClockwise {
        /// The star.
        star: StarId,
        /// The bearings.
        bearings: Vec<Option<f64>>,
    },
    /// The pose graph of a schematic drawing has no solution.
    #[error("no schematic drawing: {0}")]
    Solve(#[from] SolveError),
}

impl Drawing {
    /// The drawing with these poses, one for each place in order: position and heading of the place's frame.
    ///
    /// # Errors
    /// If there are more or fewer poses than places, if one is not finite, or if bearings contradict the
    /// clockwise order of their star.
    pub fn measured(
        map: &TopologicalMap,
        poses: Vec<Pose>,
        bearings: &Bearings,
    ) -> Result<Self, DrawingError> {
        let (given, places) = (poses.len(), map.place_count() as usize);
        if given != places {
            return Err(DrawingError::PoseCount { given, places });
        }
        for (place, &pose) in map.places().zip(&poses) {
            if !pose.is_finite() {
                return Err(DrawingError::NotFinite { place, pose });
            }
        }
        let ends = directions::of_map(map, bearings)?;
        let unit = median_link_length(map, &poses);
        Ok(Drawing { poses, ends, unit, covariances: Vec::new(), ways: BTreeMap::new() })
    }

    /// A drawing from the map alone: links about 1 long, paths as straight as they can be, places apart.
    ///
    /// Each link says that the far place lies one unit along the near end's direction, looking so that its
    /// own end points back; all of them together are a pose graph, with the first place held at the origin.
    /// If its solution puts places on each other, or does not exist because the map fits no plane, the
    /// places are moved apart.
    ///
    /// # Errors
    /// If bearings contradict the clockwise order of their star.
    pub fn schematic(map: &TopologicalMap, bearings: &Bearings) -> Result<Self, DrawingError> {
        let ends = directions::of_map(map, bearings)?;
        let poses = schematic::poses(map, &ends)?;
        Ok(Drawing { poses, ends, unit: 1.0, covariances: Vec::new(), ways: BTreeMap::new() })
    }

    /// The same drawing with the covariances of the places' positions, in the order of the places: drawn as
    /// ellipses that hold the true position with a probability of 95 %.
    #[must_use]
    pub fn with_covariances(self, covariances: Vec<Matrix2<f64>>) -> Self {
        Drawing { covariances, ..self }
    }

    /// The same drawing with links that follow given lines, as a robot drove them: each from the place of its first end to that of its
    /// second one, in the unit and frame of the poses. Links without a line are curves from place to place.
    #[must_use]
    pub fn with_ways(self, ways: impl IntoIterator<Item = ([MapOlp; 2], Vec<[f64; 2]>)>) -> Self {
        let ways = ways.into_iter().flat_map(|([from, to], line)| {
            let line: Vec<Point> = line.into_iter().map(Point::from).collect();
            let back = line.iter().rev().copied().collect();
            [(from, line), (to, back)]
        });
        Drawing { ways: ways.collect(), ..self }
    }

    /// The line that the link of an end follows away from its place, if it is known.
    pub(crate) fn way(&self, olp: MapOlp) -> Option<&[Point]> {
        self.ways.get(&olp).map(Vec::as_slice)
    }

    /// The corners of the ellipse that holds a place with a probability of 95 %, if it is known and there is one.
    pub(crate) fn ellipse(&self, place: PlaceId) -> Option<Vec<Point>> {
        let around = ellipse_95(self.covariances.get(place.index())?)?;
        Some(around.into_iter().map(|offset| self.position(place) + offset).collect())
    }

    /// Position and heading of a place.
    ///
    /// # Panics
    /// If the place is not in the map that the drawing was made for.
    #[must_use]
    pub fn pose(&self, place: PlaceId) -> Pose {
        self.poses[place.index()]
    }

    /// The direction in which an end of a star leaves its place.
    ///
    /// # Panics
    /// If the end is not in the map that the drawing was made for.
    #[must_use]
    pub fn direction(&self, olp: MapOlp) -> f64 {
        let (place, direction) = self.ends[olp.index()];
        self.pose(place).theta + direction
    }

    /// How long a typical link is: the scale for everything drawn around a place.
    #[must_use]
    pub fn unit(&self) -> f64 {
        self.unit
    }

    pub(crate) fn position(&self, place: PlaceId) -> Point {
        self.pose(place).translation()
    }

    pub(crate) fn position_of_end(&self, olp: MapOlp) -> Point {
        self.position(self.ends[olp.index()].0)
    }
}

/// The median distance of linked places; 1 if no two linked places are apart.
fn median_link_length(map: &TopologicalMap, poses: &[Pose]) -> f64 {
    let at = |olp| {
        let pose = poses[map.place(olp).index()];
        vector![pose.x, pose.y]
    };
    let mut lengths: Vec<f64> = map.links().map(|(a, b)| (at(a) - at(b)).norm()).collect();
    lengths.retain(|&length| length > 0.0);
    lengths.sort_by(f64::total_cmp);
    lengths.get(lengths.len() / 2).copied().unwrap_or(1.0)
}
