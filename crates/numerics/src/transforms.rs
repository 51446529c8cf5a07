//! Plans of Fourier transforms, not normalised.
//!
//! A planner knows algorithms for all lengths, and a crate that calls it compiles them all, which takes longer than the rest of
//! the crate. So it is called here alone; what comes back points to what is compiled here.

use std::sync::Arc;

use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};
use rustfft::{Fft, FftPlanner};

/// Σ f_n e^(−2πikn/N) of N complex numbers.
pub fn forward(length: usize) -> Arc<dyn Fft<f64>> {
    FftPlanner::new().plan_fft_forward(length)
}

/// Σ f_n e^(2πikn/N) of N complex numbers.
pub fn inverse(length: usize) -> Arc<dyn Fft<f64>> {
    FftPlanner::new().plan_fft_inverse(length)
}

/// The first N/2 + 1 sums Σ f_n e^(−2πikn/N) of N real numbers; the others are their conjugates.
pub fn real_forward(length: usize) -> Arc<dyn RealToComplex<f64>> {
    RealFftPlanner::new().plan_fft_forward(length)
}

/// N real numbers Σ f_n e^(2πikn/N) from the first N/2 + 1 of N complex ones.
pub fn real_inverse(length: usize) -> Arc<dyn ComplexToReal<f64>> {
    RealFftPlanner::new().plan_fft_inverse(length)
}
