//! When a search stops before its end, and how one looks in on it from outside.

use std::fmt;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::{Duration, Instant};

use serde::{Deserialize, Serialize};

/// Bounds on what a search may use. A bound on places is an axiom: see `Axioms::max_places`.
#[derive(Clone, Copy, PartialEq, Debug, Default)]
pub struct Limits {
    /// Nodes of the tree.
    pub nodes: Option<u64>,
    /// Time for one call.
    pub time: Option<Duration>,
    /// Bytes of the tree and of the queue. Successors that wait to be put into the tree, and the
    /// one map that each thread works on, come on top.
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
}

impl Monitor {
    /// Asks the search to stop soon, keeping what it knows.
    pub fn interrupt(&self) {
        self.stop.store(true, Ordering::Relaxed);
    }

    /// Takes back an interruption, so that the search can go on.
    pub fn reset(&self) {
        self.stop.store(false, Ordering::Relaxed);
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
    limits: Limits,
}

impl Watch {
    pub(crate) fn start(limits: Limits, monitor: &Arc<Monitor>) -> Self {
        let deadline = limits.time.and_then(|time| Instant::now().checked_add(time));
        Watch { monitor: Arc::clone(monitor), deadline, limits }
    }

    /// Whether to stop now, for a reason other than size.
    pub(crate) fn interruption(&self) -> Option<StopReason> {
        if self.monitor.stop.load(Ordering::Relaxed) {
            return Some(StopReason::Interrupted);
        }
        let late = self.deadline.is_some_and(|deadline| Instant::now() >= deadline);
        late.then_some(StopReason::TimeLimit)
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

    /// Whether that many nodes or bytes are too many.
    pub(crate) fn excess(&self, nodes: u64, bytes: u64) -> Option<StopReason> {
        if self.limits.nodes.is_some_and(|most| nodes > most) {
            return Some(StopReason::NodeLimit);
        }
        self.limits.bytes.is_some_and(|most| bytes > most).then_some(StopReason::MemoryLimit)
    }

    pub(crate) fn add_nodes(&self, nodes: u64) {
        self.monitor.nodes.fetch_add(nodes, Ordering::Relaxed);
    }

    pub(crate) fn explained(&self, travels: usize) {
        self.monitor.travels.fetch_max(travels as u64, Ordering::Relaxed);
    }
}
