//! What was believed on the way, as what is new after each travel.

use hssh_metrics::{Pose, wrap_angle};

use super::data::{PageBelief, PageHistory};
use super::image::rounded;
use crate::answer::StopReason;
use crate::pipeline::{Belief, History};

/// A place that lies no farther than that from where it was last told is not told again: m, and rad.
const SAME: (f64, f64) = (0.02, 0.01);

/// What was told so far.
#[derive(Default)]
struct Told<'a> {
    words: Vec<&'a str>,
    /// By place: x, y, θ.
    poses: Vec<[f64; 3]>,
}

/// A history as a page has it.
pub(super) fn page_history(history: &History) -> PageHistory {
    let mut told = Told::default();
    PageHistory {
        beliefs: history.beliefs.iter().map(|belief| told.tell(belief)).collect(),
        end: history.stop.map(|stop| end(stop, history.beliefs.len())),
    }
}

impl<'a> Told<'a> {
    /// What is new in a belief.
    fn tell(&mut self, belief: &'a Belief) -> PageBelief {
        let words: Vec<&str> = belief.branch.split_whitespace().collect();
        let kept = self.words.iter().zip(&words).take_while(|(one, other)| one == other).count();
        let news = PageBelief {
            kept: kept as u32,
            then: words[kept..].join(" "),
            tied: belief.tied,
            proved: belief.proved,
            probability: belief.probability,
            moved: self.moved(&belief.poses),
        };
        self.words = words;
        news
    }

    /// The places that are new, or lie elsewhere than was told.
    fn moved(&mut self, poses: &[Pose]) -> Vec<[f64; 4]> {
        let mut moved = Vec::new();
        for (number, pose) in poses.iter().enumerate() {
            let now = [pose.x, pose.y, pose.theta].map(rounded);
            let is_told = |&[x, y, theta]: &[f64; 3]| {
                (x - now[0]).hypot(y - now[1]) <= SAME.0 && wrap_angle(theta - now[2]).abs() <= SAME.1
            };
            if self.poses.get(number).is_some_and(is_told) {
                continue;
            }
            moved.push([number as f64, now[0], now[1], now[2]]);
            match self.poses.get_mut(number) {
                Some(told) => *told = now,
                None => self.poses.push(now),
            }
        }
        moved
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
