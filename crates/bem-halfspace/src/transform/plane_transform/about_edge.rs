//! Discrete cosine transform of half a row or column that is its own mirror image about the edge of its first element (DCT-II).
//!
//! With x_n at the distances ±(n + ½) elements from the mirror, the Fourier transform of the period of 2 L elements is, up to a phase
//! that both directions share,
//!
//! ```text
//! U_k = 2 Σ x_n cos(π (n + ½) k / L),        n, k = 0 … L − 1.
//! ```
//!
//! In the order x_0, x_2, x_4 … x_5, x_3, x_1 it follows from the Fourier transform V of L elements (Makhoul 1980,
//! DOI 10.1109/TASSP.1980.1163351): with w_k = exp(−iπk/2L) and U_L = 0,
//!
//! ```text
//! U_k = w_k V_k + w̄_k V_(L−k),        V_k = w̄_k (U_k − i U_(L−k)) / 2.
//! ```

use std::f64::consts::PI;

use numerics::transforms::Real;
use rustfft::num_complex::Complex;

use crate::transform::plane_transform::rounded;

/// Twiddle factors w_k = exp(−iπk/2L) for k = 0 … L/2, with L = `length`.
pub(super) fn twiddles<T: Real>(length: usize) -> Vec<Complex<T>> {
    let twiddle = |k| {
        rounded(Complex::from_polar(
            1.0,
            -0.5 * PI * k as f64 / length as f64,
        ))
    };
    (0..=length / 2).map(twiddle).collect()
}

/// Index of `element` in the order x_0, x_2, x_4 … x_3, x_1 of the transform, for L = `length`.
pub(super) const fn ordered_index(element: usize, length: usize) -> usize {
    if element.is_multiple_of(2) {
        element / 2
    } else {
        length - 1 - element / 2
    }
}

/// Writes `values` to `ordered` in the order of the transform, padded with zeros to its length L.
pub(super) fn reorder<T: Real, F: Real>(values: &[F], ordered: &mut [T]) {
    ordered.fill(T::default());
    for (element, value) in values.iter().enumerate() {
        ordered[ordered_index(element, ordered.len())] = T::rounded((*value).into());
    }
}

/// Reads the first elements, as many as `values` has, from `ordered`, which is in the order of the transform.
pub(super) fn restore_order<T: Real, F: Real>(ordered: &[T], values: &mut [F]) {
    for (element, value) in values.iter_mut().enumerate() {
        *value = F::rounded(ordered[ordered_index(element, ordered.len())].into());
    }
}

/// Computes the real `numbers` U_0 … U_(L−1) of real x from `half` = V_0 … V_(L/2); V of real x is conjugate symmetric.
pub(super) fn to_cosine_sums<T: Real>(
    twiddles: &[Complex<T>],
    half: &[Complex<T>],
    numbers: &mut [T],
) {
    let length = numbers.len();
    for (k, (value, twiddle)) in half.iter().zip(twiddles).enumerate() {
        let rotated = value * twiddle * T::rounded(2.0);
        if k > 0 {
            numbers[length - k] = -rotated.im;
        }
        numbers[k] = rotated.re;
    }
}

/// Computes `half` = 2 V_0 … 2 V_(L/2) from the real `numbers` U_0 … U_(L−1).
pub(super) fn from_cosine_sums<T: Real>(
    twiddles: &[Complex<T>],
    numbers: &[T],
    half: &mut [Complex<T>],
) {
    let length = numbers.len();
    for (k, (value, twiddle)) in half.iter_mut().zip(twiddles).enumerate() {
        let opposite = if k > 0 {
            numbers[length - k]
        } else {
            T::default()
        };
        *value = twiddle.conj() * Complex::new(numbers[k], -opposite);
    }
}
