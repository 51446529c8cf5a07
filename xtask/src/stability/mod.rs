//! `stability`: stiff and extreme cases of every method, each judged against an exact or converged value, or against the
//! typed error that is right.

mod case;
mod cone_on_solid;
mod contact_cases;
mod direct_sum;
mod half_space_cases;
mod judge;
mod line_cases;
mod picture;
mod range_cases;
mod refusal_cases;
mod rheology_cases;
mod shape_cases;
mod unit_cases;

use std::path::PathBuf;

use anyhow::{Result, bail};
use clap::Args;

use crate::output::{
    WrongInput, markdown_table, print_line, to_csv, write_atomically, write_figure,
};
use case::Family;
use judge::{Row, Verdict};

/// Where the results go, and how many cases there are.
#[derive(Debug, Args)]
pub(crate) struct Stability {
    /// Where the table and the picture are written.
    #[arg(long, default_value = "target/stability")]
    out: PathBuf,
    /// The cheap families only, and every third of their cases.
    #[arg(long)]
    quick: bool,
    /// Only cases that contain this in 'family, parameter = value'; the picture then shows no others.
    #[arg(long, value_name = "TEXT")]
    only: Option<String>,
}

/// A quick run takes one case of so many.
const QUICK: usize = 3;

/// Runs all cases, writes the table and the picture, and prints a summary.
pub(crate) fn stability(options: &Stability) -> Result<()> {
    let out = &options.out;
    std::fs::create_dir_all(out)
        .map_err(|error| WrongInput(format!("--out {} cannot be made: {error}", out.display())))?;
    let start = std::time::Instant::now();
    let rows = judge::judge(&chosen(options)?);
    let of_one_family =
        |one: &Row, other: &Row| one.family == other.family && one.parameter == other.parameter;
    let families: Vec<&[Row]> = rows.chunk_by(of_one_family).collect();
    write_atomically(&out.join("stability.csv"), to_csv(&rows)?.as_bytes())?;
    write_figure(out, "stability", &picture::picture(&families))?;
    print_line(&summary(&families))?;
    let seconds = start.elapsed().as_secs_f64();
    print_line(&format!("{} in {seconds:.1} s", out.display()))?;
    let wrong: Vec<String> = rows.iter().filter_map(complaint).collect();
    if wrong.is_empty() {
        return Ok(());
    }
    bail!(
        "{} of {} cases are wrong\n{}",
        wrong.len(),
        rows.len(),
        wrong.join("\n")
    )
}

/// What is wrong with a case.
fn complaint(row: &Row) -> Option<String> {
    let Row {
        family,
        parameter,
        value,
        expected,
        got,
        ..
    } = row;
    let text = format!("{family}, {parameter} = {value}: expected {expected}, got {got}");
    (row.verdict == Verdict::Wrong).then_some(text)
}

/// The families that are asked for.
fn chosen(options: &Stability) -> Result<Vec<Family>> {
    let mut families = families();
    if options.quick {
        families.retain(|family| !family.slow);
        for family in &mut families {
            let mut index = 0;
            family.cases.retain(|_| {
                index += 1;
                index % QUICK == 1
            });
        }
    }
    if let Some(text) = &options.only {
        for family in &mut families {
            let Family {
                name, parameter, ..
            } = *family;
            family.cases.retain(|case| {
                let whole = format!("{name}, {parameter} = {}", case.value);
                whole.contains(text.as_str())
            });
        }
        families.retain(|family| !family.cases.is_empty());
        if families.is_empty() {
            return Err(WrongInput(format!("--only {text:?} is in no case")).into());
        }
    }
    Ok(families)
}

fn families() -> Vec<Family> {
    let mut families = rheology_cases::families();
    families.extend(shape_cases::families());
    families.extend(line_cases::families());
    families.extend(contact_cases::families());
    families.extend(half_space_cases::families());
    families.extend(range_cases::families());
    families.extend(unit_cases::families());
    families.extend(refusal_cases::families());
    families
}

/// One line per family.
fn summary(families: &[&[Row]]) -> comfy_table::Table {
    let header = [
        "family",
        "parameter",
        "cases",
        "accurate",
        "refused",
        "wrong",
        "largest deviation/tolerance",
        "s",
    ];
    markdown_table(header, families.iter().map(|rows| line(rows)))
}

fn line(rows: &[Row]) -> [String; 8] {
    let count = |verdict| rows.iter().filter(|row| row.verdict == verdict).count();
    let parts = rows.iter().filter_map(Row::part_of_tolerance);
    let largest = parts.reduce(f64::max);
    let seconds: f64 = rows.iter().map(|row| row.seconds).sum();
    [
        rows[0].family.to_owned(),
        rows[0].parameter.to_owned(),
        rows.len().to_string(),
        count(Verdict::Accurate).to_string(),
        count(Verdict::Refused).to_string(),
        count(Verdict::Wrong).to_string(),
        largest.map_or_else(String::new, |part| format!("{part:.1e}")),
        format!("{seconds:.2}"),
    ]
}
