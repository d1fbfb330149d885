//! What measured travels say of where the robot can be, on top of the prices of perception.

use std::cell::{OnceCell, RefCell};
use std::collections::BTreeMap;

use hssh_metrics::{Covariance, Marginals, Pose, PoseId, SolveError};
use hssh_topology::{Arrival, ChartEnd, Hop, Olp, PlaceId, Reading, Sight, Way, Whereabouts};
use nalgebra::Matrix3;

use crate::measured::{MeasuredTravel, PlacedTravel};
use crate::posterior::{Corridor, Strain};
use crate::reading::state::{Bearing, State};

/// A variance of headings that says nothing about them: rad².
const ANY_HEADING: f64 = 100.0;

/// A visit to a place that costs more than that for how far it lies off is none: ten standard deviations.
const OUT_OF_THE_QUESTION: f64 = 50.0;

/// A way that nobody measured and that costs more than that for how it leads is none.
const UNLIKELY_WAY: f64 = 8.0;

/// One travel of a state that is about to be explained, as it was measured.
pub(crate) struct Geometry<'a> {
    pub(crate) state: &'a State,
    pub(crate) travels: &'a [MeasuredTravel],
    /// Since the last visit to a place.
    measured: MeasuredTravel,
    exit: ChartEnd,
    sight: Sight<'a>,
    seen: &'a [Bearing],
    corridor: Option<Corridor>,
    /// How far bearings of the same end lie apart: rad.
    bearing_deviation: Option<f64>,
    marginals: OnceCell<Option<Marginals>>,
    /// By pose and turn.
    strains: RefCell<BTreeMap<(PoseId, u64), Strain>>,
    /// By pose: how much χ²/2 rises if the robot is there.
    bends: RefCell<BTreeMap<PoseId, f64>>,
}

/// What a travel was, and what surrounds it.
pub(crate) struct Measurement<'a> {
    pub(crate) travel: usize,
    pub(crate) travels: &'a [MeasuredTravel],
    pub(crate) exit: ChartEnd,
    pub(crate) sight: Sight<'a>,
    pub(crate) seen: &'a [Bearing],
    pub(crate) corridor: Option<Corridor>,
    pub(crate) bearing_deviation: Option<f64>,
}

impl<'a> Geometry<'a> {
    /// `None` if the travels since the last visit cannot be composed.
    pub(crate) fn new(state: &'a State, measurement: Measurement<'a>) -> Option<Self> {
        let Measurement { travel, travels, exit, sight, seen, corridor, bearing_deviation } = measurement;
        Some(Geometry {
            state,
            travels,
            measured: state.measured_since(travel, travels).ok()?,
            exit,
            sight,
            seen,
            corridor,
            bearing_deviation,
            marginals: OnceCell::new(),
            strains: RefCell::default(),
            bends: RefCell::default(),
        })
    }

    /// What a visit to a place with that pose costs, its frame turned by `turn`.
    pub(crate) fn strain(&self, pose: PoseId, turn: f64) -> Result<Strain, SolveError> {
        let key = (pose, turn.to_bits());
        if let Some(&strain) = self.strains.borrow().get(&key) {
            return Ok(strain);
        }
        let placed = self.state.placed(&self.measured, pose, turn);
        let strain =
            self.marginals().map_or(Ok(Strain::default()), |marginals| Strain::of(&placed, marginals))?;
        self.strains.borrow_mut().insert(key, strain);
        Ok(strain)
    }

    fn marginals(&self) -> Option<&Marginals> {
        let compute = || {
            let (graph, _) = self.state.graph(self.travels).ok()?;
            Marginals::new(&graph).ok()
        };
        self.marginals.get_or_init(compute).as_ref()
    }

    /// Where the robot is if its last travel led to a place that was not known.
    fn arrived(&self) -> Option<Pose> {
        let place = self.state.account.place;
        let from = self.state.located(place)?;
        let step = self.state.placed(&self.measured, self.state.pose_of(place)?, 0.0);
        Some(from.compose(step.pose))
    }

    /// What it costs that a way leads from an end towards a point: how far that lies off the end's bearing.
    fn price_of_way(&self, end: ChartEnd, toward: Pose) -> f64 {
        let place = self.state.account.chart.end(end).place;
        let located = self.state.located(place).zip(self.state.bearing(end));
        located.map_or(0.0, |(from, bearing)| self.price_off(from, bearing, toward))
    }

    fn price_off(&self, from: Pose, bearing: Bearing, toward: Pose) -> f64 {
        match self.corridor {
            Some(corridor) if bearing.measured => {
                let there = from.between(toward);
                corridor.price_of_turn(there.y.atan2(there.x), bearing.angle)
            }
            _ => 0.0,
        }
    }

    /// The same from an end of what is seen now, at a place that was not known.
    fn price_of_way_from(&self, olp: Olp, toward: ChartEnd) -> f64 {
        let place = self.state.account.chart.end(toward).place;
        let located = self.arrived().zip(self.state.located(place));
        located.map_or(0.0, |(here, there)| self.price_off(here, self.seen[olp.index()], there))
    }

    /// What it costs that ways which were not measured lead as they would have to.
    pub(crate) fn price_of_ways(&self, way: &Way) -> f64 {
        let other_end = |end: ChartEnd| self.state.account.chart.end(end).link;
        match way.arrival {
            Arrival::Inserted { ahead } => other_end(self.exit).map_or(0.0, |reached| {
                self.towards_arrival(reached) + self.price_of_way_from(ahead, reached)
            }),
            Arrival::Crossing { on, back, ahead } => other_end(on).map_or(0.0, |to| {
                self.towards_arrival(on)
                    + self.towards_arrival(to)
                    + self.price_of_way_from(back, on)
                    + self.price_of_way_from(ahead, to)
            }),
            _ => self.price_of_hops(way),
        }
    }

    /// Links that were gone along on the way to and from places passed.
    fn price_of_hops(&self, way: &Way) -> f64 {
        let chart = &self.state.account.chart;
        // Ends of junctions that nobody saw are none of this chart's.
        let mut exit = Some(self.exit);
        let mut price = 0.0;
        for hop in &way.hops {
            let Hop::Pass { enter, leave } = *hop else {
                exit = None;
                continue;
            };
            if let Some(exit) = exit.filter(|&exit| chart.is_pending(exit))
                && enter.index() < chart.end_count()
            {
                price += self.price_between(exit, enter);
            }
            exit = (leave.index() < chart.end_count()).then_some(leave);
        }
        match (&way.arrival, exit) {
            (Arrival::Closure(end, _), Some(exit))
                if !way.hops.is_empty() && end.index() < chart.end_count() =>
            {
                price + self.price_between(exit, *end)
            }
            (Arrival::NewPlace, Some(exit)) if !way.hops.is_empty() => price + self.towards_arrival(exit),
            _ => price,
        }
    }

    fn price_between(&self, a: ChartEnd, b: ChartEnd) -> f64 {
        let located = |end: ChartEnd| self.state.located(self.state.account.chart.end(end).place);
        match (located(a), located(b)) {
            (Some(at_a), Some(at_b)) => {
                let way = at_a.between(at_b);
                let length = self.corridor.map_or(0.0, |corridor| corridor.price_of_length(way));
                length + self.price_of_way(a, at_b) + self.price_of_way(b, at_a)
            }
            _ => 0.0,
        }
    }

    fn towards_arrival(&self, end: ChartEnd) -> f64 {
        self.arrived().map_or(0.0, |here| self.price_of_way(end, here))
    }

    /// What it costs that ends that are the same do not lie in the same directions.
    pub(crate) fn price_of_bearings(&self, reading: &Reading, turn: f64) -> f64 {
        let Some(deviation) = self.bearing_deviation else { return 0.0 };
        let pairs = reading.pairs(&self.state.account.chart, self.sight.star);
        let off = |&(olp, end): &(Olp, ChartEnd)| {
            let (seen, known) = (self.seen[olp.index()], self.state.bearing(end)?);
            (seen.measured && known.measured)
                .then(|| hssh_metrics::wrap_angle(known.angle - seen.angle - turn) / deviation)
        };
        pairs.iter().filter_map(off).map(|off| 0.5 * off * off).sum()
    }

    /// How much χ²/2 rises if the robot is at that place, whatever its frame is turned by: the linear estimate.
    fn bend_at(&self, pose: PoseId) -> f64 {
        if let Some(&least) = self.bends.borrow().get(&pose) {
            return least;
        }
        let placed = self.state.placed(&self.measured, pose, 0.0);
        let blurred =
            placed.covariance.matrix() + Matrix3::from_diagonal(&nalgebra::vector![0.0, 0.0, ANY_HEADING]);
        let least = Covariance::new(blurred).ok().and_then(|covariance| {
            let turned = PlacedTravel { covariance, ..placed };
            Some(0.5 * Strain::of(&turned, self.marginals()?).ok()?.chi2)
        });
        let least = least.unwrap_or(0.0);
        self.bends.borrow_mut().insert(pose, least);
        least
    }
}

impl Whereabouts for Geometry<'_> {
    fn can_be_at(&self, place: PlaceId) -> bool {
        self.state.pose_of(place).is_none_or(|pose| self.bend_at(pose) <= OUT_OF_THE_QUESTION)
    }

    fn can_be_between(&self, ends: [ChartEnd; 2]) -> bool {
        let chart = &self.state.account.chart;
        // By the end that it left by, it came as measured.
        let is_known = |end: &ChartEnd| *end != self.exit && end.index() < chart.end_count();
        let ways = ends.into_iter().filter(is_known).map(|end| self.towards_arrival(end));
        ways.sum::<f64>() <= UNLIKELY_WAY
    }

    fn can_have_gone(&self, from: ChartEnd, to: ChartEnd) -> bool {
        self.price_between(from, to) <= UNLIKELY_WAY
    }
}
