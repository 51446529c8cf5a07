//! Time that this process takes.

use std::time::Instant;

use cpu_time::ProcessTime;

/// Most runs of one median, and most of what is too short for a single look at the clock.
const REPEATS: f64 = 5.0;
const SHORT_REPEATS: f64 = 101.0;
/// Processor time of a short run \[s].
const SHORT: f64 = 2e-3;
/// Processor time that the repeats of one run may take together \[s].
const REPEATED: f64 = 3.0;

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
    let most = if seconds < SHORT {
        SHORT_REPEATS
    } else {
        REPEATS
    };
    let mut costs = vec![first];
    while costs.len() as f64 + 1.0 <= most.min(REPEATED / seconds) {
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
