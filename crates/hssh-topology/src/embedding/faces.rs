//! Faces of an embedded graph, traced dart by dart (Definition 3.1).

use super::{Components, Counts, EmbeddedGraph};
use crate::ids::{Dart, FaceLabel};
use crate::live::LiveList;

/// The faces of an embedded graph: each a closed walk that keeps the wall to its right.
#[derive(Clone, PartialEq, Eq, Debug)]
pub struct Faces {
    darts: Vec<Dart>,
    /// Where each face ends in `darts`.
    ends: Vec<u32>,
}

impl Faces {
    /// How many there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// Whether there is none: whether the graph has no edge.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }

    /// The faces by their least dart, each as its cycle of darts.
    pub fn iter(&self) -> impl Iterator<Item = &[Dart]> {
        let starts = std::iter::once(0).chain(self.ends.iter().copied());
        starts.zip(&self.ends).map(|(start, &end)| &self.darts[start as usize..end as usize])
    }
}

impl EmbeddedGraph {
    /// `next(e) = pred(rev(e))`, pending edges skipped: the dart that follows along the face.
    /// `None` for a pending edge.
    #[must_use]
    pub fn next(&self, dart: Dart) -> Option<Dart> {
        let mut next = self.pred(self.rev(dart)?);
        while self.is_pending(next) {
            next = self.pred(next);
        }
        Some(next)
    }

    /// Traces all faces, in time and space linear in the number of darts.
    #[must_use]
    pub fn faces(&self) -> Faces {
        let mut faces = Faces { darts: Vec::with_capacity(self.darts.len()), ends: Vec::new() };
        let mut seen = vec![false; self.darts.len()];
        for start in (0..self.dart_count()).map(Dart::new) {
            let mut next = (!self.is_pending(start) && !seen[start.index()]).then_some(start);
            while let Some(dart) = next {
                seen[dart.index()] = true;
                faces.darts.push(dart);
                next = self.next(dart).filter(|next| !seen[next.index()]);
            }
            if faces.ends.last().copied().unwrap_or(0) < faces.darts.len() as u32 {
                faces.ends.push(faces.darts.len() as u32);
            }
        }
        faces
    }

    /// Counts everything anew from the links alone, in linear time.
    pub(super) fn recount(&mut self) {
        self.counts = Counts::default();
        self.components = Components::default();
        self.pending = LiveList::default();
        for _ in 0..self.vertex_count() {
            self.components.push();
        }
        self.counts.components = self.vertex_count();
        for dart in (0..self.dart_count()).map(Dart::new) {
            self.pending.push();
            let Some(rev) = self.rev(dart) else {
                self.counts.pending += 1;
                continue;
            };
            self.pending.leave(dart.number());
            if dart < rev {
                self.counts.edges += 1;
                let joined = self.components.unite(self.source(dart).number(), self.source(rev).number());
                self.counts.components -= u32::from(joined.is_some());
            }
        }
        self.counts.isolated = self.isolated_vertices().count() as u32;
        let walks = self.trace_walks();
        let without_darts = self.vertices().filter(|&v| self.darts_of(v).len() == 0).count();
        self.counts.faces_and_isolated = walks + without_darts as u32;
        // Every vertex has taken a label when it is removed again.
        self.counts.next_face = self.counts.faces_and_isolated.max(self.vertex_count());
    }

    /// Walks along every face and around every isolated vertex, and strings the pending edges met
    /// on the way together (Definition 3.2). The number of walks.
    fn trace_walks(&mut self) -> u32 {
        let mut walks = 0;
        let mut seen = vec![false; self.darts.len()];
        for start in (0..self.dart_count()).map(Dart::new) {
            if seen[start.index()] {
                continue;
            }
            let mut first_and_last: Option<(Dart, Dart)> = None;
            let mut dart = start;
            while !std::mem::replace(&mut seen[dart.index()], true) {
                if self.is_pending(dart) {
                    let (first, last) = first_and_last.unwrap_or((dart, dart));
                    self.tie(last, dart);
                    self.darts[dart.index()].face = FaceLabel::new(walks);
                    first_and_last = Some((first, dart));
                }
                // An edge leads to its other end; either way the walk goes on counterclockwise.
                dart = self.pred(self.darts[dart.index()].rev);
            }
            if let Some((first, last)) = first_and_last {
                self.tie(last, first);
            }
            walks += 1;
        }
        walks
    }

    /// Makes two pending edges neighbors along their face.
    pub(super) fn tie(&mut self, before: Dart, after: Dart) {
        self.darts[before.index()].in_face.after = after;
        self.darts[after.index()].in_face.before = before;
    }
}
