//! The answer of a search for the most probable maps, with what is proved of it.

use std::fmt;
use std::sync::Arc;

use hssh_metrics::{Pose, PoseGraph};
use hssh_topology::{Hypothesis, Measure, Position};
use serde::Serialize;

use crate::distinction::{Distinction, distinguish};
use crate::experience::Experience;
use crate::limits::StopReason;
use crate::mapper::Goal;
use crate::measured::Measured;
use crate::posterior::cost::Cost;
use crate::posterior::layout::Layout;
use crate::posterior::outlook::LINEAR_TRUST;
use crate::posterior::search::{PosteriorOrder, PosteriorSearch, Running, TIE};
use crate::report::LevelCounts;
use crate::tree::{Cursor, NodeId, Tree};

/// A map that explains everything.
#[derive(Clone, Debug)]
pub(crate) struct Found {
    pub(crate) node: NodeId,
    pub(crate) cost: Cost,
    pub(crate) closed: bool,
    pub(crate) layout: Option<Arc<Layout>>,
}

/// One explanation of an exploration, with what makes it probable.
#[derive(Clone, PartialEq, Debug)]
pub struct ProbableMap {
    /// The hypothesis in the tree.
    pub node: NodeId,
    /// Minus the logarithm of its posterior probability up to a factor that all maps share.
    pub cost: Cost,
    /// Its probability among all maps that were found: what it has at most.
    pub probability: f64,
    /// Its probability if the maps that were not found weigh as much as they can: what it has at least.
    pub least_probability: f64,
    /// What preference looks at.
    pub measure: Measure,
    /// No gateway is pending.
    pub closed: bool,
    /// By place: the frame in which the bearings of the star seen on the first visit are given, in the frame of
    /// the first place. Empty if measurements were ignored.
    pub poses: Vec<Pose>,
}

/// The account of a search for the most probable map. Field names are the names in the program's JSON.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct PosteriorReport {
    /// How the tree was searched.
    pub strategy: &'static str,
    /// Why the search stopped.
    pub stop: StopReason,
    /// How many travels there are to explain.
    pub travels: u64,
    /// The root and every child of every step.
    pub nodes: u64,
    /// Nodes that the recursive step was applied to.
    pub expanded: u64,
    /// Layouts found by least squares.
    pub solved: u64,
    /// The least factor by which χ² rose of what the linear estimate promised, among the hypotheses that may still lead
    /// to maps that matter. The bound
    /// relies on [`LINEAR_TRUST`] where headings are known well enough: a lower factor there invalidates the proof.
    pub linear_factor: f64,
    /// Maps found that explain everything.
    pub found: u64,
    /// How many of them cost as little as the best one.
    pub ties: u64,
    /// Hypotheses that were turned down because a closed map was asked for and none can come of them.
    pub rejected: u64,
    /// What the best map costs, in nats.
    pub best: Option<f64>,
    /// What any map that was not found costs at least, in nats; nothing if there is none.
    pub open_bound: Option<f64>,
    /// The probability of all maps that were not found, at most.
    pub rest: f64,
    /// Whether no map that was not found is as probable as the best one.
    pub proved: bool,
    /// Whether some hypothesis was left out because its layout cannot be computed: some odometry is out of all
    /// proportion. Nothing is proved then.
    pub unsolvable: bool,
    /// By number of travels explained, the root first.
    pub levels: Vec<LevelCounts>,
    /// Time spent searching.
    pub seconds: f64,
    /// Bytes that the tree and the queue take.
    pub bytes: u64,
}

/// A search that has come to its end.
pub(crate) struct Ended {
    tree: Tree,
    maps: Vec<ProbableMap>,
    report: PosteriorReport,
}

impl Running<'_> {
    /// Takes stock.
    pub(crate) fn end(self, search: &PosteriorSearch, stop: StopReason, seconds: f64) -> Ended {
        // Nobody knows what the hypotheses weigh that have no layout.
        let rest = if self.unsolvable.is_some() { 1.0 } else { self.rest() };
        let best = self.found.first().map(|found| found.cost.total());
        let open_bound = self.frontier.least_bound();
        let is_tied = |found: &&Found| best.is_some_and(|best| is_tie(best, found.cost.total()));
        let beats_rest = |best: f64| open_bound.is_none_or(|bound| bound > best && !is_tie(best, bound));
        // A promise that was too high does no harm where even the truth is too high.
        let within_reach = self.factors.iter().filter(|(bound, _)| *bound <= self.reach);
        let linear_factor = within_reach.map(|&(_, factor)| factor).fold(1.0, f64::min);
        let is_sound = open_bound.is_none() || linear_factor >= LINEAR_TRUST;
        let report = PosteriorReport {
            strategy: name(search),
            stop,
            travels: self.grower.context.travels() as u64,
            nodes: self.tree.len() as u64,
            expanded: self.tally.expanded,
            solved: self.solved,
            linear_factor,
            found: self.found.len() as u64,
            ties: self.found.iter().filter(is_tied).count() as u64,
            rejected: self.rejected,
            best,
            open_bound,
            rest,
            proved: is_sound && self.unsolvable.is_none() && best.map_or(open_bound.is_none(), beats_rest),
            unsolvable: self.unsolvable.is_some(),
            levels: self.tally.levels,
            seconds,
            bytes: self.tree.bytes() + self.frontier.bytes(),
        };
        let least = best.unwrap_or(0.0);
        let weight = |found: &Found| (least - found.cost.total()).exp();
        let all: f64 = self.found.iter().map(weight).sum();
        let mut cursor = Cursor::new(self.grower.context.experience);
        let map = |found: &Found| {
            let hypothesis = cursor.go_to(found.node, &self.tree, self.grower.context.experience);
            let probability = weight(found) / all;
            ProbableMap {
                node: found.node,
                cost: found.cost,
                probability,
                least_probability: probability * (1.0 - rest),
                measure: Measure::of(&hypothesis.map),
                closed: found.closed,
                poses: found.layout.as_ref().map_or_else(Vec::new, |layout| layout.poses.clone()),
            }
        };
        let maps = self.found.iter().map(map).collect();
        Ended { tree: self.tree, maps, report }
    }
}

/// Whether two costs are equal as far as least squares can tell.
fn is_tie(best: f64, other: f64) -> bool {
    other - best <= TIE * (1.0 + best.abs())
}

fn name(search: &PosteriorSearch) -> &'static str {
    match (search.order, search.goal) {
        (PosteriorOrder::BestFirst, Goal::AnyMap) => "best-first by posterior",
        (PosteriorOrder::BestFirst, Goal::ClosedMap) => "best-first by posterior, back until closed",
        (PosteriorOrder::Proof(_), Goal::AnyMap) => "posterior with proof",
        (PosteriorOrder::Proof(_), Goal::ClosedMap) => "posterior with proof, closed maps",
    }
}

impl Ended {
    pub(crate) fn into_posterior(self, experience: Experience, measured: Option<Measured>) -> Posterior {
        let Ended { tree, maps, report } = self;
        Posterior { experience, measured, tree, maps, report }
    }
}

/// The most probable maps of an exploration.
#[derive(Debug)]
pub struct Posterior {
    experience: Experience,
    measured: Option<Measured>,
    tree: Tree,
    maps: Vec<ProbableMap>,
    report: PosteriorReport,
}

impl Posterior {
    /// The maps found, the most probable first.
    #[must_use]
    pub fn maps(&self) -> &[ProbableMap] {
        &self.maps
    }

    /// The account of the search.
    #[must_use]
    pub fn report(&self) -> &PosteriorReport {
        &self.report
    }

    /// The hypothesis of a node of the tree.
    #[must_use]
    pub fn hypothesis(&self, node: NodeId) -> Hypothesis {
        let mut cursor = Cursor::new(&self.experience);
        cursor.go_to(node, &self.tree, &self.experience);
        cursor.into_hypothesis()
    }

    /// Where the robot was in the map of a node, after each travel that it explains, the start first.
    #[must_use]
    pub fn visits(&self, node: NodeId) -> Vec<Position> {
        Cursor::new(&self.experience).visits(node, &self.tree, &self.experience)
    }

    /// What tells two maps apart.
    #[must_use]
    pub fn distinguish(&self, first: &ProbableMap, second: &ProbableMap) -> Distinction {
        let [first, second] = [first.node, second.node];
        let hypotheses = [&self.hypothesis(first), &self.hypothesis(second)];
        distinguish(&self.experience.catalog, hypotheses, [&self.visits(first), &self.visits(second)])
    }

    /// The pose graph of a map at its layout: a pose for each place, an edge for each travel, and the first pose
    /// anchored. `None` if measurements were ignored.
    #[must_use]
    pub fn pose_graph(&self, map: &ProbableMap) -> Option<PoseGraph> {
        let measured = self.measured.as_ref()?;
        Some(measured.graph(&measured.frames.trail(self.visits(map.node)), &map.poses))
    }

    /// The tree of all hypotheses made.
    #[must_use]
    pub fn tree(&self) -> &Tree {
        &self.tree
    }

    /// What the search was told.
    #[must_use]
    pub fn experience(&self) -> &Experience {
        &self.experience
    }
}

impl fmt::Display for PosteriorReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}: {} ({} travels)", self.strategy, self.stop, self.travels)?;
        let rows = [
            ("nodes", self.nodes),
            ("expanded", self.expanded),
            ("layouts solved", self.solved),
            ("maps found", self.found),
            ("equally probable", self.ties),
        ];
        for (name, count) in rows {
            writeln!(f, "  {name:<32}{count:>14}")?;
        }
        let show = |cost: Option<f64>| cost.map_or("none".to_owned(), |cost| format!("{cost:.3}"));
        writeln!(f, "  χ² rose by at least {:.2} of the linear estimate", self.linear_factor)?;
        let verdict = if self.proved { "proved" } else { "not proved" };
        writeln!(
            f,
            "  best map costs {} nats, any other at least {}: {verdict}",
            show(self.best),
            show(self.open_bound)
        )?;
        writeln!(f, "  all other maps together have a probability of at most {:.2e}", self.rest)
    }
}
