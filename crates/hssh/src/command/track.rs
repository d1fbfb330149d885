//! `hssh track`: the odometry of a laser log, corrected from scan to scan.

use hssh::account::TrackAccount;
use hssh_local::MatchOptions;
use hssh_metrics::GraphFile;

use crate::arguments::TrackArguments;
use crate::failure::{Failure, Status};
use crate::input::read_tracked;
use crate::output::{Written, check_outputs, print, print_json, write_file, write_grid, write_tum};
use crate::progress::is_interrupted;

pub(crate) fn run(arguments: &TrackArguments) -> Result<Status, Failure> {
    let TrackArguments { log, trajectory, grid, g2o, .. } = arguments;
    let image = crate::output::grid_image(grid.as_deref());
    check_outputs(&[log], [trajectory, grid, g2o, &image].map(Option::as_ref))?;
    let tracked =
        read_tracked(log, &arguments.laser.choice(), &arguments.laser.topics, &MatchOptions::default())?;
    if let Some(lost) = tracked.first_loss().filter(|_| arguments.strict) {
        return Err(Failure::Partial { file: log.clone(), lost });
    }
    let account = TrackAccount::new(&log.display().to_string(), &tracked);
    if arguments.json {
        print_json(&account)?;
    } else {
        let partial = tracked.partial().map(|partial| format!("PARTIAL: {partial}\n"));
        print(&(partial.unwrap_or_default() + &account.to_string()))?;
    }
    let mut written = Written::default();
    if let Some(file) = trajectory {
        written.note(write_tum(file, &tracked.trajectory()));
    }
    if let Some(file) = grid {
        written.note(tracked.grid().map_err(Failure::from).and_then(|grid| write_grid(file, &grid)));
    }
    if let Some(file) = g2o {
        let graph = tracked.graph().map_err(Failure::from);
        written.note(graph.and_then(|graph| write_file(file, &GraphFile::from(graph).to_g2o())));
    }
    written.done()?;
    Ok(if is_interrupted() { Status::Stopped } else { Status::Found })
}
