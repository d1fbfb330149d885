//! What a search is asked for: in which order it looks, which maps it accepts, how much it proves.

use serde::{Deserialize, Serialize};

/// In which order the hypotheses of a tree are expanded.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Order {
    /// All of them, level by level, as in the thesis (section 2.3.1).
    #[default]
    BreadthFirst,
    /// The best one first, as in the thesis, until it explains everything. It may miss the optimum.
    BestFirst,
    /// In turn the best one of each number of travels explained, until the answer is proved: cyclic best-first search.
    /// It soon has a map.
    Cyclic,
    /// The one with the least admissible bound first, until the answer is proved.
    Proof,
}

/// Which maps are accepted.
#[derive(Clone, Copy, PartialEq, Eq, Hash, Debug, Default, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Goal {
    /// Any map that explains everything.
    #[default]
    AnyMap,
    /// A closed map: if the best map that explains everything is not closed, the search goes back and
    /// on with the next best hypothesis. This is the thesis's backtracking (section 3.4). Breadth-first finds all
    /// maps, whether or not they are closed.
    ClosedMap,
}

impl Goal {
    pub(crate) fn accepts(self, closed: bool) -> bool {
        closed || self == Goal::AnyMap
    }
}

/// How much is to be proved.
#[derive(Clone, Copy, PartialEq, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Proving {
    /// How many of the best maps.
    pub best: usize,
    /// Where there are probabilities: go on until all maps that were not found have at most this one together; 1 to do
    /// without.
    pub rest: f64,
    /// Without a proof, stop when the best map has been the best for so many expansions. Meant for use on the way, where the next travel
    /// will tell more.
    pub patience: Option<u64>,
}

impl Default for Proving {
    fn default() -> Self {
        Proving { best: 1, rest: 1.0, patience: None }
    }
}
