//! Runs cases, catches panics, and says of each what it is worth.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::Instant;

use anyhow::Result;
use rayon::prelude::*;
use serde::Serialize;

use crate::progress;
use crate::stability::case::{Case, Comparison, Family, Outcome};

/// What a case is worth.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub(super) enum Verdict {
    /// All numbers within their tolerances.
    Accurate,
    /// The typed error that is right.
    Refused,
    /// A number outside its tolerance, an error where there is an answer, an answer where there is none, a panic.
    Wrong,
}

/// One case in the table.
#[derive(Debug, Clone, Serialize)]
pub(super) struct Row {
    pub(super) family: &'static str,
    pub(super) parameter: &'static str,
    pub(super) value: String,
    /// Of several numbers the one that is closest to its tolerance.
    quantity: &'static str,
    pub(super) expected: String,
    pub(super) got: String,
    pub(super) deviation: Option<f64>,
    pub(super) tolerance: Option<f64>,
    pub(super) verdict: Verdict,
    pub(super) seconds: f64,
}

impl Row {
    /// Deviation as a part of what is allowed, where numbers were compared.
    pub(super) fn part_of_tolerance(&self) -> Option<f64> {
        let (deviation, tolerance) = self.deviation.zip(self.tolerance)?;
        Some(if deviation > 0.0 {
            deviation / tolerance
        } else {
            0.0
        })
    }
}

/// Runs all cases on all threads; rows in the order of the cases.
pub(super) fn judge(families: &[Family]) -> Vec<Row> {
    let cases: Vec<(&Family, &Case)> = families
        .iter()
        .flat_map(|family| family.cases.iter().map(move |case| (family, case)))
        .collect();
    let bar = progress::bar("stability", cases.len());
    // A panic is a row of the table, not a message between them.
    let usual_hook = std::panic::take_hook();
    std::panic::set_hook(Box::new(|_| {}));
    let rows = cases
        .into_par_iter()
        .with_max_len(1)
        .map(|(family, case)| {
            let row = row(family, case);
            bar.inc(1);
            row
        })
        .collect();
    std::panic::set_hook(usual_hook);
    bar.finish_and_clear();
    rows
}

fn row(family: &Family, case: &Case) -> Row {
    let start = Instant::now();
    let outcome = catch_unwind(AssertUnwindSafe(|| (case.run)()));
    let unjudged = Row {
        family: family.name,
        parameter: family.parameter,
        value: case.value.clone(),
        quantity: "",
        expected: "an answer".to_owned(),
        got: String::new(),
        deviation: None,
        tolerance: None,
        verdict: Verdict::Wrong,
        seconds: start.elapsed().as_secs_f64(),
    };
    match outcome {
        Err(panic) => Row {
            got: format!("panic: {}", message(panic.as_ref())),
            ..unjudged
        },
        Ok(outcome) => judged(outcome, unjudged),
    }
}

fn judged(outcome: Result<Outcome>, row: Row) -> Row {
    match outcome {
        Err(error) => Row {
            got: format!("{error:#}"),
            ..row
        },
        Ok(Outcome::Refusal {
            expected,
            got,
            right,
        }) => Row {
            expected: expected.to_owned(),
            got,
            verdict: if right {
                Verdict::Refused
            } else {
                Verdict::Wrong
            },
            ..row
        },
        Ok(Outcome::Values(comparisons)) => match worst(&comparisons) {
            None => Row {
                got: "nothing was compared".to_owned(),
                ..row
            },
            Some(comparison) => compared(comparison, row),
        },
    }
}

fn compared(comparison: &Comparison, row: Row) -> Row {
    let deviation = deviation(comparison);
    Row {
        quantity: comparison.quantity,
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
        ..row
    }
}

fn deviation(comparison: &Comparison) -> f64 {
    let difference = (comparison.got - comparison.expected).abs();
    if difference == 0.0 {
        return 0.0;
    }
    difference / comparison.scale
}

/// The comparison with the largest deviation as part of its tolerance; one that is not a number counts as largest.
fn worst(comparisons: &[Comparison]) -> Option<&Comparison> {
    let part = |comparison: &&Comparison| {
        let deviation = deviation(comparison);
        match deviation / comparison.tolerance {
            _ if deviation == 0.0 => 0.0,
            part if part.is_nan() => f64::INFINITY,
            part => part,
        }
    };
    comparisons
        .iter()
        .max_by(|one, other| part(one).total_cmp(&part(other)))
}

fn message(panic: &(dyn Any + Send)) -> String {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    let text = text.or_else(|| panic.downcast_ref::<&str>().copied());
    text.unwrap_or("without a message").to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn verdict(run: impl Fn() -> Result<Outcome> + Send + Sync + 'static) -> Row {
        let family = Family {
            name: "test",
            parameter: "none",
            cases: vec![Case::new("only", run)],
            slow: false,
        };
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
            let pairs = [("one", [1.0, 1.0]), ("other", [got, 1.0])];
            let row = verdict(move || Ok(Outcome::relative(&pairs, 1e-9)));
            assert_eq!(row.verdict, expected, "{got}: {row:?}");
        }
        let row = verdict(|| Ok(Outcome::Values(Vec::new())));
        assert_eq!(row.verdict, Verdict::Wrong, "nothing compared: {row:?}");
    }

    #[test]
    fn only_the_error_that_was_expected_counts_as_refused() {
        use crate::stability::case::refused;
        use rheology::{RheologyError, Viscous};
        let right = verdict(|| {
            let viscous = Viscous::new(0.0);
            Ok(refused!(viscous, RheologyError::InvalidParameter { .. }))
        });
        assert_eq!(right.verdict, Verdict::Refused, "{right:?}");
        let other = verdict(|| Ok(refused!(Viscous::new(0.0), RheologyError::NoStiffness)));
        assert_eq!(other.verdict, Verdict::Wrong, "{other:?}");
        let none = verdict(|| Ok(refused!(Viscous::new(1.0), RheologyError::NoStiffness)));
        assert_eq!(none.verdict, Verdict::Wrong, "{none:?}");
        let unexpected = verdict(|| {
            Viscous::new(0.0)?;
            Ok(Outcome::Values(Vec::new()))
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
