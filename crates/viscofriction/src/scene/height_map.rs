//! `[indenter.height-map]`: a grid of heights with its units and conventions.

use std::path::{Path, PathBuf};

use indenters::topography::{LateralUnit, Topography, TopographyError};
use numerics::{MessageNumber, positive, whole_part};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::SceneError;
use super::indenter::Edges;
use super::schema::check_ranges;
use super::source::problem_of;

/// A surface from a grid of heights: bilinear between them, or periodic, the sum of waves through them.
///
/// Heights point out of the rigid body, so that summits touch first. A row, of a text a line, runs along x, the direction in
/// which the body moves over the elastomer; y grows from row to row, in the order of the file. The same holds for every format.
#[derive(Debug, Clone, PartialEq, Deserialize, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub struct HeightMapTable {
    /// File in the folder of the scene: a text of one line of heights for each y, without names; with the extension npy an array of
    /// NumPy of the shape (n_y, n_x), float64 or float32; with the extensions asc, gsf, sdf, sur, x3p and xyz a measured surface.
    pub file: PathBuf,
    /// Distances of neighbouring heights along x and y, > 0, \[m]; not of a measured surface, which has its own, nor of a text
    /// that states its size.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub spacing: Option<[f64; 2]>,
    /// Unit of the heights; files that state it (gsf, sdf, sur, x3p, heads of texts) keep their own; without it metres.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub unit: Option<LengthUnit>,
    /// Unit of x and y in files that have positions and do not state it (xyz, asc, gsf); without it metres, or in xyz `unit`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub lateral_unit: Option<LengthUnit>,
    /// What the heights are.
    #[serde(default)]
    pub heights_are: HeightsAre,
    /// Direction in which the body moves, degrees from x towards y, 0, 90, 180 or 270. Results have x along the motion.
    #[serde(default)]
    pub direction: f64,
    /// True to fill heights that were not measured with the mean of their known neighbours, from the edges of holes inwards.
    #[serde(default)]
    pub fill_missing: bool,
    /// True to subtract the least-squares plane, after `fill_missing`.
    #[serde(default)]
    pub level: bool,
    /// What is beyond the grid.
    #[serde(default)]
    pub edges: Edges,
    /// Wavelength > 0 below which waves are left out of a periodic surface, \[m]; without it all waves of the grid are kept.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shortest_wavelength: Option<f64>,
}

/// What the heights of a map are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize, Serialize, JsonSchema)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
#[serde(rename_all = "kebab-case")]
pub enum HeightsAre {
    /// Heights of the surface, out of the rigid body: the largest touch first.
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
    /// Length of the unit, \[m].
    const fn metres(self) -> f64 {
        match self {
            Self::M => 1.0,
            Self::Mm => 1e-3,
            Self::Um => 1e-6,
            Self::Nm => 1e-9,
        }
    }
}

/// Reads the table from keys and values; errors have no line numbers.
impl TryFrom<toml::Table> for HeightMapTable {
    type Error = SceneError;

    fn try_from(table: toml::Table) -> Result<Self, SceneError> {
        serde_path_to_error::deserialize(table).map_err(|error| {
            let key = format!("indenter.height-map.{}", error.path());
            SceneError::at(key, problem_of(error.inner()))
        })
    }
}

/// Message for an error in a file of heights, with the line if it is known.
pub fn in_file(file: &Path, error: &TopographyError) -> String {
    let file = file.display();
    match error {
        TopographyError::Line { line, problem } => format!("{file}:{line}: {problem}"),
        other => format!("{file}: {other}"),
    }
}

impl HeightMapTable {
    /// Reads the surface from the contents of its file, without conversion; it may take `memory` \[bytes] in addition to them.
    ///
    /// # Errors
    /// [`SceneError`] with the place in the file, or for a spacing that is missing or superfluous.
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

    /// Converts the surface to metres, with heights out of the body and x along the motion. Fills holes and removes the tilt if
    /// requested.
    ///
    /// # Errors
    /// [`SceneError`] for a direction or spacing out of range, missing heights (at most half can be filled), heights beyond
    /// 1e30 m, and a flat map.
    pub fn prepared(&self, surface: Topography) -> Result<Topography, SceneError> {
        if self.edges == Edges::Wall && self.shortest_wavelength.is_some() {
            let problem = "needs edges = \"periodic\" or \"mirrored\", because a map with a wall has no waves; leave it out, or give edges";
            let key = "indenter.height-map.shortest_wavelength";
            return Err(SceneError::at(key, problem));
        }
        check_ranges("indenter.height-map", self)?;
        // Convert to metres, and reject implausible sizes.
        let mut surface = self.in_metres(surface)?;
        positive("indenter.height-map.spacing[0]", surface.spacing[0])?;
        positive("indenter.height-map.spacing[1]", surface.spacing[1])?;
        self.check_sizes(&surface)?;
        surface.notes.extend(marker_note(&surface.heights));
        // Fill holes, remove the tilt, and rotate x into the direction of motion.
        let mut surface = self.without_holes(surface)?;
        let sizes = surface.heights.iter().map(|height| height.abs());
        let largest = sizes.fold(0.0, f64::max);
        if self.level {
            surface = surface.levelled();
        }
        self.check_relief(&surface, largest)?;
        Ok(surface.turned(whole_part(self.direction / 90.0)))
    }

    /// Converts to metres; units in the file take precedence over those of the table.
    fn in_metres(&self, surface: Topography) -> Result<Topography, SceneError> {
        if self.spacing.is_some() && self.lateral_unit.is_some() {
            let problem =
                "the spacing is in m; this is the unit of x and y in files that have positions";
            return Err(SceneError::at("indenter.height-map.lateral_unit", problem));
        }
        let unit = self.unit.filter(|_| !surface.states_unit);
        let lateral = match surface.lateral_unit {
            LateralUnit::Stated => None,
            LateralUnit::Unstated => self.lateral_unit,
            LateralUnit::AsHeights => self.lateral_unit.or(unit),
        };
        let factor = match self.heights_are {
            HeightsAre::Surface => unit.map_or(1.0, LengthUnit::metres),
            HeightsAre::Gap => -unit.map_or(1.0, LengthUnit::metres),
        };
        let metres = lateral.map_or(1.0, LengthUnit::metres);
        let mut scaled = surface.scaled(factor);
        scaled.spacing = scaled.spacing.map(|spacing| spacing * metres);
        Ok(scaled)
    }

    /// Rejects heights beyond [`MAX_HEIGHT`], which are probably markers of missing heights.
    fn check_sizes(&self, surface: &Topography) -> Result<(), SceneError> {
        let columns = surface.shape[1];
        let mut heights = surface.heights.iter();
        let Some(index) = heights.position(|height| height.abs() > MAX_HEIGHT) else {
            return Ok(());
        };
        let (row, column) = (index / columns + 1, index % columns + 1);
        Err(self.in_file(&format!(
            "the height in row {row}, column {column} is {:e} m, where at most {MAX_HEIGHT:e} m is allowed; if it marks a \
             missing height, write nan",
            surface.heights[index]
        )))
    }

    /// Fills missing heights if the table requests it; an error if it does not, or if more than half of the heights are
    /// missing.
    fn without_holes(&self, surface: Topography) -> Result<Topography, SceneError> {
        let (points, missing) = (surface.heights.len(), surface.missing());
        if missing == 0 {
            return Ok(surface);
        }
        let advice = if !self.fill_missing {
            "fill_missing makes each the mean of its known neighbours"
        } else if 2 * missing > points {
            "more than a half is not filled, because most of the map would be made up; cut out a part with fewer holes"
        } else {
            return Ok(surface.filled());
        };
        let problem = format!("{missing} of {points} heights are missing; {advice}");
        Err(SceneError::at("indenter.height-map.fill_missing", problem))
    }

    /// Rejects a flat map; `largest` is its largest absolute height \[m] before the tilt was removed.
    fn check_relief(&self, surface: &Topography, largest: f64) -> Result<(), SceneError> {
        let heights = surface.heights.iter().copied();
        let [lowest, highest] =
            [f64::min, f64::max].map(|pick| heights.clone().fold(f64::NAN, pick));
        // A single row or column is rejected later, by the constructor of the body.
        if highest - lowest > MAX_FLAT_RANGE * largest || surface.shape.contains(&1) {
            return Ok(());
        }
        let problem = if self.level {
            "the map is flat: without its mean slope all heights are the same".to_owned()
        } else {
            format!(
                "the map is flat: all heights are {} m",
                MessageNumber(lowest)
            )
        };
        Err(self.in_file(&format!(
            "{problem}; a body with a flat end is a flat-punch"
        )))
    }

    /// An error at the key of the file of heights, with the name of the file.
    fn in_file(&self, problem: &str) -> SceneError {
        let file = self.file.display();
        SceneError::at("indenter.height-map.file", format!("{file}: {problem}"))
    }
}

/// Largest absolute height, \[m] (chosen: beyond any length, and its square is far from overflow).
const MAX_HEIGHT: f64 = 1e30;
/// Range of heights over the largest absolute height, up to which a map counts as flat (chosen, above the rounding of a removed
/// tilt).
const MAX_FLAT_RANGE: f64 = 1e-12;
/// Distance of a height from all others, over the range of these, above which it is reported as a possible marker of missing
/// heights. Chosen: a real peak is not 20 times as far from all heights as these are from each other.
const MIN_MARKER_DISTANCE: f64 = 20.0;

/// A note if the lowest or highest height is far from all others, as if it marked missing heights (-9999, 1e10); `None`
/// otherwise.
fn marker_note(heights: &[f64]) -> Option<String> {
    let known = || heights.iter().copied().filter(|height| !height.is_nan());
    let [lowest, highest] = [f64::min, f64::max].map(|pick| known().fold(f64::NAN, pick));
    [lowest, highest].into_iter().find_map(|end| {
        let others = || known().filter(|height| height.to_bits() != end.to_bits());
        let [from, to] = [f64::min, f64::max].map(|pick| others().fold(f64::NAN, pick));
        let distance = (from - end).abs().min((to - end).abs());
        // With two distinct heights there is no range to compare with.
        let is_far = to > from && distance > MIN_MARKER_DISTANCE * (to - from);
        let count = known().count() - others().count();
        is_far.then(|| {
            format!(
                "{count} heights are {end:e} m, and all others from {from:.3e} m to {to:.3e} m: if that marks missing heights, write nan"
            )
        })
    })
}
