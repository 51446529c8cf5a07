//! Error against run time of every method on every benchmark scene.
//!
//! `scenes.toml` holds the scenes, and by which methods and in which resolutions each is solved.

mod measured;
mod picture;

use anyhow::Result;
use bem_halfspace::ContactState;
use benches::{ContactScene, rough_heights};
use casebook::{HERTZ_DEPTH, deviation};
use serde::{Deserialize, Serialize};
use viscofriction::scene::{Accuracy, Method, Model, Scene};

use super::Report;
use super::fit::clear_exponent;
use super::request::{Request, presses};
use crate::output::points;
use crate::table::{Table, markdown_table};
use crate::tasks::in_turn;
use measured::{DEPTH, Found, Measured, Row};

/// What `scenes.toml` holds.
#[derive(Deserialize)]
struct Cases {
    /// Series of the methods that solve a scene that slides.
    sliding: Vec<Series>,
    /// Series of the methods that solve a scene that is only pressed.
    pressed: Vec<Series>,
    /// The scenes.
    case: Vec<Case>,
}

/// Resolutions of one method, from coarse to fine: relative errors or elements along the contact.
#[derive(Deserialize)]
struct Series {
    model: Model,
    method: Method,
    #[serde(default)]
    errors: Vec<f64>,
    #[serde(default)]
    elements: Vec<usize>,
}

/// A benchmark scene.
#[derive(Deserialize)]
struct Case {
    /// For tables and pictures.
    name: String,
    /// Whether a quick run takes it.
    #[serde(default)]
    is_quick: bool,
    scene: Scene,
}

impl Series {
    /// The first `runs` requests of the series, from coarse to fine.
    fn requests(&self, runs: usize) -> impl Iterator<Item = Request> {
        let errors = self.errors.iter().copied().map(Accuracy::RelativeError);
        let all = errors.chain(self.elements.iter().copied().map(Accuracy::Elements));
        let request = |accuracy| Request::new(self.model, self.method, accuracy);
        all.take(runs).map(request)
    }
}

/// Relative errors for which the table has the time that a method takes to reach them, and heads of these columns.
const PRINTED: [(f64, &str); 5] = [
    (1e-2, "1 %"),
    (1e-3, "0.1 %"),
    (1e-4, "0.01 %"),
    (1e-6, "10⁻⁶"),
    (1e-9, "10⁻⁹"),
];

/// Measures on one thread; a quick run takes a few scenes at coarse resolutions only, each timed once.
pub(super) fn report(quick: bool) -> Result<Report> {
    // Measure on one thread, on which the processor time is the time on an idle machine.
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build()?;
    let Measured { rows, refused, .. } = pool.install(|| measure(quick))?;
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

/// Number of runs of each method in a quick measurement, from the coarsest on.
const QUICK_RUNS: usize = 3;
/// Elements along the edges of the grids of the Hertz contact in a full measurement and in a quick one.
const HERTZ_EDGES: [&[usize]; 2] = [&[128, 256, 512, 1024, 2048], &[32, 64, 128]];
/// Elements along the edge of the rough surface in a full measurement and in a quick one.
const ROUGH_EDGE: [usize; 2] = [512, 64];

/// Measures all scenes of the file, then the contacts at one instant.
fn measure(quick: bool) -> Result<Measured> {
    let Cases {
        sliding,
        pressed,
        case: mut cases,
    } = toml::from_str(include_str!("scenes.toml"))?;
    cases.retain(|case| case.is_quick || !quick);
    let mut measured = Measured {
        is_once: quick,
        ..Measured::default()
    };
    let runs = if quick { QUICK_RUNS } else { usize::MAX };
    in_turn("work and precision", &cases, |case| {
        let is_pressed = presses(&case.scene);
        let series = if is_pressed { &pressed } else { &sliding };
        let requests = series.iter().flat_map(|series| series.requests(runs));
        measured.add_scene(&case.name, &case.scene, &requests.collect::<Vec<_>>())
    })?;
    hertz(&mut measured, HERTZ_EDGES[usize::from(quick)]);
    rough(&mut measured, ROUGH_EDGE[usize::from(quick)])?;
    Ok(measured)
}

/// Relative residual to which the Hertz contact is solved. Chosen so far below the discretisation error of its grids that only
/// this error is seen.
const HERTZ_TOLERANCE: f64 = 1e-9;
/// Relative residuals to which the rough surface is solved.
const ROUGH_TOLERANCES: [f64; 5] = [1e-2, 1e-4, 1e-6, 1e-8, 1e-10];
/// Relative residual of the solution on the same grid with which those of [`ROUGH_TOLERANCES`] are compared. Chosen.
const ROUGH_REFERENCE_TOLERANCE: f64 = 1e-12;

/// The depth of the Hertz contact on square grids with these numbers of elements along an edge. The time includes the set-up of
/// the convolution.
fn hertz(measured: &mut Measured, edges: &[usize]) {
    for &edge in edges {
        let run = Row {
            // Name the scene by the theory alone, because all Hertz contacts are similar.
            scene: "Hertz".to_owned(),
            quantity: DEPTH,
            resolution_kind: "elements",
            resolution: Some(edge as f64),
            reference: "closed form".to_owned(),
            reference_error: f64::EPSILON,
            ..Row::of_one_instant()
        };
        measured.add(run, || {
            let (contact, state) = ContactScene::hertz(edge, 0.0)?.solve(HERTZ_TOLERANCE)?;
            Ok(found(&state, &[contact.indentation_depth], &[HERTZ_DEPTH]))
        });
    }
}

/// The pressure on a rough surface, against a far more accurate solution of the same discrete problem.
fn rough(measured: &mut Measured, edge: usize) -> Result<()> {
    let scene = ContactScene::periodic(rough_heights(edge, 0)?)?;
    let (contact, exact) = scene.solve(ROUGH_REFERENCE_TOLERANCE)?;
    for tolerance in ROUGH_TOLERANCES {
        let run = Row {
            scene: "rough surface".to_owned(),
            quantity: "pressure",
            resolution_kind: "tolerance",
            resolution: Some(tolerance),
            reference: format!("the same grid to {ROUGH_REFERENCE_TOLERANCE:e}"),
            reference_error: contact.residual.max(ROUGH_REFERENCE_TOLERANCE),
            ..Row::of_one_instant()
        };
        measured.add(run, || {
            let (_, state) = scene.solve(tolerance)?;
            Ok(found(&state, state.pressure(), exact.pressure()))
        });
    }
    Ok(())
}

/// The result of a contact whose `values` are compared with `exact` ones.
fn found(state: &ContactState, values: &[f64], exact: &[f64]) -> Found {
    Found {
        error: deviation(values, exact),
        error_bar: None,
        unknowns: state.pressure().len(),
    }
}

/// How one method converges on one scene, and what that costs.
#[derive(Debug, Clone, Serialize)]
struct Fit {
    scene: String,
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
    /// The fit of the runs of one series; at least one.
    fn of(rows: &[Row]) -> Self {
        let resolved = rows.iter().filter(|row| row.is_resolved());
        let errors = resolved.filter_map(|row| Some([row.fineness()?, row.error]));
        let errors: Vec<[f64; 2]> = errors.collect();
        let numerical: Vec<&Row> = rows.iter().filter(|row| row.unknowns > 0).collect();
        let unknowns = |row: &&Row| row.unknowns as f64;
        let costs = points(&numerical, unknowns, |row| row.processor_seconds);
        let [order, cost] = [clear_exponent(&errors), clear_exponent(&costs)];
        let first = rows[0].clone();
        Self {
            scene: first.scene,
            model: first.model,
            method: first.method,
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
    let of_fit = ["scene", "model", "method", "over", "order", "cost exponent"];
    let header = of_fit.into_iter().chain(PRINTED.map(|(_, name)| name));
    let rows = series.map(|(fit, rows)| {
        let mut cells = vec![
            fit.scene.clone(),
            fit.model.to_owned(),
            fit.method.clone(),
            fit.resolution_kind.to_owned(),
            exponent(fit.order.zip(fit.order_error)),
            exponent(fit.cost_exponent.zip(fit.cost_exponent_error)),
        ];
        cells.extend(PRINTED.map(|(error, _)| time_to(rows, error)));
        cells
    });
    markdown_table(header, rows)
}

/// A cell with an exponent and its standard error; empty without one.
fn exponent(known: Option<(f64, f64)>) -> String {
    let text = known.map(|(value, error)| format!("{value:.2} ± {error:.2}"));
    text.unwrap_or_default()
}

/// The processor time of the coarsest run for which it and all finer ones reach a relative error, as a cell; a single run may
/// reach it by chance. Empty where none does. `rows` go from coarse to fine.
fn time_to(rows: &[Row], error: f64) -> String {
    let bad = rows.iter().rposition(|row| row.visible_error() > error);
    let good = rows.get(bad.map_or(0, |bad| bad + 1));
    good.map(|row| duration(row.processor_seconds))
        .unwrap_or_default()
}

/// A time with its unit, two or three digits.
fn duration(seconds: f64) -> String {
    match seconds {
        seconds if seconds < 1e-5 => format!("{:.1} µs", 1e6 * seconds),
        seconds if seconds < 1e-3 => format!("{:.0} µs", 1e6 * seconds),
        seconds if seconds < 1e-2 => format!("{:.1} ms", 1e3 * seconds),
        seconds if seconds < 1.0 => format!("{:.0} ms", 1e3 * seconds),
        seconds => format!("{seconds:.1} s"),
    }
}
