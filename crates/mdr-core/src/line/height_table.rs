//! Heights of a line at any position, interpolated from a table where the line is smooth.

use indenters::RigidLine;
use numerics::whole_part;

use super::element_heights::{ElementHeights, checked_height};
use crate::MdrError;

/// Number of cells of the table per element of the foundation. Chosen: more cells make the table longer, and its cubics accurate
/// closer to a kink. Where a cubic is not accurate the line itself is evaluated, so that the number decides the time only.
const CELLS_PER_ELEMENT: usize = 4;
/// Error of a cubic through four nodes, relative to the largest height in the table, up to which the table is used in a cell; the
/// line itself is evaluated in the others. Chosen far below the discretisation error, which is above 1e-4 on the largest number
/// of elements (case of `evidence tuning`).
const CUBIC_TOLERANCE: f64 = 1e-10;

/// Distance from an end or from the lowest point of the line, relative to the length of a cell, up to which a position counts as
/// that point. Chosen: positions that are four million cells away round by half of it. The height changes by 1e-9 of the slope
/// times the cell.
const POSITION_ROUNDING: f64 = 1e-9;

/// Table of the heights above the lowest point, \[m].
pub(crate) struct HeightTable<'a> {
    /// Line whose heights the table holds.
    line: &'a dyn RigidLine,
    /// Height of the lowest point of the line, \[m].
    lowest: f64,
    /// Position of the lowest point, \[m].
    anchor: f64,
    /// Position of the first node of the table, \[m].
    start: f64,
    /// Number of cells per length, \[1/m].
    cells_per_metre: f64,
    /// Heights at the nodes, one list per position of a node in its element: the elements of a row all have the same one.
    nodes: [Vec<f64>; CELLS_PER_ELEMENT],
    /// True if the cubic holds in the cell that begins at a node, in the same order.
    is_smooth: [Vec<bool>; CELLS_PER_ELEMENT],
}

impl<'a> HeightTable<'a> {
    /// Tabulates the heights of the part of a line that can come into contact, and marks the cells in which a cubic is accurate.
    pub(crate) fn new(line: &'a dyn RigidLine, sampled: &ElementHeights) -> Result<Self, MdrError> {
        let spacing = sampled.spacing / CELLS_PER_ELEMENT as f64;
        let [start, end] = [0, sampled.heights.len() - 1].map(|end| sampled.position(end));
        let n_cells = ((end - start) / spacing).ceil().max(1.0);
        let (lowest, cells_per_metre) = (sampled.lowest_height, spacing.recip());
        let height_of_cell =
            |cell: f64| checked_height(line, start + cell * spacing).map(|h| h - lowest);
        let cells = (0_u32..).map(f64::from).take_while(|cell| *cell <= n_cells);
        let nodes: Vec<f64> = cells.map(height_of_cell).collect::<Result<_, _>>()?;
        // A cell is smooth if the cubic through its nodes agrees with the line.
        let finite = nodes.iter().copied().filter(|height| height.is_finite());
        let allowed = CUBIC_TOLERANCE * finite.fold(0.0, f64::max);
        let is_smooth = |cell: usize| {
            let nodes_around = cell
                .checked_sub(1)
                .and_then(|first| nodes.get(first..first + 4));
            // The cubic is compared at three places, not only in the middle of the cell, where odd terms of the error vanish.
            let is_close = |part: f64| {
                let exact = height_of_cell(cell as f64 + part);
                let terms = nodes_around.into_iter().flatten().zip(weights(part));
                let cubic: f64 = terms.map(|(node, weight)| node * weight).sum();
                exact.is_ok_and(|exact| (cubic - exact).abs() <= allowed)
            };
            nodes_around.is_some() && [0.25, 0.5, 0.75].into_iter().all(is_close)
        };
        let is_smooth: Vec<bool> = (0..nodes.len()).map(is_smooth).collect();
        Ok(Self {
            line,
            lowest,
            anchor: sampled.position(sampled.anchor_index),
            start,
            cells_per_metre,
            is_smooth: split_by_subcell(&is_smooth),
            nodes: split_by_subcell(&nodes),
        })
    }

    /// Height at a position on the line, \[m]; within rounding of an end or the lowest point of the line, that of the
    /// point: no rounding is small at a cusp, or beyond an end.
    pub(crate) fn height_at(&self, x: f64) -> Result<f64, MdrError> {
        let rounding = POSITION_ROUNDING / self.cells_per_metre;
        let [rear, front] = self.line.domain();
        let mut points = [rear, self.anchor, front].into_iter();
        let point = points.find(|point| (x - point).abs() <= rounding);
        Ok(checked_height(self.line, point.unwrap_or(x))? - self.lowest)
    }

    /// Replaces `row` by the heights \[m] over a row of elements with the spacing of the foundation, whose first one is at the
    /// position `x` on the line, \[m].
    pub(crate) fn fill_row(
        &self,
        x: f64,
        n_elements: usize,
        row: &mut Vec<f64>,
    ) -> Result<(), MdrError> {
        let position_in_cells = (x - self.start) * self.cells_per_metre;
        let spacing = CELLS_PER_ELEMENT as f64 / self.cells_per_metre;
        let first_cell = position_in_cells.floor();
        let weights = weights(position_in_cells - first_cell);
        // `skipped` is the number of elements before the first one whose four nodes are in the table.
        let before = (1.0 - first_cell).max(0.0) / CELLS_PER_ELEMENT as f64;
        let skipped = whole_part(before.ceil()).min(n_elements);
        let cell = whole_part((first_cell + (skipped * CELLS_PER_ELEMENT) as f64).max(1.0));
        let from = |number: usize| &self.nodes[number % CELLS_PER_ELEMENT][..];

        // The cubics of all elements have the same four weights, because every element is at the same fraction of its cell.
        let nodes = [cell - 1, cell, cell + 1, cell + 2].map(|node| {
            let first = (node / CELLS_PER_ELEMENT).min(from(node).len());
            &from(node)[first..]
        });
        row.clear();
        row.resize(skipped, f64::NAN);
        let [a, b, c, d] = nodes;
        let all = a.iter().zip(b).zip(c.iter().zip(d));
        let cubics = all.map(|((a, b), (c, d))| {
            a * weights[0] + b * weights[1] + (c * weights[2] + d * weights[3])
        });
        row.extend(cubics.take(n_elements - skipped));
        row.resize(n_elements, f64::NAN);

        // Use the heights of the line itself where the cubic is not accurate.
        let smooth = &self.is_smooth[cell % CELLS_PER_ELEMENT];
        for (element, height) in row.iter_mut().enumerate() {
            let index = element
                .checked_sub(skipped)
                .map(|index| cell / CELLS_PER_ELEMENT + index);
            if index.and_then(|index| smooth.get(index)) != Some(&true) {
                *height = self.height_at(x + element as f64 * spacing)?;
            }
        }
        Ok(())
    }
}

/// Heights of a line at one position of it, over a row of elements, \[m].
#[derive(Debug, Default)]
pub(crate) struct HeightRow {
    /// Index of the first element.
    pub(crate) first: usize,
    /// Heights of the line, \[m].
    pub(crate) heights: Vec<f64>,
}

impl HeightRow {
    /// Height over an element of the row, \[m]; `element` is its index in the foundation.
    pub(crate) fn over(&self, element: usize) -> f64 {
        self.heights[element - self.first]
    }

    /// Extends the row to the elements of a window, [first, last], which are at the positions `x` on the line.
    pub(crate) fn cover(
        &mut self,
        line: &HeightTable<'_>,
        window: [usize; 2],
        x: impl Fn(usize) -> f64,
    ) -> Result<(), MdrError> {
        let [first, last] = window;
        // Without overlap start anew; otherwise append and prepend what is missing.
        let known = self.first..self.first + self.heights.len();
        if !known.contains(&first) && !known.contains(&last) {
            self.first = first;
            return line.fill_row(x(first), last + 1 - first, &mut self.heights);
        }
        let mut row = Vec::new();
        if last >= known.end {
            line.fill_row(x(known.end), last + 1 - known.end, &mut row)?;
            self.heights.append(&mut row);
        }
        if first < known.start {
            line.fill_row(x(first), known.start - first, &mut row)?;
            self.heights.splice(..0, row);
            self.first = first;
        }
        Ok(())
    }
}

/// Splits a list of cells by their position in an element: entry k of the list goes to the part k mod [`CELLS_PER_ELEMENT`].
fn split_by_subcell<T: Copy>(cells: &[T]) -> [Vec<T>; CELLS_PER_ELEMENT] {
    std::array::from_fn(|subcell| {
        cells
            .iter()
            .skip(subcell)
            .step_by(CELLS_PER_ELEMENT)
            .copied()
            .collect()
    })
}

/// Weights of Lagrange's cubic through four equidistant nodes, at a fraction `t` of the cell in their middle.
fn weights(t: f64) -> [f64; 4] {
    let (r, s, q) = (t + 1.0, 1.0 - t, 2.0 - t);
    [
        -t * s * q / 6.0,
        r * s * q / 2.0,
        r * t * q / 2.0,
        -r * t * s / 6.0,
    ]
}
