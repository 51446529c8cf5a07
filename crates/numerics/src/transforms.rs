//! Plans of discrete Fourier transforms, without normalisation.
//!
//! A planner contains algorithms for all lengths, and every crate that calls it compiles them all, which takes longer than the
//! rest of that crate. Only this module calls it; the plans that it returns point to code that is compiled here.

use std::sync::Arc;

use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};
use rustfft::num_traits::{AsPrimitive as _, NumAssign};
use rustfft::{Fft, FftNum, FftPlanner};

/// Floating-point type of a transform: `f64` or `f32`.
pub trait Real: FftNum + NumAssign + Default + Into<f64> {
    /// The value rounded to this type.
    fn rounded(value: f64) -> Self;

    /// Plan of Σ f_n e^(−2πikn/N) of N complex numbers.
    fn forward(length: usize) -> Arc<dyn Fft<Self>>;

    /// Plan of Σ f_n e^(2πikn/N) of N complex numbers.
    fn inverse(length: usize) -> Arc<dyn Fft<Self>>;

    /// Plan of the first N/2 + 1 sums Σ f_n e^(−2πikn/N) of N real numbers; the others are their conjugates.
    fn real_forward(length: usize) -> Arc<dyn RealToComplex<Self>>;

    /// Plan of N real numbers Σ f_n e^(2πikn/N) from the first N/2 + 1 of N complex ones.
    fn real_inverse(length: usize) -> Arc<dyn ComplexToReal<Self>>;
}

macro_rules! implement_real {
    ($real:ty) => {
        impl Real for $real {
            fn rounded(value: f64) -> Self {
                value.as_()
            }

            fn forward(length: usize) -> Arc<dyn Fft<Self>> {
                FftPlanner::new().plan_fft_forward(length)
            }

            fn inverse(length: usize) -> Arc<dyn Fft<Self>> {
                FftPlanner::new().plan_fft_inverse(length)
            }

            fn real_forward(length: usize) -> Arc<dyn RealToComplex<Self>> {
                RealFftPlanner::new().plan_fft_forward(length)
            }

            fn real_inverse(length: usize) -> Arc<dyn ComplexToReal<Self>> {
                RealFftPlanner::new().plan_fft_inverse(length)
            }
        }
    };
}

implement_real!(f64);
implement_real!(f32);
