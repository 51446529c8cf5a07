//! An error bar from two resolutions, and doubling until it is small enough.

use anyhow::{Result, bail};

use crate::scene_file::Accuracy;

/// The finest result, and how it differs from that with half as many elements.
///
/// For a method of at least first order the difference is not smaller than the error of the finer one.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Resolved<T> {
    pub(super) value: T,
    /// Absolute.
    pub(super) error: f64,
    pub(super) elements: usize,
}

const FIRST: usize = 16;

/// Solves with the elements asked for and half of them, or with more and more until the relative error is reached.
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
    let mut coarse = quantity(&solve(elements.div_ceil(2))?);
    loop {
        let value = solve(elements)?;
        let fine = quantity(&value);
        let error = (fine - coarse).abs() + ROUNDING * fine.abs();
        if error <= asked * fine.abs() || asked == f64::INFINITY {
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
        coarse = fine;
    }
}

/// Of the many sums behind a value.
const ROUNDING: f64 = 1e-12;
