//! Time and memory over the number of elements in contact, for one paraboloid on one grid.

use anyhow::{Context, Result};
use bem_halfspace::steady::SteadySliding;
use benches::memory;
use serde::Serialize;

use super::Table;
use crate::evidence::fit::exponent;
use crate::meter::measure as metered;
use crate::output::points;
use crate::scene::{Scene, refined_to};
use crate::tasks::in_turn;

/// Elements in contact on the smallest grid.
const SMALLEST: f64 = 1e3;
/// Δy/Δx, as the stationary solver has it unless told otherwise.
const ASPECT: f64 = 0.5;
/// Residual in contact relative to F_N/(4ηv), as the stationary solver has it for a relative error of 1e-3.
const TOLERANCE: f64 = 1e-7;
/// Smaller grids are left out of the exponent of growth where larger ones suffice for it.
const FITTED_FROM: f64 = 9e3;
/// Elements along the contact length on the grid that the area of the contact is taken from.
const COARSE: f64 = 40.0;
/// Relative error of the friction coefficient that the others are compared with.
const REFERENCE_ERROR: f64 = 1e-4;

/// One grid, from a cold start; coarser grids that the solver starts from are in its cost.
#[derive(Debug, Clone, Serialize)]
struct Row {
    elements_in_contact: f64,
    unknowns: usize,
    contact_sets: usize,
    seconds: f64,
    processor_seconds: f64,
    /// Most memory resident up to here.
    peak_memory_mib: Option<f64>,
    /// Of the friction coefficient on this one grid, from the extrapolated one.
    relative_deviation: f64,
}

/// Grids from the smallest to the largest, √10 times as many elements each.
pub(super) fn measure(largest: f64) -> Result<(Table, String)> {
    let scene = Scene::unit(2.0)?;
    let limit = scene.friction(&refined_to(REFERENCE_ERROR, ASPECT))?;
    let limit = limit.friction_coefficient.value;
    let solve = |spacing: f64| -> Result<SteadySliding> {
        scene.on_one_grid([spacing, ASPECT * spacing], [0.0; 2], TOLERANCE)
    };
    let area = solve(scene.theory()?.contact_length() / COARSE)?.contact_area;
    let steps = (2.0 * (largest / SMALLEST).log10()).round().max(1.0);
    let ratio = (largest / SMALLEST).powf(1.0 / steps);
    let sizes: Vec<f64> = std::iter::successors(Some(SMALLEST), |size| Some(size * ratio))
        .take_while(|size| *size < 1.01 * largest)
        .collect();
    let rows = in_turn("growth", &sizes, |size| {
        let (solution, cost) = metered(|| solve((area / (size * ASPECT)).sqrt()));
        let solution = solution.with_context(|| format!("{size:.0} elements in contact"))?;
        let [dx, dy] = solution.pressure.grid.spacing();
        Ok(Row {
            elements_in_contact: (solution.contact_area / dx / dy).round(),
            unknowns: solution.unknowns,
            contact_sets: solution.iterations,
            seconds: cost.seconds,
            processor_seconds: cost.processor_seconds,
            peak_memory_mib: memory("VmHWM:").map(|bytes| bytes / (1 << 20) as f64),
            relative_deviation: solution.friction_coefficient / limit - 1.0,
        })
    })?;
    let table = Table::new("growth", &rows)?;
    let summary = format!("{}\n{}", table.markdown(COLUMNS)?, growth(&rows));
    Ok((table, summary))
}

/// Columns that are printed.
const COLUMNS: &str = "elements_in_contact unknowns contact_sets seconds processor_seconds \
                       peak_memory_mib relative_deviation";

fn growth(rows: &[Row]) -> String {
    let elements = |row: &Row| row.elements_in_contact;
    let mut points = points(rows, elements, |row| row.processor_seconds);
    if points.iter().filter(|point| point[0] > FITTED_FROM).count() > 1 {
        points.retain(|point| point[0] > FITTED_FROM);
    }
    format!(
        "exponent of growth of the processor time over the last {} grids: {:.2}",
        points.len(),
        exponent(&points).value
    )
}
