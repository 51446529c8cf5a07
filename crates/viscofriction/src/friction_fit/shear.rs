//! Shear strength of the contact as a function of the parameters of a fit.
//!
//! ```text
//! ln τ_f = ln τ_0 − u²,    u = (log₁₀(v/v_0) + log₁₀ a_T)/w,    log₁₀ a_T ∝ ε
//! ∂ ln τ_f/∂ ln τ_0 = 1,  ∂ ln τ_f/∂ ln v_0 = 2u/(w ln 10),  ∂ ln τ_f/∂ ln w = 2u²,  ∂ ln τ_f/∂ ln ε = −2u log₁₀ a_T/w
//! ```
//!
//! Theory: docs/theory/shear.md.

use std::f64::consts::LN_10;

use rheology::{ArrheniusShift, KELVIN_AT_ZERO_CELSIUS, RheologyError, ShearStrength};

use super::family::{ACTIVATION_ENERGY, PEAK_VELOCITY, WIDTH};
use crate::files::Files;
use crate::scene::{Interface, SceneError};
use crate::solve::sensitivity::Number;

/// A law of the shear strength, with the keys of its free parameters.
pub(super) struct Shear {
    interface: Interface,
    law: ShearStrength,
    free: Vec<String>,
}

/// The shear strength at a measured point.
#[derive(Debug, Default)]
pub(super) struct Strength {
    /// Shear strength τ_f, \[Pa]; 0 without an interface.
    pub(super) value: f64,
    /// Derivatives of ln τ_f by the logarithms of the free parameters of the interface.
    pub(super) slopes: Vec<f64>,
}

impl Shear {
    /// The law of an interface, whose `free` numbers are sought.
    pub(super) fn new(
        interface: Interface,
        free: &[Number],
        files: &Files<'_>,
    ) -> Result<Self, SceneError> {
        let key = |number: &Number| number.ends()[1].to_owned();
        Ok(Self {
            law: interface.law(files)?.strength,
            interface,
            free: free.iter().map(key).collect(),
        })
    }

    /// True if the shear strength depends on the temperature.
    pub(super) const fn depends_on_temperature(&self) -> bool {
        self.law.depends_on_temperature()
    }

    /// The shear strength at a velocity \[m/s] and a temperature \[°C].
    pub(super) fn at(
        &self,
        velocity: f64,
        temperature: Option<f64>,
    ) -> Result<Strength, SceneError> {
        let strength = || {
            let slope = |key: &String| self.slope(key, velocity, temperature);
            Ok::<_, RheologyError>(Strength {
                value: self.law.at(velocity, temperature)?,
                slopes: self.free.iter().map(slope).collect::<Result<_, _>>()?,
            })
        };
        strength().map_err(|error| SceneError::at("interface", error.to_string()))
    }

    /// Derivative of ln τ_f by the logarithm of a number of the interface.
    fn slope(
        &self,
        key: &str,
        velocity: f64,
        temperature: Option<f64>,
    ) -> Result<f64, RheologyError> {
        let Interface::Bell {
            velocity: peak,
            width,
            activation_energy,
            activation_energy_unit,
            reference_temperature,
            ..
        } = self.interface
        else {
            return Ok(1.0);
        };
        let log_shift = match activation_energy {
            None => 0.0,
            Some(energy) => {
                let energy = activation_energy_unit.joule_per_mole() * energy;
                let kelvin = |celsius: f64| celsius + KELVIN_AT_ZERO_CELSIUS;
                let law = ArrheniusShift::new(energy, kelvin(reference_temperature))?;
                law.log10_factor(kelvin(temperature.unwrap_or(f64::NAN)))?
            }
        };
        let u = ((velocity / peak).log10() + log_shift) / width;
        Ok(match key {
            PEAK_VELOCITY => 2.0 * u / (width * LN_10),
            WIDTH => 2.0 * u * u,
            ACTIVATION_ENERGY => -2.0 * u * log_shift / width,
            _ => 1.0,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::EnergyUnit;

    /// ln τ_f at 3 mm/s and 35 °C.
    fn log_strength(numbers: [f64; 4]) -> f64 {
        let [shear_strength, velocity, width, energy] = numbers;
        let parameters = rheology::BellParameters {
            shear_strength,
            velocity,
            width,
            activation_energy: Some(96_485.332_123_310_02 * energy),
            reference_temperature: 20.0,
        };
        let law = ShearStrength::bell(parameters).expect("a law");
        law.at(3e-3, Some(35.0)).expect("a strength").ln()
    }

    #[test]
    fn derivatives_are_those_of_the_law() {
        let numbers = [5e6, 1e-4, 2.5, 0.9];
        let [shear_strength, velocity, width, energy] = numbers;
        let interface = Interface::Bell {
            shear_strength,
            velocity,
            width,
            activation_energy: Some(energy),
            activation_energy_unit: EnergyUnit::Electronvolt,
            reference_temperature: 20.0,
        };
        let keys = ["shear_strength", PEAK_VELOCITY, WIDTH, ACTIVATION_ENERGY];
        let shear = Shear {
            law: ShearStrength::constant(1.0).expect("a law"),
            free: keys.map(str::to_owned).to_vec(),
            interface,
        };
        let found = shear.at(3e-3, Some(35.0)).expect("a strength").slopes;
        for (k, found) in found.into_iter().enumerate() {
            let moved = |factor: f64| {
                let mut numbers = numbers;
                numbers[k] *= factor;
                log_strength(numbers)
            };
            let step: f64 = 1e-5;
            let expected = (moved(step.exp()) - moved((-step).exp())) / (2.0 * step);
            let error = (found - expected).abs();
            assert!(error < 1e-8, "{}: {found}, expected {expected}", keys[k]);
        }
    }
}
