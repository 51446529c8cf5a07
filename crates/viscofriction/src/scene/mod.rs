//! The scene file: indenter, material, load and request, as a user writes them.
//!
//! Enums are externally tagged, because only then an error knows its line and key.

mod covariance;
mod error;
mod files;
mod heat;
mod height_map;
mod history;
mod indenter;
mod interface;
mod load;
mod material;
mod motion;
mod place;
mod revolution;
mod schema;
mod solve;
mod source;
mod strain;

use std::collections::BTreeMap;
use std::path::Path;
use std::str::FromStr;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub use covariance::Covariance;
pub use error::SceneError;
pub use files::{profile, spectrum};
pub use heat::{Counterface, Heat};
pub use height_map::{HeightMapTable, HeightsAre, LengthUnit, in_file};
pub(crate) use indenter::FEWEST_REALISATIONS;
pub use indenter::{
    Edges, Indenter, IndenterKind, SelfAffineSurface, SpectrumConvention, SpectrumSurface, Term,
};
pub use indenters::Control;
pub(crate) use interface::ShearLaw;
pub use interface::{EnergyUnit, Interface};
pub use load::{Load, LoadPoint, MotionPoint, StrokeShape};
pub use material::{Approximation, Branch, MaterialKind, MaterialTable};
pub use numerics::Accuracy;
pub use revolution::Revolution;
pub use rheology::{Shift, ShiftLaw, VerticalLaw};
pub use schema::{Key, Kind, json_schema, keys, kinds, number, resolved, schema, units};
pub use solve::{Method, Model, Solve};
pub use source::Source;
pub(crate) use source::{PATH_KEYS, quoted, scene_file, split_index, value_at};
pub use strain::{Strain, StrainAmplitude, StrainDeformation};

use crate::text::WrongInput;

/// How thick the elastomer is.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Layer {
    /// Thickness > 0, \[m].
    pub thickness: f64,
}

/// A rigid body on an elastomer, and what is asked about it.
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Scene {
    /// The rigid body.
    pub indenter: Indenter,
    /// The elastomer.
    pub material: MaterialTable,
    /// A layer bonded to a rigid base; without it a half space.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub layer: Option<Layer>,
    /// Shear strength of the contact; without it only the hysteresis of the bulk is computed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub interface: Option<Interface>,
    /// Heat of sliding; without it the elastomer has the same temperature everywhere.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub heat: Option<Heat>,
    /// Factors of the moduli over the strain; without it the moduli are those of small strains.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub strain: Option<Strain>,
    /// How the body is pressed and moved.
    pub load: Load,
    /// What is asked, and how well.
    #[serde(default)]
    pub solve: Solve,
    /// Relative standard uncertainties from 0 to 1 of numbers of the scene, by their paths in quotes such as "load.normal_force"; those of
    /// "material.file.temperature" and "heat.ambient_temperature" in K.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub uncertainty: BTreeMap<String, f64>,
}

impl Scene {
    /// A body on the half space, solved to the default relative error.
    pub fn new(indenter: Indenter, material: MaterialTable, load: Load) -> Self {
        Self {
            indenter,
            material,
            layer: None,
            interface: None,
            heat: None,
            strain: None,
            load,
            solve: Solve::default(),
            uncertainty: BTreeMap::new(),
        }
    }
}

/// Parses a scene file in TOML; [`Problem`](crate::Problem) validates its numbers.
impl FromStr for Scene {
    type Err = WrongInput;

    fn from_str(text: &str) -> Result<Self, WrongInput> {
        let source = Source::new(Path::new("scene"), text.as_bytes().to_vec())?;
        scene_file(source.table()?).map_err(|error| source.locate(&error))
    }
}

/// Reads a scene from keys and values; errors have no line numbers.
impl TryFrom<toml::Table> for Scene {
    type Error = SceneError;

    fn try_from(table: toml::Table) -> Result<Self, SceneError> {
        scene_file(table)
    }
}
