//! Unilateral contact of a rigid surface with a half space at one instant.
//!
//! ```text
//! gap = separation + α/(4π) K P − d,        0 ≤ P ≤ P_max,        gap ≥ 0 where P = 0,  gap = 0 between,  gap ≤ 0 where P = P_max
//! ```
//!
//! P is the pressure and K the operator of the influence coefficients. The separation is the height of the rigid surface plus the
//! displacement of the half space before the step. The compliance α of the step is `1/G` for an elastic half space and `Δt/η` for
//! a viscous one (implicit over the step). Either the normal force `Σ P ΔA` or the depth d is given. P_max is the hardness; if it
//! is infinite, the gap vanishes wherever there is pressure.
//!
//! Theory: docs/theory/contact.md.

pub(crate) mod active_set;
pub(crate) mod exchange_rule;
mod fields;
mod folded;
mod hardness;
mod iteration;
mod mirror_weights;
mod multilevel_correction;
pub(crate) mod patches;
mod preconditioner;
mod problem;
mod solve;
mod state;

use std::f64::consts::PI;

use crate::error::check_length;
use crate::parallel::chunks::in_pool;
use crate::parallel::reductions::mean;
use crate::transform::convolution::Surroundings;
use crate::{BemError, Convolution};
use folded::solve_symmetry_reduced;
use indenters::Control;
use numerics::{InvalidParameter, finite, in_range, positive};
pub use patches::Patch;
use problem::LoadProblem;
pub(crate) use problem::{LoadSolution, StoppingCriterion};
pub(crate) use state::ContactBox;
pub use state::ContactState;
use state::LoadState;

/// A contact problem on one grid.
#[derive(Debug, Clone, Copy)]
pub struct ContactProblem<'a> {
    /// The grid and its influence coefficients.
    pub convolution: &'a Convolution,
    /// Initial gap s: height of the rigid surface plus displacement of the half space before the step, \[m]. One value per element,
    /// row-major; `+∞` where no contact is possible.
    pub separation: &'a [f64],
    /// Compliance α of the half space in this step, \[1/Pa].
    pub compliance: f64,
    /// Hardness: the largest pressure that the surface bears, \[Pa]; infinite if nothing yields. An element at this pressure is
    /// indented permanently: its negative gap is the depth of the imprint.
    pub largest_pressure: f64,
    /// Prescribed force \[N] or depth \[m].
    pub control: Control,
}

/// Stopping criteria of the contact solver.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ContactOptions {
    /// Largest |gap| in the contact and largest penetration outside it, relative to the largest displacement; greater than 0
    /// and at most 1e-2. The largest displacement is that in the contact, or that of an element under its own pressure if this is
    /// larger, as it may be on a periodic grid.
    pub tolerance: f64,
    /// Maximum number of iterations, with one operator application each.
    pub max_iterations: usize,
}

impl Default for ContactOptions {
    /// A tolerance of 1e-9 and at most 2000 iterations.
    fn default() -> Self {
        // Chosen: the tolerance is four decades above the rounding of the transforms on 512² elements, and the limit of the iterations
        // ends only solves that do not converge.
        Self {
            tolerance: 1e-9,
            max_iterations: 2000,
        }
    }
}

/// A solved contact; the pressure is in the [`ContactState`].
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[must_use]
pub struct Contact {
    /// Indentation depth d, \[m].
    pub indentation_depth: f64,
    /// Normal force, \[N].
    pub normal_force: f64,
    /// Number of elements in contact.
    pub n_contact: usize,
    /// Number of elements at the largest pressure.
    pub n_at_limit: usize,
    /// True if an element at the edge of a free grid is in contact. Unless the body ends there, the contact may extend beyond
    /// the edge, and a larger grid is needed.
    pub reaches_edge: bool,
    /// Number of iterations, with one operator application each.
    pub iterations: usize,
    /// Final residual, in the sense of [`ContactOptions::tolerance`].
    pub residual: f64,
}

/// Largest relative tolerance that is accepted. Chosen: less accurate contacts have no meaningful pressure, whose relative error
/// may be 20 times the tolerance (docs/theory/contact.md, "When it stops").
const MAX_TOLERANCE: f64 = 1e-2;

/// Solves a contact problem. The pressure in `state` is the first guess, and the solution afterwards.
///
/// Without a guess the solver starts from solutions on coarser grids. It iterates on a box around the contact if that is much
/// smaller than the grid. If separation and first guess are symmetric about the middle of the grid to the last bit, it iterates
/// on one half or one quarter of the grid; a periodic grid needs a multiple of four elements for it. The algorithm is described
/// in `docs/theory/contact.md`.
///
/// # Errors
/// [`BemError::InvalidParameter`] for a compliance that is not finite and positive, a largest pressure that is not positive, a
/// force that is not finite and non-negative, and a depth that is not finite or, on a periodic half space, not below the mean
/// of the separation; [`BemError::ForceNotBorne`] for a force that all elements together do not bear below the largest
/// pressure; [`BemError::LengthMismatch`], [`BemError::InvalidHeight`]; [`BemError::ContactNotConverged`] with the final
/// residual.
pub fn solve_contact(
    problem: &ContactProblem,
    state: &mut ContactState,
    options: &ContactOptions,
) -> Result<Contact, BemError> {
    validate(problem, state)?;
    options.validate()?;
    // With the load x = α P / (4π) the displacement is K x, and the unknown has no unit.
    let load_per_pressure = problem.compliance / (4.0 * PI);
    let grid = problem.convolution.grid();
    let area = grid.element_area();
    let loads = LoadProblem {
        convolution: problem.convolution,
        separation: problem.separation,
        control: map_force(problem.control, |force| force * load_per_pressure / area),
    };
    // Solve for the loads, and convert the solution back to pressures, converged or not.
    let largest_load = problem.largest_pressure * load_per_pressure;
    let pressure_per_load = 1.0 / load_per_pressure;
    let to_pressure = |load: f64| {
        if load < largest_load {
            // By rounding the product may exceed the largest pressure, at which it is cut off.
            problem.largest_pressure.min(load * pressure_per_load)
        } else {
            problem.largest_pressure
        }
    };
    let solve =
        |state: &mut LoadState| solve_symmetry_reduced(loads, largest_load, state, &options.into());
    let solved = in_pool(grid.n_elements(), || {
        state.solve_for_loads(problem.convolution, load_per_pressure, solve, to_pressure)
    });
    let solution = solved?;
    let at_limit = |&&element: &&usize| state.pressure()[element] >= problem.largest_pressure;
    Ok(Contact {
        indentation_depth: solution.indentation_depth,
        normal_force: solution.total_load * area / load_per_pressure,
        n_contact: state.contact().len(),
        n_at_limit: state.contact().iter().filter(at_limit).count(),
        reaches_edge: problem.reaches_edge(state),
        iterations: solution.iterations,
        residual: solution.residual,
    })
}

/// Applies a function to the value of a prescribed force, such as a change of its unit; a prescribed depth stays as it is.
fn map_force(control: Control, map: impl Fn(f64) -> f64) -> Control {
    match control {
        Control::NormalForce(force) => Control::NormalForce(map(force)),
        depth @ Control::IndentationDepth(_) => depth,
    }
}

impl ContactOptions {
    /// Checks that the tolerance is greater than 0 and at most [`MAX_TOLERANCE`].
    pub(crate) fn validate(&self) -> Result<(), InvalidParameter> {
        let value = self.tolerance;
        let is_allowed = value > 0.0 && value <= MAX_TOLERANCE;
        let allowed = "greater than 0 and at most 1e-2";
        in_range("contact tolerance", value, is_allowed, allowed).map(drop)
    }
}

/// Checks the parameters, fields and control of a problem, and the length of the first guess.
fn validate(problem: &ContactProblem, state: &ContactState) -> Result<(), BemError> {
    let (grid, heights) = (problem.convolution.grid(), problem.separation);
    // Check compliance, largest pressure and control, and the lengths and values of the fields.
    positive("compliance", problem.compliance)?;
    let limit = problem.largest_pressure;
    in_range("largest_pressure", limit, limit > 0.0, "greater than 0")?;
    check_length("separation", heights.len(), grid.n_elements())?;
    check_length("pressure", state.pressure().len(), grid.n_elements())?;
    check_heights(heights, grid.shape()[1])?;
    check_has_body("separation", heights)?;
    check_control(problem.control)?;
    // A force must be below that of all elements at the largest pressure.
    if let Control::NormalForce(normal_force) = problem.control {
        let n_elements = heights.iter().filter(|height| height.is_finite()).count();
        let limit = limit * grid.element_area() * n_elements as f64;
        if normal_force >= limit {
            return Err(BemError::ForceNotBorne {
                normal_force,
                limit,
            });
        }
    }
    // A given depth must leave gaps in a periodic contact, because it does not determine the pressure of a full one.
    if let Control::IndentationDepth(value) = problem.control
        && problem.convolution.surroundings == Surroundings::Periodic
    {
        let is_allowed = value < mean(heights);
        let allowed = "below the mean height, at which a periodic contact is full and its pressure is not determined";
        in_range("indentation_depth", value, is_allowed, allowed)?;
    }
    Ok(())
}

/// Checks that the heights of a body over a grid, row-major with `columns` columns, are numbers above −∞.
fn check_heights(heights: &[f64], columns: usize) -> Result<(), BemError> {
    let invalid = |height: &f64| height.is_nan() || *height == f64::NEG_INFINITY;
    if let Some(index) = heights.iter().position(invalid) {
        return Err(BemError::InvalidHeight {
            row: index / columns,
            column: index % columns,
            value: heights[index],
        });
    }
    Ok(())
}

/// Checks that the heights of a field are finite in at least one element.
pub(crate) fn check_has_body(field: &'static str, heights: &[f64]) -> Result<(), BemError> {
    let has_body = heights.iter().any(|height| height.is_finite());
    let allowed = "below infinity in at least one element";
    in_range(field, f64::INFINITY, has_body, allowed)?;
    Ok(())
}

/// Checks that a prescribed force is finite and not negative, or a prescribed depth finite; returns its value, \[N] or \[m].
pub(crate) fn check_control(control: Control) -> Result<f64, InvalidParameter> {
    match control {
        Control::NormalForce(value) => {
            let is_allowed = value.is_finite() && value >= 0.0;
            let allowed = "finite and not negative (there is no adhesion)";
            in_range("normal_force", value, is_allowed, allowed)
        }
        Control::IndentationDepth(value) => finite("indentation_depth", value),
    }
}
