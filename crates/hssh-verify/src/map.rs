//! A topological map as a rotation system: places, their ends in clockwise order, and links between ends.
//!
//! It grows at its end and shrinks in the reverse order, as a walk through the tree of hypotheses needs it.

use crate::route::Shape;

/// No end: the end is not linked.
pub(crate) const NONE: usize = usize::MAX;

/// An end of a local path at a place.
#[derive(Clone, Copy)]
pub(crate) struct End {
    pub(crate) place: usize,
    /// The other end of the same local path.
    pub(crate) opposite: usize,
    /// The clockwise neighbor.
    pub(crate) next: usize,
    /// The end at the other side of the way, or [`NONE`].
    pub(crate) link: usize,
    pub(crate) open: bool,
}

impl End {
    /// A gateway not linked yet.
    pub(crate) fn is_pending(&self) -> bool {
        self.open && self.link == NONE
    }
}

/// A place: where its ends begin, its star type, and the visit on which it was new.
#[derive(Clone, Copy)]
pub(crate) struct Place {
    pub(crate) first_end: usize,
    pub(crate) shape: usize,
    pub(crate) visit: usize,
}

/// A map. The ends of a place follow one another, so that their numbers are those of the certificate.
#[derive(Default)]
pub(crate) struct Map {
    pub(crate) ends: Vec<End>,
    pub(crate) places: Vec<Place>,
    links: usize,
    open_ends: usize,
    visited: Vec<bool>,
}

impl Map {
    /// Adds a place without links.
    pub(crate) fn add_place(&mut self, kind: usize, shape: &Shape, visit: usize) {
        let (place, first_end, n) = (self.places.len(), self.ends.len(), shape.degree());
        self.places.push(Place { first_end, shape: kind, visit });
        self.ends.extend((0..n).map(|i| End {
            place,
            opposite: first_end + shape.opposite[i],
            next: first_end + (i + 1) % n,
            link: NONE,
            open: shape.open[i],
        }));
        self.open_ends += shape.gateways();
    }

    /// Takes the last place away, which has no links any more.
    pub(crate) fn remove_last_place(&mut self) {
        let place = self.places.pop().expect("a place was added before it is removed");
        self.open_ends -= self.ends[place.first_end..].iter().filter(|end| end.open).count();
        self.ends.truncate(place.first_end);
    }

    /// Links two pending gateways.
    pub(crate) fn link(&mut self, a: usize, b: usize) {
        (self.ends[a].link, self.ends[b].link) = (b, a);
        self.links += 1;
    }

    /// Takes a link away.
    pub(crate) fn unlink(&mut self, a: usize, b: usize) {
        (self.ends[a].link, self.ends[b].link) = (NONE, NONE);
        self.links -= 1;
    }

    /// How many gateways are not linked.
    pub(crate) fn pending(&self) -> usize {
        self.open_ends - 2 * self.links
    }

    /// How many ends are closed.
    pub(crate) fn closed_ends(&self) -> usize {
        self.ends.len() - self.open_ends
    }

    /// The genus, by Euler's formula V − E + F = 2 − 2g. Faces are the cycles of "along the way, then to the
    /// clockwise neighbor"; an end without a link is a dead end, around which a face goes.
    pub(crate) fn genus(&mut self) -> usize {
        self.visited.clear();
        self.visited.resize(self.ends.len(), false);
        let mut faces = 0;
        for start in 0..self.ends.len() {
            let mut end = start;
            if self.visited[start] {
                continue;
            }
            faces += 1;
            while !self.visited[end] {
                self.visited[end] = true;
                let link = self.ends[end].link;
                end = self.ends[if link == NONE { end } else { link }].next;
            }
        }
        (2 + self.links - self.places.len() - faces) / 2
    }
}
