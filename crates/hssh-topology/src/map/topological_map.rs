//! The map itself: its places, ends, links and counts (section 2.3).

use super::boundaries::Boundaries;
use super::record::{Change, Direction, OlpRecord, PathRecord, PlaceRecord, Tally};
use crate::embedding::{EmbeddedGraph, PendingEdge};
use crate::ids::{Dart, MapOlp, Olp, PathId, PlaceId, StarId};
use crate::live::LiveList;

/// A topological map: places with stars, links between gateways, pending gateways and paths.
///
/// It grows by [`add_place`](Self::add_place) and [`link`](Self::link) and shrinks by
/// [`retract`](Self::retract), last in first out. Path identities, the faces and genus of the
/// underlying embedded graph, the boundary relations and every count are carried along.
#[derive(Clone, Debug)]
pub struct TopologicalMap {
    pub(super) places: Vec<PlaceRecord>,
    pub(super) olps: Vec<OlpRecord>,
    /// The gateway that each dart of the embedded graph stands for.
    pub(super) gateways: Vec<MapOlp>,
    pub(super) graph: EmbeddedGraph,
    pub(super) paths: Vec<PathRecord>,
    /// The paths that are no part of another one.
    pub(super) live_paths: LiveList,
    /// If they are carried along.
    pub(super) boundaries: Option<Boundaries>,
    pub(super) tally: Tally,
    pub(super) history: Vec<Change>,
}

/// A gateway that is not linked: what can be. It comes from a map, which is asked for it
/// ([`TopologicalMap::pending`]), and is stale once that map links it or takes it back.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct PendingGateway {
    pub(super) olp: MapOlp,
    pub(super) edge: PendingEdge,
}

impl PendingGateway {
    /// The gateway.
    #[must_use]
    pub fn olp(self) -> MapOlp {
        self.olp
    }

    /// The pending edge that stands for it in the embedded graph.
    #[must_use]
    pub fn edge(self) -> PendingEdge {
        self.edge
    }
}

impl Default for TopologicalMap {
    fn default() -> Self {
        TopologicalMap::new()
    }
}

impl TopologicalMap {
    /// The map without places. Its boundary relations are carried along.
    #[must_use]
    pub fn new() -> Self {
        TopologicalMap { boundaries: Some(Boundaries::default()), ..TopologicalMap::without_boundaries() }
    }

    /// The map without places. Its boundary relations are not carried along: whoever asks for one has all of them counted anew, for
    /// about as much time as the square of the map's places. A growth takes no more time and memory than the shorter one of two paths
    /// that it joins.
    #[must_use]
    pub fn without_boundaries() -> Self {
        TopologicalMap {
            places: Vec::new(),
            olps: Vec::new(),
            gateways: Vec::new(),
            graph: EmbeddedGraph::default(),
            paths: Vec::new(),
            live_paths: LiveList::default(),
            boundaries: None,
            tally: Tally::default(),
            history: Vec::new(),
        }
    }

    /// The number of places: f3 of section 2.3.2.
    #[must_use]
    pub fn place_count(&self) -> u32 {
        self.places.len() as u32
    }

    /// The number of links between gateways.
    #[must_use]
    pub fn link_count(&self) -> u32 {
        self.tally.links
    }

    /// The number of paths, those with a single place among them: f2 of section 2.3.2.
    #[must_use]
    pub fn path_count(&self) -> u32 {
        self.tally.paths
    }

    /// The number of paths with at least two places: f2' of section 4.7.1.
    #[must_use]
    pub fn long_path_count(&self) -> u32 {
        self.tally.long_paths
    }

    /// How many ends of paths with at least two places are closed. They stay so.
    #[must_use]
    pub fn closed_ends_of_long_paths(&self) -> u32 {
        2 * (self.tally.long_paths - self.tally.long_circles) - self.pending_ends_of_long_paths()
    }

    /// How many ends of paths with at least two places are pending.
    #[must_use]
    pub fn pending_ends_of_long_paths(&self) -> u32 {
        self.pending_count() - self.tally.loose_gateways
    }

    /// The number of closed ends. Every path has two ends, so that at least half as many paths
    /// will be there however the map grows.
    #[must_use]
    pub fn closed_end_count(&self) -> u32 {
        self.tally.closed_ends
    }

    /// How many pairs of a path and a place off the path have no boundary relation, or both: f1 of
    /// section 2.3.2.
    #[must_use]
    pub fn undetermined_boundary_count(&self) -> u64 {
        u64::from(self.tally.paths) * u64::from(self.place_count())
            - self.tally.incidences
            - self.boundary_sums().determined
    }

    /// How many pairs of a path and a place contradict axiom 6: the place is on both sides of the
    /// path, or beside a path that it lies on.
    #[must_use]
    pub fn contradictory_boundary_count(&self) -> u64 {
        self.boundary_sums().contradictory
    }

    /// The number of pending gateways.
    #[must_use]
    pub fn pending_count(&self) -> u32 {
        self.graph.pending_count()
    }

    /// Whether no gateway is pending: a closed map in the sense of section 3.3.
    #[must_use]
    pub fn is_closed(&self) -> bool {
        self.pending_count() == 0
    }

    /// Whether no pending gateway lies on a path with a single place: what the table of Figure 3.3
    /// counts as closed.
    #[must_use]
    pub fn is_nearly_closed(&self) -> bool {
        self.tally.loose_gateways == 0
    }

    /// The underlying embedded graph: places as vertices, gateways as darts, links as edges.
    #[must_use]
    pub fn graph(&self) -> &EmbeddedGraph {
        &self.graph
    }

    /// The places in order of creation.
    pub fn places(&self) -> impl ExactSizeIterator<Item = PlaceId> + use<> {
        (0..self.place_count()).map(PlaceId::new)
    }

    /// Which star a place has.
    #[must_use]
    pub fn star(&self, place: PlaceId) -> StarId {
        self.places[place.index()].star
    }

    /// The number of oriented local paths of all places.
    #[must_use]
    pub fn olp_count(&self) -> u32 {
        self.olps.len() as u32
    }

    /// The oriented local paths of a place, clockwise.
    pub fn olps_of(&self, place: PlaceId) -> impl ExactSizeIterator<Item = MapOlp> + use<> {
        let end = self.places.get(place.index() + 1).map_or(self.olps.len() as u32, |next| next.first);
        (self.places[place.index()].first as usize..end as usize).map(|olp| MapOlp::new(olp as u32))
    }

    /// An oriented local path of a place's star.
    #[must_use]
    pub fn olp(&self, place: PlaceId, olp: Olp) -> MapOlp {
        MapOlp::new(self.places[place.index()].first + olp.number())
    }

    /// An oriented local path of the place that [`add_place`](Self::add_place) would add now.
    #[must_use]
    pub fn olp_of_next_place(&self, olp: Olp) -> MapOlp {
        MapOlp::new(self.olp_count() + olp.number())
    }

    /// The path that an oriented local path lies on.
    #[must_use]
    pub fn path(&self, olp: MapOlp) -> PathId {
        self.olps[olp.index()].path
    }

    /// Which way along its path an oriented local path points.
    #[must_use]
    pub fn direction(&self, olp: MapOlp) -> Direction {
        self.olps[olp.index()].direction
    }

    /// Which oriented local path of its star it is.
    #[must_use]
    pub fn local(&self, olp: MapOlp) -> Olp {
        Olp::new(olp.number() - self.places[self.place(olp).index()].first)
    }

    /// The place whose star it belongs to.
    #[must_use]
    pub fn place(&self, olp: MapOlp) -> PlaceId {
        self.olps[olp.index()].place
    }

    /// The other direction of the same local path.
    #[must_use]
    pub fn opposite(&self, olp: MapOlp) -> MapOlp {
        self.olps[olp.index()].opposite
    }

    /// The gateway that a gateway is linked to; `None` if it is pending, or a closed end.
    #[must_use]
    pub fn linked(&self, olp: MapOlp) -> Option<MapOlp> {
        let link = self.olps[olp.index()].link;
        (link != olp).then_some(link)
    }

    /// Whether it is a gateway that is not linked yet.
    #[must_use]
    pub fn is_pending(&self, olp: MapOlp) -> bool {
        self.dart(olp).is_some() && self.linked(olp).is_none()
    }

    /// The dart that stands for a gateway; `None` for a closed end.
    #[must_use]
    pub fn dart(&self, olp: MapOlp) -> Option<Dart> {
        self.olps[olp.index()].dart
    }

    /// The gateway that a dart stands for.
    #[must_use]
    pub fn gateway(&self, dart: Dart) -> MapOlp {
        self.gateways[dart.index()]
    }

    /// The oriented local path as a pending gateway, if it is one.
    #[must_use]
    pub fn pending(&self, olp: MapOlp) -> Option<PendingGateway> {
        let edge = self.graph.pending(self.dart(olp)?)?;
        Some(PendingGateway { olp, edge })
    }

    /// The pending gateways in order of creation.
    pub fn pending_gateways(&self) -> impl Iterator<Item = PendingGateway> + '_ {
        self.graph.pending_edges().map(|edge| PendingGateway { olp: self.gateway(edge.dart()), edge })
    }

    /// All links, each once, as pairs of gateways in ascending order.
    pub fn links(&self) -> impl Iterator<Item = (MapOlp, MapOlp)> + '_ {
        let olps = (0..self.olps.len() as u32).map(MapOlp::new);
        olps.filter_map(|olp| self.linked(olp).filter(|&other| olp < other).map(|other| (olp, other)))
    }

    /// Whether two pending gateways lie in the same face, so that linking them keeps the genus.
    #[must_use]
    pub fn share_face(&self, a: PendingGateway, b: PendingGateway) -> bool {
        self.graph.face_of(a.edge) == self.graph.face_of(b.edge)
    }
}
