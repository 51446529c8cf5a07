//! Assertions that say what was found, for the tests of all crates.

use std::fmt::{Debug, Display};

/// Numbers that are not at least 0.
pub const NEGATIVE: &[f64] = &[f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -1.0, -1e-300];
/// Numbers that are not greater than 0.
pub const NOT_POSITIVE: &[f64] = &[
    f64::NAN,
    f64::INFINITY,
    f64::NEG_INFINITY,
    -1.0,
    -1e-300,
    -0.0,
    0.0,
];

/// Asserts that each of the numbers is refused by an error that names the parameter and the number.
pub fn refuses<T: Debug, E: Display>(
    parameter: &str,
    numbers: &[f64],
    attempt: impl Fn(f64) -> Result<T, E>,
) {
    for number in numbers {
        let message = refusal(parameter, attempt(*number));
        let said = match *number {
            f64::INFINITY => "larger than any number".to_owned(),
            f64::NEG_INFINITY => "below every number".to_owned(),
            none if none.is_nan() => "not a number".to_owned(),
            0.0 => "0".to_owned(),
            // With a power of ten where that is shorter.
            number => format!("{number:?}").trim_end_matches(".0").to_owned(),
        };
        let named = message.ends_with(&format!(", but is {said}"));
        assert!(named, "{message}, for {number} as {parameter}");
    }
}

/// Asserts that a result is an error that names the parameter and what it must be.
pub fn refused<T: Debug, E: Display>(parameter: &str, result: Result<T, E>) {
    refusal(parameter, result);
}

fn refusal<T: Debug, E: Display>(parameter: &str, result: Result<T, E>) -> String {
    let message = match result {
        Err(error) => error.to_string(),
        Ok(value) => panic!("{value:?} instead of a refused {parameter}"),
    };
    let named = message.starts_with(&format!("{parameter} must be "));
    assert!(named, "{message} instead of a refused {parameter}");
    message
}

/// Asserts that a number agrees with the expected one within a relative tolerance.
///
/// ```
/// let case = 3;
/// casebook::assert_close!(2.0_f64.sqrt() => 1.414_213_562, within 1e-9);
/// casebook::assert_close!(2.0_f64.sqrt() => 1.414_213_562, within 1e-9; "case {case}");
/// ```
#[macro_export]
macro_rules! assert_close {
    ($actual:expr => $expected:expr, within $tolerance:expr $(; $($context:tt)+)?) => {{
        let [actual, expected, tolerance]: [f64; 3] = [$actual, $expected, $tolerance];
        assert!(
            (actual - expected).abs() <= tolerance * expected.abs(),
            "{}{} is {actual:e}, expected {expected:e} within {tolerance:e}",
            stringify!($actual),
            String::new() $(+ ", " + &format!($($context)+))?
        );
    }};
}

/// Asserts that a result has the form of a pattern.
///
/// ```
/// let value = 3;
/// casebook::assert_matches!("x".parse::<f64>(), Err(_));
/// casebook::assert_matches!(Some(value), Some(x) if x > 2, "the value {value}");
/// ```
#[macro_export]
macro_rules! assert_matches {
    ($result:expr, $pattern:pat $(if $guard:expr)? $(, $($context:tt)+)?) => {
        match $result {
            $pattern $(if $guard)? => {}
            ref other => panic!(
                "{other:?} instead of {}{}",
                stringify!($pattern),
                String::new() $(+ ", " + &format!($($context)+))?
            ),
        }
    };
}
