//! Elastic contact of bodies of revolution with a layer of any thickness, bonded to a rigid base and frictionless above.
//!
//! Theory and comparisons: docs/layers.md, "How it is computed".

mod chebyshev;
mod equation;
mod profile;

use indenters::Axisymmetric;
use numerics::{InvalidParameter, in_range, positive};

pub use profile::LayerProfile;

use crate::FrictionError;
use crate::error::representable;
use equation::{ContactDisc, EquivalentLine, WaveQuadrature};

/// Largest ratio of the contact radius to the thickness for which the equations are solved. Chosen to limit the computing time,
/// which grows like the cube of the radius; larger radii are refused.
///
/// A wider contact is close to that on a Winkler foundation or a film ([`ThinLayer`](crate::ThinLayer)).
const MAX_RADIUS_OVER_THICKNESS: f64 = 100.0;

/// A layer bonded to a rigid base, of a material with a constant Poisson ratio.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BondedLayer {
    /// Thickness, \[m].
    thickness: f64,
    /// Poisson ratio.
    poisson_ratio: f64,
}

/// Depth and force of an elastic contact of given radius on a layer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LayerContact {
    /// Indentation depth d, \[m].
    pub indentation_depth: f64,
    /// Normal force divided by the modulus E* = 2G/(1 − ν), \[m²].
    pub force_per_modulus: f64,
}

impl BondedLayer {
    /// A layer of a thickness > 0 \[m] and a Poisson ratio above −1 and at most 1/2.
    ///
    /// # Errors
    /// [`InvalidParameter`] for other numbers.
    pub fn new(thickness: f64, poisson_ratio: f64) -> Result<Self, InvalidParameter> {
        let is_allowed = poisson_ratio > -1.0 && poisson_ratio <= 0.5;
        let allowed = "greater than -1 and at most 0.5";
        Ok(Self {
            thickness: positive("thickness", thickness)?,
            poisson_ratio: in_range("poisson_ratio", poisson_ratio, is_allowed, allowed)?,
        })
    }

    /// Thickness, \[m].
    pub const fn thickness(&self) -> f64 {
        self.thickness
    }

    /// Largest contact radius for which the equations are solved, a hundred thicknesses, \[m].
    pub fn max_contact_radius(&self) -> f64 {
        MAX_RADIUS_OVER_THICKNESS * self.thickness
    }

    /// The elastic contact of a given radius, to about ten digits.
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
        let radius_over_thickness = self.radius_over_thickness(contact_radius)?;
        let is_inside = body.line_height(contact_radius).is_finite();
        in_range(
            "contact_radius",
            contact_radius,
            is_inside,
            "inside the body",
        )?;
        // Discretise and factorise the equations, then solve them for the line of the body.
        let waves = WaveQuadrature::new(self.poisson_ratio, radius_over_thickness);
        let disc = ContactDisc::new(&waves, radius_over_thickness)?;
        let line = EquivalentLine::new(body, self.thickness, &waves, contact_radius);
        let integrals = line.integrals_to(contact_radius);
        let depth = representable("indentation depth", disc.depth(&integrals))?;
        let force = 2.0 * self.thickness * disc.load(&integrals, depth);
        Ok(LayerContact {
            indentation_depth: depth,
            force_per_modulus: representable("force over modulus", force)?,
        })
    }

    /// Radius A of the flat punch that has the stiffness on the half space which a punch of radius a has on the layer, \[m]:
    /// F = 2 E* A d.
    ///
    /// # Errors
    /// [`FrictionError::InvalidParameter`] for a radius that is not positive, or of more than a hundred thicknesses.
    pub fn equivalent_punch_radius(&self, contact_radius: f64) -> Result<f64, FrictionError> {
        let radius_over_thickness = self.radius_over_thickness(contact_radius)?;
        let waves = WaveQuadrature::new(self.poisson_ratio, radius_over_thickness);
        let disc = ContactDisc::new(&waves, radius_over_thickness)?;
        Ok(self.thickness * disc.equivalent_radius())
    }

    /// The contact radius in thicknesses, if the equations are solved for it.
    fn radius_over_thickness(&self, contact_radius: f64) -> Result<f64, InvalidParameter> {
        let radius_over_thickness = positive("contact_radius", contact_radius)? / self.thickness;
        let allowed = "at most 100 thicknesses of the layer";
        in_range(
            "contact_radius",
            contact_radius,
            radius_over_thickness <= MAX_RADIUS_OVER_THICKNESS,
            allowed,
        )?;
        Ok(radius_over_thickness)
    }
}
