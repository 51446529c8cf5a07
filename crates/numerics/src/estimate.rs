//! A value with its estimated error.

use std::fmt;
use std::iter::Sum;
use std::ops::{Add, Deref, Mul, Range};

use crate::invalid_parameter::{MessageNumber, Rounded, power_of_ten};

/// A computed number with its estimated absolute error, read as `.value` and `.error`.
///
/// The error is never negative and never NaN, so that no comparison with it passes by accident.
/// A value that is NaN is stored as 0 ± ∞: nothing is known.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize), serde(transparent))]
pub struct Estimate(ValueWithError);

/// The two numbers of an [`Estimate`].
#[derive(Debug, Clone, Copy, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ValueWithError {
    /// The computed number, never NaN.
    pub value: f64,
    /// Estimated absolute error ≥ 0, in the unit of the value; infinite if nothing is known.
    pub error: f64,
}

/// Read access to both numbers; neither can be changed alone.
impl Deref for Estimate {
    type Target = ValueWithError;

    fn deref(&self) -> &ValueWithError {
        &self.0
    }
}

/// Value and error with the same last digit, the second one of the error: `0.0384647 ± 0.0000020`, or `(6.55301 ± 0.00054)e-5` where
/// that is shorter. An exact number stands alone, rounded to five digits if it has many.
impl fmt::Display for Estimate {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ValueWithError { value, error } = self.0;
        if error == 0.0 {
            let all_digits = MessageNumber(value).to_string();
            return match all_digits.len() {
                ..=MAX_EXACT_LENGTH => formatter.write_str(&all_digits),
                _ => write!(formatter, "{}", Rounded(value)),
            };
        }
        if !(value.is_finite() && error.is_finite()) {
            return write!(formatter, "{} ± {}", Rounded(value), Rounded(error));
        }

        // `last` and `first` are the powers of ten of the last digit shown and of the first one.
        let shown_error = error.max(MIN_RELATIVE_ERROR * value.abs());
        let last = power_of_rounded(shown_error) - 1;
        let first = power_of_ten(value).max(power_of_rounded(shown_error));
        if PLAIN_POWERS.contains(&first) && last <= 0 {
            let [digits, error_digits] = [value, shown_error].map(|number| fixed(number, -last));
            return write!(formatter, "{digits} ± {error_digits}");
        }
        // The power of ten is applied in two halves, because the whole one may overflow.
        let half = 10.0_f64.powi(-first / 2);
        let other_half = 10.0_f64.powi(-first - -first / 2);
        let mantissa = |number: f64| fixed(number * half * other_half, first - last);
        let [digits, error_digits] = [value, shown_error].map(mantissa);
        write!(formatter, "({digits} ± {error_digits})e{first}")
    }
}

/// Smallest relative error that is written; a smaller one comes from rounding, and is written as this one. Chosen: it limits a
/// number to eleven digits, and no computation depends on it.
const MIN_RELATIVE_ERROR: f64 = 1e-9;
/// Largest number of characters of an exact number that is not rounded: those of 0.1234567.
const MAX_EXACT_LENGTH: usize = 9;

/// Powers of ten of the first digit of numbers that are written without a power of ten: from 0.001 to below a million. Chosen for
/// the reader; no computation depends on it.
const PLAIN_POWERS: Range<i32> = -3..6;

/// The power of ten of the first digit of an error that is rounded to two digits.
fn power_of_rounded(error: f64) -> i32 {
    let rounded = format!("{error:.1e}").parse();
    power_of_ten(rounded.unwrap_or(error))
}

/// A number with a fixed number of decimals; one that rounds to zero has no sign.
fn fixed(number: f64, decimals: i32) -> String {
    let decimals = usize::try_from(decimals).unwrap_or(0);
    let text = format!("{number:.decimals$}");
    match text.strip_prefix('-') {
        Some(digits) if digits.bytes().all(|byte| b"0.".contains(&byte)) => digits.to_owned(),
        _ => text,
    }
}

impl Estimate {
    /// A number and its absolute error; an error that is negative or NaN is infinite.
    pub const fn new(value: f64, error: f64) -> Self {
        let unknown = (0.0, f64::INFINITY);
        let (value, error) = match (value.is_nan(), error >= 0.0) {
            (true, _) => unknown,
            (false, true) => (value, error),
            (false, false) => (value, f64::INFINITY),
        };
        Self(ValueWithError { value, error })
    }

    /// A number without error.
    pub const fn exact(value: f64) -> Self {
        Self::new(value, 0.0)
    }

    /// The number with an error that is larger by `additional_error`, in the unit of the value.
    #[must_use]
    pub const fn widened(self, additional_error: f64) -> Self {
        Self::new(self.0.value, self.0.error + additional_error)
    }

    /// The error over the absolute value; NaN if both are 0.
    pub fn relative_error(&self) -> f64 {
        self.error / self.value.abs()
    }

    /// Whether the value is finite and its error at most `relative_error` times its absolute value.
    pub fn is_within(&self, relative_error: f64) -> bool {
        self.value.is_finite() && self.error <= relative_error * self.value.abs()
    }
}

/// Sum whose error is the sum of the errors, because they need not be independent.
impl Add for Estimate {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self::new(self.value + other.value, self.error + other.error)
    }
}

impl Sum for Estimate {
    fn sum<I: Iterator<Item = Self>>(estimates: I) -> Self {
        estimates.fold(Self::default(), Self::add)
    }
}

impl Mul<f64> for Estimate {
    type Output = Self;

    fn mul(self, factor: f64) -> Self {
        Self::new(factor * self.value, factor.abs() * self.error)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn messages_have_no_digits_beyond_the_second_of_the_error() {
        let known = [
            (0.038_464_693, 2.0e-6),
            (-6.225_184e-5, 1.9e-4),
            (7.356_372_07e-5, 4.4e-9),
            (-1e-9, 3.4e-3),
            (2.0e-7, 9.96e-9),
            (1234.5678, 12.0),
            (98_765.0, 1234.0),
            (4.366_974e6, 1.8e4),
            (3.0e-320, 2.0e-322),
            (-1.5e307, 2.0e300),
            (0.25, 1e-17),
            (1.0 / 3.0, 0.0),
            (2.0e-7, 0.0),
            (1.0, f64::INFINITY),
        ];
        let said = known.map(|(value, error)| Estimate::new(value, error).to_string());
        let expected = [
            "0.0384647 ± 0.0000020",
            "(-0.6 ± 1.9)e-4",
            "(7.35637 ± 0.00044)e-5",
            "0.0000 ± 0.0034",
            "(2.00 ± 0.10)e-7",
            "1235 ± 12",
            "(9.88 ± 0.12)e4",
            "(4.367 ± 0.018)e6",
            "(3.000 ± 0.020)e-320",
            "(-1.50000000 ± 0.00000020)e307",
            "0.25000000000 ± 0.00000000025",
            "0.33333",
            "2e-7",
            "1 ± larger than any number",
        ];
        assert_eq!(said, expected, "{known:?}");
    }

    #[test]
    fn errors_add_up_and_are_compared_with_the_modulus() {
        let estimates =
            [(3.0, 0.25), (-5.0, 0.5)].map(|(value, error)| Estimate::new(value, error));
        let sum = estimates.into_iter().sum::<Estimate>();
        assert_eq!(sum * -3.0, Estimate::new(6.0, 2.25), "of {estimates:?}");
        let within = |relative_error: f64| estimates[1].is_within(relative_error);
        assert_eq!([0.099, 0.1].map(within), [false, true], "of 0.5 in -5");
        let overflown = Estimate::exact(f64::INFINITY);
        assert!(!overflown.is_within(1.0), "of no number");
    }

    #[test]
    fn an_error_is_a_number_of_at_least_zero() {
        for error in [-1e-300, f64::NEG_INFINITY, f64::NAN] {
            let estimate = Estimate::new(2.0, error);
            assert_eq!(estimate, Estimate::new(2.0, f64::INFINITY), "from {error}");
            assert!(!estimate.is_within(0.1), "from {error}");
        }
        let unknown = Estimate::exact(f64::NAN);
        assert_eq!(unknown, Estimate::new(0.0, f64::INFINITY), "from NaN");
        assert_eq!(unknown * 0.0, unknown, "nothing is known of a multiple");
        let widened = Estimate::new(2.0, 0.5).widened(f64::NAN);
        assert_eq!(widened, Estimate::new(2.0, f64::INFINITY), "widened by NaN");
    }
}
