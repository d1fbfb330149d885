//! The command line.

mod export;
mod local;
mod page;
#[cfg(feature = "cluster")]
mod processes;
mod search;

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand};
use hssh::graph::{GraphOptions, KernelChoice, MethodChoice, StartChoice, WrongClosures};
use hssh::pipeline::MappingOptions;

use crate::failure::Failure;
use crate::progress::is_interrupted;

pub(crate) use export::{ExportArguments, FilesArguments};
pub(crate) use local::{
    ExploreArguments, LaserArguments, PlaceArguments, SimulateArguments, StarsArguments, TopicArguments,
    TrackArguments,
};
pub(crate) use page::PageArguments;
#[cfg(feature = "cluster")]
pub(crate) use processes::ProcessArguments;
pub(crate) use search::SearchArguments;

/// Topological maps of places that look alike: all that explain an exploration, ranked and drawn.
#[derive(Debug, Parser)]
#[command(version, arg_required_else_help = true)]
pub(crate) struct Arguments {
    #[command(subcommand)]
    pub(crate) command: Command,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Find the maps that explain an exploration, print the best and draw them.
    Map(Box<MapArguments>),
    /// Map while the robot drives: what comes from it through a pipe, shown on a page of this machine.
    Live(Box<LiveArguments>),
    /// Read an exploration and say what is in it, or what is wrong with it.
    Check(CheckArguments),
    /// Tell step by step how the best map explains an exploration.
    Explain(ExplainArguments),
    /// Find the poses of a pose graph (g2o or TORO) that contradict its measurements least.
    Graph(GraphArguments),
    /// Find the places of a grid map: their gateways, their stars, and what connects them.
    Stars(StarsArguments),
    /// Write a map as another program reads it: nav2, Open-RMF, topological_navigation, osmAG, GraphML, GeoJSON.
    Export(ExportArguments),
    /// Correct the odometry of a robot's laser log by matching scan with scan: no places, no loops.
    Track(TrackArguments),
    /// Make an exploration from a robot's laser log: find the places it visited, and their stars.
    Explore(ExploreArguments),
    /// Drive a simulated robot through a grid map, and write its laser log.
    Simulate(SimulateArguments),
    /// Check by itself what a proof rests on: a certificate that `map --certificate` wrote.
    Verify(VerifyArguments),
    /// Print the options that --options reads, each with its default.
    Options(OptionsArguments),
    /// Print a script that completes commands and options in a shell.
    Completions(CompletionsArguments),
    /// Print the manual page, or write one for each command.
    Man(ManArguments),
}

#[derive(Debug, Args)]
pub(crate) struct MapArguments {
    /// The exploration, a RON file (see docs/exploration-format.md), or a laser log in CARMEN form; `-` reads an
    /// exploration from standard input.
    pub(crate) file: PathBuf,
    #[command(flatten)]
    pub(crate) search: SearchArguments,
    /// Keep the state of the search in this file from time to time, and when it is stopped; if the file is there, go on from it. The
    /// file is removed when the search has come to its end.
    #[arg(long, value_name = "FILE", help_heading = "Limits")]
    pub(crate) checkpoint: Option<PathBuf>,
    /// With --checkpoint: so much time is between two, at least.
    #[arg(long, value_name = "SECONDS", value_parser = positive, default_value_t = 60.0, requires = "checkpoint", help_heading = "Limits")]
    pub(crate) checkpoint_every: f64,
    /// Beyond --max-memory, keep hypotheses that wait for their turn in a file in this folder, and go on. The file has no name, and is gone when the
    /// program is. Searches level by level and counts keep nothing there.
    #[arg(long, value_name = "FOLDER", help_heading = "Limits")]
    pub(crate) spill: Option<PathBuf>,
    #[cfg(feature = "cluster")]
    #[command(flatten)]
    pub(crate) processes: ProcessArguments,
    /// How many maps to list [default: 10].
    #[arg(long, value_name = "N")]
    pub(crate) top: Option<usize>,
    /// List all maps.
    #[arg(long, conflicts_with = "top")]
    pub(crate) all: bool,
    /// Refuse a log of which scans cannot be used or that breaks off, instead of saying so in the first line.
    #[arg(long)]
    pub(crate) strict: bool,
    /// Print also what the search made of each travel, and its cost.
    #[arg(long)]
    pub(crate) levels: bool,
    /// Print the answer as JSON (see docs/answer-format.md) instead of tables.
    #[arg(long)]
    pub(crate) json: bool,
    /// Draw the best map as SVG; further optimal maps that are listed get a number
    /// before the ending.
    #[arg(long, value_name = "FILE")]
    pub(crate) svg: Option<PathBuf>,
    /// Draw the best map as Graphviz DOT.
    #[arg(long, value_name = "FILE")]
    pub(crate) dot: Option<PathBuf>,
    /// Draw the search tree: DOT if the file ends in .dot, else SVG.
    #[arg(long, value_name = "FILE")]
    pub(crate) tree: Option<PathBuf>,
    /// Write what the proof rests on, for `hssh verify`.
    #[arg(long, value_name = "FILE")]
    pub(crate) certificate: Option<PathBuf>,
    /// With --readings: write the exploration as it must have been, as RON.
    #[arg(long, value_name = "FILE", requires = "readings")]
    pub(crate) corrected: Option<PathBuf>,
    /// Write the pose graph of the best map, laid out, as g2o; with a laser log: all its scans, the steps between them and
    /// what closes their loops.
    #[arg(long, value_name = "FILE")]
    pub(crate) g2o: Option<PathBuf>,
    /// With a laser log: write the grid map of the whole building, as PNG, or, if the file ends in .yaml, for
    /// ROS map_server.
    #[arg(long, value_name = "FILE")]
    pub(crate) grid: Option<PathBuf>,
    /// With a laser log: write where every scan was taken, in TUM form: time x y z qx qy qz qw, a line for each scan
    /// in the order of the log, in metres in the frame of the first place.
    #[arg(long, value_name = "FILE")]
    pub(crate) trajectory: Option<PathBuf>,
    /// Draw and write the map of this rank instead of the best ones.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub(crate) rank: Option<u32>,
    /// With a laser log: let the likeness of local maps count with this weight. Neighboring cells of a local map are
    /// not independent, so that 1 is too much [default: 0].
    #[arg(long, value_name = "WEIGHT", value_parser = not_negative)]
    pub(crate) likeness: Option<f64>,
    /// With a laser log: write pictures of every stage into this folder: the track, the local map and the star of
    /// each visit, the map, and the building.
    #[arg(long, value_name = "FOLDER")]
    pub(crate) debug_dir: Option<PathBuf>,
    /// With a laser log: put where every scan was taken into the answer, so that `hssh export --to tum` finds it there.
    #[arg(long)]
    pub(crate) with_trajectory: bool,
    #[command(flatten)]
    pub(crate) files: FilesArguments,
    #[command(flatten)]
    pub(crate) page: PageArguments,
    #[command(flatten)]
    pub(crate) places: PlaceArguments,
    #[command(flatten)]
    pub(crate) laser: LaserArguments,
}

#[derive(Debug, Args)]
pub(crate) struct LiveArguments {
    #[command(flatten)]
    pub(crate) map: MapArguments,
    /// Serve the page on this port of this machine; 0 takes one that is free.
    #[arg(long, value_name = "PORT", default_value_t = 0)]
    pub(crate) port: u16,
    /// Serve the page until Ctrl-C, also when nothing comes any more.
    #[arg(long)]
    pub(crate) stay: bool,
    /// Make the map anew when the robot has gone so many metres since the last one.
    #[arg(long, value_name = "METRES", default_value_t = 2.0, value_parser = positive)]
    pub(crate) every: f64,
}

#[derive(Debug, Args)]
pub(crate) struct OptionsArguments {
    /// Print one JSON object.
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Debug, Args)]
pub(crate) struct CompletionsArguments {
    /// The shell, such as `hssh completions bash > ~/.local/share/bash-completion/completions/hssh`.
    pub(crate) shell: clap_complete::Shell,
}

#[derive(Debug, Args)]
pub(crate) struct ManArguments {
    /// Write hssh.1 and a page for each command into this folder.
    #[arg(short, long, value_name = "FOLDER")]
    pub(crate) output: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub(crate) struct VerifyArguments {
    /// The certificate (see docs/certificate.md).
    pub(crate) certificate: PathBuf,
    /// The exploration that it is about, a RON file; of a log's, what `hssh explore` makes of it.
    pub(crate) exploration: PathBuf,
    /// Print one JSON object.
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Debug, Args)]
pub(crate) struct CheckArguments {
    /// The exploration, a RON file, or a bag; `-` reads standard input.
    pub(crate) file: PathBuf,
    #[command(flatten)]
    pub(crate) topics: TopicArguments,
    /// Print also its causal schemas ⟨view, action, view⟩, and whether equal views can be one state.
    #[arg(long)]
    pub(crate) schemas: bool,
    /// Write the graph of views as Graphviz DOT.
    #[arg(long, value_name = "FILE")]
    pub(crate) dot: Option<PathBuf>,
    /// Print one JSON object.
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Debug, Args)]
pub(crate) struct ExplainArguments {
    /// The exploration, a RON file, or a laser log; `-` reads an exploration from standard input.
    pub(crate) file: PathBuf,
    #[command(flatten)]
    pub(crate) search: SearchArguments,
    #[command(flatten)]
    pub(crate) places: PlaceArguments,
    #[command(flatten)]
    pub(crate) laser: LaserArguments,
    /// Which map of the ranking to explain, the best being 1.
    #[arg(long, default_value_t = 1, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub(crate) rank: u32,
    /// Print one JSON object.
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Debug, Args)]
pub(crate) struct GraphArguments {
    /// The pose graph: g2o, GTSAM's and Vertigo's files of that form, TORO or iSAM, plain or gzip; `-` reads standard
    /// input.
    pub(crate) file: PathBuf,
    /// Refuse a file of which something that matters cannot be used, instead of saying so in the first line.
    #[arg(long)]
    pub(crate) strict: bool,

    /// How to minimize χ².
    #[arg(long, value_enum, default_value_t = MethodChoice::Safeguarded, value_name = "HOW", help_heading = "Solver")]
    pub(crate) method: MethodChoice,
    /// Which poses to start from.
    #[arg(long, value_enum, default_value_t = StartChoice::Best, value_name = "WHERE", help_heading = "Solver")]
    pub(crate) start: StartChoice,
    /// Stop after N linear systems (with relaxation: sweeps; with --robust: rounds as well).
    #[arg(long, value_name = "N", help_heading = "Solver")]
    pub(crate) max_iterations: Option<usize>,
    /// Stop when χ² can fall by no more than this part of it.
    #[arg(long, value_name = "PART", default_value_t = 1e-9, value_parser = positive, help_heading = "Solver")]
    pub(crate) tolerance: f64,

    /// Let closures count the less the worse they fit.
    #[arg(long, value_enum, value_name = "KERNEL", help_heading = "Wrong closures")]
    pub(crate) robust: Option<KernelChoice>,
    /// With --robust: from how many standard deviations on.
    #[arg(long, value_name = "N", default_value_t = 3.0, value_parser = positive, requires = "robust", help_heading = "Wrong closures")]
    pub(crate) deviations: f64,
    /// Decide for each closure whether to believe it: graduated non-convexity.
    #[arg(long, conflicts_with = "robust", help_heading = "Wrong closures")]
    pub(crate) graduated: bool,
    /// With --graduated: the χ² of a closure from which on it is refused. 11.34 refuses one correct closure in a
    /// hundred.
    #[arg(long, value_name = "CHI2", default_value_t = 11.34, value_parser = positive, requires = "graduated", help_heading = "Wrong closures")]
    pub(crate) threshold: f64,

    /// Print one JSON object.
    #[arg(long, help_heading = "Output")]
    pub(crate) json: bool,
    /// Write the graph with its new poses, without refused closures.
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    pub(crate) g2o: Option<PathBuf>,
    /// Draw trajectory, closures and, of some poses, the covariance.
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    pub(crate) svg: Option<PathBuf>,
    /// Draw the Bayes network of poses and measurements as Graphviz DOT.
    #[arg(long, value_name = "FILE", help_heading = "Output")]
    pub(crate) dot: Option<PathBuf>,
}

pub(crate) fn positive(text: &str) -> Result<f64, String> {
    let number: Option<f64> = text.parse().ok();
    let is_right = |number: &f64| *number > 0.0 && number.is_finite();
    number.filter(is_right).ok_or_else(|| "write a positive number, like 0.5".to_owned())
}

pub(crate) fn not_negative(text: &str) -> Result<f64, String> {
    let number: Option<f64> = text.parse().ok();
    let is_right = |number: &f64| *number >= 0.0 && number.is_finite();
    number.filter(is_right).ok_or_else(|| "write a number that is not negative, like 0.5".to_owned())
}

impl GraphArguments {
    /// What is asked for.
    pub(crate) fn options(&self) -> GraphOptions {
        GraphOptions {
            method: self.method,
            start: self.start,
            max_iterations: self.max_iterations,
            tolerance: self.tolerance,
            wrong: match self.robust {
                Some(kernel) => WrongClosures::Weighed { kernel, deviations: self.deviations },
                None if self.graduated => WrongClosures::Refused { threshold: self.threshold },
                None => WrongClosures::None,
            },
            interrupted: is_interrupted,
        }
    }
}

impl MapArguments {
    /// What is asked for: the options of a file, overridden by flags.
    pub(crate) fn options(&self) -> Result<MappingOptions, Failure> {
        let mut options = self.search.options(&self.places, &self.laser)?;
        if let Some(likeness) = self.likeness {
            options.posterior.likeness = likeness;
        }
        if self.all {
            options.listed = None;
        } else if let Some(top) = self.top {
            options.listed = Some(top);
        }
        Ok(options)
    }
}
