//! What was believed on the way, as what is new after each travel.

use hssh_metrics::Pose;

use super::data::{PageBelief, PageHistory};
use super::image::rounded;
use crate::answer::StopReason;
use crate::pipeline::{Belief, History};

/// A history as a page has it.
pub(super) fn page_history(told: &History) -> PageHistory {
    let none = Belief {
        branch: String::new(),
        tied: 0,
        proved: false,
        probability: None,
        measure: crate::answer::MapMeasure { undetermined_boundaries: 0, paths: 0, places: 0, genus: 0 },
        poses: Vec::new(),
    };
    let before = std::iter::once(&none).chain(&told.beliefs);
    PageHistory {
        beliefs: before.zip(&told.beliefs).map(|(before, now)| news(before, now)).collect(),
        end: told.stop.map(|stop| end(stop, told.beliefs.len())),
    }
}

/// What is new in a belief.
fn news(before: &Belief, now: &Belief) -> PageBelief {
    let words: Vec<&str> = now.branch.split_whitespace().collect();
    let kept = before.branch.split_whitespace().zip(&words).take_while(|(one, other)| one == *other).count();
    let place = |pose: &Pose| [pose.x, pose.y, pose.theta].map(rounded);
    let moved = now.poses.iter().enumerate().filter_map(|(number, pose)| {
        let [x, y, theta] = place(pose);
        let is_new = before.poses.get(number).is_none_or(|before| place(before) != [x, y, theta]);
        is_new.then_some([number as f64, x, y, theta])
    });
    PageBelief {
        kept: kept as u32,
        then: words[kept..].join(" "),
        tied: now.tied,
        proved: now.proved,
        probability: now.probability,
        moved: moved.collect(),
    }
}

/// Why there is no belief after that many travels.
fn end(stop: StopReason, travels: usize) -> String {
    match stop {
        StopReason::Exhausted | StopReason::Found | StopReason::Proved => {
            format!("no map explains travel {travels}")
        }
        StopReason::NotSearched => "this kind of search has no beliefs on the way".to_owned(),
        StopReason::NodeLimit => {
            format!("at travel {travels} the search on the way was given up: too many hypotheses")
        }
        StopReason::TimeLimit | StopReason::MemoryLimit | StopReason::Interrupted => {
            format!("at travel {travels} the search on the way was {stop}")
        }
    }
}
