//! Whether the standard output was closed when the program began.
//!
//! Before `main` the standard library opens /dev/null in its place, so that what is printed does not go into the file that is
//! opened next. Behind it nothing tells the two from each other, and many programs that start others give them /dev/null.

use std::sync::atomic::{AtomicBool, Ordering};

static CLOSED: AtomicBool = AtomicBool::new(false);

/// Looks before the standard library does.
#[cfg(unix)]
#[ctor::ctor]
fn look() {
    use rustix::io::{Errno, fcntl_getfd};
    let is_closed = fcntl_getfd(rustix::stdio::stdout()) == Err(Errno::BADF);
    CLOSED.store(is_closed, Ordering::Relaxed);
}

pub(super) fn was_closed() -> bool {
    CLOSED.load(Ordering::Relaxed)
}
