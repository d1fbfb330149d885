//! A way to explain a travel: the chart, the price so far, and where it leads.

use super::chart::{Chart, EndId, Link};

/// Where the robot is after a travel.
#[derive(Clone, PartialEq, Debug)]
pub(super) enum Here {
    /// At a place; for every open end of the star seen last, which end of the place it is.
    At { place: usize, image: Vec<Option<EndId>> },
    /// On the way out of an end: the report was of no place.
    Underway { exit: EndId },
}

/// One way to explain a travel, in the middle of it or, with `here`, at its end.
#[derive(Clone, Debug)]
pub(super) struct Way {
    pub(super) chart: Chart,
    pub(super) price: f64,
    /// How many places were passed.
    pub(super) passed: u32,
}

/// A way and where it led.
pub(super) type Arrival = (Way, Here);

impl Way {
    /// At the beginning of a travel.
    pub(super) fn new(chart: &Chart) -> Self {
        Way { chart: chart.clone(), price: 0.0, passed: 0 }
    }

    /// Makes a link, gone along once.
    pub(super) fn link(&mut self, from: EndId, to: EndId) {
        self.chart.links.push(Link { from, to, passed: 1 });
    }

    /// Goes along the link of an end.
    pub(super) fn pass_link_of(&mut self, end: EndId) {
        let link = self.chart.link_of(end).expect("the robot goes along a link");
        self.chart.links[link].passed += 1;
    }

    /// How often the link of an end was passed.
    pub(super) fn times_passed(&self, end: EndId) -> f64 {
        f64::from(self.chart.links[self.chart.link_of(end).expect("it is linked")].passed)
    }
}
