//! Surfaces from the heights that files and arrays hold.
//!
//! One convention holds for all of them: heights point out of the body, so that summits touch first; a row runs along x, the
//! direction of motion; and y grows from row to row, in the order of the file. Heights that were not measured are NaN until
//! they are filled.

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

/// The formats that are read, and the ways for others.
const FORMATS: &str = "the formats that are read are asc (Esri's ASCII grid), gsf (Gwyddion Simple Field), npy (NumPy), sdf \
    (ISO 25178-71), sur (Digital Surf), x3p (ISO 25178-72), xyz (x, y and z in each line) and texts of one line of heights for \
    each y; in Python vf.HeightMap.from_topography(SurfaceTopography.read_topography(FILE)) takes those of many instruments, as \
    Zygo dat, Keyence vk4, NT-MDT mdt and Bruker spm, and numpy.save(\"map.npy\", heights) any array";

/// Why a file is no surface.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum TopographyError {
    /// The contents are not of the format.
    #[error("{format} is needed, but there is {found}")]
    Format {
        /// What is needed.
        format: &'static str,
        /// What there is instead, and where.
        found: String,
    },
    /// The contents are of no format that is read.
    #[error("{found}; {FORMATS}")]
    Unknown {
        /// What there is instead.
        found: String,
    },
    /// The heights do not fit into the memory that is allowed.
    #[error("{points} heights need {needed} bytes of memory to be read, and {allowed} are allowed")]
    Memory {
        /// How many there may be.
        points: u64,
        /// What they take, \[bytes].
        needed: u64,
        /// What reading may take, \[bytes].
        allowed: u64,
    },
    /// A line of heights is none.
    #[error("line {line}: {problem}")]
    Line {
        /// Counted from 1.
        line: usize,
        /// What is needed, and what is there.
        problem: String,
    },
    /// The array of heights is none, or one of other numbers.
    #[error("{problem}")]
    Array {
        /// What is needed, and what is there.
        problem: String,
    },
    /// The distances of the points are missing, or there already.
    #[error("spacing: {problem}")]
    Spacing {
        /// What is needed.
        problem: String,
    },
    /// Points were not measured.
    #[error(
        "{missing} of {points} heights are missing: fill them, or cut out a part without holes"
    )]
    Missing {
        /// How many.
        missing: usize,
        /// Of how many.
        points: usize,
    },
    /// The heights are no surface.
    #[error(transparent)]
    Surface(#[from] IndenterError),
}

/// A surface by its heights.
#[derive(Debug, Clone, PartialEq)]
pub struct Topography {
    /// Rows, one for each y, and columns, one for each x.
    pub shape: [usize; 2],
    /// Distances of neighbouring points along x and y, \[m].
    pub spacing: [f64; 2],
    /// Heights out of the body row by row, \[m]; NaN where they are missing.
    pub heights: Vec<f64>,
    /// Whether the file says in which unit its heights are.
    pub states_unit: bool,
    /// Unit of the spacing.
    pub lateral_unit: LateralUnit,
    /// Heights that were filled by [`filled`](Self::filled).
    pub n_filled: usize,
    /// What was assumed when the file was read, in sentences: units of its head, lines that were skipped.
    pub notes: Vec<String>,
}

/// In which unit the distances of the points of a file are.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum LateralUnit {
    /// In metres, as they were given or as the file states.
    #[default]
    Stated,
    /// The file does not state it: metres unless said otherwise.
    Unstated,
    /// The file states no unit, and has x, y and heights in its columns: that of the heights unless said otherwise.
    AsHeights,
}

impl Topography {
    /// The surface in the contents of a file, by their beginning or else by its extension; beside the contents it takes at most
    /// so much `memory` \[bytes].
    ///
    /// With the feature `topography`, asc (Esri's ASCII grid), gsf (Gwyddion Simple Field), sdf (ISO 25178-71), sur (Digital
    /// Surf), x3p (ISO 25178-72) and xyz (rows of x, y and z) have a `spacing` of their own. All others need one, along x and y
    /// \[m]: npy is an array of NumPy of the shape (n_y, n_x), in which NaN is a missing height, and everything else a text of
    /// one line of heights for each y, in which a cell that is empty or says that it is no number (`nan`, `NA`, `--`) is one, and
    /// whose head may state a size. Commas, semicolons, tabs or blanks separate its cells. A comma is a decimal mark where
    /// commas do not separate. Lines above the rows that are no numbers are skipped, with a note; units that they state count.
    ///
    /// # Errors
    /// [`TopographyError::Unknown`] and [`TopographyError::Format`] where the contents are not of such a format;
    /// [`TopographyError::Line`] for a line of a text that is shorter or longer than the others or holds anything else, and for
    /// a text that is no grid of heights; [`TopographyError::Array`] for another array; [`TopographyError::Memory`] before more
    /// is taken; [`TopographyError::Spacing`] where it is missing, there already, or not that of the file.
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
                    Unread::Other(problem) => TopographyError::Array { problem },
                    Unread::Known(error) => error,
                })
            }
            _ if spacing.is_some() => {
                let problem = "a measured surface has its own; leave this out".to_owned();
                Err(TopographyError::Spacing { problem })
            }
            format => measured(format, contents, memory),
        }
    }

    /// From heights row by row, of a file that does not state their unit.
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

    /// With every height times a factor: −1 where the heights given point into the body.
    #[must_use]
    pub fn scaled(mut self, factor: f64) -> Self {
        self.heights.iter_mut().for_each(|height| *height *= factor);
        self
    }

    /// Seen along another direction of motion, so many quarters of a turn from x towards y: that direction becomes x.
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

    /// Lengths along x and y of a map that repeats itself, \[m].
    pub fn periods(&self) -> [f64; 2] {
        let [rows, columns] = self.shape;
        [
            columns as f64 * self.spacing[0],
            rows as f64 * self.spacing[1],
        ]
    }

    /// How many heights are missing.
    pub fn missing(&self) -> usize {
        self.heights.iter().filter(|height| height.is_nan()).count()
    }

    /// With every missing height the mean of its known neighbours, of four, from the edges of holes inwards.
    #[must_use]
    pub fn filled(mut self) -> Self {
        let columns = self.shape[1];
        self.n_filled += self.missing();
        loop {
            let before = self.heights.clone();
            for index in (0..before.len()).filter(|index| before[*index].is_nan()) {
                let column = index % columns;
                let beside = [
                    index.checked_sub(columns),
                    Some(index + columns),
                    (column > 0).then(|| index - 1),
                    (column + 1 < columns).then_some(index + 1),
                ];
                let known = beside.into_iter().flatten().filter_map(|at| before.get(at));
                let known: Vec<f64> = known.copied().filter(|height| !height.is_nan()).collect();
                if !known.is_empty() {
                    self.heights[index] = known.iter().sum::<f64>() / known.len() as f64;
                }
            }
            let missing = |heights: &[f64]| heights.iter().filter(|height| height.is_nan()).count();
            if missing(&self.heights) == missing(&before) {
                return self;
            }
        }
    }

    /// Slopes of the plane of least squares along x and y, of heights none of which is missing.
    pub fn tilt(&self) -> [f64; 2] {
        [0, 1].map(|axis| {
            let mut sums = [0.0; 2];
            for (index, height) in self.heights.iter().enumerate() {
                let at = self.place(index)[axis];
                sums = [sums[0] + at * height, sums[1] + at * at];
            }
            // A single line of points has no slope across.
            if sums[1] > 0.0 {
                sums[0] / sums[1] / self.spacing[axis]
            } else {
                0.0
            }
        })
    }

    /// Place of a point along x and y, in points from the middle.
    fn place(&self, index: usize) -> [f64; 2] {
        let [rows, columns] = self.shape;
        [(index % columns, columns), (index / columns, rows)]
            .map(|(place, count)| place as f64 - 0.5 * (count as f64 - 1.0))
    }

    /// Without its plane of least squares, of heights none of which is missing.
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
    /// [`TopographyError::Missing`] where heights are missing; those of [`HeightMap::new`].
    pub fn body(&self) -> Result<HeightMap, TopographyError> {
        let points = self.heights.len();
        let missing = self.missing();
        if missing > 0 {
            return Err(TopographyError::Missing { missing, points });
        }
        let [rows, columns] = self.shape;
        // The map has its heights into the body, and y fastest.
        let height = |index: usize| -self.heights[index % rows * columns + index / rows];
        let heights = (0..points).map(height).collect();
        Ok(HeightMap::new([columns, rows], self.spacing, heights)?)
    }
}

#[cfg(feature = "topography")]
fn measured(
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
        Unread::Other(found) => TopographyError::Format { format, found },
        Unread::Known(error) => error,
    })
}

#[cfg(not(feature = "topography"))]
fn measured(format: Format, _: &[u8], _: Memory) -> Result<Topography, TopographyError> {
    let found = format!("a file in the format {format:?}");
    let format = "the feature `topography` of the crate `indenters`";
    Err(TopographyError::Format { format, found })
}

impl TopographyError {
    fn without_spacing() -> Self {
        let problem = "the distances of neighbouring heights along x and y are needed".to_owned();
        Self::Spacing { problem }
    }
}

/// Why a reader gives up.
enum Unread {
    /// The contents are not of the format: what there is instead.
    Other(String),
    Known(TopographyError),
}

impl From<String> for Unread {
    fn from(found: String) -> Self {
        Self::Other(found)
    }
}

impl From<TopographyError> for Unread {
    fn from(error: TopographyError) -> Self {
        Self::Known(error)
    }
}
