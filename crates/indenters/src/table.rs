//! What every table of positions and heights must fulfil.

use crate::IndenterError;
use crate::error::finite;

/// One column of a table with its name.
pub(crate) struct Column<'a> {
    pub(crate) name: &'static str,
    pub(crate) values: &'a [f64],
}

/// Checks that both columns are finite and equally long, have two rows, and that the positions increase.
///
/// # Errors
/// The [`IndenterError`] of the first rule that is broken.
pub(crate) fn check_table(positions: &Column, heights: &Column) -> Result<(), IndenterError> {
    check_lengths(positions, heights)?;
    for column in [positions, heights] {
        for value in column.values {
            finite(column.name, *value)?;
        }
    }
    let pairs = positions.values.windows(2).enumerate();
    for (index, pair) in pairs {
        if pair[1] <= pair[0] {
            return Err(IndenterError::NotIncreasing {
                list: positions.name,
                index: index + 1,
                value: pair[1],
                previous: pair[0],
            });
        }
    }
    Ok(())
}

fn check_lengths(positions: &Column, heights: &Column) -> Result<(), IndenterError> {
    let length = positions.values.len();
    if length != heights.values.len() {
        return Err(IndenterError::LengthMismatch {
            first: positions.name,
            first_length: length,
            second: heights.name,
            second_length: heights.values.len(),
        });
    }
    if length < 2 {
        return Err(IndenterError::TooFew {
            list: positions.name,
            needed: 2,
            length,
        });
    }
    Ok(())
}
