//! The command line.

use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

use clap::{Args, Parser, Subcommand, ValueEnum};
use hssh_search::{Goal, Limits, Mapper, MapperBuilder, Monitor, Strategy};
use hssh_topology::{Axioms, GenusRank, Preference};

use crate::failure::Failure;

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
    Map(MapOptions),
    /// Read an exploration and say what is in it, or what is wrong with it.
    Check(CheckOptions),
    /// Tell step by step how the best map explains an exploration.
    Explain(ExplainOptions),
}

#[derive(Debug, Args)]
pub(crate) struct MapOptions {
    /// The exploration, a RON file (see docs/exploration-format.md); `-` reads standard input.
    pub(crate) file: PathBuf,
    #[command(flatten)]
    pub(crate) search: SearchOptions,
    /// How many maps to list.
    #[arg(long, default_value_t = 10, value_name = "N")]
    pub(crate) top: usize,
    /// List all maps.
    #[arg(long, conflicts_with = "top")]
    pub(crate) all: bool,
    /// Print also what the search made of each travel, and its cost.
    #[arg(long)]
    pub(crate) levels: bool,
    /// Print one JSON object instead of tables.
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
}

#[derive(Debug, Args)]
pub(crate) struct CheckOptions {
    /// The exploration, a RON file; `-` reads standard input.
    pub(crate) file: PathBuf,
    /// Print one JSON object.
    #[arg(long)]
    pub(crate) json: bool,
}

#[derive(Debug, Args)]
pub(crate) struct ExplainOptions {
    /// The exploration, a RON file; `-` reads standard input.
    pub(crate) file: PathBuf,
    #[command(flatten)]
    pub(crate) search: SearchOptions,
    /// Which map of the ranking to explain, the best being 1.
    #[arg(long, default_value_t = 1, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub(crate) rank: u32,
    /// Print one JSON object.
    #[arg(long)]
    pub(crate) json: bool,
}

/// How the tree of hypotheses is searched.
#[derive(Clone, Copy, PartialEq, Eq, Debug, ValueEnum)]
pub(crate) enum SearchKind {
    /// All hypotheses, level by level.
    BreadthFirst,
    /// The best hypothesis by preference first: fast, may miss the optimum.
    BestFirst,
    /// By a bound that proves the best maps, all of them.
    Proof,
    /// Count all hypotheses in constant memory; lists no maps.
    Count,
}

/// Where the genus stands in the order of preference.
#[derive(Clone, Copy, PartialEq, Eq, Debug, ValueEnum)]
pub(crate) enum GenusOption {
    /// Before everything else.
    First,
    /// After everything else.
    Last,
}

#[derive(Debug, Args)]
pub(crate) struct SearchOptions {
    /// How to search.
    #[arg(long, value_enum, default_value_t = SearchKind::BreadthFirst, value_name = "HOW", help_heading = "Search")]
    pub(crate) search: SearchKind,
    /// With best-first and proof: accept closed maps only, and go back until there is one.
    #[arg(long, help_heading = "Search")]
    pub(crate) closed: bool,
    /// Threads, 0 for one per core; the result does not depend on it.
    #[arg(long, default_value_t = 0, value_name = "N", help_heading = "Search")]
    pub(crate) threads: usize,

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
    pub(crate) genus: Option<GenusOption>,

    /// Stop at N hypotheses.
    #[arg(long, value_name = "N", help_heading = "Limits")]
    pub(crate) max_nodes: Option<u64>,
    /// Stop after that many seconds.
    #[arg(long, value_name = "SECONDS", value_parser = seconds, help_heading = "Limits")]
    pub(crate) max_time: Option<Duration>,
    /// Stop when the tree takes that many MiB; the program takes somewhat more.
    #[arg(long, value_name = "MIB", default_value_t = 4096, help_heading = "Limits")]
    pub(crate) max_memory: u64,
    /// Explain only the first N travels.
    #[arg(long, value_name = "N", help_heading = "Limits")]
    pub(crate) travels: Option<usize>,
}

fn seconds(text: &str) -> Result<Duration, String> {
    let seconds: f64 = text.parse().map_err(|_| "write a number of seconds, like 10 or 0.5".to_owned())?;
    Duration::try_from_secs_f64(seconds).map_err(|_| "the time must be positive and finite".to_owned())
}

impl SearchOptions {
    pub(crate) fn axioms(&self) -> Axioms {
        Axioms {
            no_self_intersection: !self.allow_self_intersection,
            no_circular_path: !self.allow_circular,
            max_places: self.max_places,
            max_genus: if self.planar { Some(0) } else { self.max_genus },
            perpendicular: self.perpendicular,
            consistent_boundaries: self.consistent_boundaries,
        }
    }

    fn preference(&self) -> Preference {
        let genus = match self.genus {
            None => GenusRank::Ignored,
            Some(GenusOption::First) => GenusRank::First,
            Some(GenusOption::Last) => GenusRank::Last,
        };
        Preference { genus }
    }

    /// The mapper's strategy; `None` if maps are only to be counted.
    pub(crate) fn strategy(&self) -> Result<Option<Strategy>, Failure> {
        let goal = if self.closed { Goal::ClosedMap } else { Goal::AnyMap };
        match self.search {
            SearchKind::BestFirst => Ok(Some(Strategy::BestFirst(goal))),
            SearchKind::Proof => Ok(Some(Strategy::Proof(goal))),
            SearchKind::BreadthFirst | SearchKind::Count if self.closed => Err(Failure::Usage(
                "--closed goes with --search best-first and --search proof: the others find all maps, closed or not"
                    .to_owned(),
            )),
            SearchKind::BreadthFirst => Ok(Some(Strategy::BreadthFirst)),
            SearchKind::Count => Ok(None),
        }
    }

    /// How to search, but for the strategy.
    pub(crate) fn builder(&self, monitor: &Arc<Monitor>) -> MapperBuilder {
        Mapper::builder()
            .axioms(self.axioms())
            .preference(self.preference())
            .limits(self.limits())
            .threads(self.threads)
            .monitor(Arc::clone(monitor))
    }

    fn limits(&self) -> Limits {
        Limits { nodes: self.max_nodes, time: self.max_time, bytes: Some(self.max_memory << 20) }
    }
}
