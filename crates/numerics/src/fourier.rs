//! Fourier transform of a piecewise linear function.

/// Largest angle at which the series of j₀ and j₁ are used; the first terms left out are at most 2e-16 of the functions there.
const MAX_SERIES_ANGLE: f64 = 1e-2;

/// Power spectrum |∫ f e^(ikx) dx|² of a piecewise linear function f at the wave number k.
///
/// The function is linear between `points` [x, f], whose positions do not decrease, and 0 outside of them. Two points at one
/// position are a jump. The unit is the square of that of x f; the wave number has the unit of 1/x.
///
/// ```text
/// ∫ f e^(ikx) dx over [m − l, m + l] = l e^(ikm) [(f₁ + f₀) sin θ/θ + i (f₁ − f₀) (sin θ/θ − cos θ)/θ],        θ = k l
/// ```
pub fn fourier_power(points: &[[f64; 2]], wave_number: f64) -> f64 {
    let [mut real, mut imaginary] = [0.0; 2];
    // Sum the transforms of the linear pieces, about their midpoints.
    for pair in points.windows(2) {
        let [[start, from], [end, to]] = [pair[0], pair[1]];
        let half = 0.5 * (end - start);
        let [j0, j1] = spherical_bessel(wave_number * half);
        let [even, odd] = [(to + from) * j0, (to - from) * j1];
        let (sine, cosine) = (0.5 * wave_number * (start + end)).sin_cos();
        real += half * (even * cosine - odd * sine);
        imaginary += half * (even * sine + odd * cosine);
    }
    real * real + imaginary * imaginary
}

/// The spherical Bessel functions j₀ = sin θ/θ and j₁ = (sin θ/θ − cos θ)/θ.
fn spherical_bessel(angle: f64) -> [f64; 2] {
    if angle.abs() < MAX_SERIES_ANGLE {
        let square = angle * angle;
        let j0 = 1.0 - square / 6.0 * (1.0 - square / 20.0);
        let j1 = angle / 3.0 * (1.0 - square / 10.0 * (1.0 - square / 28.0));
        return [j0, j1];
    }
    let (sine, cosine) = angle.sin_cos();
    let j0 = sine / angle;
    [j0, (j0 - cosine) / angle]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A step of width 2 has (2 sin k/k)²; the triangle of half width 2 and height 2 has the square of that.
    #[test]
    fn steps_and_triangles_have_their_transforms() {
        for wave_number in [1e-4_f64, 0.02, 0.5, 3.0, 1e3] {
            let step_power = (2.0 * wave_number.sin() / wave_number).powi(2);
            let step = [[4.0, 1.0], [4.5, 1.0], [6.0, 1.0]];
            let triangle = [[-2.0, 0.0], [0.0, 2.0], [0.0, 2.0], [2.0, 0.0]];
            for (points, expected) in [
                (&step[..], step_power),
                (&triangle, step_power * step_power),
            ] {
                let power = fourier_power(points, wave_number);
                let is_near = (power - expected).abs() <= 1e-11 * expected.max(1.0 / wave_number);
                assert!(is_near, "{wave_number}: {power}, {expected}");
            }
        }
    }
}
