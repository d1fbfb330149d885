//! Experiments with measured travels: how often the true map is found, at which noise and at what cost (chapter 4).

mod chapter4;
mod horizon;
mod plot;
mod scale;
mod trial;

use std::error::Error;

use crate::flags;

pub(crate) use plot::{Chart, Curve, draw};
pub(crate) use trial::on_threads;

/// The experiments of this kind, and what runs them.
const EXPERIMENTS: [(&str, Run); 3] =
    [("chapter-4", chapter4::run), ("scale", scale::run), ("horizon", horizon::run)];

type Run = fn(&flags::Experiment) -> Result<(), Box<dyn Error>>;

/// The experiment of that name.
pub(crate) fn named(name: &str) -> Option<Run> {
    EXPERIMENTS.iter().find(|(known, _)| *known == name).map(|&(_, run)| run)
}

/// The names of all of them.
pub(crate) fn names() -> impl Iterator<Item = String> {
    EXPERIMENTS.iter().map(|(name, _)| (*name).to_owned())
}
