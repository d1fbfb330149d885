//! The causal level: views, actions, schemas, and the automaton they make (section 2.1.2).
//!
//! A robot's experience is a chain of causal schemas ⟨v, a, v'⟩: with view v it did action a and then had
//! view v'. An exploration tells that chain:
//!
//! ```
//! use hssh_causal::Exploration;
//! use hssh_causal::schema::{Automaton, Refutation, Sight, Trace, Turning};
//!
//! # let text = r#"(
//! #     stars: {"end": ["0+", "0- closed"], "middle": ["0+", "0-"]},
//! #     start: "end",
//! #     travels: [
//! #         (exit: "0+", entry: "0-", star: "middle"),
//! #         (exit: "0+", entry: "0-", star: "middle"),
//! #         (exit: "0+", entry: "0+", star: "end"),
//! #     ],
//! # )"#;
//! // A corridor: end, middle, middle, end, without any turn.
//! let exploration = Exploration::from_ron(text)?;
//! let trace = Trace::of(&exploration, Sight::Place, Turning::Direct).expect("there are travels");
//! let schemas: Vec<String> =
//!     trace.schemas().map(|schema| format!("⟨{}, {}, {}⟩", schema.from, schema.action, schema.to)).collect();
//! assert_eq!(
//!     schemas,
//!     ["⟨0+ (0-), travel, 0+ 0-⟩", "⟨0+ 0-, travel, 0+ 0-⟩", "⟨0+ 0-, travel, (0+) 0-⟩"]
//! );
//!
//! // The two middles look alike but are not one distinctive state: schemas 1 and 2 would contradict.
//! assert_eq!(Automaton::assuming(&trace, &[(1, 2)]), Err(Refutation::Schemas(1, 2)));
//! assert_eq!(Automaton::assuming(&trace, &[])?.views().len(), 4);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod action;
mod automaton;
mod dot;
mod recover;
mod stay;
mod trace;
mod view;

pub use action::{Action, Change};
pub use automaton::{Automaton, Refutation, StateId};
pub use dot::{numbered_views, view_graph_dot};
pub use recover::{RecoverError, exploration};
pub use stay::{Stay, stays};
pub use trace::{Schema, Step, Trace, Turning};
pub use view::{Sight, View};
