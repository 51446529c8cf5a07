//! Normal indentation without sliding, by marching in time: to the error asked for, or on one stated resolution.

mod on_grid;

use indenters::{Control, PressingLoad, RigidLine};
use numerics::{ErrorParts, Estimate, Goal, Quantity, Request, no_other_error, refine};
use rheology::{Elastic, Material};

use crate::MdrError;
use crate::element_heights::lowest_candidate;
use crate::steady::Problem;
pub use on_grid::{IndentOptions, IndentRow, IndentStep, indent_history, indent_on_grid};

/// Elements along the contact, and steps, after which an indentation is given up.
const MOST_ELEMENTS: usize = 16_384;
/// Depth and force converge faster than that, cusps or not.
const ORDER: f64 = 1.0;
/// There are as many steps as elements.
const WORK: f64 = 2.0;

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
    /// The history on the finest chain.
    pub finest: Vec<IndentRow>,
    /// Its resolution.
    pub options: IndentOptions,
}

/// Presses a line into an undeformed chain for a time, with as many elements, and as many steps, as the relative error of
/// the depth needs, or of the force where the depth is given; or with a number of them, and whatever error that has.
///
/// The lowest point of the line must lie inside its domain.
///
/// # Errors
/// [`MdrError::NotReached`] with what the finest chain gives; otherwise like [`indent_on_grid`] and
/// [`press`](crate::press()).
pub fn indent<'w>(
    line: &(impl RigidLine + ?Sized),
    material: &(impl Material + ?Sized),
    load: &PressingLoad,
    request: impl Into<Request<'w>>,
) -> Result<Indentation, MdrError> {
    let length = contact_length(line, material, load)?;
    let options = |elements: usize| IndentOptions {
        spacing: length / elements as f64,
        n_steps: elements,
    };
    let solve = |elements, _: &dyn Fn(f64)| {
        let rows = indent_on_grid(line, material, load, &options(elements))?;
        State::new(line, rows)
    };
    let goal = Goal {
        request: request.into(),
        largest: MOST_ELEMENTS,
        order: ORDER,
        work: WORK,
        others: 0.0,
    };
    let refined = refine(&goal, solve, |state| state.quantities, no_other_error)?;
    let State { rows, quantities } = refined.value;
    let estimate = |k: usize| Estimate {
        value: quantities[k].value,
        error: refined.error[k],
    };
    let (indentation_depth, normal_force, sought) = match load.control() {
        Control::NormalForce(force) => (estimate(0), Estimate::exact(force), 0),
        Control::IndentationDepth(depth) => (Estimate::exact(depth), estimate(1), 1),
    };
    Ok(Indentation {
        indentation_depth,
        normal_force,
        error_parts: refined.parts[sought],
        ends: [estimate(2), estimate(3)],
        finest: rows,
        options: options(refined.elements),
    })
}

/// Length of the contact at the end, \[m], for the size of the elements only: while it grows a material is pressed like a
/// spring of the compliance J(t) (Lee & Radok 1960).
fn contact_length(
    line: &(impl RigidLine + ?Sized),
    material: &(impl Material + ?Sized),
    load: &PressingLoad,
) -> Result<f64, MdrError> {
    let compliance = material.half_space_factor() * material.creep_compliance(load.duration())?;
    let spring = Elastic::new(compliance.recip())?;
    Problem::new(line, &spring, 1.0)?.contact_span(load.control())
}

/// A history on one resolution.
struct State {
    rows: Vec<IndentRow>,
    /// Depth, force, rear and front at its end. What is given is the same on all resolutions.
    quantities: [Quantity; 4],
}

impl State {
    fn new(line: &(impl RigidLine + ?Sized), rows: Vec<IndentRow>) -> Result<Self, MdrError> {
        let last = rows.last().ok_or(MdrError::Empty { list: "steps" })?;
        let [rear, front] = last.contact.ok_or(MdrError::Empty { list: "contact" })?;
        let (depth, force) = (last.indentation_depth, last.normal_force);
        // The outermost elements are loaded as wholes, whatever part of them touches: at the edge of a flat end they carry
        // as much as any, at every resolution.
        let front_height = line.height(front) - line.height(lowest_candidate(line)?);
        let outline = (depth - front_height).clamp(0.0, depth) / last.n_contact as f64;
        let spacing = last.contact_length / last.n_contact as f64;
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
            rows,
        })
    }
}
