//! Limits of a layer on a rigid base that is thin compared with the contact: Winkler foundation and incompressible film.
//!
//! Comparison with layers of finite thickness: docs/layers.md, "Where a Winkler foundation holds".

use std::f64::consts::PI;

use indenters::PowerProfile;
use numerics::{InvalidParameter, in_range, positive};
use rheology::Material;

use crate::FrictionError;
use crate::error::representable;

/// An elastic layer of thickness t, bonded to a rigid base and frictionless above.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ThinLayer {
    /// Shear modulus G, \[Pa].
    shear_modulus: f64,
    /// Poisson ratio ν.
    poisson_ratio: f64,
    /// Thickness t, \[m].
    thickness: f64,
}

/// Force and contact radius of a body that is pressed into a thin layer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ThinContact {
    /// Normal force F_N, \[N].
    pub normal_force: f64,
    /// Radius of the contact, \[m].
    pub contact_radius: f64,
}

impl ThinLayer {
    /// A layer of a shear modulus > 0 \[Pa], a Poisson ratio above −1 and at most 1/2, and a thickness > 0 \[m].
    ///
    /// # Errors
    /// [`InvalidParameter`] for other numbers.
    pub fn new(
        shear_modulus: f64,
        poisson_ratio: f64,
        thickness: f64,
    ) -> Result<Self, InvalidParameter> {
        let is_allowed = poisson_ratio > -1.0 && poisson_ratio <= 0.5;
        let allowed = "greater than -1 and at most 0.5";
        Ok(Self {
            shear_modulus: positive("shear_modulus", shear_modulus)?,
            poisson_ratio: in_range("poisson_ratio", poisson_ratio, is_allowed, allowed)?,
            thickness: positive("thickness", thickness)?,
        })
    }

    /// Ratio of pressure to depth of the Winkler foundation, 2G (1 − ν)/((1 − 2ν) t), \[Pa/m].
    ///
    /// A thin compressible layer is displaced at every point by the pressure there only (Johnson 1985, eq. 5.69). The error
    /// relative to the layer is of the order (t/a)² in the force at a depth, and t/a in the contact radius.
    ///
    /// # Errors
    /// [`InvalidParameter`] for an incompressible layer, which is no Winkler foundation.
    pub fn winkler_modulus(&self) -> Result<f64, InvalidParameter> {
        let nu = self.poisson_ratio;
        in_range("poisson_ratio", nu, nu < 0.5, "below 0.5")?;
        Ok(2.0 * self.shear_modulus * (1.0 - nu) / ((1.0 - 2.0 * nu) * self.thickness))
    }

    /// Contact of a profile h = c r^p with the Winkler foundation at an `indentation_depth` d > 0 \[m].
    ///
    /// It touches where h < d, and `F = π a² K d p/(p + 2)` with the foundation modulus K.
    ///
    /// # Errors
    /// [`FrictionError::InvalidParameter`] for other numbers and an incompressible layer; [`FrictionError::OutOfRange`].
    pub fn press_winkler(
        &self,
        profile: &PowerProfile,
        indentation_depth: f64,
    ) -> Result<ThinContact, FrictionError> {
        let depth = positive("indentation_depth", indentation_depth)?;
        let (p, a) = (profile.exponent(), profile_radius(profile, depth));
        let force = PI * a * a * self.winkler_modulus()? * depth * p / (p + 2.0);
        Ok(ThinContact {
            normal_force: representable("normal force", force)?,
            contact_radius: a,
        })
    }

    /// Contact of a profile h = c r^p with an incompressible layer, a film, at an `indentation_depth` d > 0 \[m].
    ///
    /// The layer is squeezed aside: `u = −t³/(3G) ∇²P` with the pressure P = ∂P/∂r = 0 at r = a (Johnson 1985, § 5.8). The
    /// surface rises at the contact boundary, h(a) = (1 + p/2) d, and `F = 3π G d a⁴ p/(8 (p + 4) t³)`.
    ///
    /// # Errors
    /// [`FrictionError::InvalidParameter`] for other numbers and a compressible layer; [`FrictionError::OutOfRange`].
    pub fn press_film(
        &self,
        profile: &PowerProfile,
        indentation_depth: f64,
    ) -> Result<ThinContact, FrictionError> {
        let depth = positive("indentation_depth", indentation_depth)?;
        let nu = self.poisson_ratio;
        in_range("poisson_ratio", nu, nu >= 0.5, "0.5")?;
        let p = profile.exponent();
        // The contact boundary is where the profile has the height h(a).
        let a = profile_radius(profile, (1.0 + 0.5 * p) * depth);
        let radius_over_thickness = a / self.thickness;
        let pressure = self.shear_modulus
            * (depth / self.thickness)
            * radius_over_thickness
            * radius_over_thickness;
        let force = 3.0 / 8.0 * PI * pressure * a * a * p / (p + 4.0);
        Ok(ThinContact {
            normal_force: representable("normal force", force)?,
            contact_radius: a,
        })
    }
}

/// Line load on the one-dimensional model that is equivalent to the line load F' on a thin layer: `F' (1 − 2ν) t/(1 − ν)²`,
/// \[N/m].
///
/// Both are of the same `material`, and the layer is in plane strain. A profile h(x) has the same contact, depth and friction
/// on both, because both are Winkler foundations.
///
/// # Errors
/// [`InvalidParameter`] for numbers that are not positive and an incompressible material.
pub fn winkler_line_force(
    material: &dyn Material,
    thickness: f64,
    force_per_length: f64,
) -> Result<f64, InvalidParameter> {
    let nu = material.poisson_ratio();
    let layer = ThinLayer::new(1.0, nu, thickness)?;
    let modulus = 4.0 / material.half_space_factor();
    Ok(positive("force_per_length", force_per_length)? * modulus / layer.winkler_modulus()?)
}

/// Radius at which a profile has a height, \[m].
fn profile_radius(profile: &PowerProfile, height: f64) -> f64 {
    (height / profile.coefficient()).powf(profile.exponent().recip())
}
