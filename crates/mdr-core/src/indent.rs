//! Normal indentation without sliding, under a force or at a depth that has been there for a time.
//!
//! ```text
//! Σ (d − h_i)⁺ Δx = 2 (1 − ν) J(t) F_N/4          under a force
//! F_N = 4 G(t)/(2 (1 − ν)) Σ (d − h_i)⁺ Δx        at a depth
//! ```
//! The contact only grows, so that the chain is that of springs of this compliance or modulus (Lee & Radok 1960), and only
//! the spacing of its elements matters.

use indenters::{Control, PressingLoad, RigidLine};
use numerics::{ErrorParts, Estimate, Goal, Quantity, Request, no_other_error, positive, refine};
use rheology::{Elastic, Material};

use crate::MdrError;
use crate::contact::Instant;
use crate::element_heights::{ElementHeights, lowest_candidate};
use crate::error::{enough_elements, finite};
use crate::steady::Problem;

/// Elements along the contact after which an indentation is given up.
const MOST_ELEMENTS: usize = 16_384;
/// Depth and force converge faster than that, cusps or not.
const ORDER: f64 = 1.0;

/// A contact after some time under a constant control; an error of 0 says that a quantity is given.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[must_use]
pub struct Indentation {
    /// Indentation depth d of the lowest point, \[m].
    pub indentation_depth: Estimate,
    /// Normal force F_N, \[N].
    pub normal_force: Estimate,
    /// What the error of the depth, or of the force where the depth is given, consists of.
    pub error_parts: ErrorParts,
    /// Rear and front end of the contact, \[m].
    pub ends: [Estimate; 2],
    /// Number of loaded elements of the finest chain.
    pub n_contact: usize,
}

/// Presses a line into an undeformed chain for a time, with as many elements as the relative error of the depth needs, or
/// of the force where the depth is given; or with a number of them along the contact, and whatever error that has.
///
/// The lowest point of the line must lie inside its domain.
///
/// # Errors
/// [`MdrError::NotReached`] with what the finest chain gives; [`MdrError::ContactReachesEdge`] when the contact reaches an
/// end of the domain; [`MdrError::TooCoarse`] when fewer than three elements are in contact;
/// [`MdrError::TooManyElements`] when the chain would be too long; [`MdrError::InvalidParameter`],
/// [`MdrError::InvalidHeight`], [`MdrError::NonFinite`], [`MdrError::Material`]; otherwise like [`press`](crate::press()).
pub fn indent<'w>(
    line: &(impl RigidLine + ?Sized),
    material: &(impl Material + ?Sized),
    load: &PressingLoad,
    request: impl Into<Request<'w>>,
) -> Result<Indentation, MdrError> {
    let (control, time) = (load.control(), load.duration());
    let factor = material.half_space_factor();
    let soft = Elastic::new((factor * material.creep_compliance(time)?).recip())?;
    // For the size of the elements only.
    let length = Problem::new(line, &soft, 1.0)?.contact_span(control)?;
    let modulus = match control {
        Control::NormalForce(_) => soft.shear_modulus(),
        Control::IndentationDepth(_) => material.relaxation_modulus(time)? / factor,
    };
    let solve = |elements: usize, _: &dyn Fn(f64)| {
        Pressed::new(line, modulus, load, length / elements as f64)
    };
    let goal = Goal {
        request: request.into(),
        largest: MOST_ELEMENTS,
        order: ORDER,
        work: 1.0,
        others: 0.0,
    };
    let refined = refine(&goal, solve, |pressed| pressed.quantities, no_other_error)?;
    let pressed = refined.value;
    let estimate = |k: usize| Estimate {
        value: pressed.quantities[k].value,
        error: refined.error[k],
    };
    let (indentation_depth, normal_force, sought) = match control {
        Control::NormalForce(force) => (estimate(0), Estimate::exact(force), 0),
        Control::IndentationDepth(depth) => (Estimate::exact(depth), estimate(1), 1),
    };
    Ok(Indentation {
        indentation_depth,
        normal_force,
        error_parts: refined.parts[sought],
        ends: [estimate(2), estimate(3)],
        n_contact: pressed.n_contact,
    })
}

/// A contact on one resolution.
struct Pressed {
    /// Depth, force, rear and front. What is given is the same on all resolutions.
    quantities: [Quantity; 4],
    n_contact: usize,
}

impl Pressed {
    /// On springs of a modulus \[Pa].
    fn new(
        line: &(impl RigidLine + ?Sized),
        modulus: f64,
        load: &PressingLoad,
        spacing: f64,
    ) -> Result<Self, MdrError> {
        let elements = match load.control() {
            Control::NormalForce(force) => {
                let area = positive("area", 0.25 * force / modulus)?;
                ElementHeights::holding(line, spacing, area)?
            }
            Control::IndentationDepth(depth) => ElementHeights::below(line, spacing, depth)?,
        };
        let instant = Instant {
            heights: &elements.heights,
            displacements: &vec![0.0; elements.heights.len()],
        };
        let level = match load.control() {
            Control::NormalForce(force) => instant.solve(0.25 * force / spacing / modulus, 0.0),
            Control::IndentationDepth(depth) => instant.level(depth),
        };
        let depth = finite("indentation depth", level.depth, load.duration())?;
        let is_below = |height: &f64| *height < depth;
        let heights = &elements.heights;
        let (rear, front) = (
            heights.iter().position(is_below),
            heights.iter().rposition(is_below),
        );
        let ends = [rear.unwrap_or(0), front.unwrap_or(0)];
        if let Some(end) = [0, heights.len() - 1]
            .into_iter()
            .find(|end| ends.contains(end))
        {
            return Err(elements.reached(end, depth, load.duration()));
        }
        enough_elements(level.n_below, spacing)?;
        let [rear, front] = ends.map(|end| elements.position(end));
        // The outermost elements are loaded as wholes, whatever part of them touches: at the edge of a flat end they carry
        // as much as any, at every resolution.
        let front_height = line.height(front) - line.height(lowest_candidate(line)?);
        let outline = (depth - front_height).clamp(0.0, depth) / level.n_below as f64;
        let force = 4.0 * spacing * (level.compression * modulus);
        let quantity = |value: f64, least: f64, drives: bool| Quantity {
            least,
            drives,
            ..Quantity::from(value)
        };
        Ok(Self {
            quantities: [
                quantity(depth, outline, true),
                quantity(force, force * (outline / depth), true),
                quantity(rear, spacing, false),
                quantity(front, spacing, false),
            ],
            n_contact: level.n_below,
        })
    }
}
