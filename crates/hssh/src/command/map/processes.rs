//! Searches spread over processes: those of this machine are started here, those on others by whoever has them.

use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use hssh::pipeline::{
    Input, Mapped, MappingOptions, Means, PipelineError, SearchFailure, SearchMethod, Searchers,
};
use hssh_causal::Exploration;
use hssh_cluster::{ClusterError, Hosts, HostsError, count, explain, report_loss};
use hssh_search::{Mapper, MapperBuilder, Report};

use super::search::searched;
use crate::arguments::MapArguments;
use crate::failure::Failure;
use crate::progress::monitor;
use crate::terminal::say;

/// So often it is looked whether a process is still there.
const LOOK: Duration = Duration::from_millis(50);

/// For so long a process may go on after the end before it is ended.
const PATIENCE: Duration = Duration::from_secs(5);

/// Whether this process only takes part: another one has the answer.
pub(super) fn is_helper(arguments: &MapArguments) -> bool {
    arguments.processes.process.is_some_and(|process| process > 0)
}

/// Whether several processes are asked for.
pub(crate) fn is_spread(arguments: &MapArguments) -> bool {
    arguments.processes.workers.is_some() || arguments.processes.hosts.is_some()
}

/// Searches, by the processes that were asked for.
pub(super) fn spread(
    arguments: &MapArguments,
    input: &Input,
    options: &MappingOptions,
    kept: Means<'_>,
) -> Result<Mapped, Failure> {
    let Some(processes) = Processes::of(arguments, options)? else {
        return searched(input, options, &kept);
    };
    searched(input, options, &Means { searchers: Some(&processes), ..kept })
}

/// The processes of a search.
struct Processes {
    hosts: Hosts,
    /// Those that were started here.
    started: Option<Started>,
}

/// Processes that were started here, and are watched.
struct Started {
    list: PathBuf,
    is_over: Arc<AtomicBool>,
    watch: Option<JoinHandle<()>>,
}

impl Processes {
    /// Those that are asked for, if any are.
    ///
    /// # Errors
    /// If the search cannot be spread, the addresses are none, or processes cannot be started.
    fn of(arguments: &MapArguments, options: &MappingOptions) -> Result<Option<Self>, Failure> {
        let asked = &arguments.processes;
        if !is_spread(arguments) {
            return Ok(None);
        }
        if matches!(options.search.method, Some(SearchMethod::BestFirst | SearchMethod::PosteriorBestFirst)) {
            let help = "best-first goes from one hypothesis to the next, which several processes cannot share: choose another --search, or leave out --workers and --hosts";
            return Err(Failure::Usage(help.to_owned()));
        }
        if options.readings.model.is_some() {
            let help = "a search that reckons with errors of perception is not spread over processes: leave out --readings, or --workers and --hosts";
            return Err(Failure::Usage(help.to_owned()));
        }
        if arguments.file == Path::new("-") {
            let help = "every process reads the exploration itself, which it cannot from standard input: give a file";
            return Err(Failure::Usage(help.to_owned()));
        }
        if let (Some(file), Some(process)) = (&asked.hosts, asked.process) {
            let text =
                fs::read_to_string(file).map_err(|error| Failure::Read { file: file.clone(), error })?;
            let hosts =
                Hosts::read(&text, process).map_err(|error| Failure::Hosts { file: file.clone(), error })?;
            return Ok(Some(Processes { hosts, started: None }));
        }
        let workers = asked.workers.unwrap_or(1) as usize;
        let here = |error| Failure::Hosts { file: PathBuf::from("--workers"), error };
        let hosts = Hosts::local(workers).map_err(here)?;
        let started = Started::start(&hosts).map_err(|error| here(HostsError::Ports(error)))?;
        Ok(Some(Processes { hosts, started: Some(started) }))
    }

    /// The search is over; in the words of the pipeline.
    fn ended<T>(&self, end: Result<T, ClusterError>) -> Result<T, PipelineError> {
        if let Some(started) = &self.started {
            started.is_over.store(true, Ordering::Relaxed);
        }
        end.map_err(|error| match error {
            ClusterError::Search(error) => SearchFailure::from(error).into(),
            error => PipelineError::Elsewhere(Box::new(error)),
        })
    }
}

impl Searchers for Processes {
    fn count(
        &self,
        search: MapperBuilder,
        exploration: &Exploration,
    ) -> Result<Option<Report>, PipelineError> {
        self.ended(count(search, exploration, &self.hosts, &monitor()))
    }

    /// Each process has one thread: more processes are what there is instead.
    fn explain(
        &self,
        search: MapperBuilder,
        exploration: &Exploration,
    ) -> Result<Option<Mapper>, PipelineError> {
        self.ended(explain(search.threads(1), exploration, &self.hosts, &monitor()))
    }
}

impl Started {
    /// Starts all but the first: the same command, with the addresses and a number for `--workers`.
    fn start(hosts: &Hosts) -> std::io::Result<Self> {
        let list = std::env::temp_dir().join(format!("hssh-hosts-{}", std::process::id()));
        fs::write(&list, hosts.addresses().join("\n"))?;
        let program = std::env::current_exe()?;
        let same = without_workers(std::env::args_os().skip(1));
        let mut children = Vec::new();
        for process in 1..hosts.addresses().len() {
            let mut command = Command::new(&program);
            command.args(&same).arg("--hosts").arg(&list).args(["--process", &process.to_string()]);
            command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
            children.push(command.spawn()?);
        }
        let is_over = Arc::new(AtomicBool::new(false));
        let over = Arc::clone(&is_over);
        let watch = Some(thread::spawn(move || watch(children, &over)));
        Ok(Started { list, is_over, watch })
    }
}

/// All processes end with this one, however it ends.
impl Drop for Started {
    fn drop(&mut self) {
        self.is_over.store(true, Ordering::Relaxed);
        if let Some(watch) = self.watch.take() {
            let _ = watch.join();
        }
        let _ = fs::remove_file(&self.list);
    }
}

/// Sees to it that the loss of a process is known, and that none is left after the end.
fn watch(mut children: Vec<Child>, is_over: &AtomicBool) {
    while !is_over.load(Ordering::Relaxed) {
        for (number, child) in children.iter_mut().enumerate() {
            if let Ok(Some(status)) = child.try_wait()
                && !is_over.load(Ordering::Relaxed)
                && !status.success()
            {
                say(&format!("process {} of the search ended: {status}", number + 1));
                report_loss();
                is_over.store(true, Ordering::Relaxed);
            }
        }
        thread::sleep(LOOK);
    }
    let end = Instant::now() + PATIENCE;
    for child in &mut children {
        while child.try_wait().is_ok_and(|status| status.is_none()) && Instant::now() < end {
            thread::sleep(LOOK);
        }
        let _ = child.kill();
        let _ = child.wait();
    }
}

/// The arguments but for `--workers`.
fn without_workers(arguments: impl Iterator<Item = OsString>) -> Vec<OsString> {
    let mut rest = Vec::new();
    let mut is_number = false;
    for argument in arguments {
        if std::mem::take(&mut is_number) {
            continue;
        }
        is_number = argument == "--workers";
        if !is_number && !argument.to_string_lossy().starts_with("--workers=") {
            rest.push(argument);
        }
    }
    rest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_same_command_is_without_its_processes() {
        let words = |text: &str| text.split(' ').map(OsString::from).collect::<Vec<_>>();
        let rest = words("map walk.ron --search count");
        assert_eq!(without_workers(words("map walk.ron --workers 4 --search count").into_iter()), rest);
        assert_eq!(without_workers(words("map walk.ron --workers=4 --search count").into_iter()), rest);
    }
}
