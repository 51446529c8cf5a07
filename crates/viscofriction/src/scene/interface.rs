//! `[interface.…]`: shear strength of the contact.

use std::path::PathBuf;

use numerics::{MessageNumber, Rounded};
use rheology::{
    BellParameters, DEFAULT_BELL_WIDTH, RheologyError, ShearStrength, ShearStrengthPoint,
};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use strum::IntoStaticStr;

use super::SceneError;
use super::files::shear_strengths;
use super::schema::check_ranges;
use crate::files::Files;

/// Shear strength τ_f of the real contact: its part of the friction coefficient is τ_f times the contact area over the normal force.
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize, JsonSchema, IntoStaticStr)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
#[strum(serialize_all = "kebab-case")]
pub enum Interface {
    /// A shear strength that is the same at every velocity and temperature.
    Constant {
        /// Shear strength > 0, \[Pa].
        shear_strength: f64,
    },
    /// A shear strength that is largest at one velocity, τ_0 exp(−(log₁₀(v a_T/v_0)/w)²) (Lorenz et al. 2015).
    Bell {
        /// Largest shear strength τ_0 > 0, \[Pa].
        shear_strength: f64,
        /// Velocity v_0 > 0 of the largest shear strength at the reference temperature, \[m/s].
        velocity: f64,
        /// Decades w > 0 of velocity over which the shear strength falls to τ_0/e; without it √10.
        #[serde(default = "default_width")]
        width: f64,
        /// Activation energy > 0 of a_T by Arrhenius' law, by default in J/mol, from 1 kJ/mol to 10 MJ/mol; without it the temperature has no
        /// influence.
        #[serde(skip_serializing_if = "Option::is_none")]
        activation_energy: Option<f64>,
        /// Unit of the activation energy.
        #[serde(default)]
        activation_energy_unit: EnergyUnit,
        /// Temperature at which a_T = 1, \[°C]; without it 20.
        #[serde(default = "default_reference")]
        reference_temperature: f64,
    },
    /// Measured shear strengths, interpolated on logarithmic scales and never extrapolated.
    Table {
        /// A table in the folder of the scene, with columns of speed and shear strength, and optionally of temperature and standard error.
        file: PathBuf,
    },
}

/// Unit of an activation energy.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
pub enum EnergyUnit {
    /// Joule per mole.
    #[default]
    #[serde(rename = "J/mol")]
    JoulePerMole,
    /// Kilojoule per mole.
    #[serde(rename = "kJ/mol")]
    KilojoulePerMole,
    /// Electronvolt per bond.
    #[serde(rename = "eV")]
    Electronvolt,
}

/// Smallest and largest activation energy, \[J/mol]. Chosen: less is below the thermal energy RT = 2.4e3 and has almost no influence;
/// polymers have some 1e4 to 1e6.
const ENERGY_RANGE: [f64; 2] = [1e3, 1e7];

impl EnergyUnit {
    /// The unit as in a scene.
    pub(crate) const fn name(self) -> &'static str {
        match self {
            Self::JoulePerMole => "J/mol",
            Self::KilojoulePerMole => "kJ/mol",
            Self::Electronvolt => "eV",
        }
    }

    /// Smallest and largest activation energy in this unit.
    pub(crate) fn energy_range(self) -> [f64; 2] {
        ENERGY_RANGE.map(|bound| bound / self.joule_per_mole())
    }

    /// The unit in \[J/mol].
    pub(crate) const fn joule_per_mole(self) -> f64 {
        match self {
            Self::JoulePerMole => 1.0,
            Self::KilojoulePerMole => 1e3,
            Self::Electronvolt => ELECTRONVOLT,
        }
    }
}

/// One electronvolt per particle, [J/mol]: the product of elementary charge and Avogadro constant, exact in the SI of 2019.
const ELECTRONVOLT: f64 = 96_485.332_123_310_02;

/// Width of a bell without one in the scene, \[decades].
const fn default_width() -> f64 {
    DEFAULT_BELL_WIDTH
}

/// Reference temperature of a bell without one in the scene, \[°C].
const fn default_reference() -> f64 {
    20.0
}

impl Interface {
    /// Path of the table.
    fn key(&self) -> String {
        let name: &str = self.into();
        format!("interface.{name}")
    }

    /// Unit of the activation energy; `None` if the law has none.
    pub(crate) const fn energy_unit(&self) -> Option<EnergyUnit> {
        match self {
            Self::Bell {
                activation_energy_unit,
                ..
            } => Some(*activation_energy_unit),
            _ => None,
        }
    }

    /// Checks every number against its range.
    ///
    /// # Errors
    /// [`SceneError`] for the first number out of range.
    pub fn check(&self) -> Result<(), SceneError> {
        check_ranges("interface", self)?;
        if let Self::Bell {
            activation_energy: Some(energy),
            ..
        } = self
            && let Some(unit) = self.energy_unit()
        {
            let [lowest, highest] = unit.energy_range();
            if !(lowest..=highest).contains(energy) {
                let (given, unit) = (MessageNumber(*energy), unit.name());
                let [lowest, highest] = [lowest, highest].map(Rounded);
                let problem = format!(
                    "it must be from {lowest} to {highest} {unit}, but is {given} {unit}; activation_energy_unit is \"J/mol\", \"kJ/mol\" or \"eV\""
                );
                return Err(SceneError::at("interface.bell.activation_energy", problem));
            }
        }
        Ok(())
    }

    /// The shear strength that the scene gives by numbers, with its activation energy in J/mol.
    ///
    /// # Errors
    /// [`SceneError`] for the first number out of range, and for a shear strength that is read from a file.
    pub fn shear_strength(&self) -> Result<ShearStrength, SceneError> {
        self.check()?;
        let strength = match self {
            Self::Constant { shear_strength } => ShearStrength::constant(*shear_strength),
            Self::Bell {
                shear_strength,
                velocity,
                width,
                activation_energy,
                activation_energy_unit,
                reference_temperature,
            } => {
                let unit = activation_energy_unit.joule_per_mole();
                let parameters = BellParameters {
                    shear_strength: *shear_strength,
                    velocity: *velocity,
                    width: *width,
                    activation_energy: activation_energy.map(|energy| unit * energy),
                    reference_temperature: *reference_temperature,
                };
                ShearStrength::bell(parameters)
            }
            Self::Table { .. } => {
                return Err(SceneError::at(
                    self.key(),
                    "it is read from a file, and not given by numbers",
                ));
            }
        };
        let refused = |error: RheologyError| SceneError::at(self.key(), error.to_string());
        strength.map_err(refused)
    }

    /// The shear strength, checked; reads the file of a table.
    pub(crate) fn law(&self, files: &Files<'_>) -> Result<ShearLaw, SceneError> {
        if let Self::Table { file } = self {
            return files.read_table("interface.table.file", file, shear_strengths);
        }
        self.shear_strength().map(ShearLaw::exact)
    }
}

/// A shear strength, and how well the rows of its table are known.
#[derive(Debug, Clone)]
pub(crate) struct ShearLaw {
    /// The law over velocity and temperature.
    pub(crate) strength: ShearStrength,
    /// Rows of the table with the independent standard errors of their shear strengths, relative to these; none without errors.
    pub(crate) uncertain_rows: Vec<(ShearStrengthPoint, f64)>,
}

impl ShearLaw {
    /// A law without uncertain rows.
    const fn exact(strength: ShearStrength) -> Self {
        Self {
            strength,
            uncertain_rows: Vec::new(),
        }
    }

    /// Relative standard uncertainty of the shear strength at a velocity \[m/s] and a temperature \[°C], from the errors of the rows;
    /// 0 without them.
    pub(crate) fn relative_uncertainty(
        &self,
        velocity: f64,
        temperature: Option<f64>,
    ) -> Result<f64, RheologyError> {
        let own = self.strength.at(velocity, temperature)?;
        let mut points: Vec<ShearStrengthPoint> = self
            .uncertain_rows
            .iter()
            .map(|(point, _)| *point)
            .collect();
        let mut square = 0.0;
        for (index, (point, error)) in self.uncertain_rows.iter().enumerate() {
            // ln τ_f is linear in the logarithms of all rows, so that it changes by the weight of the row when the row doubles.
            points[index].shear_strength = 2.0 * point.shear_strength;
            let doubled = ShearStrength::table(&points)?.at(velocity, temperature)?;
            points[index] = *point;
            square += ((doubled / own).log2() * error).powi(2);
        }
        Ok(square.sqrt())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_of_energies_have_their_names_in_scenes() {
        for unit in [
            EnergyUnit::JoulePerMole,
            EnergyUnit::KilojoulePerMole,
            EnergyUnit::Electronvolt,
        ] {
            let name = serde_json::to_value(unit).expect("a text");
            assert_eq!(name, unit.name(), "{unit:?}");
        }
    }
}
