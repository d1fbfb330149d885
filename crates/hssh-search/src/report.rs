//! What a search reports: counts by level and in total, and why it stopped.

use std::fmt;

use hssh_metrics::Pose;
use hssh_topology::{Axiom, Measure, Preference, Removals, TopologicalMap};
use serde::{Deserialize, Serialize};

use crate::limits::StopReason;
use crate::posterior::Cost;
use crate::tree::NodeId;

/// What a map is worth, or what maps are worth at least: the less, the better.
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
#[serde(untagged)]
pub enum Score {
    /// By preference.
    Measure(Measure),
    /// Minus ln of the posterior probability, up to a number that all maps share.
    Nats(f64),
}

impl fmt::Display for Score {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Score::Measure(measure) => measure.fmt(f),
            Score::Nats(nats) => write!(f, "{nats:.3} nats"),
        }
    }
}

/// What a search with a bound knows about its answer.
#[derive(Clone, Copy, PartialEq, Debug, Serialize)]
pub struct Proof {
    /// What the best map found is worth.
    pub best: Option<Score>,
    /// What any map that was not found is worth at best; nothing if there is none left.
    pub open_bound: Option<Score>,
    /// Whether no map that was not found is as good as the best one.
    pub proved: bool,
    /// The probability of all maps that were not found, at most, where there are probabilities.
    pub rest: Option<f64>,
    /// The least factor by which χ² rose of what the linear estimate promised, among the hypotheses that may still lead
    /// to maps that matter. The bound relies on [`LINEAR_TRUST`](crate::LINEAR_TRUST) where headings are known well enough: a lower
    /// factor there invalidates the proof.
    pub linear_factor: f64,
    /// Whether some hypothesis was left out because its layout cannot be computed: some odometry is out of all
    /// proportion. Nothing is proved then.
    pub unsolvable: bool,
}

/// One explanation of everything observed, with what ranks it.
#[derive(Clone, PartialEq, Debug)]
pub struct RankedMap {
    /// The hypothesis in the mapper's tree.
    pub node: NodeId,
    /// What preference looks at.
    pub measure: Measure,
    /// No gateway is pending.
    pub closed: bool,
    /// No gateway is pending on a path with a single place.
    pub nearly_closed: bool,
    /// How probable it is, if that ranks it.
    pub probable: Option<Probable>,
}

/// What makes a map probable.
#[derive(Clone, PartialEq, Debug)]
pub struct Probable {
    /// Minus the logarithm of its posterior probability up to a factor that all maps share.
    pub cost: Cost,
    /// Its probability if the maps that were not found weigh as much as they can: what it has at least.
    pub at_least: f64,
    /// Its probability among all maps that were found: what it has at most.
    pub at_most: f64,
    /// By place: the frame in which the bearings of the star seen on the first visit are given, in the frame of
    /// the first place. Empty if measurements were ignored.
    pub poses: Vec<Pose>,
}

impl RankedMap {
    pub(crate) fn of(node: NodeId, map: &TopologicalMap) -> Self {
        let measure = Measure::of(map);
        let (closed, nearly_closed) = (map.is_closed(), map.is_nearly_closed());
        RankedMap { node, measure, closed, nearly_closed, probable: None }
    }

    /// What it costs in nats; nothing if it is ranked by preference.
    #[must_use]
    pub fn nats(&self) -> Option<f64> {
        self.probable.as_ref().map(|probable| probable.cost.total())
    }
}

/// The nodes that explain the same number of travels.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
pub struct LevelCounts {
    /// Nodes.
    pub nodes: u64,
    /// Maps made: nodes that do not share their parent's map.
    pub maps: u64,
    /// Nodes that the next observation refuted (p-nc).
    pub refuted: u64,
}

impl std::ops::AddAssign for LevelCounts {
    fn add_assign(&mut self, other: Self) {
        self.nodes += other.nodes;
        self.maps += other.maps;
        self.refuted += other.refuted;
    }
}

/// Counts over the maps that explain the whole exploration.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize, Deserialize)]
pub struct FinalCounts {
    /// All of them.
    pub final_maps: u64,
    /// Without pending gateways (section 3.3).
    pub closed: u64,
    /// Without pending gateways on paths with a single place (the table of Figure 3.3).
    pub nearly_closed: u64,
    /// Closed and qualitatively perpendicular (section 3.4).
    pub perpendicular: u64,
    /// How many share the best rank.
    pub optimal: u64,
    /// What the best ones measure; of their genera the least.
    pub best: Option<Measure>,
}

impl FinalCounts {
    /// Counts one more map.
    pub fn record(&mut self, map: &TopologicalMap, preference: Preference) {
        self.final_maps += 1;
        self.nearly_closed += u64::from(map.is_nearly_closed());
        if map.is_closed() {
            self.closed += 1;
            self.perpendicular += u64::from(map.is_perpendicular());
        }
        self.compete(Measure::of(map), 1, preference);
    }

    /// Counts the maps that `other` counted.
    pub fn merge(&mut self, other: &FinalCounts, preference: Preference) {
        self.final_maps += other.final_maps;
        self.closed += other.closed;
        self.nearly_closed += other.nearly_closed;
        self.perpendicular += other.perpendicular;
        if let Some(best) = other.best {
            self.compete(best, other.optimal, preference);
        }
    }

    fn compete(&mut self, measure: Measure, number: u64, preference: Preference) {
        let rank = preference.rank(measure);
        match self.best.as_mut() {
            Some(best) if preference.rank(*best) == rank => {
                best.genus = best.genus.min(measure.genus);
                self.optimal += number;
            }
            Some(best) if preference.rank(*best) < rank => {}
            _ => (self.best, self.optimal) = (Some(measure), number),
        }
    }
}

/// The account of a search. Field names are the names in the program's JSON.
#[derive(Clone, PartialEq, Debug, Serialize)]
pub struct Report {
    /// How the tree was searched, and for what.
    pub strategy: String,
    /// Why the search stopped.
    pub stop: StopReason,
    /// How many travels there are to explain.
    pub travels: u64,
    /// How many travels the maps of this report explain: all, unless a limit stopped the search.
    pub explained: u64,
    /// The root and every child of every step.
    pub nodes: u64,
    /// The root's map and one for every child of an expansion.
    pub maps: u64,
    /// Nodes that an observation refuted.
    pub refuted: u64,
    /// Nodes that the recursive step was applied to.
    pub expanded: u64,
    /// Layouts found by least squares.
    pub solved: u64,
    /// Counts over the maps that explain what is explained.
    #[serde(flatten)]
    pub finals: FinalCounts,
    /// Hypotheses that were turned down because a closed map was asked for and none can come of them:
    /// maps that explain everything, and with proof also those too far from closed to become it.
    pub rejected: u64,
    /// Whether the best maps are known to be the best of all.
    pub is_optimal: bool,
    /// Successors that each axiom removed.
    pub removals: Removals,
    /// What is known about the answer, if the search has a bound.
    pub proof: Option<Proof>,
    /// By number of travels explained, the root first.
    pub levels: Vec<LevelCounts>,
    /// Time spent searching.
    pub seconds: f64,
    /// Bytes that the tree and the open hypotheses take; 0 if none are kept.
    pub bytes: u64,
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let finals = &self.finals;
        writeln!(f, "{}: {} ({} of {} travels)", self.strategy, self.stop, self.explained, self.travels)?;
        let rows = [
            ("nodes", self.nodes),
            ("maps", self.maps),
            ("refuted", self.refuted),
            ("expanded", self.expanded),
            ("layouts solved", self.solved),
            ("final maps", finals.final_maps),
            ("nearly closed", finals.nearly_closed),
            ("closed", finals.closed),
            ("closed, perpendicular", finals.perpendicular),
            (if self.is_optimal { "optimal" } else { "share the best rank" }, finals.optimal),
        ];
        for (name, count) in rows {
            if count > 0 || name != "layouts solved" {
                writeln!(f, "  {name:<32}{count:>14}")?;
            }
        }
        if let Some(best) = finals.best {
            writeln!(f, "  best          {best}")?;
        }
        for axiom in Axiom::ALL {
            let removed = self.removals.by(axiom);
            if removed > 0 {
                writeln!(f, "  removed: {:<23}{removed:>14}", axiom.to_string())?;
            }
        }
        self.proof.map_or(Ok(()), |proof| proof.fmt(f))
    }
}

impl fmt::Display for Proof {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let show = |score: Option<Score>| score.map_or("none".to_owned(), |score| score.to_string());
        let verdict = if self.proved { "proved" } else { "not proved" };
        let (best, open) = (show(self.best), show(self.open_bound));
        writeln!(f, "  {verdict}: the best map is worth {best}; what was not looked at, at best {open}")?;
        let Some(rest) = self.rest else { return Ok(()) };
        writeln!(f, "  χ² rose by at least {:.2} of the linear estimate", self.linear_factor)?;
        writeln!(f, "  all maps not found have a probability of at most {rest:.2e} together")
    }
}

/// The levels of a report as a table, with what the search cost below it.
#[derive(Clone, Copy, Debug)]
pub struct Levels<'a>(pub &'a Report);

impl fmt::Display for Levels<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "  {:>7}{:>14}{:>14}{:>14}", "travels", "nodes", "maps", "refuted")?;
        for (travels, level) in self.0.levels.iter().enumerate() {
            writeln!(f, "  {travels:>7}{:>14}{:>14}{:>14}", level.nodes, level.maps, level.refuted)?;
        }
        let Report { nodes, expanded, seconds, bytes, .. } = *self.0;
        let (per_second, per_node) = (nodes as f64 / seconds, bytes as f64 / nodes as f64);
        writeln!(f, "  {expanded} nodes expanded in {seconds:.3} s, {per_second:.0} nodes made a second")?;
        writeln!(f, "  the tree takes {bytes} bytes, {per_node:.1} a node")
    }
}
