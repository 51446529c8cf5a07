//! Transforms of one half of a row or column that is its own mirror image about its first element.
//!
//! With x_n at a distance of n elements from the mirror, x_0 for the half of the element in front of it, the Fourier
//! transform of the period of 2 L elements and the way back of the numbers u_n are
//!
//! ```text
//! U_k = 2 x_0 + 2 Σ x_n cos(π n k / L),        n, k = 0 … L,
//! u_n = U_0 + (−1)^n U_L + 2 Σ U_k cos(π n k / L),        0 < k < L.
//! ```
//!
//! Both are found from the Fourier transform Y of L numbers: with f_n for x_n, or for U_n,
//!
//! ```text
//! y_n = f_n + f_(L−n) − 2 sin(πn/L) (f_n − f_(L−n)),
//! F_2k = Re Y_k,    F_(2k+1) = F_(2k−1) − Im Y_k,    F_1 = f_0 − f_L + 2 Σ f_n cos(πn/L),    0 < n < L
//! ```
//!
//! are F_k = f_0 + (−1)^k f_L + 2 Σ f_n cos(πnk/L) (Cooley, Lewis & Welch 1970, DOI 10.1016/0022-460X(70)90075-1). The
//! sums of the imaginary parts let rounding grow with √L, to 1e-14 of the largest number for thousands of elements.

use std::f64::consts::PI;
use std::ops::{Add, Mul, Sub};

use rustfft::num_complex::Complex;

/// The numbers exp(iπn/L) for n = 0 … L/2.
pub(super) fn turns(length: usize) -> Vec<Complex<f64>> {
    let turn = |n| Complex::from_polar(1.0, PI * n as f64 / length as f64);
    (0..=length / 2).map(turn).collect()
}

/// Replaces f_0 … f_L by y_0 … y_(L−1) and something, and returns F_1.
pub(super) fn fold<T>(turns: &[Complex<f64>], numbers: &mut [T]) -> T
where
    T: Copy + Add<Output = T> + Sub<Output = T> + Mul<f64, Output = T>,
{
    let length = numbers.len() - 1;
    let (f_0, f_l) = (numbers[0], numbers[length]);
    numbers[0] = f_0 + f_l;
    let mut first = f_0 - f_l;
    let (front, back) = numbers[1..length].split_at_mut((length - 1) / 2);
    let pairs = front.iter_mut().zip(back.iter_mut().rev());
    for ((near, far), turn) in pairs.zip(&turns[1..]) {
        let (sum, difference) = (*near + *far, (*near - *far) * 2.0);
        first = first + difference * turn.re;
        *near = sum - difference * turn.im;
        *far = sum + difference * turn.im;
    }
    if length.is_multiple_of(2) {
        numbers[length / 2] = numbers[length / 2] * 2.0;
    }
    first
}

/// Writes F_0 … F_L from F_1 and the coefficients Y_0 … Y_(L/2) of a real transform.
pub(super) fn unfold_real(mut odd: f64, coefficients: &[Complex<f64>], numbers: &mut [f64]) {
    for (pair, coefficient) in numbers.chunks_mut(2).zip(coefficients) {
        odd -= coefficient.im;
        for (number, value) in pair.iter_mut().zip([coefficient.re, odd]) {
            *number = value;
        }
    }
}

/// Writes F_0 … F_L from F_1 and the coefficients Y_0 … Y_(L−1) of a complex transform: what belongs to the real parts of
/// the numbers and to the imaginary ones is that of even and odd sequences.
pub(super) fn unfold_complex(
    mut odd: Complex<f64>,
    coefficients: &[Complex<f64>],
    numbers: &mut [Complex<f64>],
) {
    let opposite = coefficients.iter().take(1).chain(coefficients.iter().rev());
    for (pair, (here, there)) in numbers.chunks_mut(2).zip(coefficients.iter().zip(opposite)) {
        let half_difference = 0.5 * (here - there);
        odd += Complex::new(-half_difference.im, half_difference.re);
        for (number, value) in pair.iter_mut().zip([0.5 * (here + there), odd]) {
            *number = value;
        }
    }
}
