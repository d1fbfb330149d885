//! Work without holding the interpreter: Ctrl-C stops it with what is known, and a panic becomes an exception. Work that asks now and
//! then whether to stop is done on the thread that wants it; a search is told, and runs in a thread of its own.

use std::any::Any;
use std::cell::Cell;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::thread::{Builder, scope};
use std::time::{Duration, Instant};

use hssh::pipeline::Monitor;
use hssh_local::Reply;
use pyo3::prelude::*;

use crate::errors::{Kind, error};

/// How often the interpreter is asked for signals.
const PATIENCE: Duration = Duration::from_millis(40);
/// The stack of the working thread, which is that of a main thread.
const STACK: usize = 8 << 20;

thread_local! {
    /// Who asks for signals while this thread works.
    static LOOKOUT: Cell<Option<Lookout>> = const { Cell::new(None) };
}

/// Whether somebody wants the work to stop.
#[derive(Debug, Default)]
pub(crate) struct Stop {
    asked: AtomicBool,
    /// The same for a search.
    pub(crate) monitor: Arc<Monitor>,
}

impl Stop {
    /// One that a search listens to that began earlier.
    pub(crate) fn of(monitor: Arc<Monitor>) -> Self {
        Stop { asked: AtomicBool::new(false), monitor }
    }

    fn ask(&self) {
        self.asked.store(true, Ordering::Relaxed);
        self.monitor.interrupt();
    }

    /// Whether to stop.
    pub(crate) fn is_asked(&self) -> bool {
        self.asked.load(Ordering::Relaxed)
    }

    /// What to tell work that asks as it goes.
    pub(crate) fn reply(&self) -> Reply {
        if self.is_asked() { Reply::Stop } else { Reply::GoOn }
    }
}

/// Asks the interpreter for signals while a thread works that does not hold it.
struct Lookout {
    /// When it last asked.
    asked: Instant,
    /// The exception that a signal raised.
    signal: Option<PyErr>,
}

impl Lookout {
    fn new() -> Self {
        Lookout { asked: Instant::now(), signal: None }
    }

    /// Whether there was a signal.
    fn sees_signal(&mut self) -> bool {
        if self.signal.is_none() && self.asked.elapsed() >= PATIENCE {
            self.signal = Python::attach(|py| py.check_signals()).err();
            self.asked = Instant::now();
        }
        self.signal.is_some()
    }
}

/// Whether a signal asks the [`attended`] work of this thread to stop.
pub(crate) fn is_interrupted() -> bool {
    // Handlers of signals may do such work themselves, with a lookout of their own.
    let Some(mut lookout) = LOOKOUT.take() else { return false };
    let is_interrupted = lookout.sees_signal();
    LOOKOUT.set(Some(lookout));
    is_interrupted
}

/// Does work on this thread that asks now and then whether it [`is_interrupted`].
pub(crate) fn attended<T: Send>(py: Python<'_>, work: impl FnOnce() -> T + Send) -> PyResult<Done<T>> {
    let around = LOOKOUT.replace(Some(Lookout::new()));
    let value = detached(py, work);
    let lookout = LOOKOUT.replace(around);
    Ok(Done { value: value?, stopped: lookout.and_then(|lookout| lookout.signal) })
}

/// Does work on this thread that soon is through.
pub(crate) fn detached<T: Send>(py: Python<'_>, work: impl FnOnce() -> T + Send) -> PyResult<T> {
    calmly(|| Ok(py.detach(work)))
}

/// What came of work.
pub(crate) struct Done<T> {
    pub(crate) value: T,
    /// Whether a signal of the interpreter stopped it before its end, with the exception that it raised.
    pub(crate) stopped: Option<PyErr>,
}

/// Does work in a thread of its own without holding the interpreter, which is asked for signals meanwhile.
pub(crate) fn watched<T: Send>(
    py: Python<'_>,
    stop: &Arc<Stop>,
    work: impl FnOnce(&Arc<Stop>) -> T + Send,
) -> PyResult<Done<T>> {
    py.detach(|| {
        scope(|scope| {
            let (sender, receiver) = channel();
            let begun =
                Builder::new().name("hssh".to_owned()).stack_size(STACK).spawn_scoped(scope, move || {
                    let _ = sender.send(catch_unwind(AssertUnwindSafe(|| work(stop))));
                });
            begun.map_err(|problem| error(Kind::Internal, format!("no thread can be started: {problem}")))?;
            let mut stopped = None;
            loop {
                match receiver.recv_timeout(PATIENCE) {
                    Ok(Ok(value)) => return Ok(Done { value, stopped }),
                    Ok(Err(panic)) => return Err(of_panic(panic.as_ref())),
                    Err(RecvTimeoutError::Disconnected) => return Err(of_panic(&"the work ended early")),
                    Err(RecvTimeoutError::Timeout) => {
                        if let Err(signal) = Python::attach(|py| py.check_signals()) {
                            stopped.get_or_insert(signal);
                            stop.ask();
                        }
                    }
                }
            }
        })
    })
}

/// Does work that has nothing to show before its end.
pub(crate) fn finished<T: Send>(py: Python<'_>, work: impl FnOnce(&Arc<Stop>) -> T + Send) -> PyResult<T> {
    let done = watched(py, &Arc::default(), work)?;
    done.stopped.map_or(Ok(done.value), Err)
}

/// Does short work; a panic becomes an exception.
pub(crate) fn calmly<T>(work: impl FnOnce() -> PyResult<T>) -> PyResult<T> {
    catch_unwind(AssertUnwindSafe(work)).unwrap_or_else(|panic| Err(of_panic(panic.as_ref())))
}

fn of_panic(panic: &(dyn Any + Send)) -> PyErr {
    let text = panic.downcast_ref::<&str>().map(|text| (*text).to_owned());
    let text = text.or_else(|| panic.downcast_ref::<String>().cloned()).unwrap_or_default();
    error(Kind::Internal, format!("{text}\nhelp: this is a bug in hssh; please report it with the input"))
}
