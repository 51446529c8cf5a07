//! Time to a stated error, by the stationary solver and by the march in time.
//!
//! The march has one grid, whose error comes from the outline that follows the elements and from the singular front, and
//! a finite sliding distance. It uses the same discretisation as the stationary solver with square elements, so that the
//! refinements of that solver tell the error of each spacing; the distance is doubled on a coarse grid until the
//! extrapolation to an infinite one is exact enough.

use anyhow::{Context, Result, bail};
use serde::Serialize;

use super::Table;
use crate::meter::{Cost, measure as metered, measure_median};
use crate::scene::{Scene, refined_to};
use crate::tasks::in_turn;

/// Who solves a problem to a relative error, by name.
type Solver = (&'static str, fn(&Scene, f64) -> Result<(Row, Cost)>);

/// A solver, the exponent of the profile, and the relative error asked for.
type Run = (Solver, f64, f64);

const STATIONARY: Solver = ("stationary", stationary);
const ONE_GRID: Solver = ("stationary, one grid", single_grid);
const MARCH: Solver = ("march in time", march);

const RUNS: [Run; 7] = [
    (STATIONARY, 1.0, 1e-3),
    (STATIONARY, 1.0, 1e-4),
    (STATIONARY, 2.0, 1e-3),
    (STATIONARY, 2.0, 1e-4),
    (STATIONARY, 1.5, 1e-5),
    (ONE_GRID, 2.0, 1e-3),
    (MARCH, 2.0, 1e-3),
];
const QUICK_RUNS: [Run; 4] = [
    (STATIONARY, 2.0, 1e-2),
    (STATIONARY, 2.0, 1e-3),
    (ONE_GRID, 2.0, 1e-2),
    (MARCH, 2.0, 1e-2),
];
/// Part of the error that may come from the distance; the rest is for the grid.
const DISTANCE_PART: f64 = 0.25;
/// Elements along the contact length on the grid that finds the distance, and the distances in such lengths, as powers
/// of two.
const COARSE: f64 = 8.0;
const DISTANCES: std::ops::RangeInclusive<i32> = 2..=8;
/// Residual on a single grid relative to the error asked for.
const RESIDUAL_PART: f64 = 1e-3;
/// Any change over the second half of the distance is taken as stationary, because its error is estimated.
const ANY_DRIFT: f64 = 1.0;

/// One run; friction belongs to F_N/(4ηv) = 1 and the coefficient 1 of the profile.
#[derive(Debug, Clone, Default, Serialize)]
struct Row {
    solver: &'static str,
    exponent: f64,
    relative_error_asked: f64,
    friction: f64,
    /// Relative, as the solver or the choice of grid and distance has it.
    estimated_error: f64,
    /// Relative, from the most accurate stationary run of the exponent.
    deviation: Option<f64>,
    /// Unknowns on the finest grid, or elements that were followed in time.
    unknowns: usize,
    /// Of a single grid and of the march, in contact lengths of the one-dimensional model.
    elements_along_contact: Option<f64>,
    sliding_distance: Option<f64>,
    seconds: f64,
    processor_seconds: f64,
}

/// Runs of the stationary solver, then it on a single grid and the march in time for the paraboloid.
pub(super) fn measure(quick: bool) -> Result<(Table, String)> {
    let runs = if quick { &QUICK_RUNS[..] } else { &RUNS };
    let mut rows = in_turn("speed", runs, row)?;
    compare(&mut rows);
    let table = Table::new("speed", &rows)?;
    let summary = format!("{}\n{}", table.markdown(COLUMNS)?, ratios(&rows));
    Ok((table, summary))
}

fn row(&((solver, solve), exponent, relative_error): &Run) -> Result<Row> {
    let (row, cost) = solve(&Scene::unit(exponent)?, relative_error)?;
    Ok(Row {
        solver,
        exponent,
        relative_error_asked: relative_error,
        seconds: cost.seconds,
        processor_seconds: cost.processor_seconds,
        ..row
    })
}

/// Fills in the deviations.
fn compare(rows: &mut [Row]) {
    let all = rows.to_vec();
    for row in rows {
        let same = all.iter().filter(|other| {
            let exponents = other.exponent.total_cmp(&row.exponent);
            exponents.is_eq() && other.solver == STATIONARY.0
        });
        let asked = |row: &Row| row.relative_error_asked;
        let best = same.min_by(|one, other| asked(one).total_cmp(&asked(other)));
        row.deviation = best
            .filter(|best| best.relative_error_asked < row.relative_error_asked)
            .map(|best| (row.friction / best.friction - 1.0).abs());
    }
}

fn stationary(scene: &Scene, relative_error: f64) -> Result<(Row, Cost)> {
    let (estimate, cost) = measure_median(|| scene.friction(&refined_to(relative_error, 0.5)))?;
    let last = estimate.refinements.last().context("no refinement")?;
    let friction = estimate.friction_coefficient;
    let row = Row {
        friction: friction.value,
        estimated_error: friction.error / friction.value,
        unknowns: last.unknowns,
        ..Row::default()
    };
    Ok((row, cost))
}

/// The stationary equations on one grid that is fine enough, chosen as that of the march is, and as that without a bar.
fn single_grid(scene: &Scene, relative_error: f64) -> Result<(Row, Cost)> {
    let spacing = spacing(scene, relative_error)?;
    let tolerance = RESIDUAL_PART * relative_error;
    let solve = || scene.on_one_grid([spacing.length; 2], [0.0; 2], tolerance);
    let (solution, cost) = measure_median(solve)?;
    let row = Row {
        friction: solution.friction_coefficient,
        estimated_error: spacing.error,
        unknowns: solution.unknowns,
        elements_along_contact: Some(scene.theory()?.contact_length() / spacing.length),
        ..Row::default()
    };
    Ok((row, cost))
}

fn march(scene: &Scene, relative_error: f64) -> Result<(Row, Cost)> {
    let distance = distance(scene, DISTANCE_PART * relative_error)?;
    let spacing = spacing(scene, (1.0 - DISTANCE_PART) * relative_error)?;
    let (transient, cost) = metered(|| scene.half_space(spacing.length, distance));
    let transient = transient?;
    let far = transient.stationary(ANY_DRIFT)?;
    let row = Row {
        friction: far.friction_coefficient,
        estimated_error: spacing.error + far.distance_error / far.friction_coefficient,
        unknowns: transient.n_elements,
        elements_along_contact: Some(scene.theory()?.contact_length() / spacing.length),
        sliding_distance: Some(distance),
        ..Row::default()
    };
    Ok((row, cost))
}

/// The shortest distance, doubled each time, whose extrapolation is exact enough.
fn distance(scene: &Scene, relative_error: f64) -> Result<f64> {
    let spacing = scene.theory()?.contact_length() / COARSE;
    for power in DISTANCES {
        let lengths = f64::from(power).exp2();
        let far = scene.half_space(spacing, lengths)?.stationary(ANY_DRIFT)?;
        if far.distance_error < relative_error * far.friction_coefficient {
            return Ok(lengths);
        }
    }
    bail!("no sliding distance up to 2^8 contact lengths has the relative error {relative_error:e}")
}

/// A spacing with its relative error.
struct Spacing {
    length: f64,
    error: f64,
}

/// The coarsest spacing of a refinement with square elements at which mean and scatter of single grids are exact enough.
fn spacing(scene: &Scene, relative_error: f64) -> Result<Spacing> {
    let estimate = scene.friction(&refined_to(0.1 * relative_error, 1.0))?;
    let limit = estimate.friction_coefficient.value;
    // A coarse grid that is exact by accident is not taken: all finer ones must be exact enough too.
    let refinements = estimate.refinements.iter().rev().map(|refinement| {
        let friction = refinement.friction_coefficient;
        Spacing {
            length: refinement.spacing,
            error: ((friction.value - limit).abs() + friction.scatter) / limit,
        }
    });
    let exact = refinements.take_while(|spacing| spacing.error < relative_error);
    exact
        .last()
        .context("no grid of the refinement is exact enough")
}

/// Columns that are printed.
const COLUMNS: &str = "solver exponent relative_error_asked estimated_error deviation unknowns \
                       elements_along_contact sliding_distance seconds processor_seconds";

/// Processor times of the stationary solver over that of the march, which is last.
fn ratios(rows: &[Row]) -> String {
    let Some((march, others)) = rows.split_last() else {
        return String::new();
    };
    let key = |row: &Row| [row.exponent, row.relative_error_asked].map(f64::to_bits);
    let same = others.iter().filter(|row| key(row) == key(march));
    let ratios = same.map(|row| {
        format!(
            "p = {}, relative error {:e}: {} takes 1/{:.0} of the processor time of the march in time",
            row.exponent,
            row.relative_error_asked,
            row.solver,
            march.processor_seconds / row.processor_seconds
        )
    });
    ratios.collect::<Vec<_>>().join("\n")
}
