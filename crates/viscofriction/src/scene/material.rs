//! `[material.…]`: the half space.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The half space; every kind may have a Poisson ratio.
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum MaterialTable {
    /// A dashpot.
    Viscous(Viscous),
    /// A spring.
    Elastic(Elastic),
    /// Spring and dashpot in parallel.
    KelvinVoigt(SpringAndDashpot),
    /// Spring and dashpot in series.
    Maxwell(SpringAndDashpot),
    /// A spring in parallel with a Maxwell element.
    StandardSolid(StandardSolid),
    /// Spring, dashpot and Maxwell branches in parallel.
    Prony(Prony),
}

/// A dashpot.
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Viscous {
    /// Shear viscosity η > 0, [Pa s].
    pub viscosity: f64,
    /// Poisson ratio, −1 < ν ≤ 1/2.
    #[serde(default = "incompressible")]
    pub poisson_ratio: f64,
}

/// A spring.
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Elastic {
    /// Shear modulus G > 0, \[Pa].
    pub shear_modulus: f64,
    /// Poisson ratio, −1 < ν ≤ 1/2.
    #[serde(default = "incompressible")]
    pub poisson_ratio: f64,
}

/// A spring and a dashpot.
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SpringAndDashpot {
    /// Shear modulus G > 0, \[Pa].
    pub shear_modulus: f64,
    /// Shear viscosity η > 0, [Pa s].
    pub viscosity: f64,
    /// Poisson ratio, −1 < ν ≤ 1/2.
    #[serde(default = "incompressible")]
    pub poisson_ratio: f64,
}

/// A spring in parallel with a Maxwell element.
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StandardSolid {
    /// Shear modulus of the spring > 0, \[Pa].
    pub equilibrium_modulus: f64,
    /// Shear modulus of the Maxwell element > 0, \[Pa].
    pub maxwell_modulus: f64,
    /// Viscosity of the Maxwell element > 0, [Pa s].
    pub viscosity: f64,
    /// Poisson ratio, −1 < ν ≤ 1/2.
    #[serde(default = "incompressible")]
    pub poisson_ratio: f64,
}

/// Spring, dashpot and Maxwell branches in parallel.
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Prony {
    /// Shear modulus of the lone spring ≥ 0, \[Pa].
    pub equilibrium_modulus: f64,
    /// Viscosity of the lone dashpot ≥ 0, [Pa s].
    #[serde(default)]
    pub viscosity: f64,
    /// Maxwell branches.
    pub branches: Vec<Branch>,
    /// Poisson ratio, −1 < ν ≤ 1/2.
    #[serde(default = "incompressible")]
    pub poisson_ratio: f64,
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
    pub const fn key(&self) -> &'static str {
        match self {
            Self::Viscous(_) => "material.viscous",
            Self::Elastic(_) => "material.elastic",
            Self::KelvinVoigt(_) => "material.kelvin-voigt",
            Self::Maxwell(_) => "material.maxwell",
            Self::StandardSolid(_) => "material.standard-solid",
            Self::Prony(_) => "material.prony",
        }
    }

    /// Poisson ratio ν.
    #[must_use]
    pub const fn poisson_ratio(&self) -> f64 {
        match self {
            Self::Viscous(Viscous { poisson_ratio, .. })
            | Self::Elastic(Elastic { poisson_ratio, .. })
            | Self::KelvinVoigt(SpringAndDashpot { poisson_ratio, .. })
            | Self::Maxwell(SpringAndDashpot { poisson_ratio, .. })
            | Self::StandardSolid(StandardSolid { poisson_ratio, .. })
            | Self::Prony(Prony { poisson_ratio, .. }) => *poisson_ratio,
        }
    }
}
