//! How the program ends: exit codes, and what it says when it cannot do what was asked.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use hssh::answer::{Answer, PictureError, VerdictKind};
use hssh::file::FileError;
use hssh::page::PageError;
use hssh::pipeline::{PipelineError, SearchFailure};
use hssh_draw::TreeError;

use crate::terminal::say;

/// How a command ended that did what was asked.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
pub(crate) enum Status {
    /// Something was found.
    Found,
    /// No map explains the exploration.
    NothingConsistent,
    /// A limit or an interruption stopped the search.
    Stopped,
    /// Something that was asked for is not there, which was said.
    Refused,
}

impl Status {
    /// How a search ended.
    pub(crate) fn of(answer: &Answer) -> Self {
        match answer.verdict.kind {
            _ if !answer.search.stop.is_complete() => Status::Stopped,
            VerdictKind::NoMap | VerdictKind::NoClosedMap => Status::NothingConsistent,
            _ => Status::Found,
        }
    }
}

impl From<Status> for ExitCode {
    fn from(status: Status) -> Self {
        match status {
            Status::Found => ExitCode::SUCCESS,
            Status::NothingConsistent => ExitCode::from(1),
            Status::Stopped => ExitCode::from(3),
            Status::Refused => ExitCode::from(2),
        }
    }
}

/// Why a command could not do what was asked.
#[derive(Debug, thiserror::Error)]
pub(crate) enum Failure {
    #[error("cannot read {}: {error}\nhelp: give the path of a file that is there, or - for standard input", file.display())]
    Read { file: PathBuf, error: std::io::Error },
    #[error(transparent)]
    File(Box<FileError>),
    #[error("cannot write {}: {error}\nhelp: the folder must exist and be writable", file.display())]
    Write { file: PathBuf, error: std::io::Error },
    #[error("{} is the input{}: hssh does not write over what it reads\nhelp: give the output another name", file.display(), also_named(file, input))]
    OverInput { file: PathBuf, input: PathBuf },
    #[error("{} and {} are one file, which only one output can have\nhelp: give each output a name of its own", other.display(), file.display())]
    SameOutput { file: PathBuf, other: PathBuf },
    #[error("cannot read the options in {}: {error}\nhelp: `hssh options` prints a file with all defaults", file.display())]
    ReadOptions { file: PathBuf, error: std::io::Error },
    #[error("{}:{}:{}: {}\nhelp: `hssh options` prints every option with its default", file.display(), error.line(), error.column(), error.problem())]
    Options { file: PathBuf, error: Box<hssh::pipeline::OptionsError> },
    #[error("{}: {lost}, and --strict accepts no partial answer", file.display())]
    Partial { file: PathBuf, lost: String },
    #[cfg(feature = "cluster")]
    #[error("{}: {error}", file.display())]
    Hosts { file: PathBuf, error: hssh_cluster::HostsError },
    #[error(transparent)]
    Graph(#[from] hssh::graph::GraphFailure),
    #[error("cannot solve the pose graph: {0}")]
    Solve(#[from] hssh_metrics::SolveError),
    #[error(transparent)]
    Picture(#[from] PictureError),
    #[error("cannot draw the search tree: {0}\nhelp: --travels N draws the tree of the first N travels")]
    Tree(#[from] TreeError),
    #[error("{0}{help}", help = help(.0))]
    Pipeline(Box<PipelineError>),
    #[error(
        "cannot go on from the checkpoint {}: {error}\nhelp: give another file, or remove this one to begin anew", file.display()
    )]
    Checkpoint { file: PathBuf, error: hssh_search::CheckpointError },
    #[error("{}: {error}", file.display())]
    Export { file: PathBuf, error: hssh::export::ExportError },
    #[error("there is no odometry to write as a pose graph")]
    NoOdometry,
    #[error("there is no map number {asked}: only {found} {explain} the exploration", explain = if *found == 1 { "map explains" } else { "maps explain" })]
    NoSuchRank { asked: u32, found: usize },
    #[error(
        "the replay disagrees with the search: {0}\nhelp: this is a bug in hssh; please report it with the exploration"
    )]
    Disagreement(#[from] hssh::answer::DisagreementError),
    #[error(transparent)]
    Grid(#[from] hssh_local::MapError),
    #[error("the map of the building is too large for a grid: {0}")]
    TooLarge(#[from] hssh_local::LatticeError),
    #[error(
        "cannot serve the page on port {port} of this machine: {error}\nhelp: another program may use it: give another --port, or 0 for any that is free"
    )]
    Port { port: u16, error: std::io::Error },
    #[error("no scan came that can be used")]
    NothingCame,
    #[error("{}: {error}", file.display())]
    Survey { file: PathBuf, error: Box<hssh_local::SurveyError> },
    #[error("the track is no pose graph: {0}")]
    TrackGraph(#[from] hssh_metrics::GraphError),
    #[error("{} proves nothing: {refusal}", file.display())]
    Refused { file: PathBuf, refusal: hssh_verify::Refusal },
    #[error("nothing is proved, so that there is no certificate: see the verdict above")]
    NothingProved,
    #[error("{0}")]
    Usage(String),
    #[error("cannot print: {0}")]
    Print(#[from] std::io::Error),
}

/// What to do instead, on a line of its own.
fn help(error: &PipelineError) -> &'static str {
    match error {
        PipelineError::Search(SearchFailure::Mapper(_)) => {
            "\nhelp: --search breadth-first goes by topology alone"
        }
        PipelineError::NoAccount { stop } if stop.is_complete() => {
            "\nhelp: a higher limit in the options' readings.model allows more errors in one travel"
        }
        PipelineError::NoAccount { .. } => "\nhelp: give the search more time, memory or hypotheses",
        PipelineError::Elsewhere(_) => {
            "\nhelp: with --checkpoint FILE the same command goes on from what was counted, by any number of processes"
        }
        PipelineError::ClosedOfAll => "\nhelp: --closed goes with --search posterior, best-first and proof",
        PipelineError::GenusOfPosterior => "\nhelp: --planar and --max-genus bound it in every search",
        _ => "",
    }
}

/// The name of the input, if it is another one.
fn also_named(file: &Path, input: &Path) -> String {
    if file == input { String::new() } else { format!(" under another name ({})", input.display()) }
}

impl From<FileError> for Failure {
    fn from(error: FileError) -> Self {
        Failure::File(Box::new(error))
    }
}

impl From<PageError> for Failure {
    fn from(error: PageError) -> Self {
        match error {
            PageError::Pipeline(error) => error.into(),
            PageError::Picture(error) => error.into(),
        }
    }
}

impl From<PipelineError> for Failure {
    fn from(error: PipelineError) -> Self {
        Failure::Pipeline(Box::new(error))
    }
}

impl Failure {
    /// The same, with the file if it is about a checkpoint.
    pub(crate) fn of_checkpoint(self, files: Option<&[PathBuf; 2]>) -> Self {
        match (self, files) {
            (Failure::Pipeline(error), Some([file, readings])) => match *error {
                PipelineError::Search(SearchFailure::Checkpoint(error)) => {
                    Failure::Checkpoint { file: file.clone(), error }
                }
                PipelineError::Search(SearchFailure::ReadingCheckpoint(error)) => {
                    Failure::Checkpoint { file: readings.clone(), error }
                }
                error => error.into(),
            },
            (failure, _) => failure,
        }
    }

    /// Says what went wrong on standard error. Nobody reads on where a pipe was closed.
    pub(crate) fn print(&self) {
        let prefix = if self.is_rendered() { "" } else { "error: " };
        let text = self.to_string();
        if !self.is_broken_pipe() {
            say(&format!("{prefix}{}", text.trim_end()));
        }
    }

    pub(crate) fn exit_code(&self) -> ExitCode {
        match self {
            _ if self.is_broken_pipe() => ExitCode::SUCCESS,
            Failure::Refused { .. } => ExitCode::from(1),
            _ => ExitCode::from(2),
        }
    }

    /// Whether it begins with the word `error` itself.
    fn is_rendered(&self) -> bool {
        matches!(self, Failure::File(error) if matches!(**error, FileError::Exploration { .. }))
    }

    fn is_broken_pipe(&self) -> bool {
        matches!(self, Failure::Print(error) if error.kind() == std::io::ErrorKind::BrokenPipe)
    }
}
