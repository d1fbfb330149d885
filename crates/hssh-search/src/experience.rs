//! The robot's experience in the mapper's terms: the star seen first, and what every travel showed.

use hssh_causal::{Exploration, NamedStar, Odometry};
use hssh_topology::{Hypothesis, Isomorphism, Observation, Olp, Position, Star, StarCatalog, StarId};

use crate::constraints::VisitConstraints;
use crate::visit::{Visit, VisitError};

/// What a search explains. It grows by [`push`](Self::push), visit by visit.
#[derive(Clone, Debug)]
pub struct Experience {
    /// All stars that occur.
    pub catalog: StarCatalog,
    /// The star seen first.
    pub start: StarId,
    /// One observation per travel.
    pub observations: Vec<Observation>,
    /// By star: the bearings of its ends, where they were measured.
    bearings: Vec<Vec<Option<f64>>>,
    /// By travel.
    odometry: Vec<Option<Odometry>>,
    /// What is known from elsewhere of which visits are to one place.
    pub(crate) constraints: VisitConstraints,
    /// Whether maps carry their boundary relations along: whether a search asks for them on its way.
    carries_boundaries: bool,
}

impl Experience {
    /// Nothing seen but a first star.
    #[must_use]
    pub fn new(star: &Star, bearings: &[Option<f64>]) -> Self {
        let mut catalog = StarCatalog::new();
        let start = catalog.add(star);
        let bearings = vec![complete(star, bearings)];
        Experience {
            catalog,
            start,
            observations: Vec::new(),
            bearings,
            odometry: Vec::new(),
            constraints: VisitConstraints::default(),
            carries_boundaries: true,
        }
    }

    /// The same, with what is known from elsewhere of which visits are to one place.
    pub(crate) fn with_constraints(self, constraints: VisitConstraints) -> Self {
        Experience { constraints, ..self }
    }

    /// The same, for a search that asks for boundary relations on its way, or not.
    pub(crate) fn with_boundaries(self, carries_boundaries: bool) -> Self {
        Experience { carries_boundaries, ..self }
    }

    /// One visit more.
    ///
    /// # Errors
    /// If an end does not exist or is closed, or if there are bearings, but not one for each end.
    pub fn push(&mut self, visit: &Visit) -> Result<(), VisitError> {
        let Visit { exit, entry, star, bearings, odometry, .. } = visit;
        usable(self.catalog.star(self.last_star()), *exit)?;
        usable(star, *entry)?;
        if !bearings.is_empty() && bearings.len() != star.degree() as usize {
            return Err(VisitError::BearingCount { star: star.clone(), bearings: bearings.len() });
        }
        let bearings = complete(star, bearings);
        let known = self.catalog.stars().zip(&self.bearings);
        let known = known.into_iter().position(|(other, measured)| (other, measured) == (star, &bearings));
        let star = match known {
            Some(known) => StarId::new(known as u32),
            None => {
                self.bearings.push(bearings);
                self.catalog.add(star)
            }
        };
        self.observations.push(Observation { exit: *exit, entry: *entry, star });
        self.odometry.push(*odometry);
        Ok(())
    }

    /// Takes back the last visit.
    pub(crate) fn pop(&mut self) {
        self.observations.pop();
        self.odometry.pop();
    }

    /// The star seen last.
    fn last_star(&self) -> StarId {
        self.observations.last().map_or(self.start, |observation| observation.star)
    }

    /// The star seen on each visit, the start first.
    pub fn seen(&self) -> impl ExactSizeIterator<Item = StarId> + '_ {
        let travels = self.observations.len();
        (0..travels + 1).map(|visit| self.star_of(visit))
    }

    /// The star seen on a visit, the start being 0.
    #[must_use]
    pub fn star_of(&self, visit: usize) -> StarId {
        visit.checked_sub(1).map_or(self.start, |travel| self.observations[travel].star)
    }

    /// The bearings of a star's ends, where they were measured.
    #[must_use]
    pub fn bearings(&self, star: StarId) -> &[Option<f64>] {
        &self.bearings[star.index()]
    }

    /// What was measured on a travel.
    #[must_use]
    pub fn odometry(&self, travel: usize) -> Option<&Odometry> {
        self.odometry[travel].as_ref()
    }

    /// The root of every tree about this experience.
    #[must_use]
    pub fn root(&self) -> Hypothesis {
        let root =
            if self.carries_boundaries { Hypothesis::root } else { Hypothesis::root_without_boundaries };
        root(&self.catalog, self.start)
    }

    /// Where the robot is at the root.
    pub(crate) fn root_position(&self) -> Position {
        let phi = Isomorphism::identity(self.catalog.star(self.start));
        Position { place: hssh_topology::PlaceId::new(0), phi }
    }
}

/// The star types of the exploration keep their numbers: `StarType(i)` becomes `StarId(i)`.
impl From<&Exploration> for Experience {
    fn from(exploration: &Exploration) -> Self {
        let mut catalog = StarCatalog::new();
        let mut bearings = Vec::new();
        for NamedStar { star, bearings: measured, .. } in exploration.star_types() {
            catalog.add(star);
            bearings.push(measured.clone());
        }
        let observe = |travel: &hssh_causal::Travel| Observation {
            exit: travel.exit,
            entry: travel.entry,
            star: StarId::new(travel.star.0),
        };
        let observations = exploration.travels().iter().map(observe).collect();
        let odometry = exploration.travels().iter().map(|travel| travel.odometry).collect();
        Experience {
            catalog,
            start: StarId::new(exploration.start().0),
            observations,
            bearings,
            odometry,
            constraints: VisitConstraints::default(),
            carries_boundaries: true,
        }
    }
}

/// One bearing for each end, unknown where none are given.
fn complete(star: &Star, bearings: &[Option<f64>]) -> Vec<Option<f64>> {
    if bearings.is_empty() { vec![None; star.degree() as usize] } else { bearings.to_vec() }
}

fn usable(star: &Star, olp: Olp) -> Result<(), VisitError> {
    if olp.number() >= star.degree() {
        return Err(VisitError::NoSuchEnd { star: star.clone(), olp });
    }
    if star.is_travelable(olp) {
        return Ok(());
    }
    Err(VisitError::ClosedEnd { star: star.clone(), olp })
}
