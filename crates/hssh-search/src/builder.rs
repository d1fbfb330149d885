//! How a mapper is to search.

use std::sync::Arc;

use hssh_metrics::SolveError;
use hssh_topology::{Axioms, AxiomsError, Preference, ReadingModelError};

use crate::checkpoint::{CheckpointError, Checkpoints};
use crate::constraints::{ConstraintError, VisitConstraints};
use crate::crew::ThreadsError;
use crate::elsewhere::Store;
use crate::helpers::Helpers;
use crate::limits::{Limits, Monitor};
use crate::order::{Goal, Order, Proving};
use crate::posterior::{Appearance, MapPrior, ModelError, PosteriorModel};
use crate::visit::MeasurementError;

/// What makes one map better than another.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum Objective {
    /// The order of preference (section 2.3.2).
    Preference(Preference),
    /// Posterior probability (chapter 4). Every travel has to be measured, unless the model ignores measurements.
    Posterior(PosteriorModel),
}

impl Objective {
    /// Whether a search for it asks for boundary relations at every step.
    pub(crate) fn asks_for_boundaries(self) -> bool {
        match self {
            Objective::Preference(_) => true,
            Objective::Posterior(PosteriorModel { prior, .. }) => {
                matches!(prior, MapPrior::Simplicity(weights) if weights.c1 > 0.0)
            }
        }
    }
}

impl Default for Objective {
    fn default() -> Self {
        Objective::Preference(Preference::default())
    }
}

/// Why a search cannot begin, or has no answer.
#[derive(Debug, thiserror::Error)]
pub enum MapperError {
    /// The axioms do not allow to discard maps.
    #[error(transparent)]
    Axioms(#[from] AxiomsError),
    /// The model is none.
    #[error("the model makes no sense: {0}")]
    Model(#[from] ModelError),
    /// The model of perception is none.
    #[error("the model of perception makes no sense: {0}")]
    Reading(#[from] ReadingModelError),
    /// What is known of which visits are to one place cannot be.
    #[error(transparent)]
    Constraints(#[from] ConstraintError),
    /// A travel is not measured, or badly.
    #[error(transparent)]
    Measurement(#[from] MeasurementError),
    /// There is no map, and some layout cannot be found.
    #[error(
        "no layout of the first {travels} travels can be computed; is an odometry among them out of all proportion? {problem}"
    )]
    Unsolvable {
        /// How many travels were to be laid out.
        travels: usize,
        /// Why they cannot be.
        problem: SolveError,
    },
    /// There is a checkpoint that the search cannot go on from.
    #[error(transparent)]
    Checkpoint(#[from] CheckpointError),
    /// Open hypotheses that were kept elsewhere cannot be read any more.
    #[error("open hypotheses that were kept on disk cannot be read any more: {0}")]
    Lost(String),
    /// No threads.
    #[error(transparent)]
    Threads(#[from] ThreadsError),
}

/// How a [`Mapper`](crate::Mapper) is to search. The default is breadth-first with the thesis's axioms and
/// preference, on one thread, without limits.
#[derive(Clone, Debug)]
pub struct MapperBuilder {
    pub(crate) axioms: Axioms,
    pub(crate) objective: Objective,
    pub(crate) order: Order,
    pub(crate) goal: Goal,
    pub(crate) proving: Proving,
    pub(crate) appearance: Appearance,
    pub(crate) constraints: VisitConstraints,
    pub(crate) limits: Limits,
    pub(crate) threads: usize,
    pub(crate) monitor: Arc<Monitor>,
    pub(crate) checkpoints: Option<Checkpoints>,
    pub(crate) helpers: Option<Arc<dyn Helpers>>,
    pub(crate) store: Option<Arc<dyn Store>>,
}

impl Default for MapperBuilder {
    fn default() -> Self {
        MapperBuilder {
            axioms: Axioms::default(),
            objective: Objective::default(),
            order: Order::default(),
            goal: Goal::default(),
            proving: Proving::default(),
            appearance: Appearance::default(),
            constraints: VisitConstraints::default(),
            limits: Limits::default(),
            threads: 1,
            monitor: Arc::default(),
            checkpoints: None,
            helpers: None,
            store: None,
        }
    }
}

impl MapperBuilder {
    /// The axioms that maps have to satisfy.
    #[must_use]
    pub fn axioms(self, axioms: Axioms) -> Self {
        MapperBuilder { axioms, ..self }
    }

    /// What makes a map better than another.
    #[must_use]
    pub fn objective(self, objective: Objective) -> Self {
        MapperBuilder { objective, ..self }
    }

    /// Looks for the maps that are preferred.
    #[must_use]
    pub fn preference(self, preference: Preference) -> Self {
        self.objective(Objective::Preference(preference))
    }

    /// Looks for the most probable maps.
    #[must_use]
    pub fn posterior(self, model: PosteriorModel) -> Self {
        self.objective(Objective::Posterior(model))
    }

    /// In which order to look.
    #[must_use]
    pub fn order(self, order: Order) -> Self {
        MapperBuilder { order, ..self }
    }

    /// Which maps to accept.
    #[must_use]
    pub fn goal(self, goal: Goal) -> Self {
        MapperBuilder { goal, ..self }
    }

    /// How much to prove.
    #[must_use]
    pub fn proving(self, proving: Proving) -> Self {
        MapperBuilder { proving, ..self }
    }

    /// What visits look like beyond their stars. By default nothing is known. It counts in the posterior only.
    #[must_use]
    pub fn appearance(self, appearance: Appearance) -> Self {
        MapperBuilder { appearance, ..self }
    }

    /// Which visits are known from elsewhere to be to one place, and which are not. By default nothing is known. [`count`](Self::count)
    /// does not ask.
    #[must_use]
    pub fn constraints(self, constraints: VisitConstraints) -> Self {
        MapperBuilder { constraints, ..self }
    }

    /// When to stop before the end.
    #[must_use]
    pub fn limits(self, limits: Limits) -> Self {
        MapperBuilder { limits, ..self }
    }

    /// How many threads, 0 for one per core; never more than are [useful](crate::useful_threads). The result does not
    /// depend on it.
    #[must_use]
    pub fn threads(self, threads: usize) -> Self {
        MapperBuilder { threads, ..self }
    }

    /// A window on the search for other threads.
    #[must_use]
    pub fn monitor(self, monitor: Arc<Monitor>) -> Self {
        MapperBuilder { monitor, ..self }
    }

    /// Where the search of a whole exploration keeps its state from time to time. It goes on from the checkpoint that is there, if there
    /// is one, with the answer of a search that was never interrupted.
    #[must_use]
    pub fn checkpoints(self, checkpoints: Checkpoints) -> Self {
        MapperBuilder { checkpoints: Some(checkpoints), ..self }
    }

    /// Other processes that help the search of a whole exploration. The result does not depend on how many they are.
    #[must_use]
    pub fn helpers(self, helpers: Arc<dyn Helpers>) -> Self {
        MapperBuilder { helpers: Some(helpers), ..self }
    }

    /// Where open hypotheses are kept for which the limit on memory leaves no room: then the search goes on, with the same result. Of the searches
    /// level by level and of counts nothing is kept there.
    #[must_use]
    pub fn spilling(self, store: Arc<dyn Store>) -> Self {
        MapperBuilder { store: Some(store), ..self }
    }

    /// What is sought, and in which order, in a few words.
    pub(crate) fn strategy(&self) -> String {
        let order = match self.order {
            Order::BreadthFirst => "breadth-first",
            Order::BestFirst => "best-first",
            Order::Cyclic => "cyclic best-first with proof",
            Order::Proof => "least bound first with proof",
        };
        let objective = match self.objective {
            Objective::Preference(_) => "by preference",
            Objective::Posterior(_) => "by posterior",
        };
        let goal = match (self.goal, self.order) {
            (Goal::AnyMap, _) | (_, Order::BreadthFirst) => "",
            (Goal::ClosedMap, Order::BestFirst) => ", back until closed",
            (Goal::ClosedMap, _) => ", closed maps",
        };
        format!("{order} {objective}{goal}")
    }
}
