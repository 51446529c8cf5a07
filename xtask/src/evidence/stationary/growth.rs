//! Time and memory over the number of elements in contact, for one paraboloid on one grid.

use anyhow::{Context, Result};
use bem_halfspace::Footprint;
use bem_halfspace::steady::{
    FrictionOptions, SteadyOptions, SteadySliding, steady, steady_friction,
};
use serde::Serialize;

use crate::meter::{measure, peak_memory};
use crate::output::markdown_table;
use crate::scene::Scene;
use crate::tasks::in_turn;

/// Elements in contact on the smallest grid.
const SMALLEST: f64 = 1e3;
/// Δy/Δx, as `steady_friction` has it unless told otherwise.
const ASPECT: f64 = 0.5;
/// Gaps left in contact relative to F_N/(4ηv), as `steady_friction` has them for a relative error of 1e-3.
const TOLERANCE: f64 = 1e-7;
const MAX_ITERATIONS: usize = 500;
/// Smaller grids are left out of the exponent of growth where larger ones suffice for it.
const FITTED_FROM: f64 = 9e3;
/// Elements along the contact length on the grid that the area of the contact is taken from.
const PILOT: f64 = 40.0;
/// Relative error of the friction coefficient that the others are compared with.
const REFERENCE_ERROR: f64 = 1e-4;

/// One grid, from a cold start; coarser grids that the solver starts from are in its cost.
#[derive(Debug, Clone, Serialize)]
pub(super) struct Row {
    elements_in_contact: f64,
    unknowns: usize,
    contact_sets: usize,
    seconds: f64,
    processor_seconds: f64,
    /// Most memory resident up to here.
    peak_memory_mib: Option<f64>,
    residual: f64,
    /// Of the friction coefficient on this one grid, from the extrapolated one.
    relative_deviation: f64,
}

/// Grids from the smallest to the largest, √10 times as many elements each.
pub(super) fn compute(largest: f64) -> Result<Vec<Row>> {
    let scene = Scene::unit(2.0)?;
    let options = FrictionOptions {
        relative_error: REFERENCE_ERROR,
        ..FrictionOptions::default()
    };
    let limit = steady_friction(&scene.body, &scene.material, &scene.load, &options)?;
    let area = solve(&scene, scene.theory()?.contact_length() / PILOT)?.contact_area;
    let sizes = sizes(largest);
    in_turn("growth", &sizes, |&size| {
        let (solution, cost) = measure(|| solve(&scene, (area / (size * ASPECT)).sqrt()));
        let solution = solution.with_context(|| format!("{size:.0} elements in contact"))?;
        let [dx, dy] = solution.pressure.grid.spacing();
        Ok(Row {
            elements_in_contact: (solution.contact_area / dx / dy).round(),
            unknowns: solution.unknowns,
            contact_sets: solution.iterations,
            seconds: cost.seconds,
            processor_seconds: cost.processor_seconds,
            peak_memory_mib: peak_memory(),
            residual: solution.residual,
            relative_deviation: solution.friction_coefficient / limit.friction_coefficient - 1.0,
        })
    })
}

fn sizes(largest: f64) -> Vec<f64> {
    let steps = (2.0 * (largest / SMALLEST).log10()).round().max(1.0);
    let ratio = (largest / SMALLEST).powf(1.0 / steps);
    std::iter::successors(Some(SMALLEST), |size| Some(size * ratio))
        .take_while(|size| *size < 1.01 * largest)
        .collect()
}

fn solve(scene: &Scene, spacing: f64) -> Result<SteadySliding> {
    let Scene {
        body,
        material,
        load,
    } = scene;
    let options = SteadyOptions {
        spacing: [spacing, ASPECT * spacing],
        phase: [0.0, 0.0],
        footprint: Footprint::of_body(body, material, load)?,
        tolerance: TOLERANCE,
        max_iterations: MAX_ITERATIONS,
    };
    Ok(steady(body, material, load, &options)?)
}

/// The table, and the exponent of growth.
pub(super) fn summary(rows: &[Row]) -> String {
    let table = markdown_table(
        [
            "elements",
            "unknowns",
            "sets",
            "s",
            "processor s",
            "MiB",
            "deviation of μ",
        ],
        rows.iter().map(|row| {
            [
                format!("{:.0}", row.elements_in_contact),
                row.unknowns.to_string(),
                row.contact_sets.to_string(),
                format!("{:.3}", row.seconds),
                format!("{:.3}", row.processor_seconds),
                row.peak_memory_mib
                    .map_or_else(String::new, |memory| format!("{memory:.0}")),
                format!("{:.1e}", row.relative_deviation),
            ]
        }),
    );
    let large = rows
        .iter()
        .filter(|row| row.elements_in_contact > FITTED_FROM);
    let fitted = if large.count() > 1 { FITTED_FROM } else { 0.0 };
    let points: Vec<[f64; 2]> = rows
        .iter()
        .filter(|row| row.elements_in_contact > fitted)
        .map(|row| [row.elements_in_contact.ln(), row.processor_seconds.ln()])
        .collect();
    format!(
        "{table}\nexponent of growth of the processor time over the last {} grids: {:.2}",
        points.len(),
        slope(&points)
    )
}

/// Slope of the line through the points by least squares.
fn slope(points: &[[f64; 2]]) -> f64 {
    let count = points.len() as f64;
    let mean = |axis: usize| points.iter().map(|point| point[axis]).sum::<f64>() / count;
    let [x, y] = [mean(0), mean(1)];
    let covariance: f64 = points
        .iter()
        .map(|point| (point[0] - x) * (point[1] - y))
        .sum();
    let variance: f64 = points.iter().map(|point| (point[0] - x).powi(2)).sum();
    covariance / variance
}
