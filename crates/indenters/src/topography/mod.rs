//! Measured surfaces, from the contents of files.
//!
//! Heights point out of the body. Along x they follow one another as in the rows of the file, along y from the first row up,
//! or from the last where the first is the upper one of a picture. Heights that were not measured are NaN until they are filled.

mod asc;
mod binary;
mod x3p;
mod xyz;

use thiserror::Error;

use crate::{HeightMap, IndenterError};

/// Why a file is no surface.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum TopographyError {
    /// The contents are not of the format.
    #[error("{format} is needed, but there is {found}")]
    Format {
        /// What is needed.
        format: &'static str,
        /// What there is instead, and where.
        found: String,
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

/// A measured surface.
#[derive(Debug, Clone, PartialEq)]
pub struct Topography {
    /// Points along x and y.
    pub shape: [usize; 2],
    /// Distance of neighbouring points along x and y, \[m].
    pub spacing: [f64; 2],
    /// Heights, y fastest, \[m]; NaN where they are missing.
    pub heights: Vec<f64>,
}

impl Topography {
    /// The surface in the contents of a file with the extension asc (Esri's ASCII grid, in metres), gsf (Gwyddion Simple
    /// Field), sur (Digital Surf), x3p (ISO 25178-72) or xyz (rows of x, y and z \[m]).
    ///
    /// # Errors
    /// [`TopographyError::Format`] where the contents are not of that format.
    pub fn read(extension: &str, contents: &[u8]) -> Result<Self, TopographyError> {
        let extension = extension.to_ascii_lowercase();
        let found = match &extension[..] {
            "asc" => asc::read(contents),
            "gsf" => binary::simple_field(contents),
            "sur" => binary::digital_surf(contents),
            "x3p" => x3p::read(contents),
            "xyz" => xyz::read(contents),
            other => Err(other.to_owned()),
        };
        let format = match &extension[..] {
            "asc" => "an ASCII grid with ncols, nrows, cellsize and heights",
            "gsf" => "a Gwyddion Simple Field 1.0",
            "sur" => "a surface of Digital Surf that is not compressed",
            "x3p" => "a surface of ISO 25178-72 with equally spaced points",
            "xyz" => "x, y and z of points of a grid in each line",
            _ => "one of the extensions asc, gsf, sur, x3p, xyz",
        };
        found.map_err(|found| TopographyError::Format { format, found })
    }

    /// From the values of all points, x fastest.
    fn of_rows(
        [columns, rows]: [usize; 2],
        spacing: [f64; 2],
        first_is_upper: bool,
        value: impl Fn(usize) -> f64,
    ) -> Self {
        let row = |y: usize| if first_is_upper { rows - 1 - y } else { y };
        let points = (0..columns).flat_map(|x| (0..rows).map(move |y| [x, y]));
        Self {
            shape: [columns, rows],
            spacing,
            heights: points.map(|[x, y]| value(row(y) * columns + x)).collect(),
        }
    }

    /// With every missing height the mean of its known neighbours, of four, from the edges of holes inwards.
    #[must_use]
    pub fn filled(mut self) -> Self {
        let columns = self.shape[1];
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
        let place = [index / self.shape[1], index % self.shape[1]];
        [0, 1].map(|axis| place[axis] as f64 - 0.5 * (self.shape[axis] as f64 - 1.0))
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
        let missing = self.heights.iter().filter(|height| height.is_nan()).count();
        if missing > 0 {
            return Err(TopographyError::Missing { missing, points });
        }
        let highest = self.heights.iter().copied().fold(f64::MIN, f64::max);
        let heights = self.heights.iter().map(|height| highest - height).collect();
        Ok(HeightMap::new(self.shape, self.spacing, heights)?)
    }
}

/// Metres in a unit of length as files write it.
fn metres(unit: &str) -> Result<f64, String> {
    let unit = unit.trim_matches(|end: char| end.is_whitespace() || end == '\0');
    Ok(match unit {
        "m" | "" => 1.0,
        "mm" => 1e-3,
        // The last one is µ in MS-DOS.
        "µm" | "μm" | "um" | "æm" => 1e-6,
        "nm" => 1e-9,
        other => return Err(format!("the unit '{other}'")),
    })
}

/// The text of a file in UTF-8, or in Latin-1.
fn text_of(contents: &[u8]) -> String {
    let contents = contents.strip_prefix(b"\xef\xbb\xbf").unwrap_or(contents);
    let latin = || contents.iter().copied().map(char::from).collect();
    std::str::from_utf8(contents).map_or_else(|_| latin(), str::to_owned)
}
