//! Sliding from first contact by marching in time, to an error asked for or with a stated spacing.
//!
//! Theory: docs/theory/line-viscoelastic.md, "Step by step".

mod foundation_march;
mod half_step_shift;
mod on_grid;
mod subgrid;

use indenters::{RigidLine, SlidingLoad};
use numerics::{ErrorParts, Estimate, FIRST_ELEMENTS, Goal, Quantity, Request, refine};
use rheology::Material;

use crate::MdrError;
use crate::line::{has_steep_kinks, lowest_candidate};
use crate::refinement::{MAX_ELEMENTS_ALONG_CONTACT, MAX_ORDER, MIN_ORDER, WORK_EXPONENT};
use crate::steady::LineProblem;
use half_step_shift::{depends_on_step, half_step_shifted};
use on_grid::march;
pub use on_grid::{SlideOptions, SlideRow, Transient, slide_memory, slide_on_grid};

/// Rounding of forces times slopes, relative to the mean slope, and of distances, relative to them.
const FRICTION_ROUNDING: f64 = 1e-12;
/// Largest ratio of the changes over two successive contact lengths that counts as exponential decay; slower changes
/// are rounding.
const MAX_CHANGE_RATIO: f64 = 0.99;
/// Factor on the error of the depth behind a steep kink, (2 − 1)/(√2 − 1). The line rises there like the root of the
/// distance, so the depth is of order 1/2 and not of first order.
const STEEP_KINK_ERROR_FACTOR: f64 = 2.42;
/// Error of the ends of the contact in steps: an end lies within a step of the outermost element, which is loaded
/// within one more.
const END_ERROR_STEPS: f64 = 2.0;

/// Steps before the end whose values give the scatter from step to step. Measured by `evidence tuning`.
const N_SCATTER_STEPS: usize = 6;

/// The end of a march from first contact; an error of 0 means that a quantity is prescribed, or exact.
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
    /// The march on the finest resolution.
    pub finest: Transient,
    /// Resolution and stopping rule of that march.
    pub options: SlideOptions,
}

/// Slides a line over an undeformed Winkler foundation, over the sliding distance of the load or until the state is
/// stationary.
///
/// The request is a relative error of the friction coefficient, or a number of elements along the contact.
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
/// [`MdrError::SlidingNotReached`] with the result of the finest resolution; [`MdrError::FrictionDiverges`] for a kink or cusp on a lone
/// dashpot; otherwise like [`slide_on_grid`].
pub fn slide<'w>(
    line: &dyn RigidLine,
    material: &dyn Material,
    load: &SlidingLoad,
    request: impl Into<Request<'w>>,
) -> Result<Sliding, MdrError> {
    LineProblem::new(line, material, load.velocity())?.check_kinks(load.control())?;
    let motion = Motion::new(line, material, load)?;

    // Refine until the errors are as asked for.
    let goal = Goal {
        request: request.into(),
        initial_elements: FIRST_ELEMENTS,
        max_elements: MAX_ELEMENTS_ALONG_CONTACT,
        order: (2.0 * line.apex_exponent() - 1.0).clamp(MIN_ORDER, MAX_ORDER),
        work_exponent: WORK_EXPONENT,
        extra_work: f64::from(depends_on_step(&material.creep())),
        selection_factor: 1.0,
    };
    let solve = |elements, report: &dyn Fn(f64)| motion.march(elements, report);
    let others = |march: &OnElements, report: &dyn Fn(f64)| motion.other_errors(march, report);
    let refined = refine(&goal, solve, |march| motion.quantities(march), others)?;

    // The error of the depth behind a steep kink is larger than that of the order that is assumed for the friction.
    let (march, mut error) = (refined.value, refined.error);
    let error_parts = refined.parts[0];
    if has_steep_kinks(line) {
        let elements = refined.parts[1].discretisation.into_iter().sum::<f64>();
        error[1] += (STEEP_KINK_ERROR_FACTOR - 1.0) * elements;
    }

    // The result of the finest resolution, with its errors.
    let end_values = motion.end_values(&march.transient);
    let [friction_coefficient, indentation_depth, rear, front] =
        std::array::from_fn(|k| Estimate::new(end_values[k], error[k]));
    let found = Sliding {
        friction_coefficient,
        error_parts,
        indentation_depth,
        normal_force: Estimate::exact(load.require_normal_force()?),
        ends: [rear, front],
        finest: march.transient,
        options: march.options,
    };
    match refined.missed {
        None => Ok(found),
        Some(missed) => Err(MdrError::SlidingNotReached {
            missed,
            reached: Box::new(found),
        }),
    }
}

/// A line, the material under it and its load.
struct Motion<'a> {
    line: &'a dyn RigidLine,
    /// Height of its lowest point, \[m].
    lowest: f64,
    material: &'a dyn Material,
    load: &'a SlidingLoad,
}

/// A march on one resolution, with its options.
struct OnElements {
    options: SlideOptions,
    transient: Transient,
}

impl<'a> Motion<'a> {
    fn new(
        line: &'a dyn RigidLine,
        material: &'a dyn Material,
        load: &'a SlidingLoad,
    ) -> Result<Self, MdrError> {
        Ok(Self {
            line,
            lowest: line.height(lowest_candidate(line)?),
            material,
            load,
        })
    }

    fn march(&self, elements: usize, report: &dyn Fn(f64)) -> Result<OnElements, MdrError> {
        let options = SlideOptions::with_elements(elements, self.line, self.material, self.load)?;
        Ok(OnElements {
            transient: march(self.line, self.material, self.load, &options, report)?,
            options,
        })
    }

    /// Friction coefficient, depth, rear and front end of the contact at the end.
    ///
    /// The friction of a step belongs to its middle; before the stationary state the end is half a step further.
    fn end_values(&self, transient: &Transient) -> [f64; 4] {
        let last = &transient.last;
        let friction = match transient.rows[..] {
            [.., before, last] if self.load.sliding_distance().is_some() => {
                1.5 * last.friction_coefficient - 0.5 * before.friction_coefficient
            }
            _ => last.friction_coefficient,
        };
        let [rear, front] = last.contact;
        [friction, last.indentation_depth, rear, front]
    }

    fn quantities(&self, march: &OnElements) -> Vec<Quantity> {
        let last = &march.transient.last;
        let [friction, depth, rear, front] = self.end_values(&march.transient).map(Quantity::from);
        let slope = last.indentation_depth / last.contact_length;
        let known = |quantity| Quantity {
            controls_refinement: false,
            ..quantity
        };
        let end = |end| Quantity {
            error_floor: END_ERROR_STEPS * march.options.spacing,
            ..known(end)
        };
        // The outermost elements are loaded over all of their length; at the edge of a flat end they carry as much as any.
        let mut edge_error = 0.0;
        if has_steep_kinks(self.line) {
            let above = last.indentation_depth - (self.line.height(front.value) - self.lowest);
            edge_error = above.clamp(0.0, last.indentation_depth) / last.n_contact as f64;
        }
        let is_elastic = self.material.creep().is_elastic();
        let scatter = |value| self.scatter(&march.transient.rows, value);
        vec![
            Quantity {
                rounding_error: if is_elastic {
                    0.0
                } else {
                    FRICTION_ROUNDING * slope
                },
                error_floor: scatter(|row| row.friction_coefficient),
                ..friction
            },
            Quantity {
                error_floor: edge_error.max(scatter(|row| row.indentation_depth)),
                ..known(depth)
            },
            end(rear),
            end(front),
        ]
    }

    /// Scatter of a value from step to step, by elements that come into contact or separate at its ends; 0 if stationary.
    fn scatter(&self, rows: &[SlideRow], value: fn(&SlideRow) -> f64) -> f64 {
        let Some(_) = self.load.sliding_distance() else {
            return 0.0;
        };
        let last = &rows[rows.len().saturating_sub(N_SCATTER_STEPS)..];
        let jump = |rows: &[SlideRow]| value(&rows[0]) - 2.0 * value(&rows[1]) + value(&rows[2]);
        let jumps = last.windows(3).map(|rows| jump(rows).abs());
        jumps.fold(0.0, f64::max)
    }

    /// Errors that are not estimated from several resolutions: of the step in time, of the distance, and below one element.
    fn other_errors(
        &self,
        march: &OnElements,
        report: &dyn Fn(f64),
    ) -> Result<Vec<ErrorParts>, MdrError> {
        let steps = self.errors_of_step(march, report)?;
        let rest = self.remaining_changes(&march.transient.rows);
        let part = |quantity: usize| ErrorParts {
            time_stepping: steps.map(|errors| errors[quantity]),
            truncation: rest.and_then(|errors| errors[quantity]),
            ..ErrorParts::NONE
        };
        let mut parts: Vec<ErrorParts> = (0..4).map(part).collect();
        for (part, subgrid_errors) in parts.iter_mut().zip(march.transient.subgrid_errors) {
            part.discretisation = Some(subgrid_errors);
        }
        Ok(parts)
    }

    /// Errors of the step in time; `None` if the result does not depend on it.
    fn errors_of_step(
        &self,
        marched: &OnElements,
        report: &dyn Fn(f64),
    ) -> Result<Option<[f64; 4]>, MdrError> {
        let time_step = marched.options.spacing / self.load.velocity();
        let Some(shifted) = half_step_shifted(self.material, time_step)? else {
            return Ok(None);
        };
        let transient = march(self.line, &shifted, self.load, &marched.options, report)?;
        let [end_values, shifted_values] =
            [&marched.transient, &transient].map(|march| self.end_values(march));
        Ok(Some(std::array::from_fn(|k| {
            (shifted_values[k] - end_values[k]).abs()
        })))
    }

    /// Remaining changes of an exponential approach, from the changes over the last two contact lengths.
    ///
    /// `None` if the sliding distance of the load was reached; an entry is `None` if its change is not finite.
    ///
    /// A march may end after little more than one contact length; then the change before it is that since the first step.
    fn remaining_changes(&self, rows: &[SlideRow]) -> Option<[Option<f64>; 4]> {
        let last = rows.last()?;
        let is_there =
            |distance: f64| last.sliding_distance >= distance * (1.0 - FRICTION_ROUNDING);
        if self.load.sliding_distance().is_some_and(is_there) {
            return None;
        }
        let remainder = |value: fn(&SlideRow) -> f64| {
            let end = rows.len() - 1;
            let back = |lengths: usize| value(&rows[end.saturating_sub(lengths * last.n_contact)]);
            // The changes decay geometrically from contact length to contact length.
            let [now, before, earlier] = [0, 1, 2].map(back);
            let [change, change_before] = [now - before, before - earlier].map(f64::abs);
            let ratio = (change / change_before).min(MAX_CHANGE_RATIO);
            Some(change * ratio / (1.0 - ratio)).filter(|rest| rest.is_finite())
        };
        Some([
            remainder(|row| row.friction_coefficient),
            remainder(|row| row.indentation_depth),
            remainder(|row| row.contact[0]),
            remainder(|row| row.contact[1]),
        ])
    }
}

#[cfg(test)]
mod tests;
