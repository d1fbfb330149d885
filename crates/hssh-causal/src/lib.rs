//! Control and causal input: explorations as plain data, and the RON text they are written in.
//!
//! An exploration is what a topological mapper works from (section 2.3 of the thesis): the star
//! that the robot saw first and its travels ⟨exit, entry, star⟩, each with the odometry measured
//! on the way if there was any. [`Exploration`] is that as data; the text looks like this:
//!
//! ```
//! use hssh_causal::Exploration;
//!
//! let exploration = Exploration::from_ron(
//!     r##"
//! Exploration(
//!     stars: {
//!         // Ends in clockwise order, both ends of every local path.
//!         "corner": ["0+", "1+ closed", "0- closed", "1-"],
//!         // Bearings in degrees counterclockwise, a label behind `#`.
//!         "door": ["0+ @90 #office", "0- @-90"],
//!     },
//!     start: "corner",
//!     travels: [
//!         (exit: "0+", entry: "0-", star: "door"),
//!         // Metres and radians; the covariance as three rows, or only its diagonal.
//!         (exit: "0+", entry: "1-", star: "corner",
//!          odometry: (x: 0.1, y: 7.9, theta: -1.57, covariance: [0.04, 0.04, 0.001])),
//!     ],
//! )"##,
//! )?;
//! assert_eq!(exploration.travels().len(), 2);
//! assert_eq!(Exploration::from_ron(&exploration.to_ron())?, exploration);
//! # Ok::<(), hssh_causal::ParseError>(())
//! ```
//!
//! The page `docs/exploration-format.md` of the repository explains every field, its unit and its
//! frame. A mistake is reported with line and column, and with what would be right:
//!
//! ```
//! # use hssh_causal::Exploration;
//! let text = r#"(stars: {"L": ["0+ closed", "0-"]}, start: "L", travels: [(exit: "0+", entry: "0-", star: "L")])"#;
//! let error = Exploration::from_ron(text).unwrap_err();
//! assert_eq!((error.line(), error.column()), (1, 66));
//! assert_eq!(
//!     error.render("loop.ron", text),
//!     r#"error: travel 1 leaves star `L` by `0+`, which is closed
//!  --> loop.ron:1:66
//!   |
//! 1 | (stars: {"L": ["0+ closed", "0-"]}, start: "L", travels: [(exit: "0+", entry: "0-", star: "L")])
//!   |                                                                  ^^^^
//! help: travelable in `L`: `0-`; otherwise another star was seen here"#
//! );
//! ```

mod bearings;
pub mod control;
mod doubt;
mod exploration;
mod format;
pub mod schema;

pub use bearings::{BearingError, check_bearings};
pub use doubt::{Doubt, Question};
pub use exploration::{
    Exploration, ExplorationError, NamedStar, Odometry, OdometryError, StarType, Travel, TravelError,
};
pub use format::{ParseError, Problem};
