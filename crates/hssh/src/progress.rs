//! The progress line of long searches, and what stops long work: Ctrl-C, and the signals of those who end programs.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, LazyLock};
use std::thread::Thread;
use std::time::Duration;

use hssh::pipeline::Monitor;
use indicatif::{HumanCount, ProgressBar, ProgressStyle};

/// A search that takes less than this shows no progress.
const PATIENCE: Duration = Duration::from_millis(700);

/// Whether somebody wants the program to stop with what it has.
static ASKED: AtomicBool = AtomicBool::new(false);

/// The monitor of the one search of this program.
static MONITOR: LazyLock<Arc<Monitor>> = LazyLock::new(Arc::default);

/// From here on, Ctrl-C and the signals that ask programs to end (SIGTERM, SIGHUP) do not end the program but
/// [interrupt](is_interrupted) its work, which keeps what it has; the second one ends it at once.
pub(crate) fn keep_on_signals() {
    static KEPT: AtomicBool = AtomicBool::new(false);
    if KEPT.swap(true, Ordering::Relaxed) {
        return;
    }
    let handler = ctrlc::set_handler(|| {
        if ASKED.swap(true, Ordering::Relaxed) {
            std::process::exit(130);
        }
        MONITOR.interrupt();
    });
    if let Err(error) = handler {
        tracing::warn!("Ctrl-C will end the program without a result: {error}");
    }
}

/// Whether the work at hand is to stop, with what it has.
pub(crate) fn is_interrupted() -> bool {
    ASKED.load(Ordering::Relaxed)
}

/// The monitor of the one search of this program.
#[cfg(feature = "cluster")]
pub(crate) fn monitor() -> Arc<Monitor> {
    Arc::clone(&MONITOR)
}

/// Takes an interruption as heard: the work that follows is not to stop, and another signal interrupts that.
pub(crate) fn hear_interruption() {
    ASKED.store(false, Ordering::Relaxed);
    MONITOR.reset();
}

/// Runs `search` with a monitor that signals interrupt, and that knows what the program takes. On a terminal, a line on standard error says how far the search
/// is.
pub(crate) fn watched<T>(travels: usize, search: impl FnOnce(&Arc<Monitor>) -> T) -> T {
    keep_on_signals();
    let monitor = Arc::clone(&MONITOR);
    monitor.watch_memory(|| memory_stats::memory_stats().map(|stats| stats.physical_mem as u64));
    let done = AtomicBool::new(false);
    std::thread::scope(|scope| {
        let line = scope.spawn(|| show(&monitor, travels, &done));
        let _ending = Ending { done: &done, line: line.thread().clone() };
        search(&monitor)
    })
}

/// Ends the progress line when the search is over, however it ends.
struct Ending<'a> {
    done: &'a AtomicBool,
    line: Thread,
}

impl Drop for Ending<'_> {
    fn drop(&mut self) {
        self.done.store(true, Ordering::Relaxed);
        self.line.unpark();
    }
}

/// Shows how far the search is until it is done.
fn show(monitor: &Monitor, travels: usize, done: &AtomicBool) {
    std::thread::park_timeout(PATIENCE);
    if done.load(Ordering::Relaxed) {
        return;
    }
    let bar = ProgressBar::new(travels as u64);
    if let Ok(style) =
        ProgressStyle::with_template("{spinner} travel {pos} of {len}  {msg}  {elapsed}  (Ctrl-C stops)")
    {
        bar.set_style(style);
    }
    while !done.load(Ordering::Relaxed) {
        bar.set_position(monitor.travels());
        bar.set_message(format!("{} hypotheses", HumanCount(monitor.nodes())));
        bar.tick();
        std::thread::park_timeout(Duration::from_millis(100));
    }
    bar.finish_and_clear();
}
