//! The footprint: the rectangle in which contact may occur, in the frame of the indenter.

use std::f64::consts::LN_2;

use indenters::{Control, SlidingLoad, Surface, check_lowest_point};
use numerics::{InvalidParameter, positive};

use crate::elements::grid::elements_along;
use crate::stationary::steady::depth_scale_of_surface;
use crate::{BemError, Elastomer};

/// Largest height of the body, above its lowest point, that may be in contact under a force F_N, over the depth scale D = F_N/(4ηv) of a
/// dashpot ([`Footprint::sliding`] for other materials). Chosen with a margin: the highest known leading edge of a contact, under a cusp
/// h ∼ r^0.51, lies at 1.6 D. A footprint that is too small grows (case of `evidence tuning`).
pub(crate) const MAX_HEIGHT_IN_DEPTH_SCALES: f64 = 2.0;

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
    /// At a given depth it holds all of the surface below that depth, because a half space nowhere rises to meet the body. Under
    /// a given force it holds all of the surface below 1.5 D, with the depth scale D = F_N / (4 η v) of a dashpot. For a cusp
    /// sharper than r^(3/4), and for surfaces other than bodies of revolution, that is 2 D. The leading edge of the contact lies at
    /// 1.6 D for h ∼ r^0.51, at 1.1 D for the cone and at 0.8 D for the paraboloid. On other materials D = h(a) =
    /// 2 (1 − ν) F_N J(a/v) / (4 a).
    ///
    /// # Errors
    /// [`BemError::InvalidParameter`] for a surface that nowhere reaches the height needed.
    pub fn sliding(
        surface: &dyn Surface,
        elastomer: &dyn Elastomer,
        load: &SlidingLoad,
    ) -> Result<Self, BemError> {
        let reached = |height| Self::of_contact_below(surface, elastomer, height);
        let depth = match load.control() {
            Control::IndentationDepth(depth) => return reached(depth),
            Control::NormalForce(_) => depth_scale_of_surface(surface, elastomer, load)?,
        };
        // Choose the largest height that may be in contact. It is smaller for bodies of revolution without a sharp cusp.
        let Some(body) = surface.as_axisymmetric() else {
            return reached(MAX_HEIGHT_IN_DEPTH_SCALES * depth);
        };
        let is_cusp = body.profile_exponent() < 0.75;
        let height = if is_cusp {
            MAX_HEIGHT_IN_DEPTH_SCALES
        } else {
            1.5
        } * depth;
        // A flat punch has no front.
        if body.profile_height(body.max_radius()) <= 0.0 {
            return Err(nowhere_as_high(height).into());
        }
        reached(height)
    }

    /// The rectangle that holds the contact, if on a half space only points of the surface below a `height` \[m] touch. On a layer,
    /// which piles up, it is larger.
    pub(crate) fn of_contact_below(
        surface: &dyn Surface,
        elastomer: &dyn Elastomer,
        height: f64,
    ) -> Result<Self, BemError> {
        Self::below(surface, Self::with_pile_up(surface, elastomer, height)?)
    }

    /// The height \[m] up to which an elastomer touches a surface, if a half space touches it up to a `height` \[m]. The height on a
    /// layer exceeds it by the pile-up.
    pub(crate) fn with_pile_up(
        surface: &dyn Surface,
        elastomer: &dyn Elastomer,
        height: f64,
    ) -> Result<f64, BemError> {
        // A half space nowhere rises to meet the body, so that the height stays as it is.
        let base = elastomer.base();
        if base.is_half_space() {
            return Ok(height);
        }
        // Find the half length of the contact below a height. Its growth when the height doubles gives the exponent p of a body h
        // ∼ r^p.
        let half_length = |height| -> Result<f64, BemError> {
            let distances = Self::below(surface, height)?.edge_distances()?;
            Ok(distances.concat().into_iter().fold(0.0, f64::max))
        };
        let length = half_length(height)?;
        // In front of a vertical wall no length is left for the pile-up; hence the upper bound of the exponent.
        let exponent = (LN_2 / (half_length(2.0 * height)? / length).ln()).min(8.0);
        Ok(base.pile_up_factor(length, exponent) * height)
    }

    /// The rectangle that holds every point of a surface below a `height` above its lowest point, \[m]. For a body that ends
    /// lower, such as a flat punch, it is bounded by the end of the body.
    ///
    /// # Errors
    /// [`BemError::InvalidParameter`] for a height that is not positive, and for a surface that is below it everywhere;
    /// [`BemError::Indenter`] for a surface whose height at the origin is not 0.
    pub fn below(surface: &dyn Surface, height: f64) -> Result<Self, BemError> {
        positive("indentation depth", height)?;
        check_lowest_point(surface, height)?;
        let [x, y] = surface.extent_below(height);
        if [x, y].into_iter().flatten().all(f64::is_finite) && x[0] < x[1] && y[0] < y[1] {
            return Ok(Self { x, y });
        }
        Err(nowhere_as_high(height).into())
    }

    /// The rectangle widened by two elements of edge `spacing` on all sides, for steep bodies that leave no margin.
    #[must_use]
    pub fn widened(&self, spacing: f64) -> Self {
        let widened = |[first, last]: [f64; 2]| [first - 2.0 * spacing, last + 2.0 * spacing];
        Self {
            x: widened(self.x),
            y: widened(self.y),
        }
    }

    /// The rectangle whose edges are twice as far from the lowest point, which is tried if the contact reaches the boundary of this one.
    pub(crate) fn doubled(&self) -> Self {
        let doubled = |ends: [f64; 2]| ends.map(|end| 2.0 * end);
        Self {
            x: doubled(self.x),
            y: doubled(self.y),
        }
    }

    /// The error [`BemError::ContactReachesBoundary`] for this footprint, after sliding over a distance \[m].
    pub(crate) const fn boundary_reached(self, sliding_distance: f64) -> BemError {
        BemError::ContactReachesBoundary {
            sliding_distance,
            footprint: self,
        }
    }

    /// Distances [[behind, ahead], [right, left]] of the edges from the lowest point, \[m]. Fails unless all are finite and greater
    /// than 0.
    pub(crate) fn edge_distances(&self) -> Result<[[f64; 2]; 2], BemError> {
        let mut sides = [self.x, self.y];
        let names = ["footprint along x", "footprint along y"];
        for (ends, name) in sides.iter_mut().zip(names) {
            *ends = [positive(name, -ends[0])?, positive(name, ends[1])?];
        }
        Ok(sides)
    }

    /// Numbers of elements behind and ahead of the element under the lowest point, and right and left of it, for elements with
    /// the edges `spacing` \[m].
    ///
    /// # Errors
    /// [`BemError::InvalidParameter`] for ends on the wrong side of the lowest point; [`BemError::GridTooLarge`].
    pub fn elements(&self, spacing: [f64; 2]) -> Result<[[usize; 2]; 2], BemError> {
        let mut counts = [[0; 2]; 2];
        for (axis, ends) in self.edge_distances()?.into_iter().enumerate() {
            for (side, end) in ends.into_iter().enumerate() {
                counts[axis][side] = elements_along(end, spacing[axis])?;
            }
        }
        Ok(counts)
    }

    /// Approximate number of all elements with the edges [Δx, Δy] \[m]: area of the footprint over area of an element, without
    /// an upper limit.
    pub(crate) fn n_elements(&self, spacing: [f64; 2]) -> f64 {
        let Self { x, y } = self;
        (x[1] - x[0]) / spacing[0] * ((y[1] - y[0]) / spacing[1])
    }
}

/// The error [`InvalidParameter`] for a height \[m] that the surface does not reach on all sides at a finite distance.
fn nowhere_as_high(height: f64) -> InvalidParameter {
    InvalidParameter {
        parameter: "indentation depth",
        value: height,
        allowed: "a height that the surface reaches all around at a finite distance greater than 0",
    }
}
