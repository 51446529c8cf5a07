//! The heights of a line at any position, from a table where it is smooth.

use indenters::RigidLine;

use crate::MdrError;
use crate::element_heights::{ElementHeights, checked_height};

/// Cells of the table per element of the chain.
const CELLS: usize = 4;
/// Error of a cubic through four nodes, relative to the largest height in the table, up to which a cell is smooth: far
/// below what elements leave out.
const SMOOTH: f64 = 1e-10;

/// Heights above the lowest point, \[m].
pub(super) struct Heights<'a, L: ?Sized> {
    line: &'a L,
    lowest: f64,
    start: f64,
    cells_per_metre: f64,
    nodes: Vec<f64>,
    is_smooth: Vec<bool>,
}

impl<'a, L: RigidLine + ?Sized> Heights<'a, L> {
    /// Of the part that a chain can touch.
    pub(super) fn new(line: &'a L, sampled: &ElementHeights) -> Result<Self, MdrError> {
        let spacing = sampled.spacing / CELLS as f64;
        let [start, end] = [0, sampled.heights.len() - 1].map(|end| sampled.position(end));
        let n_cells = ((end - start) / spacing).ceil().max(1.0);
        let (lowest, cells_per_metre) = (sampled.lowest_height, spacing.recip());
        let at = |cell: f64| checked_height(line, start + cell * spacing).map(|h| h - lowest);
        let places = (0_u32..).map(f64::from).take_while(|cell| *cell <= n_cells);
        let nodes: Vec<f64> = places.map(at).collect::<Result<_, _>>()?;
        let finite = nodes.iter().copied().filter(|height| height.is_finite());
        let allowed = SMOOTH * finite.fold(0.0, f64::max);
        let mut heights = Self {
            line,
            lowest,
            start,
            cells_per_metre,
            is_smooth: vec![false; nodes.len()],
            nodes,
        };
        for cell in 1..heights.nodes.len().saturating_sub(2) {
            // Between the nodes, not in the middle, where odd terms vanish.
            let is_close = [0.25, 0.5, 0.75].map(|part| {
                let exact = at(cell as f64 + part)?;
                Ok::<bool, MdrError>((heights.cubic(cell, &weights(part)) - exact).abs() <= allowed)
            });
            heights.is_smooth[cell] = is_close.into_iter().all(|close| close == Ok(true));
        }
        Ok(heights)
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
        let spacing = CELLS as f64 / self.cells_per_metre;
        let first = place.floor();
        let weights = weights(place - first);
        row.clear();
        for element in 0..n_elements {
            let cell = first + (element * CELLS) as f64;
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "a negative number becomes 0, whose cell is not smooth"
            )]
            let cell = cell as usize;
            row.push(match self.is_smooth.get(cell) {
                Some(true) => self.cubic(cell, &weights),
                _ => self.at(x + element as f64 * spacing)?,
            });
        }
        Ok(())
    }

    /// Through the nodes around a cell.
    fn cubic(&self, cell: usize, weights: &[f64; 4]) -> f64 {
        let nodes = self.nodes[cell - 1..cell + 3].iter().zip(weights);
        nodes.map(|(node, weight)| node * weight).sum()
    }
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
