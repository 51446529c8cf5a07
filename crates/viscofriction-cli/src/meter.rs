//! Processor time of short pieces of work.

use std::hint::black_box;

use cpu_time::ProcessTime;

/// Most repeats for a median, and processor time that they may take together \[s].
const REPEATS: usize = 5;
const REPEATED: f64 = 3.0;
/// Shortest time that is read off the clock \[s], and most runs that share it.
const CLOCKED: f64 = 2e-3;
const LARGEST_BATCH: f64 = 1e4;

/// The value of `work` and the median processor time \[s] of up to five runs, each repeated until it is long enough for the
/// clock; long ones are measured less often. Other work on the machine is not in it.
///
/// # Errors
/// That of the first run; a failure is not repeated.
pub(crate) fn measure_median<T, E>(work: impl Fn() -> Result<T, E>) -> Result<(T, f64), E> {
    let start = ProcessTime::now();
    let value = work()?;
    let first = start.elapsed().as_secs_f64();
    let batch = (CLOCKED / first.max(f64::MIN_POSITIVE)).clamp(1.0, LARGEST_BATCH);
    let mut times = Vec::new();
    if batch <= 1.0 {
        times.push(first);
    }
    while times.is_empty() || times.len() < REPEATS && (times.len() + 1) as f64 * first <= REPEATED
    {
        times.push(mean_time(&work, batch.ceil()));
    }
    times.sort_by(f64::total_cmp);
    let middle = times.len() / 2;
    // Of an even number the mean of the two in the middle.
    Ok((value, 0.5 * (times[middle] + times[(times.len() - 1) / 2])))
}

fn mean_time<T>(work: impl Fn() -> T, batch: f64) -> f64 {
    let start = ProcessTime::now();
    let mut remaining = batch;
    while remaining > 0.0 {
        black_box(work());
        remaining -= 1.0;
    }
    start.elapsed().as_secs_f64() / batch
}

#[cfg(test)]
mod tests {
    use std::cell::Cell;

    use super::*;

    #[test]
    fn a_failure_is_not_repeated_and_what_is_too_short_for_the_clock_is() {
        let runs = Cell::new(0_u32);
        let count = |failure: bool| {
            runs.set(runs.get() + 1);
            if failure {
                Err("refused")
            } else {
                Ok(runs.get())
            }
        };
        assert_eq!(
            measure_median(|| count(true)),
            Err("refused"),
            "the failure"
        );
        assert_eq!(runs.replace(0), 1, "runs of what fails");
        let (value, time) = measure_median(|| count(false)).expect("a time");
        assert_eq!(value, 1, "the value of the first run");
        assert!(runs.get() > 100, "only {} runs of nothing", runs.get());
        assert!(time > 0.0 && time < CLOCKED, "{time} s");
    }
}
