//! What can be wrong with an answer that is read, drawn, or explained again.

use hssh_topology::{Contradiction, Malformed, OlpName, StarError, Violation};

use super::place::EndReference;

/// Why a text is no answer.
#[derive(Debug, thiserror::Error)]
pub enum AnswerError {
    /// It is not the JSON of one.
    #[error("this is no answer: {0}")]
    Json(#[from] serde_json::Error),
    /// Another format.
    #[error("the format is `{0}`, not `{format}`", format = super::Answer::FORMAT)]
    OtherFormat(String),
    /// Another version.
    #[error("the answer has version {0}, this library reads version {version}", version = super::Answer::VERSION)]
    OtherVersion(u32),
}

/// Why an answer's map cannot be the map of an exploration.
#[derive(Clone, PartialEq, Debug, thiserror::Error)]
pub enum DisagreementError {
    /// There is no map of that rank.
    #[error("there is no map of rank {0}")]
    NoSuchRank(usize),
    /// The ends of a place are no star.
    #[error("place {place} has no star: {problem}")]
    Star {
        /// The place.
        place: usize,
        /// Why not.
        problem: StarError,
    },
    /// An end that its place does not have.
    #[error("place {} has no end `{}`", .0.place, .0.end)]
    NoSuchEnd(EndReference),
    /// A visit that is impossible in the map as it had grown until then.
    #[error("visit {visit} does not follow from the visits before it")]
    Visit {
        /// The visit, the start being 0.
        visit: usize,
    },
    /// A visit that an independent replay tells otherwise.
    #[error("visit {visit} is told otherwise by an independent replay")]
    ToldOtherwise {
        /// The visit, the start being 0.
        visit: usize,
    },
    /// An independent replay of the exploration does not go through.
    #[error(transparent)]
    Replay(#[from] Contradiction),
    /// It is no map.
    #[error(transparent)]
    Malformed(#[from] Malformed),
    /// An axiom does not hold.
    #[error(transparent)]
    Axiom(#[from] Violation),
}

impl DisagreementError {
    pub(super) fn no_such_end(reference: &EndReference) -> Self {
        DisagreementError::NoSuchEnd(reference.clone())
    }
}

/// The name of an end as stars spell it.
pub(super) fn end_name(text: &str) -> Option<OlpName> {
    text.parse().ok()
}
