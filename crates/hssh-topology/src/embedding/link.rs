//! Linking two pending edges: how faces split and merge (section 3.3).

use super::graph::{Counts, EmbeddedGraph, Neighbors, PendingEdge};
use crate::ids::{Dart, FaceLabel};

/// What [`EmbeddedGraph::link`] did, so that [`EmbeddedGraph::unlink`] can take it back.
#[derive(Clone, Debug)]
#[must_use = "a link can be taken back only with this"]
pub struct Link {
    a: Dart,
    b: Dart,
    counts: Counts,
    /// The stretch of pending edges that got another label, and the label it had.
    relabeled: Option<(Stretch, FaceLabel)>,
    /// The root that the union of two components hung.
    joined: Option<u32>,
}

/// Pending edges that follow one another along a face, both ends included.
#[derive(Clone, Copy, Debug)]
struct Stretch {
    first: Dart,
    last: Dart,
}

impl EmbeddedGraph {
    /// Makes two pending edges one edge.
    ///
    /// In the same face, the edge splits the face and keeps the genus. In two faces of one
    /// component it merges them and adds a handle; between two components it merges two faces and
    /// keeps the genus. Takes time proportional to the pending edges of the smaller part.
    ///
    /// The two are different and pending in this graph.
    pub fn link(&mut self, a: PendingEdge, b: PendingEdge) -> Link {
        let (a, b) = (a.dart(), b.dart());
        debug_assert!(a != b, "an edge has two ends");
        debug_assert!(self.is_pending(a) && self.is_pending(b), "a stale pending edge");
        let counts = self.counts;
        let (v, w) = (self.source(a), self.source(b));
        self.counts.isolated -= u32::from(self.is_isolated(v));
        self.counts.isolated -= u32::from(v != w && self.is_isolated(w));

        let relabeled = if self.darts[a.index()].face == self.darts[b.index()].face {
            self.split_face(a, b)
        } else {
            self.merge_faces(a, b)
        };
        let joined = self.components.unite(v.number(), w.number());
        self.counts.components -= u32::from(joined.is_some());
        self.counts.edges += 1;
        self.counts.pending -= 2;
        self.pending.leave(a.number());
        self.pending.leave(b.number());
        self.join(a, b);
        Link { a, b, counts, relabeled, joined }
    }

    /// Takes back a link. Links and vertices are taken back in the opposite order of their making.
    pub fn unlink(&mut self, link: Link) {
        let Link { a, b, counts, relabeled, joined } = link;
        if let Some((stretch, label)) = relabeled {
            self.relabel(stretch, label);
        }
        for dart in [b, a] {
            let record = &mut self.darts[dart.index()];
            record.rev = dart;
            self.degree[record.source.index()] -= 1;
            self.pending.rejoin(dart.number());
        }
        for dart in [a, b] {
            let Neighbors { before, after } = self.darts[dart.index()].in_face;
            self.darts[before.index()].in_face.after = dart;
            self.darts[after.index()].in_face.before = dart;
        }
        if let Some(root) = joined {
            self.components.divide(root);
        }
        self.counts = counts;
    }

    /// The face a … b … falls into the stretch after a up to b, and the one after b up to a.
    fn split_face(&mut self, a: Dart, b: Dart) -> Option<(Stretch, FaceLabel)> {
        let old = self.darts[a.index()].face;
        let inner = self.stretch_between(a, b);
        let outer = self.stretch_between(b, a);
        for stretch in [inner, outer].into_iter().flatten() {
            self.tie(stretch.last, stretch.first);
        }
        self.counts.faces_and_isolated += 1;
        let smaller = self.smaller(inner?, outer?);
        let fresh = self.fresh_face();
        self.relabel(smaller, fresh);
        Some((smaller, old))
    }

    /// The pending edges after a and those after b become neighbors across the new edge.
    fn merge_faces(&mut self, a: Dart, b: Dart) -> Option<(Stretch, FaceLabel)> {
        let rest_of_a = self.stretch_between(a, a);
        let rest_of_b = self.stretch_between(b, b);
        self.counts.faces_and_isolated -= 1;
        match (rest_of_a, rest_of_b) {
            (Some(rest_of_a), Some(rest_of_b)) => {
                let smaller = self.smaller(rest_of_a, rest_of_b);
                let from_a = smaller.first == rest_of_a.first;
                let (label, other) = if from_a { (a, b) } else { (b, a) };
                let (label, other) = (self.darts[label.index()].face, self.darts[other.index()].face);
                self.relabel(smaller, other);
                self.tie(rest_of_a.last, rest_of_b.first);
                self.tie(rest_of_b.last, rest_of_a.first);
                Some((smaller, label))
            }
            (Some(rest), None) | (None, Some(rest)) => {
                self.tie(rest.last, rest.first);
                None
            }
            (None, None) => None,
        }
    }

    /// The pending edges strictly after `a` and before `b` along their face; all but `a` if they
    /// are the same. `None` if there are none.
    fn stretch_between(&self, a: Dart, b: Dart) -> Option<Stretch> {
        let (first, last) = (self.darts[a.index()].in_face.after, self.darts[b.index()].in_face.before);
        (first != b).then_some(Stretch { first, last })
    }

    /// The shorter of two stretches, found in time proportional to its length.
    fn smaller(&self, one: Stretch, two: Stretch) -> Stretch {
        let (mut in_one, mut in_two) = (one.first, two.first);
        loop {
            if in_one == one.last {
                return one;
            }
            if in_two == two.last {
                return two;
            }
            in_one = self.darts[in_one.index()].in_face.after;
            in_two = self.darts[in_two.index()].in_face.after;
        }
    }

    fn relabel(&mut self, stretch: Stretch, label: FaceLabel) {
        let mut dart = stretch.first;
        loop {
            self.darts[dart.index()].face = label;
            if dart == stretch.last {
                return;
            }
            dart = self.darts[dart.index()].in_face.after;
        }
    }
}
