//! Bodies of revolution given by a table of radii and heights.
//!
//! ```text
//! h̃(x) = x Σ m_i [arcsin(min(r_(i+1), x) / x) − arcsin(min(r_i, x) / x)]        m_i slope of piece i
//! ```

use crate::right_triangle::{arc_sine_difference, leg};
use crate::table::check_table;
use crate::{Axisymmetric, IndenterError, Kink, LinePoint, ProfilePoint, surface_of_revolution};
use numerics::in_range;

/// A body of revolution with a straight profile between the rows of a table; it ends at the last radius.
///
/// Every knot is a ring-shaped edge. The slope of the equivalent line is singular at an upward jump of the slope, and the
/// line itself turns down at a downward jump. A table of a smooth body is therefore a poor model of its friction.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct PiecewiseLinearProfile {
    /// Radii of the points, increasing from 0, \[m].
    radii: Vec<f64>,
    /// Heights of the points, \[m].
    heights: Vec<f64>,
    /// Slope of each piece.
    #[cfg_attr(feature = "serde", serde(skip))]
    slopes: Vec<f64>,
    /// Jumps of the slope at the knots.
    #[cfg_attr(feature = "serde", serde(skip))]
    kinks: Vec<Kink>,
}

impl PiecewiseLinearProfile {
    /// The profile through the points (`radii[i]`, `heights[i]`), \[m]; both lists begin with 0, the radii increase and no
    /// height is negative.
    ///
    /// # Errors
    /// [`IndenterError`] `LengthMismatch`, `TooFew` (two rows are needed), `NotIncreasing` or `InvalidParameter`.
    pub fn new(radii: Vec<f64>, heights: Vec<f64>) -> Result<Self, IndenterError> {
        check_table("radii", &radii, &heights)?;
        in_range("first radius", radii[0], radii[0] == 0.0, "0")?;
        in_range("first height", heights[0], heights[0] == 0.0, "0")?;
        for &height in &heights {
            let allowed = "at least 0, the height of the lowest point";
            in_range("heights", height, height >= 0.0, allowed)?;
        }
        let slope = |i: usize| (heights[i] - heights[i - 1]) / (radii[i] - radii[i - 1]);
        let slopes: Vec<f64> = (1..radii.len()).map(slope).collect();
        let kinks = find_kinks(&radii, &heights, &slopes);
        Ok(Self {
            radii,
            heights,
            slopes,
            kinks,
        })
    }

    /// Radii of the table, \[m].
    pub fn radii(&self) -> &[f64] {
        &self.radii
    }

    /// Heights of the table, \[m].
    pub fn heights(&self) -> &[f64] {
        &self.heights
    }

    /// Index i of the piece whose half-open interval ]r_i, r_(i+1)] holds the radius \[m]; the first piece for a radius of 0.
    fn piece_at(&self, radius: f64) -> usize {
        let inner_knots = &self.radii[1..self.radii.len() - 1];
        inner_knots.partition_point(|knot| *knot < radius)
    }

    /// Sum Σ m_i φ_i = h̃(x) / x over the pieces, with the angle φ_i = arcsin(r_(i+1) / x) − arcsin(r_i / x).
    fn slope_sum(&self, x: f64) -> f64 {
        let pieces = self.radii.windows(2).zip(&self.slopes);
        let angle = |ends: &[f64]| arc_sine_difference([ends[0], ends[1].min(x)], x);
        pieces
            .take_while(|(ends, _)| ends[0] < x)
            .map(|(ends, slope)| slope * angle(ends))
            .sum()
    }
}

/// Jumps of the slope, without those that are rounding errors of collinear heights.
fn find_kinks(radii: &[f64], heights: &[f64], slopes: &[f64]) -> Vec<Kink> {
    let is_kink = |i: &usize| {
        let jump = slopes[*i] - slopes[i - 1];
        let narrow = (radii[*i] - radii[i - 1]).min(radii[i + 1] - radii[*i]);
        let high = heights[i - 1].max(heights[*i]).max(heights[i + 1]);
        jump.abs() > SLOPE_ROUNDING * high / narrow
    };
    let kink = |i| Kink {
        radius: radii[i],
        slope_jump: slopes[i] - slopes[i - 1],
    };
    (1..slopes.len()).filter(is_kink).map(kink).collect()
}

/// Bound on the ratio of the rounding error of a slope jump to the ratio of height to width of a piece.
///
/// Derived: two slopes, each with one rounding of two heights, of their difference and of the quotient.
const SLOPE_ROUNDING: f64 = 8.0 * f64::EPSILON;

impl Axisymmetric for PiecewiseLinearProfile {
    fn profile(&self, radius: f64) -> ProfilePoint {
        if radius > self.max_radius() {
            return ProfilePoint::ENDED;
        }
        let i = self.piece_at(radius);
        let fraction = (radius - self.radii[i]) / (self.radii[i + 1] - self.radii[i]);
        ProfilePoint {
            height: self.heights[i] + fraction * (self.heights[i + 1] - self.heights[i]),
            slope: self.slopes[i],
            curvature: 0.0,
        }
    }

    fn profile_exponent(&self) -> f64 {
        if self.slopes[0] == 0.0 {
            return f64::INFINITY;
        }
        1.0
    }

    fn max_radius(&self) -> f64 {
        self.radii[self.radii.len() - 1]
    }

    fn kinks(&self) -> Vec<Kink> {
        self.kinks.clone()
    }

    fn closed_line(&self, x: f64) -> Option<LinePoint> {
        if x > self.max_radius() {
            return Some(LinePoint::ENDED);
        }
        // The slope is the mean slope, with an inverse root behind each kink.
        let kinks = self.kinks.iter().take_while(|kink| kink.radius < x);
        let singular = kinks.map(|kink| kink.slope_jump * (kink.radius / leg(x, kink.radius)));
        let smooth = match x {
            0.0 => self.slopes[0] * std::f64::consts::FRAC_PI_2,
            _ => self.slope_sum(x),
        };
        Some(LinePoint {
            height: x * smooth,
            slope: smooth + singular.sum::<f64>(),
        })
    }
}

surface_of_revolution!(PiecewiseLinearProfile);
