//! A simulated robot: it drives through a grid map by the control laws of section 2.1.1 and keeps a log.
//!
//! The robot is a disc with two wheels and a laser that looks all around, of which the front half is logged. What it
//! does follows from what it perceives: ranges, and the gateways of the place-neighborhood that it is in. It reads these
//! from a local perceptual map of its own, made of what its laser saw from where scan matching believes it was. Only
//! which gateway it takes is decided by somebody who knows the whole map: a [`Strategy`]. The truth is kept beside the
//! log: true poses, and at which places it centered.
//!
//! ```
//! use hssh_world::robot::{RobotOptions, Strategy, drive};
//! use hssh_world::{floor_plan, grid};
//!
//! let plan = floor_plan(&grid(2, 2, 12.0)?, 2.4, 0.1)?;
//! let options = RobotOptions { travels: 4, ..RobotOptions::default() };
//! let drive = drive(&plan, Some([0.0, 0.0]), Strategy::Cover, &options, 1)?;
//! assert_eq!(drive.stops.len(), 5, "where it started, and four travels");
//! assert!(drive.to_carmen().contains("\nFLASER 181 "));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod body;
mod carmen;
mod drive;
mod laser;
mod odometer;
mod options;
mod outlook;
mod record;
mod run;
mod strategy;
mod tour;

pub use body::touches;
pub use drive::{Drive, DriveError, drive, drive_until};
pub use laser::Laser;
pub use odometer::Odometer;
pub use options::RobotOptions;
pub use record::{Ending, Moment, Stop};
pub use strategy::Strategy;
pub use tour::{Tour, round_trip};
