//! The stationary contact of a periodic surface on one grid, from a first guess of the pressure.
//!
//! Theory: docs/theory/stationary-half-space.md, "Periodic surfaces".

use numerics::{InvalidParameter, in_range};

use crate::parallel::reductions::mean;
use crate::stationary::periodic::equations::Equations;
use crate::stationary::periodic::kernel::MaterialAtSpeed;
use crate::stationary::periodic::{PeriodicControl, PeriodicOptions};
use crate::stationary::search::Search;
use crate::{BemError, Grid};

/// Largest allowed ratio of the root mean square of the residual, on any active set, to that of the heights about their mean.
/// Chosen (case of `evidence tuning`).
///
/// Without it the contact of a solid whose moduli differ by 1000 takes up to twice as many operator applications on 1024²
/// elements.
const INEXACT_TOLERANCE: f64 = 0.01;

/// A contact problem on one grid.
#[derive(Debug, Clone, Copy)]
pub(super) struct PeriodicContact<'a> {
    /// Material and speed.
    pub(super) sliding: &'a MaterialAtSpeed,
    /// Grid of one period.
    pub(super) grid: &'a Grid,
    /// Heights at the centres of the elements, row-major, \[m].
    pub(super) heights: &'a [f64],
    /// Prescribed mean pressure or depth.
    pub(super) control: PeriodicControl,
    /// Stopping criteria.
    pub(super) options: PeriodicOptions,
}

/// Depth and effort of a solved contact; [`solve`] returns the pressure in its argument.
pub(super) struct PeriodicSolution {
    /// Sum of height h and displacement u of the elements in contact, \[m].
    pub(super) depth: f64,
    /// Operator applications on this grid.
    pub(super) applications: usize,
    /// Final residual, relative to the largest displacement.
    pub(super) residual: f64,
}

/// Solves the problem from a first guess of the `pressure` \[Pa], row-major, which is replaced by the solution.
///
/// Outside the contact the solution is minus the gap over the self-influence, a negative pressure. Without a positive pressure in the
/// guess, the first active set is all elements not above the mean height, or those below a prescribed depth. If there are none below
/// that depth, there is no contact.
///
/// # Errors
/// [`BemError::ContactNotConverged`]; `pressure` then is the best that was reached.
pub(super) fn solve(
    problem: PeriodicContact,
    equations: &mut Equations,
    pressure: &mut Vec<f64>,
) -> Result<PeriodicSolution, BemError> {
    // Interpolate the heights at the points where gaps are evaluated. Their variance is the scale of the inner tolerance.
    let mut heights = vec![0.0; problem.grid.n_elements()];
    equations.kernel.shifted(problem.heights, &mut heights);
    let mean_height = mean(&heights);
    let squares = heights.iter().map(|h| (h - mean_height).powi(2));
    let variance = squares.sum::<f64>() / heights.len() as f64;
    // A prescribed depth is that of the mean plane. The search needs the sum of height and displacement in the contact.
    let own = equations.self_influence;
    let depth = problem.prescribed_depth().map(|depth| mean_height + depth);

    // The first active set is that of the guess. Without one it contains the elements below the mean height, or below a
    // prescribed depth. If no element lies below that depth, nothing touches.
    let overlap = |height: &f64| match depth {
        None => f64::from(*height <= mean_height),
        Some(depth) => (depth - height) / own,
    };
    let overlaps = || heights.iter().map(overlap).collect();
    if let Some(depth) = depth
        && !heights.iter().any(|height| *height < depth)
    {
        *pressure = overlaps();
        return Ok(PeriodicSolution {
            depth,
            applications: 0,
            residual: 0.0,
        });
    }
    let has_guess = pressure.iter().any(|pressure| *pressure > 0.0);
    let guess = if has_guess {
        std::mem::take(pressure)
    } else {
        overlaps()
    };

    // Search the active set and its pressures, beginning with the guess.
    (equations.depth, equations.max_applications) = (depth, problem.options.max_applications);
    let inner_tolerance = INEXACT_TOLERANCE * variance.sqrt();
    let mut search = Search::new(
        equations,
        heights,
        inner_tolerance,
        problem.options.tolerance,
        guess,
    );
    let found = search.run();
    let [residual, depth] = [search.residual, search.depth];
    *pressure = search.pressure;
    // Return the pressure in contact. Outside it return minus the gap over the self-influence, a negative pressure.
    for ((pressure, gap), inside) in pressure.iter_mut().zip(search.gap).zip(search.active) {
        *pressure = if inside {
            pressure.max(0.0)
        } else {
            -gap.max(0.0) / own
        };
    }
    found.map(|()| PeriodicSolution {
        depth,
        applications: equations.applications,
        residual,
    })
}

impl PeriodicContact<'_> {
    /// Prescribed depth of the mean plane, \[m]; `None` under a mean pressure.
    pub(super) const fn prescribed_depth(&self) -> Option<f64> {
        match self.control {
            PeriodicControl::MeanPressure(_) => None,
            PeriodicControl::MeanDepth(depth) => Some(depth),
        }
    }

    /// Fails if a depth of the mean plane \[m] is prescribed that `is_allowed` refuses.
    pub(super) fn check_depth(
        &self,
        is_allowed: impl Fn(f64) -> bool,
    ) -> Result<(), InvalidParameter> {
        let allowed = "above minus the height of the mean plane over the lowest point, and on a half space below 0";
        let check = |depth: f64| in_range("mean_depth", depth, is_allowed(depth), allowed);
        self.prescribed_depth()
            .map_or(Ok(()), |depth| check(depth).map(drop))
    }
}
