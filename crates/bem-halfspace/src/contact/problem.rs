//! A contact problem for loads, when it is solved, and what its solution is.

use crate::Convolution;
use crate::contact::{ContactOptions, Control};

/// A contact problem for the load `x = α P / (4π)`, whose displacement is `K x`.
#[derive(Debug, Clone, Copy)]
pub(super) struct LoadProblem<'a> {
    pub(super) convolution: &'a Convolution,
    /// One value per element, \[m].
    pub(super) separation: &'a [f64],
    /// A force is the sum of the loads.
    pub(super) control: Control,
}

/// The result of a solve beside the load.
pub(crate) struct LoadSolution {
    pub(crate) indentation_depth: f64,
    pub(crate) total_load: f64,
    pub(crate) iterations: usize,
    /// Largest displacement in the contact, \[m].
    pub(crate) deflection: f64,
    pub(crate) residual: f64,
}

/// When an iteration ends.
pub(crate) struct StoppingCriterion {
    /// See [`ContactOptions::tolerance`].
    pub(super) tolerance: f64,
    /// The residual must also fall to this part of what the first guess leaves; `∞` where that does not matter.
    pub(super) part_of_first: f64,
    pub(super) max_iterations: usize,
    /// Largest displacement under loads that are given and not sought, to which the tolerance relates as well, \[m].
    pub(super) given_deflection: f64,
}

impl StoppingCriterion {
    /// For a solution that is the first guess on elements of half the edges.
    ///
    /// The residual of its own first guess measures the error of the larger elements, of which about a third remains
    /// with these; nothing is gained from a solution more accurate than that.
    pub(super) const GUESS: Self = Self {
        tolerance: 1e-3,
        part_of_first: 0.1,
        max_iterations: 100,
        given_deflection: 0.0,
    };

    /// The residual at which to end, from that of the first guess.
    pub(super) fn target(&self, first_residual: f64) -> f64 {
        self.tolerance.min(self.part_of_first * first_residual)
    }
}

impl From<&ContactOptions> for StoppingCriterion {
    fn from(options: &ContactOptions) -> Self {
        Self {
            tolerance: options.tolerance,
            part_of_first: f64::INFINITY,
            max_iterations: options.max_iterations,
            given_deflection: 0.0,
        }
    }
}
