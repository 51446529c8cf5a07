//! Detection of a standard output that was closed when the program began.
//!
//! Before `main` the standard library opens /dev/null in its place, so that output does not go into the file opened next.
//! Afterwards the two cases cannot be distinguished, and many programs start others with /dev/null as output.

use std::sync::atomic::{AtomicBool, Ordering};

/// True if the standard output was closed at the start.
static CLOSED: AtomicBool = AtomicBool::new(false);

/// Checks the file descriptor before the runtime of the standard library replaces it.
#[cfg(unix)]
#[ctor::ctor]
fn record_state() {
    use rustix::io::{Errno, fcntl_getfd};
    let is_closed = fcntl_getfd(rustix::stdio::stdout()) == Err(Errno::BADF);
    CLOSED.store(is_closed, Ordering::Relaxed);
}

/// True if the standard output was closed at the start.
pub(super) fn was_closed() -> bool {
    CLOSED.load(Ordering::Relaxed)
}
