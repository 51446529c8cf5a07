//! How far the stationary solver can be trusted, and what it costs: time and memory over the number of elements in contact, and
//! error bars against the deviation from much finer solutions.

use std::iter::successors;

use anyhow::{Context, Result, ensure};
use bem_halfspace::steady::{SteadySliding, steady_refined};
use benches::memory;
use clap::{Args, ValueEnum};
use indenters::Surface;
use numerics::Estimate;
use serde::{Deserialize, Serialize};
use viscofriction::scene::{self, Indenter};
use viscofriction::solve::Problem;

use super::fit::exponent;
use super::{Report, Share};
use crate::meter::{measure, median};
use crate::output::{WrongInput, points};
use crate::scene::{Scene, as_far_as_reached, refined_to};
use crate::table::Table;
use crate::tasks::in_turn;

/// What is measured, and how far.
#[derive(Debug, Default, Args)]
pub(super) struct Options {
    /// Elements in contact on the largest grid of the table of growth, between 2e3 and 1e7 [default: 1e5, quick 4e3].
    #[arg(long, value_name = "N")]
    largest: Option<f64>,
    /// Table to make; may be given several times [default: all].
    #[arg(long = "table", value_enum, value_name = "TABLE")]
    tables: Vec<Part>,
}

/// One of the tables.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Part {
    /// Time and memory over the size of the grid.
    Growth,
    /// Error bars against much finer solutions.
    ErrorBars,
}

/// Number of elements in contact on the largest grid of a full run and of a quick one, unless the command line gives another
/// number. Chosen.
const LARGEST: [f64; 2] = [1e5, 4e3];

/// Makes the tables asked for; a quick run takes a dozen cheap cases and small grids only.
pub(super) fn report(options: &Options, quick: bool) -> Result<Report> {
    let largest = options.largest.unwrap_or(LARGEST[usize::from(quick)]);
    let wrong = format!("--largest must be between 2e3 and 1e7, but is {largest}");
    ensure!((2e3..=1e7).contains(&largest), WrongInput(wrong));
    let (mut tables, mut summaries) = (Vec::new(), Vec::new());
    // Measure the growth first, because the memory that it reports is the largest that the process has had.
    for part in [Part::Growth, Part::ErrorBars] {
        if !options.tables.is_empty() && !options.tables.contains(&part) {
            continue;
        }
        let (table, summary) = match part {
            Part::Growth => growth(largest)?,
            Part::ErrorBars => error_bars(quick)?,
        };
        tables.push(table);
        summaries.push(summary);
    }
    Ok(Report {
        name: "stationary",
        tables,
        summary: summaries.join("\n\n"),
        ..Report::default()
    })
}

/// Number of elements in contact on the smallest grid of the growth table. Chosen: on a smaller one constant costs prevail.
const SMALLEST: f64 = 1e3;
/// Aspect Δy/Δx of the elements, the ratio of width to length: the default of the stationary solver.
const ASPECT: f64 = 0.5;
/// Largest ratio of the residual in contact to F_N/(4ηv), the depth in the one-dimensional model under the normal force F_N, with
/// the viscosity η and the speed v. It is what the stationary solver takes for a relative error of 1e-3.
const TOLERANCE: f64 = 1e-7;
/// Number of elements in contact above which grids determine the exponent of growth, if there are two such grids. Chosen just
/// below 10⁴, where the second decade of grids begins: on smaller grids constant costs distort the exponent.
const MIN_FITTED_ELEMENTS: f64 = 9e3;
/// Number of elements along the contact length of the grid from which the contact area is taken. Chosen: the area only decides
/// how many elements the other grids will have in contact, for which a few per cent suffice.
const AREA_ELEMENTS: f64 = 40.0;
/// Relative error requested of the extrapolated friction coefficient with which those of single grids are compared. Chosen.
const REFERENCE_ERROR: f64 = 1e-4;

/// One grid, from a cold start; coarser grids that the solver starts from are in its cost.
#[derive(Debug, Clone, Serialize)]
struct Grid {
    elements_in_contact: f64,
    unknowns: usize,
    /// How often the set of elements in contact was changed.
    contact_sets: usize,
    seconds: f64,
    processor_seconds: f64,
    /// Largest memory resident in this process so far, in units of 2²⁰ bytes; `None` where the system does not report it.
    peak_memory_mib: Option<f64>,
    /// Ratio of the friction coefficient on this one grid to the extrapolated one, minus 1.
    relative_deviation: f64,
}

/// Cost of a paraboloid on grids from [`SMALLEST`] to `largest` elements in contact, each with about √10 times as many as the
/// one before; the table, and a summary with the exponent of growth.
fn growth(largest: f64) -> Result<(Table, String)> {
    let scene = Scene::unit(2.0)?;
    let refined = scene.friction(&refined_to(REFERENCE_ERROR, ASPECT))?;
    let limit = refined.friction_coefficient.value;
    let solve = |spacing: f64| -> Result<SteadySliding> {
        scene.on_one_grid([spacing, ASPECT * spacing], [0.0; 2], TOLERANCE)
    };
    // Compute the area of the contact, which gives the spacing for a number of elements in contact.
    let area = solve(scene.theory()?.contact_length() / AREA_ELEMENTS)?.contact_area;
    let steps = (2.0 * (largest / SMALLEST).log10()).round().max(1.0);
    let ratio = (largest / SMALLEST).powf(1.0 / steps);
    let sizes = successors(Some(SMALLEST), |size| Some(size * ratio));
    let sizes: Vec<f64> = sizes.take_while(|size| *size < 1.01 * largest).collect();
    let rows = in_turn("growth", &sizes, |size| {
        let (solution, cost) = measure(|| solve((area / (size * ASPECT)).sqrt()));
        let solution = solution.with_context(|| format!("{size:.0} elements in contact"))?;
        let [dx, dy] = solution.pressure.grid.spacing();
        Ok(Grid {
            elements_in_contact: (solution.contact_area / dx / dy).round(),
            unknowns: solution.unknowns,
            contact_sets: solution.iterations,
            seconds: cost.seconds,
            processor_seconds: cost.processor_seconds,
            peak_memory_mib: memory("VmHWM:").map(|bytes| bytes / (1 << 20) as f64),
            relative_deviation: solution.friction_coefficient / limit - 1.0,
        })
    })?;
    let elements = |row: &Grid| row.elements_in_contact;
    let mut points = points(&rows, elements, |row| row.processor_seconds);
    let is_large = |point: &[f64; 2]| point[0] > MIN_FITTED_ELEMENTS;
    if points.iter().copied().filter(is_large).count() > 1 {
        points.retain(is_large);
    }
    let table = Table::new("growth", &rows)?;
    let columns = "elements_in_contact unknowns contact_sets seconds processor_seconds \
                   peak_memory_mib relative_deviation";
    let summary = format!(
        "{}\nexponent of growth of the processor time over the last {} grids: {:.2}",
        table.markdown(columns)?,
        points.len(),
        exponent(&points).value
    );
    Ok((table, summary))
}

/// Relative error requested of the solutions whose bars are judged in a quick run. Chosen; a full run has that of
/// `stationary.toml`.
const QUICK_REQUESTED_ERROR: f64 = 3e-3;
/// Aspects Δy/Δx of the elements on which each bar is computed: bars must hold for any of them.
const ASPECTS: [f64; 3] = [0.5, 1.0, 2.0];
/// Smallest fraction of the bars that must hold. Chosen: a bar is an estimate and no bound.
const MIN_COVERAGE: f64 = 0.95;
/// Largest acceptable median of the ratio of bar to deviation. Chosen: bars that are too wide would always hold.
const MAX_MEDIAN_BAR: f64 = 30.0;
/// Number of cases, those with the largest ratio of deviation to bar, that the summary lists even if all bars hold. Chosen.
const LISTED_CASES: usize = 8;

/// What `stationary.toml` holds. All errors are relative; those of a case take precedence over those of all.
#[derive(Deserialize)]
struct Cases {
    /// Material, load and options of all cases, each of which replaces the body.
    scene: scene::Scene,
    requested_error: f64,
    reference_error_over_requested: f64,
    reference_aspect: f64,
    case: Vec<Case>,
}

/// A body, in a scene whose depth scale F_N/(4ηv) is 1.
#[derive(Deserialize)]
struct Case {
    name: String,
    /// p of a power profile.
    exponent: Option<f64>,
    #[serde(default)]
    is_quick: bool,
    /// Each of these three instead of that of all cases.
    requested_error: Option<f64>,
    reference_error_over_requested: Option<f64>,
    reference_aspect: Option<f64>,
    indenter: Indenter,
}

/// One error bar. Friction coefficients belong to F_N/(4ηv) = 1 m and bodies whose size is of the order of 1 m.
#[derive(Debug, Clone, Serialize)]
struct Bar {
    case: String,
    /// p, if the body is a power profile.
    exponent: Option<f64>,
    aspect: f64,
    relative_error_asked: f64,
    friction: f64,
    error_bar: f64,
    reference_friction: f64,
    reference_error: f64,
    deviation: f64,
    deviation_over_bar: f64,
    /// Whether the deviation is within the bar and the error of the reference.
    holds: bool,
}

impl Case {
    /// A bar for each of [`ASPECTS`], all judged by one reference of a smaller error.
    fn bars(&self, all: &Cases) -> Result<Vec<Bar>> {
        let mut scene = all.scene.clone();
        scene.indenter = self.indenter.clone();
        let problem = Problem::try_from(&scene)?;
        let body = problem.body().surface().context("a body that ends")?;
        let asked = self.requested_error.unwrap_or(all.requested_error);
        let ratio = self
            .reference_error_over_requested
            .unwrap_or(all.reference_error_over_requested);
        let aspect = self.reference_aspect.unwrap_or(all.reference_aspect);
        let reference = self.solve(body, ratio * asked, aspect)?;
        let bar = |aspect| {
            let friction = self.solve(body, asked, aspect)?;
            let deviation = (friction.value - reference.value).abs();
            Ok(Bar {
                case: self.name.clone(),
                exponent: self.exponent,
                aspect,
                relative_error_asked: asked,
                friction: friction.value,
                error_bar: friction.error,
                reference_friction: reference.value,
                reference_error: reference.error,
                deviation,
                deviation_over_bar: deviation / friction.error,
                holds: deviation <= friction.error + reference.error,
            })
        };
        ASPECTS.into_iter().map(bar).collect()
    }

    /// Stationary friction coefficient of the body in the unit scene, with the error bar that was reached.
    fn solve(&self, body: &dyn Surface, relative_error: f64, aspect: f64) -> Result<Estimate> {
        let Scene { material, load, .. } = Scene::unit(1.0)?;
        let options = refined_to(relative_error, aspect);
        let reached = as_far_as_reached(steady_refined(body, &material, &load, &options));
        reached.with_context(|| format!("{}, {options:?}", self.name))
    }
}

/// Judges the bars of all bodies, of a few in a quick run; the table of all bars, and a summary: how many hold, their median
/// width, and the cases that fail or come closest to it.
fn error_bars(quick: bool) -> Result<(Table, String)> {
    let mut cases: Cases = toml::from_str(include_str!("stationary.toml"))?;
    if quick {
        cases.case.retain(|case| case.is_quick);
        cases.requested_error = QUICK_REQUESTED_ERROR;
    }
    let bars = in_turn("error bars", &cases.case, |case| case.bars(&cases))?.concat();
    let share: Share = bars.iter().map(|bar| bar.holds).collect();
    let Share { held, all } = share;
    let width = 1.0 / median(bars.iter().map(|bar| bar.deviation_over_bar).collect());
    let verdict = |good: bool| if good { "as asked" } else { "NOT as asked" };
    let mut worst: Vec<&Bar> = bars.iter().collect();
    worst.sort_by(|one, other| other.deviation_over_bar.total_cmp(&one.deviation_over_bar));
    worst.truncate(LISTED_CASES.max(all - held));
    let columns = "case aspect relative_error_asked friction error_bar deviation \
                   deviation_over_bar holds";
    let summary = format!(
        "{held} of {all} error bars hold, {}: {}\nmedian of bar/deviation {width:.1}: {}\n{}",
        share.percentage(),
        verdict(share.fraction() >= MIN_COVERAGE),
        verdict(width <= MAX_MEDIAN_BAR),
        Table::new("worst", &worst)?.markdown(columns)?
    );
    Ok((Table::new("error_bars", &bars)?, summary))
}
