//! Thermal properties of the elastomer.

use numerics::{InvalidParameter, positive};

/// Thermal conductivity and diffusivity of the elastomer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HeatConductor {
    /// Conductivity k, \[W/(m K)].
    conductivity: f64,
    /// Diffusivity D, \[m²/s].
    diffusivity: f64,
}

/// Density and specific heat capacity, whose product is the heat capacity per volume.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HeatCapacity {
    /// Density ρ > 0, \[kg/m³].
    pub density: f64,
    /// Specific heat capacity c > 0, \[J/(kg K)].
    pub specific_heat: f64,
}

impl HeatConductor {
    /// An elastomer of the conductivity k > 0 \[W/(m K)] and the diffusivity D > 0 \[m²/s].
    ///
    /// # Errors
    /// [`InvalidParameter`] for a number that is not finite and greater than 0.
    pub fn new(conductivity: f64, diffusivity: f64) -> Result<Self, InvalidParameter> {
        Ok(Self {
            conductivity: positive("conductivity", conductivity)?,
            diffusivity: positive("diffusivity", diffusivity)?,
        })
    }

    /// An elastomer of the conductivity k > 0 \[W/(m K)] and a heat capacity, with the diffusivity D = k/(ρc).
    ///
    /// # Errors
    /// [`InvalidParameter`] for a number that is not finite and greater than 0.
    pub fn with_capacity(
        conductivity: f64,
        capacity: HeatCapacity,
    ) -> Result<Self, InvalidParameter> {
        let density = positive("density", capacity.density)?;
        let specific_heat = positive("specific heat", capacity.specific_heat)?;
        Self::new(conductivity, conductivity / density / specific_heat)
    }

    /// Conductivity k, \[W/(m K)].
    pub const fn conductivity(&self) -> f64 {
        self.conductivity
    }

    /// Diffusivity D, \[m²/s].
    pub const fn diffusivity(&self) -> f64 {
        self.diffusivity
    }
}
