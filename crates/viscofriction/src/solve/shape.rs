//! What boundary elements ask of a body: where it may touch, and how long its contact is about.

use super::error::Result;
use bem_halfspace::Footprint;
use bem_halfspace::steady::{Ladder, depth_scale};
use friction_analytic::indentation_after_impulse;
use indenters::{HeightMap, SlidingLoad, Surface, Unmirrored, contact_radius};
use rheology::{Elastic, Material, Viscous};

use super::body::Revolution;
use crate::scene::Control;

/// Elements of the coarsest grids of a ladder along the contact length of the one-dimensional model.
pub(crate) const COARSEST_ELEMENTS: f64 = 5.0;

/// How a body is pressed and slides.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Drive {
    pub(crate) control: Control,
    /// \[m/s]
    pub(crate) velocity: f64,
    /// From first touch \[m]; none for the stationary state.
    pub(crate) distance: Option<f64>,
}

/// Where a body that is pressed may touch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Patch {
    pub(crate) footprint: Footprint,
    /// Of the contact, about, \[m].
    pub(crate) length: f64,
}

/// A body that boundary elements take.
pub(crate) trait Shape: Surface {
    /// The grids on which it slides.
    fn ladder(&self, material: &dyn Material, drive: &Drive) -> Result<Ladder>;

    /// Where it touches when it is pressed for a second on a dashpot of unit viscosity.
    fn patch(&self, control: Control) -> Result<Patch>;
}

impl Shape for Revolution {
    fn ladder(&self, material: &dyn Material, drive: &Drive) -> Result<Ladder> {
        Ok(match drive.control {
            Control::NormalForce(force) => {
                Ladder::of_body(self, material, &SlidingLoad::new(force, drive.velocity)?)?
            }
            Control::IndentationDepth(depth) => Ladder::of_body_at_depth(self, depth)?,
        })
    }

    fn patch(&self, control: Control) -> Result<Patch> {
        let radius = match control {
            Control::NormalForce(impulse) => {
                indentation_after_impulse(self, &Viscous::new(1.0)?, impulse)?.contact_radius
            }
            Control::IndentationDepth(depth) => contact_radius(self, depth)?,
        };
        Ok(Patch {
            footprint: Footprint::square(1.3 * radius),
            length: 2.0 * radius,
        })
    }
}

impl<S: Shape> Shape for Unmirrored<'_, S> {
    fn ladder(&self, material: &dyn Material, drive: &Drive) -> Result<Ladder> {
        self.0.ladder(material, drive)
    }

    fn patch(&self, control: Control) -> Result<Patch> {
        self.0.patch(control)
    }
}

/// Heights up to this many depth scales may touch, as of a cusp.
const HIGHEST: f64 = 2.0;
/// Contact length of the one-dimensional model of a paraboloid over the radius where it is a depth scale high.
const SHORTER: f64 = std::f64::consts::FRAC_1_SQRT_2;

impl Shape for HeightMap {
    fn ladder(&self, material: &dyn Material, drive: &Drive) -> Result<Ladder> {
        let [depth, highest] = match drive.control {
            Control::NormalForce(force) => {
                let load = SlidingLoad::new(force, drive.velocity)?;
                let depth = depth_scale(self, (material, &load), &whole(self))?;
                [depth, HIGHEST * depth]
            }
            Control::IndentationDepth(depth) => [depth; 2],
        };
        Ok(Ladder {
            footprint: below(self, highest),
            coarsest_spacing: SHORTER * half_length(self, depth) / COARSEST_ELEMENTS,
            // The lowest of bilinear heights is the tip of a pyramid.
            apex_exponent: 1.0,
        })
    }

    fn patch(&self, control: Control) -> Result<Patch> {
        let [depth, highest] = match control {
            // What a second does on the dashpot, a spring of unit modulus does at any time.
            Control::NormalForce(impulse) => {
                let load = SlidingLoad::new(impulse, 1.0)?;
                let depth = depth_scale(self, (&Elastic::new(1.0)?, &load), &whole(self))?;
                [depth, HIGHEST * depth]
            }
            Control::IndentationDepth(depth) => [depth; 2],
        };
        Ok(Patch {
            footprint: below(self, highest),
            length: 2.0 * SHORTER * half_length(self, depth),
        })
    }
}

fn whole(map: &HeightMap) -> Footprint {
    let [x, y] = map.extent();
    Footprint { x, y }
}

fn below(map: &HeightMap, height: f64) -> Footprint {
    let [x, y] = map.extent_below(height);
    Footprint { x, y }
}

fn half_length(map: &HeightMap, height: f64) -> f64 {
    let [rear, front] = map.extent_below(height)[0];
    0.5 * (front - rear)
}
