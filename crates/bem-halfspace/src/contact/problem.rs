//! The contact problem in scaled pressures, its stopping criterion and its solution.

use crate::Convolution;
use crate::contact::{ContactOptions, Control};

/// A contact problem for the scaled pressure, or load, `x = α P / (4π)` \[m], whose displacement is `K x`.
#[derive(Debug, Clone, Copy)]
pub(super) struct LoadProblem<'a> {
    /// Operator K on the grid.
    pub(super) convolution: &'a Convolution,
    /// Initial gap s, one value per element, \[m].
    pub(super) separation: &'a [f64],
    /// Depth, or force as the sum of the loads, \[m].
    pub(super) control: Control,
}

/// Results of a solve, besides the load.
pub(crate) struct LoadSolution {
    /// Depth d, \[m].
    pub(crate) indentation_depth: f64,
    /// Sum of the loads, \[m].
    pub(crate) total_load: f64,
    /// Number of iterations, with one operator application each.
    pub(crate) iterations: usize,
    /// Largest displacement in the contact, \[m].
    pub(crate) deflection: f64,
    /// Residual in the sense of [`ContactOptions::tolerance`].
    pub(crate) residual: f64,
}

/// Stopping criterion of the iteration.
pub(crate) struct StoppingCriterion {
    /// Upper bound of the residual, in the sense of [`ContactOptions::tolerance`].
    pub(super) tolerance: f64,
    /// Upper bound of the residual as a fraction of that of the first guess; infinity means no such bound.
    pub(super) residual_reduction: f64,
    /// Maximum number of iterations.
    pub(super) max_iterations: usize,
    /// Largest displacement under loads that are given, not unknown, \[m]; the tolerance is relative to it as well.
    pub(super) given_deflection: f64,
}

impl StoppingCriterion {
    /// Criterion for a solution that is only the first guess on elements of half the edges.
    ///
    /// The residual of its own first guess measures the error of the coarser elements, of which about a third remains on these:
    /// a more accurate solution gains nothing.
    pub(super) const GUESS: Self = Self {
        tolerance: 1e-3,
        residual_reduction: 0.1,
        max_iterations: 100,
        given_deflection: 0.0,
    };

    /// Residual at which the iteration stops, given that of the first guess.
    pub(super) fn target(&self, first_residual: f64) -> f64 {
        self.tolerance.min(self.residual_reduction * first_residual)
    }
}

impl From<&ContactOptions> for StoppingCriterion {
    fn from(options: &ContactOptions) -> Self {
        Self {
            tolerance: options.tolerance,
            residual_reduction: f64::INFINITY,
            max_iterations: options.max_iterations,
            given_deflection: 0.0,
        }
    }
}
