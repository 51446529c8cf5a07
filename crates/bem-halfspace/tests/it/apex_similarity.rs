//! Next to p = 1/2 the friction of a cusp comes from its apex, where the solution is similar to itself: an angular
//! problem that knows no grid of elements. The tabulated function s(p) approaches the limit that follows from it.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use friction_analytic::scaling_factor;
use nalgebra::{DMatrix, DVector};

use crate::support::{assert_near, power};

/// Angular elements between −π/2 and π/2.
const ANGULAR_ELEMENTS: usize = 200;

/// Complete elliptic integral K of the complementary parameter, by the arithmetic-geometric mean.
fn elliptic_k(complementary_parameter: f64) -> f64 {
    let [mut a, mut b] = [1.0, complementary_parameter.sqrt()];
    while (a - b).abs() > 1e-15 * a {
        [a, b] = [0.5 * (a + b), (a * b).sqrt()];
    }
    FRAC_PI_2 / a
}

/// ∫ 2 K(cos²(φ/2)) dφ over the element at a distance of `steps` elements: the logarithm in closed form, the rest by
/// Simpson's rule.
fn influence(steps: usize, width: f64) -> f64 {
    let centre = steps as f64 * width;
    let smooth = |angle: f64| {
        let sine = (0.5 * angle).sin();
        2.0 * elliptic_k(sine * sine) + 2.0 * angle.abs().ln()
    };
    let logarithm = |angle: f64| angle * angle.abs().ln() - angle;
    let [left, right] = [centre - 0.5 * width, centre + 0.5 * width];
    let middle = if steps == 0 { 1e-8 } else { centre };
    let rest = width / 6.0 * (smooth(left) + 4.0 * smooth(middle) + smooth(right));
    rest - 2.0 * (logarithm(right) - logarithm(left))
}

/// θ and f(θ) ≥ 0 with ∫ k f dθ' = 2π cos θ where f > 0, on the elements of the wedge that is left.
fn wedge() -> Vec<(f64, f64)> {
    let width = PI / ANGULAR_ELEMENTS as f64;
    let angle = |element: usize| (element as f64 + 0.5) * width - FRAC_PI_2;
    let mut contact: Vec<usize> = (0..ANGULAR_ELEMENTS).collect();
    loop {
        let n = contact.len();
        let steps = |row: usize, column: usize| contact[row].abs_diff(contact[column]);
        let matrix = DMatrix::from_fn(n, n, |row, column| influence(steps(row, column), width));
        let right = DVector::from_fn(n, |row, _| TAU * angle(contact[row]).cos());
        let solution = matrix.lu().solve(&right).expect("regular equations");
        let pushes = |row: &usize| solution[*row] >= 0.0;
        let left: Vec<usize> = (0..n).filter(pushes).map(|row| contact[row]).collect();
        if left.len() == n {
            let pressed = |row: usize| (angle(contact[row]), solution[row]);
            return (0..n).map(pressed).collect();
        }
        contact = left;
    }
}

#[test]
fn the_scaling_factor_of_sharp_cusps_follows_from_the_apex() {
    let (wedge, width) = (wedge(), PI / ANGULAR_ELEMENTS as f64);
    let integral: f64 = wedge.iter().map(|(angle, f)| f * angle.cos()).sum();
    // h̃ = κ c |x|^p, Eq. (9).
    let stretch = power(1.0, 0.5).stretch();
    let limit = integral * width / (2.0 * stretch * stretch);
    let last = wedge.iter().map(|(angle, _)| *angle).fold(0.0, f64::max);
    let edge = (last + 0.5 * width).to_degrees();
    assert_near("opening of the wedge", edge, 43.0, 0.5);
    // s(p) is smooth in 2p − 1: two values extrapolate to the limit.
    let [near, far] = [0.501, 0.503].map(|p| scaling_factor(p).expect("a factor"));
    let extrapolated = near.value - 0.5 * (far.value - near.value);
    let error = 1.5 * near.error + 0.5 * far.error;
    assert_near("s(1/2)", extrapolated, limit, error + 1e-4 * limit);
}
