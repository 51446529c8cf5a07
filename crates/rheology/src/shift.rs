//! How the times of a material change with its temperature.

use crate::{ArrheniusShift, RheologyError, WlfShift};

/// What is to be added to °C for K.
pub const KELVIN_AT_ZERO_CELSIUS: f64 = 273.15;

/// A law of time–temperature superposition, and where it was found.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "serde", derive(serde::Deserialize, serde::Serialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Shift {
    /// Temperature of the material beside which it stands, \[°C].
    pub temperature: f64,
    /// Lowest and highest temperature that was measured, \[°C].
    pub temperature_range: [f64; 2],
    /// The law about the temperature.
    pub law: ShiftLaw,
}

/// How times change with temperature.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "serde", derive(serde::Deserialize, serde::Serialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum ShiftLaw {
    /// C₁ and C₂ \[K] of Williams, Landel and Ferry, both greater than 0.
    Wlf([f64; 2]),
    /// Activation energy of Arrhenius' law greater than 0, [J/mol].
    Arrhenius(f64),
}

impl Shift {
    /// log₁₀ of the factor of all times from the temperature of the material to another one \[°C].
    ///
    /// # Errors
    /// [`RheologyError::OutsideShiftLaw`] outside of the range of temperatures, [`RheologyError::InvalidParameter`] for constants
    /// that are not greater than 0.
    pub fn log10_factor(&self, temperature: f64) -> Result<f64, RheologyError> {
        let [lowest, highest] = self.temperature_range;
        if !(lowest..=highest).contains(&temperature) {
            return Err(RheologyError::OutsideShiftLaw {
                temperature,
                lowest,
                highest,
            });
        }
        let kelvin = |celsius: f64| celsius + KELVIN_AT_ZERO_CELSIUS;
        match self.law {
            ShiftLaw::Wlf([c1, c2]) => {
                WlfShift::new(c1, c2, self.temperature)?.log10_factor(temperature)
            }
            ShiftLaw::Arrhenius(energy) => ArrheniusShift::new(energy, kelvin(self.temperature))?
                .log10_factor(kelvin(temperature)),
        }
    }

    /// The same law beside the material of another temperature \[°C].
    ///
    /// # Errors
    /// As for [`Self::log10_factor`].
    pub fn about(&self, temperature: f64) -> Result<Self, RheologyError> {
        self.log10_factor(temperature)?;
        let law = match self.law {
            ShiftLaw::Wlf([c1, c2]) => {
                let law = WlfShift::new(c1, c2, self.temperature)?.about(temperature)?;
                ShiftLaw::Wlf(law.constants())
            }
            ShiftLaw::Arrhenius(_) => self.law,
        };
        Ok(Self {
            temperature,
            law,
            ..*self
        })
    }
}
