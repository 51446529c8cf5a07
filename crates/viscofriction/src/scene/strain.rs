//! `[strain.…]`: factors of the moduli of a filled rubber over the strain amplitude.

use std::path::PathBuf;

use rheology::{KrausModel, RheologyError, StrainDependence};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use strum::IntoStaticStr;

use super::SceneError;
use super::files::strain_dependence;
use super::schema::check_ranges;
use crate::files::Files;

/// Factors f and g of storage and loss modulus over the amplitude of the equivalent strain, which is that of a tensile test and 1/√3 of a
/// shear: the moduli are those at the strain of the contact (equivalent-linear).
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize, JsonSchema, IntoStaticStr)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
#[strum(serialize_all = "kebab-case")]
pub enum Strain {
    /// The form of Kraus (1984), f = r + (1 − r)/(1 + x²) and g = 1 + 2 (p − 1) x/(1 + x²) with x = (ε/ε_c)^m.
    Kraus {
        /// Strain ε_c > 0 of the largest loss modulus.
        critical_strain: f64,
        /// Exponent m > 0; without it 0.6, that of carbon black.
        #[serde(default = "default_exponent")]
        exponent: f64,
        /// Storage modulus at large strains over that at small ones, 0 < r ≤ 1.
        storage_ratio: f64,
        /// Largest loss modulus over that at small strains, p ≥ 1; without it 1.
        #[serde(default = "default_peak")]
        loss_peak_ratio: f64,
    },
    /// A measured strain sweep, interpolated on logarithmic scales; beyond its last strain the factors stay as they are, with a warning.
    Table {
        /// A CSV file in the folder of the scene: strain with storage_factor and loss_factor, or a strain sweep as instruments export it.
        file: PathBuf,
        /// What the strains of the file are; without it what the names of its moduli say.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        deformation: Option<StrainDeformation>,
        /// Whether strains are half the distance from peak to peak, or the whole.
        #[serde(default)]
        amplitude: StrainAmplitude,
    },
}

/// Deformation of a strain sweep.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum StrainDeformation {
    /// Tension or compression, whose strain is the equivalent one.
    Tension,
    /// Shear γ, whose equivalent strain is γ/√3.
    Shear,
}

/// Meaning of the strains of a sweep.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum StrainAmplitude {
    /// Half of the distance from peak to peak.
    #[default]
    Single,
    /// The distance from peak to peak.
    Double,
}

/// Exponent of carbon black in the form of Kraus.
const fn default_exponent() -> f64 {
    0.6
}

/// Ratio of a loss modulus without a peak.
const fn default_peak() -> f64 {
    1.0
}

impl Strain {
    /// Path of the table.
    fn key(&self) -> String {
        let name: &str = self.into();
        format!("strain.{name}")
    }

    /// Checks every number against its range.
    ///
    /// # Errors
    /// [`SceneError`] for the first number out of range.
    pub fn check(&self) -> Result<(), SceneError> {
        check_ranges("strain", self)?;
        let Self::Kraus {
            critical_strain,
            exponent,
            storage_ratio,
            loss_peak_ratio,
        } = *self
        else {
            return Ok(());
        };
        let model = KrausModel {
            critical_strain,
            exponent,
            storage_ratio,
            loss_peak_ratio,
        };
        let refused = |error: RheologyError| SceneError::at(self.key(), error.to_string());
        StrainDependence::kraus(model).map(drop).map_err(refused)
    }

    /// The factors over the strain, checked; reads the file of a table.
    pub(crate) fn law(&self, files: &Files<'_>) -> Result<StrainDependence, SceneError> {
        self.check()?;
        match self {
            Self::Kraus {
                critical_strain,
                exponent,
                storage_ratio,
                loss_peak_ratio,
            } => {
                let model = KrausModel {
                    critical_strain: *critical_strain,
                    exponent: *exponent,
                    storage_ratio: *storage_ratio,
                    loss_peak_ratio: *loss_peak_ratio,
                };
                let refused = |error: RheologyError| SceneError::at(self.key(), error.to_string());
                StrainDependence::kraus(model).map_err(refused)
            }
            Self::Table {
                file,
                deformation,
                amplitude,
            } => files.read_table("strain.table.file", file, |file, contents| {
                strain_dependence(file, contents, *deformation, *amplitude)
            }),
        }
    }
}
