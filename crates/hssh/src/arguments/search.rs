//! The command line of searches: every flag overrides what the file of options says.

use std::path::PathBuf;
use std::time::Duration;

use clap::Args;
use hssh::pipeline::{GenusOrder, MappingOptions, MetricalScore, PriorKind, SearchMethod};
use hssh_topology::Simplicity;

use super::{LaserArguments, PlaceArguments, positive};
use crate::failure::Failure;

#[derive(Debug, Args)]
pub(crate) struct SearchArguments {
    /// Read options from a RON file; flags override it. `hssh options` prints one with all defaults.
    #[arg(long, value_name = "FILE", help_heading = "Search")]
    pub(crate) options: Option<PathBuf>,
    /// How to search: posterior if every travel has odometry and no --genus is given, else breadth-first.
    #[arg(long, value_enum, value_name = "HOW", help_heading = "Search")]
    pub(crate) search: Option<SearchMethod>,
    /// Accept closed maps only, and go back until there is one; not with breadth-first and count.
    #[arg(long, help_heading = "Search")]
    pub(crate) closed: bool,
    /// Threads, 0 for one per core; the result does not depend on it [default: 0].
    #[arg(long, value_name = "N", help_heading = "Search")]
    pub(crate) threads: Option<usize>,

    /// Reckon with errors of perception, each at its price (see docs/readings.md): gateways missed or imagined, places passed
    /// unreported, visits to none, turning on the way. Every travel must be measured.
    #[arg(long, help_heading = "Search")]
    pub(crate) readings: bool,

    /// Two visits are known to be to the same place, whatever they look like; visits count from 0, the start, and this may be said
    /// of many pairs.
    #[arg(long, value_name = "VISIT,VISIT", value_parser = visits, help_heading = "Search")]
    pub(crate) same: Vec<[usize; 2]>,
    /// Two visits are known to be to different places.
    #[arg(long, value_name = "VISIT,VISIT", value_parser = visits, help_heading = "Search")]
    pub(crate) different: Vec<[usize; 2]>,

    #[command(flatten)]
    pub(crate) posterior: PosteriorArguments,
    #[command(flatten)]
    pub(crate) axioms: AxiomArguments,

    /// Stop at N hypotheses.
    #[arg(long, value_name = "N", help_heading = "Limits")]
    pub(crate) max_nodes: Option<u64>,
    /// Stop after that many seconds.
    #[arg(long, value_name = "SECONDS", value_parser = seconds, help_heading = "Limits")]
    pub(crate) max_time: Option<f64>,
    /// Stop before the program takes more memory than that: MiB, or with a unit, as in 500M or 2G [default: 4096].
    #[arg(long, value_name = "SIZE", value_parser = mebibytes, help_heading = "Limits")]
    pub(crate) max_memory: Option<u64>,
    /// Explain only the first N travels.
    #[arg(long, value_name = "N", help_heading = "Limits")]
    pub(crate) travels: Option<usize>,
}

#[derive(Debug, Args)]
pub(crate) struct PosteriorArguments {
    /// How measurements count [default: evidence].
    #[arg(long, value_enum, value_name = "HOW", help_heading = "Posterior")]
    pub(crate) score: Option<MetricalScore>,
    /// What counts besides: flat with --score evidence, else simplicity.
    #[arg(long, value_enum, value_name = "WHAT", help_heading = "Posterior")]
    pub(crate) prior: Option<PriorKind>,
    /// The weights of F: c1,c2,c3 [default: 0,2,1].
    #[arg(long, value_name = "C1,C2,C3", value_parser = weights, help_heading = "Posterior")]
    pub(crate) weights: Option<Simplicity>,
    /// New places may be anywhere in that many square metres; without it, where corridors as long as those
    /// travelled lead.
    #[arg(long, value_name = "M2", value_parser = positive, help_heading = "Posterior")]
    pub(crate) area: Option<f64>,
    /// Prove the N best maps [default: 1].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..), help_heading = "Posterior")]
    pub(crate) best: Option<u64>,
    /// Go on until all maps not found have at most that probability together; 1 to stop at the proof [default: 0.01].
    #[arg(long, value_name = "P", value_parser = positive, help_heading = "Posterior")]
    pub(crate) rest: Option<f64>,
}

#[derive(Debug, Args)]
pub(crate) struct AxiomArguments {
    /// Only maps that can be drawn in the plane: genus 0.
    #[arg(long, help_heading = "Axioms")]
    pub(crate) planar: bool,
    /// Only maps of genus at most N.
    #[arg(long, value_name = "N", conflicts_with = "planar", help_heading = "Axioms")]
    pub(crate) max_genus: Option<u32>,
    /// Only maps with at most N places.
    #[arg(long, value_name = "N", help_heading = "Axioms")]
    pub(crate) max_places: Option<u32>,
    /// No two paths share two places, and no three form a triangle.
    #[arg(long, help_heading = "Axioms")]
    pub(crate) perpendicular: bool,
    /// No place is on both sides of a path, or beside a path it lies on.
    #[arg(long, help_heading = "Axioms")]
    pub(crate) consistent_boundaries: bool,
    /// Allow a path to meet a place twice.
    #[arg(long, help_heading = "Axioms")]
    pub(crate) allow_self_intersection: bool,
    /// Allow a path to return into itself.
    #[arg(long, help_heading = "Axioms")]
    pub(crate) allow_circular: bool,
    /// Let the genus count in the order of preference.
    #[arg(long, value_enum, value_name = "WHERE", help_heading = "Axioms")]
    pub(crate) genus: Option<GenusOrder>,
}

impl SearchArguments {
    /// What is asked for: the options of the file, overridden by flags.
    pub(crate) fn options(
        &self,
        places: &PlaceArguments,
        laser: &LaserArguments,
    ) -> Result<MappingOptions, Failure> {
        let mut options = self.file()?;
        places.apply(&mut options.places);
        laser.apply(&mut options.laser);
        self.posterior.apply(&mut options);
        self.axioms.apply(&mut options);
        options.search.method = self.search.or(options.search.method);
        options.search.closed |= self.closed;
        if self.readings {
            options.readings.model.get_or_insert_default();
        }
        options.visits.same.extend(&self.same);
        options.visits.different.extend(&self.different);
        options.search.threads = self.threads.unwrap_or(options.search.threads);
        options.limits.nodes = self.max_nodes.or(options.limits.nodes);
        options.limits.seconds = self.max_time.or(options.limits.seconds);
        options.limits.mebibytes = self.max_memory.unwrap_or(options.limits.mebibytes);
        options.limits.travels = self.travels.or(options.limits.travels);
        self.refuse_useless_weights(&options)?;
        options.check()?;
        Ok(options)
    }

    /// Weights count with the prior that they are the weights of.
    fn refuse_useless_weights(&self, options: &MappingOptions) -> Result<(), Failure> {
        let posterior = &options.posterior;
        let usual =
            if posterior.score == MetricalScore::Evidence { PriorKind::Flat } else { PriorKind::Simplicity };
        if self.posterior.weights.is_some() && posterior.prior.unwrap_or(usual) != PriorKind::Simplicity {
            let help =
                "--weights are those of the prior of simplicity: add --prior simplicity, or leave them out";
            return Err(Failure::Usage(help.to_owned()));
        }
        Ok(())
    }

    fn file(&self) -> Result<MappingOptions, Failure> {
        let Some(file) = &self.options else { return Ok(MappingOptions::default()) };
        let text = std::fs::read_to_string(file)
            .map_err(|error| Failure::ReadOptions { file: file.clone(), error })?;
        MappingOptions::from_ron(&text)
            .map_err(|error| Failure::Options { file: file.clone(), error: Box::new(error) })
    }
}

impl PosteriorArguments {
    fn apply(&self, options: &mut MappingOptions) {
        let posterior = &mut options.posterior;
        posterior.score = self.score.unwrap_or(posterior.score);
        posterior.prior = self.prior.or(posterior.prior);
        posterior.weights = self.weights.unwrap_or(posterior.weights);
        posterior.area = self.area.or(posterior.area);
        posterior.best = self.best.map_or(posterior.best, |best| usize::try_from(best).unwrap_or(usize::MAX));
        posterior.rest = self.rest.unwrap_or(posterior.rest);
    }
}

impl AxiomArguments {
    fn apply(&self, options: &mut MappingOptions) {
        let axioms = &mut options.axioms;
        axioms.max_genus = if self.planar { Some(0) } else { self.max_genus.or(axioms.max_genus) };
        axioms.max_places = self.max_places.or(axioms.max_places);
        axioms.perpendicular |= self.perpendicular;
        axioms.consistent_boundaries |= self.consistent_boundaries;
        axioms.no_self_intersection &= !self.allow_self_intersection;
        axioms.no_circular_path &= !self.allow_circular;
        options.search.genus = self.genus.or(options.search.genus);
    }
}

fn seconds(text: &str) -> Result<f64, String> {
    let seconds: f64 = text.parse().map_err(|_| "write a number of seconds, like 10 or 0.5".to_owned())?;
    let is_time = Duration::try_from_secs_f64(seconds).is_ok();
    is_time.then_some(seconds).ok_or_else(|| "the time must be positive and finite".to_owned())
}

/// A number of MiB, or one with a unit: M or G, MiB or GiB.
fn mebibytes(text: &str) -> Result<u64, String> {
    let help = || "write a whole number of MiB, or one with a unit, like 500M or 2G".to_owned();
    let number = text.trim_end_matches(|letter: char| letter.is_ascii_alphabetic());
    let factor = match text[number.len()..].to_ascii_lowercase().as_str() {
        "" | "m" | "mib" => 1,
        "g" | "gib" => 1024,
        _ => return Err(help()),
    };
    let number: u64 = number.parse().map_err(|_| help())?;
    number.checked_mul(factor).ok_or_else(help)
}

fn visits(text: &str) -> Result<[usize; 2], String> {
    let numbers: Option<Vec<usize>> = text.split(',').map(|number| number.trim().parse().ok()).collect();
    match numbers.as_deref() {
        Some(&[one, other]) => Ok([one, other]),
        _ => Err("write two visits, counted from 0, like 3,17".to_owned()),
    }
}

fn weights(text: &str) -> Result<Simplicity, String> {
    let numbers: Option<Vec<f64>> = text.split(',').map(|number| number.trim().parse().ok()).collect();
    match numbers.as_deref() {
        Some(&[c1, c2, c3]) if [c1, c2, c3].iter().all(|weight| weight.is_finite() && *weight >= 0.0) => {
            Ok(Simplicity { c1, c2, c3 })
        }
        _ => Err("write three numbers that are not negative, like 0,2,1".to_owned()),
    }
}
