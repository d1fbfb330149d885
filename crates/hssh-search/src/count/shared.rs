//! A count whose branches are given out, to be counted by others: threads, processes, machines.

use std::collections::BTreeSet;
use std::time::{Duration, Instant};

use hssh_causal::Exploration;
use hssh_topology::{Axioms, Preference};

use super::branches::{CountedBranch, Progress, Top};
use super::{STRATEGY, preference, report};
use crate::builder::{MapperBuilder, MapperError};
use crate::checkpoint::{CheckpointError, Identity, Keeping};
use crate::context::Context;
use crate::crew::Crew;
use crate::cursor::Cursor;
use crate::experience::Experience;
use crate::limits::{Limits, Monitor, StopReason, Watch};
use crate::report::Report;
use crate::tree::NodeId;

/// Counts branches. Wherever it is made for the same exploration and options, it counts the same.
#[derive(Debug)]
pub struct BranchCounter {
    experience: Experience,
    axioms: Axioms,
    preference: Preference,
    crew: Crew,
    top: Top,
    cursor: Cursor,
    identity: u64,
}

/// A count whose branches are given out.
#[derive(Debug)]
pub struct SharedCount {
    counter: BranchCounter,
    progress: Progress,
    /// The branches that somebody counts.
    given: BTreeSet<NodeId>,
    keeping: Keeping,
    limits: Watch,
    options: MapperBuilder,
    started: Instant,
    /// Seconds before it went on from a checkpoint.
    before: f64,
}

impl BranchCounter {
    /// For the count that `options` ask for, whatever their limits.
    ///
    /// # Errors
    /// If the axioms do not allow to discard maps.
    pub fn new(options: &MapperBuilder, exploration: &Exploration) -> Result<Self, MapperError> {
        Ok(begin(options, exploration)?.0)
    }

    /// Tells this count from others.
    #[must_use]
    pub fn identity(&self) -> u64 {
        self.identity
    }

    /// Counts a branch on, for so long or to its end. `None` if the branch is of another count.
    pub fn count_on(&mut self, branch: &CountedBranch, time: Duration) -> Option<CountedBranch> {
        let Self { experience, axioms, preference, crew, top, cursor, .. } = self;
        if !branch.is_of(top, experience.observations.len()) {
            return None;
        }
        let limits = Limits { time: Some(time), ..Limits::default() };
        let watch = Watch::start(limits, &Monitor::default().into());
        let context = Context { experience, axioms, crew, watch: &watch };
        Some(branch.count_on(cursor, top, *preference, context).0)
    }
}

/// The counter, and a count that has just begun.
fn begin(
    options: &MapperBuilder,
    exploration: &Exploration,
) -> Result<(BranchCounter, Progress), MapperError> {
    options.axioms.check()?;
    let (experience, crew) = (Experience::from(exploration), Crew::new(1)?);
    let unlimited = Watch::without_limits();
    let context =
        Context { experience: &experience, axioms: &options.axioms, crew: &crew, watch: &unlimited };
    let (top, progress) = Top::grow(context).map_err(|_| CheckpointError::Damaged)?;
    let counter = BranchCounter {
        cursor: Cursor::new(&experience),
        axioms: options.axioms,
        preference: preference(options),
        identity: Identity::of(STRATEGY.to_owned(), options, exploration).number(),
        experience,
        crew,
        top,
    };
    Ok((counter, progress))
}

impl SharedCount {
    /// Begins the count that `options` ask for, or goes on from its checkpoint.
    ///
    /// # Errors
    /// If the axioms do not allow to discard maps, or there is a checkpoint that it cannot go on from.
    pub fn new(options: MapperBuilder, exploration: &Exploration) -> Result<Self, MapperError> {
        let started = Instant::now();
        let limits = Watch::start(options.limits, &options.monitor);
        let (counter, progress) = begin(&options, exploration)?;
        let identity = || Identity::of(STRATEGY.to_owned(), &options, exploration);
        let keeping = Keeping::new(options.checkpoints.clone(), identity);
        let kept = keeping.begin(|unsealed| {
            let before: f64 = unsealed.take()?;
            let progress = Progress::read(unsealed, &counter.top, exploration.travels().len())?;
            Ok((progress.nodes(), (before, progress)))
        })?;
        let (before, progress) = kept.unwrap_or((0.0, progress));
        let given = BTreeSet::new();
        options.monitor.goes_on(progress.nodes(), 0);
        Ok(SharedCount { counter, progress, given, keeping, limits, options, started, before })
    }

    /// Tells this count from others.
    #[must_use]
    pub fn identity(&self) -> u64 {
        self.counter.identity
    }

    /// Gives out a branch to be counted on; nothing if all that are left are given out.
    pub fn give(&mut self) -> Option<CountedBranch> {
        let branch = self.progress.next(|root| !self.given.contains(&root))?.clone();
        self.given.insert(branch.root);
        Some(branch)
    }

    /// Takes back a branch that was given out, counted on.
    pub fn take_back(&mut self, branch: CountedBranch) {
        if self.given.remove(&branch.root) {
            let _ = self.progress.put(branch);
        }
        self.options.monitor.goes_on(self.progress.nodes(), 0);
    }

    /// Whether somebody has a branch.
    #[must_use]
    pub fn is_given_out(&self) -> bool {
        !self.given.is_empty()
    }

    /// Why no more branches are to be given out, if it is over. Keeps a checkpoint if one is due.
    pub fn look(&mut self) -> Option<StopReason> {
        let stop = self.progress.take_first(self.counter.preference, &self.limits);
        if let Some(reason) = stop.or_else(|| self.limits.interruption()) {
            return Some(reason);
        }
        if self.progress.is_complete() {
            return Some(StopReason::Exhausted);
        }
        if self.keeping.due.is_some_and(|due| Instant::now() >= due) {
            self.keep();
        }
        None
    }

    /// Keeps a checkpoint, if that was asked for: of branches that are given out, what was known of them before.
    pub fn keep(&mut self) {
        let SharedCount { progress, started, before, keeping, .. } = self;
        keeping.keep(|pen| {
            pen.put(&(*before + started.elapsed().as_secs_f64()))?;
            progress.write(pen)
        });
    }

    /// The account of the count, which stopped for that reason; unless it came to its end, a checkpoint is kept.
    #[must_use]
    pub fn end(mut self, stop: StopReason) -> Report {
        if !stop.is_complete() {
            self.keep();
        }
        let seconds = self.before + self.started.elapsed().as_secs_f64();
        report(self.progress.total, stop, self.counter.top.tree.bytes(), seconds)
    }
}
