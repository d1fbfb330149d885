//! How a pose graph is to be optimized.

use clap::ValueEnum;

/// The χ² beyond which one correct closure in a hundred is.
pub const USUAL_THRESHOLD: f64 = 11.34;

/// How a pose graph is to be optimized.
#[derive(Clone, Copy, Debug)]
pub struct GraphOptions {
    /// How to minimize.
    pub method: MethodChoice,
    /// Where to begin.
    pub start: StartChoice,
    /// How many linear systems to solve at most (with relaxation: sweeps; with kernels: rounds as well); if nothing is said, as many as
    /// is usual.
    pub max_iterations: Option<usize>,
    /// Converged when χ² can fall by no more than this part of it.
    pub tolerance: f64,
    /// What becomes of closures that do not fit.
    pub wrong: WrongClosures,
    /// Asked now and then whether somebody wants it to stop.
    pub interrupted: fn() -> bool,
}

impl Default for GraphOptions {
    fn default() -> Self {
        GraphOptions {
            method: MethodChoice::Safeguarded,
            start: StartChoice::Best,
            max_iterations: None,
            tolerance: 1e-9,
            wrong: WrongClosures::None,
            interrupted: || false,
        }
    }
}

/// What becomes of closures that do not fit.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum WrongClosures {
    /// Every closure is right, but for those that the file itself holds for doubtful.
    None,
    /// They count the less the worse they fit.
    Weighed {
        /// How they lose their weight.
        kernel: KernelChoice,
        /// From how many standard deviations on.
        deviations: f64,
    },
    /// For each it is decided whether to believe it: graduated non-convexity.
    Refused {
        /// The χ² of a closure from which on it is refused; [`USUAL_THRESHOLD`] refuses one correct closure in a hundred.
        threshold: f64,
    },
}

/// How χ² is minimized.
#[derive(Clone, Copy, PartialEq, Eq, Debug, ValueEnum)]
pub enum MethodChoice {
    /// One linear system, as in the thesis's appendix B.
    LinearizeOnce,
    /// Full steps, whether or not χ² falls.
    GaussNewton,
    /// Full steps while χ² falls, then damped ones.
    LevenbergMarquardt,
    /// Gauss–Newton, guarded by Levenberg–Marquardt.
    Safeguarded,
    /// One pose after the other.
    Relaxation,
}

/// Where a descent begins.
#[derive(Clone, Copy, PartialEq, Eq, Debug, ValueEnum)]
pub enum StartChoice {
    /// Chordal poses; the file's as well, if they fit better than what was found. With --robust and --graduated
    /// dead reckoning, which wrong closures cannot spoil.
    Best,
    /// Chordal relaxation: from the edges alone.
    Chordal,
    /// The poses in the file.
    File,
    /// Dead reckoning.
    Odometry,
}

/// How a measurement that fits badly loses its weight.
#[derive(Clone, Copy, PartialEq, Eq, Debug, ValueEnum)]
pub enum KernelChoice {
    /// It pulls with a constant force.
    Huber,
    /// It pulls the less the worse it fits.
    Cauchy,
    /// Dynamic covariance scaling: in the end it is switched off.
    Dcs,
}
