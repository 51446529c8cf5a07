//! Waves of functions of one variable.

/// Angles below which sin θ/θ and its derivative are the first terms of their series, to 1e-16.
const SMALL: f64 = 1e-2;

/// |∫ f e^(ikx) dx|² of a function that is straight between `points` [x, f] at positions that do not decrease, and 0 outside
/// of them; two points at the same position are a jump.
///
/// ```text
/// ∫ f e^(ikx) dx over [m − l, m + l] = l e^(ikm) [(f₁ + f₀) sin θ/θ + i (f₁ − f₀) (sin θ/θ − cos θ)/θ],        θ = k l
/// ```
pub fn wave_power(points: &[[f64; 2]], wave: f64) -> f64 {
    let [mut real, mut imaginary] = [0.0; 2];
    for pair in points.windows(2) {
        let [[start, from], [end, to]] = [pair[0], pair[1]];
        let half = 0.5 * (end - start);
        let [even, odd] = moments(wave * half);
        let [even, odd] = [(to + from) * even, (to - from) * odd];
        let (sine, cosine) = (0.5 * wave * (start + end)).sin_cos();
        real += half * (even * cosine - odd * sine);
        imaginary += half * (even * sine + odd * cosine);
    }
    real * real + imaginary * imaginary
}

/// The spherical Bessel functions j₀ and j₁.
fn moments(angle: f64) -> [f64; 2] {
    if angle.abs() < SMALL {
        let square = angle * angle;
        let even = 1.0 - square / 6.0 * (1.0 - square / 20.0);
        let odd = angle / 3.0 * (1.0 - square / 10.0 * (1.0 - square / 28.0));
        return [even, odd];
    }
    let (sine, cosine) = angle.sin_cos();
    let even = sine / angle;
    [even, (even - cosine) / angle]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A step of the width 2 has (2 sin k/k)², a triangle the square of that of its half width.
    #[test]
    fn steps_and_triangles_have_their_waves() {
        for wave in [1e-4_f64, 0.02, 0.5, 3.0, 1e3] {
            let of_step = (2.0 * wave.sin() / wave).powi(2);
            let step = [[4.0, 1.0], [4.5, 1.0], [6.0, 1.0]];
            let triangle = [[-2.0, 0.0], [0.0, 2.0], [0.0, 2.0], [2.0, 0.0]];
            for (points, expected) in [(&step[..], of_step), (&triangle, of_step * of_step)] {
                let power = wave_power(points, wave);
                let is_near = (power - expected).abs() <= 1e-11 * expected.max(1.0 / wave);
                assert!(is_near, "{wave}: {power}, {expected}");
            }
        }
    }
}
