//! Time and memory of this process.

use std::hint::black_box;
use std::time::Instant;

use cpu_time::ProcessTime;

/// Most runs of one median.
const REPEATS: usize = 5;
/// Processor time that the repeats of one run for a median may take together \[s].
const REPEATED: f64 = 3.0;
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

/// The median cost of up to five runs of `work`, each repeated until it is long enough for the clock; long ones are
/// measured less often. Processor time decides, so that other work on the machine does not.
///
/// # Errors
/// That of the first run; a failure is not repeated.
pub(crate) fn measure_median<T, E>(work: impl Fn() -> Result<T, E>) -> Result<(T, Cost), E> {
    let (value, first) = measure(&work);
    let value = value?;
    let mut costs = Vec::new();
    let batch =
        (CLOCKED / first.processor_seconds.max(f64::MIN_POSITIVE)).clamp(1.0, LARGEST_BATCH);
    if batch <= 1.0 {
        costs.push(first);
    }
    while costs.is_empty()
        || costs.len() < REPEATS && (costs.len() + 1) as f64 * first.processor_seconds <= REPEATED
    {
        costs.push(mean_cost(&work, batch.ceil()));
    }
    let middle = |part: fn(&Cost) -> f64| median(costs.iter().map(part).collect());
    let cost = Cost {
        seconds: middle(|cost| cost.seconds),
        processor_seconds: middle(|cost| cost.processor_seconds),
    };
    Ok((value, cost))
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

/// The middle value, or the mean of the two in the middle, of at least one.
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

#[cfg(test)]
mod tests {
    use std::cell::Cell;

    use super::*;

    #[test]
    fn the_median_is_the_middle_value_or_the_mean_of_two() {
        for (values, expected) in [
            (vec![5.0], 5.0),
            (vec![3.0, 1.0, 100.0], 3.0),
            (vec![4.0, 1.0, 2.0, 100.0], 3.0),
        ] {
            let got = median(values.clone());
            assert!(
                (got - expected).abs() < 1e-15,
                "median of {values:?}: {got}"
            );
        }
    }

    #[test]
    fn a_failure_is_not_repeated() {
        let runs = Cell::new(0);
        let outcome = measure_median(|| {
            runs.set(runs.get() + 1);
            Err::<(), _>("refused")
        });
        assert_eq!(outcome.err(), Some("refused"), "the failure");
        assert_eq!(runs.get(), 1, "runs of what fails");
    }

    #[test]
    fn what_is_too_short_for_the_clock_is_repeated() {
        let runs = Cell::new(0_u32);
        let outcome: Result<_, ()> = measure_median(|| {
            runs.set(runs.get() + 1);
            Ok(runs.get())
        });
        let (value, cost) = outcome.expect("a cost");
        assert_eq!(value, 1, "the value of the first run");
        assert!(
            runs.get() > 100,
            "only {} runs of nothing, {cost:?}",
            runs.get()
        );
        assert!(cost.seconds > 0.0 && cost.seconds < CLOCKED, "{cost:?}");
    }
}
