//! What a map is made of: records of its places, ends and paths, and of how it grew.

use serde::{Deserialize, Serialize};

use super::boundaries::Mark;
use crate::embedding::Link;
use crate::ids::{Dart, MapOlp, PathId, PlaceId, StarId};

/// The two directions along a path.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Debug, Serialize, Deserialize)]
pub enum Direction {
    /// `+`
    Downstream,
    /// `-`
    Upstream,
}

impl Direction {
    /// The other direction.
    #[must_use]
    pub fn reversed(self) -> Self {
        match self {
            Direction::Downstream => Direction::Upstream,
            Direction::Upstream => Direction::Downstream,
        }
    }
}

#[derive(Clone, Copy, Debug)]
pub(super) struct PlaceRecord {
    pub(super) star: StarId,
    /// The first of its oriented local paths.
    pub(super) first: u32,
}

#[derive(Clone, Copy, Debug)]
pub(super) struct OlpRecord {
    pub(super) place: PlaceId,
    /// The other end of the same local path.
    pub(super) opposite: MapOlp,
    /// The gateway it is linked to; itself while pending, and if closed.
    pub(super) link: MapOlp,
    /// Its directed edge in the embedded graph, if it is travelable.
    pub(super) dart: Option<Dart>,
    pub(super) path: PathId,
    /// Which way along its path it points.
    pub(super) direction: Direction,
}

/// The counts that axioms, preference and reports are made of.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub(super) struct Tally {
    pub(super) links: u32,
    pub(super) paths: u32,
    pub(super) closed_ends: u32,
    /// Pending gateways on paths with only one place.
    pub(super) loose_gateways: u32,
    /// Paths with at least two places.
    pub(super) long_paths: u32,
    /// Those of them that are circular.
    pub(super) long_circles: u32,
    /// The number of pairs ⟨path, place⟩ with the place on the path.
    pub(super) incidences: u64,
}

/// One step of growth, with what is needed to take it back.
#[derive(Clone, Debug)]
pub(super) enum Change {
    Place { tally: Tally },
    Link { a: MapOlp, b: MapOlp, link: Link, tally: Tally, boundaries: Mark, joined: Joined },
}

#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) struct PathRecord {
    /// How many local paths form it.
    pub(super) local_paths: u32,
    /// How many different places lie on it.
    pub(super) places: u32,
    /// How many of its two ends are pending gateways; the others are closed. A circular path has no ends.
    pub(super) pending_ends: u32,
    pub(super) state: PathState,
}

#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(super) enum PathState {
    /// A path with two ends.
    Open,
    /// A path that returns into itself.
    Circular,
    /// It became a part of another path.
    Absorbed,
}

impl PathRecord {
    /// A path of one local path.
    pub(super) fn single(pending_ends: u32) -> Self {
        PathRecord { local_paths: 1, places: 1, pending_ends, state: PathState::Open }
    }

    /// Whether it has at least two places.
    pub(super) fn is_long(&self) -> bool {
        self.places > 1
    }

    /// How many of the path's pending gateways are on a path with a single place.
    pub(super) fn loose_gateways(&self) -> u32 {
        if self.is_long() { 0 } else { self.pending_ends }
    }
}

/// How two paths became one, or one a circle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Joined {
    pub(super) into: PathId,
    pub(super) before: PathRecord,
    pub(super) absorbed: Option<Absorbed>,
}

/// A path that became part of another one.
#[derive(Clone, Copy, Debug)]
pub(super) struct Absorbed {
    /// The end of it that was linked.
    pub(super) at: MapOlp,
    pub(super) from: PathId,
    /// Whether it ran the other way.
    pub(super) flipped: bool,
}
