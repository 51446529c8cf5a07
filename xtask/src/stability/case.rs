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
    pub(super) run: Box<dyn Fn() -> Result<Outcome> + Send + Sync>,
}

/// What a case came to.
#[derive(Debug)]
pub(super) enum Outcome {
    /// Numbers, beside those that are right.
    Values(Vec<Comparison>),
    /// A question without an answer, beside the typed error that says so.
    Refusal {
        /// Pattern of the right error.
        expected: &'static str,
        /// The error, or the answer that should not be.
        got: String,
        right: bool,
    },
}

/// A number beside the right one.
#[derive(Debug, Clone, Copy)]
pub(super) struct Comparison {
    pub(super) quantity: &'static str,
    pub(super) expected: f64,
    pub(super) got: f64,
    /// |got − expected| in units of this is the deviation.
    pub(super) scale: f64,
    /// Largest deviation that counts as accurate.
    pub(super) tolerance: f64,
}

impl Family {
    /// One case for each value of a parameter.
    pub(super) fn over<R>(
        (name, parameter): (&'static str, &'static str),
        values: impl IntoIterator<Item = f64>,
        run: R,
    ) -> Self
    where
        R: Fn(f64) -> Result<Outcome> + Copy + Send + Sync + 'static,
    {
        let case = |value: f64| Case::new(format!("{value:e}"), move || run(value));
        Self {
            name,
            parameter,
            cases: values.into_iter().map(case).collect(),
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
        run: impl Fn() -> Result<Outcome> + Send + Sync + 'static,
    ) -> Self {
        Self {
            value: value.into(),
            run: Box::new(run),
        }
    }
}

impl Outcome {
    /// Numbers, each known relative to its own size.
    pub(super) fn relative(pairs: &[(&'static str, [f64; 2])], tolerance: f64) -> Self {
        let compare = |&(quantity, [got, expected]): &(&'static str, [f64; 2])| Comparison {
            quantity,
            expected,
            got,
            scale: expected.abs(),
            tolerance,
        };
        Self::Values(pairs.iter().map(compare).collect())
    }

    /// The error that a question must end in; see [`refused!`](super::refused).
    pub(super) fn refusal<T: Debug, E: Display>(
        result: std::result::Result<T, E>,
        expected: &'static str,
        is_right: impl Fn(&E) -> bool,
    ) -> Self {
        match result {
            Ok(value) => Self::Refusal {
                expected,
                got: shortened(&format!("{value:?}")),
                right: false,
            },
            Err(error) => Self::Refusal {
                expected,
                got: error.to_string(),
                right: is_right(&error),
            },
        }
    }
}

/// Enough of an answer that should not be to recognise it.
fn shortened(text: &str) -> String {
    text.chars().take(200).collect()
}

/// The outcome of a question whose right answer is an error of the given pattern.
macro_rules! refused {
    ($result:expr, $pattern:pat) => {
        $crate::stability::case::Outcome::refusal($result, stringify!($pattern), |error| {
            matches!(error, $pattern)
        })
    };
}
pub(super) use refused;

/// 10^first, 10^(first + step), …, 10^last.
pub(super) fn decades(first: i32, last: i32, step: usize) -> impl Iterator<Item = f64> + Clone {
    (first..=last).step_by(step).map(power_of_ten)
}

/// The number nearest to 10^exponent; `powi` rounds more than once.
pub(super) fn power_of_ten(exponent: i32) -> f64 {
    format!("1e{exponent}").parse().unwrap_or(f64::NAN)
}
