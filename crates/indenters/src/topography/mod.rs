//! Topographies: measured heights from files and arrays.
//!
//! Heights point out of the body, so that summits touch first. A row runs along x, the direction of motion, and y grows from
//! row to row in the order of the file. Heights that were not measured are NaN until they are filled.

#[cfg(feature = "topography")]
mod asc;
#[cfg(feature = "topography")]
mod binary;
mod format;
mod grid;
mod header;
mod matrix;
mod memory;
mod numpy;
#[cfg(feature = "topography")]
mod sdf;
mod text;
mod units;
#[cfg(feature = "topography")]
mod x3p;
#[cfg(feature = "topography")]
mod xyz;

use format::Format;
use memory::Memory;
use thiserror::Error;

use crate::{HeightMap, IndenterError};
pub use units::length;
#[cfg(feature = "topography")]
use units::metres;

/// List of the supported formats, and advice for others.
const FORMATS: &str = "the formats that are read are asc (Esri's ASCII grid), gsf (Gwyddion Simple Field), npy (NumPy), sdf \
    (ISO 25178-71), sur (Digital Surf), x3p (ISO 25178-72), xyz (x, y and z in each line) and texts of one line of heights for \
    each y; in Python vf.HeightMap.from_topography(SurfaceTopography.read_topography(FILE)) takes those of many instruments, as \
    Zygo dat, Keyence vk4, NT-MDT mdt and Bruker spm, and numpy.save(\"map.npy\", heights) any array";

/// The reason for which a file is refused as a surface.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum TopographyError {
    /// The contents are not of the format.
    #[error("{format} is needed, but there is {found}")]
    Format {
        /// Expected format.
        format: &'static str,
        /// Actual contents, and their place.
        found: String,
    },
    /// The contents are in none of the supported formats.
    #[error("{found}; {FORMATS}")]
    Unknown {
        /// Actual contents.
        found: String,
    },
    /// The heights do not fit into the memory that is allowed.
    #[error("{points} heights need {needed} bytes of memory to be read, and {allowed} are allowed")]
    Memory {
        /// Largest possible number of heights.
        points: u64,
        /// Memory for the heights, \[bytes].
        needed: u64,
        /// Memory limit, \[bytes].
        allowed: u64,
    },
    /// A line is no row of heights.
    #[error("line {line}: {problem}")]
    Line {
        /// Line number, which counts from 1.
        line: usize,
        /// What is needed and what was found.
        problem: String,
    },
    /// The contents are no array of two dimensions with supported numbers.
    #[error("{problem}")]
    Array {
        /// What is needed and what was found.
        problem: String,
    },
    /// The spacing is missing, or given for a file that states its own.
    #[error("spacing: {problem}")]
    Spacing {
        /// What is needed.
        problem: String,
    },
    /// Some heights were not measured.
    #[error(
        "{missing} of {points} heights are missing: fill them, or cut out a part without holes"
    )]
    Missing {
        /// Number of missing heights.
        missing: usize,
        /// Number of all heights.
        points: usize,
    },
    /// The heights are refused as a height map.
    #[error(transparent)]
    Surface(#[from] IndenterError),
}

/// A measured surface: heights on a grid with equally spaced points.
#[derive(Debug, Clone, PartialEq)]
pub struct Topography {
    /// Numbers of rows, one for each y, and of columns, one for each x.
    pub shape: [usize; 2],
    /// Distances of neighbouring points along x and y, \[m].
    pub spacing: [f64; 2],
    /// Heights out of the body row by row, \[m]; NaN where they are missing.
    pub heights: Vec<f64>,
    /// Whether the file states the unit of its heights.
    pub states_unit: bool,
    /// Unit of the spacing.
    pub lateral_unit: LateralUnit,
    /// Number of heights that [`filled`](Self::filled) has filled.
    pub n_filled: usize,
    /// Notes on what the reader assumed: units stated in the header, skipped lines.
    pub notes: Vec<String>,
}

/// Source of the unit of the spacing.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum LateralUnit {
    /// Given in metres, or stated by the file.
    #[default]
    Stated,
    /// Not stated by the file: metres by default.
    Unstated,
    /// Not stated by a file with columns of x, y and heights: that of the heights by default.
    AsHeights,
}

impl Topography {
    /// Reads the surface in the contents of a file.
    ///
    /// The format follows from the signature of the contents, or else from the extension. The reader uses at most `memory`
    /// \[bytes] in addition to the contents.
    ///
    /// With the feature `topography`, files with their own spacing are read: asc (Esri's ASCII grid), gsf (Gwyddion Simple
    /// Field), sdf (ISO 25178-71), sur (Digital Surf), x3p (ISO 25178-72) and xyz (rows of x, y and z). All others need the
    /// `spacing` along x and y \[m]. A file npy is an array of NumPy of the shape (n_y, n_x), in which NaN is a missing height.
    ///
    /// Everything else is a text with one line of heights per y. Its cells are separated by commas, semicolons, tabs or
    /// blanks. A comma is a decimal mark if the separator is not a comma. An empty cell, `nan`, `NA` or `--` is a missing
    /// height. Lines above the rows are skipped with a note; units and a size that they state are used.
    ///
    /// # Errors
    /// - [`TopographyError::Unknown`] and [`TopographyError::Format`] for contents of no supported format;
    /// - [`TopographyError::Line`] for a line of a text that is longer or shorter than the others or has a cell that is no
    ///   number, and for a text that is no grid of heights;
    /// - [`TopographyError::Array`] for an unsupported array;
    /// - [`TopographyError::Memory`] if the heights do not fit into the memory;
    /// - [`TopographyError::Spacing`] if the spacing is missing, superfluous, or differs from that of the file.
    pub fn read(
        extension: &str,
        contents: &[u8],
        spacing: Option<[f64; 2]>,
        memory: u64,
    ) -> Result<Self, TopographyError> {
        let memory = Memory(memory);
        let format = Format::of(&extension.to_ascii_lowercase(), contents);
        match format.map_err(|found| TopographyError::Unknown { found })? {
            Format::Text => matrix::read(contents, spacing, memory),
            Format::Npy => {
                let spacing = spacing.ok_or_else(TopographyError::without_spacing)?;
                let found = numpy::read(contents, spacing, memory);
                found.map_err(|unread| match unread {
                    ReadFailure::Other(problem) => TopographyError::Array { problem },
                    ReadFailure::Known(error) => error,
                })
            }
            _ if spacing.is_some() => {
                let problem = "a measured surface has its own; leave this out".to_owned();
                Err(TopographyError::Spacing { problem })
            }
            format => read_measured(format, contents, memory),
        }
    }

    /// The surface with heights row by row, whose unit is not stated.
    pub const fn of_rows(shape: [usize; 2], spacing: [f64; 2], heights: Vec<f64>) -> Self {
        Self {
            shape,
            spacing,
            heights,
            states_unit: false,
            lateral_unit: LateralUnit::Stated,
            n_filled: 0,
            notes: Vec::new(),
        }
    }

    /// The surface with its heights multiplied by a factor; −1 for heights that point into the body.
    #[must_use]
    pub fn scaled(mut self, factor: f64) -> Self {
        self.heights.iter_mut().for_each(|height| *height *= factor);
        self
    }

    /// The surface for another direction of motion, a number of `quarters` of a turn from x towards y.
    ///
    /// The new direction of motion becomes x.
    #[must_use]
    pub fn turned(mut self, quarters: usize) -> Self {
        for _ in 0..quarters % 4 {
            let [rows, columns] = self.shape;
            // The first row is the last column: y is the new x, and −x the new y.
            let from = |index: usize| index % rows * columns + (columns - 1 - index / rows);
            let places = 0..self.heights.len();
            self.heights = places.map(|index| self.heights[from(index)]).collect();
            self.shape.reverse();
            self.spacing.reverse();
        }
        self
    }

    /// Periods along x and y of a periodic map, \[m].
    pub fn periods(&self) -> [f64; 2] {
        let [rows, columns] = self.shape;
        [
            columns as f64 * self.spacing[0],
            rows as f64 * self.spacing[1],
        ]
    }

    /// Number of heights that the file marks as missing.
    pub fn missing(&self) -> usize {
        self.heights.iter().filter(|height| height.is_nan()).count()
    }

    /// The surface with its holes filled from their edges inwards by the mean of the known ones of four neighbours.
    #[must_use]
    pub fn filled(mut self) -> Self {
        let columns = self.shape[1];
        self.n_filled += self.missing();
        loop {
            // Give each missing height that has a known neighbour the mean of its known neighbours.
            let before = self.heights.clone();
            for index in (0..before.len()).filter(|index| before[*index].is_nan()) {
                let column = index % columns;
                let neighbours = [
                    index.checked_sub(columns),
                    Some(index + columns),
                    (column > 0).then(|| index - 1),
                    (column + 1 < columns).then_some(index + 1),
                ];
                let known = neighbours
                    .into_iter()
                    .flatten()
                    .filter_map(|at| before.get(at));
                let known: Vec<f64> = known.copied().filter(|height| !height.is_nan()).collect();
                if !known.is_empty() {
                    self.heights[index] = known.iter().sum::<f64>() / known.len() as f64;
                }
            }
            // End when a round has filled no missing height.
            let missing = |heights: &[f64]| heights.iter().filter(|height| height.is_nan()).count();
            if missing(&self.heights) == missing(&before) {
                return self;
            }
        }
    }

    /// Slopes along x and y of the least-squares plane; no height may be missing.
    pub fn tilt(&self) -> [f64; 2] {
        [0, 1].map(|axis| {
            let mut sums = [0.0; 2];
            for (index, height) in self.heights.iter().enumerate() {
                let at = self.place(index)[axis];
                sums = [sums[0] + at * height, sums[1] + at * at];
            }
            // A single line of points has no slope across it.
            if sums[1] > 0.0 {
                sums[0] / sums[1] / self.spacing[axis]
            } else {
                0.0
            }
        })
    }

    /// Coordinates of a point along x and y from the middle, in units of the spacing.
    fn place(&self, index: usize) -> [f64; 2] {
        let [rows, columns] = self.shape;
        [(index % columns, columns), (index / columns, rows)]
            .map(|(place, count)| place as f64 - 0.5 * (count as f64 - 1.0))
    }

    /// The surface without its least-squares plane; no height may be missing.
    #[must_use]
    pub fn levelled(mut self) -> Self {
        let tilt = self.tilt();
        for index in 0..self.heights.len() {
            let at = self.place(index);
            for axis in [0, 1] {
                self.heights[index] -= tilt[axis] * at[axis] * self.spacing[axis];
            }
        }
        self
    }

    /// The rigid body with this surface, whose highest points touch first.
    ///
    /// # Errors
    /// [`TopographyError::Missing`] if heights are missing; the errors of [`HeightMap::from_heights`].
    pub fn body(&self) -> Result<HeightMap, TopographyError> {
        let points = self.heights.len();
        let missing = self.missing();
        if missing > 0 {
            return Err(TopographyError::Missing { missing, points });
        }
        Ok(HeightMap::from_heights(
            self.shape,
            self.spacing,
            &self.heights,
        )?)
    }
}

/// Reads a file of a measuring instrument, or a list of points.
#[cfg(feature = "topography")]
fn read_measured(
    format: Format,
    contents: &[u8],
    memory: Memory,
) -> Result<Topography, TopographyError> {
    let (found, format) = match format {
        Format::Asc => return asc::read(contents, memory),
        Format::Gsf => (
            binary::simple_field(contents, memory),
            "a Gwyddion Simple Field 1.0",
        ),
        Format::Sdf => (
            sdf::read(contents, memory),
            "a surface of ISO 25178-71 that is not compressed",
        ),
        Format::Sur => (
            binary::digital_surf(contents, memory),
            "a surface of Digital Surf that is not compressed",
        ),
        Format::X3p => (
            x3p::read(contents, memory),
            "a surface of ISO 25178-72 with equally spaced points",
        ),
        _ => return xyz::read(contents, memory),
    };
    found.map_err(|unread| match unread {
        ReadFailure::Other(found) => TopographyError::Format { format, found },
        ReadFailure::Known(error) => error,
    })
}

/// Refuses a file of a measuring instrument, whose readers are not compiled without the feature `topography`.
#[cfg(not(feature = "topography"))]
fn read_measured(format: Format, _: &[u8], _: Memory) -> Result<Topography, TopographyError> {
    let found = format!("a file in the format {format:?}");
    let format = "the feature `topography` of the crate `indenters`";
    Err(TopographyError::Format { format, found })
}

impl TopographyError {
    /// The error for a file that does not state its spacing, if none is given.
    fn without_spacing() -> Self {
        let problem = "the distances of neighbouring heights along x and y are needed".to_owned();
        Self::Spacing { problem }
    }
}

/// The reason for which a reader refuses the contents.
enum ReadFailure {
    /// The contents are not in the format: description of what was found.
    Other(String),
    /// An error with its own variant.
    Known(TopographyError),
}

impl From<String> for ReadFailure {
    fn from(found: String) -> Self {
        Self::Other(found)
    }
}

impl From<TopographyError> for ReadFailure {
    fn from(error: TopographyError) -> Self {
        Self::Known(error)
    }
}
