//! Regions: the faces of a map, bounded by places and paths (section 2.1.3).

use serde::Serialize;

use super::topological_map::TopologicalMap;
use crate::ids::{Dart, MapOlp, PathId, PlaceId};

/// A part of the environment enclosed by travels: a face of the embedded graph.
#[derive(Clone, PartialEq, Eq, Debug, Serialize)]
pub struct Region {
    /// The walk around the region, which lies on its right: the gateways left on the way.
    pub walk: Vec<MapOlp>,
    /// The places on the boundary, ascending.
    pub places: Vec<PlaceId>,
    /// The paths that run along the boundary, ascending.
    pub paths: Vec<PathId>,
    /// The pending gateways that open into the region, ascending (Definition 3.2).
    pub pending: Vec<MapOlp>,
}

impl TopologicalMap {
    /// The regions, in linear time. A map without links has none.
    #[must_use]
    pub fn regions(&self) -> Vec<Region> {
        let faces = self.graph.faces();
        faces
            .iter()
            .map(|face| {
                let walk: Vec<MapOlp> = face.iter().map(|&dart| self.gateway(dart)).collect();
                let places = sorted(walk.iter().map(|&olp| self.place(olp)));
                let paths = sorted(walk.iter().map(|&olp| self.path(olp)));
                let pending = sorted(face.iter().flat_map(|&dart| self.pending_before(dart)));
                Region { walk, places, paths, pending }
            })
            .collect()
    }

    /// The pending gateways in the corner that a walk along a face turns before it takes `dart`:
    /// those clockwise after `dart` up to the next edge.
    fn pending_before(&self, dart: Dart) -> impl Iterator<Item = MapOlp> + '_ {
        std::iter::successors(Some(self.graph.succ(dart)), |&next| Some(self.graph.succ(next)))
            .take_while(|&next| self.graph.is_pending(next))
            .map(|next| self.gateway(next))
    }
}

fn sorted<T: Ord>(items: impl Iterator<Item = T>) -> Vec<T> {
    let mut items: Vec<T> = items.collect();
    items.sort_unstable();
    items.dedup();
    items
}
