//! From a pose graph to its optimum: the poses that contradict its measurements least, in numbers and as a picture.

mod error;
mod optimize;
mod options;
mod report;

use std::time::Instant;

use hssh_draw::{EdgeKind, PoseGraphOptions, draw_pose_graph};
use hssh_metrics::{GraphFile, Marginals, PoseGraph, PoseId, SolveError, closures, reweighted};
use nalgebra::Matrix2;

pub use error::GraphFailure;
pub use optimize::Optimum;
pub use options::{GraphOptions, KernelChoice, MethodChoice, StartChoice, USUAL_THRESHOLD, WrongClosures};

/// Up to this many poses are drawn with the ellipse of their covariance.
const MOST_ELLIPSES: usize = 40;

/// A pose graph with the poses that were found for it.
#[derive(Clone, PartialEq, Debug)]
pub struct Optimized {
    /// The graph as it was read, each of its components anchored.
    pub file: GraphFile,
    /// The poses that the file itself holds where they are.
    pub fixed: Vec<PoseId>,
    /// The poses that are held where they are because nothing else holds their component.
    pub held: Vec<PoseId>,
    /// What was found.
    pub optimum: Optimum,
    /// Time of solving.
    pub seconds: f64,
}

/// Finds the poses of a graph that contradict its measurements least. Components that nothing holds are held by their first pose.
///
/// # Errors
/// If it has no solution, or options do not go with one another or with the graph.
///
/// ```
/// use hssh::graph::{GraphOptions, optimize};
/// use hssh::metrics::read_pose_graph;
///
/// let text = "EDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\nEDGE_SE2 0 1 3 0 0 1 0 0 1 0 1\n";
/// let found = optimize(read_pose_graph(text.as_bytes())?, &GraphOptions::default())?;
/// assert_eq!((found.optimum.poses[1].x, found.optimum.chi2), (2.0, 2.0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn optimize(mut file: GraphFile, options: &GraphOptions) -> Result<Optimized, GraphFailure> {
    let fixed = fixed(&file);
    let held = file.graph.anchor_components();
    let started = Instant::now();
    let optimum = optimize::minimize(options, &file)?;
    Ok(Optimized { file, fixed, held, optimum, seconds: started.elapsed().as_secs_f64() })
}

/// The poses that the file itself holds where they are.
fn fixed(file: &GraphFile) -> Vec<PoseId> {
    let is_fixed =
        |&pose: &PoseId| file.graph.is_anchored(pose) && file.world != Some(pose) && !file.is_landmark(pose);
    file.graph.pose_ids().filter(is_fixed).collect()
}

impl Optimized {
    /// What each edge is.
    #[must_use]
    pub fn edge_kinds(&self) -> Vec<EdgeKind> {
        let kind = |(closes, &weight): (bool, &f64)| match closes {
            _ if weight == 0.0 => EdgeKind::Refused,
            true => EdgeKind::Closure,
            false => EdgeKind::Odometry,
        };
        closures(&self.file.graph).into_iter().zip(&self.optimum.weights).map(kind).collect()
    }

    /// The plain least-squares problem that has the same minimum: the graph at the poses found, every edge with the weight that it had.
    #[must_use]
    pub fn believed(&self) -> PoseGraph {
        reweighted(&self.file.graph, &self.optimum.poses, &self.optimum.weights)
    }

    /// The graph at the poses found, without refused edges.
    #[must_use]
    pub fn into_file(self) -> GraphFile {
        let Optimized { mut file, optimum, .. } = self;
        let accepted: Vec<f64> = optimum.weights.iter().map(|weight| weight.ceil()).collect();
        file.graph = reweighted(&file.graph, &optimum.poses, &accepted);
        file
    }

    /// Trajectory, closures and, of some poses, the covariance, as SVG.
    ///
    /// # Errors
    /// If covariances cannot be computed.
    pub fn to_svg(&self, name: &str) -> Result<String, SolveError> {
        let Optimized { file, optimum, .. } = self;
        let kinds = self.edge_kinds();
        let is_drawn: Vec<bool> = file.graph.edges().iter().map(|edge| !file.is_prior(edge)).collect();
        let drawn_kinds = kinds.iter().zip(&is_drawn).filter(|&(_, &is_drawn)| is_drawn);
        let drawn = PoseGraphOptions {
            title: Some(format!("{name}: {} poses, {} edges", file.labels.len(), kinds.len())),
            kinds: drawn_kinds.map(|(&kind, _)| kind).collect(),
            covariances: covariances(&self.believed())?,
        };
        let mut placed = file.graph.clone();
        placed.set_poses(optimum.poses.clone()).expect("there is one pose for each");
        Ok(draw_pose_graph(&without_world(file, &placed), &drawn))
    }
}

/// The graph without the frame of the world, which is no pose to be drawn, and its priors.
fn without_world(file: &GraphFile, placed: &PoseGraph) -> PoseGraph {
    let mut graph = PoseGraph::new();
    for &pose in &placed.poses()[..file.labels.len()] {
        graph.add_pose(pose);
    }
    for &edge in placed.edges().iter().filter(|edge| !file.is_prior(edge)) {
        graph.add_edge(edge).expect("an edge between poses that are left");
    }
    graph
}

/// The covariances of the positions of free poses, evenly chosen if there are many.
fn covariances(graph: &PoseGraph) -> Result<Vec<(PoseId, Matrix2<f64>)>, SolveError> {
    let covariances = Marginals::new(graph)?.covariances();
    let free: Vec<PoseId> = graph.pose_ids().filter(|&pose| !graph.is_anchored(pose)).collect();
    let stride = free.len().div_ceil(MOST_ELLIPSES).max(1);
    let chosen = free.into_iter().rev().step_by(stride); // the last pose is one of them
    let position = |pose: PoseId| covariances[pose.index()].fixed_view::<2, 2>(0, 0).into_owned();
    Ok(chosen.map(|pose| (pose, position(pose))).collect())
}
