//! A cylinder across the direction of motion, without end.
//!
//! ```text
//! h(x) = x²/(2R)
//! ```

use crate::Surface;
use crate::shape::shape;

shape! {
    /// The parabola of a cylinder that is infinite along y, as in the theory of line contacts (Hertz 1881; Hunter 1961).
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn heights_and_slopes_are_those_of_the_parabola_at_every_scale() {
        for scale in [1e-150, 1.0, 1e150] {
            let cylinder = Cylinder::new(2.0 * scale).expect("a cylinder");
            let [height, slope] = [
                cylinder.height([scale, 7.0]) / scale,
                cylinder.gradient([scale, 7.0])[0],
            ];
            assert!(
                (height - 0.25).abs() < 1e-15 && (slope - 0.5).abs() < 1e-15,
                "scale {scale:e}: height {height} instead of 0.25, slope {slope} instead of 0.5"
            );
        }
    }

    #[test]
    fn a_radius_that_is_none_is_refused() {
        for radius in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(
                Cylinder::new(radius).is_err(),
                "accepted the radius {radius}"
            );
        }
    }
}
