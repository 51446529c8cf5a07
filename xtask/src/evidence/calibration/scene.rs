//! Random scenes of which a reference is known, with numbers that a person would type.

use std::path::Path;

use anyhow::Result;
use serde::Serialize;
use strum::IntoEnumIterator as _;
use toml::Value;
use viscofriction::scene::{self, Indenter, IndenterKind, MaterialKind, MaterialTable};

use crate::evidence::request::presses;
use crate::evidence::sample::{Motion, Range, sample};
use crate::random::Random;
use viscofriction::solve::Problem;

pub(super) struct Scene {
    pub(super) label: Label,
    pub(super) file: scene::Scene,
}

/// Its number and its parts, which are inline tables of a scene file.
#[derive(Debug, Clone, Default, Serialize)]
pub(super) struct Label {
    #[serde(rename = "scene")]
    pub(super) number: usize,
    indenter: String,
    material: String,
    load: String,
    solve: String,
}

/// One scene in so many slides from first touch.
const SCENES_PER_FIRST_TOUCH: usize = 6;
/// Most of the others are stationary.
const MOTIONS: [Motion; 5] = {
    let mut motions = [Motion::Stationary; 5];
    motions[0] = Motion::Pressed;
    motions
};

/// Of a flat punch only a closed form is known, and no method slides it.
const LEFT_OUT: [IndenterKind; 3] = [
    IndenterKind::FlatPunch,
    // Of files.
    IndenterKind::Table,
    IndenterKind::HeightMap,
];

/// Stationary or pressed, without files.
fn any(memory: &'static str) -> Range {
    let is_drawn = |kind: &IndenterKind| !LEFT_OUT.contains(kind);
    Range {
        bodies: IndenterKind::iter().filter(is_drawn).collect(),
        materials: MaterialKind::iter()
            .filter(|kind| *kind != MaterialKind::File)
            .collect(),
        motions: &MOTIONS,
        decades: &[3.0],
        speeds: 2.0,
        layers: 0.0,
        depths: 0.3,
        distances: 1.0,
        memory,
    }
}

/// Bodies on a dashpot whose motion from first touch is known.
fn from_first_touch(memory: &'static str) -> Range {
    Range {
        bodies: vec![IndenterKind::Cone, IndenterKind::Paraboloid],
        materials: vec![MaterialKind::Viscous],
        motions: &[Motion::SlidingOverDistance],
        depths: 0.0,
        ..any(memory)
    }
}

impl Scene {
    /// The scene with this number, from the next numbers of the generator.
    pub(super) fn new(number: usize, random: &mut Random, memory: &'static str) -> Result<Self> {
        let range = if number.is_multiple_of(SCENES_PER_FIRST_TOUCH) {
            from_first_touch(memory)
        } else {
            any(memory)
        };
        let mut file = sample(random, &range, Path::new(""))?.scene;
        // Both models and several errors are asked of it.
        (file.solve.model, file.solve.relative_error) = (None, None);
        let label = Label {
            number,
            indenter: inline(&file.indenter)?,
            material: inline(&file.material)?,
            load: inline(&file.load)?,
            solve: inline(&file.solve)?,
        };
        Ok(Self { label, file })
    }

    pub(super) const fn is_cylinder(&self) -> bool {
        matches!(self.file.indenter, Indenter::Cylinder { .. })
    }

    pub(super) const fn is_rough(&self) -> bool {
        matches!(self.file.indenter, Indenter::SelfAffine(_))
    }

    pub(super) const fn is_elastic(&self) -> bool {
        matches!(self.file.material, MaterialTable::Elastic { .. })
    }

    pub(super) const fn is_at_depth(&self) -> bool {
        self.file.load.indentation_depth.is_some()
    }

    pub(super) fn is_stationary(&self) -> bool {
        !presses(&self.file) && self.file.solve.sliding_distance.is_none()
    }

    /// Whether a dashpot carries a part of the load.
    pub(super) fn has_dashpot(&self) -> bool {
        let problem = Problem::try_from(&self.file);
        problem.is_ok_and(|problem| problem.material().relaxation().viscosity() > 0.0)
    }

    /// Whether the equivalent line is infinitely steep somewhere.
    pub(super) fn is_sharp(&self) -> bool {
        let has_cusp = match &self.file.indenter {
            Indenter::Power { exponent, .. } => *exponent < 1.0,
            Indenter::Superposition { terms } => terms.iter().any(|term| term.exponent < 1.0),
            _ => false,
        };
        has_cusp || self.is_flat()
    }

    /// Whether the body ends in a flat.
    pub(super) const fn is_flat(&self) -> bool {
        matches!(
            self.file.indenter,
            Indenter::FlatCone { .. } | Indenter::TruncatedParaboloid { .. }
        )
    }
}

fn inline(part: &impl Serialize) -> Result<String> {
    Ok(Value::try_from(part)?.to_string())
}
