//! Drives: what became of a robot in a grid, with its log and the truth beside it.

use hssh_local::{LatticeError, Occupancy, OccupancyGrid, PlaceGraph, PlaceGraphError, PlaceNumber};

use super::body::touches;
use super::options::RobotOptions;
use super::record::{Ending, Moment, Stop};
use super::run::Run;
use super::strategy::Strategy;

/// A drive.
#[derive(Clone, Debug)]
pub struct Drive {
    /// The log, from command to command.
    pub moments: Vec<Moment>,
    /// Where the robot centered itself, in order.
    pub stops: Vec<Stop>,
    /// How it ended.
    pub ending: Ending,
    /// The map as the robot met it, without clutter.
    pub grid: OccupancyGrid,
    /// The true places: those of the whole map.
    pub graph: PlaceGraph,
    /// From this range on nothing came back, in metres.
    pub max_range: f64,
}

/// Why a robot cannot drive at all.
#[derive(Clone, Copy, PartialEq, Debug, thiserror::Error)]
pub enum DriveError {
    /// No places to go to.
    #[error(transparent)]
    Map(#[from] PlaceGraphError),
    /// The options describe no local map.
    #[error("the robot cannot keep a local map: {0}")]
    LocalMap(#[from] LatticeError),
    /// Free space without places.
    #[error("the map has free space but no place: nowhere is there a crossing, a corner or a dead end")]
    NoPlaces,
    /// The start is not on the map.
    #[error("the start ({}, {}) is not on the map, which reaches from ({}, {}) to ({}, {})", .at[0], .at[1], .low[0], .low[1], .high[0], .high[1])]
    StartOutside {
        /// The start in metres.
        at: [f64; 2],
        /// The map's lower left corner.
        low: [f64; 2],
        /// The map's upper right corner.
        high: [f64; 2],
    },
    /// The start is in a wall or too near to one.
    #[error("at the start ({}, {}) there is no room for a robot of {radius} m radius: it is in a wall or unknown space, or too near; a place with room is ({:.2}, {:.2})", .at[0], .at[1], .room[0], .room[1])]
    StartBlocked {
        /// The start in metres.
        at: [f64; 2],
        /// The robot's radius.
        radius: f64,
        /// Where there is room: the center of the nearest place.
        room: [f64; 2],
    },
    /// A place of the list does not exist.
    #[error("there is no place {asked}: the map has places 0 to {last}", asked = .asked.0)]
    NoSuchPlace {
        /// The place asked for.
        asked: PlaceNumber,
        /// The last one there is.
        last: usize,
    },
}

/// Drives a robot through a grid, from `start` (metres; the center of the first place if not given) until the
/// strategy is done or the number of travels is made. The same arguments give the same drive.
///
/// What [`RobotOptions::places`] calls clutter is in nobody's way: maps that were drawn by a laser are full of
/// specks. Unknown cells are walls.
///
/// # Errors
/// If the map has no places, there is no room at the start, or the strategy names a place that is not there.
pub fn drive(
    grid: &OccupancyGrid,
    start: Option<[f64; 2]>,
    strategy: Strategy,
    options: &RobotOptions,
    seed: u64,
) -> Result<Drive, DriveError> {
    drive_until(grid, start, strategy, options, seed, &|| false)
}

/// Drives a robot as [`drive`] does, until somebody wants it to stop: that is asked before every command.
///
/// # Errors
/// As [`drive`].
pub fn drive_until(
    grid: &OccupancyGrid,
    start: Option<[f64; 2]>,
    strategy: Strategy,
    options: &RobotOptions,
    seed: u64,
    interrupted: &dyn Fn() -> bool,
) -> Result<Drive, DriveError> {
    let graph = PlaceGraph::new(grid, &options.places)?;
    let first = graph.places.first().ok_or(DriveError::NoPlaces)?;
    if let Strategy::Visit(list) = &strategy
        && let Some(&asked) = list.iter().find(|number| number.index() >= graph.places.len())
    {
        return Err(DriveError::NoSuchPlace { asked, last: graph.places.len() - 1 });
    }
    let start = start.unwrap_or(first.center);
    let grid = without_clutter(&graph);
    check_start(&grid, &graph, start, options)?;
    let mut run = Run::new(&grid, &graph, start, options, seed, interrupted)?;
    let ending = run.travel(strategy).err().unwrap_or(Ending::Done);
    let (moments, stops) = run.into_log();
    Ok(Drive { moments, stops, ending, grid, graph, max_range: options.laser.max_range })
}

/// The grid as the places of the map were found in it: free, or occupied.
fn without_clutter(graph: &PlaceGraph) -> OccupancyGrid {
    let field = graph.free.field();
    let mut grid = OccupancyGrid::filled(*field.lattice(), Occupancy::Free);
    for cell in field.lattice().cells().filter(|&cell| field.squared_cells(cell) == Some(0)) {
        grid.set(cell, Occupancy::Occupied);
    }
    grid
}

/// Whether the robot fits where it starts.
fn check_start(
    grid: &OccupancyGrid,
    graph: &PlaceGraph,
    at: [f64; 2],
    options: &RobotOptions,
) -> Result<(), DriveError> {
    let lattice = grid.lattice();
    if lattice.cell_at(at).is_none() {
        let high = lattice.point([f64::from(lattice.width()), f64::from(lattice.height())]);
        return Err(DriveError::StartOutside { at, low: lattice.origin(), high });
    }
    let radius = options.handling.radius;
    if touches(grid, at, radius) {
        let away = |center: [f64; 2]| (center[0] - at[0]).hypot(center[1] - at[1]);
        let centers = graph.places.iter().map(|place| place.center);
        let room = centers.min_by(|a, b| away(*a).total_cmp(&away(*b))).unwrap_or(at);
        return Err(DriveError::StartBlocked { at, radius, room });
    }
    Ok(())
}
