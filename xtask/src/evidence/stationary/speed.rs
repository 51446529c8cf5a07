//! Time to a stated error, by the stationary solver and by the march in time.
//!
//! The march has one grid, whose error comes from the outline that follows the elements and from the singular front, and
//! a finite sliding distance. It uses the same discretisation as the stationary solver with square elements, so that the
//! ladder of that solver tells the error of each spacing; the distance is doubled on a coarse grid until the
//! extrapolation to an infinite one is exact enough.

use anyhow::{Context, Result};
use bem_halfspace::Footprint;
use bem_halfspace::steady::{
    FrictionEstimate, FrictionOptions, SteadyOptions, steady, steady_friction,
};
use serde::Serialize;

use crate::meter::{Cost, measure, measure_best};
use crate::output::markdown_table;
use crate::progress;
use crate::scene::Scene;

/// Exponents and the relative errors asked for.
const STATIONARY: [(f64, f64); 5] = [
    (1.0, 1e-3),
    (1.0, 1e-4),
    (2.0, 1e-3),
    (2.0, 1e-4),
    (1.5, 1e-5),
];
const STATIONARY_WITH_BAR: &str = "stationary";
const SINGLE_GRID: &str = "stationary, one grid";
/// The race is run with the paraboloid.
const RACE: f64 = 2.0;
const RACE_ERROR: f64 = 1e-3;
const QUICK_RACE_ERROR: f64 = 1e-2;
/// Part of the error that may come from the distance; the rest is for the grid.
const DISTANCE_SHARE: f64 = 0.25;
/// Elements along the contact length on the grid that finds the distance, and the shortest and longest distance in such
/// lengths.
const PILOT_ELEMENTS: f64 = 8.0;
const SHORTEST: i32 = 2;
const LONGEST: i32 = 8;
/// Gaps left on a single grid relative to the error asked for, and contact sets tried.
const GAP_SHARE: f64 = 1e-3;
const MAX_ITERATIONS: usize = 500;
/// Any change over the second half of the distance counts as stationary, because the error is what is looked at.
const ANY_DRIFT: f64 = 1.0;

/// One run; friction belongs to F_N/(4ηv) = 1 and the coefficient 1 of the profile.
#[derive(Debug, Clone, Serialize)]
pub(super) struct Row {
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
    /// Of the march in time, both in contact lengths of the one-dimensional model.
    elements_along_contact: Option<f64>,
    sliding_distance: Option<f64>,
    seconds: f64,
    processor_seconds: f64,
}

/// Runs of the stationary solver, then it on a single grid and the march in time for the paraboloid.
pub(super) fn compute(quick: bool) -> Result<Vec<Row>> {
    let (runs, race_error) = if quick {
        (
            vec![(RACE, QUICK_RACE_ERROR), (RACE, RACE_ERROR)],
            QUICK_RACE_ERROR,
        )
    } else {
        (STATIONARY.to_vec(), RACE_ERROR)
    };
    let bar = progress::bar("speed", runs.len() + 2);
    let mut rows = Vec::new();
    for (exponent, relative_error) in runs {
        rows.push(stationary(exponent, relative_error)?);
        bar.inc(1);
    }
    rows.push(single_grid(race_error)?);
    bar.inc(1);
    rows.push(march(race_error)?);
    bar.finish_and_clear();
    compare(&mut rows);
    Ok(rows)
}

/// Fills in the deviations.
fn compare(rows: &mut [Row]) {
    let all = rows.to_vec();
    for row in rows {
        let best = all
            .iter()
            .filter(|other| other.exponent.total_cmp(&row.exponent).is_eq())
            .filter(|other| other.solver == STATIONARY_WITH_BAR)
            .min_by(|one, other| {
                one.relative_error_asked
                    .total_cmp(&other.relative_error_asked)
            });
        row.deviation = best
            .filter(|best| best.relative_error_asked < row.relative_error_asked)
            .map(|best| (row.friction / best.friction - 1.0).abs());
    }
}

fn friction(scene: &Scene, options: &FrictionOptions) -> Result<FrictionEstimate> {
    Ok(steady_friction(
        &scene.body,
        &scene.material,
        &scene.load,
        options,
    )?)
}

fn stationary(exponent: f64, relative_error: f64) -> Result<Row> {
    let scene = Scene::unit(exponent)?;
    let options = FrictionOptions {
        relative_error,
        ..FrictionOptions::default()
    };
    let (
        estimate,
        Cost {
            seconds,
            processor_seconds,
        },
    ) = measure_best(|| friction(&scene, &options));
    let estimate = estimate?;
    let last = estimate.refinements.last().context("no refinement")?;
    Ok(Row {
        solver: STATIONARY_WITH_BAR,
        exponent,
        relative_error_asked: relative_error,
        friction: estimate.friction_coefficient,
        estimated_error: estimate.error / estimate.friction_coefficient,
        deviation: None,
        unknowns: last.unknowns,
        elements_along_contact: None,
        sliding_distance: None,
        seconds,
        processor_seconds,
    })
}

/// The stationary equations on one grid that is fine enough, chosen as that of the march is, and as that without a bar.
fn single_grid(relative_error: f64) -> Result<Row> {
    let scene = Scene::unit(RACE)?;
    let spacing = spacing(&scene, relative_error)?;
    let Scene {
        body,
        material,
        load,
    } = &scene;
    let options = SteadyOptions {
        spacing: [spacing.length; 2],
        phase: [0.0, 0.0],
        footprint: Footprint::of_body(body, material, load)?,
        tolerance: GAP_SHARE * relative_error,
        max_iterations: MAX_ITERATIONS,
    };
    let (
        solution,
        Cost {
            seconds,
            processor_seconds,
        },
    ) = measure_best(|| steady(body, material, load, &options));
    let solution = solution?;
    Ok(Row {
        solver: SINGLE_GRID,
        exponent: RACE,
        relative_error_asked: relative_error,
        friction: solution.friction_coefficient,
        estimated_error: spacing.error,
        deviation: None,
        unknowns: solution.unknowns,
        elements_along_contact: Some(scene.theory()?.contact_length() / spacing.length),
        sliding_distance: None,
        seconds,
        processor_seconds,
    })
}

fn march(relative_error: f64) -> Result<Row> {
    let scene = Scene::unit(RACE)?;
    let length = scene.theory()?.contact_length();
    let distance = distance(&scene, DISTANCE_SHARE * relative_error)?;
    let spacing = spacing(&scene, (1.0 - DISTANCE_SHARE) * relative_error)?;
    let (
        transient,
        Cost {
            seconds,
            processor_seconds,
        },
    ) = measure(|| scene.half_space(spacing.length, distance));
    let transient = transient?;
    let far = transient.stationary(ANY_DRIFT)?;
    Ok(Row {
        solver: "march in time",
        exponent: RACE,
        relative_error_asked: relative_error,
        friction: far.friction_coefficient,
        estimated_error: spacing.error + far.distance_error / far.friction_coefficient,
        deviation: None,
        unknowns: transient.n_elements,
        elements_along_contact: Some(length / spacing.length),
        sliding_distance: Some(distance),
        seconds,
        processor_seconds,
    })
}

/// The shortest distance, doubled each time, whose extrapolation is exact enough.
fn distance(scene: &Scene, relative_error: f64) -> Result<f64> {
    let spacing = scene.theory()?.contact_length() / PILOT_ELEMENTS;
    for power in SHORTEST..=LONGEST {
        let lengths = f64::from(power).exp2();
        let far = scene.half_space(spacing, lengths)?.stationary(ANY_DRIFT)?;
        if far.distance_error < relative_error * far.friction_coefficient {
            return Ok(lengths);
        }
    }
    anyhow::bail!(
        "no sliding distance up to 2^{LONGEST} contact lengths has the relative error {relative_error:e}"
    )
}

/// A spacing with its relative error.
struct Spacing {
    length: f64,
    error: f64,
}

/// The coarsest spacing of a ladder with square elements at which mean and scatter of single grids are exact enough.
fn spacing(scene: &Scene, relative_error: f64) -> Result<Spacing> {
    let options = FrictionOptions {
        relative_error: 0.1 * relative_error,
        aspect: 1.0,
        ..FrictionOptions::default()
    };
    let estimate = friction(scene, &options)?;
    let limit = estimate.friction_coefficient;
    let errors = estimate.refinements.iter().map(|refinement| Spacing {
        length: refinement.spacing,
        error: ((refinement.friction_coefficient - limit).abs() + refinement.scatter) / limit,
    });
    // A coarse grid that is exact by accident does not count: all finer ones must be exact enough too.
    let mut errors: Vec<Spacing> = errors.collect();
    errors.reverse();
    let exact = errors
        .into_iter()
        .take_while(|spacing| spacing.error < relative_error);
    exact
        .last()
        .context("no grid of the ladder is exact enough")
}

/// The table, and how much faster the stationary solver is.
pub(super) fn summary(rows: &[Row]) -> String {
    let number = |value: Option<f64>, digits: usize| {
        value.map_or_else(String::new, |value| format!("{value:.digits$}"))
    };
    let table = markdown_table(
        [
            "solver",
            "p",
            "asked",
            "estimated",
            "deviation",
            "unknowns",
            "Δx per length",
            "distance",
            "s",
            "processor s",
        ],
        rows.iter().map(|row| {
            [
                row.solver.to_owned(),
                row.exponent.to_string(),
                format!("{:e}", row.relative_error_asked),
                format!("{:.1e}", row.estimated_error),
                row.deviation
                    .map_or_else(String::new, |value| format!("{value:.1e}")),
                row.unknowns.to_string(),
                number(row.elements_along_contact, 1),
                number(row.sliding_distance, 0),
                format!("{:.3}", row.seconds),
                format!("{:.3}", row.processor_seconds),
            ]
        }),
    );
    format!("{table}\n{}", race(rows))
}

fn race(rows: &[Row]) -> String {
    let Some((march, others)) = rows.split_last() else {
        return String::new();
    };
    let same = |row: &&Row| {
        row.exponent.total_cmp(&march.exponent).is_eq()
            && row
                .relative_error_asked
                .total_cmp(&march.relative_error_asked)
                .is_eq()
    };
    let ratio = |row: &Row| {
        format!(
            "p = {}, relative error {:e}: {} takes 1/{:.0} of the processor time of the march in time",
            row.exponent,
            row.relative_error_asked,
            row.solver,
            march.processor_seconds / row.processor_seconds
        )
    };
    let ratios: Vec<String> = others.iter().filter(same).map(ratio).collect();
    ratios.join("\n")
}
