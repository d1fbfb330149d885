//! Exhaustive counting: all that breadth-first counts, in memory that does not grow with the nodes.

use std::ops::ControlFlow;
use std::time::Instant;

use hssh_causal::Exploration;
use hssh_topology::{Hypothesis, Observation, Preference, Removals};

use crate::builder::{MapperBuilder, MapperError, Objective};
use crate::context::Context;
use crate::crew::Crew;
use crate::depth_first::{Visitor, depth_first};
use crate::experience::Experience;
use crate::fringe::Fringe;
use crate::limits::{StopReason, Watch};
use crate::report::{FinalCounts, LevelCounts, Report};
use crate::tally::Tally;
use crate::tree::{NodeId, Tree};

/// The tree is cut below the first level with that many nodes, and each branch counted by itself.
const BRANCHES: u32 = 2048;

/// How many branches are counted between two looks at a limit on nodes.
const BRANCHES_UNDER_LIMIT: usize = 64;

/// Nodes between two looks at the limits.
const LOOK: u64 = 1 << 14;

impl MapperBuilder {
    /// Counts all hypotheses about an exploration and keeps none, in memory that does not grow with their
    /// number. Neither order nor goal matters, and maps are ranked by preference.
    ///
    /// A limit or an interruption ends the count early; the report then covers the branches of the
    /// tree that were counted to their end, and is the same for any number of threads if it was the
    /// limit on nodes.
    ///
    /// # Errors
    /// If the operating system gives no threads, or the axioms do not allow to discard maps.
    pub fn count(self, exploration: &Exploration) -> Result<Report, MapperError> {
        self.axioms.check()?;
        let experience = &Experience::from(exploration);
        let crew = Crew::new(self.threads)?;
        let watch = Watch::start(self.limits, &self.monitor);
        let preference = match self.objective {
            Objective::Preference(preference) => preference,
            Objective::Posterior(_) => Preference::default(),
        };
        let context = Context { experience, axioms: &self.axioms, crew: &crew, watch: &watch };
        Ok(count(context, preference))
    }
}

/// Goes through all hypotheses of an experience and counts them, keeping none.
fn count(context: Context<'_>, preference: Preference) -> Report {
    let started = Instant::now();
    let Context { experience, axioms, crew, watch } = context;
    let travels = context.travels();

    let mut tree = Tree::new();
    let mut top = Fringe::default();
    let mut tally = Tally::new();
    let mut stop = None;
    while stop.is_none() && top.depth < travels && top.nodes.len() < BRANCHES as usize {
        stop = top.grow(&mut tree, context, &mut tally).err();
    }
    tally.levels.resize(travels + 1, LevelCounts::default());
    let mut total =
        Counting { levels: tally.levels, removals: tally.removals, ..Counting::new(preference, watch) };

    let top_expanded = u64::from(top.nodes.start);
    let branches: Vec<NodeId> = top.nodes.clone().map(NodeId::new).collect();
    // Under a limit on nodes, branches beyond it would be counted in vain.
    let at_once = if watch.limits_nodes() { BRANCHES_UNDER_LIMIT } else { branches.len().max(1) };
    for together in branches.chunks(at_once) {
        if stop.is_some() {
            break;
        }
        let counted = crew.map(together, experience, |cursor, &node| {
            let mut counting = Counting::new(preference, watch);
            counting.stop = watch.interruption();
            if counting.stop.is_none() {
                let hypothesis = cursor.go_to(node, &tree, experience);
                counting.removals = depth_first(hypothesis, top.depth, experience, axioms, &mut counting);
                watch.add_nodes(LOOK - counting.until_look);
            }
            counting
        });
        for branch in counted {
            stop = stop.or(branch.stop).or_else(|| watch.excess(total.nodes() + branch.nodes(), 0));
            if stop.is_none() {
                total.merge(&branch);
            }
        }
    }
    let nodes = total.nodes();
    let sum = |of: fn(&LevelCounts) -> u64| total.levels.iter().map(of).sum::<u64>();
    let (maps, refuted) = (sum(|level| level.maps), sum(|level| level.refuted));
    Report {
        strategy: "exhaustive counting".to_owned(),
        stop: stop.unwrap_or(StopReason::Exhausted),
        travels: travels as u64,
        explained: if stop.is_none() { travels as u64 } else { 0 },
        nodes,
        maps,
        refuted,
        expanded: top_expanded + total.steps,
        finals: total.finals,
        rejected: 0,
        is_optimal: stop.is_none(),
        removals: total.removals,
        proof: None,
        solved: 0,
        levels: total.levels,
        seconds: started.elapsed().as_secs_f64(),
        bytes: tree.bytes(),
    }
}

/// What is counted on the way.
struct Counting<'a> {
    levels: Vec<LevelCounts>,
    finals: FinalCounts,
    removals: Removals,
    preference: Preference,
    watch: &'a Watch,
    until_look: u64,
    /// Nodes that the recursive step was applied to.
    steps: u64,
    stop: Option<StopReason>,
}

impl<'a> Counting<'a> {
    fn new(preference: Preference, watch: &'a Watch) -> Self {
        Counting {
            levels: Vec::new(),
            finals: FinalCounts::default(),
            removals: Removals::default(),
            preference,
            watch,
            until_look: LOOK,
            steps: 0,
            stop: None,
        }
    }

    fn nodes(&self) -> u64 {
        self.levels.iter().map(|level| level.nodes).sum()
    }

    fn merge(&mut self, branch: &Counting<'_>) {
        for (level, counted) in self.levels.iter_mut().zip(&branch.levels) {
            *level += *counted;
        }
        self.finals.merge(&branch.finals, self.preference);
        self.removals += branch.removals;
        self.steps += branch.steps;
    }

    fn level(&mut self, depth: usize) -> &mut LevelCounts {
        if depth >= self.levels.len() {
            self.levels.resize(depth + 1, LevelCounts::default());
        }
        &mut self.levels[depth]
    }
}

impl Visitor for Counting<'_> {
    fn node(&mut self, depth: usize, new_map: bool) -> ControlFlow<()> {
        let level = self.level(depth);
        level.nodes += 1;
        level.maps += u64::from(new_map);
        self.until_look -= 1;
        if self.until_look == 0 {
            self.until_look = LOOK;
            self.watch.add_nodes(LOOK);
            self.stop = self.watch.interruption().or_else(|| self.watch.excess(self.nodes(), 0));
            if self.stop.is_some() {
                return ControlFlow::Break(());
            }
        }
        ControlFlow::Continue(())
    }

    fn step(&mut self, _: &Hypothesis, _: Observation) {
        self.steps += 1;
    }

    fn refuted(&mut self, depth: usize) {
        self.level(depth).refuted += 1;
    }

    fn last(&mut self, hypothesis: &Hypothesis) {
        self.finals.record(&hypothesis.map, self.preference);
    }
}
