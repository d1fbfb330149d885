//! Exhaustive counting: all that breadth-first counts, in memory that does not grow with the nodes.

mod branches;
mod counts;
mod shared;

use std::time::Instant;

use hssh_causal::Exploration;
use hssh_topology::Preference;

use crate::builder::{MapperBuilder, MapperError, Objective};
use crate::checkpoint::{CheckpointError, Identity, Keeping};
use crate::context::Context;
use crate::crew::Crew;
use crate::experience::Experience;
use crate::limits::{StopReason, Watch};
use crate::report::{LevelCounts, Report};
use branches::{Progress, Top};
use counts::Counts;

pub use branches::CountedBranch;
pub use shared::{BranchCounter, SharedCount};

/// What a count is called.
const STRATEGY: &str = "exhaustive counting";

impl MapperBuilder {
    /// Counts all hypotheses about an exploration and keeps none, in memory that does not grow with their
    /// number. Neither order nor goal matters, and maps are ranked by preference.
    ///
    /// A limit or an interruption ends the count early; the report then covers the branches of the
    /// tree that were counted to their end, and is the same for any number of threads if it was the
    /// limit on nodes.
    ///
    /// # Errors
    /// If the operating system gives no threads, the axioms do not allow to discard maps, or there is a checkpoint that the count
    /// cannot go on from.
    pub fn count(self, exploration: &Exploration) -> Result<Report, MapperError> {
        self.axioms.check()?;
        let started = Instant::now();
        let experience = &Experience::from(exploration);
        let crew = Crew::new(self.threads)?;
        let preference = preference(&self);
        let limits = Watch::start(self.limits, &self.monitor);
        let context = Context { experience, axioms: &self.axioms, crew: &crew, watch: &limits };
        let identity = || Identity::of(STRATEGY.to_owned(), &self, exploration);
        let mut keeping = Keeping::new(self.checkpoints.clone(), identity);

        let travels = experience.observations.len();
        let kept = keeping.begin(|unsealed| {
            let before: f64 = unsealed.take()?;
            // The top was grown before, within the limits that there were.
            let watch = &Watch::without_limits();
            let top = Top::grow(Context { watch, ..context }).map_err(|_| CheckpointError::Damaged)?.0;
            let progress = Progress::read(unsealed, &top, travels)?;
            Ok((progress.nodes(), (before, top, progress)))
        })?;
        let (before, top, mut progress) = match kept {
            Some((before, top, progress)) => {
                self.monitor.goes_on(progress.nodes(), 0);
                (before, top, progress)
            }
            None => match Top::grow(context) {
                Ok((top, progress)) => (0.0, top, progress),
                Err(stopped) => {
                    let (counts, stop) = *stopped;
                    return Ok(report(counts, stop, 0, started.elapsed().as_secs_f64()));
                }
            },
        };
        let seconds = || before + started.elapsed().as_secs_f64();
        let stop = loop {
            let watch = &limits.pausing(keeping.due);
            let stop = progress.advance(&top, preference, Context { watch, ..context });
            if !stop.is_complete() {
                keeping.keep(|pen| {
                    pen.put(&seconds())?;
                    progress.write(pen)
                });
            }
            if !watch.is_pause(stop) {
                break stop;
            }
        };
        Ok(report(progress.total, stop, top.tree.bytes(), seconds()))
    }
}

/// How the maps of a count are ranked.
fn preference(options: &MapperBuilder) -> Preference {
    match options.objective {
        Objective::Preference(preference) => preference,
        Objective::Posterior(_) => Preference::default(),
    }
}

/// The account of a count.
fn report(counts: Counts, stop: StopReason, bytes: u64, seconds: f64) -> Report {
    let nodes = counts.nodes();
    let sum = |of: fn(&LevelCounts) -> u64| counts.levels.iter().map(of).sum::<u64>();
    let travels = counts.levels.len() as u64 - 1;
    Report {
        strategy: STRATEGY.to_owned(),
        stop,
        travels,
        explained: if stop.is_complete() { travels } else { 0 },
        nodes,
        maps: sum(|level| level.maps),
        refuted: sum(|level| level.refuted),
        expanded: counts.steps,
        finals: counts.finals,
        rejected: 0,
        is_optimal: stop.is_complete(),
        removals: counts.removals,
        proof: None,
        solved: 0,
        levels: counts.levels,
        seconds,
        bytes,
    }
}
