//! The parameters of a model behind measured friction, with intervals that hold.
//!
//! ```text
//! μ_i = μ(v_i, T_i, F_i; θ) + noise
//! ```
//! for any model μ that knows its derivatives by the logarithms of its parameters θ.

mod fit;
mod read;

use numerics::least_squares::Range;
use numerics::{InvalidParameter, in_range, positive};

pub use fit::{FrictionFit, FrictionFitting, FrictionMinimum};
pub use read::friction_points;

/// A measured friction coefficient.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct FrictionPoint {
    /// Sliding or rolling speed v > 0, \[m/s].
    pub velocity: f64,
    /// Friction coefficient μ > 0: the force along the surface over the normal force.
    pub friction_coefficient: f64,
    /// Its standard error, where it is known.
    pub standard_error: Option<f64>,
    /// Temperature of the elastomer, \[°C].
    pub temperature: Option<f64>,
    /// Normal force, \[N], where it is not the same at all points.
    pub normal_force: Option<f64>,
}

impl FrictionPoint {
    /// Refuses numbers that are not greater than 0, and standard errors of some points only.
    ///
    /// # Errors
    /// [`InvalidParameter`] with the first of them.
    pub fn check_all(points: &[Self]) -> Result<(), InvalidParameter> {
        for point in points {
            positive("velocity", point.velocity)?;
            positive("friction coefficient", point.friction_coefficient)?;
            let others = [
                ("standard error", point.standard_error),
                ("normal force", point.normal_force),
            ];
            for (name, value) in others {
                value.map_or(Ok(1.0), |value| positive(name, value))?;
            }
        }
        let known = points.iter().filter(|point| point.standard_error.is_some());
        let known = known.count();
        let holds = known == 0 || known == points.len();
        let allowed = "0 or the number of points";
        in_range("number of standard errors", known as f64, holds, allowed)?;
        Ok(())
    }
}

/// How the errors of points are distributed whose size is not known.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
pub enum FrictionNoise {
    /// In proportion to the friction.
    #[default]
    Relative,
    /// The same at all points.
    Absolute,
}

/// A parameter of a model, which is sought as its logarithm.
#[derive(Debug, Clone, PartialEq)]
pub struct FreeParameter {
    /// Name.
    pub name: String,
    /// SI unit.
    pub unit: &'static str,
    /// Bounds of its logarithm, and how far that goes in one step.
    pub range: Range,
    /// What is known of its logarithm beforehand.
    pub prior: Option<Prior>,
}

/// A normal distribution.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Prior {
    /// Mean.
    pub mean: f64,
    /// Standard deviation, greater than 0.
    pub deviation: f64,
}

/// What a model says of one point.
#[derive(Debug, Clone, PartialEq)]
pub struct ModelledPoint {
    /// Friction coefficient.
    pub friction_coefficient: f64,
    /// Derivatives of its logarithm by those of the parameters.
    pub slopes: Vec<f64>,
}

/// Friction over parameters.
pub trait FrictionModel {
    /// All points at the logarithms of the parameters; none where the model has no friction there.
    fn friction(&self, parameters: &[f64]) -> Option<Vec<ModelledPoint>>;
}
