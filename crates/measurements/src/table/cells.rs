//! Access to single cells of a line by the quantity of their column.

use std::fmt::Display;

use super::{Column, Line, Quantity, Result, Table};
use crate::MeasurementError;

impl Table<'_> {
    /// Number of a quantity in SI; `None` without such a column.
    pub(crate) fn in_si(&self, line: &Line, quantity: Quantity) -> Result<Option<f64>> {
        let column = self.find(quantity);
        let number = |column: &Column| Ok(self.number(line, column)? * column.factor);
        column.map(number).transpose()
    }

    /// Positive number of a quantity in SI; `None` without such a column.
    pub(crate) fn positive_of(&self, line: &Line, quantity: Quantity) -> Result<Option<f64>> {
        let column = self.find(quantity);
        column.map(|column| self.positive(line, column)).transpose()
    }

    /// Error for the number of a quantity in a line.
    pub(crate) fn wrong_in(
        &self,
        line: &Line,
        quantity: Quantity,
        expected: &str,
    ) -> MeasurementError {
        match self.find(quantity) {
            Some(column) => self.wrong(line, column, expected),
            None => self.wrong_first(line, expected),
        }
    }

    /// Error that names the file and a line, counted from 1, but no column.
    pub(crate) fn wrong_row(&self, line: usize, problem: &dyn Display) -> MeasurementError {
        self.source.wrong_line(line, problem)
    }
}
