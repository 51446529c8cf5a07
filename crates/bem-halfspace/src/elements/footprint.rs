//! Where contact may occur, seen from the indenter.

use std::f64::consts::LN_2;

use indenters::{Control, SlidingLoad, Surface};
use numerics::{InvalidParameter, positive};

use crate::elements::grid::elements_along;
use crate::stationary::steady::depth_scale_of_surface;
use crate::{BemError, Elastomer};

/// Heights up to this many depth scales may touch, as under a cusp.
pub(crate) const HIGHEST: f64 = 2.0;

/// Ratio of the footprints that are tried one after the other where the contact reaches the boundary: chosen; with another one the same
/// contact is found.
const GROWTH: f64 = 1.5;

/// The rectangle around the lowest point of the indenter, which lies at [0, 0], in which contact may occur, \[m].
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Footprint {
    /// From rear to front: `x[0] < 0 < x[1]`.
    pub x: [f64; 2],
    /// Across the sliding direction: `y[0] < 0 < y[1]`.
    pub y: [f64; 2],
}

impl Footprint {
    /// The square of half width `radius` around the lowest point.
    pub const fn square(radius: f64) -> Self {
        Self {
            x: [-radius, radius],
            y: [-radius, radius],
        }
    }

    /// The rectangle that holds the contact of a surface that slides.
    ///
    /// At a depth that is all of the surface below it, because a half space nowhere rises to meet the body. Under a force
    /// it reaches up to 1.5 of the depth D = F_N / (4 η v), or 2 of it for a cusp sharper than r^(3/4) and for other
    /// surfaces than bodies of revolution: the front of the contact reaches 1.6 of that depth for h ∼ r^0.51, 1.1 for the
    /// cone and 0.8 for the paraboloid. On other materials than the dashpot D = h(a) = 2 (1 − ν) F_N J(a/v) / (4 a).
    ///
    /// # Errors
    /// [`BemError::InvalidParameter`] for a surface that is low everywhere.
    pub fn sliding(
        surface: &dyn Surface,
        elastomer: &dyn Elastomer,
        load: &SlidingLoad,
    ) -> Result<Self, BemError> {
        let reached = |height| Self::reached(surface, elastomer, height);
        let depth = match load.control() {
            Control::IndentationDepth(depth) => return reached(depth),
            Control::NormalForce(_) => depth_scale_of_surface(surface, elastomer, load)?,
        };
        let Some(body) = surface.as_axisymmetric() else {
            return reached(HIGHEST * depth);
        };
        let sharp = body.profile_exponent() < 0.75;
        let height = if sharp { HIGHEST } else { 1.5 } * depth;
        let footprint = reached(height)?;
        let [_, radius] = footprint.x;
        if radius < body.max_radius() || body.profile_height(radius) >= height {
            return Ok(footprint);
        }
        Err(nowhere_as_high(height).into())
    }

    /// The rectangle that holds every point of a surface that is met where a half space meets those below a height.
    pub(crate) fn reached(
        surface: &dyn Surface,
        elastomer: &dyn Elastomer,
        height: f64,
    ) -> Result<Self, BemError> {
        Self::below(surface, Self::risen(surface, elastomer, height)?)
    }

    /// The height up to which a surface is met where a half space meets it up to a `height`.
    pub(crate) fn risen(
        surface: &dyn Surface,
        elastomer: &dyn Elastomer,
        height: f64,
    ) -> Result<f64, BemError> {
        let base = elastomer.base();
        if base.is_half_space() {
            return Ok(height);
        }
        let half_length = |height| -> Result<f64, BemError> {
            let sides = Self::below(surface, height)?.sides()?;
            Ok(sides.concat().into_iter().fold(0.0, f64::max))
        };
        let length = half_length(height)?;
        // In front of a wall no length is left for the rim.
        let exponent = (LN_2 / (half_length(2.0 * height)? / length).ln()).min(8.0);
        Ok(base.pile_up_factor(length, exponent) * height)
    }

    /// The rectangle that holds every point of a surface below a `height` above its lowest point, \[m]; a body that ends
    /// lower, as a flat punch, has its end for a boundary.
    ///
    /// # Errors
    /// [`BemError::InvalidParameter`] for a height that is not positive, and for a surface that is below it everywhere.
    pub fn below(surface: &dyn Surface, height: f64) -> Result<Self, BemError> {
        positive("indentation depth", height)?;
        let [x, y] = surface.extent_below(height);
        if [x, y].into_iter().flatten().all(f64::is_finite) && x[0] < x[1] && y[0] < y[1] {
            return Ok(Self { x, y });
        }
        Err(nowhere_as_high(height).into())
    }

    /// With room for two elements at the boundary, where a steep body leaves none.
    #[must_use]
    pub fn widened(&self, spacing: f64) -> Self {
        let widened = |[first, last]: [f64; 2]| [first - 2.0 * spacing, last + 2.0 * spacing];
        Self {
            x: widened(self.x),
            y: widened(self.y),
        }
    }

    /// The rectangle whose edges are [`GROWTH`] times as far from the lowest point.
    pub(crate) fn grown(&self) -> Self {
        let grown = |ends: [f64; 2]| ends.map(|end| GROWTH * end);
        Self {
            x: grown(self.x),
            y: grown(self.y),
        }
    }

    pub(crate) const fn boundary_reached(self, sliding_distance: f64) -> BemError {
        BemError::ContactReachesBoundary {
            sliding_distance,
            footprint: self,
        }
    }

    /// Distances of the edges behind and ahead of, right and left of the lowest point, \[m]; refuses those that are not
    /// finite and greater than 0.
    pub(crate) fn sides(&self) -> Result<[[f64; 2]; 2], BemError> {
        let mut sides = [self.x, self.y];
        let names = ["footprint along x", "footprint along y"];
        for (ends, name) in sides.iter_mut().zip(names) {
            *ends = [positive(name, -ends[0])?, positive(name, ends[1])?];
        }
        Ok(sides)
    }

    /// Number of elements behind and ahead of, right and left of the element under the lowest point, of edges \[m].
    ///
    /// # Errors
    /// [`BemError::InvalidParameter`] for ends on the wrong side of the lowest point; [`BemError::GridTooLarge`].
    pub fn elements(&self, spacing: [f64; 2]) -> Result<[[usize; 2]; 2], BemError> {
        let mut counts = [[0; 2]; 2];
        for (axis, ends) in self.sides()?.into_iter().enumerate() {
            for (side, end) in ends.into_iter().enumerate() {
                counts[axis][side] = elements_along(end, spacing[axis])?;
            }
        }
        Ok(counts)
    }

    /// The same all together, however many.
    pub(crate) fn n_elements(&self, [dx, dy]: [f64; 2]) -> f64 {
        let Self { x, y } = self;
        (x[1] - x[0]) / dx * ((y[1] - y[0]) / dy)
    }
}

fn nowhere_as_high(height: f64) -> InvalidParameter {
    InvalidParameter {
        parameter: "indentation depth",
        value: height,
        allowed: "a height that the surface reaches all around at a finite distance greater than 0",
    }
}
