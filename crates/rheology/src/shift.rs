//! Laws for the change of times and moduli with temperature: G*(ω, T) = b_T G*(a_T ω, T_r).

use numerics::{InvalidParameter, in_range, positive};

use crate::{ArrheniusShift, RheologyError, WlfShift};

/// Absolute temperature of 0 °C, \[K].
pub const KELVIN_AT_ZERO_CELSIUS: f64 = 273.15;

/// A law of time–temperature superposition, and where it was found.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "serde", derive(serde::Deserialize, serde::Serialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Shift {
    /// Temperature of the material to which the shift belongs, \[°C].
    pub temperature: f64,
    /// Lowest and highest temperature that was measured, \[°C].
    pub temperature_range: [f64; 2],
    /// The law of a_T about the temperature.
    pub law: ShiftLaw,
    /// What the moduli are multiplied by, b_T; without it they stay as they are.
    #[cfg_attr(
        feature = "serde",
        serde(default, skip_serializing_if = "Option::is_none")
    )]
    pub vertical: Option<VerticalLaw>,
}

/// How moduli change with temperature.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "schemars", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "serde", derive(serde::Deserialize, serde::Serialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum VerticalLaw {
    /// As those of an ideal rubber, with the absolute temperature (Ferry 1980, Viscoelastic Properties of Polymers, ch. 11).
    Entropic,
    /// Pairs of a temperature \[°C], each higher than the one before, and a factor > 0 of the moduli, with ln of the factor straight in
    /// between.
    Table(Vec<[f64; 2]>),
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
    /// Logarithm log₁₀ a_T of the factor of all times at a temperature \[°C].
    ///
    /// # Errors
    /// [`RheologyError::OutsideShiftLaw`] outside the range of temperatures; [`RheologyError::InvalidParameter`] for constants
    /// that are not greater than 0.
    pub fn log10_factor(&self, temperature: f64) -> Result<f64, RheologyError> {
        self.check_range(temperature)?;
        let kelvin = |celsius: f64| celsius + KELVIN_AT_ZERO_CELSIUS;
        match self.law {
            ShiftLaw::Wlf([c1, c2]) => {
                WlfShift::new(c1, c2, self.temperature)?.log10_factor(temperature)
            }
            ShiftLaw::Arrhenius(energy) => ArrheniusShift::new(energy, kelvin(self.temperature))?
                .log10_factor(kelvin(temperature)),
        }
    }

    /// Factor b_T of all moduli at a temperature \[°C].
    ///
    /// # Errors
    /// [`RheologyError::OutsideShiftLaw`] outside the range of temperatures or of the table;
    /// [`RheologyError::InvalidParameter`] for a temperature that is not above absolute zero, and for an unordered table.
    pub fn modulus_factor(&self, temperature: f64) -> Result<f64, RheologyError> {
        self.check_range(temperature)?;
        match &self.vertical {
            None => Ok(1.0),
            Some(VerticalLaw::Entropic) => {
                let kelvin =
                    |celsius: f64| positive("temperature", celsius + KELVIN_AT_ZERO_CELSIUS);
                Ok(kelvin(temperature)? / kelvin(self.temperature)?)
            }
            Some(VerticalLaw::Table(table)) => {
                check_table(table)?;
                let log = |temperature| interpolate_log_factor(table, temperature);
                Ok((log(temperature)? - log(self.temperature)?).exp())
            }
        }
    }

    /// The law with another reference temperature \[°C].
    ///
    /// # Errors
    /// The errors of [`Self::log10_factor`].
    pub fn with_reference(&self, temperature: f64) -> Result<Self, RheologyError> {
        self.log10_factor(temperature)?;
        let law = match self.law {
            ShiftLaw::Wlf([c1, c2]) => {
                let law = WlfShift::new(c1, c2, self.temperature)?.with_reference(temperature)?;
                ShiftLaw::Wlf(law.constants())
            }
            ShiftLaw::Arrhenius(_) => self.law,
        };
        Ok(Self {
            temperature,
            law,
            ..self.clone()
        })
    }

    /// Refuses a temperature \[°C] outside the measured range of the law.
    fn check_range(&self, temperature: f64) -> Result<(), RheologyError> {
        check_within(temperature, self.temperature_range)
    }
}

/// Refuses a temperature outside a range, \[°C].
fn check_within(temperature: f64, [lowest, highest]: [f64; 2]) -> Result<(), RheologyError> {
    if (lowest..=highest).contains(&temperature) {
        return Ok(());
    }
    Err(RheologyError::OutsideShiftLaw {
        temperature,
        lowest,
        highest,
    })
}

/// Refuses a table that is empty or not ordered, or whose factors are not positive.
fn check_table(table: &[[f64; 2]]) -> Result<(), InvalidParameter> {
    for (index, [temperature, factor]) in table.iter().enumerate() {
        positive("shift.vertical.table factor", *factor)?;
        let is_next = index == 0 || *temperature > table[index - 1][0];
        let allowed = "finite and higher than the one before";
        in_range(
            "shift.vertical.table temperature",
            *temperature,
            temperature.is_finite() && is_next,
            allowed,
        )?;
    }
    in_range(
        "shift.vertical.table length",
        table.len() as f64,
        !table.is_empty(),
        "at least 1",
    )
    .map(drop)
}

/// ln of the modulus factor at a temperature \[°C], straight between the rows of a table that is ordered and not empty; refuses a
/// temperature outside the table.
fn interpolate_log_factor(table: &[[f64; 2]], temperature: f64) -> Result<f64, RheologyError> {
    check_within(temperature, [table[0][0], table[table.len() - 1][0]])?;
    let next = table.partition_point(|entry| entry[0] < temperature);
    let [above, above_factor] = table[next];
    let log = above_factor.ln();
    Ok(next.checked_sub(1).map_or(log, |below| {
        let [below, below_factor] = table[below];
        let part = (temperature - below) / (above - below);
        below_factor.ln() + part * (log - below_factor.ln())
    }))
}
