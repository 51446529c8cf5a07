//! The heights of a line at any position, from a table where it is smooth.

use indenters::RigidLine;
use numerics::whole_part;

use crate::MdrError;
use crate::element_heights::{ElementHeights, checked_height};

/// Cells of the table per element of the foundation.
const CELLS_PER_ELEMENT: usize = 4;
/// Error of a cubic through four nodes, relative to the largest height in the table, up to which the table is used in
/// a cell. It is far below the error of the elements.
const CUBIC_TOLERANCE: f64 = 1e-10;

/// Heights above the lowest point, \[m].
pub(super) struct HeightTable<'a> {
    line: &'a dyn RigidLine,
    lowest: f64,
    start: f64,
    cells_per_metre: f64,
    /// By the place of the cell in its element, one element after the other, as all elements are at the same place.
    nodes: [Vec<f64>; CELLS_PER_ELEMENT],
    is_smooth: [Vec<bool>; CELLS_PER_ELEMENT],
}

impl<'a> HeightTable<'a> {
    /// Of the part that a chain can touch.
    pub(super) fn new(line: &'a dyn RigidLine, sampled: &ElementHeights) -> Result<Self, MdrError> {
        let spacing = sampled.spacing / CELLS_PER_ELEMENT as f64;
        let [start, end] = [0, sampled.heights.len() - 1].map(|end| sampled.position(end));
        let n_cells = ((end - start) / spacing).ceil().max(1.0);
        let (lowest, cells_per_metre) = (sampled.lowest_height, spacing.recip());
        let at = |cell: f64| checked_height(line, start + cell * spacing).map(|h| h - lowest);
        let places = (0_u32..).map(f64::from).take_while(|cell| *cell <= n_cells);
        let nodes: Vec<f64> = places.map(at).collect::<Result<_, _>>()?;
        let finite = nodes.iter().copied().filter(|height| height.is_finite());
        let allowed = CUBIC_TOLERANCE * finite.fold(0.0, f64::max);
        let is_smooth = |cell: usize| {
            let around = cell
                .checked_sub(1)
                .and_then(|first| nodes.get(first..first + 4));
            // Between the nodes, not in the middle, where odd terms vanish.
            let is_close = |part: f64| {
                let exact = at(cell as f64 + part);
                let terms = around.into_iter().flatten().zip(weights(part));
                let cubic: f64 = terms.map(|(node, weight)| node * weight).sum();
                exact.is_ok_and(|exact| (cubic - exact).abs() <= allowed)
            };
            around.is_some() && [0.25, 0.5, 0.75].into_iter().all(is_close)
        };
        let is_smooth: Vec<bool> = (0..nodes.len()).map(is_smooth).collect();
        Ok(Self {
            line,
            lowest,
            start,
            cells_per_metre,
            is_smooth: split_by_subcell(&is_smooth),
            nodes: split_by_subcell(&nodes),
        })
    }

    /// At a position on the line.
    pub(super) fn at(&self, x: f64) -> Result<f64, MdrError> {
        Ok(checked_height(self.line, x)? - self.lowest)
    }

    /// Over a number of elements, of which the first is at a position on the line: all are at the same place of their cells.
    pub(super) fn over(
        &self,
        x: f64,
        n_elements: usize,
        row: &mut Vec<f64>,
    ) -> Result<(), MdrError> {
        let place = (x - self.start) * self.cells_per_metre;
        let spacing = CELLS_PER_ELEMENT as f64 / self.cells_per_metre;
        let cell = place.floor();
        let weights = weights(place - cell);
        // Elements before the first one of which all nodes are there.
        let before = (1.0 - cell).max(0.0) / CELLS_PER_ELEMENT as f64;
        let skipped = whole_part(before.ceil()).min(n_elements);
        let cell = whole_part((cell + (skipped * CELLS_PER_ELEMENT) as f64).max(1.0));
        let from = |number: usize| &self.nodes[number % CELLS_PER_ELEMENT][..];
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
        let smooth = &self.is_smooth[cell % CELLS_PER_ELEMENT];
        for (element, height) in row.iter_mut().enumerate() {
            let index = element
                .checked_sub(skipped)
                .map(|index| cell / CELLS_PER_ELEMENT + index);
            if index.and_then(|index| smooth.get(index)) != Some(&true) {
                *height = self.at(x + element as f64 * spacing)?;
            }
        }
        Ok(())
    }
}

/// The heights of a line at one position, over one element after the other.
#[derive(Debug, Default)]
pub(super) struct HeightRow {
    pub(super) first: usize,
    pub(super) heights: Vec<f64>,
}

impl HeightRow {
    /// Over an element that is covered.
    pub(super) fn over(&self, element: usize) -> f64 {
        self.heights[element - self.first]
    }

    /// Covers some elements at places `x` on the line, of which most were covered before.
    pub(super) fn cover(
        &mut self,
        line: &HeightTable<'_>,
        [first, last]: [usize; 2],
        x: impl Fn(usize) -> f64,
    ) -> Result<(), MdrError> {
        let known = self.first..self.first + self.heights.len();
        if !known.contains(&first) && !known.contains(&last) {
            self.first = first;
            return line.over(x(first), last + 1 - first, &mut self.heights);
        }
        let mut row = Vec::new();
        if last >= known.end {
            line.over(x(known.end), last + 1 - known.end, &mut row)?;
            self.heights.append(&mut row);
        }
        if first < known.start {
            line.over(x(first), known.start - first, &mut row)?;
            self.heights.splice(..0, row);
            self.first = first;
        }
        Ok(())
    }
}

/// Of a table of cells those at each place of an element.
fn split_by_subcell<T: Copy>(cells: &[T]) -> [Vec<T>; CELLS_PER_ELEMENT] {
    std::array::from_fn(|place| {
        cells
            .iter()
            .skip(place)
            .step_by(CELLS_PER_ELEMENT)
            .copied()
            .collect()
    })
}

/// Weights of Lagrange's cubic through four nodes, at a part of the cell in their middle.
fn weights(t: f64) -> [f64; 4] {
    let (r, s, q) = (t + 1.0, 1.0 - t, 2.0 - t);
    [
        -t * s * q / 6.0,
        r * s * q / 2.0,
        r * t * q / 2.0,
        -r * t * s / 6.0,
    ]
}
