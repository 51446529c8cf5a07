//! The table of constants: between which values nothing changes, and what changes beyond.

use super::cases::Case;
use super::{Outcome, Row};
use crate::table::{known_digits, markdown_table};

/// Largest ratio of processor times that counts as no change; the smallest is its inverse. Chosen: processor times of equal
/// runs scatter by some per cent, more while other programs run.
pub(super) const MAX_TIME_RATIO: f64 = 1.25;
/// Largest ratio of processor times that counts as no change for runs shorter than [`SHORT_RUN_SECONDS`]. Chosen: their times
/// scatter by the steps of the clock.
const MAX_TIME_RATIO_OF_SHORT_RUNS: f64 = 1.5;
/// Processor time below which a run is short, \[s]. Chosen: three of the steps of 10 ms in which Linux counts.
const SHORT_RUN_SECONDS: f64 = 0.03;
/// Largest ratio of error bars that counts as no change; the smallest is its inverse. Chosen, since a bar is an estimate.
const MAX_BAR_RATIO: f64 = 2.0;

/// Table in Markdown with one row for each constant, from the rows of all its cases.
pub(super) fn summary(cases: &[&Case], rows: &[Row]) -> String {
    let header = "constant|present|nothing changes|what changes|scenes";
    let lines = cases.iter().map(|case| {
        let of_value = case.tried().map(|tried| {
            let measured: Vec<_> = rows.iter().filter(|row| row.is_of(&tried)).collect();
            (tried.value, changes(&measured))
        });
        let of_value: Vec<_> = of_value.collect();
        // Find on either side the last value before the first that changes something.
        let (smaller, larger) = of_value.split_at(case.smaller.len());
        let [low, high] = [smaller, larger].map(|values| {
            let harmless = values.iter().take_while(|(_, changes)| changes.is_empty());
            harmless.last().map_or(&*case.present, |(value, _)| value)
        });
        let range = if low == high {
            String::new()
        } else {
            format!("{low} to {high}")
        };
        let found = of_value.iter().filter(|(_, changes)| !changes.is_empty());
        let found: Vec<String> = found
            .map(|(value, changes)| format!("{value}: {}", changes.join(", ")))
            .collect();
        let mut of_case = rows.iter().filter(|row| row.constant == case.constant);
        let changed = if of_case.all(|row| row.outcome == Outcome::Same) && found.is_empty() {
            "no digit of any answer".to_owned()
        } else {
            found.join("; ")
        };
        [
            format!("`{}`", case.constant),
            case.present.clone(),
            range,
            changed,
            case.scenes.join(", "),
        ]
    });
    markdown_table(header.split('|'), lines).to_string()
}

/// What one value of a constant changes, in words, each with the scene where it changes most; empty if nothing. `rows` are
/// those of this value.
fn changes(rows: &[&Row]) -> Vec<String> {
    let mut changes = Vec::new();
    for (outcome, verb) in [
        (Outcome::Refused, "refused"),
        (Outcome::Unfinished, "not finished"),
    ] {
        let failed = rows.iter().find(|row| row.outcome == outcome);
        changes.extend(failed.map(|row| format!("{verb} ({})", row.scene)));
    }
    let wrong = rows
        .iter()
        .filter(|row| row.outcome == Outcome::OutsideBar && row.present_deviation_over_bar <= 1.0);
    let deviations = wrong.filter_map(|row| Some((row.deviation_over_bar?, &row.scene)));
    let worst = deviations.max_by(|one, other| one.0.total_cmp(&other.0));
    changes.extend(
        worst.map(|(bars, scene)| format!("error of {} bars ({scene})", known_digits(bars, None))),
    );

    let bars = rows.iter().filter_map(|row| {
        let bar = row.value_error.filter(|bar| *bar > 0.0)?;
        Change::beyond(MAX_BAR_RATIO, bar / row.present_value_error, &row.scene)
    });
    changes.extend(Change::largest("bar", bars));
    // Compare times only where the answer has changed. Where the digits are the same the work is the same, and times differ by
    // what else the machine did.
    let changed = rows
        .iter()
        .filter(|row| row.value.is_some() && row.outcome != Outcome::Same);
    let times = changed.filter_map(|row| {
        let present = row.present_processor_seconds;
        let limit = if present < SHORT_RUN_SECONDS {
            MAX_TIME_RATIO_OF_SHORT_RUNS
        } else {
            MAX_TIME_RATIO
        };
        Change::beyond(limit, row.processor_seconds / present, &row.scene)
    });
    changes.extend(Change::largest("time", times));
    changes
}

/// Ratio of a quantity of a scene to that with the present value of the constant.
struct Change<'a> {
    ratio: f64,
    scene: &'a str,
}

impl<'a> Change<'a> {
    /// The change if the ratio is beyond the limit in either direction.
    fn beyond(limit: f64, ratio: f64, scene: &'a str) -> Option<Self> {
        let is_beyond = ratio > limit || ratio < limit.recip();
        is_beyond.then_some(Self { ratio, scene })
    }

    /// The change whose ratio is farthest from 1, in words.
    fn largest(quantity: &str, changes: impl Iterator<Item = Self>) -> Option<String> {
        let distance = |change: &Self| change.ratio.ln().abs();
        let largest = changes.max_by(|one, other| distance(one).total_cmp(&distance(other)))?;
        let Self { ratio, scene } = largest;
        Some(format!("{quantity} × {ratio:.2} ({scene})"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(tried: &str, outcome: Outcome, bars: f64, time: f64) -> Row {
        Row {
            constant: "RATIO".to_owned(),
            present: "1.0".to_owned(),
            tried: tried.to_owned(),
            scene: "cone".to_owned(),
            quantity: "friction_coefficient".to_owned(),
            outcome,
            value: (outcome != Outcome::Refused).then_some(1.0),
            value_error: (outcome != Outcome::Refused).then_some(0.1),
            present_value: 1.0,
            present_value_error: 0.1,
            reference: 1.0,
            reference_error: 0.0,
            deviation_over_bar: Some(bars),
            present_deviation_over_bar: 0.5,
            unknowns: None,
            present_unknowns: None,
            iterations: None,
            present_iterations: None,
            processor_seconds: time,
            present_processor_seconds: 1.0,
        }
    }

    #[test]
    fn the_range_ends_before_the_first_value_that_changes_something() {
        let text = r#"
            constant = "RATIO"
            source = "a.rs"
            present = "1.0"
            smaller = ["0.5", "0.25", "0.125"]
            larger = ["2.0", "4.0"]
            scenes = ["cone"]
        "#;
        let case: Case = toml::from_str(text).expect("a case");
        let rows = [
            row("0.5", Outcome::Same, 0.5, 1.05),
            row("0.25", Outcome::OutsideBar, 3.0, 1.0),
            row("0.125", Outcome::Same, 0.5, 1.0),
            row("2.0", Outcome::InsideBar, 0.9, 1.5),
            row("4.0", Outcome::Refused, 0.5, 1.0),
        ];
        let table = summary(&[&case], &rows);
        let cells: Vec<&str> = table
            .lines()
            .nth(2)
            .expect("a row")
            .split('|')
            .map(str::trim)
            .collect();
        let expected = "0.25: error of 3 bars (cone); 2.0: time × 1.50 (cone); 4.0: refused (cone)";
        assert_eq!(
            cells[1..5],
            ["`RATIO`", "1.0", "0.5 to 1.0", expected],
            "{table}"
        );
    }
}
