//! What one coarse grid says of a surface, without an error bar.

use bem_halfspace::PeriodicSliding;

use crate::solve::answer::Persson;
use crate::solve::body::Body;
use crate::solve::elements;
use crate::solve::problem::{Motion, Problem};
use crate::solve::work::rough;

/// As few elements as an answer to a relative error begins with, and so many times as many along both axes.
pub(super) const FINER: [usize; 4] = [1, 2, 4, 8];

#[derive(Debug, Clone, Copy)]
pub(super) struct Coarse {
    /// From the dissipated power, which falls with the loss of the material; that from slopes errs as on a spring.
    pub(super) friction_coefficient: f64,
    pub(super) area_fraction: f64,
    pub(super) contact_area: f64,
    pub(super) mean_depth: f64,
    /// A sum over waves, which needs no grid.
    pub(super) persson: Option<Persson>,
    pub(super) elements: usize,
}

/// Whether the surfaces of a problem are known on one grid alone, as those are that do not march.
pub(super) fn has_coarse_grids(problem: &Problem) -> bool {
    match problem.motion() {
        Motion::Sliding(load) => load.sliding_distance().is_none(),
        Motion::Pressing(_) => true,
        Motion::History(_) | Motion::Moving(_) => false,
    }
}

/// One surface on a coarse grid; none where its contact is not found there.
pub(super) fn solve(problem: &Problem, surface: u64, finer: usize) -> Option<Coarse> {
    let one = problem.of_surface(surface, 1).ok()?;
    let Body::Periodic(surface) = one.body() else {
        return None;
    };
    let rough = rough(&one, surface).ok()?;
    let (found, persson) = elements::on_coarse_grid(&one, rough, finer).ok()?;
    Some(Coarse::of(&found, persson))
}

impl Coarse {
    fn of(found: &PeriodicSliding, persson: Option<Persson>) -> Self {
        let period = found.pressure.grid.n_elements() as f64 * found.pressure.grid.element_area();
        Self {
            friction_coefficient: found.friction_from_dissipation,
            area_fraction: found.area_fraction,
            contact_area: found.area_fraction * period,
            mean_depth: found.mean_depth,
            persson,
            elements: found.pressure.grid.n_elements(),
        }
    }
}
