//! Stiff and extreme cases of every method, each judged against an exact or converged value, or against the typed error
//! that is right.

mod case;
mod cone_on_solid;
mod contacts;
mod families;
mod half_space;
mod judge;
mod line;
mod materials;
mod range;
mod refusals;
mod units;

use anyhow::Result;
use clap::Args;
use viscofriction_plot::{Cell, Colour, ColourScale, Figure, Matrix, MatrixRow};

use super::{Report, Table};
use crate::output::{WrongInput, markdown_table};
use case::{Case, Cost, Family, Finding, Verdict};

/// Which cases.
#[derive(Debug, Default, Args)]
pub(super) struct Options {
    /// Only cases that contain this in 'family, parameter = value'; the picture then shows no others.
    #[arg(long, value_name = "TEXT")]
    only: Option<String>,
}

/// A quick run takes one case of so many.
const QUICK: usize = 3;
/// Deviations below 10^this of their tolerance have the darkest colour.
const DARKEST: f64 = -6.0;

/// Runs all cases; a quick run takes every third case of the cheap families.
pub(super) fn report(options: &Options, quick: bool) -> Result<Report> {
    let rows = judge::judge(&chosen(options, quick)?)?;
    let key = |row: &Finding| (row.family, row.parameter);
    let families: Vec<&[Finding]> = rows.chunk_by(|one, other| key(one) == key(other)).collect();
    let wrong: Vec<String> = rows.iter().filter_map(complaint).collect();
    let (bad, all, which) = (wrong.len(), rows.len(), wrong.join("\n"));
    let failure = format!("{bad} of {all} cases are wrong\n{which}");
    Ok(Report {
        name: "stability",
        tables: vec![Table::new("stability", &rows)?],
        pictures: vec![("stability", picture(&families, &rows))],
        summary: summary(&families),
        failure: (!wrong.is_empty()).then_some(failure),
    })
}

/// What is wrong with a case.
fn complaint(row: &Finding) -> Option<String> {
    let name = name(row.family, row.parameter, &row.value);
    let text = format!("{name}: expected {}, got {}", row.expected, row.got);
    (row.verdict == Verdict::Wrong).then_some(text)
}

fn name(family: &str, parameter: &str, value: &str) -> String {
    format!("{family}, {parameter} = {value}")
}

/// The families that are asked for.
fn chosen(options: &Options, quick: bool) -> Result<Vec<Family>> {
    let mut families = families::all();
    if quick {
        families.retain(|family| family.cost == Cost::Cheap);
        for family in &mut families {
            let cases = std::mem::take(&mut family.cases);
            family.cases = cases.into_iter().step_by(QUICK).collect();
        }
    }
    if let Some(text) = &options.only {
        for family in &mut families {
            let of = |case: &Case| name(family.name, family.parameter, &case.value);
            let cases = std::mem::take(&mut family.cases).into_iter();
            family.cases = cases.filter(|case| of(case).contains(text)).collect();
        }
        families.retain(|family| !family.cases.is_empty());
        if families.is_empty() {
            return Err(WrongInput(format!("--only {text:?} is in no case")).into());
        }
    }
    Ok(families)
}

fn count(rows: &[Finding], verdict: Verdict) -> usize {
    rows.iter().filter(|row| row.verdict == verdict).count()
}

/// One line per family.
fn summary(families: &[&[Finding]]) -> String {
    let header = "family|parameter|cases|accurate|refused|wrong|largest deviation/tolerance|s";
    let lines = families.iter().map(|rows| {
        let largest = rows
            .iter()
            .filter_map(Finding::part_of_tolerance)
            .reduce(f64::max);
        let seconds: f64 = rows.iter().map(|row| row.seconds).sum();
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

/// The cases as a heat map: one row per family, one cell per case.
fn picture(families: &[&[Finding]], rows: &[Finding]) -> Figure {
    let [accurate, refused, wrong] =
        [Verdict::Accurate, Verdict::Refused, Verdict::Wrong].map(|verdict| count(rows, verdict));
    Figure::single(Matrix {
        title: Some(format!("{accurate} cases are accurate")),
        rows: families.iter().map(|rows| matrix_row(rows)).collect(),
        colours: ColourScale::new("log₁₀ of deviation / tolerance", [DARKEST, 0.0]),
        legend: vec![
            (
                Colour::Grey,
                format!("refused by the right error: {refused}"),
            ),
            (Colour::Red, format!("wrong: {wrong}")),
        ],
    })
}

fn matrix_row(rows: &[Finding]) -> MatrixRow {
    let [first, last] = [&rows[0], &rows[rows.len() - 1]];
    let numbers = [first, last].map(|row| row.value.parse::<f64>());
    let note = if numbers.iter().all(Result::is_ok) {
        format!("{}: {} … {}", first.parameter, first.value, last.value)
    } else {
        first.parameter.to_owned()
    };
    MatrixRow {
        name: first.family.to_owned(),
        cells: rows.iter().map(cell).collect(),
        note,
    }
}

fn cell(row: &Finding) -> Cell {
    match row.verdict {
        Verdict::Refused => Cell::Plain(Colour::Grey),
        Verdict::Wrong => Cell::Plain(Colour::Red),
        Verdict::Accurate => {
            let part = row.part_of_tolerance().unwrap_or(0.0);
            Cell::Value(part.log10().clamp(DARKEST, 0.0))
        }
    }
}
