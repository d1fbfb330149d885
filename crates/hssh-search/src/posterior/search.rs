//! Searching for the most probable maps, in the order of the thesis or with a proof.

use std::sync::Arc;
use std::time::Instant;

use hssh_causal::Exploration;
use hssh_metrics::SolveError;
use hssh_topology::{Axioms, Preference};

use crate::context::Context;
use crate::crew::Crew;
use crate::experience::Experience;
use crate::limits::{Limits, Monitor, StopReason, Watch};
use crate::mapper::{Goal, ThreadsError};
use crate::measured::{Measured, MeasurementError};
use crate::posterior::answer::{Found, Posterior};
use crate::posterior::appearance::Appearance;
use crate::posterior::cost::Tariff;
use crate::posterior::frontier::{Frontier, log_sum};
use crate::posterior::grower::{Grower, Guess};
use crate::posterior::leaf::Leaf;
use crate::posterior::model::{Metrical, ModelError, PosteriorModel};
use crate::report::Tally;
use crate::tree::{Cursor, Tree};

/// The order in which hypotheses are expanded.
#[derive(Clone, Copy, PartialEq, Debug)]
pub enum PosteriorOrder {
    /// The most probable one first, until it explains everything (chapter 4). It may miss the optimum.
    BestFirst,
    /// In turn the most probable one of each number of travels explained: cyclic best-first search. It soon has
    /// a map; whatever cannot lead to one as good is set aside, and when nothing else is left, the answer is
    /// proved.
    Proof(Proving),
}

/// What is to be proved.
#[derive(Clone, Copy, PartialEq, Debug)]
pub struct Proving {
    /// How many of the best maps.
    pub best: usize,
    /// Go on until all maps that were not found have at most this probability together; 1 to do without.
    pub rest: f64,
}

impl Default for Proving {
    fn default() -> Self {
        Proving { best: 1, rest: 1.0 }
    }
}

/// How to search for the most probable map of an exploration.
///
/// ```
/// use hssh_search::{PosteriorModel, PosteriorSearch};
/// use hssh_world::{DriftModel, grid, snake};
///
/// let world = grid(3, 3, 8.0)?;
/// let route = world.route_through(&snake(3, 3))?;
/// let exploration = world.explore_with_odometry(&route, &DriftModel::default(), 1)?;
/// let model = PosteriorModel::evidence(&exploration).ok_or("no distance was measured")?;
/// let posterior = PosteriorSearch::new(model).explain(&exploration)?;
/// assert_eq!(posterior.maps()[0].poses.len(), 9);
/// assert!(posterior.report().proved);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct PosteriorSearch {
    /// What makes a map probable.
    pub model: PosteriorModel,
    /// What makes it possible.
    pub axioms: Axioms,
    /// What visits look like beyond their stars. By default nothing is known.
    pub appearance: Appearance,
    /// In which order to look.
    pub order: PosteriorOrder,
    /// Which maps to accept.
    pub goal: Goal,
    /// When to stop before the end.
    pub limits: Limits,
    /// A window on the search for other threads.
    pub monitor: Arc<Monitor>,
}

/// Why there is no posterior.
#[derive(Debug, thiserror::Error)]
pub enum PosteriorError {
    /// The model is none.
    #[error("the model makes no sense: {0}")]
    Model(#[from] ModelError),
    /// A travel is not measured, or badly.
    #[error(transparent)]
    Measurement(#[from] MeasurementError),
    /// A layout cannot be found.
    #[error(
        "no layout of the first {travels} travels can be computed; is an odometry among them out of all proportion? {problem}"
    )]
    Solve {
        /// How many travels were to be laid out.
        travels: usize,
        /// Why they cannot be.
        problem: SolveError,
    },
    /// No threads.
    #[error(transparent)]
    Threads(#[from] ThreadsError),
}

/// By how much costs may differ and still count as equal, relative to one nat and to the cost: least squares end
/// when they promise no more than that.
pub(crate) const TIE: f64 = 1e-6;

/// By how many nats the reach of a search grows as long as too much probability is left.
const WIDENING: f64 = 1.0;

impl PosteriorSearch {
    /// A search with proof under the thesis's axioms, without limits.
    #[must_use]
    pub fn new(model: PosteriorModel) -> Self {
        PosteriorSearch {
            model,
            axioms: Axioms::default(),
            appearance: Appearance::default(),
            order: PosteriorOrder::Proof(Proving::default()),
            goal: Goal::default(),
            limits: Limits::default(),
            monitor: Arc::default(),
        }
    }

    /// Searches the tree of an exploration for its most probable maps.
    ///
    /// # Errors
    /// If the model makes no sense, if it asks for measurements that are not there, or if a layout cannot be
    /// computed because the covariances differ by too many orders of magnitude.
    pub fn explain(&self, exploration: &Exploration) -> Result<Posterior, PosteriorError> {
        self.model.check()?;
        let measured = match self.model.metrical {
            Metrical::Ignored => None,
            Metrical::Likelihood | Metrical::Evidence(_) => Some(Measured::of(exploration)?),
        };
        let started = Instant::now();
        let experience = Experience::from(exploration);
        let tariff = Tariff::new(self.model, exploration, &experience, measured.as_ref());
        let crew = Crew::new(1).map_err(ThreadsError::from)?;
        let watch = Watch::for_tree(self.limits, &self.monitor);
        let preference = Preference::default();
        let context =
            Context { experience: &experience, axioms: &self.axioms, preference, crew: &crew, watch: &watch };
        let guess = match self.order {
            PosteriorOrder::BestFirst => Guess::Parent,
            PosteriorOrder::Proof(_) => Guess::Linear,
        };
        let grower = Grower {
            context,
            tariff: &tariff,
            measured: measured.as_ref(),
            appearance: &self.appearance,
            guess,
        };

        let mut search = Running::new(grower, self.goal);
        let stop = match self.order {
            PosteriorOrder::BestFirst => search.best_first(),
            PosteriorOrder::Proof(proving) => search.prove(proving),
        };
        let seconds = started.elapsed().as_secs_f64();
        if let (true, Some((travels, problem))) = (search.found.is_empty(), search.unsolvable) {
            return Err(PosteriorError::Solve { travels, problem });
        }
        Ok(search.end(self, stop, seconds).into_posterior(experience, measured))
    }
}

/// A search that is under way.
pub(crate) struct Running<'a> {
    pub(crate) grower: Grower<'a>,
    goal: Goal,
    pub(crate) tree: Tree,
    cursor: Cursor,
    pub(crate) tally: Tally,
    pub(crate) frontier: Frontier,
    /// Maps that explain everything, the most probable first.
    pub(crate) found: Vec<Found>,
    /// Hypotheses turned down because no closed map can come of them.
    pub(crate) rejected: u64,
    /// Layouts found by least squares.
    pub(crate) solved: u64,
    /// By what factors χ² rose of what the linear estimate promised, where it rose less, each with the bound of the
    /// hypothesis.
    pub(crate) factors: Vec<(f64, f64)>,
    /// How many travels the first hypothesis explains that has no computable layout, and why it has none.
    pub(crate) unsolvable: Option<(usize, SolveError)>,
    /// What a map may cost and still matter.
    pub(crate) reach: f64,
}

impl<'a> Running<'a> {
    fn new(grower: Grower<'a>, goal: Goal) -> Self {
        let travels = grower.context.travels();
        Running {
            tree: Tree::new(),
            cursor: Cursor::new(grower.context.experience),
            tally: Tally::new(),
            frontier: Frontier::new(travels, grower.root()),
            found: Vec::new(),
            rejected: 0,
            solved: 0,
            factors: Vec::new(),
            unsolvable: None,
            reach: f64::INFINITY,
            goal,
            grower,
        }
    }

    /// The thesis's search: only the successors of the most probable hypothesis are made.
    fn best_first(&mut self) -> StopReason {
        while let Some(explained) = self.frontier.next_level() {
            if let Some(reason) = self.stop() {
                return reason;
            }
            let Some(mut leaf) = self.frontier.pop(explained) else { break };
            if !leaf.is_settled() {
                if self.settle(&mut leaf) {
                    self.frontier.push(leaf); // its turn may be later now
                }
            } else if explained < self.grower.context.travels() {
                self.grow(&leaf);
            } else if self.goal.accepts(leaf.pending == 0) {
                self.arrive(&leaf);
                return StopReason::Found;
            } else {
                self.rejected += 1;
            }
        }
        StopReason::Exhausted
    }

    /// Cyclic best-first until the best maps are proved, and so little probability is left as was asked for.
    fn prove(&mut self, proving: Proving) -> StopReason {
        let travels = self.grower.context.travels();
        let mut slack = 0.0; // of the reach, beyond the worst of the best maps
        loop {
            let mut idle = true;
            for explained in 0..=travels {
                while let Some(leaf) = self.next(explained) {
                    idle = false;
                    if explained < travels {
                        self.grow(&leaf);
                        break;
                    }
                    if self.goal.accepts(leaf.pending == 0) {
                        self.arrive(&leaf);
                    } else {
                        self.rejected += 1;
                    }
                    self.reach = self.needed(proving.best) + slack;
                    if let Some(reason) = self.stop() {
                        return reason;
                    }
                }
                if let Some(reason) = self.stop() {
                    return reason;
                }
            }
            if !idle {
                continue;
            }
            let Some(least) = self.frontier.least_bound() else { break };
            if self.rest() <= proving.rest {
                break;
            }
            slack += (least - self.reach).max(0.0) + WIDENING;
            self.reach = self.needed(proving.best) + slack;
            self.frontier.unpark(self.reach);
        }
        if self.found.is_empty() { StopReason::Exhausted } else { StopReason::Proved }
    }

    /// The next hypothesis that explains so many travels and that something may come of. It is settled.
    fn next(&mut self, explained: usize) -> Option<Leaf> {
        while let Some(mut leaf) = self.frontier.pop(explained) {
            if leaf.bound <= self.reach && !leaf.is_settled() && !self.settle(&mut leaf) {
                continue;
            }
            if leaf.bound > self.reach {
                self.frontier.park(leaf);
            } else if self.frontier.peek(explained).is_some_and(|other| *other < leaf) {
                self.frontier.push(leaf);
            } else {
                return Some(leaf);
            }
        }
        None
    }

    /// What the last of so many best maps costs, equal ones included; unlimited if there are fewer.
    fn needed(&self, best: usize) -> f64 {
        let last = self.found.get(best.max(1) - 1).map(|found| found.cost.total());
        last.map_or(f64::INFINITY, |cost| cost + TIE * (1.0 + cost.abs()))
    }

    /// The probability of everything that is still open, at most.
    pub(crate) fn rest(&self) -> f64 {
        let open = self.frontier.log_mass(self.grower.tariff);
        let found = log_sum(self.found.iter().map(|found| -found.cost.total()));
        if open == f64::NEG_INFINITY { 0.0 } else { 1.0 / (1.0 + (found - open).exp()) }
    }

    fn stop(&self) -> Option<StopReason> {
        self.grower.context.stop(&self.tree, self.frontier.bytes())
    }

    /// Lays a hypothesis out; whether that is possible. One without a layout has had its turn.
    fn settle(&mut self, leaf: &mut Leaf) -> bool {
        self.solved += 1;
        match self.grower.settle(leaf, &mut self.cursor, &self.tree) {
            Ok(factor) if factor < 1.0 => self.factors.push((leaf.bound, factor)),
            Ok(_) => {}
            Err(problem) => {
                self.unsolvable.get_or_insert((leaf.depth, problem));
                return false;
            }
        }
        true
    }

    fn grow(&mut self, leaf: &Leaf) {
        let Running { grower, cursor, tree, tally, .. } = self;
        let travels = grower.context.travels();
        let grown = grower.grow(leaf, cursor, tree, tally).unwrap_or_else(|problem| {
            self.unsolvable.get_or_insert((leaf.depth + 1, problem));
            Vec::new()
        });
        for next in grown {
            // A travel uses up two pending gateways at most.
            let closable = next.pending as usize <= 2 * (travels - next.depth);
            if next.depth < travels && !self.goal.accepts(closable) {
                self.rejected += 1;
            } else if next.bound > self.reach {
                self.frontier.park(next);
            } else {
                self.frontier.push(next);
            }
        }
    }

    /// A map that explains everything.
    fn arrive(&mut self, leaf: &Leaf) {
        let layout = self.grower.layout(leaf, &mut self.cursor, &self.tree);
        let found = Found { node: leaf.node, cost: leaf.cost, closed: leaf.pending == 0, layout };
        let place = self.found.partition_point(|other| other.cost.total() <= found.cost.total());
        self.found.insert(place, found);
    }
}
