//! Signals that end the process.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use crossguard_model_check::check::Stop;

/// Set when the process is told to stop, by SIGINT, SIGTERM or SIGHUP.
pub(super) fn interrupts() -> Arc<AtomicBool> {
    interrupts_that(|| ())
}

/// The same; `tell` is called when the process is told to stop.
pub(super) fn interrupts_that(tell: impl Fn() + Send + 'static) -> Arc<AtomicBool> {
    let interrupted = Arc::new(AtomicBool::new(false));
    let set = Arc::clone(&interrupted);
    // A second Ctrl-C should still end a process that does not stop by itself.
    let handler = move || {
        if set.swap(true, Ordering::Relaxed) {
            std::process::exit(130);
        }
        tell();
    };
    // It can only fail when there is a handler already, and there is none.
    let _ = ctrlc::set_handler(handler);
    interrupted
}

/// A request to give up, which is made when the process is told to stop.
pub(super) fn stop_when_told() -> Stop {
    let stop = Stop::default();
    let asked = stop.clone();
    let _ = interrupts_that(move || asked.request());
    stop
}
