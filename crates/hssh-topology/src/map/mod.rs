//! Topological maps: places, the links between their gateways, and the paths these form (section 2.3).

mod boundary;
mod path;
mod region;
mod sanity;

pub use boundary::{BoundaryRelation, PathSides};
pub use path::{Course, Direction};
pub use region::Region;

use boundary::Boundaries;
use path::{Joined, PathRecord};

use crate::embedding::{EmbeddedGraph, Link, PendingEdge};
use crate::ids::{Dart, MapOlp, Olp, PathId, PlaceId, StarId};
use crate::live::LiveList;
use crate::star::Star;

/// A topological map: places with stars, links between gateways, pending gateways and paths.
///
/// It grows by [`add_place`](Self::add_place) and [`link`](Self::link) and shrinks by
/// [`retract`](Self::retract), last in first out. Path identities, the faces and genus of the
/// underlying embedded graph, the boundary relations and every count are carried along.
#[derive(Clone, Debug, Default)]
pub struct TopologicalMap {
    places: Vec<PlaceRecord>,
    olps: Vec<OlpRecord>,
    /// The gateway that each dart of the embedded graph stands for.
    gateways: Vec<MapOlp>,
    graph: EmbeddedGraph,
    paths: Vec<PathRecord>,
    /// The paths that are no part of another one.
    live_paths: LiveList,
    boundaries: Boundaries,
    tally: Tally,
    history: Vec<Change>,
}

/// A gateway that is not linked: what can be. It comes from a map, which is asked for it
/// ([`TopologicalMap::pending`]), and is stale once that map links it or takes it back.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug)]
pub struct PendingGateway {
    olp: MapOlp,
    edge: PendingEdge,
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

#[derive(Clone, Copy, Debug)]
struct PlaceRecord {
    star: StarId,
    /// The first of its oriented local paths.
    first: u32,
}

#[derive(Clone, Copy, Debug)]
struct OlpRecord {
    place: PlaceId,
    /// The other end of the same local path.
    opposite: MapOlp,
    /// The gateway it is linked to; itself while pending, and if closed.
    link: MapOlp,
    /// Its directed edge in the embedded graph, if it is travelable.
    dart: Option<Dart>,
    path: PathId,
    /// Which way along its path it points.
    direction: Direction,
}

/// The counts that axioms, preference and reports are made of.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
struct Tally {
    links: u32,
    paths: u32,
    closed_ends: u32,
    /// Pending gateways on paths with only one place.
    loose_gateways: u32,
    /// Paths with at least two places.
    long_paths: u32,
    /// Those of them that are circular.
    long_circles: u32,
    /// The number of pairs ⟨path, place⟩ with the place on the path.
    incidences: u64,
}

/// One step of growth, with what is needed to take it back.
#[derive(Clone, Debug)]
enum Change {
    Place { tally: Tally },
    Link { a: MapOlp, b: MapOlp, link: Link, tally: Tally, boundaries: boundary::Mark, joined: Joined },
}

impl TopologicalMap {
    /// The map without places.
    #[must_use]
    pub fn new() -> Self {
        TopologicalMap::default()
    }

    /// Adds a place with that star, its gateways pending, each of its local paths a path of its own.
    pub fn add_place(&mut self, id: StarId, star: &Star) -> PlaceId {
        let place = PlaceId::new(self.places.len() as u32);
        let first = self.olps.len() as u32;
        self.history.push(Change::Place { tally: self.tally });
        self.places.push(PlaceRecord { star: id, first });
        self.boundaries.make_room(self.places.len());

        let mut dart = self.graph.dart_count();
        self.graph.add_vertex(star.gateways().count() as u32);
        for olp in star.olps() {
            let here = MapOlp::new(first + olp.number());
            let opposite = MapOlp::new(first + star.opposite(olp).number());
            let is_new_path = here < opposite;
            let (path, direction) = if is_new_path {
                let ends = [olp, star.opposite(olp)];
                let pending = ends.iter().filter(|&&end| star.is_travelable(end)).count();
                (self.add_path(place, pending as u32), Direction::Downstream)
            } else {
                (self.olps[opposite.index()].path, Direction::Upstream)
            };
            let travelable = star.is_travelable(olp).then(|| {
                self.gateways.push(here);
                dart += 1;
                Dart::new(dart - 1)
            });
            self.tally.closed_ends += u32::from(travelable.is_none());
            self.tally.loose_gateways += u32::from(travelable.is_some());
            self.olps.push(OlpRecord { place, opposite, link: here, dart: travelable, path, direction });
        }
        place
    }

    fn add_path(&mut self, place: PlaceId, pending_ends: u32) -> PathId {
        let path = PathId::new(self.paths.len() as u32);
        self.paths.push(PathRecord::single(pending_ends));
        self.live_paths.push();
        self.boundaries.push_path(place);
        self.tally.paths += 1;
        self.tally.incidences += 1;
        path
    }

    /// Links two pending gateways: they become one edge, and their two paths one path.
    ///
    /// The two are different and pending in this map.
    pub fn link(&mut self, a: PendingGateway, b: PendingGateway) {
        let (edges, a, b) = ((a.edge, b.edge), a.olp, b.olp);
        debug_assert!(a != b, "a link has two ends");
        debug_assert!(self.is_pending(a) && self.is_pending(b), "a stale pending gateway");
        let tally = self.tally;
        let boundaries = self.boundaries.mark();
        if self.path(a) == self.path(b) {
            self.see_path_from_itself(a);
        } else {
            self.see_path_beyond(a, self.path(b));
            self.see_path_beyond(b, self.path(a));
        }

        let link = self.graph.link(edges.0, edges.1);
        let joined = self.join_paths(a, b);
        self.olps[a.index()].link = b;
        self.olps[b.index()].link = a;
        self.tally.links += 1;
        self.history.push(Change::Link { a, b, link, tally, boundaries, joined });
    }

    /// Takes back the last [`add_place`](Self::add_place) or [`link`](Self::link). Nothing happens
    /// to an empty map.
    pub fn retract(&mut self) {
        match self.history.pop() {
            None => {}
            Some(Change::Place { tally }) => self.remove_last_place(tally),
            Some(Change::Link { a, b, link, tally, boundaries, joined }) => {
                self.olps[a.index()].link = a;
                self.olps[b.index()].link = b;
                self.part_paths(joined);
                self.boundaries.restore(boundaries);
                self.graph.unlink(link);
                self.tally = tally;
            }
        }
    }

    fn remove_last_place(&mut self, tally: Tally) {
        let Some(PlaceRecord { first, .. }) = self.places.pop() else { return };
        self.graph.remove_last_vertex();
        self.gateways.truncate(self.graph.dart_count() as usize);
        let paths = self.paths.len() - (self.olps.len() - first as usize) / 2;
        self.olps.truncate(first as usize);
        (paths..self.paths.len()).for_each(|_| self.live_paths.pop());
        self.paths.truncate(paths);
        self.boundaries.truncate(paths);
        self.tally = tally;
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
            - self.boundaries.determined()
    }

    /// How many pairs of a path and a place contradict axiom 6: the place is on both sides of the
    /// path, or beside a path that it lies on.
    #[must_use]
    pub fn contradictory_boundary_count(&self) -> u64 {
        self.boundaries.contradictory()
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
