//! What a fit of friction has reached.

use std::fmt;

/// What a fit of friction does, and what it has reached.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FitProgress {
    /// What it does.
    pub stage: FitStage,
    /// Root mean square residual of the best material so far, of the unit of [`FrictionFit::residual`]; `None` before the first.
    ///
    /// [`FrictionFit::residual`]: measurements::friction::FrictionFit::residual
    pub residual: Option<f64>,
}

/// A part of a fit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FitStage {
    /// Least squares of some of the points, from one start after the other until one explains them.
    Starts {
        /// Starts that are done.
        done: usize,
        /// How many are tried at most.
        of: usize,
    },
    /// Least squares of all points, on grids that are corrected again where the material has moved.
    LeastSquares {
        /// Rounds that are done.
        done: usize,
    },
    /// Intervals of the parameters.
    Intervals {
        /// Parameters that are done.
        done: usize,
        /// How many there are.
        of: usize,
    },
}

impl FitProgress {
    /// About which part of the work is done, where intervals take twice as long as what comes before them; 0 before the first.
    pub fn part(&self) -> f64 {
        match self.stage {
            FitStage::Intervals { done, of } => (1.0 + 2.0 * done as f64 / of.max(1) as f64) / 3.0,
            FitStage::Starts { .. } | FitStage::LeastSquares { .. } => 0.0,
        }
    }
}

impl fmt::Display for FitProgress {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.stage {
            FitStage::Starts { done, of } => write!(formatter, "start {} of {of}", done + 1)?,
            FitStage::LeastSquares { done } => {
                write!(formatter, "least squares, round {}", done + 1)?;
            }
            FitStage::Intervals { done, of } => write!(formatter, "interval {} of {of}", done + 1)?,
        }
        match self.residual {
            Some(residual) => write!(formatter, ", residual {residual:.2e}"),
            None => Ok(()),
        }
    }
}
