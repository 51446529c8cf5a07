//! Prior of the moduli in a fit of friction.

use std::str::FromStr;

use serde::Serialize;

/// Prior of the moduli of a scene's material.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum FrictionPrior {
    /// The covariance in the material table, as `fit-material` writes it; no prior if there is none.
    #[default]
    Covariance,
    /// A relative standard deviation > 0 for all moduli of elements that relax within the valid frequencies of the material.
    Relative(f64),
    /// No prior.
    None,
}

/// Parses `covariance`, `none` or a relative standard deviation.
impl FromStr for FrictionPrior {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        match text {
            "covariance" => Ok(Self::Covariance),
            "none" => Ok(Self::None),
            number => number.parse().map(Self::Relative).map_err(|_| {
                format!(
                    "prior must be covariance, none, or a relative standard deviation greater than 0, but is {text:?}"
                )
            }),
        }
    }
}
