//! In which ways a travel follows from an account (docs/readings.md, "Ways").

use super::account::{Account, Departure};
use super::chart::{Chart, ChartEnd, Side};
use super::matching::{Reading, Sight, readings};
use super::model::{ReadingModel, nats};
use super::way::{Arrival, Hop, Way};
use crate::ids::{Olp, PlaceId};

/// What else is known of where the robot can be, so that no way is spelled out that is out of the question.
pub trait Whereabouts {
    /// Whether it can be at a place of the chart.
    fn can_be_at(&self, place: PlaceId) -> bool;
    /// Whether it can be at a place that is not known, on the way between two ends that are linked.
    fn can_be_between(&self, ends: [ChartEnd; 2]) -> bool;
    /// Whether it can have gone from one end to another that it was not known to be linked to.
    fn can_have_gone(&self, from: ChartEnd, to: ChartEnd) -> bool;
}

/// Nothing is known of where the robot can be.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub struct Anywhere;

impl Whereabouts for Anywhere {
    fn can_be_at(&self, _: PlaceId) -> bool {
        true
    }

    fn can_be_between(&self, _: [ChartEnd; 2]) -> bool {
        true
    }

    fn can_have_gone(&self, _: ChartEnd, _: ChartEnd) -> bool {
        true
    }
}

impl Account {
    /// In which ways the robot, leaving by that end of the star that it saw last, can have come to see the next one; none that costs more
    /// than the model's limit.
    #[must_use]
    pub fn ways(
        &self,
        leaving: Olp,
        sight: Sight<'_>,
        model: &ReadingModel,
        whereabouts: &dyn Whereabouts,
    ) -> Vec<Way> {
        let mut listing =
            Listing { sight, model, whereabouts, origin: self.place, hops: Vec::new(), ways: Vec::new() };
        match self.departure(leaving) {
            Departure::Back(exit) => listing.turned_back(&self.chart, exit, 0.0),
            Departure::By(exit) => {
                let price = self.chart.end(exit).sightings.price_of_travel(model);
                let mut chart = self.chart.clone();
                chart.travel(exit);
                listing.depart(&chart, exit, price);
                listing.turned_back(&chart, exit, price + nats(model.turned_back));
                let price = price + nats(model.false_visit);
                listing.offer(price, Arrival::False);
            }
        }
        listing.ways
    }
}

/// The ways found so far, and the places passed so far on the one that is being looked for.
struct Listing<'a> {
    sight: Sight<'a>,
    model: &'a ReadingModel,
    whereabouts: &'a dyn Whereabouts,
    origin: PlaceId,
    hops: Vec<Hop>,
    ways: Vec<Way>,
}

impl Listing<'_> {
    /// Lists a way, unless it costs too much.
    fn offer(&mut self, price: f64, arrival: Arrival) {
        if price <= self.model.limit {
            self.ways.push(Way { hops: self.hops.clone(), arrival, price });
        }
    }

    /// Lists the ways that end with a reading at a place.
    fn offer_readings(
        &mut self,
        chart: &Chart,
        place: PlaceId,
        anchor: Option<ChartEnd>,
        price: f64,
        arrival: impl Fn(Reading) -> Arrival,
    ) {
        let most = self.model.limit - price;
        if most < 0.0 || !self.whereabouts.can_be_at(place) {
            return;
        }
        let (hops, ways) = (&self.hops, &mut self.ways);
        readings(chart, place, self.sight, anchor, self.model, most, &mut |reading| {
            let price = price + reading.price;
            ways.push(Way { hops: hops.clone(), arrival: arrival(reading), price });
        });
    }

    fn turned_back(&mut self, chart: &Chart, exit: ChartEnd, price: f64) {
        self.offer_readings(chart, self.origin, Some(exit), price, Arrival::TurnedBack);
    }

    fn depart(&mut self, chart: &Chart, exit: ChartEnd, price: f64) {
        if price > self.model.limit {
            return;
        }
        match chart.end(exit).link {
            Some(reached) => self.depart_by_link(chart, exit, reached, price),
            None => self.depart_by_pending(chart, exit, price),
        }
    }

    fn depart_by_link(&mut self, chart: &Chart, exit: ChartEnd, reached: ChartEnd, price: f64) {
        let place = chart.end(reached).place;
        let passed = chart.end(exit).passed;
        self.offer_readings(chart, place, Some(reached), price, Arrival::Predicted);
        if self.hops.is_empty() && self.whereabouts.can_be_between([exit, reached]) {
            for ahead in self.other_gateways(&[self.sight.entry]) {
                self.offer(price + self.model.price_of_passes(passed), Arrival::Inserted { ahead });
            }
        }
        if self.hops.len() < self.model.most_passed as usize {
            self.pass_place(chart, exit, reached, price);
            let hidden = self.model.price_of_passes(passed + 1) + nats(self.model.hidden);
            for side in [Side::Right, Side::Left] {
                self.hop(chart, exit, Hop::Branch { side }, price + hidden);
            }
        }
    }

    fn depart_by_pending(&mut self, chart: &Chart, exit: ChartEnd, price: f64) {
        self.offer(price, Arrival::NewPlace);
        for end in chart.pending_ends().filter(|&end| end != exit) {
            let place = chart.end(end).place;
            self.offer_readings(chart, place, Some(end), price, |reading| Arrival::Closure(end, reading));
        }
        if !self.hops.is_empty() {
            return;
        }
        for place in chart.places() {
            self.offer_readings(chart, place, None, price, Arrival::NewEnd);
        }
        for &[from, to] in chart.links() {
            let price = price + self.model.price_of_passes(chart.end(from).passed);
            if price > self.model.limit || !self.whereabouts.can_be_between([from, to]) {
                continue;
            }
            for back in self.other_gateways(&[self.sight.entry]) {
                for ahead in self.other_gateways(&[self.sight.entry, back]) {
                    self.offer(price, Arrival::Crossing { on: from, back, ahead });
                }
            }
        }
        if self.model.most_passed > 0 {
            for enter in chart.pending_ends().filter(|&end| end != exit) {
                self.pass_place(chart, exit, enter, price);
            }
            self.merge(chart, exit, price);
        }
    }

    /// The robot passes the place of `enter` and leaves by any other end.
    fn pass_place(&mut self, chart: &Chart, exit: ChartEnd, enter: ChartEnd, price: f64) {
        let place = chart.end(enter).place;
        let others = chart.open_ends_of(place).count() - 1;
        let price = price
            + self.model.price_of_passes(1)
            + (others as f64).ln().max(0.0)
            + chart.end(enter).sightings.price_of_travel(self.model);
        let is_linked = chart.end(exit).link.is_some();
        if price > self.model.limit || (!is_linked && !self.whereabouts.can_have_gone(exit, enter)) {
            return;
        }
        // The end that the robot left by is linked by then.
        for leave in chart.open_ends_of(place).filter(|&end| end != enter) {
            if !is_linked && leave == exit {
                continue;
            }
            let travel = chart.end(leave).sightings.price_of_travel(self.model);
            self.hop(chart, exit, Hop::Pass { enter, leave }, price + travel);
        }
    }

    /// The robot comes to a junction that nobody saw, on a link, and goes on along that.
    fn merge(&mut self, chart: &Chart, exit: ChartEnd, price: f64) {
        let price = price + nats(self.model.hidden) + std::f64::consts::LN_2;
        for &[on, _] in chart.links() {
            let price = price + self.model.price_of_passes(chart.end(on).passed + 1);
            for (side, back) in [Side::Right, Side::Left].into_iter().flat_map(|s| [(s, true), (s, false)]) {
                self.hop(chart, exit, Hop::Merge { on, side, back }, price);
            }
        }
    }

    /// Goes on after a place that was passed.
    fn hop(&mut self, chart: &Chart, exit: ChartEnd, hop: Hop, price: f64) {
        if price > self.model.limit {
            return;
        }
        let mut chart = chart.clone();
        let exit = chart.hop(exit, hop);
        self.hops.push(hop);
        self.depart(&chart, exit, price);
        self.hops.pop();
    }

    fn other_gateways(&self, taken: &[Olp]) -> Vec<Olp> {
        self.sight.star.gateways().filter(|olp| !taken.contains(olp)).collect()
    }
}
