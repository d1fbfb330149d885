//! The ways in which a travel follows from a chart.

use super::chart::{Chart, EndId};
use super::merge::{Element, Sight, anchored, with_new_entry};
use super::model::{ReadingModel, price};
use super::read::{read, travel_by};
use super::way::{Arrival, Here, Way};

/// One travel: what was seen at its end.
#[derive(Clone, Copy)]
pub(super) struct Travelling<'a> {
    pub(super) model: &'a ReadingModel,
    pub(super) sight: Sight<'a>,
}

impl Travelling<'_> {
    /// Leaves by `d`, for the first time or not: all ways.
    pub(super) fn leave(&self, chart: &Chart, d: EndId) -> Vec<Arrival> {
        let mut way = Way::new(chart);
        way.price += travel_by(&mut way.chart, self.model, d);
        [self.depart(way.clone(), d), self.turned_back(&way, d), vec![self.no_place(way, d)]].concat()
    }

    /// Back at the place that the robot left by `d`, after it turned at a false visit.
    pub(super) fn back(&self, chart: &Chart, d: EndId) -> Vec<Arrival> {
        self.arrive_at(&Way::new(chart), d)
    }

    fn turned_back(&self, way: &Way, d: EndId) -> Vec<Arrival> {
        let mut way = way.clone();
        way.price += price(self.model.turned_back);
        self.arrive_at(&way, d)
    }

    fn no_place(&self, mut way: Way, d: EndId) -> Arrival {
        way.price += price(self.model.false_visit);
        (way, Here::Underway { exit: d })
    }

    fn depart(&self, way: Way, d: EndId) -> Vec<Arrival> {
        if way.price > self.model.limit || way.price.is_infinite() {
            return Vec::new(); // Prices never fall.
        }
        let mut ways = Vec::new();
        if let Some(y) = way.chart.partner(d) {
            ways.extend(self.predicted(&way, d, y));
            ways.extend(self.passing(&way, d, y));
            ways.extend(self.branched(&way, d, y));
            if way.passed == 0 {
                ways.extend(self.inserted(&way, d, y));
            }
        } else {
            ways.push(self.new_place(&way, d));
            ways.extend(self.closure(&way, d));
            if way.passed == 0 {
                ways.extend(self.closure_by_a_new_end(&way, d));
                ways.extend(self.crossing(&way, d));
                ways.extend(self.passing_by_closure(&way, d));
                ways.extend(self.merged(&way, d));
            }
        }
        ways
    }

    fn predicted(&self, way: &Way, d: EndId, y: EndId) -> Vec<Arrival> {
        let mut way = way.clone();
        way.pass_link_of(d);
        self.arrive_at(&way, y)
    }

    fn inserted(&self, way: &Way, d: EndId, y: EndId) -> Vec<Arrival> {
        let facing = |b: usize| {
            let mut way = way.clone();
            way.price += way.times_passed(d) * price(self.model.unreported);
            let (place, entry, here) = self.discover(&mut way);
            let b = way.chart.places[place].ends[b];
            way.chart.split((d, entry), (y, b));
            way.chart.ends[b].evidence.travelled = true;
            way.pass_link_of(d);
            (way, here)
        };
        self.other_open_ends().into_iter().map(facing).collect()
    }

    fn passing(&self, way: &Way, d: EndId, y: EndId) -> Vec<Arrival> {
        let mut way = way.clone();
        way.pass_link_of(d);
        self.pass(&way, y, None)
    }

    fn branched(&self, way: &Way, d: EndId, y: EndId) -> Vec<Arrival> {
        let on_side = |stem_right: bool| {
            let mut way = self.with_hidden(way, d)?;
            let (_, _, stem) = way.chart.add_junction(d, y, stem_right);
            way.pass_link_of(d);
            Some(self.depart(way, stem))
        };
        [true, false].into_iter().filter_map(on_side).flatten().collect()
    }

    fn new_place(&self, way: &Way, d: EndId) -> Arrival {
        let mut way = way.clone();
        let (_, entry, here) = self.discover(&mut way);
        way.link(d, entry);
        (way, here)
    }

    fn closure(&self, way: &Way, d: EndId) -> Vec<Arrival> {
        let by = |y: EndId| {
            let mut way = way.clone();
            way.link(d, y);
            self.arrive_at(&way, y)
        };
        way.chart.pending().into_iter().filter(|&y| y != d).flat_map(by).collect()
    }

    fn closure_by_a_new_end(&self, way: &Way, d: EndId) -> Vec<Arrival> {
        let at = |place: usize| {
            let mut arrivals = self.arrive(way, place, with_new_entry(&way.chart, self.sight, place));
            for (way, here) in &mut arrivals {
                let Here::At { image, .. } = here else { unreachable!("a reading is at a place") };
                way.link(d, image[self.sight.entry].expect("the entry is open"));
            }
            arrivals
        };
        (0..way.chart.places.len()).flat_map(at).collect()
    }

    fn crossing(&self, way: &Way, d: EndId) -> Vec<Arrival> {
        let mut ways = Vec::new();
        for link in &way.chart.links {
            for a in self.other_open_ends() {
                for b in self.other_open_ends().into_iter().filter(|&b| b != a) {
                    let mut way = way.clone();
                    way.price += f64::from(link.passed) * price(self.model.unreported);
                    let (place, entry, here) = self.discover(&mut way);
                    let [a, b] = [a, b].map(|seen| way.chart.places[place].ends[seen]);
                    way.chart.split((link.from, a), (link.to, b));
                    for end in [a, b] {
                        way.chart.ends[end].evidence.travelled = true;
                    }
                    way.link(d, entry);
                    ways.push((way, here));
                }
            }
        }
        ways
    }

    fn passing_by_closure(&self, way: &Way, d: EndId) -> Vec<Arrival> {
        let by = |y: EndId| {
            let mut way = way.clone();
            way.link(d, y);
            self.pass(&way, y, Some(d))
        };
        way.chart.pending().into_iter().filter(|&y| y != d).flat_map(by).collect()
    }

    fn merged(&self, way: &Way, d: EndId) -> Vec<Arrival> {
        let mut ways = Vec::new();
        for link in &way.chart.links {
            for stem_right in [true, false] {
                let Some(mut way) = self.with_hidden(way, link.from) else { continue };
                let (toward_u, toward_v, stem) = way.chart.add_junction(link.from, link.to, stem_right);
                way.link(d, stem);
                way.price += 2.0_f64.ln();
                ways.extend(self.depart(way.clone(), toward_u));
                ways.extend(self.depart(way, toward_v));
            }
        }
        ways
    }

    /// The robot comes in by `y`, sees no place, and leaves by any other open end but `not`.
    fn pass(&self, way: &Way, y: EndId, not: Option<EndId>) -> Vec<Arrival> {
        if way.passed == self.model.most_passed {
            return Vec::new();
        }
        let open = way.chart.open_ends(way.chart.ends[y].place);
        let onward = |&z: &EndId| {
            let mut way = way.clone();
            way.passed += 1;
            way.price += price(self.model.unreported) + (open.len() as f64 - 1.0).ln();
            way.price += travel_by(&mut way.chart, self.model, y);
            way.price += travel_by(&mut way.chart, self.model, z);
            self.depart(way, z)
        };
        open.iter().filter(|&&z| z != y && Some(z) != not).flat_map(onward).collect()
    }

    /// Passes a place that was never reported, on the link of an end; `None` if that is one place too many.
    fn with_hidden(&self, way: &Way, end: EndId) -> Option<Way> {
        let mut way = way.clone();
        way.passed += 1;
        way.price += (way.times_passed(end) + 1.0) * price(self.model.unreported) + price(self.model.hidden);
        (way.passed <= self.model.most_passed).then_some(way)
    }

    /// A place that was not known, with the star as seen; its entry is travelled at no price, and so is what faces ways travelled before.
    fn discover(&self, way: &mut Way) -> (usize, EndId, Here) {
        let place = way.chart.add_visited_place(self.sight.star);
        let ends = way.chart.places[place].ends.clone();
        let entry = ends[self.sight.entry];
        way.chart.ends[entry].evidence.travelled = true;
        let image = ends.into_iter().map(|end| way.chart.ends[end].open.then_some(end)).collect();
        (place, entry, Here::At { place, image })
    }

    /// The open ends of the star but the entry.
    fn other_open_ends(&self) -> Vec<usize> {
        let is_other = |&seen: &usize| seen != self.sight.entry && self.sight.is_open(seen);
        (0..self.sight.star.ends().len()).filter(is_other).collect()
    }

    /// At the place of `y`, by `y`.
    fn arrive_at(&self, way: &Way, y: EndId) -> Vec<Arrival> {
        self.arrive(way, way.chart.ends[y].place, anchored(&way.chart, self.sight, y))
    }

    fn arrive(&self, way: &Way, place: usize, readings: Vec<Vec<Element>>) -> Vec<Arrival> {
        let arrival = |reading: Vec<Element>| {
            let (chart, image, cost) = read(&way.chart, self.model, self.sight, place, &reading);
            (Way { chart, price: way.price + cost, passed: way.passed }, Here::At { place, image })
        };
        readings.into_iter().map(arrival).collect()
    }
}
