//! Plans of Fourier transforms, not normalised.
//!
//! A planner knows algorithms for all lengths, and a crate that calls it compiles them all, which takes longer than the rest of
//! the crate. So it is called here alone; what comes back points to what is compiled here.

use std::sync::Arc;

use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};
use rustfft::num_traits::{AsPrimitive as _, NumAssign};
use rustfft::{Fft, FftNum, FftPlanner};

/// Numbers that are transformed.
pub trait Real: FftNum + NumAssign + Default + Into<f64> {
    /// The nearest of them.
    fn of(value: f64) -> Self;

    /// Σ f_n e^(−2πikn/N) of N complex numbers.
    fn forward(length: usize) -> Arc<dyn Fft<Self>>;

    /// Σ f_n e^(2πikn/N) of N complex numbers.
    fn inverse(length: usize) -> Arc<dyn Fft<Self>>;

    /// The first N/2 + 1 sums Σ f_n e^(−2πikn/N) of N real numbers; the others are their conjugates.
    fn real_forward(length: usize) -> Arc<dyn RealToComplex<Self>>;

    /// N real numbers Σ f_n e^(2πikn/N) from the first N/2 + 1 of N complex ones.
    fn real_inverse(length: usize) -> Arc<dyn ComplexToReal<Self>>;
}

macro_rules! transforms_of {
    ($real:ty) => {
        impl Real for $real {
            fn of(value: f64) -> Self {
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

transforms_of!(f64);
transforms_of!(f32);
