//! A segment of the line as a polynomial, from its front end to its rear end.

use super::legendre::{Interpolation, Polynomial, derivative, end_value, value};

/// Rounding of the displacements of a part, which is interpolated once more, in depths. Derived: a sum of eleven terms of up to
/// one depth, with roundings of up to half a unit in the last place, errs by at most 5.5 units.
const REINTERPOLATION_ROUNDING: f64 = 8.0 * f64::EPSILON;

/// Compression that a piece of the line imposes, as a polynomial in −1 ≤ t ≤ 1 from the front to the rear.
#[derive(Debug, Clone)]
pub(crate) struct Segment {
    /// Legendre coefficients of u = d − h̃, in depths.
    pub(crate) displacements: Polynomial,
    /// Coefficients above this one are zero.
    pub(crate) degree: usize,
    /// Positions of the front and the rear end, \[m].
    pub(crate) ends: [f64; 2],
    /// Length, \[m].
    pub(crate) length: f64,
    /// Rounding of the displacements, in depths; 0 for a whole piece, whose heights are relative to the lowest point.
    pub(crate) rounding: f64,
}

impl Segment {
    /// Position on the line at −1 ≤ t ≤ 1, within the ends of the segment, \[m].
    pub(crate) fn position(&self, t: f64) -> f64 {
        0.5 * (self.ends[0] * (1.0 - t) + self.ends[1] * (1.0 + t))
    }

    /// Displacement u of the line at −1 ≤ t ≤ 1, in depths.
    pub(crate) fn displacement(&self, t: f64) -> f64 {
        value(&self.displacements[..=self.degree], t)
    }

    /// Change of the displacement with the distance ξ, in depths per metre.
    pub(crate) fn rate(&self, t: f64) -> f64 {
        2.0 / self.length * value(&derivative(&self.displacements), t)
    }

    /// Displacement at the rear end, in depths.
    pub(crate) fn end(&self) -> f64 {
        end_value(&self.displacements)
    }

    /// The part of the segment over an interval of t, as a polynomial of its own −1 ≤ t ≤ 1.
    pub(crate) fn between(&self, interpolation: &Interpolation, interval: [f64; 2]) -> Self {
        let [from, to] = interval;
        if from <= -1.0 && to >= 1.0 {
            return self.clone();
        }
        let half = 0.5 * (to - from);
        let inside = |s: f64| self.displacement(0.5 * (from + to) + half * s);
        let mut displacements = interpolation.interpolate(inside);
        // Interpolation leaves rounding in the terms above the degree.
        displacements[self.degree + 1..].fill(0.0);
        Self {
            displacements,
            degree: self.degree,
            ends: [self.position(from), self.position(to)],
            length: half * self.length,
            rounding: REINTERPOLATION_ROUNDING,
        }
    }
}
