//! Time that this process takes.

use std::time::Instant;

use cpu_time::ProcessTime;

/// Largest number of runs for one median. Chosen: it is odd, so that the median is one of them, and five survive
/// two disturbed runs.
const MAX_RUNS: f64 = 5.0;
/// Largest number of runs of one median where a run is shorter than [`SHORT_RUN`]. Chosen: the resolution of the clock and the
/// scheduler then disturb more runs.
const MAX_SHORT_RUNS: f64 = 101.0;
/// Processor time below which a run counts as short, \[s]. Chosen: the slices in which a scheduler hands out time are of
/// this order.
const SHORT_RUN: f64 = 2e-3;
/// Processor time that all runs of one median may take together, \[s]. Chosen, as a bound on the time of an experiment.
const MAX_TOTAL: f64 = 3.0;

/// Time that a computation took.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Cost {
    /// Time on the wall clock, \[s].
    pub(crate) seconds: f64,
    /// Processor time of all threads of this process, \[s]; other work on the machine is not in it.
    pub(crate) processor_seconds: f64,
}

/// Runs `work` once and measures its elapsed and its processor time.
pub(crate) fn measure<T>(work: impl Fn() -> T) -> (T, Cost) {
    let (clock, processor) = (Instant::now(), ProcessTime::now());
    let value = work();
    let cost = Cost {
        seconds: clock.elapsed().as_secs_f64(),
        processor_seconds: processor.elapsed().as_secs_f64(),
    };
    (value, cost)
}

/// Result of the first run of `work`, and the median cost of [`MAX_RUNS`] runs, of [`MAX_SHORT_RUNS`] short ones, or of as
/// many as fit into [`MAX_TOTAL`]. Processor time decides how many, so that other work on the machine does not. If the
/// first run fails, its error is returned without further runs.
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
