//! Rigid surfaces in three dimensions.

use crate::Axisymmetric;

/// The surface of a rigid body as the half space sees it: height and gradient over the plane.
///
/// Every [`Axisymmetric`] body is one; other bodies implement it themselves.
///
/// ```
/// use indenters::{PowerProfile, Surface};
///
/// /// A paraboloid that is flatter across the direction of motion.
/// struct Ellipse {
///     curvatures: [f64; 2],
/// }
///
/// impl Surface for Ellipse {
///     fn height(&self, [x, y]: [f64; 2]) -> f64 {
///         self.curvatures[0] * x * x + self.curvatures[1] * y * y
///     }
///
///     fn gradient(&self, [x, y]: [f64; 2]) -> [f64; 2] {
///         [2.0 * self.curvatures[0] * x, 2.0 * self.curvatures[1] * y]
///     }
///
///     fn mirrors(&self) -> [bool; 2] {
///         [true; 2]
///     }
/// }
///
/// # fn main() -> Result<(), indenters::IndenterError> {
/// let ellipse = Ellipse { curvatures: [0.5, 0.25] };
/// let paraboloid = PowerProfile::paraboloid(0.5)?;
/// assert_eq!(ellipse.gradient([0.3, 0.4]), [0.3, 0.2]);
/// assert!((paraboloid.gradient([0.3, 0.4])[1] - 0.4).abs() < 1e-15);
/// # Ok(())
/// # }
/// ```
pub trait Surface {
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
}

impl<P: Axisymmetric> Surface for P {
    fn height(&self, [x, y]: [f64; 2]) -> f64 {
        Axisymmetric::height(self, x.hypot(y))
    }

    fn gradient(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let radius = x.hypot(y);
        if radius == 0.0 || radius > self.max_radius() {
            return [0.0, 0.0];
        }
        let slope = self.slope(radius);
        // A vertical wall, as at the equator of the sphere: the body has ended.
        if slope == f64::INFINITY {
            return [0.0, 0.0];
        }
        // A slope that overflows must not meet a zero.
        [x, y].map(|along| {
            if along == 0.0 {
                0.0
            } else {
                slope * (along / radius)
            }
        })
    }

    fn mirrors(&self) -> [bool; 2] {
        [true; 2]
    }
}

/// A surface that does not tell of its mirrors, so that solvers compute both sides of them.
///
/// The answers are the same up to rounding, but for slopes on kinks, which have two: this is for those who want to see
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
}
