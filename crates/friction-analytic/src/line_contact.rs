//! Normal indentation of a viscous half space by a cylinder, in plane strain.
//!
//! ```text
//! π η b² / R = ∫ F' dt
//! ```
//!
//! is the elastic contact `π G b²/R = F'` (Hertz 1881) with the viscosity in the place of the modulus, as long as the
//! contact grows (Lee & Radok 1960); F' is the force per length. A depth does not exist: it grows with the logarithm of
//! the length of the cylinder.

use std::f64::consts::PI;

use indenters::Cylinder;
use rheology::Viscous;

use crate::FrictionError;
use crate::error::{not_negative, representable};

/// Half the width b of the contact of a cylinder \[m] after an impulse per length ∫ F' dt ≥ 0 \[N s/m]; for a constant
/// force, force times time.
///
/// # Errors
/// [`FrictionError::InvalidParameter`] for an impulse that is negative or not finite; [`FrictionError::OutOfRange`] when
/// the result overflows or underflows.
pub fn cylinder_half_width_after_impulse(
    cylinder: &Cylinder,
    material: &Viscous,
    impulse_per_length: f64,
) -> Result<f64, FrictionError> {
    if not_negative("impulse_per_length", impulse_per_length)? == 0.0 {
        return Ok(0.0);
    }
    // Roots of the factors, because their product may overflow where b does not.
    let roots = [impulse_per_length, cylinder.radius()].map(f64::sqrt);
    let divisors = [PI, material.viscosity()].map(f64::sqrt);
    let half_width = roots[0] / divisors[0] / divisors[1] * roots[1];
    representable("half width", half_width)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// b = √(4 F' R/(π E*)) with E* = 4 G, where the impulse over the viscosity stands for F'/G.
    #[test]
    fn the_contact_is_that_of_hertz_at_every_scale() {
        for scale in [1e-100, 1.0, 1e100] {
            let cylinder = Cylinder::new(0.01 * scale).expect("a cylinder");
            let material = Viscous::new(1e6).expect("a material");
            let width = cylinder_half_width_after_impulse(&cylinder, &material, 2000.0 * scale);
            let width = width.expect("a width") / scale;
            let effective: f64 = 4.0 * 1e6;
            let expected = (4.0 * 2000.0 * 0.01 / (PI * effective)).sqrt();
            assert!(
                (width / expected - 1.0).abs() < 1e-14,
                "scale {scale:e}: {width} instead of {expected}"
            );
        }
    }

    #[test]
    fn without_impulse_there_is_no_contact_and_a_negative_one_is_refused() {
        let cylinder = Cylinder::new(0.01).expect("a cylinder");
        let material = Viscous::new(1e6).expect("a material");
        let width = |impulse| cylinder_half_width_after_impulse(&cylinder, &material, impulse);
        assert_eq!(width(0.0), Ok(0.0), "no impulse");
        for impulse in [-1.0, f64::NAN, f64::INFINITY] {
            assert!(width(impulse).is_err(), "accepted the impulse {impulse}");
        }
    }
}
