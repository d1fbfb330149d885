//! Topological maps and search trees as pictures: SVG and Graphviz DOT.
//!
//! A [`Drawing`] says where each place is drawn and which way each end of its star points, from measured
//! poses or from the map alone. [`draw_map`] and [`map_to_dot`] draw one map, [`draw_tree`] and
//! [`tree_to_dot`] a search tree in the manner of the thesis's Figure 2.5, [`draw_pose_graph`] a pose graph with its
//! closures and covariances. Equal input gives equal text.
//!
//! ```
//! use hssh_draw::{Bearings, Drawing, MapOptions, draw_map};
//! use hssh_topology::{Olp, Star, StarCatalog, TopologicalMap};
//!
//! let mut catalog = StarCatalog::new();
//! let crossing: Star = "0+ 1+ 0- 1-".parse()?;
//! let id = catalog.intern(&crossing);
//! let mut map = TopologicalMap::new();
//! let (west, east) = (map.add_place(id, &crossing), map.add_place(id, &crossing));
//! let pending = |place, end| map.pending(map.olp(place, Olp::new(end))).expect("nothing is linked yet");
//! map.link(pending(west, 1), pending(east, 3));
//!
//! let drawing = Drawing::schematic(&map, &Bearings::none())?;
//! let options = MapOptions { current: Some(east), ..MapOptions::default() };
//! assert!(draw_map(&map, &drawing, &options).starts_with("<svg"));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod curve;
mod drawing;
mod graph;
mod grid;
mod interior;
mod map;
mod palette;
mod svg;
mod tree;

pub use drawing::{Bearings, Drawing, DrawingError};
pub use graph::{EdgeKind, PoseGraphOptions, draw_pose_graph};
pub use grid::{GridPicture, RegionPicture, TOLD_WAY, TRUE_WAY, draw_grid};
pub use map::{BuildingPicture, MapOptions, draw_map, map_to_dot};
pub use tree::{Fate, SearchTree, TreeError, TreeNode, TreeOptions, draw_tree, tree_to_dot};
