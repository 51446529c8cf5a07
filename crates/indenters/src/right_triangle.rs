//! Legs and angles of right triangles with a given hypotenuse, without cancellation in nearly flat ones.

/// Leg √(x² − b²) for 0 ≤ b ≤ x, without cancellation and without overflow of the squares.
pub(crate) fn leg(hypotenuse: f64, other_leg: f64) -> f64 {
    (hypotenuse - other_leg).sqrt() * (hypotenuse + other_leg).sqrt()
}

/// Angle arccos(b / x) for 0 ≤ b ≤ x, accurate to rounding even if b is close to x.
pub(crate) fn arc_cosine(adjacent: f64, hypotenuse: f64) -> f64 {
    leg(hypotenuse, adjacent).atan2(adjacent)
}

/// Difference arcsin(r₂ / x) − arcsin(r₁ / x) for 0 ≤ r₁ ≤ r₂ ≤ x, without cancellation.
///
/// With u = r / x and c = √(1 − u²), it is the angle with the sine u₂c₁ − u₁c₂ = (u₂² − u₁²) / (u₂c₁ + u₁c₂) and the
/// cosine c₁c₂ + u₁u₂, whose terms are all positive.
pub(crate) fn arc_sine_difference([inner, outer]: [f64; 2], hypotenuse: f64) -> f64 {
    if inner >= outer {
        return 0.0;
    }
    let (u1, u2) = (inner / hypotenuse, outer / hypotenuse);
    let [c1, c2] = [inner, outer].map(|side| leg(hypotenuse, side) / hypotenuse);
    let difference = (outer - inner) / hypotenuse * (u1 + u2);
    (difference / (u2 * c1 + u1 * c2)).atan2(c1 * c2 + u1 * u2)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_thin_slice_keeps_its_digits() {
        // Compare with the series arcsin(1) − arcsin(1 − ε) = √(2ε) (1 + ε/12 + …), whose next term is below rounding; 1 − ε is
        // exact for this ε.
        let epsilon = 2.0_f64.powi(-40);
        let expected = (2.0 * epsilon).sqrt() * (1.0 + epsilon / 12.0);
        for actual in [
            arc_sine_difference([1.0 - epsilon, 1.0], 1.0),
            arc_cosine(1.0 - epsilon, 1.0),
        ] {
            assert!(
                (actual / expected - 1.0).abs() < 4e-16,
                "{actual} instead of {expected}"
            );
        }
    }
}
