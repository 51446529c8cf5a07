//! Transforms of one real row.

use numerics::transforms::Real;
use realfft::{ComplexToReal, RealToComplex};
use rustfft::num_complex::Complex;

pub(super) fn forward_real<T: Real>(
    plan: &dyn RealToComplex<T>,
    reals: &mut [T],
    coefficients: &mut [Complex<T>],
    scratch: &mut [Complex<T>],
) {
    let done = plan.process_with_scratch(reals, coefficients, scratch);
    assert!(done.is_ok(), "the buffers fit the plan: {done:?}");
}

pub(super) fn inverse_real<T: Real>(
    plan: &dyn ComplexToReal<T>,
    coefficients: &mut [Complex<T>],
    reals: &mut [T],
    scratch: &mut [Complex<T>],
) {
    // Rounding leaves imaginary parts where a real row has none, and the transform refuses them.
    coefficients[0].im = T::default();
    if reals.len().is_multiple_of(2) {
        coefficients[reals.len() / 2].im = T::default();
    }
    let done = plan.process_with_scratch(coefficients, reals, scratch);
    assert!(done.is_ok(), "the buffers fit the plan: {done:?}");
}
