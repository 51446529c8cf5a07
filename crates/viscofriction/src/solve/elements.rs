//! Boundary-element solutions as answers.

use bem_halfspace::indent::{IndentCurve, IndentPoint, PressEstimate};
use bem_halfspace::slide::{PressureField, SlideEstimate, SlideRow};
use bem_halfspace::steady::SteadyEstimate;
use bem_halfspace::{
    ContactEstimate, GridOptions, PeriodicEstimate, PeriodicLoad, PeriodicRow, PeriodicSliding,
    PeriodicTransient, Reached, periodic,
};
use friction_analytic::{EnergyFactor, PerssonSliding, RoughLoad, SurfaceWave, persson_of_waves};
use indenters::rough::{PeriodicSurface, Wave};
use indenters::{Control, FrictionParts, Moved};
use numerics::{ErrorParts, Estimate, Request};

use super::answer::{Answer, ContactBox, Grid, HistoryRow, Persson};
use super::body::Body;
use super::curve::{AREA, Curve, DEPTH, FORCE, OfPoint};
use super::cut_off::WithoutShortestOctave;
use super::error::Result;
use super::half_space::Simple;
use super::mdr::answer_from_motion;
use super::problem::{Motion, Problem};
use crate::scene::{Method, Model};

/// An answer with the quantities that all estimates for a single body have; `[x, y]` are the ends of the contact \[m].
fn common_answer<S, O>(
    estimate: &ContactEstimate<S, O>,
    method: Method,
    [x, y]: [[f64; 2]; 2],
) -> Answer {
    Answer {
        friction_coefficient: Some(estimate.friction_coefficient),
        indentation_depth: estimate.indentation_depth,
        error_parts: estimate.error_parts,
        contact_area: Some(estimate.contact_area),
        peak_pressure: estimate.peak_pressure,
        contact_box: Some(ContactBox::around(x, y, estimate.contact_box_error)),
        ..Answer::new(method, Model::HalfSpace, estimate.normal_force)
    }
}

/// Converts a stationary estimate: quantities extrapolated over the grids; pressure, work and grid of the finest one.
pub(crate) fn answer_from_steady(problem: &Problem, estimate: SteadyEstimate) -> Result<Answer> {
    let (finest, options) = (&estimate.finest, &estimate.options);
    let ends = [finest.contact_x, finest.contact_y];
    let mut answer = Answer {
        unknowns: finest.unknowns,
        iterations: finest.iterations,
        stationary: Some(*options),
        ..common_answer(&estimate, Method::BemSteady, ends)
    };
    if let Body::Cylinder(_) = problem.body() {
        answer.is_per_length = true;
        answer.contact_box = Some(ContactBox::along(
            finest.contact_x,
            estimate.contact_box_error,
        ));
        answer.fields.line_pressure = finest.pressure.along_x();
    } else {
        answer.grid = Some(Grid {
            footprint: options.footprint.elements(options.spacing)?,
            factorised: finest.is_factorised(),
        });
        answer.fields.pressure = Some(estimate.finest.pressure);
    }
    Ok(answer)
}

/// A periodic surface with its load.
#[derive(Clone, Copy)]
pub(crate) struct Rough<'a> {
    pub(crate) surface: &'a PeriodicSurface,
    pub(crate) load: PeriodicLoad,
    /// Mean pressure of the load, \[Pa].
    pub(crate) mean_pressure: f64,
}

/// Stationary sliding of a periodic surface, or its indentation without sliding; forces and areas are those of one period.
pub(crate) fn periodic(problem: &Problem, rough: Rough, request: Request) -> Result<Answer> {
    let elastomer = problem.elastomer()?;
    let solve =
        |surface: &_, request: Request| periodic::steady(surface, &elastomer, &rough.load, request);
    let estimate = solve(rough.surface, request)?;
    let finest = estimate.finest.pressure.grid.shape();
    let mut answer = answer_from_periodic(problem, rough, estimate)?;
    answer.cut_off(WithoutShortestOctave::of(
        rough.surface,
        request,
        finest,
        solve,
    ));
    Ok(answer)
}

/// The answer of a periodic stationary estimate: with Persson's theory if the surface slides, and without friction if it does not.
fn answer_from_periodic(
    problem: &Problem,
    rough: Rough,
    estimate: PeriodicEstimate<PeriodicSliding>,
) -> Result<Answer> {
    let is_pressed = matches!(problem.motion(), Motion::Pressing(_));
    let method = if is_pressed {
        Method::BemTransient
    } else {
        Method::BemSteady
    };
    let mut answer = common_periodic_answer(problem, rough, method, &estimate);
    answer.iterations = estimate.finest.applications;
    answer.persson = Persson::of(problem)?;
    answer = answer.under(estimate.finest.pressure);
    if is_pressed {
        answer.friction_coefficient = None;
        answer.friction_from_dissipation = None;
        answer.error_parts = ErrorParts::discretisation_only(answer.requested_quantity().error);
        // The pressure of a viscoelastic contact depends on how it has grown, which a single state does not represent.
        if !matches!(problem.simple(), Some(Simple::Elastic)) {
            answer.fields.pressure = None;
        }
    }
    Ok(answer)
}

/// Solution for a sliding or pressed periodic surface on one coarse grid, without error estimates; and Persson's theory if it
/// slides. The grid has `finer` times the elements of the first grid of an answer, along each axis.
pub(crate) fn on_coarse_grid(
    problem: &Problem,
    rough: Rough,
    finer: usize,
) -> Result<(PeriodicSliding, Option<Persson>)> {
    let elastomer = problem.elastomer()?;
    let found = periodic::steady_on_coarse_grid(rough.surface, &elastomer, &rough.load, finer)?;
    Ok((found, Persson::of(problem)?))
}

/// The answer of a periodic march in time.
pub(crate) fn answer_from_periodic_transient(
    problem: &Problem,
    rough: Rough,
    estimate: PeriodicEstimate<PeriodicTransient>,
) -> Answer {
    let mut answer = common_periodic_answer(problem, rough, Method::BemTransient, &estimate);
    let rows = &estimate.finest.rows;
    answer.iterations = rows.len();
    let row = |row: &PeriodicRow| HistoryRow {
        sliding_distance_m: row.sliding_distance,
        time_s: row.time,
        indentation_depth_m: row.mean_depth,
        friction_coefficient: row.friction_coefficient,
        area_over_force: Some(row.area_fraction / rough.mean_pressure),
    };
    answer.fields.history = rows.iter().map(row).collect();
    answer.fields.gap = Some(estimate.finest.gap);
    answer.under(estimate.finest.pressure)
}

/// An answer with the quantities that all estimates for a periodic surface have; forces and areas are those of one period, the
/// depth is known on a layer only.
fn common_periodic_answer<S>(
    problem: &Problem,
    rough: Rough,
    method: Method,
    estimate: &PeriodicEstimate<S>,
) -> Answer {
    let area: f64 = rough.surface.period().iter().product();
    let mean_pressure = Estimate::exact(rough.mean_pressure);
    let is_layer = problem.thickness().is_finite();
    Answer {
        friction_coefficient: Some(estimate.friction_coefficient),
        error_parts: ErrorParts::discretisation_only(estimate.friction_coefficient.error),
        indentation_depth: is_layer.then_some(estimate.mean_depth),
        contact_area: Some(estimate.area_fraction * area),
        mean_pressure: Some(mean_pressure),
        area_fraction: Some(estimate.area_fraction),
        friction_from_dissipation: estimate.friction_from_dissipation,
        ..Answer::new(method, Model::HalfSpace, mean_pressure * area)
    }
}

/// Persson's theory of a periodic surface on a half space under a mean pressure, summed exactly over its waves. `None` for other
/// scenes, and if a Prony series stands for another law, whose error would not be part of the result.
///
/// # Errors
/// [`SolveError::Analytic`](super::SolveError) where a frequency or a result overflows.
pub fn persson(problem: &Problem) -> Result<Option<PerssonSliding>> {
    let (Body::Periodic(surface), Control::NormalForce(force)) =
        (problem.body(), problem.motion().control())
    else {
        return Ok(None);
    };
    let is_nonlinear = problem.strain_dependence().is_some();
    if problem.thickness().is_finite() || problem.expansion().is_some() || is_nonlinear {
        return Ok(None);
    }
    let wave = |wave: &Wave| SurfaceWave {
        amplitude: wave.amplitude,
        wave_vector: surface.wave_vector(wave),
    };
    let waves: Vec<SurfaceWave> = surface.waves().iter().map(wave).collect();
    let load = RoughLoad {
        mean_pressure: force / surface.period().iter().product::<f64>(),
        velocity: match problem.motion() {
            Motion::Sliding(load) => load.velocity(),
            _ => 0.0,
        },
    };
    Ok(Some(persson_of_waves(&waves, problem.material(), load)?))
}

/// Parameter γ of the contact area of Xu and others (2024), who find 0.42 to 0.45.
const XU_GAMMA: f64 = 0.45;

impl Persson {
    /// Evaluates the theory for a surface that slides; `None` if it does not apply.
    fn of(problem: &Problem) -> Result<Option<Self>> {
        let theory = match problem.motion() {
            Motion::Pressing(_) => None,
            _ => persson(problem)?,
        };
        let Some(theory) = theory else {
            return Ok(None);
        };
        let friction = |factor| theory.friction_coefficient(factor).value;
        Ok(Some(Self {
            area_fraction: theory.area_fraction.value,
            area_fraction_xu: theory.area_fraction_of_xu(XU_GAMMA)?.value,
            friction_coefficient: friction(EnergyFactor::PERSSON_2001),
            friction_coefficient_2006: friction(EnergyFactor::PERSSON_2006),
        }))
    }
}

impl Answer {
    /// Adds the answer without the shortest octave, without its friction if nothing slides.
    fn cut_off(&mut self, without: Option<WithoutShortestOctave>) {
        let slides = self.friction_coefficient.is_some();
        self.without_shortest_octave = without.map(|without| WithoutShortestOctave {
            friction_coefficient: without.friction_coefficient.filter(|_| slides),
            ..without
        });
    }

    /// Adds the pressure field of a period; the elements in contact are the unknowns.
    fn under(mut self, pressure: PressureField) -> Self {
        let elements = pressure.pressure.iter();
        self.unknowns = elements.filter(|pressure| **pressure > 0.0).count();
        self.period_grid = Some(pressure.grid.shape());
        self.fields.pressure = Some(pressure);
        self
    }
}

/// Converts a time march: quantities extrapolated over the grids; the last step, work and grid of the finest one.
pub(crate) fn answer_from_slide(estimate: SlideEstimate) -> Result<Answer> {
    let last = estimate.finest.last();
    let ends = [last.contact_x, last.contact_y];
    let mut answer = Answer {
        unknowns: last.n_contact,
        iterations: estimate.finest.rows.len(),
        grid: Some(grid_of_march(&estimate.options)?),
        ..common_answer(&estimate, Method::BemTransient, ends)
    };
    let row = |row: &SlideRow| HistoryRow {
        sliding_distance_m: row.sliding_distance,
        time_s: row.time,
        indentation_depth_m: row.indentation_depth,
        friction_coefficient: row.friction_coefficient,
        area_over_force: Some(row.contact_area / row.normal_force),
    };
    answer.fields.history = estimate.finest.rows.iter().map(row).collect();
    answer.fields.gap = estimate.finest.gap;
    answer.fields.pressure = Some(estimate.finest.pressure);
    Ok(answer)
}

/// The answer of a motion, without the unbounded depth of a periodic surface on a half space.
pub(crate) fn answer_from_moved(problem: &Problem, mut found: Moved) -> Result<Answer> {
    let parts = problem.add_shear_to_motion(&mut found)?;
    let mut answer = answer_from_motion(Method::BemTransient, Model::HalfSpace, found);
    if let Some(FrictionParts { hysteresis, shear }) = parts {
        answer.friction_from_hysteresis = Some(hysteresis);
        answer.friction_from_shear = Some(shear);
        answer.error_parts =
            (answer.error_parts).plus(ErrorParts::discretisation_only(shear.error));
    }
    if matches!(problem.body(), Body::Periodic(_)) && !problem.thickness().is_finite() {
        answer.indentation_depth = None;
    }
    Ok(answer)
}

/// Converts an indentation: quantities extrapolated over the grids; pressure, work and grid of the finest one. No friction.
pub(crate) fn answer_from_press(estimate: PressEstimate) -> Result<Answer> {
    let finest = &estimate.finest;
    let ends = [finest.contact_x, finest.contact_y];
    let mut answer = Answer {
        friction_coefficient: None,
        unknowns: finest.n_contact,
        iterations: 1,
        grid: Some(grid_of_march(&estimate.options)?),
        ..common_answer(&estimate, Method::BemTransient, ends)
    };
    answer.fields.gap = estimate
        .finest
        .gap
        .filter(|_| estimate.finest.pressure.is_some());
    answer.fields.pressure = estimate.finest.pressure;
    Ok(answer)
}

/// Converts a history: quantities of its last point, and force, depth and area at all points over time. No friction.
pub(crate) fn answer_from_curve(found: &IndentCurve) -> Result<Answer> {
    let last = found.points[found.points.len() - 1];
    let columns: [OfPoint<IndentPoint>; 3] = [
        (FORCE, |point| point.normal_force),
        (DEPTH, |point| point.indentation_depth),
        (AREA, |point| point.contact_area),
    ];
    let mut answer = Answer {
        indentation_depth: Some(last.indentation_depth),
        contact_area: Some(last.contact_area),
        error_parts: found.error_parts,
        unknowns: found.n_contact,
        iterations: found.n_steps,
        grid: Some(grid_of_march(&found.options)?),
        ..Answer::new(Method::BemTransient, Model::HalfSpace, last.normal_force)
    };
    answer.fields.curve = Curve::of(&found.points, |point| point.time, columns);
    Ok(answer)
}

/// The answer of an estimate that missed the request; `None` if it has no valid answer.
pub(crate) fn reached(problem: &Problem, rough: Option<Rough>, found: Reached) -> Option<Answer> {
    let answer = match found {
        Reached::Steady(found) => answer_from_steady(problem, found),
        Reached::Slide(found) => answer_from_slide(found),
        Reached::Press(found) => answer_from_press(found),
        Reached::Curve(found) => answer_from_curve(&found),
        Reached::Moved(found) => answer_from_moved(problem, found),
        Reached::Periodic(found) => answer_from_periodic(problem, rough?, found),
        Reached::PeriodicTransient(found) => {
            Ok(answer_from_periodic_transient(problem, rough?, found))
        }
    };
    answer.ok()
}

/// The finest grid of a time march, from its options; its equations are never factorised.
fn grid_of_march(options: &GridOptions) -> Result<Grid> {
    Ok(Grid {
        footprint: options.footprint.elements(options.spacing)?,
        factorised: false,
    })
}
