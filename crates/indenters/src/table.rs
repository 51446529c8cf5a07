//! What every table of positions and heights must fulfil.

use crate::IndenterError;
use numerics::finite;

/// Checks that both lists are finite and equally long, have two rows, and that the positions, which have a name, increase.
pub(crate) fn check_table(
    list: &'static str,
    positions: &[f64],
    heights: &[f64],
) -> Result<(), IndenterError> {
    check_heights(list, positions.len(), heights)?;
    at_least(2, list, positions.len())?;
    for (name, values) in [(list, positions), ("heights", heights)] {
        for value in values {
            finite(name, *value)?;
        }
    }
    increasing(list, positions)
}

/// Checks that there are as many heights as a list, which has a name, needs.
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

pub(crate) fn at_least(
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

pub(crate) fn increasing(list: &'static str, values: &[f64]) -> Result<(), IndenterError> {
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
