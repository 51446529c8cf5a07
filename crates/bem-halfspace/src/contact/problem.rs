//! The contact problem for loads, which are scaled pressures x = α P/(4π), its stopping criterion and its solution.
//!
//! The compliance α of the step has the unit 1/Pa and the operator K the unit m, so that loads have no unit and K x is a length.
//! Within a march heights and lengths may have other units, and x their quotient.

use crate::Convolution;
use crate::contact::{ContactOptions, Control};

/// A contact problem for the load `x = α P / (4π)` of each element, whose displacement is `K x`.
#[derive(Debug, Clone, Copy)]
pub(super) struct LoadProblem<'a> {
    /// Operator K on the grid, \[m].
    pub(super) convolution: &'a Convolution,
    /// Initial gap s, one value per element, row-major, \[m]; `+∞` where no contact is possible.
    pub(super) separation: &'a [f64],
    /// Prescribed depth \[m], or force as the sum of the loads, without unit.
    pub(super) control: Control,
}

/// Results of a solve, besides the fields of load and displacement.
pub(crate) struct LoadSolution {
    /// Depth d, \[m].
    pub(crate) indentation_depth: f64,
    /// Sum of the loads x over the grid of the problem, without unit.
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
    /// Upper bound of the ratio of the residual to that of the first guess; infinite for no such bound. The stricter of both bounds
    /// holds.
    pub(super) residual_reduction: f64,
    /// Maximum number of iterations.
    pub(super) max_iterations: usize,
    /// Largest displacement under loads that are given, not unknown, \[m]; the tolerance is relative to it as well.
    pub(super) given_deflection: f64,
}

impl StoppingCriterion {
    /// Criterion for a solution that is only the first guess on elements of half the edges.
    ///
    /// Reduction of the residual: that of the first guess measures the error of the coarser elements, which is of the order 3/2.
    /// About a third of it remains on these, so that a tenth is accurate enough. Tolerance and number of iterations are chosen to
    /// limit the time: a guess that misses them is used all the same, so that they decide the number of iterations only.
    pub(super) const GUESS: Self = Self {
        tolerance: 1e-3,
        residual_reduction: 0.1,
        max_iterations: 100,
        given_deflection: 0.0,
    };

    /// Relative residual at which the iteration stops, given that of the first guess.
    pub(super) fn target_residual(&self, first_residual: f64) -> f64 {
        self.tolerance.min(self.residual_reduction * first_residual)
    }
}

impl From<&ContactOptions> for StoppingCriterion {
    /// Criterion with tolerance and iterations of the options, without a bound relative to the first guess and without given loads.
    fn from(options: &ContactOptions) -> Self {
        Self {
            tolerance: options.tolerance,
            residual_reduction: f64::INFINITY,
            max_iterations: options.max_iterations,
            given_deflection: 0.0,
        }
    }
}
