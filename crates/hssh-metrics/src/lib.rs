//! SE(2), pose graphs and least squares: where places are, given measured relative poses (chapter 4 of the
//! thesis and its appendix B). The crate knows no place and no star; a pose graph is all it needs.
//!
//! ```
//! use hssh_metrics::{Options, chordal_poses, read_pose_graph, solve};
//!
//! let text = "\
//! EDGE_SE2 0 1  1.0 0.0  1.5708  100 0 0 100 0 1000
//! EDGE_SE2 1 2  1.1 0.0  1.5708  100 0 0 100 0 1000
//! EDGE_SE2 2 3  1.0 0.0  1.5708  100 0 0 100 0 1000
//! EDGE_SE2 3 0  1.0 0.1  1.5708  100 0 0 100 0 1000
//! ";
//! let mut file = read_pose_graph(text.as_bytes())?; // any BufRead: a file, a pipe, a string
//! assert!(file.skipped.is_empty());
//!
//! let graph = &mut file.graph;
//! graph.anchor_components(); // hold the first pose fixed: measurements are relative
//! graph.set_poses(chordal_poses(graph)?)?; // start from the edges alone
//! let solution = solve(graph, &Options::default())?;
//!
//! assert!(solution.is_converged());
//! assert!(solution.chi2 < 1.0);
//! graph.set_poses(solution.poses)?;
//! println!("{}", file.to_g2o());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Conventions
//!
//! * Metres and radians, counterclockwise; every angle that an operation returns is in (−π, π].
//! * τ = ⊖π_s ⊕ π_e is the pose of the end as seen from the start, (4.1): [`Pose::between`].
//! * The error of an edge is e = ⊖τ° ⊕ (⊖π_s ⊕ π_e), and χ² = Σ eᵀ Ω e without a factor ½: g2o's convention.
//!   The thesis subtracts τ° instead, in the frame of the start pose. The two χ² are equal with
//!   `Ω_thesis = R(θ°) Ω R(θ°)ᵀ`; [`Edge::observed`] takes the thesis's covariance, the field
//!   [`Edge::information`] is g2o's.
//! * Covariances of poses are of (x, y, θ) in the global frame.
//!
//! # Where to read on
//!
//! [`Pose`], [`Covariance`] and [`PoseGraph`] are the nouns; [`LinearizedEdge`] is appendix B.1; [`solve`] is
//! appendix B.2, once or repeated; [`metrical_log_likelihood`] is (4.9) and [`laplace_log_evidence`] the
//! integral (4.6) that it stands in for; [`Marginals`] says what is known of each pose, and what one more
//! measurement would cost. If some measurements may be plainly wrong, [`screen_closures`] finds out which.
//! [`relax`] lowers χ² without any large matrix, and [`floating_poses`] says what is
//! held by too few measurements. Where poses at hand may be misleading, [`solve_from_anywhere`] finds
//! the same minimum whatever they are. [`BayesNetwork`] is section 4.2: the model that all of this is about.

mod angle;
mod anywhere;
mod bayes_network;
mod components;
mod descent;
mod floating;
mod graduated;
mod graph;
mod initial;
mod likelihood;
mod linear;
mod linearization;
mod marginals;
mod pose;
mod readmission;
mod relaxation;
mod robust;
mod solution;
mod solve;
mod text;
mod uncertainty;

pub use angle::wrap_angle;
pub use anywhere::solve_from_anywhere;
pub use bayes_network::{BayesNetwork, Measurement, Variable};
pub use floating::floating_poses;
pub use graduated::{Screening, screen_closures};
pub use graph::{Edge, GraphError, PoseGraph, PoseId};
pub use initial::{chordal_poses, closures, odometry_poses};
pub use likelihood::{PriorError, UniformPrior, laplace_log_evidence, metrical_log_likelihood};
pub use linearization::{LinearizationPoint, LinearizedEdge};
pub use marginals::{Marginals, NewConstraint};
pub use pose::Pose;
pub use relaxation::{Relaxation, relax};
pub use robust::{Kernel, RobustSolution, reweighted, solve_robustly};
pub use solution::{Method, Options, Solution, SolveError, StopReason};
pub use solve::solve;
pub use text::{GraphFile, ReadError, ReadProblem, SkippedRecords, read_pose_graph};
pub use uncertainty::{Covariance, Information, UncertainPose, UncertaintyError};
