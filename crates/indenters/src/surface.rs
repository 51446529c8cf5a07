//! Rigid surfaces in three dimensions.

use crate::Axisymmetric;

/// The surface of a rigid body as the half space sees it: height and gradient over the plane.
///
/// Every [`Axisymmetric`] body is one; other bodies implement it themselves.
///
/// ```
/// use indenters::{PowerProfile, Surface};
///
/// /// An infinitely long cylinder across the direction of motion, as a parabola.
/// struct Cylinder {
///     curvature: f64,
/// }
///
/// impl Surface for Cylinder {
///     fn height(&self, [x, _]: [f64; 2]) -> f64 {
///         self.curvature * x * x
///     }
///
///     fn gradient(&self, [x, _]: [f64; 2]) -> [f64; 2] {
///         [2.0 * self.curvature * x, 0.0]
///     }
/// }
///
/// # fn main() -> Result<(), indenters::IndenterError> {
/// let cylinder = Cylinder { curvature: 0.5 };
/// let paraboloid = PowerProfile::paraboloid(0.5)?;
/// assert_eq!(cylinder.gradient([0.3, 0.4]), [0.3, 0.0]);
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
}
