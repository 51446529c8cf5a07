//! Root of a function in a bracket, and minimum of a function in a bracket, both to the last digits.
//!
//! The root is found by Chandrupatla's method: inverse quadratic interpolation where it is safe, bisection elsewhere
//! (Chandrupatla 1997, Adv. Eng. Softw. 28, 145).

use std::convert::Infallible;

/// Finds x with `function(x) = 0` between two positions at which the function has opposite signs (or is zero).
///
/// The position is found to a few units in the last place. Returns `None` if the signs at both ends agree or one of
/// them is NaN.
pub fn bracketed_root(function: impl Fn(f64) -> f64, bracket: [f64; 2]) -> Option<f64> {
    let function = |x| Ok::<f64, Infallible>(function(x));
    try_bracketed_root(function, bracket).unwrap_or_else(|never| match never {})
}

/// Finds a root like [`bracketed_root`], for a function that may fail.
///
/// # Errors
/// The first error of the function.
pub fn try_bracketed_root<E>(
    function: impl Fn(f64) -> Result<f64, E>,
    bracket: [f64; 2],
) -> Result<Option<f64>, E> {
    let [mut b, mut a] = bracket;
    let (mut fa, mut fb) = (function(a)?, function(b)?);
    if fa == 0.0 {
        return Ok(Some(a));
    }
    if fb == 0.0 {
        return Ok(Some(b));
    }
    // `opposite` is false also when one of the two values is NaN.
    let opposite = fa * fb.signum() < 0.0;
    if !opposite {
        return Ok(None);
    }
    let mut fraction = 0.5;
    for _ in 0..MAX_ITERATIONS {
        // Evaluate in the bracket; a becomes the newest point, b the other end and c the point that has left.
        let x = a + fraction * (b - a);
        let fx = function(x)?;
        let (c, fc);
        if (fx > 0.0) == (fa > 0.0) {
            (c, fc) = (a, fa);
        } else {
            (c, fc) = (b, fb);
            (b, fb) = (a, fa);
        }
        (a, fa) = (x, fx);

        // Stop when the bracket is as short as rounding.
        let best = if fa.abs() < fb.abs() { a } else { b };
        let tolerance = f64::EPSILON * best.abs() / (b - a).abs();
        if fa == 0.0 || tolerance >= 0.5 || b - a == 0.0 {
            return Ok(Some(best));
        }

        // Interpolate where the inverse quadratic through the three points is monotone (Chandrupatla's criterion).
        let position = (a - b) / (c - b);
        let phi = (fa - fb) / (fc - fb);
        let interpolated =
            fa / (fb - fa) * fc / (fb - fc) + (c - a) / (b - a) * fa / (fc - fa) * fb / (fc - fb);
        let is_monotone = phi * phi < position && (1.0 - phi) * (1.0 - phi) < 1.0 - position;
        let is_safe = is_monotone && interpolated.is_finite();
        let step = if is_safe { interpolated } else { 0.5 };
        fraction = step.clamp(tolerance, 1.0 - tolerance);
    }
    Ok(Some(if fa.abs() < fb.abs() { a } else { b }))
}

/// Largest number of function values of a root search.
///
/// Bisection alone needs about 2100 halvings between the smallest and the largest number.
const MAX_ITERATIONS: usize = 2200;

/// Reciprocal (√5 − 1)/2 of the golden ratio, the factor by which a golden-section step shortens the bracket.
const INVERSE_GOLDEN_RATIO: f64 = 0.618_033_988_749_894_9;
/// Number of golden-section steps: its reduction 0.618⁸⁰ = 2e-17 exhausts the digits of the bracket.
const GOLDEN_SECTION_STEPS: usize = 80;

/// The position of the minimum of a function with a single minimum in a bracket, by golden-section search to the last digits.
pub fn golden_section(function: impl Fn(f64) -> f64, [mut low, mut high]: [f64; 2]) -> f64 {
    for _ in 0..GOLDEN_SECTION_STEPS {
        let inner = INVERSE_GOLDEN_RATIO * (high - low);
        if function(high - inner) <= function(low + inner) {
            high = low + inner;
        } else {
            low = high - inner;
        }
    }
    low.midpoint(high)
}

#[cfg(test)]
mod tests {
    use std::cell::Cell;

    use super::*;
    use approx::assert_relative_eq;

    #[test]
    fn a_tiny_root_is_as_accurate_as_a_large_one() {
        for scale in [1e-250, 1e-9, 1.0, 1e200] {
            let count = Cell::new(0);
            let cubic = |x: f64| {
                count.set(count.get() + 1);
                (x / scale).powi(3) - 2.0
            };
            let over_scale = bracketed_root(cubic, [0.0, 5.0 * scale]).expect("a root") / scale;
            assert_relative_eq!(over_scale, 2.0_f64.cbrt(), max_relative = 4e-16);
            assert!(count.get() <= 10, "bisection takes 54: {}", count.get());
        }
    }

    #[test]
    fn interpolation_takes_few_steps_from_wide_brackets() {
        type Case = (fn(f64) -> f64, [f64; 2], f64, usize);
        let cases: [Case; 3] = [
            (|x| x.exp() - 2.0, [-20.0, 30.0], 2.0_f64.ln(), 13),
            (|x| x.cos() - x, [0.0, 2.0], 0.739_085_133_215_160_6, 8),
            (|x| (x - 1.0).atan(), [-50.0, 100.0], 1.0, 15),
        ];
        for (function, bracket, expected, max_steps) in cases {
            let count = Cell::new(0);
            let counted = |x: f64| {
                count.set(count.get() + 1);
                function(x)
            };
            let root = bracketed_root(counted, bracket).expect("a root");
            assert_relative_eq!(root, expected, max_relative = 4e-16);
            let count = count.get();
            assert!(count <= max_steps, "{count} steps from {bracket:?}");
        }
    }

    #[test]
    fn equal_signs_have_no_root() {
        let root = bracketed_root(|x| x * x + 1.0, [-1.0, 1.0]);
        assert_eq!(root, None, "x^2 + 1 has no root");
    }
}
