//! A value with its estimated error.

use std::fmt;
use std::iter::Sum;
use std::ops::{Add, Deref, Mul};

use crate::invalid_parameter::{POSITIONAL_RANGE, Rounded, power_of_ten};

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

/// The format of messages, without digits beyond the second of the error: 0.0384647 ± 2.0e-6.
impl fmt::Display for Estimate {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ValueWithError { value, error } = self.0;
        let has_digits = value.is_finite() && error.is_finite() && error > 0.0;
        if !has_digits {
            return write!(formatter, "{} ± {}", Rounded(value), Rounded(error));
        }
        // Powers of ten of the last digit shown, the second of the error, and of the first digit of the value.
        let last = power_of_ten(error) - 1;
        let first = power_of_ten(value);
        if POSITIONAL_RANGE.contains(&value.abs().max(error)) {
            let digits = usize::try_from(-last).unwrap_or(0);
            return write!(formatter, "{value:.digits$} ± {error:.1e}");
        }
        let digits = usize::try_from(first - last).unwrap_or(0);
        write!(formatter, "{value:.digits$e} ± {error:.1e}")
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

    /// The error over the modulus of the value; NaN if both are 0.
    pub fn relative_error(&self) -> f64 {
        self.error / self.value.abs()
    }

    /// Whether the value is finite and its error at most `relative_error` times its modulus.
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
            (2.0e-7, 3.4e-9),
            (1234.5678, 12.0),
            (0.0, 1e-3),
            (1.0 / 3.0, 0.0),
            (1.0, f64::INFINITY),
        ];
        let said = known.map(|(value, error)| Estimate::new(value, error).to_string());
        let expected = [
            "0.0384647 ± 2.0e-6",
            "-0.00006 ± 1.9e-4",
            "0.0000735637 ± 4.4e-9",
            "2.000e-7 ± 3.4e-9",
            "1235 ± 1.2e1",
            "0.0000 ± 1.0e-3",
            "0.33333 ± 0",
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
