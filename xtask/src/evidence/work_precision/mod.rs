//! Error against run time of every method on every benchmark scene.

mod contacts;
mod picture;
mod scenes;
mod series;

use anyhow::Result;
use serde::Serialize;

use super::fit::clear_exponent;
use super::{Report, Table};
use crate::output::{markdown_table, points};
use crate::tasks::in_turn;
use scenes::{QUICK_SCENES, SCENES, Scene};
use series::{Measured, Row};

/// How much is measured.
struct Extent {
    scenes: &'static [Scene],
    /// Runs of each method, from the coarsest on.
    runs: usize,
    timed_once: bool,
    /// Elements along the edges of the grids of the Hertz contact, and of the rough surface.
    edges: &'static [usize],
    rough_edge: usize,
}

const FULL: Extent = Extent {
    scenes: &SCENES,
    runs: usize::MAX,
    timed_once: false,
    edges: &[128, 256, 512, 1024, 2048],
    rough_edge: 512,
};

const QUICK: Extent = Extent {
    scenes: &QUICK_SCENES,
    runs: 3,
    timed_once: true,
    edges: &[32, 64, 128],
    rough_edge: 64,
};

/// Relative errors whose time is printed, and their names.
const PRINTED: [(f64, &str); 5] = [
    (1e-2, "1 %"),
    (1e-3, "0.1 %"),
    (1e-4, "0.01 %"),
    (1e-6, "10⁻⁶"),
    (1e-9, "10⁻⁹"),
];

/// Measures on one thread; a quick run takes a few scenes at coarse resolutions only, each timed once.
pub(super) fn report(quick: bool) -> Result<Report> {
    let extent = if quick { QUICK } else { FULL };
    // On one thread processor time is the time on an idle machine.
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build()?;
    let Measured { rows, refused, .. } = pool.install(|| measure(&extent))?;
    let series = || rows.chunk_by(Row::is_of_series);
    let fits: Vec<Fit> = series().map(Fit::of).collect();
    let (sliding, at_rest): (Vec<&Row>, Vec<&Row>) = rows.iter().partition(|row| row.slides());
    Ok(Report {
        name: "work_precision",
        tables: vec![
            Table::new("work_precision", &rows)?,
            Table::new("work_precision_orders", &fits)?,
        ],
        pictures: vec![
            ("work_precision_sliding", picture::figure(&sliding)),
            ("work_precision_at_rest", picture::figure(&at_rest)),
        ],
        summary: format!("{}{refused}", table(fits.iter().zip(series()))),
        failure: None,
    })
}

fn measure(extent: &Extent) -> Result<Measured> {
    let mut measured = Measured {
        once: extent.timed_once,
        ..Measured::default()
    };
    in_turn("work and precision", extent.scenes, |scene| {
        measured.add_scene(scene, extent.runs)
    })?;
    contacts::hertz(&mut measured, extent.edges);
    contacts::rough(&mut measured, extent.rough_edge)?;
    Ok(measured)
}

/// How one method converges on one scene, and what that costs.
#[derive(Debug, Clone, Serialize)]
struct Fit {
    scene: &'static str,
    model: &'static str,
    method: String,
    resolution_kind: &'static str,
    /// Runs that the order is fitted to, whose errors are larger than that of the reference and than rounding.
    runs_fitted: usize,
    /// q of error ∼ (1/elements)^q, or ∼ tolerance^q.
    order: Option<f64>,
    /// Standard error of the order.
    order_error: Option<f64>,
    /// q of processor time ∼ unknowns^q.
    cost_exponent: Option<f64>,
    /// Standard error of this exponent.
    cost_exponent_error: Option<f64>,
}

impl Fit {
    /// The fit of the runs of one series, of which there is one at least.
    fn of(rows: &[Row]) -> Self {
        let first = &rows[0];
        let resolved = rows.iter().filter(|row| row.is_resolved());
        let errors = resolved.filter_map(|row| Some([row.fineness()?, row.error]));
        let errors: Vec<[f64; 2]> = errors.collect();
        let numerical: Vec<&Row> = rows.iter().filter(|row| row.unknowns > 0).collect();
        let unknowns = |row: &&Row| row.unknowns as f64;
        let costs = points(&numerical, unknowns, |row| row.processor_seconds);
        let [order, cost] = [clear_exponent(&errors), clear_exponent(&costs)];
        Self {
            scene: first.scene,
            model: first.model,
            method: first.method.clone(),
            resolution_kind: first.resolution_kind,
            runs_fitted: errors.len(),
            order: order.map(|order| order.value),
            order_error: order.map(|order| order.error),
            cost_exponent: cost.map(|cost| cost.value),
            cost_exponent_error: cost.map(|cost| cost.error),
        }
    }
}

/// Order, exponent of cost, and the time to an error: one row per series, one column per error.
fn table<'a>(series: impl Iterator<Item = (&'a Fit, &'a [Row])>) -> comfy_table::Table {
    let header = ["scene", "model", "method", "over", "order", "cost exponent"];
    let header = header.into_iter().chain(PRINTED.map(|(_, name)| name));
    let rows = series.map(|(fit, rows)| {
        let cells = [
            fit.scene.to_owned(),
            fit.model.to_owned(),
            fit.method.clone(),
            fit.resolution_kind.to_owned(),
            exponent(fit.order, fit.order_error),
            exponent(fit.cost_exponent, fit.cost_exponent_error),
        ];
        let times = PRINTED.map(|(error, _)| time_to(rows, error));
        cells.into_iter().chain(times).collect::<Vec<_>>()
    });
    markdown_table(header, rows)
}

fn exponent(value: Option<f64>, error: Option<f64>) -> String {
    value.zip(error).map_or_else(String::new, |(value, error)| {
        format!("{value:.2} ± {error:.2}")
    })
}

/// The time of the coarsest run from which on all finer ones are as exact, because one alone may be so by chance.
fn time_to(rows: &[Row], error: f64) -> String {
    let bad = rows.iter().rposition(|row| row.visible_error() > error);
    rows.get(bad.map_or(0, |bad| bad + 1))
        .map_or_else(String::new, |row| duration(row.processor_seconds))
}

fn duration(seconds: f64) -> String {
    match seconds {
        seconds if seconds < 1e-5 => format!("{:.1} µs", 1e6 * seconds),
        seconds if seconds < 1e-3 => format!("{:.0} µs", 1e6 * seconds),
        seconds if seconds < 1e-2 => format!("{:.1} ms", 1e3 * seconds),
        seconds if seconds < 1.0 => format!("{:.0} ms", 1e3 * seconds),
        seconds => format!("{seconds:.1} s"),
    }
}
