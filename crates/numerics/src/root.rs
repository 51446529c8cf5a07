//! A bracketed root, to a relative tolerance.
//!
//! Chandrupatla's method: inverse quadratic interpolation where it is safe, bisection elsewhere (Chandrupatla 1997,
//! Adv. Eng. Softw. 28, 145).

use std::convert::Infallible;

/// Finds x with `function(x) = 0` between two positions at which the function has opposite signs (or is zero).
///
/// The position is found to a few units in the last place. Returns `None` when the signs at both ends agree or one of
/// them is NaN.
pub fn bracketed_root(function: impl Fn(f64) -> f64, bracket: [f64; 2]) -> Option<f64> {
    let function = |x| Ok::<f64, Infallible>(function(x));
    try_bracketed_root(function, bracket).unwrap_or_else(|never| match never {})
}

/// Like [`bracketed_root`], of a function that may fail.
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
    // False also when one of them is NaN.
    let opposite = fa * fb.signum() < 0.0;
    if !opposite {
        return Ok(None);
    }
    let mut fraction = 0.5;
    for _ in 0..MAX_ITERATIONS {
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
        let best = if fa.abs() < fb.abs() { a } else { b };
        let tolerance = f64::EPSILON * best.abs() / (b - a).abs();
        if fa == 0.0 || tolerance >= 0.5 || b - a == 0.0 {
            return Ok(Some(best));
        }
        let position = (a - b) / (c - b);
        let phi = (fa - fb) / (fc - fb);
        let interpolated =
            fa / (fb - fa) * fc / (fb - fc) + (c - a) / (b - a) * fa / (fc - fa) * fb / (fc - fb);
        let safe = phi * phi < position && (1.0 - phi) * (1.0 - phi) < 1.0 - position;
        let safe = safe && interpolated.is_finite();
        fraction = if safe { interpolated } else { 0.5 };
        fraction = fraction.clamp(tolerance, 1.0 - tolerance);
    }
    Ok(Some(if fa.abs() < fb.abs() { a } else { b }))
}

/// Bisection alone needs about 2100 halvings between the smallest and the largest number.
const MAX_ITERATIONS: usize = 2200;

/// The position of the minimum of a function that has one in a bracket, by golden section to the last digits.
pub fn golden_section(function: impl Fn(f64) -> f64, [mut low, mut high]: [f64; 2]) -> f64 {
    const GOLDEN: f64 = 0.618_033_988_749_894_9;
    // Each pass shortens the bracket by the golden ratio; 80 passes exhaust the digits.
    const PASSES: usize = 80;
    for _ in 0..PASSES {
        let inner = GOLDEN * (high - low);
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
        for (function, bracket, expected, most) in cases {
            let count = Cell::new(0);
            let counted = |x: f64| {
                count.set(count.get() + 1);
                function(x)
            };
            let root = bracketed_root(counted, bracket).expect("a root");
            assert_relative_eq!(root, expected, max_relative = 4e-16);
            let count = count.get();
            assert!(count <= most, "{count} steps from {bracket:?}");
        }
    }

    #[test]
    fn equal_signs_are_refused() {
        let root = bracketed_root(|x| x * x + 1.0, [-1.0, 1.0]);
        assert_eq!(root, None, "x^2 + 1 has no root");
    }
}
