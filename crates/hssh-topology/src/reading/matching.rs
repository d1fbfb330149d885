//! Readings: how the ends of a star as seen correspond to those of a place.

use serde::{Deserialize, Serialize};

use super::chart::{Chart, ChartEnd};
use super::model::ReadingModel;
use crate::ids::{Olp, PlaceId};
use crate::star::Star;

/// One element of the merged clockwise sequence of what was seen and what is known.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize, Deserialize)]
pub enum Element {
    /// An end of the star is that end of the place.
    Matched(Olp, ChartEnd),
    /// An end of the place was not seen.
    Missed(ChartEnd),
    /// An end of the star is none that the place was known to have.
    New(Olp),
}

/// How a star, seen on coming into a place by `entry`, corresponds to the star of the place.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct Reading {
    /// The place.
    pub place: PlaceId,
    /// Clockwise; the first element is that of the entry.
    pub merged: Vec<Element>,
    /// What it costs, nats.
    pub price: f64,
}

impl Reading {
    /// Whether nothing was missed, and nothing is new.
    #[must_use]
    pub fn is_isomorphism(&self) -> bool {
        self.merged.iter().all(|element| matches!(element, Element::Matched(..)))
    }

    /// Which ends of the star are which of the place: all of them if it is an isomorphism, else those that are matched. The chart is that from before
    /// the visit.
    #[must_use]
    pub fn pairs(&self, chart: &Chart, star: &Star) -> Vec<(Olp, ChartEnd)> {
        if self.is_isomorphism()
            && let Some(&Element::Matched(olp, end)) = self.merged.first()
            && let Some(image) = rotation(chart, star, olp, end)
        {
            return star.olps().map(|olp| (olp, image(olp))).collect();
        }
        let matched = self.merged.iter().filter_map(|element| match *element {
            Element::Matched(olp, end) => Some((olp, end)),
            _ => None,
        });
        matched.collect()
    }
}

/// A star as seen on coming in by an end of it.
#[derive(Clone, Copy, Debug)]
pub struct Sight<'a> {
    /// The star.
    pub star: &'a Star,
    /// The end that the robot came in by.
    pub entry: Olp,
}

/// Hands every reading of what was seen at a place that costs no more than `most` to `each`: those that take the entry to `anchor`; without one,
/// those for which the entry is a new end.
pub(super) fn readings(
    chart: &Chart,
    place: PlaceId,
    sight: Sight<'_>,
    anchor: Option<ChartEnd>,
    model: &ReadingModel,
    most: f64,
    each: &mut dyn FnMut(Reading),
) {
    let degree = sight.star.degree();
    let seen: Vec<Olp> = (0..degree)
        .map(|turn| sight.entry.turned(turn, degree))
        .filter(|&olp| sight.star.is_travelable(olp))
        .collect();
    let known: Vec<ChartEnd> = chart.open_ends_of(place).collect();
    let visits = chart.visits(place);
    let mut merging = Merging { chart, place, sight, model, most, visits, seen, known, merged: Vec::new() };
    match anchor {
        Some(anchor) => {
            let Some(position) = merging.known.iter().position(|&end| end == anchor) else { return };
            merging.known.rotate_left(position);
            if merging.looks_like(sight.entry, anchor) {
                let counted = merging.counted(anchor);
                let price = merging.price_of_shown(anchor) + counted.price_of_travel(model);
                merging.merged.push(Element::Matched(sight.entry, anchor));
                merging.go_on(1, 1, price, each);
            }
        }
        None => {
            merging.merged.push(Element::New(sight.entry));
            for _ in 0..merging.known.len() {
                merging.go_on(1, 0, model.price_of_new_entry(visits), each);
                merging.known.rotate_left(1);
            }
        }
    }
}

/// Two sequences on the way to be merged.
struct Merging<'a> {
    chart: &'a Chart,
    place: PlaceId,
    sight: Sight<'a>,
    model: &'a ReadingModel,
    most: f64,
    visits: u32,
    /// The open ends of the star, clockwise from the entry.
    seen: Vec<Olp>,
    /// Those of the place, clockwise from the anchor.
    known: Vec<ChartEnd>,
    merged: Vec<Element>,
}

impl Merging<'_> {
    /// Goes on with what is left after so many ends of either sequence.
    fn go_on(&mut self, seen: usize, known: usize, price: f64, each: &mut dyn FnMut(Reading)) {
        if price > self.most {
            return;
        }
        let (here, there) = (self.seen.get(seen).copied(), self.known.get(known).copied());
        if here.is_none() && there.is_none() {
            if self.is_reading() {
                each(Reading { place: self.place, merged: self.merged.clone(), price });
            }
            return;
        }
        if let (Some(olp), Some(end)) = (here, there)
            && self.looks_like(olp, end)
        {
            self.take(
                Element::Matched(olp, end),
                seen + 1,
                known + 1,
                price + self.price_of_shown(end),
                each,
            );
        }
        if let Some(end) = there {
            let missed = self.chart.end(end).sightings.price_of_missed(self.model);
            self.take(Element::Missed(end), seen, known + 1, price + missed, each);
        }
        if let Some(olp) = here {
            let shown = self.model.price_of_new_end(self.visits);
            self.take(Element::New(olp), seen + 1, known, price + shown, each);
        }
    }

    fn take(
        &mut self,
        element: Element,
        seen: usize,
        known: usize,
        price: f64,
        each: &mut dyn FnMut(Reading),
    ) {
        self.merged.push(element);
        self.go_on(seen, known, price, each);
        self.merged.pop();
    }

    fn looks_like(&self, olp: Olp, end: ChartEnd) -> bool {
        self.sight.star.ends()[olp.index()].label.as_deref() == self.chart.end(end).label.as_deref()
    }

    /// What it costs to see an end of the place; nothing on the first visit.
    fn price_of_shown(&self, end: ChartEnd) -> f64 {
        if self.visits == 0 { 0.0 } else { self.chart.end(end).sightings.price_of_shown(self.model) }
    }

    /// What was seen of an end, this visit included.
    fn counted(&self, end: ChartEnd) -> super::model::Sightings {
        let mut sightings = self.chart.end(end).sightings;
        sightings.shown += 1;
        sightings
    }

    /// Whether the opposites agree, and whatever is without errors is an isomorphism.
    fn is_reading(&self) -> bool {
        let star = self.sight.star;
        let image = |olp: Olp| {
            self.merged.iter().find_map(|element| match *element {
                Element::Matched(seen, end) if seen == olp => Some(end),
                _ => None,
            })
        };
        let source = |end: ChartEnd| {
            self.merged.iter().find_map(|element| match *element {
                Element::Matched(seen, known) if known == end => Some(seen),
                _ => None,
            })
        };
        let mut pairs = 0;
        for element in &self.merged {
            let Element::Matched(olp, end) = *element else { continue };
            pairs += 1;
            let (over, across) = (star.opposite(olp), self.chart.end(end).opposite);
            let agrees = match (star.is_travelable(over), image(over)) {
                (true, Some(image)) => image == across,
                (true, None) => !self.chart.end(across).open,
                (false, _) => source(across).is_none(),
            };
            if !agrees || source(across).is_some_and(|seen| seen != over) {
                return false;
            }
        }
        pairs > 0 && (pairs < self.merged.len() || self.is_isomorphism())
    }

    /// Whether the rotation that the first pair decides is an isomorphism (Definition 2.2).
    fn is_isomorphism(&self) -> bool {
        let Some(&Element::Matched(entry, anchor)) = self.merged.first() else { return false };
        rotation(self.chart, self.sight.star, entry, anchor).is_some_and(|image| {
            let star = self.sight.star;
            star.olps().all(|olp| {
                let (seen, known) = (&star.ends()[olp.index()], self.chart.end(image(olp)));
                star.is_travelable(olp) == known.open
                    && seen.label.as_deref() == known.label.as_deref()
                    && image(star.opposite(olp)) == known.opposite
            })
        })
    }
}

/// The rotation of a star that takes `olp` to an end of a place with as many ends.
pub(super) fn rotation<'a>(
    chart: &'a Chart,
    star: &Star,
    olp: Olp,
    end: ChartEnd,
) -> Option<impl Fn(Olp) -> ChartEnd + use<'a>> {
    let ends = chart.ends_of(chart.end(end).place);
    let degree = star.degree();
    let at = ends.iter().position(|&other| other == end)?;
    (ends.len() == degree as usize)
        .then_some(move |other: Olp| ends[(at + olp.turn_to(other, degree) as usize) % ends.len()])
}
