//! Products with the transform of a kernel that is even along both axes, and therefore real.
//!
//! With a mirror along y the coefficients of rows are real, and two of them form one complex number (`rows.rs`). A complex column
//! then is a pair of real columns, each with factors of its own.

use rustfft::num_complex::Complex;

use crate::elements::mirror::Mirror;
use crate::transform::plane_transform::PlaneTransform;

impl PlaneTransform {
    /// Multiplies column number `column` of a transformed field, `values`, by the `spectrum` of the kernel over the whole period, which
    /// has the layout [column][0..=padded_x / 2].
    pub(crate) fn multiply_even(
        &self,
        spectrum: &[f64],
        column: usize,
        values: &mut [Complex<f64>],
    ) {
        let length = self.padded[0] / 2 + 1;
        let factors = |column: usize| &spectrum[column * length..][..length];
        let factors_of_pair = || {
            // An odd number of real coefficients leaves the last pair with one of them.
            let last = self.padded[1] / 2;
            [2 * column, 2 * column + 1].map(|column| factors(column.min(last)))
        };
        let has_real_pairs = self.rows.is_symmetric();
        let both = if has_real_pairs {
            factors_of_pair()
        } else {
            [factors(column); 2]
        };
        match self.columns.mirror {
            Mirror::None if has_real_pairs => multiply_pair(both, values),
            Mirror::None => multiply_whole(both[0], values),
            Mirror::Centre => multiply_pair_even_about_centre(both, values),
            Mirror::Edge => multiply_pair_even_about_edge(both, &self.columns.twiddles, values),
        }
    }
}

/// Multiplies a complex column without symmetry by real factors that are even in the row; `factors` are those of the rows 0 to n/2.
fn multiply_whole(factors: &[f64], values: &mut [Complex<f64>]) {
    let (lower, upper) = values.split_at_mut(factors.len());
    for (value, factor) in lower.iter_mut().zip(factors) {
        *value *= factor;
    }
    for (value, factor) in upper.iter_mut().rev().zip(&factors[1..]) {
        *value *= factor;
    }
}

/// Multiplies the transform of a column whose real and imaginary parts are two real columns, each by its own real, even factors.
///
/// With the values V_k and V_(−k), the transforms of both columns are (V_k ± V̄_(−k))/2, the second times i.
fn multiply_pair(factors: [&[f64]; 2], values: &mut [Complex<f64>]) {
    // V_k and V_(−k) together contain both columns, so that they change together.
    let length = values.len();
    for (k, (first, second)) in factors[0].iter().zip(factors[1]).enumerate() {
        let opposite = (length - k) % length;
        let (mean, half_difference) = (0.5 * (first + second), 0.5 * (first - second));
        let [here, there] = [values[k], values[opposite]];
        values[k] = mean * here + half_difference * there.conj();
        values[opposite] = mean * there + half_difference * here.conj();
    }
}

/// Multiplies two real columns that are even about an element centre, whose real transforms are stored as real and imaginary part, each by
/// its own factors.
fn multiply_pair_even_about_centre(factors: [&[f64]; 2], values: &mut [Complex<f64>]) {
    for (value, (real, imaginary)) in values.iter_mut().zip(factors[0].iter().zip(factors[1])) {
        *value = Complex::new(value.re * real, value.im * imaginary);
    }
}

/// Multiplies two real columns that are even about an element edge, each by its own factors: the real and imaginary part of the cosine sums
/// U_k, in the notation of [`about_edge`](super::about_edge).
fn multiply_pair_even_about_edge(
    factors: [&[f64]; 2],
    twiddles: &[Complex<f64>],
    values: &mut [Complex<f64>],
) {
    let length = values.len();
    let [real, imaginary] = factors;
    let pairs = real.iter().zip(imaginary);
    let product = |value: Complex<f64>, (real, imaginary): (&f64, &f64)| {
        Complex::new(value.re * real, value.im * imaginary)
    };
    let pair = |twiddle: Complex<f64>, [here, there]: [Complex<f64>; 2], [one, other]: [_; 2]| {
        // Convert V_k and V_(L−k) to the cosine sums U_k and U_(L−k), multiply these by their factors, and convert them back.
        let [here, there] = [twiddle * here, twiddle.conj() * there];
        let sum = product(here + there, one);
        // U_(L−k) is i times the difference, and is transformed back with −i.
        let difference = product(times_i(here - there), other);
        [
            twiddle.conj() * (sum - times_i(difference)),
            twiddle * (sum + times_i(difference)),
        ]
    };
    // The cosine sum U_0 has no opposite and is multiplied alone.
    values[0] = product(2.0 * values[0], (&real[0], &imaginary[0]));
    let (lower, upper) = values[1..].split_at_mut(length / 2);
    // List the factors of the opposite cosine sums U_(L−k) for k = 1, 2, …
    let opposite = pairs.clone().rev().skip(real.len() - length);
    let opposite_values = lower.iter_mut().zip(upper.iter_mut().rev());
    for ((twiddle, (here, there)), (one, other)) in twiddles[1..]
        .iter()
        .zip(opposite_values)
        .zip(pairs.skip(1).zip(opposite))
    {
        [*here, *there] = pair(*twiddle, [*here, *there], [one, other]);
    }
    if length.is_multiple_of(2) {
        // For even L, U_(L/2) is its own opposite.
        let middle = length / 2;
        let both = [(&real[middle], &imaginary[middle]); 2];
        values[middle] = pair(twiddles[middle], [values[middle]; 2], both)[1];
    }
}

/// Product of a complex number and the imaginary unit.
fn times_i(value: Complex<f64>) -> Complex<f64> {
    Complex::new(-value.im, value.re)
}
