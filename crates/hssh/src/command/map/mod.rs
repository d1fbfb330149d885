//! `hssh map`: the maps that explain an exploration, ranked and drawn.

mod draw;
mod log;
pub(crate) mod preferred;
pub(crate) mod probable;

use hssh_causal::Exploration;
use hssh_search::LevelCounts;

use crate::arguments::{MapOptions, Task};
use crate::failure::{Failure, Status};
use crate::input::{is_log, read_exploration};
use log::Surveyed;

/// What maps are to explain.
pub(crate) struct Source {
    pub(crate) exploration: Exploration,
    /// The laser log that it was made of.
    surveyed: Option<Surveyed>,
}

pub(crate) fn run(options: &MapOptions) -> Result<Status, Failure> {
    let travels = options.search.travels.unwrap_or(usize::MAX);
    let mut source = read(options)?;
    source.exploration = source.exploration.prefix(travels);
    match options.search.task(&source.exploration)? {
        Task::Prefer(strategy) => preferred::run(options, strategy, &source),
        Task::Weigh(order) => probable::run(options, order, &source),
        Task::Count if draw::is_asked(options) => {
            let help = "counting keeps no maps to draw: choose another --search for pictures";
            Err(Failure::Usage(help.to_owned()))
        }
        Task::Count => preferred::run_count(options, &source.exploration),
    }
}

/// Which travel no map explains, by how many hypotheses explain so many travels.
fn none_survives(levels: &[LevelCounts]) -> String {
    let travel = levels.iter().position(|level| level.nodes == 0).unwrap_or(levels.len());
    format!(
        "No map explains the exploration: none survives travel {travel}. Is a star wrong, or an axiom too strict? \
         --travels {} maps what was before.\n",
        travel.saturating_sub(1)
    )
}

fn read(options: &MapOptions) -> Result<Source, Failure> {
    if is_log(&options.file)? {
        return log::read(&options.file, &options.places, options.debug_dir.as_deref());
    }
    let is_asked = options.grid.is_some() || options.likeness != 0.0 || options.debug_dir.is_some();
    if is_asked || !options.places.is_empty() {
        let help = "--grid, --likeness, --debug-dir and what counts as a place need a laser log: an exploration has no scans";
        return Err(Failure::Usage(help.to_owned()));
    }
    Ok(Source { exploration: read_exploration(&options.file)?, surveyed: None })
}
