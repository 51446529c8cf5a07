//! Stiff and extreme cases of every method, each judged against an exact or converged value, or against the typed error
//! that is right.

mod case;
mod cone_on_solid;
mod families;
mod half_space;
mod line;
mod range;

use anyhow::{Result, ensure};
use clap::Args;
use viscofriction_plot::{
    Axis, Chart, Colour, Dash, Figure, LegendPlace, Line, Marker, Series, Shape,
};

use super::{Report, Table};
use crate::output::{WrongInput, markdown_table};
use case::{Cost, Family, Row, Verdict};

/// Which cases.
#[derive(Debug, Default, Args)]
pub(super) struct Options {
    /// Only cases that contain this in 'family, parameter = value'; the picture then shows no others.
    #[arg(long, value_name = "TEXT")]
    only: Option<String>,
}

/// A quick run takes one case of so many.
const QUICK: usize = 3;
/// Smaller parts of the tolerance are drawn as this one.
const SMALLEST: f64 = 1e-9;

/// Runs all cases; a quick run takes every third case of the cheap families.
pub(super) fn report(options: &Options, quick: bool) -> Result<Report> {
    report_of(&chosen(options, quick)?)
}

fn report_of(families: &[Family]) -> Result<Report> {
    let rows = case::judge(families)?;
    let wrong: Vec<String> = rows.iter().filter_map(complaint).collect();
    let (bad, all, which) = (wrong.len(), rows.len(), wrong.join("\n"));
    let failure = format!("{bad} of {all} cases are wrong\n{which}");
    Ok(Report {
        name: "stability",
        tables: vec![Table::new("stability", &rows)?],
        pictures: vec![("stability", picture(&rows))],
        summary: summary(&rows),
        failure: (!wrong.is_empty()).then_some(failure),
    })
}

/// What is wrong with a case.
fn complaint(row: &Row) -> Option<String> {
    let name = name([row.family, row.parameter], row.value);
    let text = format!("{name}: expected {}, got {}", row.expected, row.got);
    (row.verdict == Verdict::Wrong).then_some(text)
}

fn name([family, parameter]: [&str; 2], value: f64) -> String {
    format!("{family}, {parameter} = {value:e}")
}

/// The families that are asked for.
fn chosen(options: &Options, quick: bool) -> Result<Vec<Family>> {
    let mut families = families::all();
    if quick {
        families.retain(|family| family.cost == Cost::Cheap);
    }
    for family in &mut families {
        let step = if quick { QUICK } else { 1 };
        family.values = family.values.iter().copied().step_by(step).collect();
        if let Some(text) = &options.only {
            let names = [family.name, family.parameter];
            let values = &mut family.values;
            values.retain(|value| name(names, *value).contains(text));
        }
    }
    families.retain(|family| !family.values.is_empty());
    let text = options.only.as_deref().unwrap_or_default();
    let wrong = format!("--only {text:?} is in no case");
    ensure!(!families.is_empty(), WrongInput(wrong));
    Ok(families)
}

fn count(rows: &[Row], verdict: Verdict) -> usize {
    rows.iter().filter(|row| row.verdict == verdict).count()
}

/// One line per family.
fn summary(rows: &[Row]) -> String {
    let header = "family|parameter|cases|accurate|refused|wrong|largest deviation/tolerance|s";
    let key = |row: &Row| [row.family, row.parameter];
    let families = rows.chunk_by(|one, other| key(one) == key(other));
    let lines = families.map(|rows| {
        let parts = rows.iter().filter_map(Row::part_of_tolerance);
        let seconds: f64 = rows.iter().map(|row| row.seconds).sum();
        let largest = parts.reduce(f64::max);
        [
            rows[0].family.to_owned(),
            rows[0].parameter.to_owned(),
            rows.len().to_string(),
            count(rows, Verdict::Accurate).to_string(),
            count(rows, Verdict::Refused).to_string(),
            count(rows, Verdict::Wrong).to_string(),
            largest.map_or_else(String::new, |part| format!("{part:.1e}")),
            format!("{seconds:.2}"),
        ]
    });
    markdown_table(header.split('|'), lines).to_string()
}

/// All cases over the decade of their parameter, those at the ends of floating-point numbers in a panel of their own.
fn picture(rows: &[Row]) -> Figure {
    let [usual, ends]: [Vec<&Row>; 2] = rows
        .iter()
        .partition(|row| row.value.log10().abs() < 13.0)
        .into();
    let panels = [(usual, 13.0), (ends, 330.0)].into_iter();
    let panels = panels.filter(|(rows, _)| !rows.is_empty());
    Figure::new(panels.map(|(rows, end)| panel(&rows, end)), 2)
}

/// Deviations over decades from −`end` to `end`; what has none stands above the tolerance.
fn panel(rows: &[&Row], end: f64) -> Chart {
    let kinds = [
        ("theorem", Shape::Circle, Colour::Black),
        ("line", Shape::Circle, Colour::Blue),
        ("half space", Shape::Square, Colour::Green),
        ("refused by the right error", Shape::Plus, Colour::Magenta),
        ("wrong", Shape::Diamond, Colour::Red),
    ];
    let ends = vec![[-end, 1.0], [end, 1.0]];
    let tolerance = Series::line(ends, Line::thin(Dash::Dashed), Colour::Black);
    let mut series = vec![tolerance];
    for (kind, shape, colour) in kinds {
        let of_kind = rows.iter().filter(|row| match row.verdict {
            Verdict::Accurate => row.family.starts_with(kind),
            Verdict::Refused => kind.starts_with("refused"),
            Verdict::Wrong => kind == "wrong",
        });
        let points: Vec<_> = of_kind
            .map(|row| [row.value.log10(), height(row)])
            .collect();
        if !points.is_empty() {
            let label = format!("{kind}: {}", points.len());
            series.push(Series::markers(points, Marker::open(shape), colour).labelled(label));
        }
    }
    let x = Axis::linear("log₁₀ of the parameter", [-end, end]);
    let y = Axis::log10("deviation / tolerance", [0.1 * SMALLEST, 100.0]);
    Chart {
        legend: LegendPlace::Below,
        ..Chart::new(x, y, series)
    }
}

/// Where a case stands: an accurate one at its part of the tolerance, the others above all of these.
fn height(row: &Row) -> f64 {
    match row.verdict {
        Verdict::Accurate => row.part_of_tolerance().unwrap_or(0.0).max(SMALLEST),
        Verdict::Refused => 5.0,
        Verdict::Wrong => 20.0,
    }
}

#[cfg(test)]
mod tests {
    use super::case::{compare, families};
    use super::*;

    #[test]
    fn a_wrong_case_fails_the_experiment_and_is_named() {
        let families = families! {
            Cheap "line, test", "p", [1.0, 2.0] => |p| compare!(within 1e-9; "p" => p, 1.0);
        };
        let report = report_of(&families).expect("a report");
        let expected = "1 of 2 cases are wrong\nline, test, p = 2e0: expected 1e0, got 2e0";
        assert_eq!(report.failure.as_deref(), Some(expected), "{report:?}");
        let report = report_of(&families[..0]).expect("a report");
        assert_eq!(report.failure, None, "nothing is wrong");
    }
}
