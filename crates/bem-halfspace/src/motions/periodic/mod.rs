//! Motions of a periodic surface with error bars: reciprocating up to the limit cycle, or along a path through points.
//!
//! Theory: docs/theory/transient-half-space.md, "Motions".

mod full_contact;
mod moving_surface;
mod stresses;

use indenters::rough::PeriodicSurface;
use indenters::{MotionRecord, MotionView, Moved, MovingLoad};
use numerics::{Accuracy, ErrorParts, Goal, MAX_STORED_STATES, Request};

use crate::elements::grid::MIN_COARSEST_EDGE;
use crate::estimate::refinement_limits::{MARCH_ORDER, MARCH_WORK_EXPONENT};
use crate::march::n_history_variables;
use crate::motions::any_motion::refine_motion;
use crate::stationary::periodic::grid_sizes::FIRST_ELEMENTS_PER_WAVE;
use crate::stationary::periodic::refinement::MIN_CONTACT_ELEMENTS;
use crate::{BemError, Elastomer};
use moving_surface::MovingSurface;

/// Number of elements per shortest wave for the first error estimate. Derived: half as many, on its coarser grid, are those on the
/// first grid of a stationary contact.
const ELEMENTS_PER_SHORTEST_WAVE: usize = 2 * FIRST_ELEMENTS_PER_WAVE;
/// Relative tolerance of the contact of a step. Its product with the root mean square slope is part of the error of the friction. Chosen;
/// from 1e-9 to 1e-7 no answer changes by more than 1e-7 of its bar (case of `evidence tuning`).
const CONTACT_TOLERANCE: f64 = 1e-8;
/// Upper bound of the memory per element without its history variables, \[bytes]. Chosen above the sum of heights, pressures,
/// gaps and the buffers of transforms and contact solver. It decides the stated memory only.
const BYTES_PER_ELEMENT: f64 = 170.0;
/// Upper bound of the memory per wave along x and step, \[bytes]: three complex states of 16 bytes each, with a margin.
const BYTES_PER_WAVE: f64 = 80.0;

/// Moves a sum of waves over a material at rest, along a path through points, or reciprocating up to the limit cycle.
///
/// The relative error of the request is that of the mean friction coefficient of a cycle, or that of the friction force of a path
/// relative to its largest value. If a number of elements is asked for instead, it is the number along the edge of the period
/// with more elements.
///
/// Forces and energies are those of one period, and so is the normal force of the load, the mean pressure times the area. At the
/// beginning the surface is pressed instantaneously. The depth is that of the mean plane, as in
/// [`PeriodicSliding`](crate::PeriodicSliding). In full contact a cycle is computed in closed form.
///
/// ```
/// use bem_halfspace::indenters::rough::{PeriodicSurface, Wave};
/// use bem_halfspace::indenters::{Control, MovingLoad, Shape, Stroke};
/// use bem_halfspace::periodic;
/// use bem_halfspace::rheology::{StandardSolid, StandardSolidParameters};
///
/// let wave = Wave { numbers: [1, 0], amplitude: 1e-5, phase: 0.0 };
/// let ridges = PeriodicSurface::new([1e-3; 2], vec![wave])?;
/// let rubber = StandardSolid::new(StandardSolidParameters {
///     equilibrium_modulus: 1e6,
///     maxwell_modulus: 9e6,
///     viscosity: 9e4,
/// })?;
/// let stroke = Stroke { length: 2e-4, frequency: 10.0, shape: Shape::Sinusoidal };
/// // A mean pressure of 1 MPa closes all gaps.
/// let load = MovingLoad::reciprocating(Control::NormalForce(1.0), stroke)?;
/// let cycle = periodic::move_along(&ridges, &rubber, &load, 1e-6)?;
/// assert!(cycle.dissipated_energy.is_some_and(|energy| energy.value > 0.0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`BemError::NotReached`] with the result on the finest grid allowed; [`BemError::NoCycle`] for reciprocation on a material that
/// flows; [`BemError::NotPeriodic`]; [`BemError::DepthFromRest`]; [`BemError::Indenter`] for a path that is too long
/// for the elements that the shortest waves need; [`BemError::PeriodTooCoarse`] for too few elements; otherwise like
/// [`slide`](crate::periodic::slide).
pub fn move_along<'w>(
    surface: &PeriodicSurface,
    elastomer: &dyn Elastomer,
    load: &MovingLoad,
    request: impl Into<Request<'w>>,
) -> Result<Moved, BemError> {
    let request = request.into();
    let problem = MovingSurface::new(surface, elastomer, load, request.accuracy)?;
    // Choose the first grid, and the finest one whose march is short enough.
    let first = elements_of_motion(surface);
    let is_full = problem.is_full();
    let goal = Goal {
        request,
        initial_elements: first,
        max_elements: problem.max_elements(first),
        order: MARCH_ORDER,
        work_exponent: MARCH_WORK_EXPONENT,
        extra_work: 0.0,
        selection_factor: 1.0,
    };
    // Refine elements and steps together until the error asked for is reached.
    let view = MotionView {
        load,
        is_elastic: problem.spectra.creep.is_elastic(),
        extrapolation_order: None,
    };
    refine_motion(
        &goal,
        &view,
        |elements, report| problem.solve_on_grid(elements, is_full, report),
        |record| other_errors(&view, record),
    )
}

/// Upper bound of the memory of [`move_along`] for a number of elements along the edge of the period that has more of them,
/// \[bytes].
///
/// # Errors
/// As for [`move_along`], before anything is followed.
pub fn move_along_memory(
    surface: &PeriodicSurface,
    elastomer: &dyn Elastomer,
    load: &MovingLoad,
    elements: usize,
) -> Result<f64, BemError> {
    let problem = MovingSurface::new(surface, elastomer, load, Accuracy::Elements(elements))?;
    let shape = problem.shape(elements);
    let n_steps = problem.n_steps(elements, shape)?;
    let n_fields = n_history_variables(&problem.spectra.creep);
    // Besides the states of the fixed-point iteration, the limit cycle of the coarser grid is stored.
    let copies = if problem.limit_cycle.is_some() {
        MAX_STORED_STATES + 1
    } else {
        1
    };
    let per_element = BYTES_PER_ELEMENT + (copies * n_fields * size_of::<f64>()) as f64;
    let waves = surface.largest_numbers()[0] as f64 + 1.0;
    let n_elements = shape.map(|n| n as f64).iter().product::<f64>();
    Ok(per_element * n_elements + BYTES_PER_WAVE * waves * n_steps)
}

/// Number of elements, along the edge of the period that has more of them, of the first error estimate of [`move_along`].
pub fn elements_of_motion(surface: &PeriodicSurface) -> usize {
    let [x, y] = initial_shape(surface);
    x.max(y)
}

/// Numbers of elements along both edges for the first error estimate, in proportion to the largest numbers of waves; 2 along an edge
/// without waves.
fn initial_shape(surface: &PeriodicSurface) -> [usize; 2] {
    surface.largest_numbers().map(|number| match number {
        0 => 2,
        _ => (ELEMENTS_PER_SHORTEST_WAVE * number).max(MIN_COARSEST_EDGE),
    })
}

/// Errors of the quantities of the `view` that finer elements do not reduce: the remaining change to the limit cycle, and the contact
/// tolerance. If too few elements are in contact, the whole value is added as discretisation error.
fn other_errors(view: &MotionView, record: &MotionRecord) -> Vec<ErrorParts> {
    let pressed = record.steps.iter().filter(|step| step.normal_force > 0.0);
    let fewest = pressed
        .map(|step| step.n_contact)
        .min()
        .unwrap_or(usize::MAX);
    let mut rests = view.truncation_errors(record);
    if let (true, [friction, _, work, ..]) = (record.n_cycles > 0, &mut rests[..]) {
        friction.iteration = Some(CONTACT_TOLERANCE * record.rms_slope);
        work.iteration = Some(CONTACT_TOLERANCE * record.rms_slope * record.normal_work);
    }
    // The coarser grid of the error estimate has half the elements along both axes.
    if fewest >= 4 * MIN_CONTACT_ELEMENTS {
        return rests;
    }
    let sizes = view.quantities(record).into_iter();
    let wide = sizes.map(|quantity| ErrorParts::discretisation_only(quantity.value.abs()));
    let padded = rests.into_iter().chain(std::iter::repeat(ErrorParts::NONE));
    wide.zip(padded)
        .map(|(wide, rest)| wide.plus(rest))
        .collect()
}
