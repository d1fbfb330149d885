//! The readings of a star at a place: every merged clockwise sequence that the rules allow.

use hssh_topology::{Passability, Star};

use super::chart::{Chart, EndId};
use crate::star::{isomorphisms, opposite};

/// A star as seen on coming in by an end of it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sight<'a> {
    pub(super) star: &'a Star,
    pub(super) entry: usize,
}

/// An element of a merged sequence; ends of the star are called by their position in it.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum Element {
    Matched { seen: usize, end: EndId },
    Missed(EndId),
    New(usize),
}

impl Sight<'_> {
    pub(super) fn is_open(&self, seen: usize) -> bool {
        self.star.ends()[seen].passability == Passability::Travelable
    }

    /// The open ends, clockwise from the entry.
    fn open_ends(&self) -> Vec<usize> {
        let degree = self.star.ends().len();
        (0..degree).map(|steps| (self.entry + steps) % degree).filter(|&seen| self.is_open(seen)).collect()
    }
}

/// The readings anchored at an open end.
pub(super) fn anchored(chart: &Chart, sight: Sight, y: EndId) -> Vec<Vec<Element>> {
    let ends = rotated_to(&chart.open_ends(chart.ends[y].place), y);
    let first = Element::Matched { seen: sight.entry, end: y };
    merges(&sight.open_ends()[1..], &ends[1..])
        .into_iter()
        .map(|rest| [vec![first], rest].concat())
        .filter(|sequence| is_reading(chart, sight, sequence))
        .collect()
}

/// The readings at a place in which the entry is new.
pub(super) fn with_new_entry(chart: &Chart, sight: Sight, place: usize) -> Vec<Vec<Element>> {
    let ends = chart.open_ends(place);
    ends.iter()
        .flat_map(|&begin| merges(&sight.open_ends()[1..], &rotated_to(&ends, begin)))
        .map(|rest| [vec![Element::New(sight.entry)], rest].concat())
        .filter(|sequence| is_reading(chart, sight, sequence))
        .collect()
}

fn rotated_to(ends: &[EndId], first: EndId) -> Vec<EndId> {
    let position = ends.iter().position(|&end| end == first).expect("it is one of them");
    [&ends[position..], &ends[..position]].concat()
}

/// Every merged sequence of two sequences.
fn merges(seen: &[usize], ends: &[EndId]) -> Vec<Vec<Element>> {
    if seen.is_empty() && ends.is_empty() {
        return vec![Vec::new()];
    }
    let mut merged = Vec::new();
    let mut begin_with = |first: Element, rest: Vec<Vec<Element>>| {
        merged.extend(rest.into_iter().map(|rest| [vec![first], rest].concat()));
    };
    if let Some((&a, seen)) = seen.split_first() {
        begin_with(Element::New(a), merges(seen, ends));
    }
    if let Some((&b, ends)) = ends.split_first() {
        begin_with(Element::Missed(b), merges(seen, ends));
    }
    if let (Some((&a, seen)), Some((&b, ends))) = (seen.split_first(), ends.split_first()) {
        begin_with(Element::Matched { seen: a, end: b }, merges(seen, ends));
    }
    merged
}

fn is_reading(chart: &Chart, sight: Sight, sequence: &[Element]) -> bool {
    let pairs: Vec<(usize, EndId)> = sequence
        .iter()
        .filter_map(|&element| match element {
            Element::Matched { seen, end } => Some((seen, end)),
            Element::Missed(_) | Element::New(_) => None,
        })
        .collect();
    let same_label = |&(a, x): &(usize, EndId)| sight.star.ends()[a].label == chart.ends[x].label;
    !pairs.is_empty()
        && pairs.iter().all(same_label)
        && pairs.iter().all(|&pair| opposites_agree(chart, sight, &pairs, pair))
        && (pairs.len() < sequence.len() || is_isomorphism(chart, sight, &pairs))
}

/// a is matched to x: their opposites are matched to each other, or each is closed, new or missed as allowed.
fn opposites_agree(chart: &Chart, sight: Sight, pairs: &[(usize, EndId)], (a, x): (usize, EndId)) -> bool {
    let (opposite_a, opposite_x) = (opposite(sight.star, a), chart.ends[x].opposite);
    let image = pairs.iter().find(|pair| pair.0 == opposite_a).map(|pair| pair.1);
    let preimage = pairs.iter().find(|pair| pair.1 == opposite_x).map(|pair| pair.0);
    match (image, preimage) {
        (Some(end), _) => end == opposite_x,
        (None, Some(_)) => false,
        // New in the star: closed here. Closed in the star: closed here, or open and missed.
        (None, None) => !sight.is_open(opposite_a) || !chart.ends[opposite_x].open,
    }
}

/// Whether all pairs belong to one isomorphism, closed ends included (Definition 2.2).
fn is_isomorphism(chart: &Chart, sight: Sight, pairs: &[(usize, EndId)]) -> bool {
    let here = chart.star(chart.ends[pairs[0].1].place);
    let degree = here.ends().len();
    isomorphisms(sight.star, &here)
        .into_iter()
        .any(|rotation| pairs.iter().all(|&(a, x)| (a + rotation) % degree == chart.position(x).1))
}
