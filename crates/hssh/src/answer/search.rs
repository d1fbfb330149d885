//! How the tree of hypotheses was searched, and what that took.

use hssh_search::StopReason;
use hssh_topology::Removals;
use serde::{Deserialize, Serialize};

/// What makes one map better than another.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum SearchObjective {
    /// The order of preference over topology (section 2.3.2).
    Preference,
    /// The posterior probability, given measured travels (chapter 4).
    Posterior,
}

/// In which order hypotheses were looked at.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum SearchOrder {
    /// All, level by level.
    BreadthFirst,
    /// The best one first, until it explains everything.
    BestFirst,
    /// The best one of each number of travels explained in turn, until the answer is proved.
    Cyclic,
    /// By a bound, until the answer is proved.
    Proof,
    /// All, only to be counted.
    Count,
}

/// The hypotheses that explain the same number of travels.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
pub struct SearchLevel {
    /// How many travels they explain.
    pub travels: u64,
    /// How many were made.
    pub nodes: u64,
    /// Maps made for them.
    pub maps: u64,
    /// How many the next travel refuted.
    pub refuted: u64,
}

/// The maps found, by kind. With an order that does not keep all maps, only those kept are counted.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
pub struct FoundCounts {
    /// All that explain what is explained.
    pub maps: u64,
    /// How many are as good as the first.
    pub tied: u64,
    /// Without pending gateways.
    pub closed: u64,
    /// Without pending gateways on paths with a single place.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub nearly_closed: Option<u64>,
    /// Closed, no two paths sharing two places, no three forming a triangle.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub perpendicular: Option<u64>,
}

/// The account of a search.
#[derive(Clone, PartialEq, Debug, Serialize, Deserialize)]
pub struct SearchSummary {
    /// What made one map better than another.
    pub objective: SearchObjective,
    /// In which order hypotheses were looked at.
    pub order: SearchOrder,
    /// Whether closed maps only were accepted.
    pub closed_only: bool,
    /// Why it stopped.
    pub stop: StopReason,
    /// Hypotheses made: the root and every child of every step.
    pub nodes: u64,
    /// Maps made: the root's and one for every child of an expansion.
    pub maps_made: u64,
    /// Hypotheses that the next travel refuted.
    pub refuted: u64,
    /// Hypotheses that the recursive step was applied to.
    pub expanded: u64,
    /// Layouts found by least squares.
    pub layouts: u64,
    /// The maps found.
    pub found: FoundCounts,
    /// Hypotheses turned down because a closed map was asked for and none can come of them.
    pub rejected: u64,
    /// Successors that each axiom removed; absent if they were not counted.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub removals: Option<Removals>,
    /// By number of travels explained.
    pub levels: Vec<SearchLevel>,
    /// Time taken.
    pub seconds: f64,
    /// Memory of the tree and of what waits to be searched.
    pub bytes: u64,
}

impl SearchSummary {
    /// How it was searched, in words.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match (self.objective, self.order, self.closed_only) {
            (_, SearchOrder::Count, _) => "exhaustive counting",
            (SearchObjective::Preference, SearchOrder::BreadthFirst, _) => "breadth-first",
            (SearchObjective::Preference, SearchOrder::BestFirst, false) => "best-first",
            (SearchObjective::Preference, SearchOrder::BestFirst, true) => "best-first, back until closed",
            (SearchObjective::Preference, SearchOrder::Cyclic, false) => "cyclic best-first with proof",
            (SearchObjective::Preference, SearchOrder::Cyclic, true) => {
                "cyclic best-first with proof, closed maps"
            }
            (SearchObjective::Preference, SearchOrder::Proof, false) => "best-first with proof",
            (SearchObjective::Preference, SearchOrder::Proof, true) => "best-first with proof, closed maps",
            (SearchObjective::Posterior, SearchOrder::BreadthFirst, _) => "breadth-first by posterior",
            (SearchObjective::Posterior, SearchOrder::BestFirst, false) => "best-first by posterior",
            (SearchObjective::Posterior, SearchOrder::BestFirst, true) => {
                "best-first by posterior, back until closed"
            }
            (SearchObjective::Posterior, SearchOrder::Cyclic, false) => "posterior with proof",
            (SearchObjective::Posterior, SearchOrder::Cyclic, true) => "posterior with proof, closed maps",
            (SearchObjective::Posterior, SearchOrder::Proof, false) => {
                "posterior with proof, least bound first"
            }
            (SearchObjective::Posterior, SearchOrder::Proof, true) => {
                "posterior with proof, least bound first, closed maps"
            }
        }
    }
}
