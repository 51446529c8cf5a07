//! Error bars against the deviation from much finer solutions.

use anyhow::{Context, Result};
use bem_halfspace::BemError;
use bem_halfspace::steady::{FrictionEstimate, FrictionOptions};
use serde::Serialize;

use crate::evidence::stationary::bodies::{self, Case};
use crate::meter::{measure, median};
use crate::output::markdown_table;
use crate::progress;

/// Shapes of the elements.
const ASPECTS: [f64; 3] = [0.5, 1.0, 2.0];
/// What is asked of the bars: the fraction that holds, and how much wider than needed they may be at the median.
const NEEDED_FRACTION: f64 = 0.95;
const WIDEST_MEDIAN: f64 = 30.0;
/// Cases with the largest deviations that are printed even if their bars hold.
const WORST: usize = 8;

/// One bar. Friction coefficients belong to F_N/(4ηv) = 1 and bodies of the size 1.
#[derive(Debug, Clone, Serialize)]
pub(super) struct Row {
    case: String,
    /// Of a power profile.
    exponent: Option<f64>,
    aspect: f64,
    relative_error_asked: f64,
    /// Whether the error asked for was reached; the bar counts either way.
    reached: bool,
    friction: f64,
    error_bar: f64,
    reference_friction: f64,
    reference_error: f64,
    deviation: f64,
    deviation_over_bar: f64,
    /// Whether the deviation is within the bar and the error of the reference.
    holds: bool,
    unknowns: Option<usize>,
    seconds: f64,
    processor_seconds: f64,
}

/// A friction coefficient with the error claimed, reached or not.
struct Answer {
    friction: f64,
    error: f64,
    unknowns: Option<usize>,
}

/// Tests the bars of all bodies, or of a few.
pub(super) fn compute(quick: bool) -> Result<Vec<Row>> {
    let cases = if quick {
        bodies::quick()?
    } else {
        bodies::all()?
    };
    let bar = progress::bar("error bars", cases.len() * (1 + ASPECTS.len()));
    let mut rows = Vec::new();
    for case in &cases {
        let reference = solve(case, &case.reference())?;
        bar.inc(1);
        for aspect in ASPECTS {
            rows.push(row(case, &reference, aspect)?);
            bar.inc(1);
        }
    }
    bar.finish_and_clear();
    Ok(rows)
}

fn row(case: &Case, reference: &Answer, aspect: f64) -> Result<Row> {
    let options = FrictionOptions {
        relative_error: case.relative_error,
        aspect,
        ..FrictionOptions::default()
    };
    let (answer, cost) = measure(|| solve(case, &options));
    let Answer {
        friction,
        error,
        unknowns,
    } = answer?;
    let deviation = (friction - reference.friction).abs();
    Ok(Row {
        case: case.name.clone(),
        exponent: case.exponent,
        aspect,
        relative_error_asked: case.relative_error,
        reached: unknowns.is_some(),
        friction,
        error_bar: error,
        reference_friction: reference.friction,
        reference_error: reference.error,
        deviation,
        deviation_over_bar: deviation / error,
        holds: deviation <= error + reference.error,
        unknowns,
        seconds: cost.seconds,
        processor_seconds: cost.processor_seconds,
    })
}

fn solve(case: &Case, options: &FrictionOptions) -> Result<Answer> {
    match (case.solve)(options) {
        Ok(estimate) => Ok(Answer {
            friction: estimate.friction_coefficient,
            error: estimate.error,
            unknowns: last_unknowns(&estimate),
        }),
        Err(BemError::FrictionNotReached {
            friction_coefficient,
            error,
            ..
        }) => Ok(Answer {
            friction: friction_coefficient,
            error,
            unknowns: None,
        }),
        Err(other) => Err(other).with_context(|| format!("{}, {options:?}", case.name)),
    }
}

fn last_unknowns(estimate: &FrictionEstimate) -> Option<usize> {
    estimate.refinements.last().map(|last| last.unknowns)
}

/// How many bars hold, how wide they are, and the cases that fail or come closest to it.
pub(super) fn summary(rows: &[Row]) -> String {
    let held = rows.iter().filter(|row| row.holds).count();
    let fraction = held as f64 / rows.len() as f64;
    let width = 1.0 / median(rows.iter().map(|row| row.deviation_over_bar).collect());
    let verdict = |good: bool| if good { "as asked" } else { "NOT as asked" };
    let mut worst: Vec<&Row> = rows.iter().collect();
    worst.sort_by(|one, other| other.deviation_over_bar.total_cmp(&one.deviation_over_bar));
    let shown = WORST.max(rows.len() - held);
    let table = markdown_table(
        [
            "case",
            "Δy/Δx",
            "asked",
            "μ",
            "bar",
            "deviation",
            "ratio",
            "holds",
        ],
        worst.into_iter().take(shown).map(|row| {
            [
                row.case.clone(),
                row.aspect.to_string(),
                format!("{:e}", row.relative_error_asked),
                format!("{:.6}", row.friction),
                format!("{:.1e}", row.error_bar),
                format!("{:.1e}", row.deviation),
                format!("{:.2}", row.deviation_over_bar),
                if row.holds { "yes" } else { "NO" }.to_owned(),
            ]
        }),
    );
    format!(
        "{held} of {} error bars hold, {:.1} %: {}\nmedian of bar/deviation {width:.1}: {}\n{table}",
        rows.len(),
        100.0 * fraction,
        verdict(fraction >= NEEDED_FRACTION),
        verdict(width <= WIDEST_MEDIAN),
    )
}
