//! Rigid surfaces in three dimensions.

use auto_impl::auto_impl;

use crate::Axisymmetric;
use crate::extent::search;

/// The surface of a rigid body: height and gradient over the (x, y) plane.
///
/// Only [`height`](Self::height) and [`gradient`](Self::gradient) must be implemented; see the example
/// `custom_surface.rs`. The macro [`surface_of_revolution!`](crate::surface_of_revolution) implements the trait for an
/// [`Axisymmetric`] body.
#[auto_impl(&, Box, Arc)]
pub trait Surface: Send + Sync {
    /// Height h(x, y) above the lowest point, \[m], at a `[x, y]` position \[m]; `+∞` where there is no body.
    fn height(&self, position: [f64; 2]) -> f64;

    /// Gradient [∂h/∂x, ∂h/∂y]; zero where there is no body, and at the apex of a body of revolution for any exponent.
    fn gradient(&self, position: [f64; 2]) -> [f64; 2];

    /// Mirror symmetries: whether h(−x, y) = h(x, y), and whether h(x, −y) = h(x, y), everywhere up to rounding.
    ///
    /// The gradient has the same symmetry except on kinks. Solvers restrict themselves to one side of each mirror plane; the
    /// default `false` makes them compute both.
    fn mirrors(&self) -> [bool; 2] {
        [false; 2]
    }

    /// Rectangle `[[x_min, x_max], [y_min, y_max]]` \[m] that contains the origin and every point lower than `height` \[m].
    ///
    /// An end is infinite where the surface never rises above the height. The default implementation searches grids from the
    /// origin outwards. It misses parts narrower than a thirtieth of their distance from the origin, and parts a thousand
    /// times as far away as all others. Its rectangle is up to a tenth too large.
    fn extent_below(&self, height: f64) -> [[f64; 2]; 2] {
        search(height, |position| self.height(position) < height)
    }

    /// Leading exponent p of h ∼ c r^p at the lowest point; 1 if unknown.
    fn apex_exponent(&self) -> f64 {
        1.0
    }

    /// Length along x of the cells of a gridded surface, at whose ends the slope may jump, \[m].
    ///
    /// The lowest point lies on an end of a cell. `None` if the slope is continuous, or if nothing is known.
    fn cell_length(&self) -> Option<f64> {
        None
    }

    /// The surface as a body of revolution about the origin, if it is one.
    fn as_axisymmetric(&self) -> Option<&dyn Axisymmetric> {
        None
    }
}

/// A surface that reports no mirror symmetry, so that solvers compute both sides of each mirror plane.
///
/// The results agree up to rounding, except for slopes on kinks, which are one-sided. It serves to test the symmetry
/// reduction and to measure what it saves.
#[derive(Debug, Clone, Copy)]
pub struct Unmirrored<'a, S: ?Sized>(pub &'a S);

impl<S: Surface + ?Sized> Surface for Unmirrored<'_, S> {
    fn height(&self, position: [f64; 2]) -> f64 {
        self.0.height(position)
    }

    fn gradient(&self, position: [f64; 2]) -> [f64; 2] {
        self.0.gradient(position)
    }

    fn extent_below(&self, height: f64) -> [[f64; 2]; 2] {
        self.0.extent_below(height)
    }

    fn apex_exponent(&self) -> f64 {
        self.0.apex_exponent()
    }

    fn cell_length(&self) -> Option<f64> {
        self.0.cell_length()
    }
}
