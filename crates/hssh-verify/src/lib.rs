//! An independent checker of the proofs that the searches claim.
//!
//! A search writes a certificate: which nodes of the tree of hypotheses it expanded, which it left open and under what
//! bound, and which maps it found. [`verify`] walks that tree with a recursive step, a map, measures, bounds and least
//! squares of its own, and either confirms the claim or names the first line that does not hold. The format is
//! explained in `docs/certificate.md`.
//!
//! ```
//! use hssh_causal::Exploration;
//!
//! let exploration = Exploration::from_ron(
//!     r#"(stars: {"door": ["0+", "0-"]}, start: "door", travels: [(exit: "0+", entry: "0-", star: "door")])"#,
//! )?;
//! // The robot went through one door to another. The new place is the only successor: the first door again
//! // would be a circular path.
//! let certificate = format!(
//!     "hssh-certificate 1\n{}\naxioms {{}}\ngoal any\nobjective preference ignored\n\
//!      best 0 1 2 0\nmaps 1\ntree\ne 1\nf 0 1 2 0\nend\n",
//!     hssh_verify::exploration_line(&exploration),
//! );
//! let verdict = hssh_verify::verify(&certificate, &exploration)?;
//! assert_eq!((verdict.maps, verdict.expanded, verdict.open), (1, 1, 0));
//!
//! let wrong = certificate.replace("f 0 1 2 0", "f 0 1 3 0");
//! assert_eq!(hssh_verify::verify(&wrong, &exploration).unwrap_err().line, 10);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod frames;
mod header;
mod layout;
mod lines;
mod map;
mod outlook;
mod paths;
mod pose;
mod posterior;
mod rank;
mod route;
mod step;
mod verdict;
mod walk;

pub use header::{Best, exploration_line};
pub use lines::Refusal;
pub use verdict::{Verdict, report, verify};
