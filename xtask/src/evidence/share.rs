//! How often something holds, and how often it must.

/// How many of all cases hold.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Share {
    pub(super) held: usize,
    pub(super) all: usize,
}

impl Share {
    pub(super) fn fraction(self) -> f64 {
        self.held as f64 / self.all as f64
    }

    /// In per cent; empty without cases.
    pub(super) fn percentage(self) -> String {
        let percentage = || format!("{:.1} %", 100.0 * self.fraction());
        (self.all > 0).then(percentage).unwrap_or_default()
    }

    /// Standard deviation of the fraction of so many cases, each of which holds with a probability.
    pub(super) fn scatter(self, probability: f64) -> f64 {
        (probability * (1.0 - probability) / self.all as f64).sqrt()
    }

    /// Whether each case may hold with a probability: not fewer hold than by so many standard deviations.
    pub(super) fn may_be(self, probability: f64, deviations: f64) -> bool {
        let least = probability - deviations * self.scatter(probability);
        self.all > 0 && self.held as f64 >= least * self.all as f64
    }
}

impl FromIterator<bool> for Share {
    fn from_iter<I: IntoIterator<Item = bool>>(cases: I) -> Self {
        let add = |Self { held, all }, holds| Self {
            held: held + usize::from(holds),
            all: all + 1,
        };
        cases.into_iter().fold(Self::default(), add)
    }
}
