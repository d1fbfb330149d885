//! Explorations: what the robot saw and did, as plain data (section 2.3).

use hssh_topology::{Olp, Star};

/// Which of an exploration's star types: an index into [`Exploration::star_types`].
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct StarType(pub u32);

impl StarType {
    /// The type as an index.
    #[must_use]
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// A star as observed, under a name, with the bearings of its ends where they were measured.
#[derive(Clone, PartialEq, Debug)]
pub struct NamedStar {
    /// The name that travels refer to.
    pub name: String,
    /// The star.
    pub star: Star,
    /// One bearing per end of the star, clockwise as the star is, in radians counterclockwise from
    /// the x axis of the place's own frame; `None` where it was not measured.
    pub bearings: Vec<Option<f64>>,
}

/// A measured relative pose with its uncertainty: the arrival place's frame as seen from the
/// departure place's frame (τ of equation (4.1)).
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Odometry {
    /// Metres along the departure frame's x axis.
    pub x: f64,
    /// Metres along the departure frame's y axis.
    pub y: f64,
    /// Radians, counterclockwise.
    pub theta: f64,
    /// Covariance of (x, y, θ), symmetric positive definite, row by row; m², m·rad and rad².
    pub covariance: [[f64; 3]; 3],
}

/// One travel ⟨S, S::exit, S'::entry, S'⟩. The star it starts from is the one before it.
#[derive(Clone, PartialEq, Debug)]
pub struct Travel {
    /// The oriented local path of the departure star that the robot left by.
    pub exit: Olp,
    /// The oriented local path of the arrival star that the robot came in by.
    pub entry: Olp,
    /// The star observed on arrival.
    pub star: StarType,
    /// The relative pose measured on the way, if it was.
    pub odometry: Option<Odometry>,
}

/// A whole exploration: the star types met, the one it starts in, and the travels in order.
#[derive(Clone, PartialEq, Debug)]
pub struct Exploration {
    star_types: Vec<NamedStar>,
    start: StarType,
    travels: Vec<Travel>,
}
