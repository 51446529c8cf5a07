//! Fit of a friction model to measured friction coefficients, with confidence intervals.
//!
//! ```text
//! μ_i = μ(v_i, T_i, F_i; θ) + noise
//! ```
//! for any model μ with derivatives by the logarithms of its parameters θ.

mod fit;
mod read;
mod runs;

use numerics::least_squares::ParameterRange;
use numerics::{InvalidParameter, in_range, positive};

pub use fit::{FrictionFit, FrictionFitting, FrictionMinimum};
pub(crate) use read::FRICTION;
pub(crate) use read::ROTATIONAL_UNITS;
pub use read::{FrictionTable, FrictionTableOptions, friction_points};

/// A measured friction coefficient.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct FrictionPoint {
    /// Sliding or rolling speed v > 0, \[m/s].
    pub velocity: f64,
    /// Friction coefficient μ > 0, the ratio of the force along the surface to the normal force.
    pub friction_coefficient: f64,
    /// Standard error of the friction coefficient, if known.
    pub standard_error: Option<f64>,
    /// Temperature of the elastomer, \[°C], if known.
    pub temperature: Option<f64>,
    /// Normal force, \[N], if it varies between points.
    pub normal_force: Option<f64>,
}

impl FrictionPoint {
    /// Largest plausible friction coefficient. Chosen: a larger number is another quantity, or in another unit.
    pub const LARGEST_COEFFICIENT: f64 = 10.0;

    /// Checks measured points.
    ///
    /// Refused are numbers that are not greater than 0, implausible friction coefficients, and standard errors of some points
    /// only. So is friction whose ratio of largest to smallest value exceeds three times that of the speeds.
    ///
    /// # Errors
    /// [`InvalidParameter`] for the first violation.
    pub fn check_all(points: &[Self]) -> Result<(), InvalidParameter> {
        for point in points {
            positive("velocity", point.velocity)?;
            let friction = positive("friction coefficient", point.friction_coefficient)?;
            let holds = friction <= Self::LARGEST_COEFFICIENT;
            let allowed = "at most 10, because no body on rubber has a larger one (is it in per cent, or are columns exchanged?)";
            in_range("friction coefficient", friction, holds, allowed)?;
            let others = [
                ("standard error", point.standard_error),
                ("normal force", point.normal_force),
            ];
            for (name, value) in others {
                value.map_or(Ok(1.0), |value| positive(name, value))?;
            }
        }
        let with_error = points.iter().filter(|point| point.standard_error.is_some());
        let n_errors = with_error.count();
        let holds = n_errors == 0 || n_errors == points.len();
        let allowed = "0 or the number of points";
        in_range("number of standard errors", n_errors as f64, holds, allowed)?;
        Self::check_spread(points)
    }

    /// Refuses friction that varies more with the speed than for a linear material, as with exchanged columns.
    fn check_spread(points: &[Self]) -> Result<(), InvalidParameter> {
        let is_constant =
            |of: fn(&Self) -> Option<f64>| points.windows(2).all(|two| of(&two[0]) == of(&two[1]));
        if points.is_empty()
            || !is_constant(|point| point.temperature)
            || !is_constant(|point| point.normal_force)
        {
            return Ok(());
        }
        let spread = |of: fn(&Self) -> f64| {
            let values = points.iter().map(of);
            values.clone().fold(0.0, f64::max) / values.fold(f64::INFINITY, f64::min)
        };
        let [friction, speed] = [
            spread(|point| point.friction_coefficient),
            spread(|point| point.velocity),
        ];
        let allowed = "at most three times that of the speeds, because the friction of a linear material changes at most in proportion \
                       to the speed (are the columns of speed and friction exchanged?)";
        let holds = friction <= 3.0 * speed;
        in_range(
            "largest over smallest friction coefficient",
            friction,
            holds,
            allowed,
        )?;
        Ok(())
    }
}

/// Distribution of the errors of points, whose size is unknown.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
pub enum FrictionNoise {
    /// Standard deviation proportional to the friction.
    #[default]
    Relative,
    /// Equal standard deviation at all points.
    Absolute,
}

/// A free parameter of a model, which is fitted as its logarithm.
#[derive(Debug, Clone, PartialEq)]
pub struct FreeParameter {
    /// Name.
    pub name: String,
    /// SI unit.
    pub unit: &'static str,
    /// Bounds of its logarithm, and largest change of it in one step.
    pub range: ParameterRange,
}

/// Normal prior distribution of the logarithms of the parameters.
#[derive(Debug, Clone, PartialEq)]
pub struct Prior {
    /// Means, in the order of the parameters.
    pub mean: Vec<f64>,
    /// Inverse of the covariance, row by row; rows and columns of unknown parameters are 0.
    pub precision: Vec<f64>,
    /// Rank of the precision matrix: the number of known parameters.
    pub rank: usize,
}

/// Modelled friction of one point.
#[derive(Debug, Clone, PartialEq)]
pub struct ModelledPoint {
    /// Friction coefficient.
    pub friction_coefficient: f64,
    /// Derivatives of its logarithm by the logarithms of the parameters.
    pub slopes: Vec<f64>,
}

/// A model of friction with free parameters.
pub trait FrictionModel {
    /// Friction of all points at the logarithms of the parameters; `None` if the model has no solution there.
    fn friction(&self, parameters: &[f64]) -> Option<Vec<ModelledPoint>>;
}
