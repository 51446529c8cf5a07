//! Any motion of a line over a Winkler foundation: starts, stops, dwells and returns, once or reciprocating.
//!
//! ```text
//! F_t = 4 Σ Δx w h̃'(X − x),   ∫ F_t dx + ∫ F_N dd = stored and dissipated energy
//! ```
//! w is the load of the element at the position X, and Δx the spacing of the elements. The lowest point of the line is at the
//! position x, the height of the line is h̃, and d is the depth.
//!
//! A step moves the line by about one element, or its duration grows after a stop, so that spacing and time step are refined
//! together. Errors are estimated from several resolutions.
//!
//! Theory: docs/theory/line-viscoelastic.md, "One law".

mod compensated;
mod contact_history;
mod cycle;
mod element_means;
mod elements;
mod force_balance;
mod motion_problem;
mod slide;
mod winkler;

use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

use indenters::{MotionRecord, MotionView, Moved, MovingLoad, RigidLine};
use numerics::{
    Accuracy, FIRST_ELEMENTS, Goal, ITERATION_SHARE, MIN_CONVERGENCE_ORDER, Progress, Request,
    positive, refine, whole_part,
};
use rheology::Material;

use crate::MdrError;
use crate::line::has_steep_kinks;
use crate::steady::LineProblem;
use motion_problem::MotionProblem;
pub use slide::{Sliding, SlidingStep, slide, slide_memory};

/// Largest number of elements along the contact in a refinement. Chosen, to limit the computing time: the refinement stops
/// there, even if the error is still larger than asked for.
const MAX_ELEMENTS_ALONG_CONTACT: usize = 4096;
/// Exponent of the work as a function of the number of elements along the contact. Derived: the number of steps grows in
/// proportion to it, and so does the work of each step.
const WORK_EXPONENT: f64 = 2.0;
/// Largest order of convergence that is assumed. Chosen: smooth bodies have a better one, but the position of their contact boundary
/// between the elements makes it unsafe to assume more. A higher order makes error bars narrower.
const MAX_ORDER: f64 = 1.0;
/// Ratio of the number of elements of a foundation to that along the contact, for the estimate of memory. Chosen as an upper
/// bound for bodies whose sides keep rising; no solution depends on it.
const FOUNDATION_PER_CONTACT: f64 = 4.0;

/// Largest product of elements, steps and cycles of a resolution that a refinement takes up. Chosen to limit the time to about a
/// minute of one thread, which grows in proportion to it. The refinement ends before a larger resolution.
const MAX_WORK: f64 = 5e8;
/// Number of elements along the contact from which on the refinement of a limit cycle may give up. It stops if the friction is
/// smaller than its change by the last halving of the spacing. The friction is then only an error of the elements.
///
/// Chosen to limit the time: with half of it, a friction that the next halving would resolve may be given up; with twice as many,
/// one that is never resolved takes four times as long.
const MIN_ELEMENTS_TO_GIVE_UP: usize = 128;
/// Difference between the exponent p of an apex x^p and the order of convergence, because the position of the apex between two elements is
/// arbitrary.
/// Chosen (case of `evidence tuning`).
const TIP_ORDER_LOSS: f64 = 0.5;
/// Order of convergence behind a steep kink. Derived: the line rises like the root of the distance there, so that its rise over
/// one element falls like the root of the spacing.
const STEEP_KINK_ORDER: f64 = 0.5;
/// Smallest number of elements over which a stroke goes on the resolution where a relative error is first sought. On fewer
/// elements two resolutions may agree by chance. Chosen; from 0 to 16 no digit of an answer changes (case of `evidence tuning`).
const MIN_ELEMENTS_PER_STROKE: f64 = 4.0;
/// Relative tolerance of the limit cycle if a number of elements is asked for. Chosen below the discretisation error, which is of
/// the order 1/4096, or 2e-4, on the largest number of elements along the contact.
const CYCLE_TOLERANCE_ON_ELEMENTS: f64 = 1e-5;

/// Moves a line over an undeformed Winkler foundation, through the points of a motion or reciprocating in its limit cycle.
///
/// The request is a relative error of the mean friction coefficient, or a number of elements along the contact. At the
/// beginning the line is pressed instantaneously. The friction force of a motion through points has the same error, relative to
/// its largest value.
///
/// ```
/// use mdr_core::indenters::{Control, EquivalentLine, MovingLoad, Shape, Sphere, Stroke};
/// use mdr_core::rheology::{StandardSolid, StandardSolidParameters};
/// use mdr_core::move_along;
///
/// let rubber = StandardSolid::new(StandardSolidParameters {
///     equilibrium_modulus: 1e6,
///     maxwell_modulus: 1e7,
///     viscosity: 1e5,
/// })?;
/// let ball = Sphere::new(5e-3)?;
/// let stroke = Stroke { length: 5e-3, frequency: 1.0, shape: Shape::Sinusoidal };
/// let load = MovingLoad::reciprocating(Control::NormalForce(1.0), stroke)?;
/// let cycle = move_along(&EquivalentLine(&ball), &rubber, &load, 1e-2)?;
/// let energy = cycle.dissipated_energy.expect("of a cycle");
/// let expected = cycle.friction_coefficient.value * 1.0 * load.length();
/// assert!((energy.value / expected - 1.0).abs() < 1e-9);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`MdrError::MotionNotReached`] with the result of the finest resolution; [`MdrError::NoCycle`] for a reciprocating motion on
/// a material that flows; [`MdrError::NotPeriodic`]; [`IndenterError::TooManySteps`](indenters::IndenterError::TooManySteps);
/// [`MdrError::ContactReachesEdge`]; [`MdrError::FrictionDiverges`] for a kink or cusp on a material with a parallel
/// dashpot; otherwise like [`slide`](crate::slide()).
pub fn move_along<'w>(
    line: &dyn RigidLine,
    material: &dyn Material,
    load: &MovingLoad,
    request: impl Into<Request<'w>>,
) -> Result<Moved, MdrError> {
    // Refuse a line whose friction has no limit on refinement, and prepare the motion.
    let accuracy_request = request.into();
    LineProblem::new(line, material, load.fastest())?.check_kinks(load.largest_control())?;
    let length = contact_length(line, material, load)?;
    let tolerance = match accuracy_request.accuracy {
        Accuracy::RelativeError(error) => ITERATION_SHARE * error,
        Accuracy::Elements(_) => CYCLE_TOLERANCE_ON_ELEMENTS,
    };
    let problem = MotionProblem::new(line, material, load, length, tolerance)?;

    // Refine until the errors are as asked for, or the work is too much.
    let limited = WorkLimit {
        watch: accuracy_request.watch,
        load,
        length,
        is_elastic: material.creep().is_elastic(),
        solved: Mutex::default(),
    };
    let goal = Goal {
        request: Request {
            watch: &limited,
            ..accuracy_request
        },
        initial_elements: first_elements(load, length),
        max_elements: MAX_ELEMENTS_ALONG_CONTACT,
        order: convergence_order(line),
        work_exponent: WORK_EXPONENT,
        extra_work: 0.0,
        selection_factor: 1.0,
    };
    let view = MotionView {
        load,
        is_elastic: material.creep().is_elastic(),
        extrapolation_order: None,
    };
    let refined = refine(
        &goal,
        |elements, report: &dyn Fn(f64)| {
            let record = problem.solve_on(elements, report)?;
            limited.record(elements, &record);
            Ok(record)
        },
        |record| view.quantities(record),
        |record, _: &dyn Fn(f64)| Ok::<_, MdrError>(view.truncation_errors(record)),
    )?;
    let missed = refined.missed;
    let found = view.moved(refined);
    match missed {
        None => Ok(found),
        Some(missed) => Err(MdrError::MotionNotReached {
            missed,
            reached: Box::new(found),
        }),
    }
}

/// Progress that stops the refinement before a resolution with more work than [`MAX_WORK`], or at a friction that is not
/// resolved.
///
/// The next resolution is assumed to take as many cycles as the last one.
#[derive(Debug)]
struct WorkLimit<'a> {
    /// Receiver of the progress, which may also stop the refinement.
    watch: &'a dyn Progress,
    /// Motion of the line.
    load: &'a MovingLoad,
    /// Length of the contact, \[m].
    length: f64,
    /// True for an elastic material, whose friction of 0 counts as resolved.
    is_elastic: bool,
    /// Friction coefficient and number of cycles, by the number of elements.
    solved: Mutex<BTreeMap<usize, (f64, usize)>>,
}

impl WorkLimit<'_> {
    /// Stores the friction and the number of cycles on a number of elements.
    fn record(&self, elements: usize, record: &MotionRecord) {
        let mut solved = self.solved.lock().unwrap_or_else(PoisonError::into_inner);
        solved.insert(elements, (record.friction(), record.n_cycles.max(1)));
    }

    /// Friction and number of cycles on a number of elements; `None` if they were not solved.
    fn solved(&self, elements: usize) -> Option<(f64, usize)> {
        let solved = self.solved.lock().unwrap_or_else(PoisonError::into_inner);
        solved.get(&elements).copied()
    }

    /// True if the friction on a number of elements is smaller than its change from half of them.
    fn is_unresolved(&self, elements: usize) -> bool {
        let pair = self.solved(elements).zip(self.solved(elements / 2));
        let is_smaller =
            pair.is_some_and(|((fine, _), (half, _))| fine.abs() < (fine - half).abs());
        is_smaller && self.load.is_cycle() && !self.is_elastic
    }
}

impl Progress for WorkLimit<'_> {
    fn may_refine(&self, elements: usize) -> bool {
        // Give up on a friction that is only an error of the elements.
        let before = elements / 2;
        if before >= MIN_ELEMENTS_TO_GIVE_UP && self.is_unresolved(before) {
            return false;
        }
        // Otherwise a resolution is allowed if its product of elements, steps and cycles is at most `MAX_WORK`, and the
        // receiver of the progress allows it too.
        let n_cycles = self.solved(before).map_or(1, |(_, n_cycles)| n_cycles) as f64;
        let allowed = MAX_WORK / (n_cycles * elements as f64);
        let spacing = self.length / elements as f64;
        self.load.n_steps(elements, spacing, allowed).is_ok() && self.watch.may_refine(elements)
    }

    fn report(&self, fraction: f64) {
        self.watch.report(fraction);
    }
}

/// Elements along a contact of a `length` \[m] on the resolution where a relative error is first sought; for a cycle they double until
/// the stroke goes over enough of them, or the refinement may give up.
fn first_elements(load: &MovingLoad, length: f64) -> usize {
    if !load.is_cycle() {
        return FIRST_ELEMENTS;
    }
    let stroke = 0.5 * load.length();
    let needed = whole_part((MIN_ELEMENTS_PER_STROKE * length / stroke).ceil());
    needed
        .clamp(FIRST_ELEMENTS, MIN_ELEMENTS_TO_GIVE_UP)
        .next_power_of_two()
}

/// Length of the contact at the largest speed, force and depth of a motion, \[m].
fn contact_length(
    line: &dyn RigidLine,
    material: &dyn Material,
    load: &MovingLoad,
) -> Result<f64, MdrError> {
    let steady = LineProblem::new(line, material, load.fastest())?;
    let length = steady.contact(load.largest_control())?.length;
    Ok(positive("contact length", length)?)
}

/// Order in the spacing with which the friction of a motion is assumed to converge, at most [`MAX_ORDER`].
fn convergence_order(line: &dyn RigidLine) -> f64 {
    if has_steep_kinks(line) {
        STEEP_KINK_ORDER
    } else {
        (line.apex_exponent() - TIP_ORDER_LOSS).clamp(MIN_CONVERGENCE_ORDER, MAX_ORDER)
    }
}

/// Elements along the contact with which [`move_along`] first seeks a relative error.
///
/// # Errors
/// As for [`move_along`], before the motion is computed.
pub fn elements_of_motion(
    line: &dyn RigidLine,
    material: &dyn Material,
    load: &MovingLoad,
) -> Result<usize, MdrError> {
    Ok(first_elements(load, contact_length(line, material, load)?))
}

/// Memory that [`move_along`] takes at most for a number of elements along the contact, \[bytes].
///
/// # Errors
/// As for [`move_along`], before the motion is computed.
pub fn move_along_memory(
    line: &dyn RigidLine,
    material: &dyn Material,
    load: &MovingLoad,
    elements: usize,
) -> Result<f64, MdrError> {
    let length = contact_length(line, material, load)?;
    MotionProblem::new(line, material, load, length, CYCLE_TOLERANCE_ON_ELEMENTS)?
        .memory_for(elements)
}
