//! The command line.

mod local;

use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

use clap::{Args, Parser, Subcommand, ValueEnum};
use hssh_causal::Exploration;
use hssh_metrics::UniformPrior;
use hssh_search::{
    Corridor, Goal, Limits, MapPrior, Mapper, MapperBuilder, Metrical, Monitor, PlacePrior, PosteriorModel,
    PosteriorOrder, PosteriorSearch, Proving, Strategy,
};
use hssh_topology::{Axioms, GenusRank, Preference, Simplicity};

use crate::failure::Failure;
pub(crate) use local::{ExploreOptions, PlaceArguments, SimulateOptions, StarsOptions};

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
    /// Find the poses of a pose graph (g2o or TORO) that contradict its measurements least.
    Graph(GraphOptions),
    /// Find the places of a grid map: their gateways, their stars, and what connects them.
    Stars(StarsOptions),
    /// Make an exploration from a robot's laser log: find the places it visited, and their stars.
    Explore(ExploreOptions),
    /// Drive a simulated robot through a grid map, and write its laser log.
    Simulate(SimulateOptions),
}

#[derive(Debug, Args)]
pub(crate) struct MapOptions {
    /// The exploration, a RON file (see docs/exploration-format.md), or a laser log in CARMEN form; `-` reads an
    /// exploration from standard input.
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
    /// Write the pose graph of the best map, laid out, as g2o.
    #[arg(long, value_name = "FILE")]
    pub(crate) g2o: Option<PathBuf>,
    /// With a laser log: write the grid map of the whole building, as PNG, or, if the file ends in .yaml, for
    /// ROS map_server.
    #[arg(long, value_name = "FILE")]
    pub(crate) grid: Option<PathBuf>,
    /// With a laser log: let the likeness of local maps count with this weight. Neighboring cells of a local map are
    /// not independent, so that 1 is too much.
    #[arg(long, value_name = "WEIGHT", default_value_t = 0.0)]
    pub(crate) likeness: f64,
    /// With a laser log: write pictures of every stage into this folder: the track, the local map and the star of
    /// each visit, the map, and the building.
    #[arg(long, value_name = "FOLDER")]
    pub(crate) debug_dir: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) places: PlaceArguments,
}

#[derive(Debug, Args)]
pub(crate) struct CheckOptions {
    /// The exploration, a RON file; `-` reads standard input.
    pub(crate) file: PathBuf,
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

#[derive(Debug, Args)]
pub(crate) struct GraphOptions {
    /// The pose graph: g2o, GTSAM's files of that form, or TORO; `-` reads standard input.
    pub(crate) file: PathBuf,

    /// How to minimize χ².
    #[arg(long, value_enum, default_value_t = MethodOption::Safeguarded, value_name = "HOW", help_heading = "Solver")]
    pub(crate) method: MethodOption,
    /// Which poses to start from.
    #[arg(long, value_enum, default_value_t = StartOption::Best, value_name = "WHERE", help_heading = "Solver")]
    pub(crate) start: StartOption,
    /// Stop after N linear systems (with relaxation: sweeps; with --robust: rounds as well).
    #[arg(long, value_name = "N", help_heading = "Solver")]
    pub(crate) max_iterations: Option<usize>,
    /// Stop when χ² can fall by no more than this part of it.
    #[arg(long, value_name = "PART", default_value_t = 1e-9, value_parser = positive, help_heading = "Solver")]
    pub(crate) tolerance: f64,

    /// Let closures count the less the worse they fit.
    #[arg(long, value_enum, value_name = "KERNEL", help_heading = "Wrong closures")]
    pub(crate) robust: Option<KernelOption>,
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

/// How χ² is minimized.
#[derive(Clone, Copy, PartialEq, Eq, Debug, ValueEnum)]
pub(crate) enum MethodOption {
    /// One linear system, as in the thesis's appendix B.
    LinearizeOnce,
    /// Full steps, whether or not χ² falls.
    GaussNewton,
    /// Full steps while χ² falls, then damped ones.
    LevenbergMarquardt,
    /// Gauss–Newton, guarded by Levenberg–Marquardt.
    Safeguarded,
    /// One pose after the other.
    Relaxation,
}

/// Where a descent begins.
#[derive(Clone, Copy, PartialEq, Eq, Debug, ValueEnum)]
pub(crate) enum StartOption {
    /// Chordal poses; the file's as well, if they fit better than what was found. With --robust and --graduated
    /// dead reckoning, which wrong closures cannot spoil.
    Best,
    /// Chordal relaxation: from the edges alone.
    Chordal,
    /// The poses in the file.
    File,
    /// Dead reckoning.
    Odometry,
}

/// How a measurement that fits badly loses its weight.
#[derive(Clone, Copy, PartialEq, Eq, Debug, ValueEnum)]
pub(crate) enum KernelOption {
    /// It pulls with a constant force.
    Huber,
    /// It pulls the less the worse it fits.
    Cauchy,
    /// Dynamic covariance scaling: in the end it is switched off.
    Dcs,
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
    /// The most probable maps given the measured travels, with a proof.
    Posterior,
    /// The most probable hypothesis first, as in the thesis: may miss the optimum.
    PosteriorBestFirst,
}

/// How well a map fits the measured travels.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default, ValueEnum)]
pub(crate) enum ScoreOption {
    /// The density of the measurements whatever the layout, with a price for every new place.
    #[default]
    Evidence,
    /// Their density at the most likely layout, as in the thesis.
    Likelihood,
    /// They do not count.
    Ignored,
}

/// How probable a map is before anything is measured.
#[derive(Clone, Copy, PartialEq, Eq, Debug, ValueEnum)]
pub(crate) enum PriorOption {
    /// All maps alike.
    Flat,
    /// In inverse proportion to F = c1·f1 + c2·f2' + c3·f3, as in the thesis.
    Simplicity,
    /// All extensions of a map alike, wherever there is a choice.
    Choices,
}

#[derive(Debug, Args)]
pub(crate) struct PosteriorOptions {
    /// How measurements count.
    #[arg(long, value_enum, value_name = "HOW", default_value_t = ScoreOption::Evidence, help_heading = "Posterior")]
    pub(crate) score: ScoreOption,
    /// What counts besides: flat with --score evidence, else simplicity.
    #[arg(long, value_enum, value_name = "WHAT", help_heading = "Posterior")]
    pub(crate) prior: Option<PriorOption>,
    /// The weights of F: c1,c2,c3.
    #[arg(long, value_name = "C1,C2,C3", value_delimiter = ',', default_values_t = [0.0, 2.0, 1.0], help_heading = "Posterior")]
    pub(crate) weights: Vec<f64>,
    /// New places may be anywhere in that many square metres; without it, where corridors as long as those
    /// travelled lead.
    #[arg(long, value_name = "M2", value_parser = positive, help_heading = "Posterior")]
    pub(crate) area: Option<f64>,
    /// Prove the N best maps.
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u64).range(1..), help_heading = "Posterior")]
    pub(crate) best: u64,
    /// Go on until all maps not found have at most that probability together; 1 to stop at the proof.
    #[arg(long, value_name = "P", default_value_t = 0.01, value_parser = positive, help_heading = "Posterior")]
    pub(crate) rest: f64,
}

/// Where the genus stands in the order of preference.
#[derive(Clone, Copy, PartialEq, Eq, Debug, ValueEnum)]
pub(crate) enum GenusOption {
    /// Before everything else.
    First,
    /// After everything else.
    Last,
}

/// What a command is to do with the tree of hypotheses.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(crate) enum Task {
    /// Find the maps that are preferred.
    Prefer(Strategy),
    /// Find the most probable maps.
    Weigh(PosteriorOrder),
    /// Count all hypotheses.
    Count,
}

#[derive(Debug, Args)]
pub(crate) struct SearchOptions {
    /// How to search: posterior if every travel has odometry and no --genus is given, else breadth-first.
    #[arg(long, value_enum, value_name = "HOW", help_heading = "Search")]
    pub(crate) search: Option<SearchKind>,
    /// Accept closed maps only, and go back until there is one; not with breadth-first and count.
    #[arg(long, help_heading = "Search")]
    pub(crate) closed: bool,
    /// Threads, 0 for one per core; the result does not depend on it.
    #[arg(long, default_value_t = 0, value_name = "N", help_heading = "Search")]
    pub(crate) threads: usize,

    #[command(flatten)]
    pub(crate) posterior: PosteriorOptions,

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

fn positive(text: &str) -> Result<f64, String> {
    let number: Option<f64> = text.parse().ok();
    let is_right = |number: &f64| *number > 0.0 && number.is_finite();
    number.filter(is_right).ok_or_else(|| "write a positive number, like 0.5".to_owned())
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

    /// How to search that exploration.
    pub(crate) fn kind(&self, exploration: &Exploration) -> SearchKind {
        let is_measured = || exploration.travels().iter().all(|travel| travel.odometry.is_some());
        match self.search {
            Some(kind) => kind,
            None if exploration.travels().is_empty() || self.genus.is_some() => SearchKind::BreadthFirst,
            None if is_measured() => SearchKind::Posterior,
            None => SearchKind::BreadthFirst,
        }
    }

    fn goal(&self) -> Goal {
        if self.closed { Goal::ClosedMap } else { Goal::AnyMap }
    }

    /// How to search: by preference, by posterior, or only to count.
    pub(crate) fn task(&self, exploration: &Exploration) -> Result<Task, Failure> {
        let kind = self.kind(exploration);
        match kind {
            SearchKind::BestFirst => Ok(Task::Prefer(Strategy::BestFirst(self.goal()))),
            SearchKind::Proof => Ok(Task::Prefer(Strategy::Proof(self.goal()))),
            SearchKind::BreadthFirst | SearchKind::Count if self.closed => Err(Failure::Usage(
                "--closed goes with --search posterior, best-first and proof: the others find all maps, closed or not"
                    .to_owned(),
            )),
            SearchKind::BreadthFirst => Ok(Task::Prefer(Strategy::BreadthFirst)),
            SearchKind::Count => Ok(Task::Count),
            SearchKind::Posterior | SearchKind::PosteriorBestFirst if self.genus.is_some() => {
                Err(Failure::Usage(
                    "--genus belongs to the order of preference, which the posterior does not ask: use --planar or --max-genus"
                        .to_owned(),
                ))
            }
            SearchKind::Posterior => {
                let proving = Proving { best: self.posterior.best as usize, rest: self.posterior.rest };
                Ok(Task::Weigh(PosteriorOrder::Proof(proving)))
            }
            SearchKind::PosteriorBestFirst => Ok(Task::Weigh(PosteriorOrder::BestFirst)),
        }
    }

    /// What makes a map probable.
    pub(crate) fn model(&self, exploration: &Exploration) -> Result<PosteriorModel, Failure> {
        let PosteriorOptions { score, prior, weights, area, .. } = &self.posterior;
        let places = || match area {
            Some(area) => UniformPrior::over_area(*area).ok().map(PlacePrior::Uniform),
            None => Corridor::typical_of(exploration).map(PlacePrior::Corridor),
        };
        let metrical = match score {
            ScoreOption::Likelihood => Metrical::Likelihood,
            ScoreOption::Ignored => Metrical::Ignored,
            // Without any measured distance nothing is laid out, and the search will say so.
            ScoreOption::Evidence => places().map_or(Metrical::Likelihood, Metrical::Evidence),
        };
        let usual = if *score == ScoreOption::Evidence { PriorOption::Flat } else { PriorOption::Simplicity };
        let prior = match prior.unwrap_or(usual) {
            PriorOption::Flat => MapPrior::Flat,
            PriorOption::Choices => MapPrior::Choices,
            PriorOption::Simplicity => {
                let [c1, c2, c3] = weights[..] else {
                    return Err(Failure::Usage("--weights needs three numbers, like 0,2,1".to_owned()));
                };
                MapPrior::Simplicity(Simplicity { c1, c2, c3 })
            }
        };
        Ok(PosteriorModel { metrical, prior })
    }

    /// The search by posterior.
    pub(crate) fn weighing(
        &self,
        order: PosteriorOrder,
        exploration: &Exploration,
        monitor: &Arc<Monitor>,
    ) -> Result<PosteriorSearch, Failure> {
        Ok(PosteriorSearch {
            axioms: self.axioms(),
            order,
            goal: self.goal(),
            limits: self.limits(),
            monitor: Arc::clone(monitor),
            ..PosteriorSearch::new(self.model(exploration)?)
        })
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
