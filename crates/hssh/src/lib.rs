//! The hybrid Spatial Semantic Hierarchy: topological maps of places that look alike.
//!
//! This crate gathers the library crates under one name, and has the way through all of them: [`pipeline::map`] takes an
//! exploration or a robot's laser log to an [`answer::Answer`]. From the text of an exploration to the best map:
//!
//! ```
//! use hssh::pipeline::{Input, MappingOptions, map};
//!
//! let text = r#"(
//!     stars: { "west": ["0+ @0", "0- @180 closed"], "east": ["0+ @0 closed", "0- @180"] },
//!     start: "west",
//!     travels: [(exit: "0+", entry: "0-", star: "east"), (exit: "0-", entry: "0+", star: "west")],
//! )"#;
//! let input = Input::from_ron("corridor", text)?;
//! let mapped = map(&input, &MappingOptions::default(), &Default::default())?;
//! let best = &mapped.answer.maps[0];
//! assert!(best.closed && best.places.len() == 2);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! And from a log, here one that a simulated robot kept, to the map and the grid of the building:
//!
//! ```
//! use hssh::answer::MapPicture;
//! use hssh::pipeline::{Input, MappingOptions, map};
//! # use hssh::world::{floor_plan, floors, robot::{RobotOptions, Strategy, drive}};
//! # let floor = floors().into_iter().find(|floor| floor.name == "ring").ok_or("no such floor")?;
//! # let grid = floor_plan(&floor.world, floor.width, 0.1)?;
//! # let log = drive(&grid, None, Strategy::Cover, &RobotOptions::default(), 1)?.to_carmen();
//! # let log = log.as_bytes();
//!
//! let options = MappingOptions::from_ron("(axioms: (max_genus: 0))")?;
//! let input = Input::from_log("ring", log, &options)?; // any reader: a file, plain or gzip
//! let mapped = map(&input, &options, &Default::default())?;
//! println!("{}", mapped.answer.verdict.sentence);
//! let svg = MapPicture::new(&mapped.answer.maps[0], None)?.to_svg();
//! let building = mapped.building(&input, 1)?;
//! # assert_eq!(mapped.answer.maps[0].places.len(), 4);
//! # assert!(svg.starts_with("<svg") && building.lattice().width() > 100);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod account;
pub mod answer;
pub mod export;
pub mod file;
pub mod graph;
pub mod kind;
pub mod online;
pub mod page;
pub mod pipeline;

#[doc(inline)]
pub use hssh_causal as causal;
#[doc(inline)]
pub use hssh_draw as draw;
#[doc(inline)]
pub use hssh_local as local;
#[doc(inline)]
pub use hssh_metrics as metrics;
#[doc(inline)]
pub use hssh_search as search;
#[doc(inline)]
pub use hssh_topology as topology;
#[doc(inline)]
pub use hssh_world as world;

/// The front page of the repository, so that its examples are tested.
#[cfg(doctest)]
#[doc = include_str!("../../../README.md")]
struct Readme;

/// What is said about pages, so that its example is tested.
#[cfg(doctest)]
#[doc = include_str!("../../../docs/report.md")]
struct Report;
