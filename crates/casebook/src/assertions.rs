//! Assertions that say what was found, for the tests of all crates.

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
