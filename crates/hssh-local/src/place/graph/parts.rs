//! Which part of the medial axis belongs to which place.

use super::section::{Section, Way};

/// A place of a grid: an index into [`PlaceGraph::places`](super::PlaceGraph::places).
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct PlaceNumber(pub u32);

impl PlaceNumber {
    /// The place as an index.
    #[must_use]
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

/// Which part of the axis belongs to which place.
#[derive(Clone, Debug, Default)]
pub(super) struct Parts {
    /// The sections with the places at their ends.
    pub(super) sections: Vec<PlacedSection>,
    /// The place of each edge that lies inside one.
    pub(super) inner: Vec<Option<PlaceNumber>>,
}

/// A section with what belongs to the places at its ends.
#[derive(Clone, Debug)]
pub(super) struct PlacedSection {
    pub(super) edge: usize,
    pub(super) range: [usize; 2],
    /// For each end the place there and the position in the edge's points of the gateway to it.
    pub(super) ends: [Option<(PlaceNumber, usize)>; 2],
}

impl PlacedSection {
    pub(super) fn unplaced(section: &Section) -> Self {
        PlacedSection { edge: section.edge.index(), range: section.range, ends: [None; 2] }
    }

    /// The first points of a way, up to its gateway, belong to a place.
    pub(super) fn claim(&mut self, way: Way, place: PlaceNumber, gateway: usize) {
        let [first, last] = self.range;
        let at = if way.is_backward { last - gateway } else { first + gateway };
        self.ends[usize::from(way.is_backward)] = Some((place, at));
    }
}
