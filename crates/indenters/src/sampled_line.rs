//! Rigid lines given by a table, linear between its rows.

use crate::table::check_table;
use crate::{IndenterError, RigidLine};

/// A piecewise linear rigid line.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct SampledLine {
    /// Positions of the points, increasing, \[m].
    positions: Vec<f64>,
    /// Heights of the points, \[m].
    heights: Vec<f64>,
}

impl SampledLine {
    /// The line through the points (`positions[i]`, `heights[i]`), \[m], with increasing positions.
    ///
    /// # Errors
    /// [`IndenterError`] `LengthMismatch`, `TooFew` (two rows are needed), `NotIncreasing`, or `InvalidParameter` for a
    /// number that is not finite.
    pub fn new(positions: Vec<f64>, heights: Vec<f64>) -> Result<Self, IndenterError> {
        check_table("positions", &positions, &heights)?;
        Ok(Self { positions, heights })
    }

    /// Positions of the table, \[m].
    pub fn positions(&self) -> &[f64] {
        &self.positions
    }

    /// Heights of the table, \[m].
    pub fn heights(&self) -> &[f64] {
        &self.heights
    }

    /// Index i of the piece whose half-open interval [x_i, x_(i+1)[ holds the position.
    fn piece_at(&self, x: f64) -> usize {
        let inner = &self.positions[1..self.positions.len() - 1];
        inner.partition_point(|position| *position <= x)
    }
}

impl RigidLine for SampledLine {
    fn height(&self, x: f64) -> f64 {
        let [lower, upper] = self.domain();
        if !(lower..=upper).contains(&x) {
            return f64::INFINITY;
        }
        let i = self.piece_at(x);
        let [left, right] = [self.positions[i], self.positions[i + 1]];
        // The last knot keeps its height to the last bit, so that a plateau stays level.
        if x >= right {
            return self.heights[i + 1];
        }
        let fraction = (x - left) / (right - left);
        self.heights[i] + fraction * (self.heights[i + 1] - self.heights[i])
    }

    fn slope(&self, x: f64) -> f64 {
        let i = self.piece_at(x);
        (self.heights[i + 1] - self.heights[i]) / (self.positions[i + 1] - self.positions[i])
    }

    fn domain(&self) -> [f64; 2] {
        [self.positions[0], self.positions[self.positions.len() - 1]]
    }

    fn kinks(&self) -> Vec<f64> {
        self.positions[1..self.positions.len() - 1].to_vec()
    }

    fn monotone_breaks(&self, _samples: usize) -> Vec<f64> {
        self.positions.clone()
    }
}
