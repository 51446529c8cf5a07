//! Time that this process takes.

use std::time::Instant;

use cpu_time::ProcessTime;

/// Most runs of one median.
const MAX_RUNS: f64 = 5.0;
/// Most runs of one median where a run is short.
const MAX_SHORT_RUNS: f64 = 101.0;
/// Processor time below which a run is short, \[s].
const SHORT_RUN: f64 = 2e-3;
/// Processor time that all runs of one median may take, \[s].
const MAX_TOTAL: f64 = 3.0;

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

/// The median cost of several runs of `work`, of more the shorter they are; a failure of the first is not repeated.
/// Processor time decides, so that other work on the machine does not.
pub(crate) fn measure_median<T, E>(work: impl Fn() -> Result<T, E>) -> Result<(T, Cost), E> {
    let (value, first) = measure(&work);
    let value = value?;
    let seconds = first.processor_seconds.max(f64::MIN_POSITIVE);
    let most = match seconds {
        ..SHORT_RUN => MAX_SHORT_RUNS,
        _ => MAX_RUNS,
    };
    let mut costs = vec![first];
    while costs.len() as f64 + 1.0 <= most.min(MAX_TOTAL / seconds) {
        costs.push(measure(&work).1);
    }
    let middle = |part: fn(&Cost) -> f64| median(costs.iter().map(part).collect());
    let cost = Cost {
        seconds: middle(|cost| cost.seconds),
        processor_seconds: middle(|cost| cost.processor_seconds),
    };
    Ok((value, cost))
}

/// The middle value, or the mean of the two in the middle, of at least one.
pub(crate) fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    let [low, high] = [(values.len() - 1) / 2, values.len() / 2];
    0.5 * (values[low] + values[high])
}
