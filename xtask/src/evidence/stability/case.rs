//! A case: a computation at the edge of what is possible, its right result, and the verdict about it.

use std::fmt::{Debug, Display};
use std::time::Instant;

use anyhow::Result;
use serde::{Deserialize, Serialize};

use crate::tasks::in_parallel;

/// Cases that differ in one parameter.
#[derive(Debug, Clone, Default, Deserialize)]
#[serde(default)]
pub(super) struct Family {
    /// Name of the computation that all cases of the family share.
    pub(super) name: String,
    /// Name of the parameter that differs from case to case.
    pub(super) parameter: String,
    /// Powers of ten as values: exponents of the first and the last, and the step of the exponent.
    decades: Vec<(i32, i32, usize)>,
    /// Values of the parameter that are no powers of ten.
    values: Vec<f64>,
}

impl Family {
    /// Values of the parameter. Powers of ten are parsed, which gives the nearest f64, because `powi` rounds more than once.
    pub(super) fn values(&self) -> impl Iterator<Item = f64> {
        let powers = self
            .decades
            .iter()
            .flat_map(|&(first, last, step)| (first..=last).step_by(step))
            .map(|power| format!("1e{power}").parse().unwrap_or(f64::NAN));
        powers.chain(self.values.iter().copied())
    }

    /// Name of the case with this value, for people and for `--only`.
    pub(super) fn case(&self, value: f64) -> String {
        format!("{}, {} = {value:e}", self.name, self.parameter)
    }
}

/// Verdict about a case.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum Verdict {
    /// All numbers are within their tolerances.
    Accurate,
    /// The computation returns the type of error that is expected.
    Refused,
    /// A number is outside its tolerance, an error is returned where there is a solution, or a solution where there is none.
    #[default]
    Wrong,
}

/// A case in the table: result and verdict; [`judge`] fills in which case it is.
#[derive(Debug, Clone, Default, Serialize)]
pub(super) struct Row {
    pub(super) family: String,
    pub(super) parameter: String,
    pub(super) value: f64,
    /// Quantity that was compared; of several the one with the largest deviation over tolerance.
    quantity: String,
    /// The right number, or the pattern of the right error.
    expected: String,
    /// The number that was computed, or the error.
    got: String,
    /// Relative deviation, or in the unit that the case chooses; `None` if an error was returned.
    deviation: Option<f64>,
    /// Largest deviation of an accurate result, in the same unit.
    tolerance: Option<f64>,
    pub(super) verdict: Verdict,
    /// Time on the wall clock \[s].
    pub(super) seconds: f64,
}

impl Row {
    /// Compares a number with the right one. Their difference over `scale` is the deviation.
    pub(super) fn number(
        quantity: &str,
        [got, expected]: [f64; 2],
        scale: f64,
        tolerance: f64,
    ) -> Self {
        let deviation = (got - expected).abs() / scale;
        Self {
            quantity: quantity.to_owned(),
            // Leave out a deviation that is NaN or infinite, because a table has finite numbers only.
            deviation: deviation.is_finite().then_some(deviation),
            tolerance: Some(tolerance),
            verdict: Verdict::Accurate.provided(deviation <= tolerance),
            ..Self::wrong(format!("{expected:e}"), format!("{got:e}"))
        }
    }

    /// Compares a number with the right one, within a relative tolerance.
    pub(super) fn relative(quantity: &str, pair: [f64; 2], tolerance: f64) -> Self {
        Self::number(quantity, pair, pair[1].abs(), tolerance)
    }

    /// The one of several compared numbers with the largest deviation over tolerance.
    pub(super) fn worst(numbers: impl IntoIterator<Item = Self>) -> Self {
        let part = |row: &Self| row.part_of_tolerance().unwrap_or(f64::INFINITY);
        numbers
            .into_iter()
            .max_by(|one, other| part(one).total_cmp(&part(other)))
            .unwrap_or_else(|| Self::wrong("a number", "nothing was compared"))
    }

    /// Judges a problem that must end in an error, of the pattern `expected`; see [`refused!`](super::refused).
    pub(super) fn refusal<T: Debug, E: Display>(
        result: std::result::Result<T, E>,
        expected: &str,
        is_right: impl Fn(&E) -> bool,
    ) -> Self {
        match result {
            // Show the beginning of a solution that should not exist, by which it is recognised.
            Ok(value) => {
                let text: String = format!("{value:?}").chars().take(200).collect();
                Self::wrong(expected, text)
            }
            Err(error) => Self {
                verdict: Verdict::Refused.provided(is_right(&error)),
                ..Self::wrong(expected, error.to_string())
            },
        }
    }

    /// Row of a case, with the verdict `Wrong` unless the caller changes it.
    fn wrong(expected: impl Into<String>, got: impl Into<String>) -> Self {
        Self {
            expected: expected.into(),
            got: got.into(),
            ..Self::default()
        }
    }

    /// A line that says which case is wrong, and how.
    pub(super) fn complaint(&self) -> String {
        let Self {
            family,
            parameter,
            value,
            expected,
            got,
            ..
        } = self;
        format!("{family}, {parameter} = {value:e}: expected {expected}, got {got}")
    }

    /// Deviation over tolerance; `None` where no numbers were compared or the deviation is not finite.
    pub(super) fn part_of_tolerance(&self) -> Option<f64> {
        Some(self.deviation? / self.tolerance?)
    }
}

impl Verdict {
    /// This verdict if the case is `right`, otherwise `Wrong`.
    fn provided(self, right: bool) -> Self {
        if right { self } else { Self::Wrong }
    }
}

/// The row of a problem whose right result is an error that matches a pattern.
macro_rules! refused {
    ($result:expr => $pattern:pat) => {
        Ok($crate::evidence::stability::case::Row::refusal(
            $result,
            stringify!($pattern),
            |error| matches!(error, $pattern),
        ))
    };
}
pub(super) use refused;

/// One value of the parameter of a family.
pub(super) struct Case<'a, F> {
    pub(super) family: &'a Family,
    /// Computes and judges the case with a value of the parameter.
    pub(super) run: F,
    /// The value.
    pub(super) value: f64,
}

/// Runs all cases on all threads; rows in the order of the cases. An error of `run` makes the case wrong.
pub(super) fn judge<F: Fn(f64) -> Result<Row> + Sync>(cases: &[Case<'_, F>]) -> Result<Vec<Row>> {
    in_parallel("stability", cases, |case| {
        let start = Instant::now();
        let row = (case.run)(case.value);
        Ok(Row {
            family: case.family.name.clone(),
            parameter: case.family.parameter.clone(),
            value: case.value,
            seconds: start.elapsed().as_secs_f64(),
            ..row.unwrap_or_else(|error| Row::wrong("a solution", format!("{error:#}")))
        })
    })
}

#[cfg(test)]
mod tests {
    use std::env::VarError;

    use anyhow::anyhow;

    use super::*;

    fn judged(run: impl Fn(f64) -> Result<Row> + Send + Sync + 'static) -> Row {
        let family = &Family::default();
        let rows = judge(&[Case {
            family,
            run,
            value: 1.0,
        }]);
        rows.expect("a row").remove(0)
    }

    fn beside_one(got: f64) -> Row {
        judged(move |one| {
            let number = |quantity, got| Row::relative(quantity, [got, 1.0], 1e-9);
            Ok(Row::worst([number("one", one), number("other", got)]))
        })
    }

    #[test]
    fn only_numbers_within_their_tolerance_and_expected_errors_are_right() {
        let missing = || Err::<(), _>(VarError::NotPresent);
        for (row, expected) in [
            (beside_one(1.0 + 0.9e-9), Verdict::Accurate),
            (beside_one(1.0 + 1.1e-9), Verdict::Wrong),
            (beside_one(1.0 - 1.1e-9), Verdict::Wrong),
            (beside_one(f64::NAN), Verdict::Wrong),
            (beside_one(f64::INFINITY), Verdict::Wrong),
            (judged(|_| Ok(Row::worst([]))), Verdict::Wrong),
            (
                judged(move |_| refused!(missing() => VarError::NotPresent)),
                Verdict::Refused,
            ),
            (
                judged(move |_| refused!(missing() => VarError::NotUnicode(_))),
                Verdict::Wrong,
            ),
            (
                judged(|_| refused!(Ok::<_, VarError>(1) => _)),
                Verdict::Wrong,
            ),
            (judged(|_| Err(anyhow!("no solution"))), Verdict::Wrong),
        ] {
            assert_eq!(row.verdict, expected, "{row:?}");
        }
    }
}
