//! Small-scale space: laser logs, occupancy grids, gateways and stars; from a log to an exploration.
//!
//! The places of a grid map, here of two corridors that cross:
//!
//! ```
//! use hssh_local::{Lattice, Occupancy, OccupancyGrid, PlaceGraph, PlaceOptions};
//!
//! // 2 m wide and 20 m long, in cells of 0.1 m; everything else is wall.
//! let lattice = Lattice::new(220, 220, 0.1, [0.0, 0.0])?;
//! let mut grid = OccupancyGrid::filled(lattice, Occupancy::Occupied);
//! let is_wide = |index: u32| (100..120).contains(&index);
//! let is_long = |index: u32| (10..210).contains(&index);
//! for cell in lattice.cells() {
//!     if is_wide(cell.row) && is_long(cell.column) || is_long(cell.row) && is_wide(cell.column) {
//!         grid.set(cell, Occupancy::Free);
//!     }
//! }
//! let graph = PlaceGraph::new(&grid, &PlaceOptions::default())?;
//! let ways: Vec<usize> = graph.places.iter().map(|place| place.star.star.gateways().count()).collect();
//! assert_eq!((ways.len(), ways.iter().max()), (5, Some(&4))); // the crossing, and four dead ends
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod carmen;
mod closing;
mod disjoint_sets;
mod distance;
mod geodesic;
mod global_map;
mod grid;
mod lines;
mod local_map;
mod map_server;
mod matching;
mod place;
mod progress;
mod recording;
mod region;
mod roadmap;
mod route;
mod scan;
mod skeleton;
mod survey;

pub use carmen::{
    GrowingLog, LaserKind, LaserLog, LaserMessage, LaserMount, LaserTurn, LaserView, LogError, LogPosition,
    LogReader, LogWarning, LoggedScan, Message, MessageProblem,
};
pub use closing::{Alike, ClosedTrack, ClosingError, ClosingOptions, Closure, close_loops};
pub use distance::DistanceField;
pub use global_map::{Stay, building_map, global_map, global_poses, mean_wall_distance, stays, visit_frames};
pub use grid::{Cell, CellLine, GridError, Lattice, LatticeError, Occupancy, OccupancyGrid};
pub use lines::LineEnds;
pub use local_map::{LocalMap, LocalMapOptions};
pub use map_server::{
    MapError, encode_png, read_floor_plan, read_map, read_map_with_remarks, write_map, write_png,
};
pub use matching::{
    GrowingTrack, MatchOptions, MotionNoise, Slip, TimedScan, Track, TrackedScan, Tracker,
    odometry_from_scans, track, track_calibrated,
};
pub use place::{
    DoorOptions, Gateway, GatewayOptions, GridPlace, LocalStar, Neighborhood, NeighborhoodError, OpenEnd,
    PlaceConnection, PlaceGraph, PlaceGraphError, PlaceKind, PlaceNumber, PlaceOptions, Sighting, doors,
    hidden_area, neighborhood, sight,
};
pub use progress::Reply;
pub use recording::{RecordedScan, Recording, TimedPose};
pub use region::{
    CutOptions, DoorwayOptions, KindOptions, LeafOptions, Outline, Passage, Region, RegionKind, RegionMap,
    RegionNumber, RegionOptions, without_rims,
};
pub use roadmap::{
    Connection, RegionPlace, RoadNode, RoadNodeKind, RoadNodeNumber, Roadmap, RoadmapOptions, Way,
};
pub use route::{RouteOptions, driven_line};
pub use scan::{Scan, scan_around};
pub use skeleton::{
    AxisPoint, EdgeEnd, FreeSpace, Skeleton, SkeletonEdge, SkeletonEdgeId, SkeletonNode, SkeletonNodeId,
    SkeletonOptions, Tip, UnknownSpace,
};
pub use survey::{
    Evidence, PerceptionModel, Resemblance, Survey, SurveyError, SurveyOptions, SurveyStage, SurveyWarning,
    Visit, doubts, resemblance, survey, survey_tracked, turned_laser,
};
