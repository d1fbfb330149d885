//! What a search reports: counts by level and in total, and why it stopped.

use std::fmt;

use hssh_topology::{Axiom, Measure, Preference, Removals, TopologicalMap};
use serde::Serialize;

use crate::crew::Step;
use crate::limits::StopReason;
use crate::proof::Certificate;
use crate::tree::{Child, NodeId, Outcome, Tree};

/// The nodes that explain the same number of travels.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize)]
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

/// What is counted while a tree grows.
#[derive(Clone, Debug)]
pub(crate) struct Tally {
    pub(crate) levels: Vec<LevelCounts>,
    pub(crate) removals: Removals,
    /// Nodes that the recursive step was applied to.
    pub(crate) expanded: u64,
}

impl Tally {
    /// The root and its map.
    pub(crate) fn new() -> Self {
        let root = LevelCounts { nodes: 1, maps: 1, refuted: 0 };
        Tally { levels: vec![root], removals: Removals::default(), expanded: 0 }
    }

    /// A node was expanded; its successors are about to be added to the tree.
    pub(crate) fn enter<'a>(
        &mut self,
        node: NodeId,
        step: &Step,
        successors: impl ExactSizeIterator<Item = &'a Child>,
        tree: &mut Tree,
    ) {
        tree.set_outcome(node, step.outcome);
        let depth = tree.depth(node);
        self.removals += step.removals;
        self.expanded += 1;
        self.levels[depth].refuted += u64::from(step.outcome == Outcome::Refuted);
        if successors.len() == 0 {
            return;
        }
        if self.levels.len() == depth + 1 {
            self.levels.push(LevelCounts::default());
        }
        let level = &mut self.levels[depth + 1];
        level.nodes += successors.len() as u64;
        level.maps += successors.filter(|child| child.growth.is_some()).count() as u64;
    }
}

/// Counts over the maps that explain the whole exploration.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, Serialize)]
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
    /// How the tree was searched.
    pub strategy: &'static str,
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
    /// Counts over the maps that explain what is explained.
    #[serde(flatten)]
    pub finals: FinalCounts,
    /// Hypotheses that were turned down because a closed map was asked for and none can come of them:
    /// maps that explain everything, and with proof also those too far from closed to become it.
    pub rejected: u64,
    /// Whether the best maps are known to be the best of all: whether nothing was left out.
    pub is_optimal: bool,
    /// Successors that each axiom removed.
    pub removals: Removals,
    /// What best-first with proof proved.
    pub certificate: Option<Certificate>,
    /// By number of travels explained, the root first.
    pub levels: Vec<LevelCounts>,
    /// Time spent searching.
    pub seconds: f64,
    /// Bytes that the tree takes; 0 if none is kept.
    pub tree_bytes: u64,
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let finals = &self.finals;
        writeln!(f, "{}: {} ({} of {} travels)", self.strategy, self.stop, self.explained, self.travels)?;
        let rows = [
            ("nodes", self.nodes),
            ("maps", self.maps),
            ("refuted", self.refuted),
            ("final maps", finals.final_maps),
            ("nearly closed", finals.nearly_closed),
            ("closed", finals.closed),
            ("closed, perpendicular", finals.perpendicular),
            (if self.is_optimal { "optimal" } else { "share the best rank" }, finals.optimal),
        ];
        for (name, count) in rows {
            writeln!(f, "  {name:<32}{count:>14}")?;
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
        if let Some(certificate) = &self.certificate {
            writeln!(f, "  certificate   {certificate}")?;
        }
        Ok(())
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
        let Report { nodes, expanded, seconds, tree_bytes, .. } = *self.0;
        let (per_second, per_node) = (nodes as f64 / seconds, tree_bytes as f64 / nodes as f64);
        writeln!(f, "  {expanded} nodes expanded in {seconds:.3} s, {per_second:.0} nodes made a second")?;
        writeln!(f, "  the tree takes {tree_bytes} bytes, {per_node:.1} a node")
    }
}
