//! Stationary sliding of periodic surfaces, rough and wavy ones.
//!
//! A rigid surface h(x, y) with the periods L_x and L_y slides along x on a viscoelastic half space. In the frame that moves
//! with it the stationary state is one complementarity problem
//!
//! ```text
//! gap = h + u − d ≥ 0,  p ≥ 0,  p · gap = 0,  mean of p given,      û(q) = 2 p̂(q) M / (|q| E*(ω)),  ω = −q_x v
//! ```
//!
//! for the displacement u, the pressure p and the depth d. A hat denotes the amplitude of the wave with the wave vector q, and v
//! is the sliding speed. The complex contact modulus is E* = 2 G*/(1 − ν), with the shear modulus G* and the Poisson ratio ν. The
//! compliance ratio M of a layer is 1 on a half space.
//!
//! The kernel is translation-invariant and not symmetric. The problem is solved by nested iteration, from the coarsest grid to
//! the one asked for, each with half the spacing of the one before. The discretisation is trigonometric collocation: pressures
//! and gaps are values at points, with the exact symbol of the kernel for each resolved wave. The friction coefficient μ is
//! computed in two ways,
//!
//! ```text
//! μ ⟨p⟩ = ⟨p ∂h/∂x⟩ = Σ_q 2 |p̂|² (|q_x|/|q|) Im E*(|q_x| v)/|E*|².
//! ```
//!
//! The active-set search is shared with single bodies (`stationary/search.rs`); the equations on a given active set are in
//! `equations.rs`.
//!
//! Theory: docs/theory/stationary-half-space.md, "Periodic surfaces".

mod block_correction;
mod contact;
mod equations;
#[cfg(feature = "rough")]
mod estimate;
#[cfg(feature = "rough")]
mod gap;
#[cfg(feature = "rough")]
pub(crate) mod grid_sizes;
pub(crate) mod kernel;
mod load;
pub(crate) mod nested;
#[cfg(feature = "rough")]
pub(crate) mod perimeter_error;
#[cfg(feature = "rough")]
pub(crate) mod refinement;

pub(crate) mod fourier_multiplier;
#[cfg(feature = "rough")]
pub mod sensitivity;
#[cfg(feature = "rough")]
mod subgrid_gaps;

use numerics::{InvalidParameter, in_range, positive};

use crate::elements::area;
use crate::error::check_length;
use crate::parallel::chunks::in_pool;
use crate::parallel::reductions::{dot, mean};
use crate::{BemError, Elastomer, Grid, PressureField};
use contact::PeriodicContact;
use equations::Equations;
#[cfg(feature = "rough")]
pub use estimate::{PeriodicEstimate, slide, steady, steady_on_coarse_grid};
#[cfg(feature = "rough")]
pub use gap::gap;
#[cfg(feature = "rough")]
pub use grid_sizes::{edge_for_bars, elements_for_bars, fewest_elements, largest_grid, memory};
use kernel::MaterialAtSpeed;
pub use load::{PeriodicControl, PeriodicLoad};

/// Stopping criteria of the solver.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct PeriodicOptions {
    /// Largest |gap| in the contact and largest penetration outside, relative to the largest displacement from the mean;
    /// between 0 and 1.
    pub tolerance: f64,
    /// Maximum number of operator applications on the finest grid.
    pub max_applications: usize,
}

impl Default for PeriodicOptions {
    /// Relative tolerance 1e-6, and at most 2000 operator applications.
    fn default() -> Self {
        Self {
            tolerance: 1e-6,
            max_applications: 2000,
        }
    }
}

/// A stationary state of a periodic surface on one grid.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[must_use]
#[non_exhaustive]
pub struct PeriodicSliding {
    /// Friction coefficient ⟨p ∂h/∂x⟩/⟨p⟩, with the slope of the trigonometric polynomial through the heights.
    pub friction_coefficient: f64,
    /// Friction coefficient from the power that the material dissipates. Both converge to the same value; their difference
    /// measures how well this grid resolves the contact.
    pub friction_from_dissipation: f64,
    /// Fraction of the period in contact, with the perimeter correction of Yastrebov, Anciaux & Molinari (2017).
    pub area_fraction: f64,
    /// Depth of the mean plane of the surface, \[m]; negative in light contact.
    ///
    /// It is measured from the mean of the deformed half space, which the mean pressure moves without limit, or from the
    /// undeformed surface of a layer.
    pub mean_depth: f64,
    /// Operator applications on this grid.
    pub applications: usize,
    /// Final residual, in the sense of [`PeriodicOptions::tolerance`].
    pub residual: f64,
    /// Pressure of the elements; the origin is the centre of the first element.
    pub pressure: PressureField,
}

/// Solves the stationary sliding of a periodic surface on a linear viscoelastic solid, or its pressing without sliding.
///
/// `heights` \[m] has the height at the centre of every element of the grid, whose edges are the periods; in between the surface
/// is the trigonometric polynomial through them. The lowest points touch first, and the surface slides towards positive x. At the
/// velocity 0 the contact is the elastic one with the equilibrium modulus.
///
/// # Errors
/// [`BemError::LengthMismatch`], [`BemError::InvalidHeight`]; [`BemError::InvalidParameter`] for options out of range, one
/// row or column only, and heights that are all the same; [`BemError::FlowsUnderWaves`]; [`BemError::Material`];
/// [`BemError::ContactNotConverged`].
pub fn steady_on_grid(
    grid: &Grid,
    heights: &[f64],
    elastomer: &dyn Elastomer,
    load: &PeriodicLoad,
    options: &PeriodicOptions,
) -> Result<PeriodicSliding, BemError> {
    options.validate()?;
    check_surface(grid, heights)?;
    let problem = PeriodicContact {
        sliding: &MaterialAtSpeed::under_load(elastomer, load)?,
        grid,
        heights,
        control: load.require_stationary()?,
        options: *options,
    };
    solve_from(&mut Vec::new(), problem)
}

/// Solves a problem from a guess of the pressure, see [`nested::solve`], which is replaced by the pressure on this grid.
fn solve_from(guess: &mut Vec<f64>, problem: PeriodicContact) -> Result<PeriodicSliding, BemError> {
    in_pool(problem.grid.n_elements(), || solve_in_pool(guess, problem))
}

/// Solves a problem as [`solve_from`], on the threads of the caller, and evaluates the friction.
fn solve_in_pool(
    guess: &mut Vec<f64>,
    problem: PeriodicContact,
) -> Result<PeriodicSliding, BemError> {
    let is_closed = |depth: f64| depth >= 0.0 && !problem.sliding.is_on_rigid_base();
    problem.check_depth(|depth| !is_closed(depth))?;
    // Solve for the pressure. Outside the contact the solution is negative, which the pressure field leaves out.
    let mut equations = Equations::new(problem.sliding, problem.grid, problem.control)?;
    let solved = nested::solve(problem, &mut equations, guess)?;
    problem.check_depth(|_| guess.iter().any(|pressure| *pressure > 0.0))?;
    let pressure: Vec<f64> = guess.iter().map(|p| p.max(0.0)).collect();
    // Compute the friction from the slopes of the surface, and from the power that the material dissipates.
    let mut field = vec![0.0; pressure.len()];
    let weighted_mean = |field: &[f64]| dot(field, &pressure) / pressure.iter().sum::<f64>();
    equations.kernel.slopes(problem.heights, &mut field);
    let from_slopes = weighted_mean(&field);
    equations.kernel.negative_loss_slopes(&pressure, &mut field);
    let from_dissipation = weighted_mean(&field);
    Ok(PeriodicSliding {
        friction_coefficient: from_slopes,
        friction_from_dissipation: from_dissipation,
        area_fraction: area::area_fraction(problem.grid.shape()[1], &pressure).area,
        mean_depth: solved.depth - mean(problem.heights),
        applications: solved.applications,
        residual: solved.residual,
        pressure: PressureField {
            grid: *problem.grid,
            origin: [0.0; 2],
            pressure,
        },
    })
}

impl PeriodicOptions {
    /// Refuses numbers out of their ranges.
    fn validate(&self) -> Result<(), InvalidParameter> {
        numerics::between_zero_and_one("tolerance", self.tolerance)?;
        positive("max_applications", self.max_applications as f64).map(drop)
    }
}

/// Refuses heights that are not finite, too few, or all the same.
pub(crate) fn check_surface(grid: &Grid, heights: &[f64]) -> Result<(), BemError> {
    let [rows, columns] = grid.shape();
    check_length("heights", heights.len(), grid.n_elements())?;
    let allowed = "at least 2";
    in_range("rows of heights", rows as f64, rows >= 2, allowed)?;
    in_range("columns of heights", columns as f64, columns >= 2, allowed)?;
    if let Some(index) = heights.iter().position(|height| !height.is_finite()) {
        return Err(BemError::InvalidHeight {
            row: index / columns,
            column: index % columns,
            value: heights[index],
        });
    }
    let is_flat = heights.iter().all(|h| h.total_cmp(&heights[0]).is_eq());
    let allowed = "not the same everywhere: a flat surface has no friction";
    in_range("height", heights[0], !is_flat, allowed)?;
    Ok(())
}
