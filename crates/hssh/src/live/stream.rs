//! What one thread reads and another one follows: all that has come, and when.

use std::path::Path;
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use super::incoming::{Incoming, Source};
use crate::failure::Failure;

/// Others look again after so long, if nothing wakes them before.
const PATIENCE: Duration = Duration::from_millis(100);

/// A stream from a robot.
pub(crate) struct Stream {
    come: Mutex<Come>,
    changed: Condvar,
}

/// What has come.
struct Come {
    incoming: Incoming,
    /// When each scan came.
    arrivals: Vec<Instant>,
    ended: Option<Result<(), Failure>>,
}

/// What had come at one moment.
pub(crate) struct Snapshot {
    pub(crate) incoming: Incoming,
    /// When each scan came.
    pub(crate) arrivals: Vec<Instant>,
    /// Whether nothing more will come.
    pub(crate) is_last: bool,
}

impl Stream {
    pub(crate) fn new(incoming: Incoming) -> Self {
        let come = Come { incoming, arrivals: Vec::new(), ended: None };
        Stream { come: Mutex::new(come), changed: Condvar::new() }
    }

    fn lock(&self) -> MutexGuard<'_, Come> {
        self.come.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Reads a source to its end.
    pub(crate) fn read(&self, source: Source, file: &Path) {
        let read = source.read(file, |change| {
            let mut come = self.lock();
            let before = come.incoming.scans();
            change(&mut come.incoming);
            for _ in before..come.incoming.scans() {
                come.arrivals.push(Instant::now());
            }
            if come.incoming.scans() > before {
                self.changed.notify_all();
            }
        });
        self.lock().ended.get_or_insert(read);
        self.changed.notify_all();
    }

    /// Nothing more is waited for.
    pub(crate) fn cut_off(&self) {
        self.lock().ended.get_or_insert(Ok(()));
        self.changed.notify_all();
    }

    /// Whether it has ended.
    pub(crate) fn has_ended(&self) -> bool {
        self.lock().ended.is_some()
    }

    /// Waits until there are more scans than so many, or the end; gives up after a while.
    pub(crate) fn wait(&self, scans: usize) {
        let is_waiting = |come: &mut Come| come.arrivals.len() <= scans && come.ended.is_none();
        drop(self.changed.wait_timeout_while(self.lock(), PATIENCE, is_waiting));
    }

    /// What has come, if that is more scans than so many, or the end.
    pub(crate) fn snapshot(&self, scans: usize) -> Option<Snapshot> {
        let come = self.lock();
        let is_last = come.ended.is_some();
        (come.arrivals.len() > scans || is_last).then(|| Snapshot {
            incoming: come.incoming.clone(),
            arrivals: come.arrivals.clone(),
            is_last,
        })
    }

    /// What has come in the end, and whether reading failed before; to be asked once.
    pub(crate) fn end(&self) -> (Incoming, Result<(), Failure>) {
        let mut come = self.lock();
        let ended = come.ended.replace(Ok(())).unwrap_or(Ok(()));
        (come.incoming.clone(), ended)
    }
}
