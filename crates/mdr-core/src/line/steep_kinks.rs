//! Kinks at which the friction diverges on a material with a parallel dashpot.
//!
//! Behind an upward jump of the slope of a body its equivalent line is as steep as the inverse root of the distance δ from
//! the kink. ∫ h̃'² dx (16) then diverges like ln δ, which a sum over pieces would not show where the jump is small.

use indenters::RigidLine;

/// First distance from a kink at which the slope is computed, relative to the position of the kink. Chosen: the leading term of
/// the slope prevails there, and at the third distance, 2⁻²⁴, positions round by 2⁻²⁹ of the distance only.
const FIRST_KINK_DISTANCE: f64 = 1.0 / (1 << 20) as f64;
/// Ratio of successive distances from a kink at which the slope is computed. Chosen: over it an inverse root grows by the factor 2,
/// far above rounding, from which [`MIN_DIFFERENCE_RATIO`] follows.
const KINK_DISTANCE_RATIO: f64 = 0.25;
/// Smallest ratio of the differences of slopes from distance to distance at a steep kink. Derived: it is 2 for the inverse root,
/// at which the integral of the squared slope diverges; the rest is a margin for rounding.
const MIN_DIFFERENCE_RATIO: f64 = 1.99;
/// Difference of two slopes, relative to the slopes, up to which it counts as rounding. Derived: at the second distance, 2⁻²² of
/// the position, positions round by 2⁻³¹ of the distance, so that an inverse root errs by 2⁻³², or 2e-10; the factor of four is a
/// margin.
const SLOPE_ROUNDING: f64 = 1e-9;

/// A side of a kink on which the slope is unbounded.
pub(crate) struct SteepKink {
    /// Position of the kink, \[m].
    pub(crate) position: f64,
    /// The part of the line that is steep, \[m].
    side: [f64; 2],
}

/// True if a line has kinks at which its slope is unbounded.
pub(crate) fn has_steep_kinks(line: &dyn RigidLine) -> bool {
    !SteepKink::all_of(line).is_empty()
}

impl SteepKink {
    /// All steep kinks of a line except at x = 0, where a cusp is resolved as far as numbers reach.
    pub(crate) fn all_of(line: &dyn RigidLine) -> Vec<Self> {
        let kinks = line.kinks().into_iter().filter(|kink| *kink != 0.0);
        let sides = kinks.flat_map(|position| [-1.0, 1.0].map(|side| (position, side)));
        let steep = sides.filter(|&(position, side)| is_steep(line, position, side));
        let kink = |(position, side): (f64, f64)| {
            let end = position + side * FIRST_KINK_DISTANCE * position.abs();
            let side = [position.min(end), position.max(end)];
            Self { position, side }
        };
        steep.map(kink).collect()
    }

    /// True if the steep side is in one of the contacts `[rear, front]`, or begins at its end.
    ///
    /// A contact that reaches beyond a kink by less than the rounding of its position counts as reaching beyond it.
    pub(crate) fn is_in(&self, contacts: &[[f64; 2]]) -> bool {
        let [first, last] = self.side;
        contacts
            .iter()
            .any(|[rear, front]| *rear <= last && *front >= first)
    }
}

/// True if the slope grows towards the kink at `position` \[m] at least like the inverse root of the distance, on the `side` −1 or
/// 1 of it.
fn is_steep(line: &dyn RigidLine, position: f64, side: f64) -> bool {
    let parts = [
        1.0,
        KINK_DISTANCE_RATIO,
        KINK_DISTANCE_RATIO * KINK_DISTANCE_RATIO,
    ];
    let [far, near, nearest] =
        parts.map(|part| line.slope(position + side * part * FIRST_KINK_DISTANCE * position.abs()));
    let (first, second) = (near - far, nearest - near);
    first > SLOPE_ROUNDING * near.abs()
        && second >= MIN_DIFFERENCE_RATIO * first
        && second.is_finite()
}
