//! Time and memory of this process.

use std::hint::black_box;
use std::time::{Duration, Instant};

use cpu_time::ProcessTime;

/// Repeats of what takes little time, and how much is little.
const REPEATS: usize = 5;
const SHORT: Duration = Duration::from_millis(500);
/// Repeats of what takes longer.
const FEW_REPEATS: usize = 3;
/// Shortest time that is read off the clock \[s], and most runs that share it.
const CLOCKED: f64 = 2e-3;
const LARGEST_BATCH: f64 = 1e4;

/// Time that a computation took, \[s].
#[derive(Debug, Clone, Copy)]
pub(crate) struct Cost {
    pub(crate) seconds: f64,
    /// Processor time of all threads; other work on the machine is not in it.
    pub(crate) processor_seconds: f64,
}

/// Runs `work` and measures it.
pub(crate) fn measure<T>(work: impl Fn() -> T) -> (T, Cost) {
    let (clock, processor) = (Instant::now(), ProcessTime::now());
    let value = work();
    let cost = Cost {
        seconds: clock.elapsed().as_secs_f64(),
        processor_seconds: processor.elapsed().as_secs_f64(),
    };
    (value, cost)
}

/// Runs `work`, several times if it is short, and returns the least cost.
pub(crate) fn measure_best<T>(work: impl Fn() -> T) -> (T, Cost) {
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

/// The median cost of several runs of `work`, each repeated until it is long enough for the clock.
pub(crate) fn measure_median<T>(work: impl Fn() -> T) -> (T, Cost) {
    let (value, first) = measure(&work);
    let batch = (CLOCKED / first.seconds.max(f64::MIN_POSITIVE)).clamp(1.0, LARGEST_BATCH);
    let mut costs = if batch > 1.0 { Vec::new() } else { vec![first] };
    let repeats = if first.seconds < SHORT.as_secs_f64() {
        REPEATS
    } else {
        FEW_REPEATS
    };
    while costs.len() < repeats {
        costs.push(mean_cost(&work, batch.ceil()));
    }
    let middle = |part: fn(&Cost) -> f64| median(costs.iter().map(part).collect());
    let cost = Cost {
        seconds: middle(|cost| cost.seconds),
        processor_seconds: middle(|cost| cost.processor_seconds),
    };
    (value, cost)
}

fn mean_cost<T>(work: impl Fn() -> T, batch: f64) -> Cost {
    let mut remaining = batch;
    let (clock, processor) = (Instant::now(), ProcessTime::now());
    while remaining > 0.0 {
        black_box(work());
        remaining -= 1.0;
    }
    Cost {
        seconds: clock.elapsed().as_secs_f64() / batch,
        processor_seconds: processor.elapsed().as_secs_f64() / batch,
    }
}

/// The middle value, or the mean of the two in the middle.
pub(crate) fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    let middle = values.len() / 2;
    if values.len() % 2 == 1 {
        values[middle]
    } else {
        0.5 * (values[middle - 1] + values[middle])
    }
}

/// Most memory that the process has had resident so far, \[MiB]; known on Linux only.
pub(crate) fn peak_memory() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status
        .lines()
        .find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kibibytes: f64 = line.trim().strip_suffix("kB")?.trim().parse().ok()?;
    Some(kibibytes / 1024.0)
}
