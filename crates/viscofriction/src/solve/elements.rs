//! What boundary elements say, as answers.

use bem_halfspace::indent::{IndentPoint, follow};
use bem_halfspace::slide::{SlideRow, slide};
use bem_halfspace::{
    ContactEstimate, GridOptions, PeriodicLoad, indent, steady, steady_line, steady_periodic,
};
use friction_analytic::{RoughLoad, SurfaceWave, persson_of_waves};
use indenters::rough::{PeriodicSurface, Wave};
use indenters::{Cylinder, PressingLoad, SlidingLoad, Surface};
use numerics::{ErrorParts, Estimate, Request};

use super::answer::{Answer, ContactBox, Grid, HistoryRow, Persson, RoughAnswer};
use super::curve::{AREA, Curve, DEPTH, FORCE, OfPoint};
use super::error::Result;
use super::problem::Problem;
use crate::scene::{Method, Model};

/// The quantities of an estimate, with the ends of its contact along x and y.
fn answer<S, O>(estimate: &ContactEstimate<S, O>, method: Method, [x, y]: [[f64; 2]; 2]) -> Answer {
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

/// The stationary state.
pub(crate) fn stationary(
    problem: &Problem,
    surface: &dyn Surface,
    load: &SlidingLoad,
    request: Request,
) -> Result<Answer> {
    let estimate = steady(surface, &problem.elastomer()?, load, request)?;
    let (finest, options) = (&estimate.finest, &estimate.options);
    let ends = [finest.contact_x, finest.contact_y];
    let mut answer = Answer {
        unknowns: finest.unknowns,
        iterations: finest.iterations,
        grid: Some(Grid {
            footprint: options.footprint.elements(options.spacing)?,
            factorised: finest.is_factorised(),
        }),
        ..answer(&estimate, Method::BemSteady, ends)
    };
    answer.fields.pressure = Some(estimate.finest.pressure);
    Ok(answer)
}

/// The stationary state of a cylinder in plane strain.
pub(crate) fn line_contact(
    problem: &Problem,
    cylinder: &Cylinder,
    load: &SlidingLoad,
    request: Request,
) -> Result<Answer> {
    let estimate = steady_line(cylinder, &problem.elastomer()?, load, request)?;
    let finest = &estimate.finest;
    let contact = ContactBox::along(finest.contact, estimate.contact_box_error);
    let mut answer = Answer {
        is_per_length: true,
        contact_box: Some(contact),
        unknowns: finest.unknowns,
        iterations: finest.iterations,
        ..answer(&estimate, Method::BemSteady, [finest.contact; 2])
    };
    answer.fields.line_pressure = estimate.finest.pressure;
    Ok(answer)
}

/// Largest grid of a period, and memory that one of its elements takes at most, \[bytes].
const LARGEST_GRID: u64 = 1 << 22;
const BYTES_PER_ELEMENT: u64 = 200;

/// The stationary state of a periodic surface; forces and areas are those of one period.
pub(crate) fn periodic(
    problem: &Problem,
    surface: &PeriodicSurface,
    load: &PeriodicLoad,
    relative_error: f64,
) -> Result<Answer> {
    let area: f64 = surface.period().iter().product();
    let mean_pressure = load.mean_pressure();
    let fitting = problem.max_memory.map(|bytes| bytes / BYTES_PER_ELEMENT);
    let most = fitting.map_or(LARGEST_GRID, |fitting| fitting.min(LARGEST_GRID));
    #[expect(clippy::cast_possible_truncation, reason = "at most the largest grid")]
    let most = most as usize;
    let estimate = steady_periodic(surface, &problem.elastomer()?, load, relative_error, most)?;
    let wave = |wave: &Wave| SurfaceWave {
        amplitude: wave.amplitude,
        wave_vector: surface.wave_vector(wave),
    };
    let waves: Vec<SurfaceWave> = surface.waves().iter().map(wave).collect();
    let force = Estimate::exact(mean_pressure * area);
    let load = RoughLoad {
        mean_pressure,
        velocity: load.velocity(),
    };
    // The theory is that of the half space.
    let theory = problem.thickness.is_infinite();
    let theory = theory.then(|| persson_of_waves(&waves, &problem.material, load));
    let persson = theory.transpose()?.map(|theory| Persson {
        area_fraction: theory.area_fraction.value,
        friction_coefficient: theory.friction_coefficient.value,
    });
    let finest = estimate.finest;
    let elements = finest.pressure.pressure.iter();
    let mut answer = Answer {
        friction_coefficient: Some(estimate.friction_coefficient),
        error_parts: ErrorParts::of_elements(estimate.friction_coefficient.error),
        indentation_depth: problem.thickness.is_finite().then_some(estimate.mean_depth),
        contact_area: Some(estimate.area_fraction * area),
        unknowns: elements.filter(|pressure| **pressure > 0.0).count(),
        iterations: finest.products,
        rough: Some(RoughAnswer {
            mean_pressure: Estimate::exact(mean_pressure),
            area_fraction: estimate.area_fraction,
            friction_from_dissipation: estimate.friction_from_dissipation,
            persson,
        }),
        ..Answer::new(Method::BemSteady, Model::HalfSpace, force)
    };
    answer.fields.pressure = Some(finest.pressure);
    Ok(answer)
}

/// From first touch to the stationary state, or over a distance.
pub(crate) fn transient(
    problem: &Problem,
    surface: &dyn Surface,
    load: &SlidingLoad,
    request: Request,
) -> Result<Answer> {
    let estimate = slide(surface, &problem.elastomer()?, load, request)?;
    let last = estimate.finest.last();
    let ends = [last.contact_x, last.contact_y];
    let mut answer = Answer {
        unknowns: last.n_contact,
        iterations: estimate.finest.rows.len(),
        grid: Some(of_march(&estimate.options)?),
        ..answer(&estimate, Method::BemTransient, ends)
    };
    answer.fields.history = estimate.finest.rows.iter().map(history_row).collect();
    answer.fields.pressure = Some(estimate.finest.pressure);
    Ok(answer)
}

/// Pressing without sliding.
pub(crate) fn pressed(
    problem: &Problem,
    surface: &dyn Surface,
    load: &PressingLoad,
    request: Request,
) -> Result<Answer> {
    let estimate = indent(surface, &problem.elastomer()?, load, request)?;
    let finest = &estimate.finest;
    let ends = [finest.contact_x, finest.contact_y];
    let mut answer = Answer {
        friction_coefficient: None,
        unknowns: finest.n_contact,
        iterations: 1,
        grid: Some(of_march(&estimate.options)?),
        ..answer(&estimate, Method::BemTransient, ends)
    };
    answer.fields.pressure = estimate.finest.pressure;
    Ok(answer)
}

/// Pressing and letting go along a history; the answer is its last point.
pub(crate) fn followed(
    problem: &Problem,
    surface: &dyn Surface,
    request: Request,
) -> Result<Answer> {
    let found = follow(surface, &problem.elastomer()?, &problem.history, request)?;
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
        grid: Some(of_march(&found.options)?),
        ..Answer::new(Method::BemTransient, Model::HalfSpace, last.normal_force)
    };
    answer.fields.curve = Curve::of(&found.points, |point| point.time, columns);
    Ok(answer)
}

fn of_march(options: &GridOptions) -> Result<Grid> {
    Ok(Grid {
        footprint: options.footprint.elements(options.spacing)?,
        factorised: false,
    })
}

fn history_row(row: &SlideRow) -> HistoryRow {
    HistoryRow {
        sliding_distance_m: row.sliding_distance,
        time_s: row.time,
        indentation_depth_m: row.indentation_depth,
        friction_coefficient: row.friction_coefficient,
    }
}
