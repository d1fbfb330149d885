//! Posterior probability of accounts at work: what each way of explaining a travel costs, errors of perception included.

use std::sync::Arc;

use hssh_metrics::SolveError;
use hssh_topology::{
    Anywhere, Arrival, Derivation, MapOlp, Outcome, PlaceId, Reading, ReadingModel, Removals, TopologicalMap,
    Way,
};

use crate::context::Context;
use crate::cursor::Cursor;
use crate::experience::Experience;
use crate::leaf::{Appraise, Grown, Growth, Leaf};
use crate::limits::StopReason;
use crate::measured::{Measured, MeasuredTravel};
use crate::posterior::{Cost, Layout, Metrical, NEGLIGIBLE, Nats, PosteriorModel, Sameness, TIE, Tariff};
use crate::reading::geometry::{Geometry, Measurement};
use crate::reading::state::{Sights, State, sight};
use crate::report::Score;
use crate::tree::{Child, NodeId, Tree};
use crate::visit::MeasurementError;

/// Appraises accounts.
#[derive(Debug)]
pub(crate) struct ByReading {
    reading: ReadingModel,
    bearing_deviation: Option<f64>,
    tariff: Tariff,
    /// Nothing if the model ignores measurements.
    measured: Option<Measured>,
    sights: Sights,
}

/// What an open account carries.
#[derive(Clone, Debug)]
pub(crate) struct Burden {
    /// What it costs; while its way is not spelled out, at least.
    pub(crate) cost: Cost,
    pub(super) bound: Nats,
    /// What χ² will become by the linear estimate.
    pub(super) promised: f64,
    /// Successors that cost no more are spelled out.
    pub(super) spelled: Nats,
    pub(super) stage: Stage,
}

/// No successor is spelled out yet.
const NOTHING: Nats = Nats(f64::NEG_INFINITY);

/// Successors are spelled out in portions: those that cost so many nats more than the least that was not.
const PORTION: f64 = 3.0;

/// How far an account is spelled out. Nothing is before its turn.
#[derive(Clone, Debug)]
pub(super) enum Stage {
    /// Its state is there, and the map that its chart makes.
    Done(Arc<State>, Arc<TopologicalMap>),
    /// Its parent, and what the travel is taken to be.
    Sketched(Arc<State>, Arc<Way>),
    /// No map comes of it: it violates an axiom.
    Impossible,
}

impl ByReading {
    pub(crate) fn new(
        model: PosteriorModel,
        reading: ReadingModel,
        bearing_deviation: Option<f64>,
        experience: &Experience,
    ) -> Self {
        ByReading {
            reading,
            bearing_deviation,
            tariff: Tariff::new(model, Sameness::AnyReading),
            measured: (model.metrical != Metrical::Ignored).then(Measured::default),
            sights: Sights::of(experience),
        }
    }

    fn travels(&self) -> Option<&[MeasuredTravel]> {
        self.measured.as_ref().map(|measured| measured.travels.as_slice())
    }

    fn appraise(&self, leaf: &mut Leaf<Self>) {
        let Burden { cost, promised, .. } = leaf.load;
        if matches!(leaf.load.stage, Stage::Impossible) {
            (leaf.key, leaf.load.bound) = (Nats(f64::INFINITY), Nats(f64::INFINITY));
            return;
        }
        leaf.load.bound = Nats(self.tariff.bound(&cost, None, leaf.depth()));
        leaf.key = Nats(cost.with_chi2(promised).total());
    }

    /// What a way costs on top of its parent's cost, and what χ² it promises.
    fn pay(
        &self,
        leaf: &Leaf<Self>,
        before: &State,
        way: &Way,
        geometry: Option<&Geometry<'_>>,
        experience: &Experience,
    ) -> Result<(Cost, f64), SolveError> {
        let travel = leaf.depth();
        let mut cost = leaf.load.cost;
        cost.perception += way.price;
        let chi2 = before.layout.chi2;
        let Some(geometry) = geometry else { return Ok((cost, chi2)) };
        cost.perception += geometry.price_of_ways(way);
        let known = way.arrival.reading().and_then(|reading| Some((reading, before.pose_of(reading.place)?)));
        let Some((reading, pose)) = known else {
            cost.places += self.tariff.new_place(travel);
            return Ok((cost, chi2));
        };
        let (observation, sight) = sight(experience, travel);
        let turn = before.turn_under(reading, sight, self.sights.of_star(observation.star));
        cost.perception += geometry.price_of_bearings(reading, turn);
        let strain = geometry.strain(pose, turn)?;
        cost.vagueness += if self.tariff.is_evidence() { strain.vagueness } else { 0.0 };
        Ok((cost.with_chi2(chi2 + strain.trust * strain.chi2), chi2 + strain.chi2))
    }

    /// The state of a leaf, and its map.
    pub(crate) fn done<'a>(&self, leaf: &'a Leaf<Self>) -> Option<(&'a State, &'a TopologicalMap)> {
        match &leaf.load.stage {
            Stage::Done(state, map) => Some((state, map)),
            _ => None,
        }
    }

    /// Whether a reading is of a place that has a pose.
    fn is_strained(before: &State, arrival: &Arrival) -> bool {
        arrival.reading().is_some_and(|Reading { place, .. }| before.pose_of(*place).is_some())
    }
}

/// Leaves the best of those successors that are not spelled out yet; the leaf once more, for the others.
fn portion(
    leaf: &Leaf<ByReading>,
    successors: &mut Vec<(Child, Leaf<ByReading>)>,
) -> Option<Leaf<ByReading>> {
    successors.retain(|(_, next)| next.key > leaf.load.spelled);
    let least = successors.iter().map(|(_, next)| next.key).min()?;
    let most = Nats(least.0 + PORTION);
    let left = || successors.iter().filter(|(_, next)| next.key > most).map(|(_, next)| next);
    let rest = left().map(|next| next.key).min().zip(left().map(|next| next.load.bound).min());
    let rest = rest.map(|(key, bound)| {
        let load = Burden { bound, spelled: most, ..leaf.load.clone() };
        Leaf { key, arrival: u32::MAX, load, ..leaf.clone() }
    });
    successors.retain(|(_, next)| next.key <= most);
    rest
}

impl Appraise for ByReading {
    type Key = Nats;
    type Load = Burden;

    const WEIGHS: bool = true;

    fn observe(&mut self, context: Context<'_>, _: &Tree) -> Result<Option<StopReason>, MeasurementError> {
        let Context { experience, watch, .. } = context;
        if let Some(measured) = &mut self.measured {
            measured.observe(experience)?;
        }
        Ok(self.tariff.observe(experience, self.measured.as_ref(), watch).err())
    }

    fn renew(&self, leaf: &mut Leaf<Self>, _: usize, _: &mut Cursor, _: &Tree, _: Context<'_>) {
        self.appraise(leaf);
    }

    fn root(&self, context: Context<'_>) -> Leaf<Self> {
        let state = State::begin(context.experience, &self.sights);
        let map = state.account.chart.map(context.axioms);
        let pending = map.as_ref().map_or(0, TopologicalMap::pending_count);
        let stage = map.map_or(Stage::Impossible, |map| Stage::Done(Arc::new(state), Arc::new(map)));
        let burden =
            Burden { cost: Cost::default(), bound: Nats(0.0), promised: 0.0, spelled: NOTHING, stage };
        let mut leaf = Leaf::new(Nats(0.0), NodeId::ROOT, 0, pending, burden);
        self.appraise(&mut leaf);
        leaf
    }

    fn grow(&self, leaf: &Leaf<Self>, _: &mut Cursor, _: &Tree, context: Context<'_>) -> Growth<Self> {
        let nothing = Grown {
            outcome: Outcome::Refuted,
            removals: Removals::default(),
            successors: Vec::new(),
            rest: None,
        };
        let Stage::Done(state, _) = &leaf.load.stage else { return Ok(nothing) };
        let travel = leaf.depth();
        let (observation, sight) = sight(context.experience, travel);
        let seen = self.sights.of_star(observation.star);
        let geometry = match self.travels() {
            None => None,
            Some(travels) => Geometry::new(
                state,
                Measurement {
                    travel,
                    travels,
                    exit: state.account.exit(observation.exit),
                    sight,
                    seen,
                    corridor: self.tariff.corridor(),
                    bearing_deviation: self.bearing_deviation,
                },
            ),
        };
        if self.measured.is_some() && geometry.is_none() {
            return Ok(nothing);
        }
        let ways = match &geometry {
            Some(geometry) => state.account.ways(observation.exit, sight, &self.reading, geometry),
            None => state.account.ways(observation.exit, sight, &self.reading, &Anywhere),
        };
        let constraints = &context.experience.constraints;
        let visits = constraints.concern(travel + 1).then(|| state.visits());
        let is_allowed = |way: &Way| {
            let place = way.arrival.reading().map(|reading| reading.place);
            let is_there =
                |visits: &[Option<PlaceId>], visit: usize| place.is_some() && visits[visit] == place;
            visits
                .as_ref()
                .is_none_or(|visits| constraints.allow(travel + 1, |visit| is_there(visits, visit)))
        };
        let mut successors = Vec::with_capacity(ways.len());
        for (number, way) in ways.into_iter().enumerate().filter(|(_, way)| is_allowed(way)) {
            let (cost, promised) = self.pay(leaf, state, &way, geometry.as_ref(), context.experience)?;
            let stage = Stage::Sketched(Arc::clone(state), Arc::new(way));
            let burden = Burden { cost, bound: Nats(0.0), promised, spelled: NOTHING, stage };
            // The tree keeps what tells siblings apart: here the number of the way.
            let (number, none) = (MapOlp::new(number as u32), MapOlp::new(0));
            let child = Child {
                parent: leaf.node,
                derivation: Derivation::Closure(number),
                exit: none,
                arrival: none,
            };
            let mut next = Leaf::new(Nats(0.0), leaf.node, travel + 1, u32::MAX, burden);
            self.appraise(&mut next);
            successors.push((child, next));
        }
        let outcome = if successors.is_empty() { Outcome::Refuted } else { Outcome::Expanded };
        let rest = portion(leaf, &mut successors);
        Ok(Grown { outcome, successors, rest, ..nothing })
    }

    fn is_settled(&self, leaf: &Leaf<Self>) -> bool {
        !matches!(leaf.load.stage, Stage::Sketched(..))
    }

    fn settle(
        &self,
        leaf: &mut Leaf<Self>,
        _: &mut Cursor,
        _: &Tree,
        context: Context<'_>,
    ) -> Result<Option<f64>, SolveError> {
        let Stage::Sketched(before, way) = leaf.load.stage.clone() else { return Ok(None) };
        let travel = leaf.depth() - 1;
        let (observation, sight) = sight(context.experience, travel);
        let seen = self.sights.of_star(observation.star);
        let followed = before.follow(travel, observation, sight, seen, &way, self.travels());
        let mut state = followed.map_err(|_| SolveError::Singular)?;
        let Some(map) = state.account.chart.map(context.axioms) else {
            leaf.load.stage = Stage::Impossible;
            self.appraise(leaf);
            return Ok(None);
        };
        let mut factor = None;
        if let Some(travels) = self.travels().filter(|_| Self::is_strained(&before, &way.arrival)) {
            let promised = leaf.load.promised;
            let (mut graph, loops) = state.graph(travels).map_err(|_| SolveError::Singular)?;
            let mut layout: Layout = before.layout.bent_to(&mut graph, loops, promised)?;
            // χ² cannot fall along a branch: where it seems to, the parent was caught in a local minimum.
            layout.chi2 = layout.chi2.max(before.layout.chi2);
            let relied_on = 2.0 * leaf.load.cost.bend > before.layout.chi2;
            let rise = (layout.chi2 - before.layout.chi2 + NEGLIGIBLE)
                / (promised - before.layout.chi2 + NEGLIGIBLE);
            factor = (relied_on && rise < 1.0).then_some(rise);
            leaf.load.cost = leaf.load.cost.with_chi2(layout.chi2);
            leaf.load.promised = layout.chi2;
            state.layout = layout;
        }
        leaf.pending = map.pending_count();
        leaf.load.stage = Stage::Done(Arc::new(state), Arc::new(map));
        self.appraise(leaf);
        Ok(factor)
    }

    fn bound(&self, leaf: &Leaf<Self>) -> Option<Nats> {
        self.is_possible(leaf).then_some(leaf.load.bound)
    }

    fn is_possible(&self, leaf: &Leaf<Self>) -> bool {
        !matches!(leaf.load.stage, Stage::Impossible)
    }

    fn reach(&self, Nats(cost): Nats, slack: f64) -> Nats {
        Nats(cost + TIE * (1.0 + cost.abs()) + slack)
    }

    fn nats(&self, Nats(cost): Nats) -> f64 {
        cost
    }

    /// In how many ways perception may have erred is not counted.
    fn log_mass(&self, leaf: &Leaf<Self>) -> f64 {
        if self.is_possible(leaf) { f64::INFINITY } else { f64::NEG_INFINITY }
    }

    fn turns_down_early(&self) -> bool {
        false
    }

    fn score(&self, Nats(cost): Nats) -> Score {
        Score::Nats(cost)
    }

    fn bytes(&self, leaf: &Leaf<Self>) -> u64 {
        let own = match &leaf.load.stage {
            Stage::Done(state, map) => state.bytes() + u64::from(map.olp_count()) * 96,
            Stage::Sketched(_, way) => (size_of::<Way>() + 40 * (way.hops.len() + 8)) as u64,
            Stage::Impossible => 0,
        };
        own + size_of::<Leaf<Self>>() as u64
    }
}
