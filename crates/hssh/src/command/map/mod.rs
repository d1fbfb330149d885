//! `hssh map`: the maps that explain an exploration, ranked and drawn.

mod draw;
pub(crate) mod preferred;
pub(crate) mod probable;

use crate::arguments::{MapOptions, Task};
use crate::failure::{Failure, Status};
use crate::input::read_exploration;

pub(crate) fn run(options: &MapOptions) -> Result<Status, Failure> {
    let exploration = read_exploration(&options.file)?;
    let exploration = exploration.prefix(options.search.travels.unwrap_or(usize::MAX));
    match options.search.task(&exploration)? {
        Task::Prefer(strategy) => preferred::run(options, strategy, &exploration),
        Task::Weigh(order) => probable::run(options, order, &exploration),
        Task::Count if draw::is_asked(options) => {
            let help = "counting keeps no maps to draw: choose another --search for pictures";
            Err(Failure::Usage(help.to_owned()))
        }
        Task::Count => preferred::run_count(options, &exploration),
    }
}
