//! Real transforms of rows, along y.

use std::sync::Arc;

use numerics::transforms::Real;
use realfft::{ComplexToReal, RealToComplex};
use rustfft::num_complex::Complex;

use crate::elements::mirror::Mirror;
use crate::transform::plane_transform::about_centre::CosineTransform;
use crate::transform::plane_transform::about_edge;
use crate::transform::plane_transform::real_rows::{forward_real, inverse_real};
use crate::transform::plane_transform::workspace::Buffers;

/// Plans of the transforms of a row, or of the half of a row that is its own mirror image.
///
/// The coefficients of a whole row are complex; half of the period is stored, the other half are their conjugates. The
/// coefficients of a row with a mirror are real, and each two neighbours are stored as one complex number.
#[derive(Clone)]
pub(super) enum RowTransform<T> {
    /// A whole row, or half a row with a mirror at the edge of its first element.
    Fourier {
        /// Real forward transform, of the period or of half of it.
        forward: Arc<dyn RealToComplex<T>>,
        /// Inverse transform of the same length, without normalisation.
        inverse: Arc<dyn ComplexToReal<T>>,
        /// Twiddle factors of [`about_edge`]; `None` without a mirror.
        twiddles: Option<Vec<Complex<T>>>,
    },
    /// Half a row with a mirror through the centre of its first element.
    AboutCentre(CosineTransform<T>),
}

impl<T: Real> RowTransform<T> {
    /// Plans for rows of a period of `period` elements.
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

    /// Number of elements of a row that are transformed: the period, or the part of it in the symmetry-reduced domain.
    pub(super) fn len(&self) -> usize {
        match self {
            Self::Fourier { forward, .. } => forward.len(),
            Self::AboutCentre(cosines) => cosines.len(),
        }
    }

    /// True if rows are even about a mirror, so that their transform is real; two real coefficients share one complex number.
    pub(super) const fn is_symmetric(&self) -> bool {
        !matches!(self, Self::Fourier { twiddles: None, .. })
    }

    /// Number of complex numbers in which the coefficients are stored.
    pub(super) fn n_coefficients(&self) -> usize {
        if self.is_symmetric() {
            self.len().div_ceil(2)
        } else {
            self.len() / 2 + 1
        }
    }

    /// Number of complex numbers of scratch that both transforms need.
    pub(super) fn scratch_len(&self) -> usize {
        match self {
            Self::Fourier {
                forward, inverse, ..
            } => forward.get_scratch_len().max(inverse.get_scratch_len()),
            Self::AboutCentre(cosines) => cosines.plan().get_scratch_len(),
        }
    }

    /// Number of reals of the underlying real Fourier transform.
    pub(super) fn n_reals(&self) -> usize {
        match self {
            Self::Fourier { forward, .. } => forward.len(),
            Self::AboutCentre(cosines) => cosines.plan().len(),
        }
    }

    /// Real Fourier transform of a row of the whole period, without padding and without a mirror; `row` is overwritten.
    pub(super) fn forward_whole(&self, row: &mut [T], transformed: &mut [Complex<T>]) {
        assert!(!self.is_symmetric(), "a whole row");
        if let Self::Fourier { forward, .. } = self {
            let mut scratch = forward.make_scratch_vec();
            forward_real(&**forward, row, transformed, &mut scratch);
        }
    }

    /// Transforms a row of `values` padded with zeros; the coefficients are left in `half_row` of the buffers.
    pub(super) fn forward<F: Real>(&self, buffers: &mut Buffers<T>, values: &[F]) {
        match self {
            Self::Fourier {
                forward, twiddles, ..
            } => {
                match twiddles {
                    Some(_) => about_edge::reorder(values, &mut buffers.row),
                    None => copy_padded(&mut buffers.row, values),
                }
                forward_real(
                    &**forward,
                    &mut buffers.row,
                    &mut buffers.half_row,
                    &mut buffers.scratch,
                );
                if let Some(twiddles) = twiddles {
                    // Convert the complex coefficients to real cosine sums, and store these in pairs.
                    about_edge::to_cosine_sums(twiddles, &buffers.half_row, &mut buffers.row);
                    store_in_pairs(&buffers.row, &mut buffers.half_row);
                }
            }
            Self::AboutCentre(cosines) => {
                copy_padded(&mut buffers.row, values);
                // U_0 counts the half element x_0 on both sides of the mirror.
                buffers.row[0] *= T::rounded(2.0);
                cosines.apply(buffers);
                store_in_pairs(&buffers.row, &mut buffers.half_row);
            }
        }
    }

    /// Transforms the coefficients in `half_row` of the buffers back, without normalisation, and writes the first `values`.
    pub(super) fn inverse<F: Real>(&self, buffers: &mut Buffers<T>, values: &mut [F]) {
        match self {
            Self::Fourier {
                inverse, twiddles, ..
            } => {
                if let Some(twiddles) = twiddles {
                    // Split the pairs of real cosine sums, and convert these to complex coefficients.
                    split_pairs(&buffers.half_row, &mut buffers.row);
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
                // The cosine transform is its own inverse, but for the normalisation.
                split_pairs(&buffers.half_row, &mut buffers.row);
                cosines.apply(buffers);
            }
        }
        for (value, found) in values.iter_mut().zip(&buffers.row) {
            *value = F::rounded((*found).into());
        }
    }
}

/// Copies `values` into `row`, rounds them to its precision and pads with zeros.
fn copy_padded<T: Real, F: Real>(row: &mut [T], values: &[F]) {
    for (place, value) in row.iter_mut().zip(values) {
        *place = T::rounded((*value).into());
    }
    row[values.len()..].fill(T::default());
}

/// Stores each two neighbouring real numbers as one complex number; the last of an odd number has the imaginary part 0.
fn store_in_pairs<T: Real>(reals: &[T], pairs: &mut [Complex<T>]) {
    let (whole, rest) = reals.as_chunks::<2>();
    let alone = rest.iter().map(|&real| Complex::new(real, T::default()));
    let complete = whole.iter().map(|&[re, im]| Complex::new(re, im));
    for (place, pair) in pairs.iter_mut().zip(complete.chain(alone)) {
        *place = pair;
    }
}

/// Splits complex numbers into neighbouring real numbers: the inverse of [`store_in_pairs`].
fn split_pairs<T: Real>(pairs: &[Complex<T>], reals: &mut [T]) {
    for (reals, pair) in reals.chunks_mut(2).zip(pairs) {
        for (real, value) in reals.iter_mut().zip([pair.re, pair.im]) {
            *real = value;
        }
    }
}
