//! Real Fourier transforms of one row, with buffers of the right lengths.

use numerics::transforms::Real;
use realfft::{ComplexToReal, RealToComplex};
use rustfft::num_complex::Complex;

/// Transforms n `reals`, which are overwritten, into n/2 + 1 complex `coefficients`.
pub(super) fn forward_real<T: Real>(
    plan: &dyn RealToComplex<T>,
    reals: &mut [T],
    coefficients: &mut [Complex<T>],
    scratch: &mut [Complex<T>],
) {
    let done = plan.process_with_scratch(reals, coefficients, scratch);
    assert!(done.is_ok(), "the buffers fit the plan: {done:?}");
}

/// Transforms n/2 + 1 complex `coefficients`, which are overwritten, back into n `reals`, without normalisation.
pub(super) fn inverse_real<T: Real>(
    plan: &dyn ComplexToReal<T>,
    coefficients: &mut [Complex<T>],
    reals: &mut [T],
    scratch: &mut [Complex<T>],
) {
    // The first and, for even lengths, the last coefficient of a real row are real; the transform refuses imaginary rounding there.
    coefficients[0].im = T::default();
    if reals.len().is_multiple_of(2) {
        coefficients[reals.len() / 2].im = T::default();
    }
    let done = plan.process_with_scratch(coefficients, reals, scratch);
    assert!(done.is_ok(), "the buffers fit the plan: {done:?}");
}
