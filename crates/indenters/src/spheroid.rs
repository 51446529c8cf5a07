//! Half a spheroid, the ellipsoid of revolution: a sphere whose heights are multiplied by a factor, and with them its line.
//!
//! ```text
//! h(r) = H (1 − √(1 − r²/R²)) = (H/R) (R − √(R² − r²))        h̃(x) = (H/R) x artanh(x / R)
//! ```

use numerics::positive;

use crate::{Axisymmetric, IndenterError, LinePoint, ProfilePoint, Sphere, surface_of_revolution};

/// The lower half of a spheroid; it ends at the equator.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Spheroid {
    /// Sphere of the radius R.
    sphere: Sphere,
    /// Semi-axis H along z, \[m].
    height: f64,
}

impl Spheroid {
    /// A spheroid of the semi-axes `radius` R > 0 \[m] across and `height` H > 0 \[m] along z.
    ///
    /// # Errors
    /// [`IndenterError::InvalidParameter`] when a semi-axis, or their ratio H/R, is not finite and greater than zero.
    pub fn new(radius: f64, height: f64) -> Result<Self, IndenterError> {
        let sphere = Sphere::new(radius)?;
        positive("height", height)?;
        positive("height / radius", height / radius)?;
        Ok(Self { sphere, height })
    }

    /// Semi-axis R across, \[m].
    pub const fn radius(&self) -> f64 {
        self.sphere.radius()
    }

    /// Semi-axis H along z, \[m].
    pub const fn height(&self) -> f64 {
        self.height
    }

    /// Ratio H/R of the heights to those of the sphere of radius R.
    const fn factor(&self) -> f64 {
        self.height / self.radius()
    }
}

impl Axisymmetric for Spheroid {
    fn profile(&self, radius: f64) -> ProfilePoint {
        let point = self.sphere.profile(radius);
        ProfilePoint {
            height: self.factor() * point.height,
            slope: self.factor() * point.slope,
            curvature: self.factor() * point.curvature,
        }
    }

    fn profile_exponent(&self) -> f64 {
        2.0
    }

    fn max_radius(&self) -> f64 {
        self.radius()
    }

    fn closed_line(&self, x: f64) -> Option<LinePoint> {
        let line = self.sphere.closed_line(x)?;
        Some(LinePoint {
            height: self.factor() * line.height,
            slope: self.factor() * line.slope,
        })
    }

    fn closed_radius(&self, height: f64) -> Option<f64> {
        self.sphere.closed_radius(height / self.factor())
    }
}

surface_of_revolution!(Spheroid);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn semi_axes_that_are_not_positive_are_refused() {
        for wrong in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            for refused in [Spheroid::new(wrong, 1.0), Spheroid::new(1.0, wrong)] {
                let name =
                    ["radius", "height"].map(|name| format!("{name} must be finite and greater"));
                let said = refused.expect_err("out of range").to_string();
                assert!(name.iter().any(|name| said.starts_with(name)), "{said}");
            }
        }
        assert!(
            Spheroid::new(1e300, 1e-300).is_err(),
            "the ratio underflows"
        );
    }
}
