//! Rigid surfaces in three dimensions.

use crate::Axisymmetric;

/// The surface of a rigid body as the half space sees it: height and gradient over the plane.
pub trait Surface {
    /// Height h(x, y) above the lowest point, [m], at a `[x, y]` position [m]; `+∞` where there is no body.
    fn height(&self, position: [f64; 2]) -> f64;

    /// Gradient [∂h/∂x, ∂h/∂y]; zero at the apex of a body of revolution, whatever its exponent.
    fn gradient(&self, position: [f64; 2]) -> [f64; 2];
}

impl<P: Axisymmetric> Surface for P {
    fn height(&self, [x, y]: [f64; 2]) -> f64 {
        Axisymmetric::height(self, x.hypot(y))
    }

    fn gradient(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let radius = x.hypot(y);
        if radius == 0.0 {
            return [0.0, 0.0];
        }
        let slope = self.slope(radius);
        [slope * (x / radius), slope * (y / radius)]
    }
}
