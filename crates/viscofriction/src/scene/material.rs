//! `[material.…]`: the half space.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use strum::IntoStaticStr;

/// The half space; every kind may have a Poisson ratio.
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize, JsonSchema, IntoStaticStr)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
#[strum(serialize_all = "kebab-case")]
pub enum MaterialTable {
    /// A dashpot.
    Viscous {
        /// Shear viscosity η > 0, [Pa s].
        viscosity: f64,
        /// Poisson ratio, −1 < ν ≤ 1/2.
        #[serde(default = "incompressible")]
        poisson_ratio: f64,
    },
    /// A spring.
    Elastic {
        /// Shear modulus G > 0, \[Pa].
        shear_modulus: f64,
        /// Poisson ratio, −1 < ν ≤ 1/2.
        #[serde(default = "incompressible")]
        poisson_ratio: f64,
    },
    /// Spring and dashpot in parallel.
    KelvinVoigt {
        /// Shear modulus G > 0, \[Pa].
        shear_modulus: f64,
        /// Shear viscosity η > 0, [Pa s].
        viscosity: f64,
        /// Poisson ratio, −1 < ν ≤ 1/2.
        #[serde(default = "incompressible")]
        poisson_ratio: f64,
    },
    /// Spring and dashpot in series.
    Maxwell {
        /// Shear modulus G > 0, \[Pa].
        shear_modulus: f64,
        /// Shear viscosity η > 0, [Pa s].
        viscosity: f64,
        /// Poisson ratio, −1 < ν ≤ 1/2.
        #[serde(default = "incompressible")]
        poisson_ratio: f64,
    },
    /// A spring in parallel with a Maxwell element.
    StandardSolid {
        /// Shear modulus of the spring > 0, \[Pa].
        equilibrium_modulus: f64,
        /// Shear modulus of the Maxwell element > 0, \[Pa].
        maxwell_modulus: f64,
        /// Viscosity of the Maxwell element > 0, [Pa s].
        viscosity: f64,
        /// Poisson ratio, −1 < ν ≤ 1/2.
        #[serde(default = "incompressible")]
        poisson_ratio: f64,
    },
    /// Spring, dashpot and Maxwell branches in parallel.
    Prony {
        /// Shear modulus of the lone spring ≥ 0, \[Pa].
        equilibrium_modulus: f64,
        /// Viscosity of the lone dashpot ≥ 0, [Pa s].
        #[serde(default)]
        viscosity: f64,
        /// Maxwell branches.
        branches: Vec<Branch>,
        /// Poisson ratio, −1 < ν ≤ 1/2.
        #[serde(default = "incompressible")]
        poisson_ratio: f64,
    },
}

/// A Maxwell branch.
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Branch {
    /// Shear modulus ≥ 0, \[Pa].
    pub modulus: f64,
    /// Relaxation time > 0, \[s].
    pub relaxation_time: f64,
}

const fn incompressible() -> f64 {
    0.5
}

impl MaterialTable {
    /// The key of the table.
    #[must_use]
    pub fn key(&self) -> String {
        let name: &str = self.into();
        format!("material.{name}")
    }

    /// Poisson ratio ν.
    #[must_use]
    pub const fn poisson_ratio(&self) -> f64 {
        match self {
            Self::Viscous { poisson_ratio, .. }
            | Self::Elastic { poisson_ratio, .. }
            | Self::KelvinVoigt { poisson_ratio, .. }
            | Self::Maxwell { poisson_ratio, .. }
            | Self::StandardSolid { poisson_ratio, .. }
            | Self::Prony { poisson_ratio, .. } => *poisson_ratio,
        }
    }
}
