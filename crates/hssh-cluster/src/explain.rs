//! Searches that keep their tree, over processes: the first one searches, and the others take turns of hypotheses for it.

use std::fmt;
use std::sync::mpsc::{self, Receiver, RecvTimeoutError, Sender};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread::{self, JoinHandle};
use std::time::Duration;

use hssh_causal::Exploration;
use hssh_search::{Expander, Helpers, Mapper, MapperBuilder, Monitor};
use timely::dataflow::channels::pact::Exchange;
use timely::dataflow::operators::generic::operator::Operator;
use timely::dataflow::operators::{ConnectLoop, Feedback};
use timely::scheduling::SyncActivator;
use timely::worker::Worker;

use crate::connect::connect;
use crate::error::ClusterError;
use crate::hosts::Hosts;
use crate::loss::{is_lost, notice_losses};
use crate::run::run;

/// So often it is looked whether a process was lost.
const LOOK: Duration = Duration::from_millis(20);

/// Whom a request is for, and the request.
type Request = (usize, Vec<u8>);

/// Who answers, and the answer; nothing if the request was none of its search.
type Answer = (usize, Option<Vec<u8>>);

/// Takes part in the search that `options` ask for: the first process gets the mapper, the others nothing. Limits, checkpoints, threads and the monitor of
/// the first process count; each of the others takes its turns on one thread.
///
/// # Errors
/// If the search cannot begin, the processes cannot be connected, or one is lost; then there is a checkpoint, if one was asked for, and threads may be
/// left that wait for the lost process: the program is to end.
pub fn explain(
    options: MapperBuilder,
    exploration: &Exploration,
    hosts: &Hosts,
    monitor: &Arc<Monitor>,
) -> Result<Option<Mapper>, ClusterError> {
    if hosts.addresses().len() == 1 {
        return Ok(Some(options.explain(exploration)?));
    }
    notice_losses();
    if hosts.process() > 0 {
        let expander = Expander::new(options, exploration)?;
        let connections = connect(hosts, expander.identity(), monitor)?;
        let running = run(hosts, connections, |worker| take_part(worker, None, Some(expander)))?;
        return joined(running).map(|()| None);
    }
    let connections = connect(hosts, options.identity(exploration), monitor)?;
    let (asks, requests) = mpsc::channel();
    let (told, answers) = mpsc::channel();
    let (awake, wake) = mpsc::channel();
    let desk = Desk { requests, answers: told, awake };
    let running = run(hosts, connections, |worker| take_part(worker, Some(desk), None))?;
    let wake: SyncActivator = wake.recv().map_err(|_| ClusterError::Lost)?;
    let others = Arc::new(Others {
        count: hosts.addresses().len() - 1,
        wake: Mutex::new(wake),
        line: Mutex::new(Some(Line { asks, answers })),
    });
    let explained = options.helpers(Arc::clone(&others) as Arc<dyn Helpers>).explain(exploration);
    if is_lost() || others.is_cut_off() {
        return Err(ClusterError::Lost);
    }
    others.dismiss();
    joined(running)?;
    Ok(Some(explained?))
}

/// Waits for the end of a part.
fn joined(running: JoinHandle<Result<(), String>>) -> Result<(), ClusterError> {
    while !running.is_finished() {
        if is_lost() {
            return Err(ClusterError::Lost);
        }
        thread::sleep(LOOK);
    }
    match running.join() {
        Ok(Ok(())) if !is_lost() => Ok(()),
        Ok(Err(problem)) => Err(ClusterError::Connect(problem)),
        _ => Err(ClusterError::Lost),
    }
}

/// The other processes, as the search sees them.
struct Others {
    count: usize,
    /// Wakes the thread that talks to them.
    wake: Mutex<SyncActivator>,
    /// Nothing if they are lost, or if nothing is left to be asked.
    line: Mutex<Option<Line>>,
}

struct Line {
    asks: Sender<Request>,
    answers: Receiver<Answer>,
}

impl Others {
    fn line(&self) -> MutexGuard<'_, Option<Line>> {
        self.line.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn wake(&self) {
        let wake = self.wake.lock().unwrap_or_else(PoisonError::into_inner);
        // Whoever does not hear it is gone, which others notice.
        let _ = wake.activate();
    }

    fn is_cut_off(&self) -> bool {
        self.line().is_none()
    }

    /// Nothing is left to be asked.
    fn dismiss(&self) {
        *self.line() = None;
        self.wake();
    }
}

impl Line {
    /// Sends requests, and waits for the answers.
    fn ask(
        &self,
        requests: Vec<Vec<u8>>,
        wake: impl FnOnce(),
        meanwhile: &mut dyn FnMut(),
    ) -> Option<Vec<Vec<u8>>> {
        let mut answers: Vec<Option<Vec<u8>>> = requests.iter().map(|_| None).collect();
        for (process, request) in (1..).zip(requests) {
            self.asks.send((process, request)).ok()?;
        }
        wake();
        meanwhile();
        for _ in 0..answers.len() {
            let (process, answer) = loop {
                match self.answers.recv_timeout(LOOK) {
                    Ok(answer) => break answer,
                    Err(RecvTimeoutError::Timeout) if !is_lost() => {}
                    Err(_) => return None,
                }
            };
            *answers.get_mut(process - 1)? = answer;
        }
        answers.into_iter().collect()
    }
}

impl fmt::Debug for Others {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Others").field("count", &self.count).finish_non_exhaustive()
    }
}

impl Helpers for Others {
    fn count(&self) -> usize {
        if self.is_cut_off() { 0 } else { self.count }
    }

    fn ask(&self, requests: Vec<Vec<u8>>, meanwhile: &mut dyn FnMut()) -> Option<Vec<Vec<u8>>> {
        let mut line = self.line();
        let answers = line.as_ref()?.ask(requests, || self.wake(), meanwhile);
        if answers.is_none() {
            *line = None;
        }
        answers
    }
}

/// Where the first process leaves requests and finds answers.
struct Desk {
    requests: Receiver<Request>,
    answers: Sender<Answer>,
    /// What wakes whoever sits there.
    awake: Sender<SyncActivator>,
}

/// Carries requests and answers, if this is the first process; answers, if it is another one.
fn take_part(worker: &mut Worker, mut desk: Option<Desk>, mut expander: Option<Expander>) {
    let index = worker.index();
    worker.dataflow::<u64, _, _>(|scope| {
        let (back, answers) = scope.feedback::<Vec<Answer>>(1);
        let requests = answers.unary(Exchange::new(|_: &Answer| 0), "ask", |capability, info| {
            if let Some(desk) = &desk {
                let _ = desk.awake.send(scope.worker().sync_activator_for(info.address.to_vec()));
            }
            let mut capability = desk.is_some().then_some(capability);
            move |input, output| {
                let Some(Desk { requests, answers, .. }) = &mut desk else { return };
                input.for_each(|_, heard| {
                    for answer in heard.drain(..) {
                        let _ = answers.send(answer);
                    }
                });
                let Some(now) = &capability else { return };
                let mut session = output.session(now);
                let is_over = loop {
                    match requests.try_recv() {
                        Ok(request) => session.give(request),
                        Err(end) => break end == mpsc::TryRecvError::Disconnected,
                    }
                };
                drop(session);
                if is_over {
                    capability = None;
                }
            }
        });
        let answers =
            requests.unary(Exchange::new(|(process, _): &Request| *process as u64), "answer", |_, _| {
                move |input, output| {
                    input.for_each(|now, requests| {
                        let mut session = output.session(&now);
                        for (_, request) in requests.drain(..) {
                            let answer = expander.as_mut().and_then(|expander| expander.answer(&request));
                            session.give((index, answer));
                        }
                    });
                }
            });
        answers.connect_loop(back);
    });
    while worker.has_dataflows() {
        worker.step_or_park(Some(LOOK));
    }
}
