//! Surfaces given by heights on a rectangular grid.
//!
//! ```text
//! h = (1 − s)(1 − t) h_ij + s (1 − t) h_(i+1)j + (1 − s) t h_i(j+1) + s t h_(i+1)(j+1)        0 ≤ s, t ≤ 1 in a cell
//! ```

use crate::table::{at_least, check_heights};
use crate::{IndenterError, Surface};
use numerics::{finite, positive, whole_part};

/// Part of the length of a map by which a point beyond its edge is on it: a point that was meant to be on the edge is off it by
/// some units in the last place.
const EDGE_TOLERANCE: f64 = 1e-12;

/// A surface through heights on a grid, bilinear between them; it ends at the edge of the grid.
///
/// Heights count as those of all bodies here, from the lowest point away from the elastomer; those of instruments and arrays,
/// out of the body, are a [`Topography`](crate::topography::Topography).
///
/// Its lowest height is the origin, of several the one nearest to the middle. Every grid line is an edge: details of
/// the size of a cell are those of the grid, not of the surface that was measured.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct HeightMap {
    shape: [usize; 2],
    spacing: [f64; 2],
    /// Row and column of the lowest height.
    lowest: [usize; 2],
    /// Above the lowest, row-major with y fastest.
    heights: Vec<f64>,
}

impl HeightMap {
    /// The surface through `heights` \[m], row-major with y fastest, in as many rows along x and columns along y as
    /// `shape` says, `spacing` \[m] apart along x and y.
    ///
    /// # Errors
    /// [`IndenterError`] `TooFew` (two rows and two columns are needed), `LengthMismatch` or `InvalidParameter`.
    pub fn new(
        shape: [usize; 2],
        spacing: [f64; 2],
        mut heights: Vec<f64>,
    ) -> Result<Self, IndenterError> {
        at_least(2, "heights along x", shape[0])?;
        at_least(2, "heights along y", shape[1])?;
        check_heights("grid", shape[0].saturating_mul(shape[1]), &heights)?;
        positive("spacing along x", spacing[0])?;
        positive("spacing along y", spacing[1])?;
        for height in &heights {
            finite("height", *height)?;
        }
        let lowest = lowest(shape, &heights);
        let base = heights[lowest[0] * shape[1] + lowest[1]];
        for height in &mut heights {
            *height = finite("height above the lowest", *height - base)?;
        }
        Ok(Self {
            shape,
            spacing,
            lowest,
            heights,
        })
    }

    /// Heights along x and along y.
    pub const fn shape(&self) -> [usize; 2] {
        self.shape
    }

    /// Distances of neighbouring heights along x and y, \[m].
    pub const fn spacing(&self) -> [f64; 2] {
        self.spacing
    }

    /// Heights above the lowest \[m], row-major with y fastest.
    pub fn heights(&self) -> &[f64] {
        &self.heights
    }

    /// The map beside its mirror images about its last row, about its last column and about both: when that is repeated its
    /// edges fit, and no height jumps.
    #[must_use]
    pub fn mirrored(&self) -> Self {
        let [rows, columns] = self.shape;
        let folded = |index: usize, length: usize| index.min(2 * length - 1 - index);
        let height = |index: usize| {
            let row = folded(index / (2 * columns), rows);
            self.heights[row * columns + folded(index % (2 * columns), columns)]
        };
        Self {
            shape: [2 * rows, 2 * columns],
            heights: (0..4 * rows * columns).map(height).collect(),
            ..*self
        }
    }

    /// Where the surface begins and ends along x and along y, seen from its lowest point, \[m].
    pub fn extent(&self) -> [[f64; 2]; 2] {
        [0, 1].map(|axis| self.between(axis, [0, self.shape[axis] - 1]))
    }

    fn between(&self, axis: usize, nodes: [usize; 2]) -> [f64; 2] {
        nodes.map(|node| (node as f64 - self.lowest[axis] as f64) * self.spacing[axis])
    }

    /// The cell along an axis that holds a coordinate \[m], and where in the cell it lies, from 0 to 1; `None` outside.
    fn cell(&self, axis: usize, coordinate: f64) -> Option<(usize, f64)> {
        let place = coordinate / self.spacing[axis] + self.lowest[axis] as f64;
        let last = self.shape[axis] - 1;
        let end = last as f64;
        let rounding = EDGE_TOLERANCE * end;
        if !(place >= -rounding && place <= end + rounding) {
            return None;
        }
        let place = place.clamp(0.0, end);
        let cell = whole_part(place).min(last - 1);
        Some((cell, place - cell as f64))
    }

    /// Heights at the corners of a cell: at its lower x, at its upper x, each from lower to upper y.
    fn corners(&self, [row, column]: [usize; 2]) -> [[f64; 2]; 2] {
        [row, row + 1].map(|row| {
            let first = row * self.shape[1] + column;
            [self.heights[first], self.heights[first + 1]]
        })
    }
}

/// Row and column of the lowest height, of equal ones the nearest to the middle.
fn lowest(shape: [usize; 2], heights: &[f64]) -> [usize; 2] {
    let place = |index: usize| [index / shape[1], index % shape[1]];
    let from_middle = |index: usize| -> f64 {
        let node = place(index);
        let squares = [0, 1].map(|axis| {
            let half = 0.5 * (shape[axis] - 1) as f64;
            ((node[axis] as f64 - half) / half).powi(2)
        });
        squares[0] + squares[1]
    };
    let below = |one: &usize, other: &usize| {
        let heights = heights[*one].total_cmp(&heights[*other]);
        heights.then_with(|| from_middle(*one).total_cmp(&from_middle(*other)))
    };
    place((0..heights.len()).min_by(below).unwrap_or(0))
}

fn mix([from, to]: [f64; 2], part: f64) -> f64 {
    (1.0 - part) * from + part * to
}

impl Surface for HeightMap {
    fn height(&self, [x, y]: [f64; 2]) -> f64 {
        let (Some((row, s)), Some((column, t))) = (self.cell(0, x), self.cell(1, y)) else {
            return f64::INFINITY;
        };
        mix(self.corners([row, column]).map(|edge| mix(edge, t)), s)
    }

    fn gradient(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let (Some((row, s)), Some((column, t))) = (self.cell(0, x), self.cell(1, y)) else {
            return [0.0, 0.0];
        };
        let [behind, ahead] = self.corners([row, column]);
        [
            (mix(ahead, t) - mix(behind, t)) / self.spacing[0],
            mix([behind[1] - behind[0], ahead[1] - ahead[0]], s) / self.spacing[1],
        ]
    }

    fn extent_below(&self, height: f64) -> [[f64; 2]; 2] {
        let mut nodes = self.lowest.map(|index| [index, index]);
        for (index, _) in (self.heights.iter().enumerate()).filter(|(_, node)| **node <= height) {
            let node = [index / self.shape[1], index % self.shape[1]];
            for (nodes, index) in nodes.iter_mut().zip(node) {
                *nodes = [nodes[0].min(index), nodes[1].max(index)];
            }
        }
        // A cell reaches below a height only where one of its corners does.
        [0, 1].map(|axis| {
            let [first, last] = nodes[axis];
            let end = (last + 1).min(self.shape[axis] - 1);
            self.between(axis, [first.saturating_sub(1), end])
        })
    }

    fn cell_length(&self) -> Option<f64> {
        Some(self.spacing[0])
    }

    fn mirrors(&self) -> [bool; 2] {
        let rows = || self.heights.chunks_exact(self.shape[1]);
        let same = [
            rows().eq(rows().rev()),
            rows().all(|row| row.iter().eq(row.iter().rev())),
        ];
        // The mirror passes through the lowest point, and the surface ends as far from it on both sides.
        [0, 1].map(|axis| same[axis] && 2 * self.lowest[axis] + 1 == self.shape[axis])
    }
}
