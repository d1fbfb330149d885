//! Where the places of a map are, as far as measured travels tell: one frame for all of them
//! (section 2.1.4).

use hssh_causal::{Exploration, StarType};
use hssh_metrics::{
    Covariance, Edge, GraphError, Options, Pose, PoseGraph, PoseId, SolveError, UncertaintyError,
    chordal_poses, solve, wrap_angle,
};
use hssh_topology::{Isomorphism, Olp, PlaceId, Position};
use nalgebra::Matrix3;

/// The poses of all places in the frame of the first one.
#[derive(Clone, PartialEq, Debug)]
pub struct Placement {
    /// By place: the frame in which the bearings of the star seen on the first visit are given.
    pub poses: Vec<Pose>,
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
    let seen: Vec<StarType> = exploration.visits().collect();
    let places = visits.iter().map(|visit| visit.place.index() + 1).max().unwrap_or(0);
    let mut first_seen: Vec<Option<StarType>> = vec![None; places];
    let mut frames = Vec::new(); // of each visit, in the frame of its place
    for (visit, &star_type) in visits.iter().zip(&seen) {
        let first = *first_seen[visit.place.index()].get_or_insert(star_type);
        frames.push(Pose::new(0.0, 0.0, turn(exploration, star_type, first, visit.phi)));
    }

    let mut graph = PoseGraph::new();
    for _ in 0..places {
        graph.add_pose(Pose::default());
    }
    let id = |place: PlaceId| PoseId(place.0);
    for (index, travel) in exploration.travels().iter().enumerate().take(visits.len().saturating_sub(1)) {
        let Some(odometry) = &travel.odometry else { continue };
        let (from, to) = (&visits[index], &visits[index + 1]);
        if from.place == to.place {
            continue;
        }
        let c = odometry.covariance;
        let covariance = Covariance::new(Matrix3::from_fn(|row, column| c[row][column]))
            .map_err(|problem| PlacementError::Covariance { travel: index + 1, problem })?;
        let measured = Pose::new(odometry.x, odometry.y, odometry.theta);
        let relative = frames[index].compose(measured).compose(frames[index + 1].inverse());
        let covariance = covariance.rotated(frames[index].theta);
        let edge = Edge::observed(id(from.place), id(to.place), relative, &covariance);
        graph.add_edge(edge)?;
    }
    if graph.anchor_components().len() != 1 {
        return Ok(None);
    }
    let start = chordal_poses(&graph)?;
    graph.set_poses(start)?;
    let solution = solve(&graph, &Options::default())?;
    Ok(Some(Placement { poses: solution.poses, chi2: solution.chi2 }))
}

/// By how much the frame of a visit is turned against that of its place: the mean difference of the
/// bearings of corresponding ends.
fn turn(exploration: &Exploration, seen: StarType, first: StarType, phi: Isomorphism) -> f64 {
    let (seen, first) = (&exploration.star_types()[seen.index()], &exploration.star_types()[first.index()]);
    let spread = |olp: Olp| -std::f64::consts::TAU * f64::from(olp.0) / f64::from(seen.star.degree());
    let measured: Vec<f64> = seen
        .star
        .olps()
        .filter_map(|olp| Some(first.bearings[phi.apply(olp).index()]? - seen.bearings[olp.index()]?))
        .collect();
    if measured.is_empty() {
        return wrap_angle(spread(phi.apply(Olp(0))) - spread(Olp(0)));
    }
    let (sine, cosine) = measured.iter().fold((0.0, 0.0), |(s, c), turn| (s + turn.sin(), c + turn.cos()));
    sine.atan2(cosine)
}
