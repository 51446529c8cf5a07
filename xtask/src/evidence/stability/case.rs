//! A case: a computation at the edge of what is possible, and what it must come to.

use std::fmt::{Debug, Display};

use anyhow::Result;

/// Cases that differ in one parameter, or in one kind of input.
pub(super) struct Family {
    /// What is computed.
    pub(super) name: &'static str,
    /// What differs from case to case.
    pub(super) parameter: &'static str,
    pub(super) cases: Vec<Case>,
    /// Whether it is left out of a quick run.
    pub(super) slow: bool,
}

/// One case of a family.
pub(super) struct Case {
    /// Value of the parameter.
    pub(super) value: String,
    pub(super) run: Box<dyn Fn() -> Result<Finding> + Send + Sync>,
}

/// What a case came to.
#[derive(Debug)]
pub(super) enum Finding {
    /// Numbers, beside those that are right.
    Values(Vec<Comparison>),
    /// A problem without a solution, beside the typed error that says so.
    Refusal {
        /// Pattern of the right error.
        expected: &'static str,
        /// The error, or the solution that should not be.
        got: String,
        right: bool,
    },
}

/// A number beside the right one.
#[derive(Debug, Clone)]
pub(super) struct Comparison {
    pub(super) quantity: String,
    pub(super) got: f64,
    pub(super) expected: f64,
    /// |got − expected| in units of this is the deviation.
    pub(super) scale: f64,
    /// Largest deviation that is accurate.
    pub(super) tolerance: f64,
}

impl Family {
    /// One case for each value of a parameter.
    pub(super) fn over<R>(
        name: &'static str,
        parameter: &'static str,
        values: impl IntoIterator<Item = f64>,
        run: R,
    ) -> Self
    where
        R: Fn(f64) -> Result<Finding> + Copy + Send + Sync + 'static,
    {
        let case = |value: f64| Case::new(format!("{value:e}"), move || run(value));
        Self::of(name, parameter, values.into_iter().map(case).collect())
    }

    pub(super) fn of(name: &'static str, parameter: &'static str, cases: Vec<Case>) -> Self {
        Self {
            name,
            parameter,
            cases,
            slow: false,
        }
    }

    /// The same, left out of a quick run.
    pub(super) fn slow(self) -> Self {
        Self { slow: true, ..self }
    }
}

impl Case {
    pub(super) fn new(
        value: impl Into<String>,
        run: impl Fn() -> Result<Finding> + Send + Sync + 'static,
    ) -> Self {
        Self {
            value: value.into(),
            run: Box::new(run),
        }
    }
}

impl Comparison {
    /// A number that is known relative to its own size.
    pub(super) fn relative(quantity: &str, got: f64, expected: f64, tolerance: f64) -> Self {
        Self {
            quantity: quantity.replace('_', " "),
            got,
            expected,
            scale: expected.abs(),
            tolerance,
        }
    }

    /// The same in other units.
    pub(super) fn in_units_of(self, scale: f64) -> Self {
        Self { scale, ..self }
    }
}

impl Finding {
    /// The error that a problem must end in; see [`refused!`](super::refused).
    pub(super) fn refusal<T: Debug, E: Display>(
        result: std::result::Result<T, E>,
        expected: &'static str,
        is_right: impl Fn(&E) -> bool,
    ) -> Self {
        let (got, right) = match result {
            // Enough of a solution that should not be to recognise it.
            Ok(value) => (format!("{value:?}").chars().take(200).collect(), false),
            Err(error) => (error.to_string(), is_right(&error)),
        };
        Self::Refusal {
            expected,
            got,
            right,
        }
    }
}

/// A list of families, each as `name, parameter, values => function of the value;`.
macro_rules! families {
    ($($name:literal, $parameter:literal, $values:expr => $run:expr;)*) => {
        vec![$($crate::evidence::stability::case::Family::over($name, $parameter, $values, $run)),*]
    };
}

/// A list of cases, each as `value of the parameter => finding;`.
macro_rules! cases {
    ($($value:expr => $finding:expr;)*) => {
        vec![$($crate::evidence::stability::case::Case::new($value, move || $finding)),*]
    };
}

/// Numbers beside the right ones, within one relative tolerance: fields of two structs, or `name: got, expected`.
macro_rules! compare {
    ($got:expr, $expected:expr, within $tolerance:expr; $($field:ident),+) => {{
        let (got, expected, tolerance) = (&$got, &$expected, $tolerance);
        compare!(within tolerance; $(stringify!($field) => got.$field, expected.$field);+)
    }};
    (within $tolerance:expr; $($name:expr => $got:expr, $expected:expr);+) => {{
        use $crate::evidence::stability::case::{Comparison, Finding};
        let tolerance = $tolerance;
        Ok(Finding::Values(vec![$(Comparison::relative($name, $got, $expected, tolerance)),+]))
    }};
}

/// What comes of a problem whose right result is an error of the given pattern.
macro_rules! refused {
    ($result:expr => $pattern:pat) => {
        Ok($crate::evidence::stability::case::Finding::refusal(
            $result,
            stringify!($pattern),
            |error| matches!(error, $pattern),
        ))
    };
}
pub(super) use {cases, compare, families, refused};

/// 10^first, 10^(first + step), …, 10^last.
pub(super) fn decades(first: i32, last: i32, step: usize) -> impl Iterator<Item = f64> + Clone {
    (first..=last).step_by(step).map(power_of_ten)
}

/// The number nearest to 10^exponent; `powi` rounds more than once.
pub(super) fn power_of_ten(exponent: i32) -> f64 {
    format!("1e{exponent}").parse().unwrap_or(f64::NAN)
}
