//! Do answers contradict each other? Random scenes over all that a scene can be, and relations that their answers must obey.

mod derivatives;
mod judge;
mod relation;
mod surfaces;
mod units;

use std::collections::BTreeSet;
use std::path::Path;

use anyhow::{Context as _, Result};
use strum::IntoEnumIterator as _;

use super::Report;
use super::sample::{Options, Source};
use crate::meter::median;
use crate::table::{GrowingTable, ROWS_AT_ONCE, markdown_table};
use judge::{Row, Verdict, judge};
use relation::Relation;

/// Number of random scenes of a full run and of a quick one. Chosen by the time that they may take.
const SCENES: [usize; 2] = [5000, 22];
/// Number of decades, up and down, from which sliding distances from first touch are drawn in a quick run. Chosen: long distances
/// take long.
const QUICK_DISTANCE_DECADES: f64 = 0.2;
/// Largest memory of one solution in a quick run, which bounds the size of its grids. Chosen: a solution then takes seconds
/// at most.
const QUICK_MEMORY: &str = "16 MiB";
/// Relative errors requested in a quick run. Chosen: smaller ones would only repeat the refinement on finer grids.
const QUICK_ERRORS: [f64; 1] = [0.1];
/// Fraction of the comparisons within error bars that may deviate by more than the sum of both. Each bar is to hold in 95 % of
/// the cases, their sum much more often.
const MAX_OUTSIDE_FRACTION: f64 = 0.01;
/// Largest ratio of the deviation to the sum of both bars in the comparisons that [`MAX_OUTSIDE_FRACTION`] admits outside
/// the error bars. Chosen: a bar that is an estimate may be too small by such a factor; a larger deviation is a defect.
const MAX_DEVIATION_OVER_BARS: f64 = 3.0;
/// Number of contradictions that the page lists by name, the worst ones. Chosen: they suffice to see what contradictions
/// have in common; `agreement.csv` has all.
const LISTED_CONTRADICTIONS: usize = 20;

/// Judges random scenes. Those that `agreement.csv` in `out` already has for this seed are not judged again.
pub(super) fn report(options: &Options, out: &Path, quick: bool) -> Result<Report> {
    let count = options.count(SCENES[usize::from(quick)])?;
    let seed = options.seed();
    let mut source = Source::new("agreement")?;
    if quick {
        source.range.distances = QUICK_DISTANCE_DECADES;
        source.range.errors = QUICK_ERRORS.into();
        QUICK_MEMORY.clone_into(&mut source.range.memory);
    }
    let mut table = GrowingTable::open(out.join("agreement.csv"))?;
    let rows: &[Row] = &table.rows;
    let of_seed = rows.iter().filter(|row| row.seed == seed);
    let done: BTreeSet<usize> = of_seed.map(|row| row.scene).collect();
    let all: BTreeSet<usize> = (1..=count).collect();
    let missing: Vec<usize> = all.difference(&done).copied().collect();
    table.extend(&missing, ROWS_AT_ONCE, |number| {
        judge(seed, *number, &source, out).with_context(|| format!("agreement-{seed}-{number}"))
    })?;
    let rows = &table.rows;
    let tables = format!("{}\n\n{}", relation_table(rows), calibration(rows));
    Ok(Report {
        name: "agreement",
        summary: format!("{tables}\n\n{}", contradictions(rows)),
        failure: failure(rows),
        ..Report::default()
    })
}

/// Names of the relations in the table, before them `answer`, and whether each holds up to rounding.
fn relations() -> impl Iterator<Item = (&'static str, bool)> {
    let all = Relation::iter().map(|relation| (relation.into(), relation.is_exact()));
    std::iter::once(("answer", true)).chain(all)
}

/// One line per relation: number of rows of each verdict, and the largest deviation over allowed deviation.
fn relation_table(rows: &[Row]) -> comfy_table::Table {
    use Verdict::{Differs, Holds, Refused, Unfinished, Wrong};
    let header = "relation|holds|scenes|refused|unfinished|hold|outside|wrong|worst deviation";
    let lines = relations().map(|(relation, is_exact)| {
        let of: Vec<&Row> = rows.iter().filter(|row| row.relation == relation).collect();
        let count = |verdict| of.iter().filter(|row| row.verdict == verdict).count();
        let worst = of.iter().filter_map(|row| row.part).fold(0.0, f64::max);
        let unit = match is_exact {
            true => "to rounding",
            false => "within the sum of the bars",
        };
        let mut line = vec![
            relation.replace('-', " "),
            unit.to_owned(),
            of.len().to_string(),
        ];
        let verdicts = [Refused, Unfinished, Holds, Differs, Wrong];
        line.extend(verdicts.map(|verdict| count(verdict).to_string()));
        line.push(format!("{worst:.2}"));
        line
    });
    markdown_table(header.split('|'), lines)
}

/// Name of a kind of scenes, and whether one belongs to it.
type Kind = (&'static str, fn(&Row) -> bool);

/// Kinds of scenes whose error bars [`calibration`] counts separately; a scene may be of several.
const KINDS: [Kind; 6] = [
    ("rough surfaces and height maps", |row| {
        row.is_of("self-affine spectrum height-map")
    }),
    ("flat ends that slide on the half space", |row| {
        row.slides() && row.is_of("flat-punch flat-cone truncated-paraboloid")
    }),
    ("sliding at a depth", |row| row.slides() && row.is_at_depth),
    ("layers", |row| row.has_layer),
    ("pressed, and histories", |row| !row.slides()),
    ("all", |_| true),
];

/// One line per kind of scene for the relation [`Relation::QuarterOfTheError`] of boundary elements: how many deviations are
/// within the sum of both error bars, the median of that sum over the deviation, and the worst deviation over it.
fn calibration(rows: &[Row]) -> comfy_table::Table {
    let name: &str = Relation::QuarterOfTheError.into();
    let of = |row: &&Row| row.relation == name && row.method.starts_with("bem");
    let lines = KINDS.map(|(kind, belongs)| {
        let of_kind = rows.iter().filter(of).filter(|row| belongs(row));
        let parts: Vec<f64> = of_kind.filter_map(|row| row.part).collect();
        let held = parts.iter().filter(|part| **part <= 1.0).count();
        let worst = parts.iter().copied().fold(0.0, f64::max);
        let [compared, held] = [parts.len(), held].map(|count| count.to_string());
        // Leave out deviations of exactly 0, as of elastic contacts, which have no friction to differ in.
        let others: Vec<f64> = parts.into_iter().filter(|part| *part > 0.0).collect();
        let middle = (!others.is_empty()).then(|| format!("{:.1}", median(others).recip()));
        let [middle, worst] = [middle.unwrap_or_default(), format!("{worst:.2}")];
        [kind.to_owned(), compared, held, middle, worst]
    });
    let header = "boundary elements to a quarter of the error|compared|within the bars|median of bars/deviation|worst";
    markdown_table(header.split('|'), lines)
}

/// The number of contradictions and a list in Markdown of the worst, under the names of their folders.
fn contradictions(rows: &[Row]) -> String {
    let found = rows.iter().filter(|row| row.verdict.contradicts());
    let mut found: Vec<&Row> = found.collect();
    let size = |row: &Row| row.part.unwrap_or(f64::INFINITY);
    found.sort_by(|one, other| size(other).total_cmp(&size(one)));
    let lines = found.iter().take(LISTED_CONTRADICTIONS).map(|row| {
        let part = row.part.map(|part| format!(" {part:.2}"));
        let what = match &*row.message {
            "" => &row.quantity,
            message => message,
        };
        let [seed, scene] = [row.seed, row.scene as u64];
        let (relation, part) = (&row.relation, part.unwrap_or_default());
        format!("- agreement-{seed}-{scene}, {relation}: {what}{part}\n")
    });
    let listed: String = lines.collect();
    format!("{} contradictions\n\n{listed}", found.len())
}

/// Why the command fails: an answer that cannot be, a relation to rounding that does not hold, or bars that hold too seldom.
fn failure(rows: &[Row]) -> Option<String> {
    let is_exact = |row: &&Row| {
        let mut exact = relations().filter(|(_, exact)| *exact);
        row.verdict == Verdict::Wrong || exact.any(|(name, _)| name == row.relation)
    };
    let (exact, compared): (Vec<&Row>, Vec<&Row>) = rows.iter().partition(is_exact);
    let wrong = exact.iter().filter(|row| row.verdict.contradicts()).count();
    let parts: Vec<f64> = compared.iter().filter_map(|row| row.part).collect();
    let (all, outside) = (
        parts.len(),
        parts.iter().filter(|part| **part > 1.0).count(),
    );
    let farthest = parts.into_iter().fold(0.0, f64::max);
    let holds = wrong == 0
        && outside as f64 <= MAX_OUTSIDE_FRACTION * all as f64
        && farthest <= MAX_DEVIATION_OVER_BARS;
    (!holds).then(|| {
        format!(
            "agreement: {wrong} exact contradictions, {outside} of {all} comparisons outside the sum of their bars, the \
             farthest by {farthest:.2} of them"
        )
    })
}
