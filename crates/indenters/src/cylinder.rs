//! The infinitely long cylinder with its axis along y, across the direction of motion.
//!
//! ```text
//! h(x) = x²/(2R)
//! ```

use crate::Surface;
use crate::shape::shape;

shape! {
    /// The parabolic cylinder of the theory of line contacts, infinite along y (Hertz 1881; Hunter 1961).
    Cylinder;
    /// A cylinder of `radius` R > 0 \[m].
    new;
    /// Radius R, \[m].
    radius: radius;
}

impl Surface for Cylinder {
    fn height(&self, [x, _]: [f64; 2]) -> f64 {
        0.5 * x * (x / self.radius)
    }

    fn gradient(&self, [x, _]: [f64; 2]) -> [f64; 2] {
        [x / self.radius, 0.0]
    }

    fn mirrors(&self) -> [bool; 2] {
        [true; 2]
    }

    fn extent_below(&self, height: f64) -> [[f64; 2]; 2] {
        let half = (2.0 * self.radius).sqrt() * height.max(0.0).sqrt();
        [[-half, half], [f64::NEG_INFINITY, f64::INFINITY]]
    }

    fn apex_exponent(&self) -> f64 {
        2.0
    }
}
