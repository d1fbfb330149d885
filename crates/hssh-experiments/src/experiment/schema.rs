//! What an experiment file says: `fixtures/experiments/*.ron`, one file for one published table.
//!
//! ```ron
//! (
//!     title: "Figure 3.3: search-space reduction",
//!     runs: [
//!         (
//!             name: "3×3 planar",
//!             world: grid(rows: 3, columns: 3),
//!             route: snake,
//!             axioms: (max_genus: 0),
//!             search: exhaustive,
//!             expected: [(source: "Figure 3.3", nodes: 240, maps: 147)],
//!         ),
//!     ],
//! )
//! ```
//!
//! Unknown fields are errors. Everything but `title`, `runs`, `name`, `world` and `search` may be left out.

use std::time::Duration;

use hssh_search::{Goal, Limits, Order, StopReason};
use hssh_topology::{Axioms, Preference};
use ron::extensions::Extensions;
use serde::Deserialize;

use crate::experiment::truth::Verdict;

/// One file.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Experiment {
    /// What the table is called.
    pub(crate) title: String,
    /// What a reader has to know about it.
    #[serde(default)]
    pub(crate) about: String,
    /// Whether `--all` leaves it out unless `--slow` is given.
    #[serde(default)]
    pub(crate) slow: bool,
    /// The columns of the table.
    pub(crate) runs: Vec<Run>,
}

/// One search: a column of the table.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Run {
    /// The column's head.
    pub(crate) name: String,
    /// Where the robot is.
    pub(crate) world: WorldSource,
    /// How it goes through the world; an exploration has its own route.
    pub(crate) route: Option<RouteSource>,
    /// The axioms of the maps; the published tables' axioms 1 and 2 by default.
    #[serde(default)]
    pub(crate) axioms: Axioms,
    /// The order of preference; (f1, f2, f3) by default.
    #[serde(default)]
    pub(crate) preference: Preference,
    /// How the tree is searched.
    pub(crate) search: Search,
    /// When to give up.
    #[serde(default)]
    pub(crate) limits: RunLimits,
    /// What should come out, by source.
    #[serde(default)]
    pub(crate) expected: Vec<Expected>,
}

/// A world, or what a robot wrote down of one.
#[derive(Clone, PartialEq, Debug, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub(crate) enum WorldSource {
    /// A rectangular grid (section 3.4).
    Grid { rows: u32, columns: u32 },
    /// A street network in the data folder: GraphML, or nodes and edges as text.
    Streets { file: String },
    /// A part of a Delaunay triangulation; `density` from 0, a tree, to 1, all of it.
    RandomPlanar { places: u32, density: f64, seed: u64 },
    /// An exploration in `fixtures`, with the names of the places truly visited if they are known.
    Exploration { file: String, visits: Option<Vec<String>> },
}

/// How the robot goes through a world.
#[derive(Clone, PartialEq, Debug, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub(crate) enum RouteSource {
    /// All rows of a grid, then all columns.
    Snake,
    /// The 21 travels of Figure 3.3 through the 3×4 grid.
    #[serde(rename = "thesis_3x4")]
    Thesis3x4,
    /// A walk that takes every link, or its first travels.
    Cover { seed: u64, travels: Option<usize> },
    /// A random walk that turns back only at dead ends.
    RandomWalk { travels: usize, seed: u64 },
    /// The places by number.
    Places(Vec<u32>),
}

/// How the tree is searched.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub(crate) enum Search {
    /// Level by level, keeping the tree.
    BreadthFirst,
    /// Depth-first, keeping nothing.
    Exhaustive,
    /// The best hypothesis first.
    BestFirst(Goal),
    /// The least bound first, until the answer is proved.
    Proof(Goal),
}

impl Search {
    /// The mapper's order, and what it accepts; `None` if it takes no mapper.
    pub(crate) fn order_and_goal(self) -> Option<(Order, Goal)> {
        match self {
            Search::Exhaustive => None,
            Search::BreadthFirst => Some((Order::BreadthFirst, Goal::AnyMap)),
            Search::BestFirst(goal) => Some((Order::BestFirst, goal)),
            Search::Proof(goal) => Some((Order::Proof, goal)),
        }
    }

    /// Whether it goes through all hypotheses, so that what it counts belongs to the exploration and
    /// not to the search.
    pub(crate) fn is_complete(self) -> bool {
        matches!(self, Search::BreadthFirst | Search::Exhaustive)
    }
}

/// When to give up.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub(crate) struct RunLimits {
    /// Nodes of the tree.
    pub(crate) nodes: Option<u64>,
    /// Seconds.
    pub(crate) seconds: Option<u64>,
    /// Bytes of the tree and the queue.
    pub(crate) bytes: Option<u64>,
}

impl From<RunLimits> for Limits {
    fn from(limits: RunLimits) -> Self {
        let time = limits.seconds.map(Duration::from_secs);
        Limits { nodes: limits.nodes, time, bytes: limits.bytes }
    }
}

/// Values from one source. Only those that are given are compared.
#[derive(Clone, PartialEq, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Expected {
    /// Who says so: a figure of the thesis, or how the value was found independently.
    pub(crate) source: String,
    /// The root and every child of every step.
    pub(crate) nodes: Option<u64>,
    /// The root's map and one for every child of an expansion.
    pub(crate) maps: Option<u64>,
    /// Nodes that an observation refuted.
    pub(crate) refuted: Option<u64>,
    /// Nodes that explain everything.
    pub(crate) final_maps: Option<u64>,
    /// Those without a pending gateway on a path with a single place: the thesis's table.
    pub(crate) nearly_closed: Option<u64>,
    /// Those without a pending gateway.
    pub(crate) closed: Option<u64>,
    /// Those that are perpendicular besides.
    pub(crate) perpendicular: Option<u64>,
    /// How many share the best rank.
    pub(crate) optimal: Option<u64>,
    /// (f1, f2, f3) of the best.
    pub(crate) best: Option<(u64, u32, u32)>,
    /// Nodes per level, the root first.
    pub(crate) levels: Option<Vec<u64>>,
    /// Why the search stopped.
    pub(crate) stop: Option<StopReason>,
    /// What became of the true map.
    pub(crate) true_map: Option<Verdict>,
}

impl Experiment {
    /// Reads an experiment file; `Some(…)` may be left out.
    ///
    /// # Errors
    /// With line and column.
    pub(crate) fn read(text: &str) -> Result<Self, ron::error::SpannedError> {
        ron::Options::default().with_default_extension(Extensions::IMPLICIT_SOME).from_str(text)
    }
}
