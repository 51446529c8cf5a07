//! Exponentials of relaxation with their means and moments, to their own rounding.
//!
//! ```text
//! e^(−x),   ∫₀¹ e^(−x θ) dθ,   ∫₀¹ e^(−z (1 − θ)) θ^j dθ
//! ```

/// Exponential e^(−x) at x ≥ 0, without the slow evaluation of the library for results below the smallest number.
#[inline]
pub(crate) fn decay(x: f64) -> f64 {
    if x > EXP_UNDERFLOW { 0.0 } else { (-x).exp() }
}

/// Exponential e^(−x) at x ≥ 0 and its mean (1 − e^(−x))/x over [0, x], in this order, each to its own rounding: both may
/// multiply a large force.
#[inline]
pub(crate) fn decay_and_mean(x: f64) -> [f64; 2] {
    if x > 1.0 {
        let decay = decay(x);
        return [decay, (1.0 - decay) / x];
    }
    let mean = if x > SERIES_MAX_ARGUMENT {
        (1.0 - (-x).exp()) / x
    } else if x < SHORT_SERIES_MAX_ARGUMENT {
        series::<N_SHORT_SERIES_TERMS>(-x)
    } else {
        series::<N_SERIES_TERMS>(-x)
    };
    [1.0 - x * mean, mean]
}

/// Exponential e^(−x) at x ≥ 0, given its mean (1 − e^(−x))/x; up to x = 1 no further exponential is computed.
#[inline]
pub(crate) fn decay_from_mean(x: f64, mean: f64) -> f64 {
    if x > 1.0 { decay(x) } else { 1.0 - x * mean }
}

/// The first N terms of the mean of e^x, Σ x^n/(n + 1)!. Even and odd ones are summed apart, so that the processor computes
/// both together.
#[inline]
fn series<const N: usize>(x: f64) -> f64 {
    let square = x * x;
    let [mut even, mut odd] = [0.0; 2];
    for n in (0..N / 2).rev() {
        even = even * square + RECIPROCAL_FACTORIALS[2 * n];
        odd = odd * square + RECIPROCAL_FACTORIALS[2 * n + 1];
    }
    even + x * odd
}

/// Argument x from which on e^(−x) is less than the smallest positive number, −ln(2^−1075) = 745.13.
const EXP_UNDERFLOW: f64 = 745.2;
/// Argument up to which the mean of e^(−x) is summed as a power series. Chosen: below it the closed form (1 − e^(−x))/x loses 1.3
/// or more binary digits by cancellation. With a larger argument the series needs more than [`N_SERIES_TERMS`].
const SERIES_MAX_ARGUMENT: f64 = 0.5;
/// Number of terms in the series of the mean of e^(−x) up to [`SERIES_MAX_ARGUMENT`]: the first one left out is 0.5^14/15! =
/// 5e-17.
const N_SERIES_TERMS: usize = 14;
/// Argument up to which [`N_SHORT_SERIES_TERMS`] terms of the series are as accurate as all. Chosen: it changes the time only.
const SHORT_SERIES_MAX_ARGUMENT: f64 = 0.02;
/// Number of terms in the series of the mean of e^(−x) up to [`SHORT_SERIES_MAX_ARGUMENT`]: the first one left out is 0.02^8/9!
/// = 7e-20.
const N_SHORT_SERIES_TERMS: usize = 8;

/// 1/(n + 1)!, the coefficients of the mean of e^x.
const RECIPROCAL_FACTORIALS: [f64; N_SERIES_TERMS] = {
    let mut factors = [1.0; N_SERIES_TERMS];
    let mut n = 1;
    while n < N_SERIES_TERMS {
        factors[n] = factors[n - 1] / (n + 1) as f64;
        n += 1;
    }
    factors
};

/// Reciprocals 1/n; the entry of n = 0 is 0 and not used. The series in [`moments`] ends at rounding before the last one.
pub(crate) const RECIPROCALS: [f64; 64] = {
    let mut reciprocals = [0.0; 64];
    let mut n = 1;
    while n < 64 {
        reciprocals[n] = 1.0 / n as f64;
        n += 1;
    }
    reciprocals
};

/// Moments μ_j = ∫₀¹ e^(−z (1 − θ)) θ^j dθ for j = 0, 1, …, to rounding at every z ≥ 0: one for each entry of `moments`, which has
/// at least one.
///
/// The recurrence μ_j = (1 − j μ_(j−1))/z goes upwards to j ≤ z and downwards from the last one, each where it does not
/// amplify errors.
pub(crate) fn moments(z: f64, moments: &mut [f64]) {
    let last = moments.len() - 1;

    // The upward recurrence gives μ_j for j ≤ z: it multiplies an error of μ_(j−1) by j/z, which is at most 1.
    moments[0] = decay_and_mean(z)[1];
    let mut order = 1;
    while order <= last && (order as f64) <= z {
        moments[order] = (1.0 - order as f64 * moments[order - 1]) / z;
        order += 1;
    }
    if order > last {
        return;
    }

    // The last moment, of order n, is the series 1/(n+1) − z/((n+1)(n+2)) + …, whose terms fall from the first on; 50 of them
    // reach rounding. The downward recurrence then gives the moments in between.
    let mut term = RECIPROCALS[last + 1];
    let mut sum = term;
    for reciprocal in &RECIPROCALS[last + 2..] {
        term *= -z * reciprocal;
        sum += term;
        if term.abs() <= 1e-17 * sum {
            break;
        }
    }
    moments[last] = sum;
    for order in (order + 1..=last).rev() {
        moments[order - 1] = (1.0 - z * moments[order]) * RECIPROCALS[order];
    }
}
