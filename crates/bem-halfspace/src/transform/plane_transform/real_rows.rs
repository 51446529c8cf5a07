//! Transforms of one real row.

use realfft::{ComplexToReal, RealToComplex};
use rustfft::num_complex::Complex;

pub(super) fn forward_real(
    plan: &dyn RealToComplex<f64>,
    (reals, coefficients): (&mut [f64], &mut [Complex<f64>]),
    scratch: &mut [Complex<f64>],
) {
    let done = plan.process_with_scratch(reals, coefficients, scratch);
    assert!(done.is_ok(), "the buffers fit the plan: {done:?}");
}

pub(super) fn inverse_real(
    plan: &dyn ComplexToReal<f64>,
    (coefficients, reals): (&mut [Complex<f64>], &mut [f64]),
    scratch: &mut [Complex<f64>],
) {
    // Rounding leaves imaginary parts where a real row has none, and the transform refuses them.
    coefficients[0].im = 0.0;
    if reals.len().is_multiple_of(2) {
        coefficients[reals.len() / 2].im = 0.0;
    }
    let done = plan.process_with_scratch(coefficients, reals, scratch);
    assert!(done.is_ok(), "the buffers fit the plan: {done:?}");
}
