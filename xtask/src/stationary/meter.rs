//! Time and memory of this process.

use std::time::{Duration, Instant};

use cpu_time::ProcessTime;

/// Repeats of what takes little time, and how much is little.
const REPEATS: usize = 5;
const SHORT: Duration = Duration::from_millis(500);

/// Time that a computation took, \[s].
#[derive(Debug, Clone, Copy)]
pub(super) struct Cost {
    pub(super) seconds: f64,
    /// Processor time of all threads; other work on the machine is not in it.
    pub(super) processor_seconds: f64,
}

/// Runs `work` and measures it.
pub(super) fn measure<T>(work: impl Fn() -> T) -> (T, Cost) {
    let (clock, processor) = (Instant::now(), ProcessTime::now());
    let value = work();
    let cost = Cost {
        seconds: clock.elapsed().as_secs_f64(),
        processor_seconds: processor.elapsed().as_secs_f64(),
    };
    (value, cost)
}

/// Runs `work`, several times if it is short, and returns the least cost.
pub(super) fn measure_best<T>(work: impl Fn() -> T) -> (T, Cost) {
    let (mut value, mut best) = measure(&work);
    for _ in 1..REPEATS {
        if best.seconds > SHORT.as_secs_f64() {
            break;
        }
        let (again, cost) = measure(&work);
        value = again;
        best.seconds = best.seconds.min(cost.seconds);
        best.processor_seconds = best.processor_seconds.min(cost.processor_seconds);
    }
    (value, best)
}

/// Most memory that the process has had resident so far, \[MiB]; known on Linux only.
pub(super) fn peak_memory() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status
        .lines()
        .find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kibibytes: f64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(kibibytes / 1024.0)
}
