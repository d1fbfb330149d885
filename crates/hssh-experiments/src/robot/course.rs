//! Courses: where the robot drives, and what the true places are there.

use std::error::Error;
use std::path::Path;

use hssh_local::{OccupancyGrid, PlaceOptions, read_map};
use hssh_world::robot::RobotOptions;
use hssh_world::{Floor, Point, floor_plan};

use crate::grids::known_places;

/// Metres per cell of the floor plans.
const RESOLUTION: f64 = 0.1;
/// On the map of the ACES floor, ways out lead on so far, as along logs, and corridors are so wide, in metres:
/// lobbies end before, and niches and doors are narrower.
const ACES_DEPTH: f64 = 8.0;
const ACES_NARROWEST: f64 = 0.8;

/// A place to drive.
pub(super) struct Course {
    pub(super) name: String,
    pub(super) grid: OccupancyGrid,
    /// The centers of the true places.
    pub(super) places: Vec<Point>,
    /// Where the robot starts; at the first place of the map if not given.
    pub(super) start: Option<[f64; 2]>,
    /// How the robot drives.
    pub(super) robot: RobotOptions,
}

impl Course {
    /// A floor that was built of corridors.
    pub(super) fn built(floor: &Floor) -> Result<Self, Box<dyn Error>> {
        Ok(Course {
            name: floor.name.to_owned(),
            grid: floor_plan(&floor.world, floor.width, RESOLUTION)?,
            places: floor.world.places().iter().map(|place| place.position).collect(),
            start: None,
            robot: RobotOptions::default(),
        })
    }

    /// The ACES floor as a laser drew it, with its clutter; its nine places are those of the topology made by hand.
    pub(super) fn aces(data: &Path) -> Result<Self, Box<dyn Error>> {
        let places: Vec<[f64; 2]> = known_places(data)?.iter().map(|place| place.point).collect();
        let mut map = PlaceOptions::default();
        map.skeleton.shallowest_branch = ACES_DEPTH;
        map.skeleton.narrowest_passage = ACES_NARROWEST;
        Ok(Course {
            name: "aces".to_owned(),
            grid: read_map(&data.join("gridmap/aces.yaml"))?,
            start: places.first().copied(),
            places: places.into_iter().map(|[x, y]| Point::new(x, y)).collect(),
            robot: RobotOptions { places: map, ..RobotOptions::default() },
        })
    }

    /// The true place nearest to a point, and how far off its center is.
    pub(super) fn nearest(&self, x: f64, y: f64) -> Option<(usize, f64)> {
        let here = Point::new(x, y);
        let off = self.places.iter().map(|place| place.distance_to(here)).enumerate();
        off.min_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// The true place around a point.
    pub(super) fn place_at(&self, x: f64, y: f64) -> Option<usize> {
        /// A place reaches so far, in metres.
        const REACH: f64 = 4.8;
        self.nearest(x, y).filter(|(_, off)| *off < REACH).map(|(place, _)| place)
    }
}
