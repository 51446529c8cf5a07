//! A value with its error.

use std::iter::Sum;
use std::ops::{Add, Mul};

/// A computed number and what it may be off by.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Estimate {
    /// The computed number.
    pub value: f64,
    /// Estimated absolute error, in the unit of the value.
    pub error: f64,
}

impl Estimate {
    /// A number and its absolute error.
    pub const fn new(value: f64, error: f64) -> Self {
        Self { value, error }
    }

    /// A number without error.
    pub const fn exact(value: f64) -> Self {
        Self { value, error: 0.0 }
    }

    /// Whether the value is finite and its error at most the relative one.
    pub fn is_within(&self, relative_error: f64) -> bool {
        self.value.is_finite() && self.error <= relative_error * self.value.abs()
    }
}

/// Errors add up: they need not be independent.
impl Add for Estimate {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self {
            value: self.value + other.value,
            error: self.error + other.error,
        }
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
        Self {
            value: factor * self.value,
            error: factor.abs() * self.error,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
}
