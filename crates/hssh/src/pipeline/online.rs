//! What was believed on the way: the exploration told again to the on-line search, travel by travel.

use hssh_metrics::Pose;
use hssh_search::{Goal, Limits, Mapper, RankedMap, StopReason, Visit};

use super::engine::{Task, measured};
use super::error::{PipelineError, SearchFailure};
use super::options::SearchMethod;
use crate::answer::MapMeasure;

/// The best map of the travels so far.
#[derive(Clone, PartialEq, Debug)]
pub struct Belief {
    /// What identifies the map: one word for each travel so far.
    pub branch: String,
    /// How many maps were as good, this one among them.
    pub tied: u64,
    /// Whether it was proved that none was better.
    pub proved: bool,
    /// By posterior: its probability, at least and at most; as in the answer, what a log's places rest on is a factor.
    pub probability: Option<[f64; 2]>,
    /// What preference looks at.
    pub measure: MapMeasure,
    /// By posterior: the frames of its places in that of the first. Empty if nothing was laid out.
    pub poses: Vec<Pose>,
}

/// What was believed after each travel, the start first, and why it ends if it does not go to the end.
#[derive(Clone, PartialEq, Debug)]
pub struct History {
    /// After so many travels as the number in the list says.
    pub beliefs: Vec<Belief>,
    /// Why the search was given up; nothing if it went through all travels considered. [`StopReason::Exhausted`] says that no map explains the
    /// next travel.
    pub stop: Option<StopReason>,
}

impl Task<'_> {
    /// What is believed after each travel; given up beyond so many hypotheses.
    pub(super) fn history(&self, most_nodes: u64) -> Result<History, PipelineError> {
        let mut history = History { beliefs: Vec::new(), stop: None };
        if self.method == SearchMethod::Count {
            history.stop = Some(StopReason::NotSearched);
            return Ok(history);
        }
        let limits = self.options.limits.of_search();
        let most_nodes = limits.nodes.map_or(most_nodes, |nodes| nodes.min(most_nodes));
        let builder = self.mapper_builder_for(Goal::AnyMap)?;
        let start = &self.exploration.star_types()[self.exploration.start().index()];
        let mut mapper = builder
            .limits(Limits { nodes: Some(most_nodes), ..limits })
            .start_with(&start.star, &start.bearings)
            .map_err(SearchFailure::from)?;
        for travel in 0..=self.exploration.travels().len() {
            if let Some(before) = travel.checked_sub(1)
                && mapper.observe(Visit::of(self.exploration, before)).is_err()
            {
                history.stop = Some(StopReason::NotSearched);
                break;
            }
            let stop = mapper.advance();
            let (report, maps) = mapper.answer(1);
            match maps.first() {
                Some(map) if report.explained as usize == travel => {
                    history.beliefs.push(belief(&mapper, map, report.finals.optimal, report.is_optimal));
                }
                _ => {
                    history.stop = Some(stop);
                    break;
                }
            }
        }
        Ok(history)
    }
}

fn belief(mapper: &Mapper, map: &RankedMap, tied: u64, proved: bool) -> Belief {
    let probable = map.probable.as_ref();
    Belief {
        branch: mapper.branch(map.node).to_string(),
        tied,
        proved,
        probability: probable.map(|probable| [probable.at_least, probable.at_most]),
        measure: measured(map.measure),
        poses: probable.map(|probable| probable.poses.clone()).unwrap_or_default(),
    }
}
