//! What a robot tells a mapper when it comes to a place.

use hssh_causal::{Exploration, Odometry};
use hssh_metrics::UncertaintyError;
use hssh_topology::{Olp, Star};

/// What a robot tells when it comes to a place: how it left the place before, how it came into this one, and what it
/// sees and has measured.
#[derive(Clone, PartialEq, Debug)]
pub struct Visit {
    /// The end of the star seen last that the robot left by.
    pub exit: Olp,
    /// The end of the star seen now that it came in by.
    pub entry: Olp,
    /// The star seen now.
    pub star: Star,
    /// By end of the star: its bearing in the frame of this visit, rad, where it was measured; or nothing at all.
    pub bearings: Vec<Option<f64>>,
    /// The frame of this visit in the frame of the one before, if it was measured.
    pub odometry: Option<Odometry>,
    /// By earlier visit and rotation of φ: the log-likelihood ratio for the two visits to be at one place, by what
    /// they look like beyond their stars. Empty, or short, where nothing is known.
    pub likeness: Vec<Vec<f64>>,
}

impl Visit {
    /// A visit of which no more is known than its star.
    #[must_use]
    pub fn new(exit: Olp, entry: Olp, star: &Star) -> Self {
        let (bearings, likeness) = (Vec::new(), Vec::new());
        Visit { exit, entry, star: star.clone(), bearings, odometry: None, likeness }
    }

    /// The visit that a travel of an exploration ends in, the first travel being 0. Where stars of an exploration have no bearings, the
    /// visit has none either.
    #[must_use]
    pub fn of(exploration: &Exploration, travel: usize) -> Self {
        let travel = &exploration.travels()[travel];
        let named = &exploration.star_types()[travel.star.index()];
        let (exit, entry, star, bearings) =
            (travel.exit, travel.entry, named.star.clone(), named.bearings.clone());
        Visit { exit, entry, star, bearings, odometry: travel.odometry, likeness: Vec::new() }
    }

    /// The same with a measured way.
    #[must_use]
    pub fn with_odometry(self, odometry: Odometry) -> Self {
        Visit { odometry: Some(odometry), ..self }
    }

    /// The same with measured bearings.
    #[must_use]
    pub fn with_bearings(self, bearings: Vec<Option<f64>>) -> Self {
        Visit { bearings, ..self }
    }
}

/// A visit that cannot have happened.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
pub enum VisitError {
    /// The star has no such end.
    #[error("the star {star} has no end number {olp}")]
    NoSuchEnd {
        /// The star.
        star: Star,
        /// The end asked for.
        olp: Olp,
    },
    /// The end is closed.
    #[error("the end {} of the star {star} is closed", star.name(*.olp))]
    ClosedEnd {
        /// The star.
        star: Star,
        /// The closed end.
        olp: Olp,
    },
    /// There are more or fewer bearings than ends.
    #[error("the star {star} has {} ends but {bearings} bearings", star.degree())]
    BearingCount {
        /// The star.
        star: Star,
        /// How many bearings were given.
        bearings: usize,
    },
    /// A travel is not measured well enough for what the search asks of it.
    #[error(transparent)]
    Measurement(#[from] MeasurementError),
}

/// A travel that cannot be laid out.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
pub enum MeasurementError {
    /// It has no odometry.
    #[error("travel {travel} has no odometry; the posterior needs it for every travel")]
    Missing {
        /// The travel, counted from 1.
        travel: usize,
    },
    /// A covariance is too close to singular.
    #[error("the covariance of travel {travel} cannot be used: {problem}")]
    Covariance {
        /// The travel, counted from 1.
        travel: usize,
        /// Why not.
        problem: UncertaintyError,
    },
}
