//! Simulated worlds and routes through them; knows nothing of the mapper.
//!
//! A [`World`] is the truth that a mapper is asked to find: places with positions and stars, and
//! links between their gateways. Build one with [`grid`], [`offices`], [`random_planar`] or from a
//! [`StreetNetwork`]; send a robot through it on a [`Route`]; [`World::explore`] writes down what
//! the robot saw and did, and nothing else. What it measures on the way errs as [`PolarNoise`] or
//! [`DriftModel`] says: [`World::explore_with_odometry`].
//!
//! All place frames are aligned with the world: x points east, y north, both in metres.
//!
//! ```
//! use hssh_world::{grid, snake};
//!
//! let world = grid(3, 3, 8.0)?;
//! let route = world.route_through(&snake(3, 3))?;
//! let exploration = world.explore(&route)?;
//! assert_eq!(exploration.travels().len(), 16);
//! assert_eq!(exploration.star_types().len(), 9);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod crossing;
mod drift;
mod explore;
mod floor_plan;
mod geometry;
pub mod graphml;
mod grid;
mod misperception;
pub mod momepy;
mod noise;
mod offices;
mod path;
mod plans;
mod polar;
mod random;
pub mod robot;
mod route;
pub mod strategies;
mod streets;
mod walk;
mod world;

pub use drift::DriftModel;
pub use floor_plan::{FloorPlanError, floor_plan};
pub use geometry::Point;
pub use grid::{grid, snake, thesis_3x4};
pub use misperception::{ErrorRates, Misperceived};
pub use noise::{DriftError, OdometryNoise};
pub use offices::{OfficePlan, offices};
pub use path::Path;
pub use plans::{Floor, floors};
pub use polar::PolarNoise;
pub use random::random_planar;
pub use route::{Route, RouteError};
pub use streets::{Crossing, Street, StreetError, StreetNetwork, StreetProblem};
pub use walk::{cover, random_walk};
pub use world::{Link, Place, PlaceId, World, WorldError, WorldOlp};
