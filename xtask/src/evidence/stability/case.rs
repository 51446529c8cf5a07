//! A case: a computation at the edge of what is possible, and what it must come to.

use std::fmt::{Debug, Display};

use anyhow::Result;
use serde::Serialize;

/// Cases that differ in one parameter, or in one kind of input.
pub(super) struct Family {
    /// What is computed.
    pub(super) name: &'static str,
    /// What differs from case to case.
    pub(super) parameter: &'static str,
    pub(super) cases: Vec<Case>,
    pub(super) cost: Cost,
}

/// What a family costs; a quick run leaves the costly ones out.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Cost {
    Cheap,
    Costly,
}

/// One case of a family.
pub(super) struct Case {
    /// Value of the parameter.
    pub(super) value: String,
    pub(super) run: Box<dyn Fn() -> Result<Finding> + Send + Sync>,
}

/// What a case is worth.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum Verdict {
    /// All numbers within their tolerances.
    Accurate,
    /// The typed error that is right.
    Refused,
    /// A number outside its tolerance, an error where there is a solution, a solution where there is none, a panic.
    #[default]
    Wrong,
}

impl Verdict {
    fn provided(self, right: bool) -> Self {
        if right { self } else { Self::Wrong }
    }
}

/// A case in the table: what it came to, and, of [`judge`](super::judge), which one it is.
#[derive(Debug, Clone, Default, Serialize)]
pub(super) struct Finding {
    pub(super) family: &'static str,
    pub(super) parameter: &'static str,
    pub(super) value: String,
    /// Of several numbers the one that is closest to its tolerance.
    pub(super) quantity: String,
    /// The right number, or the pattern of the right error.
    pub(super) expected: String,
    pub(super) got: String,
    pub(super) deviation: Option<f64>,
    pub(super) tolerance: Option<f64>,
    pub(super) verdict: Verdict,
    pub(super) seconds: f64,
}

/// A number beside the right one.
#[derive(Debug, Clone)]
pub(super) struct Comparison {
    quantity: String,
    got: f64,
    expected: f64,
    /// |got − expected| in units of this is the deviation.
    scale: f64,
    /// Largest deviation that is accurate.
    tolerance: f64,
}

impl Family {
    /// One case for each value of a parameter.
    pub(super) fn over<R>(
        cost: Cost,
        name: &'static str,
        parameter: &'static str,
        values: impl IntoIterator<Item = f64>,
        run: R,
    ) -> Self
    where
        R: Fn(f64) -> Result<Finding> + Copy + Send + Sync + 'static,
    {
        let case = |value: f64| Case::new(format!("{value:e}"), move || run(value));
        let cases = values.into_iter().map(case).collect();
        Self {
            cost,
            ..Self::of(name, parameter, cases)
        }
    }

    pub(super) fn of(name: &'static str, parameter: &'static str, cases: Vec<Case>) -> Self {
        Self {
            name,
            parameter,
            cases,
            cost: Cost::Cheap,
        }
    }
}

impl Case {
    pub(super) fn new(
        value: impl ToString,
        run: impl Fn() -> Result<Finding> + Send + Sync + 'static,
    ) -> Self {
        Self {
            value: value.to_string(),
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

    fn deviation(&self) -> f64 {
        let difference = (self.got - self.expected).abs();
        if difference == 0.0 {
            return 0.0;
        }
        difference / self.scale
    }

    /// Infinite for what is not a number.
    fn part_of_tolerance(&self) -> f64 {
        let part = part(self.deviation(), self.tolerance);
        if part.is_nan() { f64::INFINITY } else { part }
    }

    fn finding(&self) -> Finding {
        let deviation = self.deviation();
        Finding {
            quantity: self.quantity.clone(),
            expected: format!("{:e}", self.expected),
            got: format!("{:e}", self.got),
            // NaN and infinity are no numbers of a table.
            deviation: deviation.is_finite().then_some(deviation),
            tolerance: Some(self.tolerance),
            verdict: Verdict::Accurate.provided(deviation <= self.tolerance),
            ..Finding::default()
        }
    }
}

impl Finding {
    /// The worst of several numbers.
    pub(super) fn of(numbers: &[Comparison]) -> Self {
        let part = Comparison::part_of_tolerance;
        let worst = numbers
            .iter()
            .max_by(|one, other| part(one).total_cmp(&part(other)));
        let nothing = || Self::wrong("a number", "nothing was compared".to_owned());
        worst.map_or_else(nothing, Comparison::finding)
    }

    pub(super) fn wrong(expected: &str, got: String) -> Self {
        let expected = expected.to_owned();
        Self {
            expected,
            got,
            ..Self::default()
        }
    }

    /// The error that a problem must end in; see [`refused!`](super::refused).
    pub(super) fn refusal<T: Debug, E: Display>(
        result: std::result::Result<T, E>,
        expected: &str,
        is_right: impl Fn(&E) -> bool,
    ) -> Self {
        match result {
            // Enough of a solution that should not be to recognise it.
            Ok(value) => Self::wrong(expected, format!("{value:?}").chars().take(200).collect()),
            Err(error) => Self {
                verdict: Verdict::Refused.provided(is_right(&error)),
                ..Self::wrong(expected, error.to_string())
            },
        }
    }

    /// Deviation as a part of what is allowed, where numbers were compared.
    pub(super) fn part_of_tolerance(&self) -> Option<f64> {
        Some(part(self.deviation?, self.tolerance?))
    }
}

/// No deviation is within any tolerance, even none.
fn part(deviation: f64, tolerance: f64) -> f64 {
    if deviation == 0.0 {
        return 0.0;
    }
    deviation / tolerance
}

/// A list of families, each as `cost name, parameter, values => function of the value;`.
macro_rules! families {
    ($($cost:ident $name:literal, $parameter:literal, $values:expr => $run:expr;)*) => {{
        use $crate::evidence::stability::case::{Cost, Family};
        vec![$(Family::over(Cost::$cost, $name, $parameter, $values, $run)),*]
    }};
}

/// A list of cases, each as `value of the parameter => finding;`.
macro_rules! cases {
    ($($value:expr => $finding:expr;)*) => {
        vec![$($crate::evidence::stability::case::Case::new($value, move || $finding)),*]
    };
}

/// Numbers beside the right ones, within one relative tolerance: fields of two structs, or `name => got, expected`.
macro_rules! compare {
    ($got:expr, $expected:expr, within $tolerance:expr; $($field:ident),+) => {{
        let (got, expected, tolerance) = (&$got, &$expected, $tolerance);
        compare!(within tolerance; $(stringify!($field) => got.$field, expected.$field);+)
    }};
    (within $tolerance:expr; $($name:expr => $got:expr, $expected:expr);+) => {{
        use $crate::evidence::stability::case::{Comparison, Finding};
        let tolerance = $tolerance;
        Ok(Finding::of(&[$(Comparison::relative($name, $got, $expected, tolerance)),+]))
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
