//! Building an embedded graph from its links at once, in linear time.

use super::components::Components;
use super::graph::{Counts, EmbeddedGraph};
use crate::ids::{Dart, FaceLabel};
use crate::live::LiveList;

/// Why a list of links is no embedded graph.
#[derive(Clone, PartialEq, Eq, Debug, thiserror::Error)]
pub enum EmbeddingError {
    /// A link names a dart that no vertex has.
    #[error("dart {0} does not exist: the vertices have {1} darts together")]
    NoSuchDart(Dart, u32),
    /// A dart is linked twice, or to itself.
    #[error("dart {0} is linked twice or to itself: a dart has one other end")]
    LinkedTwice(Dart),
}

impl EmbeddedGraph {
    /// A graph from the degrees of its vertices and the pairs of darts that form its edges, in
    /// linear time. Darts are numbered vertex by vertex, clockwise. Darts in no link are pending.
    ///
    /// # Errors
    /// If a dart does not exist or is used twice.
    pub fn from_links(
        degrees: impl IntoIterator<Item = u32>,
        links: impl IntoIterator<Item = (Dart, Dart)>,
    ) -> Result<Self, EmbeddingError> {
        let mut graph = EmbeddedGraph::new();
        for degree in degrees {
            graph.push_vertex(degree);
        }
        for (a, b) in links {
            for dart in [a, b] {
                if dart.index() >= graph.darts.len() {
                    return Err(EmbeddingError::NoSuchDart(dart, graph.darts.len() as u32));
                }
                if a == b || !graph.is_pending(dart) {
                    return Err(EmbeddingError::LinkedTwice(dart));
                }
            }
            graph.join(a, b);
        }
        graph.recount();
        Ok(graph)
    }

    /// Counts everything anew from the links alone, in linear time.
    fn recount(&mut self) {
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
}
