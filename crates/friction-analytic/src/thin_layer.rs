//! What a layer on a rigid base becomes where it is thin compared with the contact.

use std::f64::consts::PI;

use indenters::PowerProfile;
use numerics::{InvalidParameter, in_range, positive};
use rheology::Material;

use crate::FrictionError;
use crate::error::representable;

/// An elastic layer of the thickness t, bonded to a rigid base and free of friction above.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ThinLayer {
    shear_modulus: f64,
    poisson_ratio: f64,
    thickness: f64,
}

/// A body that is pressed into a thin layer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ThinContact {
    /// Normal force F_N, \[N].
    pub normal_force: f64,
    /// Radius of the contact, \[m].
    pub contact_radius: f64,
}

impl ThinLayer {
    /// Of a shear modulus > 0 \[Pa], a Poisson ratio above −1 and at most 1/2, and a thickness > 0 \[m].
    ///
    /// # Errors
    /// [`InvalidParameter`] for other numbers.
    pub fn new(
        shear_modulus: f64,
        poisson_ratio: f64,
        thickness: f64,
    ) -> Result<Self, InvalidParameter> {
        let holds = poisson_ratio > -1.0 && poisson_ratio <= 0.5;
        let allowed = "greater than -1 and at most 0.5";
        Ok(Self {
            shear_modulus: positive("shear_modulus", shear_modulus)?,
            poisson_ratio: in_range("poisson_ratio", poisson_ratio, holds, allowed)?,
            thickness: positive("thickness", thickness)?,
        })
    }

    /// Pressure over depth of the Winkler foundation, 2G (1 − ν)/((1 − 2ν) t), \[Pa/m]: every point of a thin compressible
    /// layer gives way to the pressure on it alone (Johnson 1985, eq. 5.69). Relative to the layer the force at a depth is
    /// off like (t/a)², and the radius like t/a.
    ///
    /// # Errors
    /// [`InvalidParameter`] for an incompressible layer, which does not give way so.
    pub fn winkler_modulus(&self) -> Result<f64, InvalidParameter> {
        let nu = self.poisson_ratio;
        in_range("poisson_ratio", nu, nu < 0.5, "below 0.5")?;
        Ok(2.0 * self.shear_modulus * (1.0 - nu) / ((1.0 - 2.0 * nu) * self.thickness))
    }

    /// A profile h = c r^p that is pressed into the Winkler foundation to an `indentation_depth` d > 0, \[m]: it touches
    /// where h < d, and `F = π a² K d p/(p + 2)`.
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

    /// The same where the layer is incompressible, and is squeezed from under the body like a film: `u = −t³/(3G) ∇²p` with
    /// p = ∂p/∂r = 0 at r = a (Johnson 1985, § 5.8). The rim rises, h(a) = (1 + p/2) d, and
    /// `F = 3π G d a⁴ p/(8 (p + 4) t³)`.
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
        let a = profile_radius(profile, (1.0 + 0.5 * p) * depth);
        let slenderness = a / self.thickness;
        let pressure = self.shear_modulus * (depth / self.thickness) * slenderness * slenderness;
        let force = 3.0 / 8.0 * PI * pressure * a * a * p / (p + 4.0);
        Ok(ThinContact {
            normal_force: representable("normal force", force)?,
            contact_radius: a,
        })
    }
}

/// The force per length on the one-dimensional model of a `material`, \[N/m], that does to a profile h(x) what the force per
/// length F' does to it in plane strain on the Winkler foundation of a thin layer of that material: `F' (1 − 2ν) t/(1 − ν)²`.
/// Contact, depth and friction of both are the same, because both are springs side by side.
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

fn profile_radius(profile: &PowerProfile, height: f64) -> f64 {
    (height / profile.coefficient()).powf(profile.exponent().recip())
}
