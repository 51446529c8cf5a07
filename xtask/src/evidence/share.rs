//! Fractions of cases in which a statement holds, and a test of whether they are significantly too small.

/// In how many of some cases a statement holds.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Share {
    /// Number of cases in which it holds.
    pub(super) held: usize,
    /// Number of all cases.
    pub(super) all: usize,
}

impl Share {
    /// Fraction of the cases that hold, 0 to 1; NaN without cases.
    pub(super) fn fraction(self) -> f64 {
        self.held as f64 / self.all as f64
    }

    /// The fraction in per cent, for people; an empty text without cases.
    pub(super) fn percentage(self) -> String {
        let percentage = || format!("{:.1} %", 100.0 * self.fraction());
        (self.all > 0).then(percentage).unwrap_or_default()
    }

    /// Standard deviation of the fraction of this number of independent cases, each of which holds with `probability`
    /// (binomial distribution).
    pub(super) fn scatter(self, probability: f64) -> f64 {
        (probability * (1.0 - probability) / self.all as f64).sqrt()
    }

    /// Whether the cases are compatible with each holding with `probability`: the fraction is not lower than that by more than
    /// `deviations` standard deviations. False without cases.
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
