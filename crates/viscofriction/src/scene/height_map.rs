//! `[indenter.height-map]`: a grid of heights, and how they are meant.

use std::path::{Path, PathBuf};

use indenters::topography::{Topography, TopographyError};
use numerics::{in_range, positive, whole_part};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::SceneError;
use super::indenter::Edges;
use super::source::problem_of;

/// A surface from a grid of heights: bilinear between them, or periodic, the sum of waves through them.
///
/// Heights point out of the rigid body, so that summits touch first. A row, of a text a line, runs along x, the direction in
/// which the body moves over the elastomer; y grows from row to row, in the order of the file. The same holds for every format.
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub struct HeightMapTable {
    /// File beside the scene file: a text of one line of heights for each y, without names; with the extension npy an array of
    /// NumPy of the shape (n_y, n_x), float64 or float32; with the extensions asc, gsf, sur, x3p and xyz a measured surface.
    pub file: PathBuf,
    /// Distances of neighbouring heights along x and y, > 0, \[m]; not of a measured surface, which has its own.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub spacing: Option<[f64; 2]>,
    /// Unit of the heights, metres unless given; files that state it (gsf, sur, x3p) keep their own.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub unit: Option<LengthUnit>,
    /// What the heights are.
    #[serde(default)]
    pub heights_are: HeightsAre,
    /// Direction in which the body moves, from x towards y: 0, 90, 180 or 270 degrees. Results have x along the motion.
    #[serde(default)]
    pub direction: f64,
    /// Fill heights that were not measured with the mean of their known neighbours, from the edges of holes inwards.
    #[serde(default)]
    pub fill_missing: bool,
    /// Take the plane of least squares out.
    #[serde(default)]
    pub level: bool,
    /// What is beyond the grid.
    #[serde(default)]
    pub edges: Edges,
    /// Waves shorter than this are left out of a periodic surface, \[m]; without it none that the grid knows.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shortest_wavelength: Option<f64>,
}

/// What the heights of a map are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize, Serialize, JsonSchema)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
#[serde(rename_all = "kebab-case")]
pub enum HeightsAre {
    /// Those of the surface, out of the rigid body: the largest touch first.
    #[default]
    Surface,
    /// The gap between the surface and a plane that it touches, into the body: the smallest touch first.
    Gap,
}

/// A unit of length.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize, Serialize, JsonSchema)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
#[serde(rename_all = "lowercase")]
pub enum LengthUnit {
    /// Metre.
    M,
    /// Millimetre.
    Mm,
    /// Micrometre.
    #[serde(alias = "µm", alias = "μm")]
    Um,
    /// Nanometre.
    Nm,
}

impl LengthUnit {
    const fn metres(self) -> f64 {
        match self {
            Self::M => 1.0,
            Self::Mm => 1e-3,
            Self::Um => 1e-6,
            Self::Nm => 1e-9,
        }
    }
}

/// The table that keys and values describe, without the lines of a text.
impl TryFrom<toml::Table> for HeightMapTable {
    type Error = SceneError;

    fn try_from(table: toml::Table) -> Result<Self, SceneError> {
        serde_path_to_error::deserialize(table).map_err(|error| {
            let key = format!("indenter.height-map.{}", error.path());
            SceneError::at(key, problem_of(error.inner()))
        })
    }
}

/// What is wrong with a file of heights, with its place.
pub fn in_file(file: &Path, error: &TopographyError) -> String {
    let file = file.display();
    match error {
        TopographyError::Line { line, problem } => format!("{file}:{line}: {problem}"),
        other => format!("{file}: {other}"),
    }
}

impl HeightMapTable {
    /// The surface as the file holds it, of which these are the contents; beside them it takes at most so much `memory` \[bytes].
    ///
    /// # Errors
    /// [`SceneError`] with the place in the file, or for a spacing that is missing or not needed.
    pub fn read(
        &self,
        file: &Path,
        contents: &[u8],
        memory: u64,
    ) -> Result<Topography, SceneError> {
        let extension = file.extension().unwrap_or_default().to_string_lossy();
        let found = Topography::read(&extension, contents, self.spacing, memory);
        found.map_err(|error| {
            if let TopographyError::Spacing { problem } = error {
                return SceneError::at("indenter.height-map.spacing", problem);
            }
            SceneError::at("indenter.height-map.file", in_file(file, &error))
        })
    }

    /// The surface with its heights in metres out of the body, x along the motion, and holes and tilt treated as is asked.
    ///
    /// # Errors
    /// [`SceneError`] for a direction or a spacing out of range, and for heights that are missing.
    pub fn prepared(&self, surface: Topography) -> Result<Topography, SceneError> {
        if self.edges == Edges::Wall && self.shortest_wavelength.is_some() {
            let problem = "needs edges = \"periodic\" or \"mirrored\", because a map with a wall has no waves; leave it out, or give edges";
            let key = "indenter.height-map.shortest_wavelength";
            return Err(SceneError::at(key, problem));
        }
        let key = "indenter.height-map.direction";
        let quarters = self.direction / 90.0;
        let is_known = [0.0, 1.0, 2.0, 3.0].contains(&quarters);
        in_range(key, self.direction, is_known, "0, 90, 180 or 270")?;
        positive("indenter.height-map.spacing[0]", surface.spacing[0])?;
        positive("indenter.height-map.spacing[1]", surface.spacing[1])?;
        let unit = self.unit.filter(|_| !surface.states_unit);
        let factor = match self.heights_are {
            HeightsAre::Surface => unit.map_or(1.0, LengthUnit::metres),
            HeightsAre::Gap => -unit.map_or(1.0, LengthUnit::metres),
        };
        let surface = surface.scaled(factor);
        let (points, missing) = (surface.heights.len(), surface.missing());
        let surface = match missing {
            0 => surface,
            _ if self.fill_missing && missing < points => surface.filled(),
            _ => {
                let problem = format!(
                    "{missing} of {points} heights are missing; fill_missing makes each the mean of its known neighbours"
                );
                return Err(SceneError::at("indenter.height-map.fill_missing", problem));
            }
        };
        let surface = if self.level {
            surface.levelled()
        } else {
            surface
        };
        Ok(surface.turned(whole_part(quarters)))
    }
}
