//! Why there is no answer, or something of it cannot be had.

use std::error::Error;

use hssh_causal::ExplorationError;
use hssh_local::{LatticeError, LogError, SurveyError};
use hssh_metrics::PriorError;
use hssh_search::{CheckpointError, MapperError, PlacementError, ThreadsError};
use hssh_topology::AxiomsError;
use hssh_topology::ReadingModelError;

use crate::answer::{DisagreementError, StopReason};

/// Why there is no answer.
#[derive(Debug, thiserror::Error)]
pub enum PipelineError {
    /// A number among the options that makes no sense.
    #[error("the option {name} is {number}: write a number that is {what}")]
    Number {
        /// The option.
        name: &'static str,
        /// What it is.
        number: f64,
        /// What it must be.
        what: &'static str,
    },
    /// Axioms that do not allow to discard maps.
    #[error(transparent)]
    Axioms(#[from] AxiomsError),
    /// A search that finds all maps was asked for closed ones only.
    #[error("only closed maps are asked for, but this search finds all maps, closed or not")]
    ClosedOfAll,
    /// The genus was to count in a search that does not go by preference.
    #[error("the genus belongs to the order of preference, which the posterior does not ask")]
    GenusOfPosterior,
    /// The area of the prior.
    #[error(transparent)]
    Area(#[from] PriorError),
    /// The log cannot be read.
    #[error(transparent)]
    Log(Box<LogError>),
    /// No places along the log.
    #[error(transparent)]
    Survey(Box<SurveyError>),
    /// The search.
    #[error(transparent)]
    Search(#[from] SearchFailure),
    /// No account of an exploration with errors.
    #[error("no account of the exploration was found, errors of perception included: {stop}")]
    NoAccount {
        /// Why the search stopped.
        stop: StopReason,
    },
    /// What is said of visits cannot be.
    #[error(transparent)]
    Visits(#[from] hssh_search::ConstraintError),
    /// Counting does not ask which visits are to one place.
    #[error(
        "hypotheses are counted whatever is said of visits: leave out --same and --different, or search in another way"
    )]
    CountedVisits,
    /// The model of perception.
    #[error("the option readings.model: {0}")]
    Readings(#[from] ReadingModelError),
    /// Errors of perception are reckoned with where travels are measured.
    #[error(
        "errors of perception can be told from other places only if every travel is measured: some travel of the exploration has no odometry"
    )]
    UnmeasuredReadings,
    /// A log's visits are read by its survey.
    #[error(
        "readings are for explorations: visits along a laser log show one star at one place by the survey, and ways are the robot's own"
    )]
    ReadingsOfLog,
    /// The search by other means than those of this process.
    #[error("{0}")]
    Elsewhere(Box<dyn Error + Send + Sync>),
    /// Another process has the answer.
    #[error("the search is spread over processes, the first of which has the answer")]
    AnsweredElsewhere,
    /// An account that makes no exploration.
    #[error(
        "the account makes no exploration: {0}\nhelp: this is a bug in hssh; please report it with the exploration"
    )]
    Corrected(Box<ExplorationError>),
    /// There is no map of that rank among those listed.
    #[error("there is no map number {asked}: only {found} {explain} the exploration", explain = if *found == 1 { "map explains" } else { "maps explain" })]
    NoSuchRank {
        /// The rank asked for, the best being 1.
        asked: usize,
        /// How many maps there are.
        found: usize,
    },
    /// No scans to draw a grid of, or no odometry to place them by.
    #[error("there are no scans to draw the building of: only a laser log has them")]
    NoScans,
    /// Scans so far apart that the grid would be too large.
    #[error("the map of the building is too large for a grid: {0}")]
    Grid(#[from] LatticeError),
    /// The map does not explain the exploration.
    #[error(
        "the replay disagrees with the search: {0}\nhelp: this is a bug in hssh; please report it with the exploration"
    )]
    Disagreement(#[from] DisagreementError),
}

/// Why a search came to nothing.
#[derive(Debug, thiserror::Error)]
pub enum SearchFailure {
    /// The operating system gave no threads.
    #[error(transparent)]
    Threads(#[from] ThreadsError),
    /// Measurements that cannot be weighed, or are not there.
    #[error("cannot weigh the maps: {0}")]
    Mapper(MapperError),
    /// There is a checkpoint that the search cannot go on from.
    #[error("cannot go on from the checkpoint: {0}")]
    Checkpoint(CheckpointError),
    /// The same of the search for readings.
    #[error("cannot go on from the checkpoint of the search for readings: {0}")]
    ReadingCheckpoint(CheckpointError),
    /// A map that cannot be placed by its odometry.
    #[error("cannot place the map by its odometry: {0}")]
    Placement(#[from] PlacementError),
}

impl From<MapperError> for SearchFailure {
    fn from(error: MapperError) -> Self {
        match error {
            MapperError::Checkpoint(error) => SearchFailure::Checkpoint(error),
            error => SearchFailure::Mapper(error),
        }
    }
}
