//! Processes that are lost: timely's threads that talk to them panic, and nothing else tells.

use std::panic;
use std::sync::Once;
use std::sync::atomic::{AtomicBool, Ordering};

/// What those panics begin with; timely promises to keep it.
const WORDS: &str = "timely communication error:";

/// Threads whose further panics say nothing new.
const THREADS: &str = "timely:";

static LOST: AtomicBool = AtomicBool::new(false);

/// Whether a process is lost.
pub(crate) fn is_lost() -> bool {
    LOST.load(Ordering::Relaxed)
}

/// Somebody knows from elsewhere that a process is lost.
pub fn report_loss() {
    LOST.store(true, Ordering::Relaxed);
}

/// From here on the loss of a process is noticed, and is no panic that is printed.
pub(crate) fn notice_losses() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        let others = panic::take_hook();
        panic::set_hook(Box::new(move |information| {
            if information.payload_as_str().is_some_and(|words| words.contains(WORDS)) {
                report_loss();
            }
            let is_timely = std::thread::current().name().is_some_and(|name| name.starts_with(THREADS));
            if !(is_lost() && is_timely) {
                others(information);
            }
        }));
    });
}
