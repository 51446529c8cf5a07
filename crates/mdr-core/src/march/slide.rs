//! Sliding at constant speed from first touch, over a distance or into the stationary state.
//!
//! It is a motion of one stage, with steps of one element:
//!
//! ```text
//! X_k = k Δx,   t_k = k Δx/v,   ∫ F_N dt = F_N Δx/v in each step
//! ```
//! The lowest point of the line is over an element at the beginning of every step. A kink there then falls between two
//! elements and never inside a step, and a stationary state repeats itself to the last digit. Where a spring carries the
//! contact from the beginning, the line is pressed before the first step.
//!
//! Theory: docs/theory/line-viscoelastic.md, "Step by step".

mod subgrid;

use indenters::{RigidLine, SlidingLoad};
use numerics::{
    ErrorParts, Estimate, FIRST_ELEMENTS, Goal, MIN_CONVERGENCE_ORDER, Quantity, Request, in_range,
    refine, whole_part,
};
use rheology::Material;

use super::motion_problem::{MOTION_BYTES_PER_ELEMENT, force_correction};
use super::winkler::{Prescribed, WinklerFoundation};
use super::{
    FOUNDATION_PER_CONTACT, MAX_ELEMENTS_ALONG_CONTACT, MAX_ORDER, STEEP_KINK_ORDER, WORK_EXPONENT,
};
use crate::MdrError;
use crate::branches::{Foundation, n_history};
use crate::error::{enough_elements, finite};
use crate::line::{ElementHeights, MAX_ELEMENTS, has_steep_kinks};
use crate::steady::{LineProblem, SteadyContact};
use subgrid::{LastContact, SubgridForces};

/// Largest sliding distance in the search for the stationary state, in lengths of the stationary contact. Chosen: an exponential
/// approach to [`DRIFT_TOLERANCE`] takes ln(10⁹) = 21 lengths. After it the search ends with [`MdrError::NotStationary`].
const MAX_CONTACT_LENGTHS: f64 = 100.0;
/// Margin of the height of the first foundation above the stationary depth, relative to that depth. Chosen as a thousand times
/// the error 1e-9 of that depth. A contact that goes deeper is computed again on a higher foundation.
const DEPTH_MARGIN: f64 = 1e-6;
/// Relative change of depth and friction coefficient over one contact length below which the state is stationary.
///
/// The approach is exponential with the contact length as its length, so that the remaining distance to the limit is below
/// `DRIFT_TOLERANCE`/(e − 1). Chosen far below the discretisation error; a tenth of it takes ln 10 = 2.3 contact lengths more.
const DRIFT_TOLERANCE: f64 = 1e-9;
/// Rounding of sums of forces times slopes, relative to the mean slope, and of sliding distances. Derived as
/// [`numerics::SUMMATION_ERROR`] is, for sums over up to 4·10⁶ elements.
const FRICTION_ROUNDING: f64 = 1e-12;
/// Largest ratio of the changes over two successive contact lengths that counts as exponential decay; slower changes are
/// rounding. Chosen: it bounds the remaining change by 0.99/(1 − 0.99), or 99 times the last one.
const MAX_CHANGE_RATIO: f64 = 0.99;
/// Error of an end of the contact, as a multiple of the spacing. Derived: the end lies within one spacing of the outermost loaded element,
/// which is loaded within one more.
const END_ERROR_STEPS: f64 = 2.0;

/// The end of sliding from first touch; an error of 0 means that a quantity is prescribed, or exact.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[must_use]
#[non_exhaustive]
pub struct Sliding {
    /// Friction coefficient μ = F_h/F_N after the sliding distance of the load, or of the stationary state.
    pub friction_coefficient: Estimate,
    /// What the error of the friction coefficient consists of.
    pub error_parts: ErrorParts,
    /// Indentation depth d of the lowest point, \[m].
    pub indentation_depth: Estimate,
    /// Normal force F_N, \[N].
    pub normal_force: Estimate,
    /// Rear and front end of the contact, \[m].
    pub ends: [Estimate; 2],
    /// All steps on the finest resolution.
    pub steps: Vec<SlidingStep>,
    /// Positions of the elements around the last contact \[m] from the rear to the front, and the load per length there
    /// \[N/m].
    pub load: Vec<[f64; 2]>,
    /// Spacing Δx of the elements on the finest resolution, \[m].
    pub spacing: f64,
}

/// One step of sliding.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct SlidingStep {
    /// Distance slid since first touch, at the end of the step, \[m].
    pub sliding_distance: f64,
    /// Time since first touch, at the end of the step, \[s].
    pub time: f64,
    /// Indentation depth d at the end of the step, \[m].
    pub indentation_depth: f64,
    /// Mean friction coefficient over the step.
    pub friction_coefficient: f64,
    /// Positions of the rearmost and the foremost loaded element on the line at the end of the step, \[m].
    pub contact: [f64; 2],
    /// Number of loaded elements at the end of the step.
    pub n_contact: usize,
}

/// Slides a line over an undeformed Winkler foundation, over the sliding distance of the load or until the state is
/// stationary.
///
/// The request is a relative error of the friction coefficient, or a number of elements along the contact (along the
/// sliding distance if that is shorter). A motion over a distance that becomes stationary before ends there.
///
/// ```
/// use mdr_core::indenters::{EquivalentLine, PowerProfile, SlidingLoad};
/// use mdr_core::{rheology::Viscous, slide};
///
/// // Long after first contact the friction is that of (21).
/// let (cone, fluid) = (PowerProfile::cone(0.1)?, Viscous::new(1e4)?);
/// let load = SlidingLoad::new(1.0, 0.01)?.after(0.1)?;
/// let slid = slide(&EquivalentLine(&cone), &fluid, &load, 1e-2)?;
/// let expected = std::f64::consts::FRAC_PI_2 * 0.1;
/// assert!((slid.friction_coefficient.value / expected - 1.0).abs() < 0.02);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// - [`MdrError::SlidingNotReached`] with the result of the finest resolution.
/// - [`MdrError::FrictionDiverges`] for a kink or cusp on a material with a parallel dashpot.
/// - [`MdrError::ForceBeyondEdge`] when the stationary contact would reach the edge of the body (Remark 4), and
///   [`MdrError::ContactReachesEdge`] when the contact reaches the last element in front. The rear end of the line
///   may carry load: elements that pass it are free.
/// - [`MdrError::NotStationary`], with the steps, if the state is not stationary after 100 contact lengths.
/// - [`MdrError::TooCoarse`] for fewer than three elements along the contact, [`MdrError::TooManyElements`] when the
///   foundation would be too long.
/// - [`MdrError::Indenter`] when the load prescribes the depth, or a track.
/// - [`MdrError::NotRising`], [`MdrError::InvalidParameter`], [`MdrError::InvalidHeight`], [`MdrError::NonFinite`],
///   [`MdrError::Material`].
pub fn slide<'w>(
    line: &dyn RigidLine,
    material: &dyn Material,
    load: &SlidingLoad,
    request: impl Into<Request<'w>>,
) -> Result<Sliding, MdrError> {
    LineProblem::new(line, material, load.velocity())?.check_kinks(load.control())?;
    let problem = SlidingProblem::new(line, material, load)?;
    // On any elements the friction is finite, but it grows without limit on refinement.
    let apex_exponent = line.apex_exponent();
    let converges = apex_exponent > 0.5 || !problem.foundation.has_dashpot();
    let allowed = "above 1/2, where the friction integral (16) converges";
    in_range("apex exponent", apex_exponent, converges, allowed)?;
    // With a height |x|^p at the apex, ∫ h'² dx over an element has the order Δx^(2p − 1).
    let goal = Goal {
        request: request.into(),
        initial_elements: FIRST_ELEMENTS,
        max_elements: MAX_ELEMENTS_ALONG_CONTACT,
        order: if has_steep_kinks(line) {
            STEEP_KINK_ORDER
        } else {
            (2.0 * apex_exponent - 1.0).clamp(MIN_CONVERGENCE_ORDER, MAX_ORDER)
        },
        work_exponent: WORK_EXPONENT,
        extra_work: 0.0,
        selection_factor: 1.0,
    };
    let refined = refine(
        &goal,
        |elements, report: &dyn Fn(f64)| problem.solve_on(elements, report),
        |record| problem.quantities(record),
        |record, _: &dyn Fn(f64)| Ok::<_, MdrError>(problem.other_errors(record, material)),
    )?;

    // The answer is the result of the finest resolution, with the errors that the refinement has estimated.
    let record = refined.value;
    let end_values = problem.end_values(&record.steps);
    let [friction_coefficient, indentation_depth, rear, front] =
        std::array::from_fn(|k| Estimate::new(end_values[k], refined.error[k]));
    let found = Sliding {
        friction_coefficient,
        error_parts: refined.parts[0],
        indentation_depth,
        normal_force: Estimate::exact(problem.normal_force),
        ends: [rear, front],
        steps: record.steps,
        load: record.load,
        spacing: record.elements.spacing,
    };
    match refined.missed {
        None => Ok(found),
        Some(missed) => Err(MdrError::SlidingNotReached {
            missed,
            reached: Box::new(found),
        }),
    }
}

/// Memory that [`slide`] takes at most for a number of elements along the contact, or along the sliding distance where that
/// is shorter, \[bytes].
///
/// # Errors
/// As for [`slide`], before the motion is computed.
pub fn slide_memory(
    line: &dyn RigidLine,
    material: &dyn Material,
    load: &SlidingLoad,
    elements: usize,
) -> Result<f64, MdrError> {
    let problem = SlidingProblem::new(line, material, load)?;
    let Schedule { spacing, n_steps } = problem.schedule(elements)?;
    // Four records of each step: a list that grows by doubling holds up to two, and a caller makes rows of a table from them.
    let per_step = 4 * size_of::<SlidingStep>();
    let n_elements =
        (FOUNDATION_PER_CONTACT * problem.contact.length / spacing).min(2.0 * MAX_ELEMENTS as f64);
    let per_element =
        MOTION_BYTES_PER_ELEMENT + (n_history(&problem.foundation) * size_of::<f64>()) as f64;
    Ok(n_steps * per_step as f64 + n_elements * per_element)
}

/// A line, its load and the foundation under it.
struct SlidingProblem<'a> {
    /// Rigid line that slides.
    line: &'a dyn RigidLine,
    /// Law of an element, with lengths that are times in \[s].
    foundation: Foundation,
    /// Normal force, velocity and sliding distance.
    load: &'a SlidingLoad,
    /// Normal force F_N, \[N].
    normal_force: f64,
    /// The stationary contact.
    contact: SteadyContact,
}

/// Equal steps of one element.
struct Schedule {
    /// Spacing Δx of the elements, \[m].
    spacing: f64,
    /// Number of steps over the sliding distance, or at most.
    n_steps: f64,
}

/// The steps on one resolution, and the contact at their end.
struct SlidingRecord {
    /// All steps from first touch on.
    steps: Vec<SlidingStep>,
    /// Positions of the elements around the last contact \[m] from the rear to the front, and the load per length there \[N/m].
    load: Vec<[f64; 2]>,
    /// Difference between the normal force and its mean over the last step, relative to the normal force.
    force_error: f64,
    /// Elements under the line, with their spacing.
    elements: ElementHeights,
}

impl<'a> SlidingProblem<'a> {
    /// Prepares a slide from first touch under a force; refuses a given depth, and a track, on which the line meets its own trace.
    fn new(
        line: &'a dyn RigidLine,
        material: &dyn Material,
        load: &'a SlidingLoad,
    ) -> Result<Self, MdrError> {
        load.require_fresh_ground()?;
        let normal_force = load.require_normal_force()?;
        Ok(Self {
            line,
            foundation: Foundation::new(material, 1.0)?,
            load,
            normal_force,
            contact: LineProblem::new(line, material, load.velocity())?.contact(load.control())?,
        })
    }

    /// Steps for a number of elements along the contact, or along the sliding distance where that is shorter.
    fn schedule(&self, elements: usize) -> Result<Schedule, MdrError> {
        let length = self.contact.length;
        // The sliding distance is divided into equal parts that are no longer than the contact, so that all resolutions have
        // steps in proportion.
        let (resolved, parts) = match self.load.sliding_distance() {
            None => (length, MAX_CONTACT_LENGTHS),
            Some(distance) => {
                let parts = (distance / length).ceil().max(1.0);
                (distance / parts, parts)
            }
        };
        let spacing = resolved / elements.max(1) as f64;
        enough_elements(elements, spacing)?;
        Ok(Schedule {
            spacing,
            n_steps: parts * elements as f64,
        })
    }

    /// Slides with a number of elements along the contact. The foundation is made higher, and the slide repeated, until the
    /// contact stays below its largest height.
    fn solve_on(&self, elements: usize, report: &dyn Fn(f64)) -> Result<SlidingRecord, MdrError> {
        let schedule = self.schedule(elements)?;
        let mut height = (1.0 + DEPTH_MARGIN) * self.contact.depth;
        loop {
            let sampled = ElementHeights::below(self.line, schedule.spacing, height)?;
            let max_height = sampled.max_height;
            if let Some(record) = self.run(sampled, schedule.n_steps, report)? {
                return Ok(record);
            }
            height = 2.0 * max_height;
        }
    }

    /// Marches all steps; `None` if the contact reached elements beyond the heights in `elements`.
    fn run(
        &self,
        elements: ElementHeights,
        n_steps: f64,
        report: &dyn Fn(f64),
    ) -> Result<Option<SlidingRecord>, MdrError> {
        let spacing = elements.spacing;
        let time_step = spacing / self.load.velocity();
        let start = -elements.position(elements.anchor_index);
        let mut winkler = WinklerFoundation::new(
            self.line,
            &self.foundation,
            &elements,
            [start - spacing, start + spacing],
            0.0,
            start,
        )?;

        // The line is pressed at rest, unless a dashpot resists. The divisions come in this order so that even forces whose
        // square is out of the range of numbers give a result.
        let load = 0.25 * self.normal_force / spacing / self.foundation.unit;
        if !self.foundation.has_dashpot() {
            let duration = f64::EPSILON * time_step;
            if winkler
                .advance(duration, start, Prescribed::Load(load))?
                .is_none()
            {
                return Ok(None);
            }
        }

        // Slide by one element per step, until the state is stationary.
        let (mut steps, mut load_factor, mut force_error) = (Vec::new(), 1.0, 0.0);
        let mut drift = 1.0;
        while (steps.len() as f64) < n_steps {
            if !steps.is_empty() {
                winkler.follow(start);
            }
            let prescribed = Prescribed::Load(load_factor * load);
            let Some(result) = winkler.advance(time_step, start + spacing, prescribed)? else {
                return Ok(None);
            };
            // Feed the error of the force back into the load that the next step prescribes.
            force_error = 1.0 - result.sums.normal_load / load;
            load_factor += force_correction(force_error);
            let number = (steps.len() + 1) as f64;
            let time = number * time_step;
            let Some(contact) = result.contact else {
                return enough_elements(0, spacing).map(|()| None);
            };
            // On springs the sum of the slopes vanishes if the contact ends inside the line.
            let ends_inside = contact[0] > elements.position(0) + 0.5 * spacing;
            let friction = if self.foundation.is_elastic() && ends_inside {
                0.0
            } else {
                result.sums.tangential_load / result.sums.normal_load
            };
            steps.push(SlidingStep {
                sliding_distance: number * spacing,
                time,
                indentation_depth: result.depth,
                friction_coefficient: finite("friction coefficient", friction, time)?,
                contact,
                n_contact: result.sums.n_loaded,
            });
            drift = relative_change(&steps, spacing);
            // Towards the stationary state the changes fall exponentially.
            let settled = drift.ln() / DRIFT_TOLERANCE.ln();
            report((number / n_steps).max(settled).clamp(0.0, 1.0));
            if drift <= DRIFT_TOLERANCE {
                enough_elements(result.sums.n_loaded, spacing)?;
                break;
            }
        }
        if self.load.sliding_distance().is_none() && drift > DRIFT_TOLERANCE {
            return Err(MdrError::NotStationary {
                drift,
                drift_tolerance: DRIFT_TOLERANCE,
                sliding_distance: steps.len() as f64 * spacing,
                steps,
            });
        }
        Ok(Some(SlidingRecord {
            steps,
            load: winkler.loads_per_length(),
            force_error,
            elements,
        }))
    }

    /// Friction coefficient, depth \[m], rear and front end of the contact \[m] at the end of the march, in this order.
    ///
    /// The friction of a step belongs to its middle; before the stationary state the end is half a step further.
    fn end_values(&self, steps: &[SlidingStep]) -> [f64; 4] {
        let last = &steps[steps.len() - 1];
        let friction = match steps {
            [.., before, last] if self.load.sliding_distance().is_some() => {
                1.5 * last.friction_coefficient - 0.5 * before.friction_coefficient
            }
            _ => last.friction_coefficient,
        };
        let [rear, front] = last.contact;
        [friction, last.indentation_depth, rear, front]
    }

    /// The end values with the errors that are known on one resolution; the friction controls the refinement.
    fn quantities(&self, record: &SlidingRecord) -> Vec<Quantity> {
        let (steps, spacing) = (&record.steps, record.elements.spacing);
        let values = self.end_values(steps);
        // In the stationary state steps repeat themselves; before, elements at the ends make them scatter.
        let scatter = |value| match self.load.sliding_distance() {
            None => 0.0,
            Some(_) => scatter(steps, value),
        };
        let floors = [
            scatter(|step| step.friction_coefficient) + (record.force_error * values[0]).abs(),
            scatter(|step| step.indentation_depth) + (record.force_error * values[1]).abs(),
            END_ERROR_STEPS * spacing,
            END_ERROR_STEPS * spacing,
        ];
        let quantity = |k: usize| Quantity {
            error_floor: floors[k],
            controls_refinement: k == 0,
            ..Quantity::from(values[k])
        };
        let mut quantities: Vec<Quantity> = (0..values.len()).map(quantity).collect();
        if self.foundation.is_elastic() {
            quantities[0].error_floor = 0.0;
        } else {
            let last = &steps[steps.len() - 1];
            quantities[0].rounding_error = FRICTION_ROUNDING * last.steepness(spacing);
        }
        quantities
    }

    /// Errors that are not estimated from several resolutions: of a finite distance, and below one element.
    fn other_errors(&self, record: &SlidingRecord, material: &dyn Material) -> Vec<ErrorParts> {
        let values = self.end_values(&record.steps);
        let mut parts = self.truncation_errors(&record.steps);
        if self.foundation.is_elastic() {
            return parts.to_vec();
        }
        let contact = LastContact {
            line: self.line,
            elements: &record.elements,
            load: &record.load,
            depth: values[1],
            velocity: self.load.velocity(),
        };
        let SubgridForces { tangential, normal } = contact.subgrid_forces(material);
        let [tangential, normal] = [tangential, normal].map(|force| force / self.normal_force);
        // The force grows with the depth at least in proportion, and a change of the depth moves the friction again.
        parts[0].discretisation = Some(tangential + 2.0 * values[0].abs() * normal);
        parts[1].discretisation = Some(normal * values[1]);
        parts.to_vec()
    }

    /// Remaining changes of an exponential approach, from the changes over the last two contact lengths.
    ///
    /// No parts if the sliding distance of the load was reached; a part is `None` if its change is not finite.
    ///
    /// A motion may end after little more than one contact length; then the change before it is that since the first step.
    fn truncation_errors(&self, steps: &[SlidingStep]) -> [ErrorParts; 4] {
        let end = steps.len() - 1;
        let last = &steps[end];
        let is_there =
            |distance: f64| last.sliding_distance >= distance * (1.0 - FRICTION_ROUNDING);
        if self.load.sliding_distance().is_some_and(is_there) {
            return [ErrorParts::NONE; 4];
        }
        let remainder = |value: fn(&SlidingStep) -> f64| {
            let back = |lengths: usize| value(&steps[end.saturating_sub(lengths * last.n_contact)]);
            // The changes decay geometrically from contact length to contact length.
            let [now, before, earlier] = [0, 1, 2].map(back);
            let [change, change_before] = [now - before, before - earlier].map(f64::abs);
            let ratio = (change / change_before).min(MAX_CHANGE_RATIO);
            Some(change * ratio / (1.0 - ratio)).filter(|rest| rest.is_finite())
        };
        let values: [fn(&SlidingStep) -> f64; 4] = [
            |step| step.friction_coefficient,
            |step| step.indentation_depth,
            |step| step.contact[0],
            |step| step.contact[1],
        ];
        let part = |value| ErrorParts {
            truncation: remainder(value),
            ..ErrorParts::NONE
        };
        values.map(part)
    }
}

impl SlidingStep {
    /// Estimate of the mean slope of the line in the contact: depth over contact length.
    fn steepness(&self, spacing: f64) -> f64 {
        self.indentation_depth / (self.n_contact as f64 * spacing)
    }
}

/// Scatter of a value from step to step, by elements that come into contact or separate at the ends of the contact: the second
/// difference of the last three steps, in the unit of the value.
fn scatter(steps: &[SlidingStep], value: fn(&SlidingStep) -> f64) -> f64 {
    let [.., first, second, third] = steps else {
        return 0.0;
    };
    (value(first) - 2.0 * value(second) + value(third)).abs()
}

/// Relative change of depth and friction over the last contact length; 1 if the distance is shorter.
///
/// The contact length is measured from the rearmost to the foremost loaded element, gaps included.
fn relative_change(steps: &[SlidingStep], spacing: f64) -> f64 {
    let now = &steps[steps.len() - 1];
    let span = whole_part((now.contact[1] - now.contact[0]) / spacing + 1.5);
    let Some(before) = steps.len().checked_sub(1 + span).map(|index| &steps[index]) else {
        return 1.0;
    };
    let change = |value: fn(&SlidingStep) -> f64, noise: f64| {
        let [now, before] = [value(now), value(before)];
        let difference = (now - before).abs();
        if difference > noise {
            difference / now.abs().max(before.abs())
        } else {
            0.0
        }
    };
    let noise = FRICTION_ROUNDING * now.steepness(spacing);
    let depth = change(|step| step.indentation_depth, 0.0);
    depth.max(change(|step| step.friction_coefficient, noise))
}

#[cfg(test)]
mod tests;
