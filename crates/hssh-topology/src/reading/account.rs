//! Accounts: a chart, and where the robot is in it, after so many travels.

use serde::{Deserialize, Serialize};

use super::chart::{Chart, ChartEnd};
use super::matching::{Element, Reading, Sight};
use super::way::{Arrival, Hop, Way};
use crate::ids::{Olp, PlaceId};
use crate::star::Star;

/// One explanation of an exploration with errors: what the robot's surroundings are, and where in them it is.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct Account {
    /// What there is.
    pub chart: Chart,
    /// Where the robot was last, of all places.
    pub place: PlaceId,
    /// By end of the star seen there: the end of the place that it is; `None` for a closed end of which nothing is known.
    pub seen: Vec<Option<ChartEnd>>,
    /// If the last report was of no place.
    pub underway: Option<Underway>,
}

/// The robot has left a place, and what it took for another one was none.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
pub struct Underway {
    /// The end that it left by.
    pub exit: ChartEnd,
    /// The end of what it saw that it came in by.
    pub entry: Olp,
}

/// How the robot sets out on a travel.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Departure {
    /// By an end of its place.
    By(ChartEnd),
    /// Back, on the way, to the end that it left by.
    Back(ChartEnd),
}

impl Account {
    /// One place with the star seen first.
    #[must_use]
    pub fn begin(star: &Star) -> Self {
        let mut chart = Chart::default();
        let ends = chart.add_place(star);
        show_all(&mut chart, &ends);
        Account { chart, place: PlaceId::new(0), seen: ends.into_iter().map(Some).collect(), underway: None }
    }

    /// How the robot sets out if it leaves by that end of the star that it saw last.
    ///
    /// # Panics
    /// If the end is closed.
    pub(super) fn departure(&self, leaving: Olp) -> Departure {
        match self.underway {
            Some(Underway { exit, entry }) if leaving == entry => Departure::Back(exit),
            Some(Underway { exit, .. }) => Departure::By(exit),
            None => Departure::By(self.seen[leaving.index()].expect("the robot leaves by open ends")),
        }
    }

    /// The end of the chart that the robot leaves by if it leaves by that end of the star that it saw last, or left by if it is underway.
    ///
    /// # Panics
    /// If the end is closed.
    #[must_use]
    pub fn exit(&self, leaving: Olp) -> ChartEnd {
        match self.departure(leaving) {
            Departure::By(exit) | Departure::Back(exit) => exit,
        }
    }

    /// What the travel makes of the account if that is its way: the way is one of [`ways`](Self::ways) for the same travel.
    #[must_use]
    pub fn follow(&self, leaving: Olp, sight: Sight<'_>, way: &Way) -> Account {
        let mut next = self.clone();
        next.underway = None;
        let exit = self.exit(leaving);
        next.chart.travel(exit);
        let exit = way.hops.iter().fold(exit, |exit, &hop| next.chart.hop(exit, hop));
        next.arrive(exit, sight, &way.arrival);
        next
    }

    /// By which ends the robot came into the places that it passes on that way, and by which it left them.
    #[must_use]
    pub fn passed(&self, leaving: Olp, way: &Way) -> Vec<[ChartEnd; 2]> {
        let mut chart = self.chart.clone();
        let mut exit = self.exit(leaving);
        let mut passed = Vec::with_capacity(way.hops.len());
        for &hop in &way.hops {
            let leave = chart.hop(exit, hop);
            passed.push([chart.end(exit).link.expect("it was gone along"), leave]);
            exit = leave;
        }
        passed
    }

    fn arrive(&mut self, exit: ChartEnd, sight: Sight<'_>, arrival: &Arrival) {
        let chart = &mut self.chart;
        match arrival {
            Arrival::False => {
                self.underway = Some(Underway { exit, entry: sight.entry });
                return;
            }
            Arrival::Predicted(reading) | Arrival::TurnedBack(reading) => {
                self.seen = chart.read(sight, reading);
            }
            Arrival::Closure(end, reading) => {
                self.seen = chart.read(sight, reading);
                chart.link(exit, *end);
            }
            Arrival::NewEnd(reading) => {
                self.seen = chart.read(sight, reading);
                chart.link(exit, self.seen[sight.entry.index()].expect("the entry is open"));
            }
            Arrival::NewPlace => {
                let ends = chart.found(sight.star);
                chart.link(exit, ends[sight.entry.index()]);
                self.seen = ends.into_iter().map(Some).collect();
            }
            &Arrival::Inserted { ahead } => {
                let ends = chart.found(sight.star);
                chart.divide(exit, ends[sight.entry.index()], ends[ahead.index()]);
                chart.travel(ends[ahead.index()]);
                self.seen = ends.into_iter().map(Some).collect();
            }
            &Arrival::Crossing { on, back, ahead } => {
                let ends = chart.found(sight.star);
                chart.divide(on, ends[back.index()], ends[ahead.index()]);
                chart.link(exit, ends[sight.entry.index()]);
                [back, ahead].into_iter().for_each(|olp| chart.travel(ends[olp.index()]));
                self.seen = ends.into_iter().map(Some).collect();
            }
        }
        let entry = self.seen[sight.entry.index()].expect("the entry is open");
        chart.travel(entry);
        self.place = chart.end(entry).place;
        if !matches!(arrival, Arrival::TurnedBack(_)) {
            chart.pass(exit);
        }
    }
}

/// A first visit shows all open ends.
fn show_all(chart: &mut Chart, ends: &[ChartEnd]) {
    for &end in ends.iter().filter(|end| chart.end(**end).open).collect::<Vec<_>>() {
        chart.sightings_mut(end).shown = 1;
    }
    chart.visit(chart.end(ends[0]).place);
}

impl Chart {
    /// A place that looks like that, seen for the first time; its ends by those of the star.
    fn found(&mut self, star: &Star) -> Vec<ChartEnd> {
        let ends = self.add_place(star);
        show_all(self, &ends);
        ends
    }

    /// The robot passes a place, coming from `exit`; the end that it leaves by.
    pub(super) fn hop(&mut self, exit: ChartEnd, hop: Hop) -> ChartEnd {
        match hop {
            Hop::Pass { enter, leave } => {
                if self.end(exit).link.is_none() {
                    self.link(exit, enter);
                }
                self.pass(exit);
                self.travel(enter);
                self.travel(leave);
                leave
            }
            Hop::Branch { side } => {
                let junction = self.add_junction(exit, side);
                self.pass(exit);
                junction.stem
            }
            Hop::Merge { on, side, back } => {
                let junction = self.add_junction(on, side);
                self.link(exit, junction.stem);
                self.pass(exit);
                if back { junction.toward_from } else { junction.toward_to }
            }
        }
    }

    /// A place is seen once more: its ends are counted, new ones become part of it. By end of the star: the end that it is.
    fn read(&mut self, sight: Sight<'_>, reading: &Reading) -> Vec<Option<ChartEnd>> {
        let star = sight.star;
        let visits = self.visits(reading.place);
        let mut seen = vec![None; star.ends().len()];
        for (olp, end) in reading.pairs(self, star) {
            seen[olp.index()] = Some(end);
        }
        // A new end follows the one before it: the sequence is walked from an end that was known.
        let known =
            reading.merged.iter().position(|element| !matches!(element, Element::New(_))).unwrap_or(0);
        let (head, tail) = reading.merged.split_at(known);
        let mut before = None;
        for &element in tail.iter().chain(head) {
            let end = match element {
                Element::Matched(_, end) => {
                    self.sightings_mut(end).shown += 1;
                    end
                }
                Element::Missed(end) => {
                    self.sightings_mut(end).missed += 1;
                    end
                }
                Element::New(olp) => {
                    let before = before.expect("something of the place was known");
                    let end = self.new_end(star, olp, before, reading);
                    let sightings = self.sightings_mut(end);
                    (sightings.shown, sightings.missed) = (1, visits);
                    seen[olp.index()] = Some(end);
                    end
                }
            };
            before = Some(end);
        }
        self.close(star, reading, &mut seen);
        self.visit(reading.place);
        seen
    }

    /// An end that was not known: the closed opposite of a known one, or one more.
    fn new_end(&mut self, star: &Star, olp: Olp, before: ChartEnd, reading: &Reading) -> ChartEnd {
        let label = star.ends()[olp.index()].label.as_deref().map(std::sync::Arc::from);
        let over = star.opposite(olp);
        let across = reading.merged.iter().find_map(|element| match *element {
            Element::Matched(seen, end) if seen == over => Some(self.end(end).opposite),
            _ => None,
        });
        match across {
            Some(end) => {
                self.open(end, label);
                if end != before {
                    self.move_end(before, end);
                }
                end
            }
            None => self.insert_end(before, true, label),
        }
    }

    /// New ends get their opposites: one another, or closed ends after what stands before these in the star.
    fn close(&mut self, star: &Star, reading: &Reading, seen: &mut [Option<ChartEnd>]) {
        let is_new = |olp: Olp| reading.merged.contains(&Element::New(olp));
        let degree = star.degree();
        for olp in star.gateways().filter(|&olp| is_new(olp)) {
            let over = star.opposite(olp);
            let end = seen[olp.index()].expect("open ends were read");
            if is_new(over) {
                self.pair(end, seen[over.index()].expect("open ends were read"));
            } else if !star.is_travelable(over) {
                let before = (1..degree).map(|turn| over.turned(degree - turn, degree));
                let before =
                    before.filter(|&other| star.is_travelable(other)).find_map(|other| seen[other.index()]);
                let closed = self.insert_end(before.unwrap_or(end), false, None);
                self.pair(end, closed);
                seen[over.index()] = Some(closed);
            }
        }
    }
}
