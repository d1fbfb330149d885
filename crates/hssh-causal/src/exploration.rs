//! Explorations: what the robot saw and did, as plain data (section 2.3).

use hssh_topology::{Olp, OlpName, Star};

use crate::bearings::{BearingError, check_bearings};

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

/// Why a sequence of travels is no exploration.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
pub enum ExplorationError {
    /// Two star types share a name.
    #[error("two star types are both named `{0}`")]
    RepeatedStarName(String),
    /// A star type has another number of bearings than ends.
    #[error("star `{name}` has {ends} ends but {bearings} bearings")]
    BearingCount {
        /// The star type's name.
        name: String,
        /// How many oriented local paths it has.
        ends: usize,
        /// How many bearings were given.
        bearings: usize,
    },
    /// A bearing is no direction, or contradicts the clockwise order.
    #[error("star `{name}`: {problem}")]
    Bearing {
        /// The star type's name.
        name: String,
        /// What is wrong with it.
        problem: BearingError,
    },
    /// A label that is empty or has white space around it, so that a reader cannot see what it is.
    #[error("star `{name}`: the label {label:?} of `{olp}` is empty or has white space around it")]
    Label {
        /// The star type's name.
        name: String,
        /// The labeled end.
        olp: OlpName,
        /// Its label.
        label: String,
    },
    /// A star type index past the end of the list.
    #[error("star type {0} does not exist: there are {1}, counted from 0")]
    NoSuchStarType(u32, usize),
    /// A travel is impossible.
    #[error("travel {travel}: {problem}")]
    Travel {
        /// The travel, counted from 1.
        travel: usize,
        /// What is wrong with it.
        problem: TravelError,
    },
}

/// Why a travel cannot have happened as written.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
pub enum TravelError {
    /// The end does not exist in the star.
    #[error("star `{star}` has no end number {olp}: it has {degree}, counted from 0")]
    NoSuchEnd {
        /// The star type's name.
        star: String,
        /// The index asked for.
        olp: u32,
        /// How many ends there are.
        degree: u32,
    },
    /// A closed end was used to leave or to enter.
    #[error("the robot cannot {verb} star `{star}` by `{olp}`, which is closed; travelable: {open}")]
    ClosedEnd {
        /// The star type's name.
        star: String,
        /// The closed end's name.
        olp: String,
        /// "leave" or "enter".
        verb: &'static str,
        /// The names of the travelable ends.
        open: String,
    },
    /// The odometry is no measurement.
    #[error(transparent)]
    Odometry(#[from] OdometryError),
}

/// Why numbers are no relative pose with covariance.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
pub enum OdometryError {
    /// NaN or infinite.
    #[error("odometry contains {0}, which is no finite number")]
    NotFinite(f64),
    /// A number out of all proportion.
    #[error("odometry says {value:e} {unit}, as no robot measures on one travel: {most:e} is the most")]
    OutOfProportion {
        /// The number.
        value: f64,
        /// Its unit.
        unit: &'static str,
        /// How large it may be.
        most: f64,
    },
    /// C ≠ Cᵀ.
    #[error(
        "the covariance is not symmetric: row {row} column {column} is {a}, but row {column} column {row} is {b}"
    )]
    NotSymmetric {
        /// Row, from 1.
        row: usize,
        /// Column, from 1.
        column: usize,
        /// The entry.
        a: f64,
        /// Its mirror image.
        b: f64,
    },
    /// An eigenvalue is zero or negative.
    #[error(
        "the covariance is not positive definite: its smallest eigenvalue is {0}, but every direction needs a positive variance"
    )]
    NotPositiveDefinite(f64),
}

impl Odometry {
    /// How large the numbers may be, with their units: a thousand kilometres are no travel of a robot.
    const MOST: [(f64, &'static str); 3] = [(1e6, "metres"), (1e6, "metres"), (1e4, "radians")];
    /// How large variances may be: a million metres and as many turns.
    const MOST_VARIANCE: f64 = 1e12;

    /// Checks that all numbers are finite and in proportion, and that the covariance is symmetric positive definite.
    ///
    /// # Errors
    /// If it is not.
    pub fn check(&self) -> Result<(), OdometryError> {
        let flat = [self.x, self.y, self.theta];
        let entries = flat.iter().chain(self.covariance.iter().flatten());
        if let Some(&bad) = entries.into_iter().find(|value| !value.is_finite()) {
            return Err(OdometryError::NotFinite(bad));
        }
        for (value, (most, unit)) in flat.into_iter().zip(Self::MOST) {
            if value.abs() > most {
                return Err(OdometryError::OutOfProportion { value, unit, most });
            }
        }
        let c = &self.covariance;
        if let Some(&value) = c.iter().flatten().find(|value| value.abs() > Self::MOST_VARIANCE) {
            let (unit, most) = ("of variance", Self::MOST_VARIANCE);
            return Err(OdometryError::OutOfProportion { value, unit, most });
        }
        for (row, column) in [(0, 1), (0, 2), (1, 2)] {
            let (a, b) = (c[row][column], c[column][row]);
            if (a - b).abs() > 1e-9 * a.abs().max(b.abs()) {
                return Err(OdometryError::NotSymmetric { row: row + 1, column: column + 1, a, b });
            }
        }
        let matrix = nalgebra::Matrix3::from_fn(|row, column| c[row][column]);
        if matrix.cholesky().is_none() {
            return Err(OdometryError::NotPositiveDefinite(matrix.symmetric_eigenvalues().min()));
        }
        Ok(())
    }
}

impl Exploration {
    /// An exploration from its parts.
    ///
    /// # Errors
    /// If a star name repeats, bearings contradict the clockwise order of a star's ends, a label is
    /// blank, a star type or an end does not exist, a travel uses a closed end, or an odometry is
    /// no measurement.
    pub fn new(
        star_types: Vec<NamedStar>,
        start: StarType,
        travels: Vec<Travel>,
    ) -> Result<Self, ExplorationError> {
        for (index, named) in star_types.iter().enumerate() {
            if star_types[..index].iter().any(|other| other.name == named.name) {
                return Err(ExplorationError::RepeatedStarName(named.name.clone()));
            }
            let (ends, bearings) = (named.star.ends().len(), named.bearings.len());
            if ends != bearings {
                return Err(ExplorationError::BearingCount { name: named.name.clone(), ends, bearings });
            }
            check_bearings(&named.star, &named.bearings)
                .map_err(|problem| ExplorationError::Bearing { name: named.name.clone(), problem })?;
            check_labels(named)?;
        }
        let exploration = Exploration { star_types, start, travels };
        exploration.named_star(start)?;
        let mut here = start;
        for (index, travel) in exploration.travels.iter().enumerate() {
            exploration.named_star(travel.star)?;
            exploration
                .check_travel(here, travel)
                .map_err(|problem| ExplorationError::Travel { travel: index + 1, problem })?;
            here = travel.star;
        }
        Ok(exploration)
    }

    fn named_star(&self, star_type: StarType) -> Result<&NamedStar, ExplorationError> {
        self.star_types
            .get(star_type.index())
            .ok_or(ExplorationError::NoSuchStarType(star_type.0, self.star_types.len()))
    }

    fn check_travel(&self, from: StarType, travel: &Travel) -> Result<(), TravelError> {
        usable(&self.star_types[from.index()], travel.exit, "leave")?;
        usable(&self.star_types[travel.star.index()], travel.entry, "enter")?;
        Ok(travel.odometry.as_ref().map_or(Ok(()), Odometry::check)?)
    }

    /// The star types, in the order in which [`StarType`] counts them.
    #[must_use]
    pub fn star_types(&self) -> &[NamedStar] {
        &self.star_types
    }

    /// A star type.
    #[must_use]
    pub fn star(&self, star_type: StarType) -> &Star {
        &self.star_types[star_type.index()].star
    }

    /// The star type seen at the very beginning.
    #[must_use]
    pub fn start(&self) -> StarType {
        self.start
    }

    /// The travels, in order.
    #[must_use]
    pub fn travels(&self) -> &[Travel] {
        &self.travels
    }

    /// The star types seen, in order: one more than there are travels.
    pub fn visits(&self) -> impl Iterator<Item = StarType> + '_ {
        std::iter::once(self.start).chain(self.travels.iter().map(|travel| travel.star))
    }

    /// The beginning of this exploration: its first `travels` travels.
    #[must_use]
    pub fn prefix(&self, travels: usize) -> Self {
        let travels = self.travels[..travels.min(self.travels.len())].to_vec();
        Exploration { travels, ..self.clone() }
    }
}

fn check_labels(named: &NamedStar) -> Result<(), ExplorationError> {
    for end in named.star.ends() {
        if let Some(label) = &end.label
            && (label.is_empty() || label.trim() != label)
        {
            let (name, label) = (named.name.clone(), label.clone());
            return Err(ExplorationError::Label { name, olp: end.name, label });
        }
    }
    Ok(())
}

fn usable(named: &NamedStar, olp: Olp, verb: &'static str) -> Result<(), TravelError> {
    let star = &named.star;
    if olp.number() >= star.degree() {
        return Err(TravelError::NoSuchEnd {
            star: named.name.clone(),
            olp: olp.number(),
            degree: star.degree(),
        });
    }
    if star.is_travelable(olp) {
        return Ok(());
    }
    let open = star.gateways().map(|olp| star.name(olp).to_string()).collect::<Vec<_>>();
    let open = if open.is_empty() { "none".to_owned() } else { open.join(", ") };
    Err(TravelError::ClosedEnd { star: named.name.clone(), olp: star.name(olp).to_string(), verb, open })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn named(name: &str, ends: &str) -> NamedStar {
        let star: Star = ends.parse().unwrap();
        NamedStar { name: name.to_owned(), bearings: vec![None; star.ends().len()], star }
    }

    fn walk(exit: u32, entry: u32, star: u32) -> Travel {
        Travel { exit: Olp::new(exit), entry: Olp::new(entry), star: StarType(star), odometry: None }
    }

    fn refusal(star_types: Vec<NamedStar>, start: u32, travels: Vec<Travel>) -> String {
        Exploration::new(star_types, StarType(start), travels).unwrap_err().to_string()
    }

    #[test]
    fn refuses_what_is_no_exploration() {
        let corner = || named("L", "0+ 1+ (0-) (1-)");
        assert_eq!(refusal(vec![corner(), corner()], 0, vec![]), "two star types are both named `L`");
        assert_eq!(
            refusal(vec![corner()], 1, vec![]),
            "star type 1 does not exist: there are 1, counted from 0"
        );
        assert_eq!(
            refusal(vec![corner()], 0, vec![walk(0, 1, 0), walk(4, 1, 0)]),
            "travel 2: star `L` has no end number 4: it has 4, counted from 0"
        );
        assert_eq!(
            refusal(vec![corner()], 0, vec![walk(0, 2, 0)]),
            "travel 1: the robot cannot enter star `L` by `0-`, which is closed; travelable: 0+, 1+"
        );
        assert_eq!(
            refusal(vec![named("L", "0+: 0-")], 0, vec![]),
            "star `L`: the label \"\" of `0+` is empty or has white space around it"
        );
        let bearings = vec![Some(0.0), Some(0.5), Some(1.0), None];
        assert_eq!(
            refusal(vec![NamedStar { bearings, ..corner() }], 0, vec![]),
            "star `L`: the bearing of `0-` contradicts the clockwise order of the ends: turning clockwise from `1+` to `0-` passes `0+`"
        );
    }

    #[test]
    fn prefixes_keep_stars_and_start() {
        let whole =
            Exploration::new(vec![named("I", "0+ 0-")], StarType(0), vec![walk(0, 1, 0), walk(0, 1, 0)])
                .unwrap();
        assert_eq!(whole.prefix(1).travels(), &whole.travels()[..1]);
        assert_eq!(whole.prefix(9), whole);
        assert_eq!(whole.prefix(0).visits().count(), 1);
    }
}
