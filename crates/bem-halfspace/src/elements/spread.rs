//! The area of a contact as its loads know it, whose elements change sides one by one.
//!
//! The area is the limit of `∫ pˢ dA` for s = 0. Changes of
//!
//! ```text
//! L(s) = ln Σ xˢ
//! ```
//!
//! are sums over the elements for s = 1, 2, 3, of which the weights at the edge are small, and are carried on to 0 from there:
//! by `a + b s + c s/(1 + s/2)`, the change of pressures that are proportional to (1 − r²)^β around the β = 1/2 of smooth bodies,
//! and for comparison by a parabola.

/// Weights of L(1), L(2) and L(3), by either way.
const WEIGHTS: [[f64; 3]; 2] = [[4.5, -6.0, 2.5], [3.0, -3.0, 1.0]];

/// The derivatives of both measures of the logarithm of the area by each load; `sum` is that over all elements in contact.
pub(crate) fn measures_of_area(loads: &[f64], sum: impl Fn(&[f64]) -> f64) -> [Vec<f64>; 2] {
    let power = |exponent: i32| -> Vec<f64> {
        let powers = loads.iter().map(|load| load.powi(exponent));
        powers.collect()
    };
    let [first, second, third] = [1, 2, 3].map(|exponent| {
        let by_load = f64::from(exponent) / sum(&power(exponent));
        power(exponent - 1)
            .into_iter()
            .map(move |power| by_load * power)
    });
    let by_loads: Vec<[f64; 3]> = first
        .zip(second)
        .zip(third)
        .map(|((a, b), c)| [a, b, c])
        .collect();
    WEIGHTS.map(|weights| {
        let measure = |by_load: &[f64; 3]| -> f64 {
            let pairs = weights.iter().zip(by_load);
            pairs.map(|(weight, derivative)| weight * derivative).sum()
        };
        by_loads.iter().map(measure).collect()
    })
}
