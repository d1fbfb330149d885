//! Where the places of a map are, as far as measured travels tell: one frame for all of them
//! (section 2.1.4).

use hssh_causal::Exploration;
use hssh_metrics::{
    GraphError, Options, Pose, PoseGraph, SolveError, UncertaintyError, chordal_poses, solve,
};
use hssh_topology::Position;

use crate::experience::Experience;
use crate::frames::Frames;
use crate::measured::MeasuredTravel;
use crate::visited::Visited;

/// The poses of all places in the frame of the first one.
#[derive(Clone, PartialEq, Debug)]
pub struct Placement {
    /// A pose for each place: the frame in which the bearings of the star seen on the first visit are given.
    /// An edge for each measured travel. The first pose is anchored, the others are where least squares
    /// puts them.
    pub graph: PoseGraph,
    /// How badly the travels fit: χ² of the least squares solution.
    pub chi2: f64,
}

/// Why places cannot be placed.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
pub enum PlacementError {
    /// A covariance is too close to singular.
    #[error("the covariance of travel {travel} cannot be used: {problem}")]
    Covariance {
        /// The travel, counted from 1.
        travel: usize,
        /// Why not.
        problem: UncertaintyError,
    },
    /// The travels are no pose graph.
    #[error("the travels allow no layout: {0}")]
    Graph(#[from] GraphError),
    /// The least squares problem has no solution.
    #[error("the travels allow no layout: {0}")]
    Solve(#[from] SolveError),
}

/// Places the places of a map so that they fit the measured travels best. `visits` are the robot's
/// positions in the map, one more than there are travels. `None` if some place cannot be reached from
/// the first one by measured travels.
///
/// A robot that comes back to a place may see its star turned: then the frame of that visit is turned
/// against the frame of the place, by the difference of the bearings of ends that φ takes to one
/// another. Ends without bearings count as spread evenly around the place.
///
/// # Errors
/// If a covariance cannot be inverted, or the least squares problem cannot be solved.
pub fn place_by_odometry(
    exploration: &Exploration,
    visits: &[Position],
) -> Result<Option<Placement>, PlacementError> {
    let (frames, visited) = (Frames::of(&Experience::from(exploration)), Visited::of(visits));
    let trail = frames.trail(&visited);
    let mut graph = PoseGraph::new();
    for _ in 0..trail.places() {
        graph.add_pose(Pose::default());
    }
    for (index, travel) in exploration.travels().iter().enumerate().take(visits.len().saturating_sub(1)) {
        let Some(odometry) = &travel.odometry else { continue };
        let measured = MeasuredTravel::of(odometry)
            .map_err(|problem| PlacementError::Covariance { travel: index + 1, problem })?;
        let placed = measured.between(trail.end(index), trail.end(index + 1));
        if placed.from != placed.to {
            graph.add_edge(placed.edge())?;
        }
    }
    if graph.anchor_components().len() != 1 {
        return Ok(None);
    }
    let start = chordal_poses(&graph)?;
    graph.set_poses(start)?;
    let solution = solve(&graph, &Options::default())?;
    graph.set_poses(solution.poses)?;
    Ok(Some(Placement { graph, chi2: solution.chi2 }))
}
