//! Checks of parameters against their allowed ranges, and the format of numbers in messages.

use std::fmt::{self, Display, Formatter, LowerExp};
use std::ops::Range;

use thiserror::Error;

/// A parameter that is not a number, or out of its allowed range.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[error("{parameter} must be {allowed}, but is {}", MessageNumber(*value))]
pub struct InvalidParameter {
    /// Name of the parameter.
    pub parameter: &'static str,
    /// The refused value.
    pub value: f64,
    /// Description of the allowed values.
    pub allowed: &'static str,
}

/// A number in the format of messages.
///
/// Infinity and NaN are written in words, very large and very small numbers with a power of ten, and zero without sign and
/// power. Rounding errors of decimal numbers of few digits are not shown.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MessageNumber(pub f64);

impl MessageNumber {
    /// Words for a value that is infinite or not a number; `None` for a finite one.
    const fn words(self) -> Option<&'static str> {
        match self.0 {
            f64::INFINITY => Some("larger than any number"),
            f64::NEG_INFINITY => Some("below every number"),
            number if number.is_nan() => Some("not a number"),
            _ => None,
        }
    }
}

impl Display for MessageNumber {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> fmt::Result {
        match self.words() {
            Some(words) => formatter.write_str(words),
            None if self.0 == 0.0 => formatter.write_str("0"),
            None if let Some(short) = without_rounding_error(self.0) => {
                Display::fmt(&Self(short), formatter)
            }
            // `Debug` writes numbers out of this range with a power of ten.
            None if !POSITIONAL_RANGE.contains(&self.0.abs()) => {
                fmt::Debug::fmt(&self.0, formatter)
            }
            None => Display::fmt(&self.0, formatter),
        }
    }
}

/// Absolute values of numbers that are written without a power of ten: those for which `Debug` does so.
pub(crate) const POSITIONAL_RANGE: Range<f64> = 1e-5..1e16;
/// Number of significant digits of a short decimal number that the rounding errors of a few operations do not change. Derived:
/// one less than those that survive reading and writing.
const RELIABLE_DIGITS: usize = f64::DIGITS as usize - 1;
/// Largest number of characters of the mantissa, with its point, of a number that is written as a short decimal one in messages.
/// Chosen for the reader; no result depends on it.
const MAX_SHORT_MANTISSA: usize = 10;

/// The short decimal number from which this one differs by rounding errors only, such as 0.3 for 0.1 + 0.2.
///
/// `None` if there is none, or if it is an integer, whose neighbours may be out of range.
fn without_rounding_error(number: f64) -> Option<f64> {
    let short = format!("{number:.*e}", RELIABLE_DIGITS - 1)
        .parse::<f64>()
        .ok()?;
    let scientific = format!("{:e}", short.abs());
    let mantissa_length = scientific.split('e').next()?.len();
    let is_rounding_error = short.to_bits() != number.to_bits()
        && mantissa_length <= MAX_SHORT_MANTISSA
        && short.fract() != 0.0;
    is_rounding_error.then_some(short)
}

/// A computed number in the format of messages, rounded to five significant digits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rounded(pub f64);

impl Display for Rounded {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> fmt::Result {
        let rounded = format!("{:.4e}", self.0).parse();
        Display::fmt(&MessageNumber(rounded.unwrap_or(self.0)), formatter)
    }
}

/// The power of ten of the first digit of a finite number.
pub(crate) fn power_of_ten(number: f64) -> i32 {
    let text = format!("{number:e}");
    let power = text.split('e').nth(1);
    power.and_then(|power| power.parse().ok()).unwrap_or(0)
}

impl LowerExp for MessageNumber {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> fmt::Result {
        match self.words() {
            Some(words) => formatter.write_str(words),
            None if self.0 == 0.0 => formatter.write_str("0"),
            None => LowerExp::fmt(&self.0, formatter),
        }
    }
}

/// The value of a parameter if `holds`, the condition that the text `allowed` describes.
///
/// # Errors
/// [`InvalidParameter`] otherwise.
pub const fn in_range(
    parameter: &'static str,
    value: f64,
    holds: bool,
    allowed: &'static str,
) -> Result<f64, InvalidParameter> {
    if holds {
        return Ok(value);
    }
    Err(InvalidParameter {
        parameter,
        value,
        allowed,
    })
}

/// A value that is finite and greater than 0.
///
/// # Errors
/// [`InvalidParameter`] otherwise.
pub const fn positive(parameter: &'static str, value: f64) -> Result<f64, InvalidParameter> {
    let holds = value.is_finite() && value > 0.0;
    in_range(parameter, value, holds, "finite and greater than 0")
}

/// A value that is finite and at least 0.
///
/// # Errors
/// [`InvalidParameter`] otherwise.
pub const fn not_negative(parameter: &'static str, value: f64) -> Result<f64, InvalidParameter> {
    let holds = value.is_finite() && value >= 0.0;
    in_range(parameter, value, holds, "finite and at least 0")
}

/// A value that is finite.
///
/// # Errors
/// [`InvalidParameter`] otherwise.
pub const fn finite(parameter: &'static str, value: f64) -> Result<f64, InvalidParameter> {
    in_range(parameter, value, value.is_finite(), "finite")
}

/// A value between 0 and 1, which are excluded.
///
/// # Errors
/// [`InvalidParameter`] otherwise.
pub const fn between_zero_and_one(
    parameter: &'static str,
    value: f64,
) -> Result<f64, InvalidParameter> {
    let holds = value > 0.0 && value < 1.0;
    in_range(parameter, value, holds, "between 0 and 1")
}

#[cfg(test)]
mod tests {
    use super::*;

    type Check = fn(&'static str, f64) -> Result<f64, InvalidParameter>;

    #[test]
    fn numbers_in_messages_are_short() {
        let numbers = [1e-300, -1e300, 0.25, -0.0, 1e-4, 300.0, f64::INFINITY];
        let said = numbers.map(|number| MessageNumber(number).to_string());
        let expected = "1e-300|-1e300|0.25|0|0.0001|300|larger than any number";
        assert_eq!(said.join("|"), expected, "in words");
        assert_eq!(format!("{:.1e}", MessageNumber(-0.0)), "0", "with a power");
        let noisy = [
            0.1 + 0.2,
            31.599_999_999_999_998,
            -40.239_000_000_000_004,
            1.0 - 1e-16,
            1.0 / 3.0,
        ];
        let said = noisy.map(|number| MessageNumber(number).to_string());
        let expected = "0.3|31.6|-40.239|0.9999999999999999|0.3333333333333333";
        assert_eq!(said.join("|"), expected, "rounding errors");
        let said = [1.0 / 3.0, 2.0e-7 / 3.0, 20.0].map(|number| Rounded(number).to_string());
        assert_eq!(said.join("|"), "0.33333|6.6667e-8|20", "computed");
    }

    #[test]
    fn each_check_accepts_its_range_and_no_more() {
        let cases: [(Check, &[f64], &[f64]); 4] = [
            (positive, &[5e-324, 1e308], &[0.0, -1.0]),
            (not_negative, &[0.0, 1e308], &[-5e-324]),
            (finite, &[-1e308, 0.0, 1e308], &[]),
            (between_zero_and_one, &[5e-324, 0.999], &[0.0, 1.0]),
        ];
        for (check, accepted, refused) in cases {
            for &value in accepted {
                assert_eq!(check("length", value), Ok(value), "accepted");
            }
            for value in [refused, &[f64::NAN, f64::INFINITY, f64::NEG_INFINITY]].concat() {
                let error = check("length", value).expect_err("out of range");
                let error = error.to_string();
                assert!(!error.contains("inf") && !error.contains("NaN"), "{error}");
                let said = error.starts_with("length must be ");
                assert!(
                    said && error.ends_with(&format!(", but is {}", MessageNumber(value))),
                    "{error}"
                );
            }
        }
    }
}
