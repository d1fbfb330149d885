//! Exhaustive counting over processes.

use std::collections::VecDeque;
use std::sync::Arc;
use std::sync::mpsc::{self, Receiver, RecvTimeoutError, Sender};
use std::time::Duration;

use hssh_causal::Exploration;
use hssh_search::{BranchCounter, CountedBranch, MapperBuilder, Monitor, Report, SharedCount, StopReason};
use timely::dataflow::channels::pact::Exchange;
use timely::dataflow::operators::generic::operator::Operator;
use timely::dataflow::operators::{ConnectLoop, Feedback};
use timely::worker::Worker;

use crate::connect::connect;
use crate::error::ClusterError;
use crate::hosts::Hosts;
use crate::loss::{is_lost, notice_losses};
use crate::run::run;

/// For so long a branch is counted before its state goes back.
const TURN: Duration = Duration::from_millis(50);

/// So many branches wait at each process, so that none waits for the first one.
const AHEAD: usize = 8;

/// So often it is looked whether it is over.
const LOOK: Duration = Duration::from_millis(20);

/// For so long the last checkpoint may take after a process was lost.
const LAST_WORDS: Duration = Duration::from_secs(600);

/// What a process says to the first one: who it is, and the branch that it counted on; nothing if that was no branch there.
type Message = (usize, Option<CountedBranch>);

/// How the part of a process ended.
type End = Result<Option<Report>, ClusterError>;

/// Takes part in the count that `options` ask for: the first process gets the report, the others nothing. Limits, checkpoints and the monitor of the first
/// process count.
///
/// # Errors
/// If the count cannot begin, the processes cannot be connected, or one is lost; then there is a checkpoint of what was counted until then, if one was asked for,
/// and threads of the search may be left that wait for the lost process: the program is to end.
pub fn count(
    options: MapperBuilder,
    exploration: &Exploration,
    hosts: &Hosts,
    monitor: &Arc<Monitor>,
) -> End {
    notice_losses();
    let counter = BranchCounter::new(&options, exploration)?;
    let shared = match hosts.process() {
        0 => Some(SharedCount::new(options, exploration)?),
        _ => None,
    };
    let (ended, end) = mpsc::channel();
    let connections = connect(hosts, counter.identity(), monitor)?;
    let running = run(hosts, connections, |worker| take_part(worker, counter, shared, ended))?;
    loop {
        match end.recv_timeout(LOOK) {
            Ok(end) => {
                if end.is_ok() {
                    // Nobody leaves before all have heard the end.
                    let _ = running.join();
                }
                return end;
            }
            Err(RecvTimeoutError::Timeout) if is_lost() => return last_words(&end, hosts),
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => {
                return Err(match running.join() {
                    Ok(Err(problem)) => ClusterError::Connect(problem),
                    _ => ClusterError::Lost,
                });
            }
        }
    }
}

/// A process was lost: the first one writes a checkpoint.
fn last_words(end: &Receiver<End>, hosts: &Hosts) -> End {
    if hosts.process() == 0
        && let Ok(end) = end.recv_timeout(LAST_WORDS)
    {
        return end;
    }
    Err(ClusterError::Lost)
}

/// Gives out branches, if this is the first process, and counts.
fn take_part(
    worker: &mut Worker,
    mut counter: BranchCounter,
    shared: Option<SharedCount>,
    ended: Sender<End>,
) {
    let (index, processes) = (worker.index(), worker.peers());
    let is_first = shared.is_some();
    let mut coordinator = shared.map(|count| Coordinator::new(count, processes, ended.clone()));
    worker.dataflow::<u64, _, _>(|scope| {
        let (back, messages) = scope.feedback::<Vec<Message>>(1);
        let branches = messages.unary(Exchange::new(|_: &Message| 0), "give out", |capability, info| {
            let activator = scope.activator_for(info.address);
            let mut capability = is_first.then_some(capability);
            move |input, output| {
                let Some(coordinator) = &mut coordinator else { return };
                input.for_each(|_, messages| {
                    messages.drain(..).for_each(|message| coordinator.hear(message));
                });
                let Some(now) = &capability else { return };
                let mut session = output.session(now);
                if coordinator.give(|to, branch| session.give((to, branch))) {
                    activator.activate_after(LOOK);
                } else {
                    drop(session);
                    capability = None;
                }
            }
        });
        let answers = branches.unary(
            Exchange::new(|(to, _): &(usize, CountedBranch)| *to as u64),
            "count",
            |capability, info| {
                let activator = scope.activator_for(info.address);
                drop(capability);
                let mut waiting = VecDeque::new();
                move |input, output| {
                    input.for_each(|now, branches| {
                        if let Some(now) = now.retain_least(output.output_index()) {
                            waiting.extend(branches.drain(..).map(|(_, branch)| (now.clone(), branch)));
                        }
                    });
                    if let Some((now, branch)) = waiting.pop_front() {
                        output.session(&now).give((index, counter.count_on(&branch, TURN)));
                    }
                    if !waiting.is_empty() {
                        activator.activate();
                    }
                }
            },
        );
        answers.connect_loop(back);
    });
    while worker.has_dataflows() {
        worker.step_or_park(Some(LOOK));
    }
    if !is_first {
        let _ = ended.send(Ok(None));
    }
}

/// What the first process knows of all.
struct Coordinator {
    /// Nothing after the end.
    count: Option<SharedCount>,
    /// By process: how many branches it has.
    waiting: Vec<usize>,
    stop: Option<StopReason>,
    ended: Sender<End>,
}

impl Coordinator {
    fn new(count: SharedCount, processes: usize, ended: Sender<End>) -> Self {
        Coordinator { count: Some(count), waiting: vec![0; processes], stop: None, ended }
    }

    /// Takes back what a process counted.
    fn hear(&mut self, (from, branch): Message) {
        let Some(count) = &mut self.count else { return };
        match branch {
            Some(branch) => {
                count.take_back(branch);
                self.waiting[from] = self.waiting[from].saturating_sub(1);
            }
            None => self.end(Err(ClusterError::Foreign(from))),
        }
    }

    /// Gives branches to all, in turn; whether it goes on.
    fn give(&mut self, mut give: impl FnMut(usize, CountedBranch)) -> bool {
        let Some(count) = &mut self.count else { return false };
        if is_lost() {
            count.keep();
            self.end(Err(ClusterError::Lost));
            return false;
        }
        self.stop = self.stop.or_else(|| count.look());
        match self.stop {
            Some(_) if count.is_given_out() => {}
            Some(stop) => {
                if let Some(count) = self.count.take() {
                    self.end(Ok(Some(count.end(stop))));
                }
                return false;
            }
            None => {
                for most in 1..=AHEAD {
                    for (process, waiting) in self.waiting.iter_mut().enumerate() {
                        if *waiting >= most {
                            continue;
                        }
                        let Some(branch) = count.give() else { return true };
                        *waiting += 1;
                        give(process, branch);
                    }
                }
            }
        }
        true
    }

    /// Says how it ended.
    fn end(&mut self, end: End) {
        self.count = None;
        let _ = self.ended.send(end);
    }
}
