//! Progress reports of a computation on finer and finer resolutions, and the permission to refine further.

use std::fmt;

/// Receiver of the progress of a computation, which may also stop its refinement.
pub trait Progress: fmt::Debug + Sync {
    /// Whether a resolution with this number of elements may be begun, if the coarser ones miss the requested error.
    fn may_refine(&self, elements: usize) -> bool;

    /// Reports the completed fraction of the expected work, from 0 to 1. It decreases when more work turns out to be needed.
    fn report(&self, fraction: f64);
}

/// Progress that is not reported and allows every resolution.
#[derive(Debug)]
pub struct SilentProgress;

impl Progress for SilentProgress {
    fn may_refine(&self, _: usize) -> bool {
        true
    }

    fn report(&self, _: f64) {}
}

/// Progress that is not reported and allows resolutions of at most this number of elements.
#[derive(Debug, Clone, Copy)]
pub struct MaxElements(pub usize);

impl Progress for MaxElements {
    fn may_refine(&self, elements: usize) -> bool {
        elements <= self.0
    }

    fn report(&self, _: f64) {}
}

/// Progress that is passed on to `watch`, with an upper limit on the number of elements.
#[derive(Debug, Clone, Copy)]
pub struct CappedProgress<'a> {
    /// Receiver of all reports, which may stop the refinement earlier.
    pub watch: &'a dyn Progress,
    /// Largest number of elements of a resolution that may be begun.
    pub max_elements: usize,
}

impl Progress for CappedProgress<'_> {
    fn may_refine(&self, elements: usize) -> bool {
        elements <= self.max_elements && self.watch.may_refine(elements)
    }

    fn report(&self, fraction: f64) {
        self.watch.report(fraction);
    }
}

/// Progress of one part of the work, reported as a fraction of all work; from [`WorkProgress::partial`].
#[derive(Debug)]
pub struct PartialProgress<'a> {
    /// Receiver of the reports.
    watch: &'a dyn Progress,
    /// Fraction of all work that is completed before this part begins.
    start: f64,
    /// Fraction of all work that this part is.
    extent: f64,
}

impl Progress for PartialProgress<'_> {
    fn may_refine(&self, elements: usize) -> bool {
        self.watch.may_refine(elements)
    }

    fn report(&self, fraction: f64) {
        self.watch
            .report((self.start + fraction * self.extent).min(1.0));
    }
}

/// Completed and expected work, in a unit that the caller chooses.
#[derive(Debug)]
pub struct WorkProgress<'a> {
    /// Receiver of the reports.
    watch: &'a dyn Progress,
    /// Work that is completed.
    completed: f64,
    /// Expected total work.
    expected: f64,
}

impl<'a> WorkProgress<'a> {
    /// Progress of an expected amount of work, none of which is completed.
    pub const fn new(watch: &'a dyn Progress, expected: f64) -> Self {
        Self {
            watch,
            completed: 0.0,
            expected,
        }
    }

    /// Sets the expected total to the completed work plus this remaining work.
    pub const fn set_remaining_work(&mut self, work: f64) {
        self.expected = self.completed + work;
    }

    /// Runs a task of the given work, which reports the completed fraction of itself through its argument.
    pub fn run<T>(&mut self, work: f64, task: impl FnOnce(&dyn Fn(f64)) -> T) -> T {
        let (watch, completed, expected) = (self.watch, self.completed, self.expected);
        let report =
            |fraction: f64| watch.report(((completed + fraction * work) / expected).min(1.0));
        let value = task(&report);
        self.add(work);
        value
    }

    /// Progress of the next part, of the given amount of work. The caller must [`add`](Self::add) the amount once the part is
    /// completed. A part of no work reports a constant fraction.
    pub fn partial(&self, work: f64) -> PartialProgress<'a> {
        PartialProgress {
            watch: self.watch,
            start: self.completed / self.expected,
            extent: work / self.expected,
        }
    }

    /// Adds completed work, and reports it.
    pub fn add(&mut self, work: f64) {
        self.completed += work;
        self.watch.report((self.completed / self.expected).min(1.0));
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Mutex;

    use super::*;

    #[derive(Debug, Default)]
    struct Recorder(Mutex<Vec<f64>>);

    impl Progress for Recorder {
        fn may_refine(&self, elements: usize) -> bool {
            elements < 8
        }

        fn report(&self, fraction: f64) {
            self.0.lock().expect("a list").push(fraction);
        }
    }

    #[test]
    fn a_part_reports_itself_as_a_fraction_of_all_work() {
        let recorder = Recorder::default();
        let mut progress = WorkProgress::new(&recorder, 4.0);
        progress.add(1.0);
        let part = progress.partial(2.0);
        part.report(0.5);
        progress.partial(0.0).report(1.0);
        assert!(part.may_refine(7) && !part.may_refine(8));
        let reported = recorder.0.into_inner().expect("a list");
        assert_eq!(reported, [0.25, 0.5, 0.25]);
    }
}
