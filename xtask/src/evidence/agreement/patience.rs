//! How long a scene may take.

use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use viscofriction::Watch;

/// A refinement is ended before the grid that begins later than this.
const PATIENCE: Duration = Duration::from_secs(10);

/// Ends a refinement that takes too long.
#[derive(Debug)]
pub(super) struct Patience {
    until: Instant,
    has_ended: AtomicBool,
}

impl Default for Patience {
    /// From now on.
    fn default() -> Self {
        Self {
            until: Instant::now() + PATIENCE,
            has_ended: AtomicBool::new(false),
        }
    }
}

impl Patience {
    /// Whether it has ended something.
    pub(super) fn has_ended(&self) -> bool {
        self.has_ended.load(Ordering::Relaxed)
    }
}

impl Watch for Patience {
    fn allows(&self, _: usize) -> bool {
        let is_early = Instant::now() < self.until;
        self.has_ended.fetch_or(!is_early, Ordering::Relaxed);
        is_early
    }

    fn done(&self, _: f64) {}
}
