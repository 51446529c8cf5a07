//! Checks of tables of positions and heights.

use crate::IndenterError;
use numerics::finite;

/// Checks a table of two or more rows: finite numbers, lists of equal length, increasing positions.
///
/// `list` is the name of the positions in messages.
pub(crate) fn check_table(
    list: &'static str,
    positions: &[f64],
    heights: &[f64],
) -> Result<(), IndenterError> {
    check_heights(list, positions.len(), heights)?;
    check_min_length(2, list, positions.len())?;
    for (name, values) in [(list, positions), ("heights", heights)] {
        for value in values {
            finite(name, *value)?;
        }
    }
    check_increasing(list, positions)
}

/// Checks that the number of heights is the length of the list `first`.
pub(crate) const fn check_heights(
    first: &'static str,
    first_length: usize,
    heights: &[f64],
) -> Result<(), IndenterError> {
    if heights.len() == first_length {
        return Ok(());
    }
    Err(IndenterError::LengthMismatch {
        first,
        first_length,
        second: "heights",
        second_length: heights.len(),
    })
}

/// Checks that a list has at least `needed` entries.
pub(crate) fn check_min_length(
    needed: usize,
    list: &'static str,
    length: usize,
) -> Result<(), IndenterError> {
    if length >= needed {
        return Ok(());
    }
    Err(IndenterError::TooFew {
        list,
        needed,
        length,
    })
}

/// Checks that the values of a list increase strictly.
pub(crate) fn check_increasing(list: &'static str, values: &[f64]) -> Result<(), IndenterError> {
    match values.windows(2).position(|pair| pair[1] <= pair[0]) {
        None => Ok(()),
        Some(before) => Err(IndenterError::NotIncreasing {
            list,
            index: before + 1,
            value: values[before + 1],
            previous: values[before],
        }),
    }
}
