//! Progress of a fit of friction.

use std::fmt;

/// Current stage of a fit of friction, and its residual so far.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FitProgress {
    /// Current stage.
    pub stage: FitStage,
    /// Root mean square residual of the best material so far, in the unit of [`FrictionFit::residual`]; `None` before the first.
    ///
    /// [`FrictionFit::residual`]: measurements::friction::FrictionFit::residual
    pub residual: Option<f64>,
}

/// A stage of the fit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FitStage {
    /// Contacts of all points, if the material is fixed.
    Contacts,
    /// Least squares of some of the points from successive starts, until one is consistent with the noise.
    Starts {
        /// Number of completed starts.
        done: usize,
        /// Largest number of starts.
        of: usize,
    },
    /// Least squares of all points, with grids corrected again after large changes of the material.
    LeastSquares {
        /// Number of completed rounds.
        done: usize,
    },
    /// Confidence intervals of the parameters.
    Intervals {
        /// Number of completed parameters.
        done: usize,
        /// Number of parameters.
        of: usize,
    },
}

impl FitProgress {
    /// Estimated fraction of the work done, if the intervals take twice as long as all before them; 0 before the first interval.
    pub fn part(&self) -> f64 {
        match self.stage {
            FitStage::Intervals { done, of } => (1.0 + 2.0 * done as f64 / of.max(1) as f64) / 3.0,
            FitStage::Contacts | FitStage::Starts { .. } | FitStage::LeastSquares { .. } => 0.0,
        }
    }
}

impl fmt::Display for FitProgress {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.stage {
            FitStage::Contacts => write!(formatter, "contacts of the points")?,
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
