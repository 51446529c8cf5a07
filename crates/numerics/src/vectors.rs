//! Sums over vectors, in their order.

use std::ops::{AddAssign, Mul};

/// Scalar product of two vectors of equal length.
pub fn dot(left: &[f64], right: &[f64]) -> f64 {
    let pairs = left.iter().zip(right);
    pairs.map(|(left, right)| left * right).sum()
}

/// Arithmetic mean.
pub fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

/// Adds `factor` times `values` to `sum` (axpy).
pub fn add_scaled<T>(sum: &mut [T], factor: T, values: &[T])
where
    T: Copy + Mul<Output = T> + AddAssign,
{
    for (sum, value) in sum.iter_mut().zip(values) {
        *sum += factor * *value;
    }
}
