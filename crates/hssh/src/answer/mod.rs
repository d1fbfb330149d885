//! One answer for all who ask: what a mapper made of an exploration or a log, as plain data to be written and read.
//!
//! `docs/answer-format.md` in the repository explains every field: its meaning, unit, frame and range. Places,
//! visits, travels, scans and ends are counted from 0; sentences count travels, scans and lines from 1, and visits from 0, the start.

mod building;
mod certificate;
mod difference;
mod error;
mod explanation;
mod input;
mod map;
mod picture;
mod place;
mod reading;
mod rebuild;
mod reservation;
mod search;
mod text;
mod verdict;
mod visit;
mod warning;
mod words;

pub use building::{AnsweredBuilding, AnsweredPassage, AnsweredRegion, AnsweredStay};
pub use certificate::{Assumption, CertificateSummary, Trusted, Worth};
pub use difference::{MapDifference, PartingVisit, TestTravels};
pub use error::{AnswerError, DisagreementError};
pub use explanation::Explanation;
pub use hssh_search::StopReason;
pub use input::{AnsweredEvidence, AnsweredInput, InputKind};
pub use map::{AnsweredMap, CostItem, CostSheet, CurrentPosition, MapMeasure};
pub use picture::{MapPicture, PictureError};
pub use place::{AnsweredEnd, AnsweredLink, AnsweredPath, AnsweredPlace, EndReference, EndState, PlacedPose};
pub use reading::{CorrectionKind, ReadingAccount, ReadingCorrection};
pub use rebuild::RebuiltMap;
pub use search::{FoundCounts, SearchLevel, SearchObjective, SearchOrder, SearchSummary};
pub use text::Listing;
pub use verdict::{Verdict, VerdictKind};
pub use visit::{AnsweredVisit, Finding, VisitRecord};
pub use warning::{AnswerWarning, Spot, WarningKind};
pub use words::counted;

use serde::{Deserialize, Serialize};

/// What is known after a search: what it was asked, what it did, what is proved, and the maps in their order.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct Answer {
    /// [`Answer::FORMAT`].
    pub format: String,
    /// [`Answer::VERSION`] of the program that wrote it.
    pub version: u32,
    /// What was to be explained, and how much of it is.
    pub input: AnsweredInput,
    /// How it was searched.
    pub search: SearchSummary,
    /// What came of it, in a word and in a sentence.
    pub verdict: Verdict,
    /// What is proved.
    pub certificate: CertificateSummary,
    /// The best maps, the best one first.
    pub maps: Vec<AnsweredMap>,
    /// What the robot visited, the start first, and where that is in the first map.
    pub visits: Vec<VisitRecord>,
    /// Of a log: the building, as all scans draw it where the first map has them.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub building: Option<AnsweredBuilding>,
    /// What of the exploration is taken for misread, if errors of perception were reckoned with: then travels, visits and maps are those
    /// of the exploration as it must have been.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub readings: Option<ReadingAccount>,
    /// What was decided with little reason, or left out.
    pub warnings: Vec<AnswerWarning>,
}

impl Answer {
    /// What answers call their format.
    pub const FORMAT: &str = "hssh-answer";
    /// The version of the format that this library writes.
    pub const VERSION: u32 = 1;

    /// Reads an answer.
    ///
    /// # Errors
    /// If the text is no JSON, no answer, or an answer of a later version.
    pub fn from_json(text: &str) -> Result<Self, AnswerError> {
        /// What every version of the format has.
        #[derive(Deserialize)]
        struct Head {
            format: String,
            version: u32,
        }
        let Head { format, version } = serde_json::from_str(text)?;
        if format != Self::FORMAT {
            return Err(AnswerError::OtherFormat(format));
        }
        if version != Self::VERSION {
            return Err(AnswerError::OtherVersion(version));
        }
        Ok(serde_json::from_str(text)?)
    }

    /// The answer as JSON, with line breaks; equal answers give equal texts.
    #[must_use]
    pub fn to_json(&self) -> String {
        serde_json::to_string_pretty(self).expect("an answer is structs, lists, texts and numbers") + "\n"
    }

    /// The map of a rank, the best one being 1.
    #[must_use]
    pub fn map(&self, rank: usize) -> Option<&AnsweredMap> {
        self.maps.iter().find(|map| map.rank == rank as u64)
    }
}
