//! Bodies of revolution that are pressed into a layer of any thickness, bonded to a rigid base and free of friction above.

mod equation;
mod profile;
mod series;

use indenters::Axisymmetric;
use numerics::{InvalidParameter, in_range, positive};

pub use profile::LayerProfile;

use crate::FrictionError;
use crate::error::representable;
use equation::{Disc, Heights, Waves};

/// Radius of a contact in thicknesses, beyond which the equations are not solved: a layer is a Winkler foundation or a film by
/// then ([`ThinLayer`](crate::ThinLayer)).
const WIDEST: f64 = 100.0;

/// A layer bonded to a rigid base, of a material with a constant Poisson ratio.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BondedLayer {
    thickness: f64,
    poisson_ratio: f64,
}

/// A contact of a given radius.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LayerContact {
    /// Indentation depth d, \[m].
    pub indentation_depth: f64,
    /// Normal force over the modulus E* = 2G/(1 − ν), \[m²].
    pub force_per_modulus: f64,
}

impl BondedLayer {
    /// Of a thickness > 0 \[m] and a Poisson ratio above −1 and at most 1/2.
    ///
    /// # Errors
    /// [`InvalidParameter`] for other numbers.
    pub fn new(thickness: f64, poisson_ratio: f64) -> Result<Self, InvalidParameter> {
        let holds = poisson_ratio > -1.0 && poisson_ratio <= 0.5;
        let allowed = "greater than -1 and at most 0.5";
        Ok(Self {
            thickness: positive("thickness", thickness)?,
            poisson_ratio: in_range("poisson_ratio", poisson_ratio, holds, allowed)?,
        })
    }

    /// Thickness, \[m].
    pub const fn thickness(&self) -> f64 {
        self.thickness
    }

    /// Radius of the widest contact that is solved, \[m].
    pub fn widest(&self) -> f64 {
        WIDEST * self.thickness
    }

    /// An elastic contact of a given radius, to about ten digits.
    ///
    /// # Errors
    /// [`FrictionError::InvalidParameter`] for a radius that is not positive, that the body does not reach, or of more than
    /// a hundred thicknesses; [`FrictionError::OutOfRange`] for a body that is flat up to there, whose depth is free, and where
    /// a result underflows.
    pub fn press(
        &self,
        body: &dyn Axisymmetric,
        contact_radius: f64,
    ) -> Result<LayerContact, FrictionError> {
        let slenderness = self.slenderness(contact_radius)?;
        let is_inside = body.line_height(contact_radius).is_finite();
        in_range(
            "contact_radius",
            contact_radius,
            is_inside,
            "inside the body",
        )?;
        let waves = Waves::new(self.poisson_ratio, slenderness);
        let disc = Disc::new(&waves, slenderness)?;
        let heights = Heights::new(body, self.thickness, &waves, contact_radius);
        let sums = heights.up_to(contact_radius);
        let depth = representable("indentation depth", disc.depth(&sums))?;
        let force = 2.0 * self.thickness * disc.load(&sums, depth);
        Ok(LayerContact {
            indentation_depth: depth,
            force_per_modulus: representable("force over modulus", force)?,
        })
    }

    /// Radius \[m] of the flat punch that is as stiff on the half space as one of the radius a is on the layer: F = 2 E* A d.
    ///
    /// # Errors
    /// [`FrictionError::InvalidParameter`] for a radius that is not positive, or of more than a hundred thicknesses.
    pub fn punch_radius(&self, contact_radius: f64) -> Result<f64, FrictionError> {
        let slenderness = self.slenderness(contact_radius)?;
        let waves = Waves::new(self.poisson_ratio, slenderness);
        Ok(self.thickness * Disc::new(&waves, slenderness)?.radius())
    }

    fn slenderness(&self, contact_radius: f64) -> Result<f64, InvalidParameter> {
        let slenderness = positive("contact_radius", contact_radius)? / self.thickness;
        let allowed = "at most 100 thicknesses of the layer";
        in_range(
            "contact_radius",
            contact_radius,
            slenderness <= WIDEST,
            allowed,
        )?;
        Ok(slenderness)
    }
}
