//! An error bar from three resolutions, and doubling until it is small enough.

use anyhow::{Result, bail};

use crate::scene_file::Accuracy;

/// The finest result, and how it differs from those with three quarters and half of its elements.
///
/// An error of first order C/n differs by C/n from half the elements and by C/(3 n) from three quarters. The larger of
/// both, doubled, because which elements touch jumps from resolution to resolution, and one difference alone may vanish
/// by chance.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Resolved<T> {
    pub(super) value: T,
    /// Absolute.
    pub(super) error: f64,
    pub(super) elements: usize,
}

const FIRST: usize = 16;
const SAFETY: f64 = 2.0;

/// Solves with the elements asked for, or with more and more until the relative error is reached.
pub(super) fn resolve<T>(
    accuracy: Accuracy,
    largest: usize,
    solve: impl Fn(usize) -> Result<T>,
    quantity: impl Fn(&T) -> f64,
) -> Result<Resolved<T>> {
    let (mut elements, asked) = match accuracy {
        Accuracy::Elements(elements) => (elements, f64::INFINITY),
        Accuracy::RelativeError(error) => (FIRST, error),
    };
    let mut half = quantity(&solve(elements.div_ceil(2))?);
    loop {
        let three_quarters = quantity(&solve((3 * elements).div_ceil(4))?);
        let value = solve(elements)?;
        let fine = quantity(&value);
        let difference = (fine - half).abs().max(3.0 * (fine - three_quarters).abs());
        let error = SAFETY * difference + ROUNDING * fine.abs();
        if error <= asked * fine.abs() || asked.is_infinite() {
            return Ok(Resolved {
                value,
                error,
                elements,
            });
        }
        if elements >= largest {
            bail!(
                "the relative error {asked:e} was not reached with {elements} elements along the contact: the value is \
                 {fine} with an error of {error:.1e}"
            );
        }
        elements *= 2;
        half = fine;
    }
}

/// Of the many sums behind a value.
const ROUNDING: f64 = 1e-12;
