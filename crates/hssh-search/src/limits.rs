//! When a search stops before its end, and how one looks in on it from outside.

use std::fmt;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Mutex, OnceLock, PoisonError};
use std::time::{Duration, Instant};

use serde::{Deserialize, Serialize};

/// Bounds on what a search may use. A bound on places is an axiom: see `Axioms::max_places`.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Limits {
    /// Nodes of the tree.
    pub nodes: Option<u64>,
    /// Time for one call.
    pub time: Option<Duration>,
    /// Bytes that the process takes, if the monitor [knows](Monitor::watch_memory); else those of the tree and of what waits to be
    /// searched, to which successors that wait to be put into the tree and the one map that each thread works on come on top.
    pub bytes: Option<u64>,
}

/// Why a search stopped.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum StopReason {
    /// It has not begun: there are observations that it has not looked at.
    NotSearched,
    /// The whole tree was searched.
    Exhausted,
    /// Best-first reached a map that explains everything.
    Found,
    /// Best-first proved that no other map is better.
    Proved,
    /// The limit on nodes.
    NodeLimit,
    /// The limit on time.
    TimeLimit,
    /// The limit on memory.
    MemoryLimit,
    /// Somebody asked it to stop.
    Interrupted,
}

impl StopReason {
    /// Whether the search came to its own end: no limit and no interruption cut it short.
    #[must_use]
    pub fn is_complete(self) -> bool {
        matches!(self, StopReason::Exhausted | StopReason::Found | StopReason::Proved)
    }
}

impl fmt::Display for StopReason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            StopReason::NotSearched => "not searched yet",
            StopReason::Exhausted => "searched everything",
            StopReason::Found => "found a map",
            StopReason::Proved => "proved the best map",
            StopReason::NodeLimit => "stopped by the node limit",
            StopReason::TimeLimit => "stopped by the time limit",
            StopReason::MemoryLimit => "stopped by the memory limit",
            StopReason::Interrupted => "interrupted",
        })
    }
}

/// A window on a running search, to be shared between threads: how far it is, and a way to stop it.
#[derive(Debug, Default)]
pub struct Monitor {
    stop: AtomicBool,
    nodes: AtomicU64,
    travels: AtomicU64,
    /// What tells how many bytes the process takes.
    memory: OnceLock<fn() -> Option<u64>>,
    /// When it was asked last, and what it said.
    taken: Mutex<Option<(Instant, u64)>>,
}

/// How much time is between two looks at the memory of the process: a look costs a few microseconds.
const MEMORY_LOOK: Duration = Duration::from_millis(5);

/// A search stops when the process takes this part of what it may: the rest is for what waits to be put into the tree, for the answer and
/// for a checkpoint.
const FOR_SEARCH: f64 = 0.95;

impl Monitor {
    /// Asks the search to stop soon, keeping what it knows.
    pub fn interrupt(&self) {
        self.stop.store(true, Ordering::Relaxed);
    }

    /// Takes back an interruption, so that the search can go on.
    pub fn reset(&self) {
        self.stop.store(false, Ordering::Relaxed);
    }

    /// Whether somebody asked the search to stop.
    #[must_use]
    pub fn is_interrupted(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }

    /// The search goes on from a checkpoint with so many nodes.
    pub(crate) fn goes_on(&self, nodes: u64, travels: usize) {
        self.nodes.store(nodes, Ordering::Relaxed);
        self.travels.store(travels as u64, Ordering::Relaxed);
    }

    /// From now on, limits on bytes are on those that the process takes, which `bytes` tells. That is for programs that do nothing
    /// else; a search in a larger one has its limit on what itself keeps.
    pub fn watch_memory(&self, bytes: fn() -> Option<u64>) {
        let _ = self.memory.set(bytes);
    }

    /// How many bytes the process takes, if that is known.
    fn taken(&self) -> Option<u64> {
        let ask = self.memory.get()?;
        let mut taken = self.taken.lock().unwrap_or_else(PoisonError::into_inner);
        if taken.is_none_or(|(asked, _)| asked.elapsed() >= MEMORY_LOOK) {
            *taken = ask().map(|bytes| (Instant::now(), bytes));
        }
        taken.map(|(_, bytes)| bytes)
    }

    /// Nodes made so far.
    #[must_use]
    pub fn nodes(&self) -> u64 {
        self.nodes.load(Ordering::Relaxed)
    }

    /// Travels explained so far.
    #[must_use]
    pub fn travels(&self) -> u64 {
        self.travels.load(Ordering::Relaxed)
    }
}

/// The limits of one running search.
#[derive(Clone, Debug)]
pub(crate) struct Watch {
    monitor: Arc<Monitor>,
    deadline: Option<Instant>,
    /// When the search stands still for a moment, whatever the limits: it goes on afterwards.
    pause: Option<Instant>,
    limits: Limits,
}

impl Watch {
    pub(crate) fn start(limits: Limits, monitor: &Arc<Monitor>) -> Self {
        let deadline = limits.time.and_then(|time| Instant::now().checked_add(time));
        Watch { monitor: Arc::clone(monitor), deadline, pause: None, limits }
    }

    /// Whether to stop now, for a reason other than size.
    pub(crate) fn interruption(&self) -> Option<StopReason> {
        if self.monitor.stop.load(Ordering::Relaxed) {
            return Some(StopReason::Interrupted);
        }
        let first = self.deadline.into_iter().chain(self.pause).min();
        first.is_some_and(|first| Instant::now() >= first).then_some(StopReason::TimeLimit)
    }

    /// Stops the search soon.
    pub(crate) fn interrupt(&self) {
        self.monitor.interrupt();
    }

    /// The same, but the search stops at that moment as if its time were over, if it is not over before.
    pub(crate) fn pausing(&self, pause: Option<Instant>) -> Self {
        Watch { pause, ..self.clone() }
    }

    /// Whether a search that stopped for that reason stands still for a moment only.
    pub(crate) fn is_pause(&self, stop: StopReason) -> bool {
        let comes_first = |pause: Instant| self.deadline.is_none_or(|deadline| pause < deadline);
        stop == StopReason::TimeLimit && self.pause.is_some_and(comes_first)
    }

    /// No limits at all.
    pub(crate) fn without_limits() -> Self {
        Watch::start(Limits::default(), &Arc::default())
    }

    /// How much time there was, if that is limited.
    pub(crate) fn time(&self) -> Option<Duration> {
        self.limits.time
    }

    /// The same, but over so much sooner, if time is limited.
    pub(crate) fn sooner(&self, reserve: Duration) -> Self {
        let deadline = self.deadline.and_then(|deadline| deadline.checked_sub(reserve));
        Watch { deadline: deadline.or(self.deadline), ..self.clone() }
    }

    /// The limits of a search that keeps its tree, which can number half of 2^32 nodes and what one
    /// round of expansions adds.
    pub(crate) fn for_tree(limits: Limits, monitor: &Arc<Monitor>) -> Self {
        let most = limits.nodes.unwrap_or(u64::MAX).min(1 << 31);
        Watch::start(Limits { nodes: Some(most), ..limits }, monitor)
    }

    /// Whether there is a limit on nodes.
    pub(crate) fn limits_nodes(&self) -> bool {
        self.limits.nodes.is_some()
    }

    /// Which part of what it may the process takes; nothing if that is not limited, or not known.
    pub(crate) fn taken(&self) -> Option<f64> {
        Some(self.monitor.taken()? as f64 / self.limits.bytes? as f64)
    }

    /// Whether that many nodes or bytes are too many.
    pub(crate) fn excess(&self, nodes: u64, bytes: u64) -> Option<StopReason> {
        if self.limits.nodes.is_some_and(|most| nodes > most) {
            return Some(StopReason::NodeLimit);
        }
        let most = self.limits.bytes?;
        let is_too_much = match self.monitor.taken() {
            Some(taken) => taken as f64 > FOR_SEARCH * most as f64,
            None => bytes > most,
        };
        is_too_much.then_some(StopReason::MemoryLimit)
    }

    pub(crate) fn add_nodes(&self, nodes: u64) {
        self.monitor.nodes.fetch_add(nodes, Ordering::Relaxed);
    }

    pub(crate) fn explained(&self, travels: usize) {
        self.monitor.travels.fetch_max(travels as u64, Ordering::Relaxed);
    }
}
