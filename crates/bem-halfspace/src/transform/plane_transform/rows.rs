//! Real transforms along y.

use std::sync::Arc;

use numerics::transforms::Real;
use realfft::{ComplexToReal, RealToComplex};
use rustfft::num_complex::Complex;

use crate::elements::mirror::Mirror;
use crate::transform::plane_transform::about_centre::CosineTransform;
use crate::transform::plane_transform::about_edge;
use crate::transform::plane_transform::real_rows::{forward_real, inverse_real};
use crate::transform::plane_transform::workspace::Buffers;

/// The transforms of a row, or of the part of it in front of a mirror.
///
/// The coefficients of a whole row are complex, and those of the other half of the period their conjugates; those beside
/// a mirror are real, and two of them side by side are stored as one complex number.
#[derive(Clone)]
pub(super) enum RowTransform<T> {
    Fourier {
        forward: Arc<dyn RealToComplex<T>>,
        inverse: Arc<dyn ComplexToReal<T>>,
        /// Of [`about_edge`]; none without a mirror there.
        twiddles: Option<Vec<Complex<T>>>,
    },
    AboutCentre(CosineTransform<T>),
}

impl<T: Real> RowTransform<T> {
    /// For a period of so many elements.
    pub(super) fn new(period: usize, mirror: Mirror) -> Self {
        let half = period / 2;
        let (length, twiddles) = match mirror {
            Mirror::None => (period, None),
            Mirror::Centre => return Self::AboutCentre(CosineTransform::new(half)),
            Mirror::Edge => (half, Some(about_edge::twiddles(half))),
        };
        Self::Fourier {
            forward: T::real_forward(length),
            inverse: T::real_inverse(length),
            twiddles,
        }
    }

    /// Number of elements that are transformed.
    pub(super) fn len(&self) -> usize {
        match self {
            Self::Fourier { forward, .. } => forward.len(),
            Self::AboutCentre(cosines) => cosines.len(),
        }
    }

    pub(super) const fn has_mirror(&self) -> bool {
        !matches!(self, Self::Fourier { twiddles: None, .. })
    }

    /// Number of complex numbers that hold the coefficients.
    pub(super) fn n_coefficients(&self) -> usize {
        if self.has_mirror() {
            self.len().div_ceil(2)
        } else {
            self.len() / 2 + 1
        }
    }

    pub(super) fn scratch_len(&self) -> usize {
        match self {
            Self::Fourier {
                forward, inverse, ..
            } => forward.get_scratch_len().max(inverse.get_scratch_len()),
            Self::AboutCentre(cosines) => cosines.plan().get_scratch_len(),
        }
    }

    /// Number of reals that are transformed.
    pub(super) fn n_reals(&self) -> usize {
        match self {
            Self::Fourier { forward, .. } => forward.len(),
            Self::AboutCentre(cosines) => cosines.plan().len(),
        }
    }

    /// Transforms all elements of a row without a mirror; they are overwritten.
    pub(super) fn forward_whole(&self, row: &mut [T], transformed: &mut [Complex<T>]) {
        assert!(!self.has_mirror(), "a whole row");
        if let Self::Fourier { forward, .. } = self {
            let mut scratch = forward.make_scratch_vec();
            forward_real(&**forward, row, transformed, &mut scratch);
        }
    }

    /// Transforms the values at the beginning of a row that is zero behind them; the coefficients are in the half row of
    /// the buffers.
    pub(super) fn forward<F: Real>(&self, buffers: &mut Buffers<T>, values: &[F]) {
        match self {
            Self::Fourier {
                forward, twiddles, ..
            } => {
                match twiddles {
                    Some(_) => about_edge::reorder(values, &mut buffers.row),
                    None => fill(&mut buffers.row, values),
                }
                forward_real(
                    &**forward,
                    &mut buffers.row,
                    &mut buffers.half_row,
                    &mut buffers.scratch,
                );
                if let Some(twiddles) = twiddles {
                    about_edge::to_cosine_sums(twiddles, &buffers.half_row, &mut buffers.row);
                    pair(&buffers.row, &mut buffers.half_row);
                }
            }
            Self::AboutCentre(cosines) => {
                fill(&mut buffers.row, values);
                buffers.row[0] *= T::rounded(2.0);
                cosines.apply(buffers);
                pair(&buffers.row, &mut buffers.half_row);
            }
        }
    }

    /// Transforms back, without normalisation, the coefficients in the half row of the buffers.
    pub(super) fn inverse<F: Real>(&self, buffers: &mut Buffers<T>, values: &mut [F]) {
        match self {
            Self::Fourier {
                inverse, twiddles, ..
            } => {
                if let Some(twiddles) = twiddles {
                    unpair(&buffers.half_row, &mut buffers.row);
                    about_edge::from_cosine_sums(twiddles, &buffers.row, &mut buffers.half_row);
                }
                inverse_real(
                    &**inverse,
                    &mut buffers.half_row,
                    &mut buffers.row,
                    &mut buffers.scratch,
                );
                if twiddles.is_some() {
                    return about_edge::restore_order(&buffers.row, values);
                }
            }
            Self::AboutCentre(cosines) => {
                unpair(&buffers.half_row, &mut buffers.row);
                cosines.apply(buffers);
            }
        }
        for (value, found) in values.iter_mut().zip(&buffers.row) {
            *value = F::rounded((*found).into());
        }
    }
}

/// Values, and zeros behind them.
fn fill<T: Real, F: Real>(row: &mut [T], values: &[F]) {
    for (place, value) in row.iter_mut().zip(values) {
        *place = T::rounded((*value).into());
    }
    row[values.len()..].fill(T::default());
}

/// Stores two real numbers each as one complex number.
fn pair<T: Real>(reals: &[T], pairs: &mut [Complex<T>]) {
    let (whole, rest) = reals.as_chunks::<2>();
    let alone = rest.iter().map(|&real| Complex::new(real, T::default()));
    let whole = whole.iter().map(|&[re, im]| Complex::new(re, im));
    for (place, pair) in pairs.iter_mut().zip(whole.chain(alone)) {
        *place = pair;
    }
}

/// The inverse of [`pair`].
fn unpair<T: Real>(pairs: &[Complex<T>], reals: &mut [T]) {
    for (reals, pair) in reals.chunks_mut(2).zip(pairs) {
        for (real, value) in reals.iter_mut().zip([pair.re, pair.im]) {
            *real = value;
        }
    }
}
