//! Posterior probability at work: what each successor of a hypothesis pays, and its layout.

use std::cmp::Ordering;
use std::sync::Arc;

use hssh_metrics::{Marginals, Pose, PoseGraph, SolveError};
use hssh_topology::{Derivation, Position, SimplicityFloor, Step};
use serde::{Deserialize, Serialize};

use crate::context::Context;
use crate::cursor::Cursor;
use crate::frames::Trail;
use crate::leaf::{Appraise, Grown, Growth, Leaf};
use crate::legs::Legs;
use crate::limits::StopReason;
use crate::measured::Measured;
use crate::order::Order;
use crate::posterior::appearance::Appearance;
use crate::posterior::cost::Cost;
use crate::posterior::layout::{Layout, Strain};
use crate::posterior::model::{Metrical, PosteriorModel};
use crate::posterior::outlook::Sameness;
use crate::posterior::tariff::Tariff;
use crate::report::{Probable, Score};
use crate::step::{Look, successors};
use crate::tree::{Child, NodeId, Tree};
use crate::visit::MeasurementError;
use crate::visited::Visited;

/// A rise of χ² that does not matter.
pub(crate) const NEGLIGIBLE: f64 = 0.1;

/// By how much costs may differ and still count as equal, relative to one nat and to the cost: least squares end
/// when they promise no more than that.
pub(crate) const TIE: f64 = 1e-6;

/// A cost that orders.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
pub(crate) struct Nats(pub(crate) f64);

impl Eq for Nats {}

impl Ord for Nats {
    fn cmp(&self, other: &Self) -> Ordering {
        self.0.total_cmp(&other.0)
    }
}

impl PartialOrd for Nats {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

/// Appraises by posterior probability.
#[derive(Debug)]
pub(crate) struct ByPosterior {
    pub(crate) tariff: Tariff,
    /// Nothing if the model ignores measurements.
    pub(crate) measured: Option<Measured>,
    /// What visits look like beyond their stars.
    pub(crate) appearance: Appearance,
    /// Until it is laid out, a hypothesis counts as its parent in the thesis's best-first, as its bound in the proof, and as the linear
    /// estimate says in all others.
    order: Order,
    /// By node of the tree: what its new places cost. Filled only while leaves are renewed after prices changed.
    places: Vec<f64>,
}

/// What an open hypothesis carries.
#[derive(Clone, Debug)]
pub(crate) struct Burden {
    /// What it costs; while it is strained, at least.
    pub(crate) cost: Cost,
    /// What F of all maps that may come of it is at least.
    pub(super) floor: Option<SimplicityFloor>,
    /// What every map that comes of it costs at least.
    pub(crate) bound: Nats,
    /// ln of how many maps can come of it at most.
    pub(super) log_branches: f64,
    pub(super) placing: Placing,
}

/// How a hypothesis is laid out. Nothing is solved before its turn.
#[derive(Clone, Debug)]
pub(super) enum Placing {
    /// Solved.
    Done(Arc<Layout>),
    /// As its parent, with one place more where the travel leads.
    Grown(Arc<Layout>),
    /// The last travel connects known places of its parent's layout. The linear estimate says what χ² will
    /// become.
    Strained(Arc<Layout>, f64),
}

/// A successor before its travel is judged.
struct Successor {
    child: Child,
    position: Position,
    complexity: f64,
    floor: Option<SimplicityFloor>,
    pending: u32,
}

/// A hypothesis that is being expanded, in metrical terms.
struct Departure<'a> {
    trail: Trail<'a>,
    legs: &'a Legs,
    layout: Arc<Layout>,
    /// The distribution of its layout, once a travel between known places asks for it.
    marginals: Option<Marginals>,
}

impl ByPosterior {
    pub(crate) fn new(model: PosteriorModel, appearance: Appearance, order: Order) -> Self {
        let measured = (model.metrical != Metrical::Ignored).then(Measured::default);
        ByPosterior {
            tariff: Tariff::new(model, Sameness::Isomorphic),
            measured,
            appearance,
            order,
            places: Vec::new(),
        }
    }

    /// Sets what follows from a leaf's cost.
    fn appraise(&self, leaf: &mut Leaf<Self>) {
        let Burden { cost, floor, placing, .. } = &leaf.load;
        let bound = Nats(self.tariff.bound(cost, *floor, leaf.depth()));
        leaf.key = match (self.order, placing) {
            (Order::Proof, _) if leaf.depth() < self.tariff.travels() => bound,
            (Order::Proof, _) => Nats(cost.total()),
            (Order::BestFirst, Placing::Strained(origin, _)) => Nats(cost.with_chi2(origin.chi2).total()),
            (_, &Placing::Strained(_, promised)) => Nats(cost.with_chi2(promised).total()),
            (_, Placing::Done(_) | Placing::Grown(_)) => Nats(cost.total()),
        };
        leaf.load.bound = bound;
        leaf.load.log_branches = self.tariff.log_branches(leaf.depth(), leaf.pending);
    }

    fn leaf(&self, node: NodeId, depth: usize, pending: u32, burden: Burden) -> Leaf<Self> {
        let mut leaf = Leaf::new(Nats(0.0), node, depth, pending, burden);
        self.appraise(&mut leaf);
        leaf
    }

    /// The layout of a hypothesis, and where the robot was in it.
    fn layout<'a>(&'a self, leaf: &Leaf<Self>, visited: &'a Visited) -> Option<(Arc<Layout>, Trail<'a>)> {
        let measured = self.measured.as_ref()?;
        let trail = measured.frames.trail(visited);
        let layout = match &leaf.load.placing {
            Placing::Done(layout) | Placing::Strained(layout, _) => Arc::clone(layout),
            Placing::Grown(origin) => {
                let last = measured.placed(trail, leaf.depth() - 1);
                Arc::new(origin.with_new_place(&last))
            }
        };
        Some((layout, trail))
    }

    /// What a travel costs that ends at a known place.
    fn strain(
        &self,
        departure: &mut Departure<'_>,
        travel: usize,
        to: Position,
    ) -> Result<Strain, SolveError> {
        let Some(measured) = &self.measured else { return Ok(Strain::default()) };
        let placed = measured.placed_to(departure.trail, travel, to);
        if departure.marginals.is_none() {
            departure.marginals = Some(departure.layout.marginals(departure.legs)?);
        }
        departure.marginals.as_ref().map_or(Ok(Strain::default()), |marginals| Strain::of(&placed, marginals))
    }

    /// What a travel adds to the cost of a hypothesis, and how its successor is laid out.
    fn pay(
        &self,
        cost: &mut Cost,
        departure: Option<&mut Departure<'_>>,
        travel: usize,
        next: &Successor,
        first_visits: &[usize],
    ) -> Result<Placing, SolveError> {
        let is_new_place = next.child.derivation == Derivation::NewPlace;
        if is_new_place {
            cost.places += self.tariff.new_place(travel);
            cost.appearance += self.appearance.of_new_place(travel + 1);
        } else {
            let first = first_visits[next.position.place.index()];
            cost.appearance += self.appearance.of_old_place(travel + 1, first, next.position.phi);
        }
        let Some(departure) = departure else { return Ok(Placing::Done(Layout::root())) };
        if is_new_place {
            return Ok(Placing::Grown(Arc::clone(&departure.layout)));
        }
        let strain = self.strain(departure, travel, next.position)?;
        cost.vagueness += if self.tariff.is_evidence() { strain.vagueness } else { 0.0 };
        let before = departure.layout.chi2;
        *cost = cost.with_chi2(before + strain.trust * strain.chi2);
        Ok(Placing::Strained(Arc::clone(&departure.layout), before + strain.chi2))
    }

    /// The pose graph of a map whose places have those poses. `None` if measurements are ignored.
    pub(crate) fn graph(&self, visits: &[Position], poses: &[Pose]) -> Option<PoseGraph> {
        let measured = self.measured.as_ref()?;
        Some(measured.graph(measured.frames.trail(&Visited::of(visits)), poses.iter().copied()))
    }
}

impl Appraise for ByPosterior {
    type Key = Nats;
    type Load = Burden;

    const WEIGHS: bool = true;

    fn observe(&mut self, context: Context<'_>, tree: &Tree) -> Result<Option<StopReason>, MeasurementError> {
        let Context { experience, watch, .. } = context;
        if let Some(measured) = &mut self.measured {
            measured.observe(experience)?;
        }
        let is_changed = match self.tariff.observe(experience, self.measured.as_ref(), watch) {
            Ok(is_changed) => is_changed,
            Err(reason) => return Ok(Some(reason)),
        };
        self.places.clear();
        if is_changed {
            for node in tree.nodes() {
                let before = tree.parent(node).map_or(0.0, |parent| self.places[parent.index()]);
                let is_new_place = tree.derivation(node) == Some(Derivation::NewPlace);
                let price = if is_new_place { self.tariff.new_place(tree.depth(node) - 1) } else { 0.0 };
                self.places.push(before + price);
            }
        }
        Ok(None)
    }

    fn renew(&self, leaf: &mut Leaf<Self>, _: usize, _: &mut Cursor, _: &Tree, _: Context<'_>) {
        if let Some(&places) = self.places.get(leaf.node.index()) {
            leaf.load.cost.places = places;
        }
        self.appraise(leaf);
    }

    fn root(&self, context: Context<'_>) -> Leaf<Self> {
        let map = context.experience.root().map;
        let cost = Cost { complexity: self.tariff.complexity(&map), ..Cost::default() };
        let placing = Placing::Done(Layout::root());
        let burden =
            Burden { cost, floor: self.tariff.floor(&map), bound: Nats(0.0), log_branches: 0.0, placing };
        self.leaf(NodeId::ROOT, 0, map.pending_count(), burden)
    }

    fn grow(
        &self,
        leaf: &Leaf<Self>,
        cursor: &mut Cursor,
        tree: &Tree,
        context: Context<'_>,
    ) -> Growth<Self> {
        let travel = leaf.depth();
        let (mut next, mut step) = (Vec::new(), Step::default());
        let outcome =
            successors(cursor, leaf.node, tree, context, &mut step, Look::Inside, |child, hypothesis| {
                let map = &hypothesis.map;
                next.push(Successor {
                    child,
                    position: hypothesis.position,
                    complexity: self.tariff.complexity(map),
                    floor: self.tariff.floor(map),
                    pending: map.pending_count(),
                });
            });

        let (visited, legs) = match &self.measured {
            Some(measured) => {
                let (visited, legs) = cursor.travelled(leaf.node, tree, context.experience, measured);
                (visited, Some(legs))
            }
            None => (cursor.visited(leaf.node, tree, context.experience), None),
        };
        let laid_out = self.layout(leaf, visited).zip(legs);
        let mut departure =
            laid_out.map(|((layout, trail), legs)| Departure { trail, legs, layout, marginals: None });
        let choice = self.tariff.choice(next.len());
        let mut grown = Vec::with_capacity(next.len());
        for next in next {
            let mut cost = Cost { complexity: next.complexity, ..leaf.load.cost };
            let is_choice = next.child.derivation != Derivation::Predicted;
            cost.choices += if is_choice { choice } else { 0.0 };
            let placing = self.pay(&mut cost, departure.as_mut(), travel, &next, visited.first_visits())?;
            let burden = Burden { cost, floor: next.floor, bound: Nats(0.0), log_branches: 0.0, placing };
            grown.push((next.child, self.leaf(next.child.parent, travel + 1, next.pending, burden)));
        }
        Ok(Grown { outcome, removals: step.removals, successors: grown, rest: None })
    }

    fn is_settled(&self, leaf: &Leaf<Self>) -> bool {
        !matches!(leaf.load.placing, Placing::Strained(..))
    }

    fn settle(
        &self,
        leaf: &mut Leaf<Self>,
        cursor: &mut Cursor,
        tree: &Tree,
        context: Context<'_>,
    ) -> Result<Option<f64>, SolveError> {
        let Burden { cost, placing, .. } = &mut leaf.load;
        let (Placing::Strained(origin, promised), Some(measured)) = (&*placing, &self.measured) else {
            return Ok(None);
        };
        let (_, legs) = cursor.travelled(leaf.node, tree, context.experience, measured);
        let mut layout = origin.bent(legs, *promised)?;
        // χ² cannot fall along a branch: where it seems to, the parent was caught in a local minimum.
        layout.chi2 = layout.chi2.max(origin.chi2);
        let relied_on = 2.0 * cost.bend > origin.chi2;
        let factor = (layout.chi2 - origin.chi2 + NEGLIGIBLE) / (promised - origin.chi2 + NEGLIGIBLE);
        *cost = cost.with_chi2(layout.chi2);
        *placing = Placing::Done(Arc::new(layout));
        self.appraise(leaf);
        Ok((relied_on && factor < 1.0).then_some(factor))
    }

    fn bound(&self, leaf: &Leaf<Self>) -> Option<Nats> {
        Some(leaf.load.bound)
    }

    fn reach(&self, Nats(cost): Nats, slack: f64) -> Nats {
        Nats(cost + TIE * (1.0 + cost.abs()) + slack)
    }

    fn nats(&self, Nats(cost): Nats) -> f64 {
        cost
    }

    fn log_mass(&self, leaf: &Leaf<Self>) -> f64 {
        leaf.load.log_branches - leaf.load.bound.0
    }

    fn turns_down_early(&self) -> bool {
        true
    }

    fn score(&self, Nats(cost): Nats) -> Score {
        Score::Nats(cost)
    }

    fn probable(&self, leaf: &Leaf<Self>, visited: &Visited) -> Option<Probable> {
        let layout = self.layout(leaf, visited);
        let poses = layout.map_or_else(Vec::new, |(layout, _)| layout.poses.iter().collect());
        Some(Probable { cost: leaf.load.cost, at_least: 0.0, at_most: 1.0, poses })
    }

    /// Counted as if it shared its layout with no other.
    fn bytes(&self, leaf: &Leaf<Self>) -> u64 {
        let (Placing::Done(layout) | Placing::Grown(layout) | Placing::Strained(layout, _)) =
            &leaf.load.placing;
        (size_of::<Leaf<Self>>() + layout.poses.len() * size_of::<Pose>()) as u64
    }
}
