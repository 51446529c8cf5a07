//! Do answers contradict each other? Random scenes over all that a scene can be, and relations that their answers must obey.

mod judge;
mod patience;
mod relation;

mod units;

use std::collections::BTreeSet;
use std::path::Path;

use anyhow::Result;
use strum::IntoEnumIterator as _;
use viscofriction::scene::{IndenterKind, MaterialKind};

use super::Report;
use super::sample::{Motion, Options, Range};
use crate::meter::median;
use crate::output::{markdown_table, read_csv, to_csv, write_atomically};
use crate::tasks::in_parallel;
use judge::{Row, Verdict, judge};
use relation::Relation;

const SCENES: usize = 5000;
const QUICK_SCENES: usize = 150;
/// A half is stationary.
const MOTIONS: [Motion; 20] = {
    use Motion::{History, Pressed, SlidingForTime, SlidingOverDistance, Stationary};
    let mut motions = [Stationary; 20];
    motions[10] = SlidingForTime;
    (motions[11], motions[12]) = (SlidingOverDistance, SlidingOverDistance);
    (motions[13], motions[14], motions[15]) = (Pressed, Pressed, Pressed);
    (motions[16], motions[17], motions[18], motions[19]) = (History, History, History, History);
    motions
};
/// Some scenes are extreme.
const DECADES: [f64; 8] = [3.0, 3.0, 3.0, 3.0, 3.0, 3.0, 9.0, 40.0];
/// Rows that were computed; an interrupted run goes on where it was.
const ROWS: &str = "agreement.csv";
/// Scenes that are judged before they are written.
const AT_ONCE: usize = 64;
/// Part of the comparisons that may be outside the sum of the bars, and by how many of these sums at most.
const OUTSIDE: f64 = 0.01;
const FARTHEST: f64 = 3.0;
/// Contradictions that the page names.
const NAMED: usize = 20;

/// Judges random scenes, of which `out` may hold some.
pub(super) fn report(options: &Options, out: &Path, quick: bool) -> Result<Report> {
    let count = options.count(if quick { QUICK_SCENES } else { SCENES })?;
    let seed = options.seed();
    let range = range(quick);
    let file = out.join(ROWS);
    let mut rows: Vec<Row> = if file.exists() {
        read_csv(&file)?
    } else {
        Vec::new()
    };
    let of_seed = rows.iter().filter(|row| row.seed == seed);
    let done: BTreeSet<usize> = of_seed.map(|row| row.scene).collect();
    let missing: Vec<usize> = (1..=count)
        .filter(|number| !done.contains(number))
        .collect();
    for (chunk, some) in missing.chunks(AT_ONCE).enumerate() {
        let task = format!("agreement, {} of {}", chunk * AT_ONCE, missing.len());
        let judged = in_parallel(task, some, |number| judge(seed, *number, &range, out))?;
        rows.extend(judged.into_iter().flatten());
        write_atomically(&file, to_csv(&rows)?.as_bytes())?;
    }
    Ok(Report {
        name: "agreement",
        tables: Vec::new(),
        pictures: Vec::new(),
        summary: format!(
            "{}\n\n{}\n\n{}",
            table(&rows),
            calibration(&rows),
            contradictions(&rows)
        ),
        failure: failure(&rows),
    })
}

/// Everything that a scene can be.
fn range(quick: bool) -> Range {
    Range {
        bodies: IndenterKind::iter().collect(),
        materials: MaterialKind::iter().collect(),
        motions: &MOTIONS,
        decades: &DECADES,
        speeds: 3.0,
        layers: 0.2,
        depths: 0.3,
        distances: if quick { 0.2 } else { 1.0 },
        memory: "48 MiB",
    }
}

/// The names of the relations in the table, that of an answer in itself first.
fn relations() -> impl Iterator<Item = (&'static str, bool)> {
    let all = Relation::iter().map(|relation| (relation.into(), relation.is_exact()));
    std::iter::once(("answer", true)).chain(all)
}

/// One line per relation: what was tried, refused, and held.
fn table(rows: &[Row]) -> comfy_table::Table {
    let header = "relation|holds|scenes|refused|unfinished|hold|outside|wrong|worst deviation";
    let lines = relations().map(|(relation, is_exact)| {
        let of: Vec<&Row> = rows.iter().filter(|row| row.relation == relation).collect();
        let count = |verdict| of.iter().filter(|row| row.verdict == verdict).count();
        let worst = of.iter().filter_map(|row| row.part).fold(0.0, f64::max);
        let unit = if is_exact {
            "to rounding"
        } else {
            "within the sum of the bars"
        };
        let counts = [
            Verdict::Refused,
            Verdict::Unfinished,
            Verdict::Holds,
            Verdict::Differs,
            Verdict::Wrong,
        ];
        let counts = counts.map(|verdict| count(verdict).to_string());
        let about = [
            relation.replace('-', " "),
            unit.to_owned(),
            of.len().to_string(),
        ];
        about
            .into_iter()
            .chain(counts)
            .chain([format!("{worst:.2}")])
            .collect::<Vec<_>>()
    });
    markdown_table(header.split('|'), lines)
}

/// Name of a kind of scenes, and whether one belongs to it.
type Kind = (&'static str, fn(&Row) -> bool);

/// Kinds of scenes whose bars are counted apart.
const KINDS: [Kind; 6] = [
    ("rough surfaces and height maps", |row| {
        row.is_of("self-affine height-map")
    }),
    ("flat ends that slide on the half space", |row| {
        row.slides() && row.is_of("flat-punch flat-cone truncated-paraboloid")
    }),
    ("sliding at a depth", |row| {
        row.slides() && row.motion.contains("depth")
    }),
    ("layers", |row| row.motion.contains("layer")),
    ("pressed, and histories", |row| !row.slides()),
    ("all", |_| true),
];

/// How far answers by boundary elements are from those to a quarter of the error, over the sum of both bars, by kind of
/// scene.
fn calibration(rows: &[Row]) -> comfy_table::Table {
    let name: &str = Relation::QuarterOfTheError.into();
    let of = |row: &&Row| {
        let by_elements = row.method.starts_with("bem");
        row.relation == name && by_elements && row.part.is_some()
    };
    let lines = KINDS.map(|(kind, belongs)| {
        let parts = rows.iter().filter(of).filter(|row| belongs(row));
        let parts: Vec<f64> = parts.filter_map(|row| row.part).collect();
        let held = parts.iter().filter(|part| **part <= 1.0).count();
        let worst = parts.iter().copied().fold(0.0, f64::max);
        // Elastic contacts have no friction to differ in.
        let others: Vec<f64> = parts.iter().copied().filter(|part| *part > 0.0).collect();
        let middle = (!others.is_empty()).then(|| format!("{:.1}", median(others).recip()));
        let [compared, held] = [parts.len(), held].map(|count| count.to_string());
        let [middle, worst] = [middle.unwrap_or_default(), format!("{worst:.2}")];
        [kind.to_owned(), compared, held, middle, worst]
    });
    let header = "boundary elements to a quarter of the error|compared|within the bars|median of bars/deviation|worst";
    markdown_table(header.split('|'), lines)
}

/// The worst contradictions by name.
fn contradictions(rows: &[Row]) -> String {
    let mut found: Vec<&Row> = rows
        .iter()
        .filter(|row| row.verdict.contradicts())
        .collect();
    let size = |row: &Row| row.part.unwrap_or(f64::INFINITY);
    found.sort_by(|one, other| size(other).total_cmp(&size(one)));
    let lines = found.iter().take(NAMED).map(|row| {
        let what = if row.message.is_empty() {
            &row.quantity
        } else {
            &row.message
        };
        let part = row
            .part
            .map_or_else(String::new, |part| format!(" {part:.2}"));
        let [seed, scene] = [row.seed, row.scene as u64];
        format!(
            "- agreement-{seed}-{scene}, {}: {what}{part}\n",
            row.relation
        )
    });
    let listed: String = lines.collect();
    format!("{} contradictions\n\n{listed}", found.len())
}

/// Why the command fails: an answer that cannot be, a relation to rounding that does not hold, or bars that hold too seldom.
fn failure(rows: &[Row]) -> Option<String> {
    let exact: BTreeSet<&str> = relations()
        .filter(|(_, exact)| *exact)
        .map(|(name, _)| name)
        .collect();
    let contradicts = |row: &&Row| row.verdict.contradicts();
    let is_exact = |row: &&Row| exact.contains(&*row.relation) || row.verdict == Verdict::Wrong;
    let wrong = rows.iter().filter(contradicts).filter(is_exact).count();
    let compared = rows
        .iter()
        .filter(|row| !is_exact(row) && row.part.is_some());
    let parts: Vec<f64> = compared.filter_map(|row| row.part).collect();
    let outside = parts.iter().filter(|part| **part > 1.0).count();
    let farthest = parts.iter().copied().fold(0.0, f64::max);
    let holds =
        wrong == 0 && outside as f64 <= OUTSIDE * parts.len() as f64 && farthest <= FARTHEST;
    (!holds).then(|| {
        format!(
            "agreement: {wrong} exact contradictions, {outside} of {} comparisons outside the sum of their bars, the farthest \
             by {farthest:.2} of them",
            parts.len()
        )
    })
}
