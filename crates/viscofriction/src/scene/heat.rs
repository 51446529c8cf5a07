//! `[heat]`: temperature of the contact.

use bem_halfspace::heat::{self, HeatCapacity, HeatConductor};
use numerics::InvalidParameter;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::SceneError;
use super::schema::check_ranges;

/// Heat of sliding: the temperature of the contact is computed, and material and shear strength are those at this temperature.
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Heat {
    /// Thermal conductivity k of the elastomer > 0, \[W/m/K].
    pub conductivity: f64,
    /// Thermal diffusivity k/(ρc) of the elastomer > 0, \[m²/s]; without it density and heat_capacity are given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub diffusivity: Option<f64>,
    /// Density ρ of the elastomer > 0, \[kg/m³].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub density: Option<f64>,
    /// Specific heat capacity c of the elastomer > 0, \[J/kg/K].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub heat_capacity: Option<f64>,
    /// Temperature of the elastomer far from the contact, \[°C]; without it that of the material.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ambient_temperature: Option<f64>,
    /// What the body does with the heat of the interface.
    #[serde(default)]
    pub counterface: Counterface,
    /// Time > 0 for which a periodic surface has been sliding, \[s]; its mean temperature grows with the root of it. Other bodies reach
    /// a stationary temperature and need none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub duration: Option<f64>,
}

/// What the body does with the heat of the interface; the heat of the bulk stays in the elastomer.
#[derive(Debug, Clone, Copy, Default, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Counterface {
    /// It takes no heat.
    #[default]
    Insulating,
    /// It takes all heat of the interface.
    Conducting,
    /// It takes this share of the heat of the interface, from 0 to 1.
    Share(f64),
}

impl Heat {
    /// Checks every number against its range, and that either the diffusivity or density and heat capacity are given.
    ///
    /// # Errors
    /// [`SceneError`] for the first number that is missing, out of range, or given twice.
    pub fn check(&self) -> Result<(), SceneError> {
        check_ranges("heat", self)?;
        self.conductor().map(drop)
    }

    /// The elastomer as a conductor of heat.
    pub(crate) fn conductor(&self) -> Result<HeatConductor, SceneError> {
        let wrong = |error: InvalidParameter| SceneError::at("heat", error.to_string());
        match (self.diffusivity, self.density, self.heat_capacity) {
            (Some(diffusivity), None, None) => {
                HeatConductor::new(self.conductivity, diffusivity).map_err(wrong)
            }
            (None, Some(density), Some(specific_heat)) => {
                let capacity = HeatCapacity {
                    density,
                    specific_heat,
                };
                HeatConductor::with_capacity(self.conductivity, capacity).map_err(wrong)
            }
            (Some(_), _, _) => {
                let problem = "the diffusivity follows from conductivity, density and heat_capacity; give either it or the other two";
                Err(SceneError::at("heat.diffusivity", problem))
            }
            (None, None, None) => {
                let problem = "how fast heat spreads is not known: give diffusivity [m²/s], or density [kg/m³] and heat_capacity [J/kg/K]";
                Err(SceneError::at("heat", problem))
            }
            (None, None, Some(_)) => {
                let problem = "beside heat_capacity the density is needed, or the diffusivity in the place of both";
                Err(SceneError::at("heat.heat_capacity", problem))
            }
            (None, Some(_), None) => {
                let problem = "beside density the heat_capacity is needed, or the diffusivity in the place of both";
                Err(SceneError::at("heat.density", problem))
            }
        }
    }
}

/// Converts to the counterface of the surface temperature, which counts the share of the elastomer.
impl From<Counterface> for heat::Counterface {
    fn from(counterface: Counterface) -> Self {
        match counterface {
            Counterface::Insulating => Self::Insulating,
            Counterface::Conducting => Self::Conducting,
            Counterface::Share(share) => Self::ElastomerShare(1.0 - share),
        }
    }
}
