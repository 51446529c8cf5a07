//! Rigid surfaces in three dimensions.

use auto_impl::auto_impl;

use crate::Axisymmetric;
use crate::extent::search;

/// The surface of a rigid body as the half space sees it: height and gradient over the plane.
///
/// Only height and gradient have to be given; all bodies of this crate are surfaces, and
/// [`surface_of_revolution!`](crate::surface_of_revolution) makes an own [`Axisymmetric`] body one.
///
/// The example `custom_surface.rs` of this crate is a surface of its own.
#[auto_impl(&, Box, Arc)]
pub trait Surface: Send + Sync {
    /// Height h(x, y) above the lowest point, \[m], at a `[x, y]` position \[m]; `+∞` where there is no body.
    fn height(&self, position: [f64; 2]) -> f64;

    /// Gradient [∂h/∂x, ∂h/∂y]; zero at the apex of a body of revolution, whatever its exponent, and
    /// where there is no body.
    fn gradient(&self, position: [f64; 2]) -> [f64; 2];

    /// Whether h(−x, y) = h(x, y), and whether h(x, −y) = h(x, y), everywhere and up to rounding, and the gradient
    /// accordingly but on kinks. Solvers then do without one side of the mirror; a surface that does not say so is computed
    /// on both.
    fn mirrors(&self) -> [bool; 2] {
        [false; 2]
    }

    /// The rectangle `[[x_min, x_max], [y_min, y_max]]` \[m] that holds every point lower than `height` \[m]; infinite where
    /// the surface stays low without end.
    ///
    /// Unless a surface knows it, it is searched on grids from the origin outwards: parts narrower than a thirtieth of their
    /// distance from it, or a thousand times as far away as the others, are not seen. The rectangle holds the origin too, and
    /// is a tenth too large.
    fn extent_below(&self, height: f64) -> [[f64; 2]; 2] {
        search(height, |position| self.height(position) < height)
    }

    /// Leading exponent p of h ∼ c r^p at the lowest point; 1 where nothing is known.
    fn apex_exponent(&self) -> f64 {
        1.0
    }

    /// Length along x of the cells at whose ends the slope may jump, the lowest point among them, \[m]; `None` where it jumps nowhere
    /// or nothing is known.
    fn cell_length(&self) -> Option<f64> {
        None
    }

    /// The surface as a body of revolution about the origin, if it is one.
    fn as_axisymmetric(&self) -> Option<&dyn Axisymmetric> {
        None
    }
}

/// A surface whose mirrors are hidden, so that solvers compute both sides of them.
///
/// The results are the same up to rounding, but for slopes on kinks, which have two: this is for those who want to see
/// that, or what a mirror saves.
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
