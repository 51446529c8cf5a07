//! Height maps: surfaces given by heights on a rectangular grid.
//!
//! ```text
//! h = (1 − s)(1 − t) h_ij + s (1 − t) h_(i+1)j + (1 − s) t h_i(j+1) + s t h_(i+1)(j+1)        0 ≤ s, t ≤ 1 in a cell
//! ```

use crate::table::{check_heights, check_min_length};
use crate::{IndenterError, Surface};
use numerics::{finite, positive, whole_part};

/// Ratio of the distance beyond the edge to the length of the map up to which a point counts as on the edge. Chosen: it
/// covers the rounding of coordinates that were meant to lie on the edge.
const EDGE_TOLERANCE: f64 = 1e-12;

/// A surface with bilinear interpolation between heights on a grid; it ends at the edge of the grid.
///
/// Two constructors differ in the direction of the heights and in the order of the values:
///
/// | constructor | heights | order | `shape` |
/// |---|---|---|---|
/// | [`from_heights`](Self::from_heights) | out of the body, so that summits touch first | rows along x, x fastest | \[n_y, n_x] |
/// | [`from_gaps`](Self::from_gaps) | into the body, so that minima touch first | rows along y, y fastest | \[n_x, n_y] |
///
/// `from_heights` is the convention of scene files, of arrays in Python and of [`Topography`](crate::topography::Topography);
/// `from_gaps` is that of [`Surface::height`] and of the methods of this type. x is the direction of sliding.
///
/// The origin is the lowest node; among several, the one nearest to the middle. Every grid line is an edge: details of
/// the size of a cell belong to the grid, not to the measured surface.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct HeightMap {
    /// Rows along x and columns along y.
    shape: [usize; 2],
    /// Distances between rows and between columns, \[m].
    spacing: [f64; 2],
    /// Row and column of the lowest height.
    lowest: [usize; 2],
    /// Heights above the lowest \[m], row-major with y fastest.
    heights: Vec<f64>,
}

impl HeightMap {
    /// The surface through `heights` \[m] that point out of the body, row by row: a row runs along x, the direction of sliding.
    ///
    /// `shape` is the number of rows, one for each y, and of columns, one for each x; `spacing` \[m] is the distance of
    /// neighbouring heights along x and along y. The height at x = j dx and y = i dy has the index i n_x + j.
    ///
    /// # Errors
    /// [`IndenterError`] `TooFew` (two heights along x and along y are needed), `LengthMismatch` or `InvalidParameter`.
    ///
    /// ```
    /// use indenters::{HeightMap, Surface};
    ///
    /// // One summit at the second of three x and the second of two y; it touches first.
    /// let map = HeightMap::from_heights([2, 3], [0.5, 1.0], &[1.0, 2.0, 0.0, 1.0, 4.0, 3.0])?;
    /// assert_eq!(map.extent(), [[-0.5, 0.5], [-1.0, 0.0]]);
    /// assert_eq!(map.height([0.5, 0.0]), 1.0);
    /// # Ok::<(), indenters::IndenterError>(())
    /// ```
    pub fn from_heights(
        shape: [usize; 2],
        spacing: [f64; 2],
        heights: &[f64],
    ) -> Result<Self, IndenterError> {
        let [rows, columns] = shape;
        check_heights("grid", rows.saturating_mul(columns), heights)?;
        let gap = |index: usize| -heights[index % rows * columns + index / rows];
        let gaps = (0..heights.len()).map(gap).collect();
        Self::from_gaps([columns, rows], spacing, gaps)
    }

    /// The surface through heights \[m] that point into the body, the gaps between body and elastomer at first touch, row-major
    /// with y fastest.
    ///
    /// `shape` is the number of gaps along x and along y, `spacing` \[m] the distance of neighbouring gaps along x and along y.
    /// The gap at x = i dx and y = j dy has the index i n_y + j.
    ///
    /// # Errors
    /// [`IndenterError`] `TooFew` (two heights along x and along y are needed), `LengthMismatch` or `InvalidParameter`.
    pub fn from_gaps(
        shape: [usize; 2],
        spacing: [f64; 2],
        mut heights: Vec<f64>,
    ) -> Result<Self, IndenterError> {
        check_min_length(2, "heights along x", shape[0])?;
        check_min_length(2, "heights along y", shape[1])?;
        check_heights("grid", shape[0].saturating_mul(shape[1]), &heights)?;
        positive("spacing along x", spacing[0])?;
        positive("spacing along y", spacing[1])?;
        for height in &heights {
            finite("height", *height)?;
        }
        // Measure all heights from the lowest node, which becomes the origin of the body.
        let lowest = lowest_node(shape, &heights);
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

    /// Numbers of heights along x and along y.
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

    /// The map together with its mirror images about its last row, its last column and both.
    ///
    /// The periodic continuation of the mirrored map has no jump of the height.
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

    /// Ends of the surface along x and along y, relative to its lowest point, \[m].
    pub fn extent(&self) -> [[f64; 2]; 2] {
        [0, 1].map(|axis| self.node_coordinates(axis, [0, self.shape[axis] - 1]))
    }

    /// Coordinates of two nodes along an axis, relative to the lowest point, \[m].
    fn node_coordinates(&self, axis: usize, nodes: [usize; 2]) -> [f64; 2] {
        nodes.map(|node| (node as f64 - self.lowest[axis] as f64) * self.spacing[axis])
    }

    /// The cell along an axis that holds a coordinate \[m], and the position in the cell, from 0 to 1; `None` outside.
    fn cell(&self, axis: usize, coordinate: f64) -> Option<(usize, f64)> {
        // Points that are beyond the edge only by rounding count as on it; those farther outside have no height.
        let node = coordinate / self.spacing[axis] + self.lowest[axis] as f64;
        let last = self.shape[axis] - 1;
        let end = last as f64;
        let rounding = EDGE_TOLERANCE * end;
        if !(node >= -rounding && node <= end + rounding) {
            return None;
        }
        let node = node.clamp(0.0, end);
        let cell = whole_part(node).min(last - 1);
        Some((cell, node - cell as f64))
    }

    /// Heights at the corners of a cell, `[[h_ij, h_i(j+1)], [h_(i+1)j, h_(i+1)(j+1)]]`.
    fn corners(&self, [row, column]: [usize; 2]) -> [[f64; 2]; 2] {
        [row, row + 1].map(|row| {
            let first = row * self.shape[1] + column;
            [self.heights[first], self.heights[first + 1]]
        })
    }
}

/// Row and column of the lowest height; among equal ones, of the nearest to the middle.
fn lowest_node(shape: [usize; 2], heights: &[f64]) -> [usize; 2] {
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

/// Linear interpolation between two values, at a fraction `part` of the way.
fn interpolate([from, to]: [f64; 2], part: f64) -> f64 {
    (1.0 - part) * from + part * to
}

impl Surface for HeightMap {
    fn height(&self, [x, y]: [f64; 2]) -> f64 {
        let (Some((row, s)), Some((column, t))) = (self.cell(0, x), self.cell(1, y)) else {
            return f64::INFINITY;
        };
        interpolate(
            self.corners([row, column]).map(|edge| interpolate(edge, t)),
            s,
        )
    }

    fn gradient(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let (Some((row, s)), Some((column, t))) = (self.cell(0, x), self.cell(1, y)) else {
            return [0.0, 0.0];
        };
        let [behind, ahead] = self.corners([row, column]);
        [
            (interpolate(ahead, t) - interpolate(behind, t)) / self.spacing[0],
            interpolate([behind[1] - behind[0], ahead[1] - ahead[0]], s) / self.spacing[1],
        ]
    }

    fn extent_below(&self, height: f64) -> [[f64; 2]; 2] {
        // Find the first and last row and column that contain a node below the height.
        let mut nodes = self.lowest.map(|index| [index, index]);
        for (index, _) in (self.heights.iter().enumerate()).filter(|(_, node)| **node <= height) {
            let node = [index / self.shape[1], index % self.shape[1]];
            for (nodes, index) in nodes.iter_mut().zip(node) {
                *nodes = [nodes[0].min(index), nodes[1].max(index)];
            }
        }
        // A bilinear cell reaches below a height only if one of its corners does: extend the nodes by one cell.
        [0, 1].map(|axis| {
            let [first, last] = nodes[axis];
            let end = (last + 1).min(self.shape[axis] - 1);
            self.node_coordinates(axis, [first.saturating_sub(1), end])
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
        // The lowest point, which is the origin, must lie on the mirror plane in the middle of the map.
        [0, 1].map(|axis| same[axis] && 2 * self.lowest[axis] + 1 == self.shape[axis])
    }
}
