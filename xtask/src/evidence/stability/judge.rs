//! Runs cases, catches panics, and says of each what it is worth.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::Instant;

use anyhow::{Result, anyhow};

use super::case::{Case, Family, Finding};
use crate::tasks::in_parallel;

/// Runs all cases on all threads; findings in the order of the cases.
pub(super) fn judge(families: &[Family]) -> Result<Vec<Finding>> {
    let cases: Vec<(&Family, &Case)> = families
        .iter()
        .flat_map(|family| family.cases.iter().map(move |case| (family, case)))
        .collect();
    // A panic is a row of the table, not a message between them.
    let usual_hook = std::panic::take_hook();
    std::panic::set_hook(Box::new(|_| {}));
    let rows = in_parallel("stability", &cases, |(family, case)| Ok(row(family, case)));
    std::panic::set_hook(usual_hook);
    rows
}

fn row(family: &Family, case: &Case) -> Finding {
    let start = Instant::now();
    let finding = catch_unwind(AssertUnwindSafe(|| (case.run)()));
    let finding = finding.unwrap_or_else(|panic| Err(anyhow!("panic: {}", message(&*panic))));
    let unexpected = |error| Finding::wrong("a solution", format!("{error:#}"));
    Finding {
        family: family.name,
        parameter: family.parameter,
        value: case.value.clone(),
        seconds: start.elapsed().as_secs_f64(),
        ..finding.unwrap_or_else(unexpected)
    }
}

fn message(panic: &(dyn Any + Send)) -> &str {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    let text = text.or_else(|| panic.downcast_ref::<&str>().copied());
    text.unwrap_or("without a message")
}

#[cfg(test)]
mod tests {
    use rheology::{RheologyError, Viscous};

    use super::super::case::{Verdict, compare, refused};
    use super::*;

    fn finding(run: impl Fn() -> Result<Finding> + Send + Sync + 'static) -> Finding {
        let family = Family::of("test", "none", vec![Case::new("only", run)]);
        judge(&[family]).expect("a finding").remove(0)
    }

    fn beside_one(got: f64) -> Finding {
        finding(move || compare!(within 1e-9; "one" => 1.0, 1.0; "other" => got, 1.0))
    }

    #[test]
    fn only_numbers_within_their_tolerance_and_expected_errors_are_right() {
        let invalid =
            || finding(|| refused!(Viscous::new(0.0) => RheologyError::InvalidParameter(_)));
        let other = |viscosity| {
            finding(move || refused!(Viscous::new(viscosity) => RheologyError::NoStiffness))
        };
        let unexpected = || {
            Viscous::new(0.0)?;
            compare!(within 1e-9; "one" => 1.0, 1.0)
        };
        for (finding, expected) in [
            (beside_one(1.0 + 0.9e-9), Verdict::Accurate),
            (beside_one(1.0 + 1.1e-9), Verdict::Wrong),
            (beside_one(1.0 - 1.1e-9), Verdict::Wrong),
            (beside_one(f64::NAN), Verdict::Wrong),
            (beside_one(f64::INFINITY), Verdict::Wrong),
            (finding(|| Ok(Finding::of(&[]))), Verdict::Wrong),
            (invalid(), Verdict::Refused),
            (other(0.0), Verdict::Wrong),
            (other(1.0), Verdict::Wrong),
            (finding(unexpected), Verdict::Wrong),
        ] {
            assert_eq!(finding.verdict, expected, "{finding:?}");
        }
    }

    #[test]
    fn a_panic_is_a_wrong_row_with_its_message() {
        let row = finding(|| panic!("cell {}", 7));
        assert_eq!(row.verdict, Verdict::Wrong, "{row:?}");
        assert_eq!(row.got, "panic: cell 7", "{row:?}");
    }
}
