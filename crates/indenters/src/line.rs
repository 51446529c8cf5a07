//! Rigid lines of the one-dimensional model.

use crate::Axisymmetric;
use crate::forward::forward;
use crate::monotone_breaks::find_breaks;

/// A continuous rigid line h̃(x) on a closed interval, which moves towards positive x.
pub trait RigidLine {
    /// Height h̃(x), \[m], at a position of the domain; `+∞` outside.
    fn height(&self, x: f64) -> f64;

    /// Slope h̃'(x), at a position of the domain; at a kink one of the two one-sided slopes, finite where one of them is.
    fn slope(&self, x: f64) -> f64;

    /// The interval X on which the line is given, \[m]. Its ends may be infinite.
    fn domain(&self) -> [f64; 2];

    /// Positions inside the domain at which the slope jumps or is singular, increasing.
    fn kinks(&self) -> Vec<f64> {
        Vec::new()
    }

    /// Exponent p of the line h̃ ∼ |x|^p around its lowest point; 1 where nothing is known.
    fn apex_exponent(&self) -> f64 {
        1.0
    }

    /// Positions, increasing, from end to end of the finite domain, between which the line only rises or only falls.
    ///
    /// Found by looking for one change of sign of the slope in each of `samples` equal intervals. A line that knows its
    /// turning points overrides this.
    fn monotone_breaks(&self, samples: usize) -> Vec<f64> {
        find_breaks(self, samples)
    }
}

forward!(RigidLine, {
    fn height(&self, x: f64) -> f64;
    fn slope(&self, x: f64) -> f64;
    fn domain(&self) -> [f64; 2];
    fn kinks(&self) -> Vec<f64>;
    fn apex_exponent(&self) -> f64;
    fn monotone_breaks(&self, samples: usize) -> Vec<f64>;
});

/// The equivalent line of a body of revolution, `h̃(x)`, with its apex at `x = 0`.
#[derive(Debug, PartialEq)]
pub struct EquivalentLine<'a, P: ?Sized>(pub &'a P);

// Not derived, because the body itself need not be one that can be copied.
impl<P: ?Sized> Clone for EquivalentLine<'_, P> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<P: ?Sized> Copy for EquivalentLine<'_, P> {}

impl<P: Axisymmetric + ?Sized> RigidLine for EquivalentLine<'_, P> {
    fn height(&self, x: f64) -> f64 {
        self.0.line_height(x)
    }

    fn slope(&self, x: f64) -> f64 {
        self.0.line_slope(x)
    }

    fn domain(&self) -> [f64; 2] {
        [-self.0.max_radius(), self.0.max_radius()]
    }

    fn apex_exponent(&self) -> f64 {
        self.0.profile_exponent()
    }

    fn kinks(&self) -> Vec<f64> {
        let radii: Vec<f64> = self.0.kinks().iter().map(|kink| kink.radius).collect();
        let mirrored = radii.iter().rev().map(|radius| -radius);
        mirrored
            .chain(std::iter::once(0.0))
            .chain(radii.iter().copied())
            .collect()
    }
}
