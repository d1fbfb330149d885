//! Paths, sides, faces and genus of a sketch, each traced from its definition.

use std::collections::BTreeSet;

use super::sketch::{End, Wiring};
use super::violation::TracedPath;
use crate::ids::PlaceId;

impl Wiring<'_> {
    /// From `end` straight ahead: at each place met, the end that looks ahead, `end` being the first;
    /// and whether the way comes around to `end` again.
    fn straight_ahead(&self, end: End) -> (Vec<End>, bool) {
        let mut headings = vec![end];
        let mut here = end;
        while let Some(entry) = self.partner(here) {
            here = self.opposite(entry);
            if here == end {
                return (headings, true);
            }
            headings.push(here);
        }
        (headings, false)
    }

    /// All paths; every local path lies on exactly one.
    pub(super) fn paths(&self) -> Vec<TracedPath> {
        let mut seen = BTreeSet::new();
        let mut paths = Vec::new();
        for end in self.places().flat_map(|place| self.ends_of(place)) {
            if seen.contains(&end) {
                continue;
            }
            let (backward, _) = self.straight_ahead(self.opposite(end));
            let first = self.opposite(backward[backward.len() - 1]);
            let (headings, circular) = self.straight_ahead(first);
            seen.extend(headings.iter().flat_map(|&heading| [heading, self.opposite(heading)]));
            paths.push(TracedPath { headings, circular });
        }
        paths
    }

    /// The places right of a path (section 2.3.2): some path leaves it by an end on its right-hand
    /// side and reaches them going that way.
    pub(super) fn right_of(&self, path: &TracedPath) -> BTreeSet<PlaceId> {
        self.reached_to_the_right(path.headings.iter().copied())
    }

    /// The places left of a path: right of it in the other direction.
    pub(super) fn left_of(&self, path: &TracedPath) -> BTreeSet<PlaceId> {
        self.reached_to_the_right(path.headings.iter().map(|&heading| self.opposite(heading)))
    }

    fn reached_to_the_right(&self, headings: impl Iterator<Item = End>) -> BTreeSet<PlaceId> {
        let mut reached = BTreeSet::new();
        for heading in headings {
            let behind = self.opposite(heading);
            let clockwise = self.ends_of(heading.place).chain(self.ends_of(heading.place));
            let right = clockwise.skip_while(|&end| end != heading).skip(1).take_while(|&end| end != behind);
            for leaving in right {
                let (way, comes_back) = self.straight_ahead(leaving);
                reached.extend(way.iter().skip(1).map(|end| end.place));
                if comes_back {
                    reached.insert(leaving.place);
                }
            }
        }
        reached
    }

    /// (|E| + 2c − |V| − |I| − f) / 2, by Euler and Poincaré (section 3.2).
    pub(super) fn genus(&self) -> usize {
        let linked: BTreeSet<PlaceId> = self.linked_ends().map(|end| end.place).collect();
        let vertices = self.places().count();
        let (edges, isolated) = (self.linked_ends().count() / 2, vertices - linked.len());
        (edges + 2 * self.component_count() - vertices - isolated - self.face_count()) / 2
    }

    /// f: the orbits of `next(e) = pred(rev(e))` (Definition 3.1).
    fn face_count(&self) -> usize {
        let mut seen = BTreeSet::new();
        let mut faces = 0;
        for start in self.linked_ends() {
            let mut dart = start;
            faces += usize::from(!seen.contains(&start));
            while seen.insert(dart) {
                dart = self.next_on_face(dart);
            }
        }
        faces
    }

    /// The first linked end counterclockwise of where the link of `dart` arrives.
    fn next_on_face(&self, dart: End) -> End {
        let Some(arrival) = self.partner(dart) else { return dart };
        let mut linked: Vec<End> =
            self.ends_of(arrival.place).filter(|&end| self.partner(end).is_some()).collect();
        linked.reverse(); // counterclockwise
        let at = linked.iter().position(|&end| end == arrival).unwrap_or(0);
        linked[(at + 1) % linked.len()]
    }

    /// c: how many places remain if links are contracted.
    fn component_count(&self) -> usize {
        let mut component: Vec<PlaceId> = self.places().collect();
        for end in self.linked_ends() {
            let Some(far) = self.partner(end) else { continue };
            let (here, there) = (component[end.place.index()], component[far.place.index()]);
            component.iter_mut().filter(|other| **other == there).for_each(|other| *other = here);
        }
        component.into_iter().collect::<BTreeSet<_>>().len()
    }
}
