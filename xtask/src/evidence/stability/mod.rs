//! Stiff and extreme cases of every method, each judged against an exact or converged value, or against the typed error
//! that is right.

mod case;
mod cone_on_solid;
mod families;
mod half_space;
mod line;

use anyhow::{Result, ensure};
use clap::Args;
use viscofriction_plot::{Axis, Chart, Colour, Dash, Figure, Shape};

use super::Report;
use crate::output::WrongInput;
use crate::picture::{chart, guide, markers};
use crate::table::{Column, Table, table_of};
use case::{Case, Family, Row, Verdict};
use families::Run;

/// Which cases.
#[derive(Debug, Default, Args)]
pub(super) struct Options {
    /// Only cases that contain this in 'family, parameter = value'; the picture then shows no others.
    #[arg(long, value_name = "TEXT")]
    only: Option<String>,
}

/// Ratio of deviation to tolerance at which smaller ones are drawn, because zero has no place on a logarithmic axis. Chosen.
const MIN_DRAWN_PART: f64 = 1e-9;

/// Runs all cases, also in a quick run.
pub(super) fn report(options: &Options) -> Result<Report> {
    let families = families::all()?;
    report_of(&case::judge(&chosen(&families, options)?)?)
}

/// The report on judged cases; it fails if one of them is wrong.
fn report_of(rows: &[Row]) -> Result<Report> {
    let wrong = rows.iter().filter(|row| row.verdict == Verdict::Wrong);
    let wrong: Vec<String> = wrong.map(Row::complaint).collect();
    let (bad, all, which) = (wrong.len(), rows.len(), wrong.join("\n"));
    let failure = format!("{bad} of {all} cases are wrong\n{which}");
    Ok(Report {
        name: "stability",
        tables: vec![Table::new("stability", rows)?],
        pictures: vec![("stability", picture(rows))],
        summary: table_of(&columns(), rows.chunk_by(|a, b| a.family == b.family)).to_string(),
        failure: (!wrong.is_empty()).then_some(failure),
    })
}

/// The cases whose name contains the text asked for; fails where there is none.
fn chosen<'a>(families: &'a [(Family, Run)], options: &Options) -> Result<Vec<Case<'a, Run>>> {
    let text = options.only.as_deref().unwrap_or_default();
    let mut cases = Vec::new();
    for (family, run) in families {
        let is_asked = |value: &f64| family.case(*value).contains(text);
        let values = family.values().filter(is_asked);
        let run = *run;
        cases.extend(values.map(|value| Case { family, run, value }));
    }
    let wrong = format!("--only {text:?} is in no case");
    ensure!(!cases.is_empty(), WrongInput(wrong));
    Ok(cases)
}

/// Number of cases with a verdict, as a cell.
fn count(rows: &[Row], verdict: Verdict) -> String {
    let of_verdict = rows.iter().filter(|row| row.verdict == verdict);
    of_verdict.count().to_string()
}

/// Columns of the table with one line per family.
fn columns<'a>() -> [Column<&'a [Row]>; 8] {
    [
        ("family", |rows| rows[0].family.clone()),
        ("parameter", |rows| rows[0].parameter.clone()),
        ("cases", |rows| rows.len().to_string()),
        ("accurate", |rows| count(rows, Verdict::Accurate)),
        ("refused", |rows| count(rows, Verdict::Refused)),
        ("wrong", |rows| count(rows, Verdict::Wrong)),
        ("largest deviation/tolerance", |rows| {
            let parts = rows.iter().filter_map(Row::part_of_tolerance);
            let largest = parts.reduce(f64::max).map(|part| format!("{part:.1e}"));
            largest.unwrap_or_default()
        }),
        ("s", |rows| {
            let seconds: f64 = rows.iter().map(|row| row.seconds).sum();
            format!("{seconds:.2}")
        }),
    ]
}

/// All cases over the decimal logarithm of their parameter, those beyond 10^±13 in a panel of their own.
fn picture(rows: &[Row]) -> Figure {
    let is_usual = |row: &&Row| row.value.log10().abs() < 13.0;
    let (usual, ends): (Vec<&Row>, Vec<&Row>) = rows.iter().partition(is_usual);
    let panels = [(usual, 13.0), (ends, 330.0)]
        .into_iter()
        .filter(|(rows, _)| !rows.is_empty())
        .map(|(rows, end)| panel(&rows, end));
    Figure::new(panels, 2)
}

/// Ratio of deviation to tolerance as a function of the decimal logarithm of the parameter, from −`end` to `end`.
fn panel(rows: &[&Row], end: f64) -> Chart {
    let kinds = [
        ("theorem", Shape::Circle, Colour::Black),
        ("line", Shape::Circle, Colour::Blue),
        ("half space", Shape::Square, Colour::Green),
        ("refused by the right error", Shape::Plus, Colour::Magenta),
        ("wrong", Shape::Diamond, Colour::Red),
    ];
    let tolerance = guide([-end, end].map(|x| [x, 1.0]), Dash::Dashed);
    let of_kinds = kinds.into_iter().filter_map(|(kind, shape, colour)| {
        let of_kind = rows.iter().filter(|row| match row.verdict {
            Verdict::Accurate => row.family.starts_with(kind),
            Verdict::Refused => kind.starts_with("refused"),
            Verdict::Wrong => kind == "wrong",
        });
        let points = of_kind.map(|row| [row.value.log10(), height(row)]);
        let points: Vec<_> = points.collect();
        let label = format!("{kind}: {}", points.len());
        markers(points, shape, colour, &label)
    });
    let series = [tolerance].into_iter().chain(of_kinds).collect();
    let x = Axis::linear("log₁₀ of the parameter", [-end, end]);
    let y = Axis::log10("deviation / tolerance", [0.1 * MIN_DRAWN_PART, 100.0]);
    chart(x, y, series)
}

/// Ordinate of a case: deviation over tolerance of an accurate one; fixed places above the tolerance of the others.
fn height(row: &Row) -> f64 {
    match row.verdict {
        Verdict::Accurate => row.part_of_tolerance().unwrap_or(0.0).max(MIN_DRAWN_PART),
        Verdict::Refused => 5.0,
        Verdict::Wrong => 20.0,
    }
}

#[cfg(test)]
mod tests {
    use super::case::judge;
    use super::*;

    #[test]
    fn a_wrong_case_fails_the_experiment_and_is_named() {
        let family: Family = toml::from_str("name = 'line, test'\nparameter = 'p'").expect("TOML");
        let beside_one = |p| Ok(Row::relative("p", [p, 1.0], 1e-9));
        let cases = [1.0, 2.0].map(|value| Case {
            family: &family,
            run: beside_one,
            value,
        });
        let rows = judge(&cases).expect("rows");
        let report = report_of(&rows).expect("a report");
        let expected = "1 of 2 cases are wrong\nline, test, p = 2e0: expected 1e0, got 2e0";
        assert_eq!(report.failure.as_deref(), Some(expected), "{report:?}");
        let report = report_of(&rows[..1]).expect("a report");
        assert_eq!(report.failure, None, "nothing is wrong");
    }
}
