//! Where contact may occur, seen from the indenter.

use indenters::{Axisymmetric, SlidingLoad};
use numerics::bracketed_root;
use rheology::Material;

use crate::BemError;
use crate::error::positive;
use crate::grid::elements_along;
use crate::steady::depth_scale_of_body;

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
    #[must_use]
    pub const fn square(radius: f64) -> Self {
        Self {
            x: [-radius, radius],
            y: [-radius, radius],
        }
    }

    /// The square that holds the contact of a body of revolution: up to 1.5 of the height D = F_N / (4 η v), or 2 of it
    /// for a cusp sharper than r^(3/4). The front of the contact reaches 1.6 of that scale for h ∼ r^0.51, 1.1 for the
    /// cone and 0.8 for the paraboloid. On other materials than the dashpot D = h(a) = 2 (1 − ν) F_N J(a/v) / (4 a).
    ///
    /// # Errors
    /// [`BemError::InvalidParameter`] when the body has no radius that could be found for this load.
    pub fn of_body(
        body: &(impl Axisymmetric + ?Sized),
        material: &(impl Material + ?Sized),
        load: &SlidingLoad,
    ) -> Result<Self, BemError> {
        let depth = depth_scale_of_body(body, material, load)?;
        let height = if body.profile_exponent() < 0.75 {
            2.0
        } else {
            1.5
        };
        Self::below(body, height * depth, ("depth scale", depth))
    }

    /// The square that holds the contact of a body of revolution at a depth of its lowest point \[m]: the surface nowhere
    /// rises to meet the body.
    ///
    /// # Errors
    /// [`BemError::InvalidParameter`] for a depth that is not positive, or that the body reaches at no finite radius.
    pub fn of_body_at_depth(
        body: &(impl Axisymmetric + ?Sized),
        depth: f64,
    ) -> Result<Self, BemError> {
        Self::below(body, positive("depth", depth)?, ("depth", depth))
    }

    fn below(
        body: &(impl Axisymmetric + ?Sized),
        height: f64,
        (parameter, value): (&'static str, f64),
    ) -> Result<Self, BemError> {
        let radius = radius_at_height(body, height).filter(|radius| *radius > 0.0);
        radius.map(Self::square).ok_or(BemError::InvalidParameter {
            parameter,
            value,
            allowed: "a height that the body reaches at a finite radius greater than 0",
        })
    }

    pub(crate) const fn boundary_reached(&self, sliding_distance: f64) -> BemError {
        let Self {
            x: [x_min, x_max],
            y: [y_min, y_max],
        } = *self;
        BemError::ContactReachesBoundary {
            sliding_distance,
            x_min,
            x_max,
            y_min,
            y_max,
        }
    }

    /// Number of elements behind and ahead of, right and left of the element under the lowest point.
    pub(crate) fn elements(&self, spacing: [f64; 2]) -> Result<[[usize; 2]; 2], BemError> {
        let mut counts = [[0; 2]; 2];
        for (axis, (ends, name)) in [(self.x, "footprint along x"), (self.y, "footprint along y")]
            .into_iter()
            .enumerate()
        {
            for (side, end) in [-ends[0], ends[1]].into_iter().enumerate() {
                positive(name, end)?;
                counts[axis][side] = elements_along(end, spacing[axis])?;
            }
        }
        Ok(counts)
    }
}

fn radius_at_height(body: &(impl Axisymmetric + ?Sized), height: f64) -> Option<f64> {
    let above = |radius: f64| body.profile_height(radius) >= height;
    let mut radius = if body.max_radius().is_finite() {
        body.max_radius()
    } else {
        1.0
    };
    while !above(radius) && radius < 0.25 * f64::MAX && radius < body.max_radius() {
        radius *= 2.0;
    }
    while above(0.5 * radius) && radius > f64::MIN_POSITIVE {
        radius *= 0.5;
    }
    let excess = |radius: f64| (body.profile_height(radius) - height).clamp(-height, height);
    bracketed_root(excess, [0.5 * radius, radius]).or(above(radius).then_some(radius))
}
