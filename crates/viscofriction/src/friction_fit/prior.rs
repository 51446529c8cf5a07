//! What is known of the moduli before a fit of friction.

use std::str::FromStr;

use serde::Serialize;

/// What is known of the moduli of a scene's material before the fit.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum FrictionPrior {
    /// The covariance of the moduli that the material has, as `fit-material` writes it; nothing if it has none.
    #[default]
    Covariance,
    /// One relative standard deviation > 0 of all moduli of elements that relax within the valid frequencies of the material.
    Relative(f64),
    /// Nothing.
    None,
}

/// `covariance`, `none` or a number.
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
