//! Rigid surfaces in three dimensions.

use auto_impl::auto_impl;

use crate::extent::search;
use crate::{Axisymmetric, IndenterError};

/// Largest height at the origin, in units of the depth of a contact, that is taken for 0. Chosen: it changes a depth by less than any
/// relative error that the half space can be asked for, and allows for rounding in a body 10⁹ times as large as the depth.
const MAX_HEIGHT_AT_ORIGIN: f64 = 1e-6;

/// The surface of a rigid body: height and gradient over the (x, y) plane.
///
/// Only [`height`](Self::height) and [`gradient`](Self::gradient) must be implemented; see the example
/// `custom_surface.rs`. The macro [`surface_of_revolution!`](crate::surface_of_revolution) implements the trait for an
/// [`Axisymmetric`] body.
#[auto_impl(&, Box, Arc)]
pub trait Surface: Send + Sync {
    /// Height h(x, y) above the lowest point, which is the origin, \[m], at a `[x, y]` position \[m]; `+∞` where there is no body.
    /// Solvers refuse a height that is NaN or −∞; those that choose their grid also one at the origin that is not 0.
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

/// Checks the height \[m] of a surface at a position [x, y] \[m], and returns it.
///
/// # Errors
/// [`IndenterError::InvalidHeight`] for NaN and −∞.
pub fn checked_height(height: f64, position: [f64; 2]) -> Result<f64, IndenterError> {
    if height.is_nan() || height == f64::NEG_INFINITY {
        return Err(IndenterError::InvalidHeight { position, height });
    }
    Ok(height)
}

/// Checks that the height of a surface at the origin is 0, to 10⁻⁶ of the `depth` \[m] of a contact; with an infinite depth, that it
/// is finite.
///
/// # Errors
/// [`IndenterError::InvalidHeight`] for NaN and −∞; [`IndenterError::LowestPointNotZero`] for any other height.
pub fn check_lowest_point(surface: &dyn Surface, depth: f64) -> Result<(), IndenterError> {
    let height = checked_height(surface.height([0.0; 2]), [0.0; 2])?;
    if height.is_finite() && height.abs() <= MAX_HEIGHT_AT_ORIGIN * depth {
        return Ok(());
    }
    Err(IndenterError::LowestPointNotZero { height })
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
