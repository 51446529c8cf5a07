//! Discrete cosine transform of half a row or column that is its own mirror image about the centre of its first element (DCT-I).
//!
//! With x_n at the distances ±n elements from the mirror, and x_0 for half the element on it, the Fourier transform of the
//! period of 2 L elements and its inverse u_n are
//!
//! ```text
//! U_k = 2 x_0 + 2 Σ x_n cos(π n k / L),        n, k = 0 … L,
//! u_n = U_0 + (−1)^n U_L + 2 Σ U_k cos(π n k / L),        0 < k < L.
//! ```
//!
//! Both are sums F_k = f_0 + (−1)^k f_L + 2 Σ f_n cos(πnk/L), which the Fourier transform of the period has as its real
//! coefficients. A transform Y of L numbers is enough, with
//!
//! ```text
//! y_n = f_n + f_(L−n) − 2 sin(πn/L) (f_n − f_(L−n)),
//! F_2k = Re Y_k,    F_(2k+1) = F_(2k−1) − Im Y_k,    mean of F_1, F_3 … F_(2L−1) = f_0 − f_L
//! ```
//!
//! (Cooley, Lewis & Welch 1970, DOI 10.1016/0022-460X(70)90075-1, except for the mean). The small sines in y_n amplify rounding by
//! about L: up to 1e-14 of the largest number for L = [`MAX_FOLDED_LENGTH`]. Longer periods are transformed as a whole.

use std::f64::consts::PI;
use std::sync::Arc;

use numerics::transforms::Real;
use realfft::RealToComplex;
use rustfft::num_complex::Complex;

use crate::transform::plane_transform::real_rows::forward_real;
use crate::transform::plane_transform::workspace::Buffers;

/// Largest L for which L numbers are transformed instead of the period of 2 L. Chosen: the rounding error grows like L (head of this
/// file); longer periods are transformed as a whole, which takes about twice as long.
const MAX_FOLDED_LENGTH: usize = 512;

/// Plan of the sums F_k of real numbers f_n.
#[derive(Clone)]
pub(super) struct CosineTransform<T> {
    /// Real Fourier transform of L numbers, or of the period of 2 L.
    plan: Arc<dyn RealToComplex<T>>,
    /// Sines sin(πn/L) for n = 0 … L/2; `None` if the whole period is transformed.
    sines: Option<Vec<T>>,
}

impl<T: Real> CosineTransform<T> {
    /// Plan for values f_0 … f_L with L = `length`.
    pub(super) fn new(length: usize) -> Self {
        let sine = |n| T::rounded((PI * n as f64 / length as f64).sin());
        if length > MAX_FOLDED_LENGTH {
            return Self {
                plan: T::real_forward(2 * length),
                sines: None,
            };
        }
        Self {
            plan: T::real_forward(length),
            sines: Some((0..=length / 2).map(sine).collect()),
        }
    }

    /// Number of values f_n, L + 1.
    pub(super) fn len(&self) -> usize {
        let transformed = self.plan.len();
        1 + self.sines.as_ref().map_or(transformed / 2, |_| transformed)
    }

    /// The underlying real Fourier transform, of L or 2 L numbers.
    pub(super) fn plan(&self) -> &dyn RealToComplex<T> {
        &*self.plan
    }

    /// Replaces f_0 … f_L by F_0 … F_L in the row of the buffers.
    pub(super) fn apply(&self, buffers: &mut Buffers<T>) {
        let (numbers, reals) = (&mut buffers.row, &mut buffers.folded);
        let (coefficients, scratch) = (&mut buffers.half_row, &mut buffers.scratch);
        if let Some(sines) = &self.sines {
            // Transform L numbers only. The odd sums follow from differences and their known mean.
            let mean = numbers[0] - numbers[reals.len()];
            sums_and_differences(sines, numbers, reals);
            forward_real(&*self.plan, reals, coefficients, scratch);
            cosine_sums(coefficients, mean, numbers);
        } else {
            // Transform the whole period of 2 L numbers, whose coefficients are real.
            unfold(numbers, reals);
            forward_real(&*self.plan, reals, coefficients, scratch);
            for (number, coefficient) in numbers.iter_mut().zip(coefficients) {
                *number = coefficient.re;
            }
        }
    }
}

/// Computes y_0 … y_(L−1) from f_0 … f_L (head of this file).
fn sums_and_differences<T: Real>(sines: &[T], numbers: &[T], folded: &mut [T]) {
    // The pair n and L − n has one sum and one difference; n = L/2 is its own partner.
    let length = folded.len();
    for (n, &sine) in sines.iter().enumerate() {
        let [near, far] = [numbers[n], numbers[length - n]];
        let (sum, difference) = (near + far, T::rounded(2.0) * sine * (near - far));
        if n > 0 {
            folded[length - n] = sum + difference;
        }
        folded[n] = sum - difference;
    }
}

/// Computes F_0 … F_L from Y_0 … Y_(L/2) and the `mean` of the F_k with odd k (head of this file).
fn cosine_sums<T: Real>(coefficients: &[Complex<T>], mean: T, numbers: &mut [T]) {
    // Take the even sums directly from the coefficients, and the odd ones from cumulative differences up to a constant.
    let (mut odd, mut total) = (T::default(), T::default());
    for (pair, coefficient) in numbers.chunks_mut(2).zip(coefficients) {
        odd -= coefficient.im;
        pair[0] = coefficient.re;
        if let Some(number) = pair.get_mut(1) {
            *number = odd;
            total += odd;
        }
    }
    let length = numbers.len() - 1;
    if !length.is_multiple_of(2) {
        // In the period F_L occurs once, all other odd terms twice.
        total -= T::rounded(0.5) * odd;
    }
    // The constant follows from the mean of the odd sums.
    let shift = mean - total * T::rounded(2.0) / T::rounded(length as f64);
    for number in numbers.iter_mut().skip(1).step_by(2) {
        *number += shift;
    }
}

/// Extends f_0 … f_L by its mirror image f_(L−1) … f_1 to the whole period of 2 L values.
pub(super) fn unfold<T: Copy>(numbers: &[T], period: &mut [T]) {
    period[..numbers.len()].copy_from_slice(numbers);
    let images = numbers[1..].iter().rev().skip(1);
    for (place, image) in period[numbers.len()..].iter_mut().zip(images) {
        *place = *image;
    }
}
