//! Faces of an embedded graph, traced dart by dart (Definition 3.1).

use super::graph::EmbeddedGraph;
use crate::ids::Dart;

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
}
