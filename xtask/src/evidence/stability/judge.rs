//! Runs cases, catches panics, and says of each what it is worth.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::Instant;

use anyhow::{Result, bail};
use serde::Serialize;

use super::case::{Case, Comparison, Family, Finding};
use crate::tasks::in_parallel;

/// What a case is worth.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum Verdict {
    /// All numbers within their tolerances.
    Accurate,
    /// The typed error that is right.
    Refused,
    /// A number outside its tolerance, an error where there is a solution, a solution where there is none, a panic.
    Wrong,
}

/// One case in the table.
#[derive(Debug, Clone, Serialize)]
pub(super) struct Row {
    pub(super) family: &'static str,
    pub(super) parameter: &'static str,
    pub(super) value: String,
    /// Of several numbers the one that is closest to its tolerance.
    quantity: String,
    pub(super) expected: String,
    pub(super) got: String,
    deviation: Option<f64>,
    tolerance: Option<f64>,
    pub(super) verdict: Verdict,
    pub(super) seconds: f64,
}

impl Row {
    /// Deviation as a part of what is allowed, where numbers were compared.
    pub(super) fn part_of_tolerance(&self) -> Option<f64> {
        Some(part(self.deviation?, self.tolerance?))
    }

    fn judge(self, finding: Result<Finding>) -> Self {
        let refused = |expected: &str, got, right| Self {
            expected: expected.to_owned(),
            got,
            verdict: if right {
                Verdict::Refused
            } else {
                Verdict::Wrong
            },
            ..self.clone()
        };
        match finding {
            Err(error) => refused("a solution", format!("{error:#}"), false),
            Ok(Finding::Refusal {
                expected,
                got,
                right,
            }) => refused(expected, got, right),
            Ok(Finding::Values(comparisons)) => {
                let part = Comparison::part_of_tolerance;
                let worst = comparisons
                    .iter()
                    .max_by(|one, other| part(one).total_cmp(&part(other)));
                match worst {
                    Some(worst) => self.compare(worst),
                    None => refused("a number", "nothing was compared".to_owned(), false),
                }
            }
        }
    }

    fn compare(self, comparison: &Comparison) -> Self {
        let deviation = comparison.deviation();
        Self {
            quantity: comparison.quantity.clone(),
            expected: format!("{:e}", comparison.expected),
            got: format!("{:e}", comparison.got),
            // NaN and infinity are no numbers of a table.
            deviation: deviation.is_finite().then_some(deviation),
            tolerance: Some(comparison.tolerance),
            verdict: if deviation <= comparison.tolerance {
                Verdict::Accurate
            } else {
                Verdict::Wrong
            },
            ..self
        }
    }
}

impl Comparison {
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
}

/// No deviation is within any tolerance, even none.
fn part(deviation: f64, tolerance: f64) -> f64 {
    if deviation == 0.0 {
        return 0.0;
    }
    deviation / tolerance
}

/// Runs all cases on all threads; rows in the order of the cases.
pub(super) fn judge(families: &[Family]) -> Vec<Row> {
    let cases: Vec<(&Family, &Case)> = families
        .iter()
        .flat_map(|family| family.cases.iter().map(move |case| (family, case)))
        .collect();
    // A panic is a row of the table, not a message between them.
    let usual_hook = std::panic::take_hook();
    std::panic::set_hook(Box::new(|_| {}));
    let rows = in_parallel("stability", &cases, |(family, case)| row(family, case));
    std::panic::set_hook(usual_hook);
    rows
}

fn row(family: &Family, case: &Case) -> Row {
    let start = Instant::now();
    let finding = catch_unwind(AssertUnwindSafe(|| (case.run)()));
    let finding = finding.unwrap_or_else(|panic| bail!("panic: {}", message(panic.as_ref())));
    let row = Row {
        family: family.name,
        parameter: family.parameter,
        value: case.value.clone(),
        quantity: String::new(),
        expected: String::new(),
        got: String::new(),
        deviation: None,
        tolerance: None,
        verdict: Verdict::Wrong,
        seconds: start.elapsed().as_secs_f64(),
    };
    row.judge(finding)
}

fn message(panic: &(dyn Any + Send)) -> &str {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    let text = text.or_else(|| panic.downcast_ref::<&str>().copied());
    text.unwrap_or("without a message")
}

#[cfg(test)]
mod tests {
    use rheology::{RheologyError, Viscous};

    use super::super::case::{compare, refused};
    use super::*;

    fn verdict(run: impl Fn() -> Result<Finding> + Send + Sync + 'static) -> Row {
        let family = Family::of("test", "none", vec![Case::new("only", run)]);
        judge(&[family]).remove(0)
    }

    #[test]
    fn only_numbers_within_their_tolerance_are_accurate() {
        for (got, expected) in [
            (1.0 + 0.9e-9, Verdict::Accurate),
            (1.0 + 1.1e-9, Verdict::Wrong),
            (1.0 - 1.1e-9, Verdict::Wrong),
            (f64::NAN, Verdict::Wrong),
            (f64::INFINITY, Verdict::Wrong),
        ] {
            let row =
                verdict(move || compare!(within 1e-9; "one" => 1.0, 1.0; "other" => got, 1.0));
            assert_eq!(row.verdict, expected, "{got}: {row:?}");
        }
        let row = verdict(|| Ok(Finding::Values(Vec::new())));
        assert_eq!(row.verdict, Verdict::Wrong, "nothing compared: {row:?}");
    }

    #[test]
    fn only_the_error_that_was_expected_is_the_right_refusal() {
        let right =
            verdict(|| refused!(Viscous::new(0.0) => RheologyError::InvalidParameter { .. }));
        assert_eq!(right.verdict, Verdict::Refused, "{right:?}");
        let other = verdict(|| refused!(Viscous::new(0.0) => RheologyError::NoStiffness));
        assert_eq!(other.verdict, Verdict::Wrong, "{other:?}");
        let none = verdict(|| refused!(Viscous::new(1.0) => RheologyError::NoStiffness));
        assert_eq!(none.verdict, Verdict::Wrong, "{none:?}");
        let unexpected = verdict(|| {
            Viscous::new(0.0)?;
            Ok(Finding::Values(Vec::new()))
        });
        assert_eq!(unexpected.verdict, Verdict::Wrong, "{unexpected:?}");
    }

    #[test]
    fn a_panic_is_a_wrong_row_with_its_message() {
        let row = verdict(|| panic!("cell {}", 7));
        assert_eq!(row.verdict, Verdict::Wrong, "{row:?}");
        assert_eq!(row.got, "panic: cell 7", "{row:?}");
    }
}
