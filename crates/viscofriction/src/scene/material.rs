//! `[material.…]`: the viscoelastic material of the half space or layer.

use std::path::PathBuf;

use rheology::{PronyExpansion, RelaxationBranch, RheologyError, Shift};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use strum::{EnumDiscriminants, EnumIter, IntoStaticStr};
use toml::{Table, Value};

use super::schema::check_ranges;
use super::{Covariance, SceneError};

/// Defines the table of a material: each kind with its own keys, and the keys that all kinds have.
macro_rules! materials {
    ($($(#[$sentence:meta])+ $kind:ident { $($keys:tt)* })+) => {
        /// The half space; every kind may have a Poisson ratio.
        #[derive(
            Debug, Clone, PartialEq, Deserialize, Serialize, JsonSchema, IntoStaticStr, EnumDiscriminants,
        )]
        #[serde(rename_all = "kebab-case", deny_unknown_fields)]
        #[strum(serialize_all = "kebab-case")]
        #[strum_discriminants(
            name(MaterialKind),
            derive(EnumIter, IntoStaticStr),
            strum(serialize_all = "kebab-case"),
            doc = "The kinds of materials, for whoever goes through all of them."
        )]
        pub enum MaterialTable {
            $(
                $(#[$sentence])+
                $kind {
                    $($keys)*
                    /// Poisson ratio, −1 < ν ≤ 1/2.
                    #[serde(default = "incompressible")]
                    poisson_ratio: f64,
                    /// Lowest and highest frequency > 0 at which it was measured, \[rad/s].
                    valid_frequencies: Option<[f64; 2]>,
                },
            )+
            /// The material of another file.
            File {
                /// A file in the folder of the scene, with a table `[material.…]`, such as the material.toml of `fit-material`.
                path: PathBuf,
                /// Temperature to which the shift law takes the material, \[°C]; without it that of the file.
                temperature: Option<f64>,
                /// Poisson ratio, −1 < ν ≤ 1/2; without it that of the file.
                poisson_ratio: Option<f64>,
                /// Lowest and highest frequency > 0 at which it was measured, \[rad/s]; without it those of the file.
                valid_frequencies: Option<[f64; 2]>,
            },
        }

        impl MaterialTable {
            /// Poisson ratio ν; `None` for a file whose own ratio is kept.
            pub const fn poisson_ratio(&self) -> Option<f64> {
                match self {
                    $(Self::$kind { poisson_ratio, .. })|+ => Some(*poisson_ratio),
                    Self::File { poisson_ratio, .. } => *poisson_ratio,
                }
            }

            /// Measured range of angular frequencies, \[rad/s]; `None` if this table states none.
            pub const fn valid_frequencies(&self) -> Option<[f64; 2]> {
                match self {
                    $(Self::$kind { valid_frequencies, .. })|+
                    | Self::File { valid_frequencies, .. } => *valid_frequencies,
                }
            }
        }
    };
}

materials! {
    /// A dashpot.
    Viscous {
        /// Shear viscosity η > 0, \[Pa s].
        viscosity: f64,
    }
    /// A spring.
    Elastic {
        /// Shear modulus G > 0, \[Pa].
        shear_modulus: f64,
    }
    /// Spring and dashpot in parallel.
    KelvinVoigt {
        /// Shear modulus G > 0, \[Pa].
        shear_modulus: f64,
        /// Shear viscosity η > 0, \[Pa s].
        viscosity: f64,
    }
    /// Spring and dashpot in series.
    Maxwell {
        /// Shear modulus G > 0, \[Pa].
        shear_modulus: f64,
        /// Shear viscosity η > 0, \[Pa s].
        viscosity: f64,
    }
    /// A spring in parallel with a Maxwell element.
    StandardSolid {
        /// Shear modulus of the spring > 0, \[Pa].
        equilibrium_modulus: f64,
        /// Shear modulus of the Maxwell element > 0, \[Pa].
        maxwell_modulus: f64,
        /// Viscosity of the Maxwell element > 0, \[Pa s].
        viscosity: f64,
    }
    /// Spring, dashpot and Maxwell branches in parallel.
    Prony {
        /// Shear modulus of the lone spring ≥ 0, \[Pa].
        equilibrium_modulus: f64,
        /// Viscosity of the lone dashpot ≥ 0, \[Pa s].
        #[serde(default)]
        viscosity: f64,
        /// Maxwell branches.
        branches: Vec<Branch>,
        /// Change of its times and moduli with temperature, for heat, for shear that depends on the temperature, and for scenes that
        /// name this material as a file.
        shift: Option<Shift>,
        /// Error of a series that approximates another law; all bars contain it.
        approximation: Option<Approximation>,
        /// Uncertainty of its moduli.
        covariance: Option<Covariance>,
    }
    /// Between spring and dashpot: G* = K (iω)^a.
    Springpot {
        /// Coefficient K > 0, \[Pa s^a].
        coefficient: f64,
        /// Exponent a, from 0.01 to 0.99: almost a spring, and almost a dashpot.
        exponent: f64,
        /// Shear modulus ≥ 0 of a spring in parallel, \[Pa].
        #[serde(default)]
        equilibrium_modulus: f64,
        /// Shortest and longest time > 0 for which the material is needed, \[s]: the time of a contact length and those of a
        /// history are within it.
        time_range: [f64; 2],
    }
    /// Spring and springpot in series: G* = G z/(1 + z), z = (iωτ)^a.
    FractionalMaxwell {
        /// Shear modulus G > 0 of the spring in series, \[Pa].
        shear_modulus: f64,
        /// Relaxation time τ > 0, at which spring and springpot have the same modulus |G*|, \[s].
        relaxation_time: f64,
        /// Exponent a, from 0.01 to 0.99.
        exponent: f64,
        /// Shear modulus ≥ 0 of a spring in parallel, \[Pa].
        #[serde(default)]
        equilibrium_modulus: f64,
        /// Shortest and longest time > 0 for which the material is needed, \[s], as of a springpot.
        time_range: [f64; 2],
    }
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

/// Error of a series that approximates another law.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Approximation {
    /// Largest relative error of its moduli, from 0 to 0.1, at the times of `time_range` and at the frequencies 1/t.
    pub relative_error: f64,
    /// Shortest and longest time > 0 for which that holds, \[s], as of a springpot.
    pub time_range: [f64; 2],
}

/// Converts an expansion to an incompressible material with the error of the series.
impl From<&PronyExpansion> for MaterialTable {
    fn from(expansion: &PronyExpansion) -> Self {
        let branches = expansion.spectrum.branches().iter();
        let branch = |one: &RelaxationBranch| Branch {
            modulus: one.modulus,
            relaxation_time: one.relaxation_time,
        };
        Self::Prony {
            equilibrium_modulus: expansion.spectrum.equilibrium_modulus(),
            viscosity: expansion.spectrum.viscosity(),
            branches: branches.map(branch).collect(),
            poisson_ratio: incompressible(),
            valid_frequencies: None,
            shift: None,
            approximation: Some(Approximation {
                relative_error: expansion.relative_error,
                time_range: expansion.time_range,
            }),
            covariance: None,
        }
    }
}

/// Poisson ratio of an incompressible material.
const fn incompressible() -> f64 {
    0.5
}

impl MaterialTable {
    /// Path of the table of the material in the scene, such as `material.prony`.
    pub fn key(&self) -> String {
        let name: &str = self.into();
        format!("material.{name}")
    }

    /// Checks every number against its range.
    ///
    /// # Errors
    /// [`SceneError`] for the first number out of range.
    pub fn check(&self) -> Result<(), SceneError> {
        check_ranges("material", self)
    }

    /// Temperature dependence of times and moduli; `None` if it is not known.
    pub const fn shift(&self) -> Option<&Shift> {
        match self {
            Self::Prony { shift, .. } => shift.as_ref(),
            _ => None,
        }
    }

    /// Covariance of the moduli; `None` if it is not known.
    pub const fn covariance(&self) -> Option<&Covariance> {
        match self {
            Self::Prony { covariance, .. } => covariance.as_ref(),
            _ => None,
        }
    }

    /// Removes the covariance, which does not apply to other moduli.
    #[cfg(feature = "fit")]
    pub(crate) fn without_covariance(mut self) -> Self {
        if let Self::Prony { covariance, .. } = &mut self {
            *covariance = None;
        }
        self
    }

    /// Replaces Poisson ratio and valid frequencies \[rad/s] of a material file by those that the scene gives.
    pub(crate) fn with_given(
        self,
        poisson_ratio: Option<f64>,
        valid_frequencies: Option<[f64; 2]>,
    ) -> Result<Self, SceneError> {
        let wrong = |error: toml::ser::Error| SceneError::at("material", error.to_string());
        let mut material = Value::try_from(&self).map_err(wrong)?;
        let window = valid_frequencies.map(|ends| Value::from(ends.to_vec()));
        let given = [
            ("poisson_ratio", poisson_ratio.map(Value::Float)),
            ("valid_frequencies", window),
        ];
        let kinds = material.as_table_mut().into_iter().flatten();
        for kind in kinds.filter_map(|(_, kind)| kind.as_table_mut()) {
            let keys = given.iter().cloned();
            kind.extend(keys.filter_map(|(key, value)| Some((key.to_owned(), value?))));
        }
        Self::try_from(Table::from_iter([("material".to_owned(), material)]))
    }

    /// The material at another temperature \[°C]: times are multiplied by the shift factor a_T of its law, moduli by b_T. An
    /// error without a shift law, and outside its range.
    pub(crate) fn at(mut self, celsius: f64) -> Result<Self, SceneError> {
        let key = "material.file.temperature";
        let Self::Prony {
            equilibrium_modulus,
            viscosity,
            branches,
            valid_frequencies,
            shift: Some(shift),
            approximation,
            ..
        } = &mut self
        else {
            let problem = "the file has no shift law, as fit-material writes it for isotherms of several temperatures";
            return Err(SceneError::at(key, problem));
        };
        let wrong = |error: RheologyError| SceneError::at(key, error.to_string());
        let factor = 10_f64.powf(shift.log10_factor(celsius).map_err(wrong)?);
        let modulus_factor = shift.modulus_factor(celsius).map_err(wrong)?;
        *equilibrium_modulus *= modulus_factor;
        *viscosity *= modulus_factor * factor;
        for branch in branches {
            branch.modulus *= modulus_factor;
            branch.relaxation_time *= factor;
        }
        for end in valid_frequencies.iter_mut().flatten() {
            *end /= factor;
        }
        if let Some(known) = approximation {
            known.time_range = known.time_range.map(|time| time * factor);
        }
        *shift = shift.with_reference(celsius).map_err(wrong)?;
        Ok(self)
    }
}
