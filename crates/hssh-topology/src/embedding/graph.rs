//! A rotation system with the faces, components and genus that it carries along (section 3.2).

use super::components::Components;
use crate::ids::{Dart, FaceLabel, Vertex};
use crate::live::LiveList;

/// A graph with a clockwise order of the edges around each vertex; parallel edges and loops allowed.
///
/// The darts of a vertex are numbered consecutively in clockwise order. A dart is either linked to
/// another one, its [`rev`](Self::rev), and the two are the directed edges e_v and e_w of T(G); or
/// it is *pending*: it holds a position in the circular order but no edge is there yet.
///
/// [`link`](Self::link) turns two pending edges into an edge. The number of faces, the genus and
/// the face that each pending edge lies in are carried along, not recounted.
///
/// ```
/// use hssh_topology::{EmbeddedGraph, PendingEdge};
///
/// let mut graph = EmbeddedGraph::new();
/// graph.add_vertex(4); // one vertex, four pending edges: darts 0, 1, 2, 3 clockwise
/// let pending: Vec<PendingEdge> = graph.pending_edges().collect();
/// graph.link(pending[0], pending[2]); // a loop, which parts the other two
/// assert_ne!(graph.face_of(pending[1]), graph.face_of(pending[3]));
/// graph.link(pending[1], pending[3]); // crosses it
/// assert_eq!((graph.face_count(), graph.genus()), (1, 1)); // the torus
/// ```
#[derive(Clone, Debug)]
pub struct EmbeddedGraph {
    /// The first dart of each vertex, and one more entry that ends the last vertex.
    first: Vec<u32>,
    /// How many darts of each vertex are linked.
    pub(super) degree: Vec<u32>,
    pub(super) darts: Vec<DartRecord>,
    pub(super) components: Components,
    pub(super) counts: Counts,
    pub(super) pending: LiveList,
}

/// A dart that no edge is at: what can be linked. It comes from a graph, which is asked for it
/// ([`EmbeddedGraph::pending`]), and is stale once that graph links it.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct PendingEdge(Dart);

impl PendingEdge {
    /// The dart.
    #[must_use]
    pub fn dart(self) -> Dart {
        self.0
    }
}

/// Everything that is known of one dart.
#[derive(Clone, Copy, Debug)]
pub(super) struct DartRecord {
    pub(super) source: Vertex,
    /// The dart in the other direction, or the dart itself while it is pending.
    pub(super) rev: Dart,
    /// The face that a pending edge lies in; a linked dart keeps the label it had.
    pub(super) face: FaceLabel,
    /// The neighbors among the pending edges of the face, in the order in which a walk along the
    /// face meets them: counterclockwise around each vertex. A linked dart keeps those it had.
    pub(super) in_face: Neighbors,
}

/// The two neighbors in a circle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Neighbors {
    pub(super) before: Dart,
    pub(super) after: Dart,
}

/// The terms of the Euler–Poincaré formula.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub(super) struct Counts {
    pub(super) edges: u32,
    pub(super) components: u32,
    pub(super) isolated: u32,
    /// f + |I|: the plane around an isolated vertex counts as one face here, so that linking treats
    /// all vertices alike.
    pub(super) faces_and_isolated: u32,
    pub(super) pending: u32,
    pub(super) next_face: u32,
}

impl Default for EmbeddedGraph {
    fn default() -> Self {
        EmbeddedGraph::new()
    }
}

impl EmbeddedGraph {
    /// The empty graph.
    #[must_use]
    pub fn new() -> Self {
        EmbeddedGraph {
            first: vec![0],
            degree: Vec::new(),
            darts: Vec::new(),
            components: Components::default(),
            counts: Counts::default(),
            pending: LiveList::default(),
        }
    }

    /// Adds a vertex with that many pending edges, unconnected to all others.
    pub fn add_vertex(&mut self, degree: u32) -> Vertex {
        let vertex = self.push_vertex(degree);
        let face = self.fresh_face();
        let (first, end) = self.span(vertex);
        for dart in (first..end).map(Dart::new) {
            let in_face = Neighbors { before: self.succ(dart), after: self.pred(dart) };
            let record = &mut self.darts[dart.index()];
            (record.face, record.in_face) = (face, in_face);
            self.pending.push();
        }
        self.components.push();
        self.counts.components += 1;
        self.counts.isolated += 1;
        self.counts.faces_and_isolated += 1;
        self.counts.pending += degree;
        vertex
    }

    /// Takes back the last [`add_vertex`](Self::add_vertex).
    ///
    /// # Panics
    /// If there is no vertex, or if the last one has an edge.
    pub fn remove_last_vertex(&mut self) {
        let vertex = Vertex::new(self.vertex_count().checked_sub(1).expect("there is a vertex to remove"));
        assert!(self.is_isolated(vertex), "a vertex that is removed has no edge");
        let (first, end) = self.span(vertex);
        (first..end).for_each(|_| self.pending.pop());
        self.darts.truncate(first as usize);
        self.first.pop();
        self.degree.pop();
        self.components.pop();
        self.counts.components -= 1;
        self.counts.isolated -= 1;
        self.counts.faces_and_isolated -= 1;
        self.counts.pending -= end - first;
        self.counts.next_face -= 1;
    }

    pub(super) fn push_vertex(&mut self, degree: u32) -> Vertex {
        let vertex = Vertex::new(self.vertex_count());
        let first = self.darts.len() as u32;
        self.darts.extend((first..first + degree).map(|dart| {
            let alone = Neighbors { before: Dart::new(dart), after: Dart::new(dart) };
            DartRecord { source: vertex, rev: Dart::new(dart), face: FaceLabel::new(0), in_face: alone }
        }));
        self.first.push(first + degree);
        self.degree.push(0);
        vertex
    }

    /// Makes two pending darts each other's reverse.
    pub(super) fn join(&mut self, a: Dart, b: Dart) {
        for (dart, rev) in [(a, b), (b, a)] {
            let record = &mut self.darts[dart.index()];
            record.rev = rev;
            self.degree[record.source.index()] += 1;
        }
    }

    /// Makes two pending edges neighbors along their face.
    pub(super) fn tie(&mut self, before: Dart, after: Dart) {
        self.darts[before.index()].in_face.after = after;
        self.darts[after.index()].in_face.before = before;
    }

    pub(super) fn fresh_face(&mut self) -> FaceLabel {
        self.counts.next_face += 1;
        FaceLabel::new(self.counts.next_face - 1)
    }

    /// The darts of a vertex, as a range of numbers.
    fn span(&self, vertex: Vertex) -> (u32, u32) {
        (self.first[vertex.index()], self.first[vertex.index() + 1])
    }

    /// |V|.
    #[must_use]
    pub fn vertex_count(&self) -> u32 {
        self.first.len() as u32 - 1
    }

    /// |E|, without pending edges.
    #[must_use]
    pub fn edge_count(&self) -> u32 {
        self.counts.edges
    }

    /// c, the number of connected components.
    #[must_use]
    pub fn component_count(&self) -> u32 {
        self.counts.components
    }

    /// f, the number of faces (Definition 3.1). An isolated vertex has none.
    #[must_use]
    pub fn face_count(&self) -> u32 {
        self.counts.faces_and_isolated - self.counts.isolated
    }

    /// The number of pending edges.
    #[must_use]
    pub fn pending_count(&self) -> u32 {
        self.counts.pending
    }

    /// The least number of handles of a surface that the graph can be drawn on without crossings:
    /// (|E| + 2c − |V| − |I| − f) / 2.
    #[must_use]
    pub fn genus(&self) -> u32 {
        let counts = self.counts;
        (counts.edges + 2 * counts.components - self.vertex_count() - counts.faces_and_isolated) / 2
    }

    /// Whether the genus is 0.
    #[must_use]
    pub fn is_planar(&self) -> bool {
        self.genus() == 0
    }

    /// The vertices, in order of creation.
    pub fn vertices(&self) -> impl ExactSizeIterator<Item = Vertex> + use<> {
        (0..self.vertex_count()).map(Vertex::new)
    }

    /// The vertices without edges: I.
    pub fn isolated_vertices(&self) -> impl Iterator<Item = Vertex> + '_ {
        self.vertices().filter(|&vertex| self.is_isolated(vertex))
    }

    /// Whether no edge meets the vertex; pending edges are none.
    #[must_use]
    pub fn is_isolated(&self, vertex: Vertex) -> bool {
        self.degree[vertex.index()] == 0
    }

    /// The darts and pending edges of a vertex, clockwise.
    pub fn darts_of(&self, vertex: Vertex) -> impl ExactSizeIterator<Item = Dart> + use<> {
        let (first, end) = self.span(vertex);
        DartRange { next: first, end }
    }

    /// The number of darts, pending edges among them.
    #[must_use]
    pub fn dart_count(&self) -> u32 {
        self.darts.len() as u32
    }

    /// The vertex that a dart leaves.
    #[must_use]
    pub fn source(&self, dart: Dart) -> Vertex {
        self.darts[dart.index()].source
    }

    /// The vertex that a dart leads to, `None` for a pending edge.
    #[must_use]
    pub fn target(&self, dart: Dart) -> Option<Vertex> {
        self.rev(dart).map(|rev| self.source(rev))
    }

    /// The same edge in the other direction, `None` for a pending edge.
    #[must_use]
    pub fn rev(&self, dart: Dart) -> Option<Dart> {
        let rev = self.darts[dart.index()].rev;
        (rev != dart).then_some(rev)
    }

    /// Whether no edge is there yet.
    #[must_use]
    pub fn is_pending(&self, dart: Dart) -> bool {
        self.darts[dart.index()].rev == dart
    }

    /// The next dart or pending edge clockwise around the source.
    #[must_use]
    pub fn succ(&self, dart: Dart) -> Dart {
        let (first, end) = self.span(self.source(dart));
        Dart::new(if dart.number() + 1 == end { first } else { dart.number() + 1 })
    }

    /// The next dart or pending edge counterclockwise around the source.
    #[must_use]
    pub fn pred(&self, dart: Dart) -> Dart {
        let (first, end) = self.span(self.source(dart));
        Dart::new(if dart.number() == first { end - 1 } else { dart.number() - 1 })
    }

    /// The dart as a pending edge, if it is one.
    #[must_use]
    pub fn pending(&self, dart: Dart) -> Option<PendingEdge> {
        self.is_pending(dart).then_some(PendingEdge(dart))
    }

    /// The face that a pending edge lies in (Definition 3.2).
    #[must_use]
    pub fn face_of(&self, edge: PendingEdge) -> FaceLabel {
        debug_assert!(self.is_pending(edge.0), "a stale pending edge");
        self.darts[edge.0.index()].face
    }

    /// All pending edges, ascending.
    pub fn pending_edges(&self) -> impl Iterator<Item = PendingEdge> + '_ {
        self.pending.iter().map(|dart| PendingEdge(Dart::new(dart)))
    }

    /// The pending edges of the face that `edge` lies in, from `edge` on, as a walk along the face
    /// meets them.
    pub fn pending_edges_of_face(&self, edge: PendingEdge) -> impl Iterator<Item = PendingEdge> + '_ {
        debug_assert!(self.is_pending(edge.0), "a stale pending edge");
        let mut next = Some(edge.0);
        std::iter::from_fn(move || {
            let current = next?;
            let after = self.darts[current.index()].in_face.after;
            next = (after != edge.0).then_some(after);
            Some(PendingEdge(current))
        })
    }

    /// Whether two vertices lie in the same component.
    #[must_use]
    pub fn are_connected(&self, a: Vertex, b: Vertex) -> bool {
        self.components.root(a.number()) == self.components.root(b.number())
    }
}

/// The darts of one vertex.
struct DartRange {
    next: u32,
    end: u32,
}

impl Iterator for DartRange {
    type Item = Dart;

    fn next(&mut self) -> Option<Dart> {
        (self.next < self.end).then(|| {
            self.next += 1;
            Dart::new(self.next - 1)
        })
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        let left = (self.end - self.next) as usize;
        (left, Some(left))
    }
}

impl ExactSizeIterator for DartRange {}
