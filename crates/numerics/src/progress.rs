//! How far a computation on finer and finer resolutions is, for whoever waits for it.

use std::fmt;

/// Follows a computation, and may end it.
pub trait Watch: fmt::Debug + Sync {
    /// Whether a resolution with so many elements may be begun because those before it do not have the error asked for.
    fn allows(&self, elements: usize) -> bool;

    /// So much of the work that is expected is done, from 0 to 1; less than before where more turns out to be needed.
    fn done(&self, part: f64);
}

/// Nobody follows.
#[derive(Debug)]
pub struct Unwatched;

impl Watch for Unwatched {
    fn allows(&self, _: usize) -> bool {
        true
    }

    fn done(&self, _: f64) {}
}

/// Nobody follows, and resolutions with more elements than this are not begun.
#[derive(Debug, Clone, Copy)]
pub struct AtMost(pub usize);

impl Watch for AtMost {
    fn allows(&self, elements: usize) -> bool {
        elements <= self.0
    }

    fn done(&self, _: f64) {}
}

/// Follows as another does, and resolutions with more elements than so many are not begun.
#[derive(Debug, Clone, Copy)]
pub struct NoFiner<'a> {
    /// Is told what this one is told, and may end it earlier.
    pub watch: &'a dyn Watch,
    /// Most elements of a resolution that may be begun.
    pub than: usize,
}

impl Watch for NoFiner<'_> {
    fn allows(&self, elements: usize) -> bool {
        elements <= self.than && self.watch.allows(elements)
    }

    fn done(&self, part: f64) {
        self.watch.done(part);
    }
}

/// Tells of a piece of work as a part of all.
#[derive(Debug)]
pub struct Share<'a> {
    watch: &'a dyn Watch,
    from: f64,
    part: f64,
}

impl Watch for Share<'_> {
    fn allows(&self, elements: usize) -> bool {
        self.watch.allows(elements)
    }

    fn done(&self, part: f64) {
        self.watch.done((self.from + part * self.part).min(1.0));
    }
}

/// Work that is done and expected, in a unit of one's own.
#[derive(Debug)]
pub struct Progress<'a> {
    watch: &'a dyn Watch,
    done: f64,
    expected: f64,
}

impl<'a> Progress<'a> {
    /// Nothing is done of what is expected.
    pub const fn new(watch: &'a dyn Watch, expected: f64) -> Self {
        let done = 0.0;
        Self {
            watch,
            done,
            expected,
        }
    }

    /// So much is left.
    pub const fn expect(&mut self, work: f64) {
        self.expected = self.done + work;
    }

    /// Does a piece of work that tells which part of it is done.
    pub fn during<T>(&mut self, work: f64, task: impl FnOnce(&dyn Fn(f64)) -> T) -> T {
        let (watch, done, expected) = (self.watch, self.done, self.expected);
        let tell = |part: f64| watch.done(((done + part * work) / expected).min(1.0));
        let value = task(&tell);
        self.add(work);
        value
    }

    /// Follows a piece of work that is done elsewhere; work 0 tells nothing of itself.
    pub fn share(&self, work: f64) -> Share<'a> {
        Share {
            watch: self.watch,
            from: self.done / self.expected,
            part: work / self.expected,
        }
    }

    /// A piece of work is done.
    pub fn add(&mut self, work: f64) {
        self.done += work;
        self.watch.done((self.done / self.expected).min(1.0));
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Mutex;

    use super::*;

    #[derive(Debug, Default)]
    struct Recorder(Mutex<Vec<f64>>);

    impl Watch for Recorder {
        fn allows(&self, elements: usize) -> bool {
            elements < 8
        }

        fn done(&self, part: f64) {
            self.0.lock().expect("a list").push(part);
        }
    }

    #[test]
    fn a_share_tells_of_itself_as_a_part_of_all() {
        let recorder = Recorder::default();
        let mut progress = Progress::new(&recorder, 4.0);
        progress.add(1.0);
        let share = progress.share(2.0);
        share.done(0.5);
        progress.share(0.0).done(1.0);
        assert!(share.allows(7) && !share.allows(8));
        let told = recorder.0.into_inner().expect("a list");
        assert_eq!(told, [0.25, 0.5, 0.25]);
    }
}
