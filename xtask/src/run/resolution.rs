//! An error bar from three resolutions, and doubling until it is small enough.

use anyhow::{Result, bail};

use crate::scene_file::Accuracy;

/// The finest result, and how it differs from those with three quarters and half of its elements.
///
/// An error of first order C/n differs by C/n from half the elements and by C/(3 n) from three quarters. The larger of
/// both, doubled, because which elements touch jumps from resolution to resolution, and one difference alone may vanish
/// by chance.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Resolved<T, const N: usize> {
    pub(super) value: T,
    /// Absolute, of each quantity.
    pub(super) error: [f64; N],
    pub(super) elements: usize,
}

const FIRST: usize = 16;
const SAFETY: f64 = 2.0;

/// Solves with the elements asked for, or with more and more until all quantities have the relative error.
pub(super) fn resolve<T, const N: usize>(
    accuracy: Accuracy,
    largest: usize,
    solve: impl Fn(usize) -> Result<T>,
    quantities: impl Fn(&T) -> [f64; N],
) -> Result<Resolved<T, N>> {
    let (mut elements, asked) = match accuracy {
        Accuracy::Elements(elements) => (elements, f64::INFINITY),
        Accuracy::RelativeError(error) => (FIRST, error),
    };
    let mut half = quantities(&solve(elements.div_ceil(2))?);
    loop {
        let three_quarters = quantities(&solve((3 * elements).div_ceil(4))?);
        let value = solve(elements)?;
        let fine = quantities(&value);
        let error: [f64; N] = std::array::from_fn(|quantity| {
            error([half, three_quarters, fine].map(|values| values[quantity]))
        });
        let missed = (0..N).find(|&quantity| error[quantity] > asked * fine[quantity].abs());
        let Some(missed) = missed else {
            return Ok(Resolved {
                value,
                error,
                elements,
            });
        };
        if elements >= largest {
            bail!(
                "the relative error {asked:e} was not reached with {elements} elements along the contact: the value is \
                 {} with an error of {:.1e}",
                fine[missed],
                error[missed]
            );
        }
        elements *= 2;
        half = quantities(&value);
    }
}

fn error([half, three_quarters, fine]: [f64; 3]) -> f64 {
    let difference = (fine - half).abs().max(3.0 * (fine - three_quarters).abs());
    SAFETY * difference + ROUNDING * fine.abs()
}

/// Of the many sums behind a value.
const ROUNDING: f64 = 1e-12;
