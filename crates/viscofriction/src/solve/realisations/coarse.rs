//! Solution for one surface on one coarse grid, without an error estimate.

use bem_halfspace::PeriodicSliding;

use crate::solve::answer::Persson;
use crate::solve::body::Body;
use crate::solve::elements;
use crate::solve::problem::{Motion, Problem};
use crate::solve::work::rough;

/// Ratios of the number of elements along each axis of the coarse grids that are tried, to that of the first grid of an answer.
/// Chosen: the spacing halves from one to the next.
pub(super) const REFINEMENT_FACTORS: [usize; 4] = [1, 2, 4, 8];

/// Quantities of one surface on a coarse grid.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Coarse {
    /// Friction coefficient from the dissipated power, which vanishes with the loss of the material; that from the slopes has a
    /// discretisation error even on a spring.
    pub(crate) friction_from_hysteresis: f64,
    /// Friction coefficient from the shear of the contact area; 0 without an interface.
    pub(crate) friction_from_shear: f64,
    /// Contact area as a fraction of the period.
    pub(crate) area_fraction: f64,
    /// Contact area of one period, \[m²].
    pub(crate) contact_area: f64,
    /// Depth of the mean plane, \[m].
    pub(crate) mean_depth: f64,
    /// Persson's theory, a sum over waves that needs no grid.
    pub(crate) persson: Option<Persson>,
    /// Elements of the grid.
    pub(crate) elements: usize,
}

/// True if a single grid solves the problem: stationary sliding or indentation, without a time march.
pub(super) fn has_coarse_grids(problem: &Problem) -> bool {
    match problem.motion() {
        Motion::Sliding(load) => load.sliding_distance().is_none(),
        Motion::Pressing(_) => true,
        Motion::History { .. } | Motion::Moving(_) => false,
    }
}

/// Solves for one surface, counted from 0, on the coarse grid with the refinement factor `finer`; `None` if its contact is not
/// found there.
pub(super) fn solve(problem: &Problem, surface: u64, finer: usize) -> Option<Coarse> {
    let one = problem.realisation_problem(surface, 1).ok()?;
    let Body::Periodic(surface) = one.body() else {
        return None;
    };
    let rough = rough(&one, surface).ok()?;
    let (found, persson) = elements::on_coarse_grid(&one, rough, finer).ok()?;
    let strength = one.shear_strength().ok()?.unwrap_or(0.0);
    Some(Coarse::of(&found, strength / rough.mean_pressure, persson))
}

impl Coarse {
    /// Collects the quantities of a solution on one grid. `shear` is the ratio of shear strength and mean pressure.
    fn of(found: &PeriodicSliding, shear: f64, persson: Option<Persson>) -> Self {
        let period = found.pressure.grid.n_elements() as f64 * found.pressure.grid.element_area();
        Self {
            friction_from_hysteresis: found.friction_from_dissipation,
            friction_from_shear: shear * found.area_fraction,
            area_fraction: found.area_fraction,
            contact_area: found.area_fraction * period,
            mean_depth: found.mean_depth,
            persson,
            elements: found.pressure.grid.n_elements(),
        }
    }

    /// Friction coefficient: hysteresis and shear.
    pub(crate) fn friction_coefficient(&self) -> f64 {
        self.friction_from_hysteresis + self.friction_from_shear
    }
}
