//! Kinks at which the friction of a lone dashpot has no limit.
//!
//! Behind an upward jump of its slope the equivalent line of a body is as steep as the inverse root of the distance
//! δ from the kink; ∫ h̃'² dx (16) then diverges like ln δ. A sum over pieces would not see it where the jump is small.

use indenters::RigidLine;

/// First distance from a kink at which the slope is taken, relative to the position of the kink.
const REACH: f64 = 1.0 / (1 << 20) as f64;
/// By which the distances of the second and third slope are smaller each.
const CLOSER: f64 = 0.25;
/// What differences of an inverse root grow by from distance to distance, less what smaller powers leave.
const GROWTH: f64 = 1.99;
/// Differences of slopes below this part of them are rounding.
const ROUNDING: f64 = 1e-9;

/// A side of a kink on which the slope has no limit.
pub(super) struct SteepKink {
    pub(super) position: f64,
    /// The part of the line that is steep, \[m].
    side: [f64; 2],
}

/// Whether a line has kinks at which it is steeper than any number.
pub(crate) fn has_steep_kinks(line: &dyn RigidLine) -> bool {
    !SteepKink::all_of(line).is_empty()
}

impl SteepKink {
    /// Those of a line, apart from x = 0, where a cusp is resolved as far as numbers reach.
    pub(super) fn all_of(line: &dyn RigidLine) -> Vec<Self> {
        let kinks = line.kinks().into_iter().filter(|kink| *kink != 0.0);
        let sides = kinks.flat_map(|position| [-1.0, 1.0].map(|side| (position, side)));
        let steep = sides.filter(|&(position, side)| is_steep(line, position, side));
        let kink = |(position, side): (f64, f64)| {
            let end = position + side * REACH * position.abs();
            let side = [position.min(end), position.max(end)];
            Self { position, side }
        };
        steep.map(kink).collect()
    }

    /// Whether the steep side is in one of the contacts `[rear, front]`, or begins where that ends: what reaches beyond a
    /// kink by less than the rounding of its position reaches beyond it all the same.
    pub(super) fn is_in(&self, contacts: &[[f64; 2]]) -> bool {
        let [first, last] = self.side;
        let mut contacts = contacts.iter();
        contacts.any(|[rear, front]| *rear <= last && *front >= first)
    }
}

/// Whether the slope rises beyond all limits towards the kink, at least like the inverse root of the distance.
fn is_steep(line: &dyn RigidLine, position: f64, side: f64) -> bool {
    let parts = [1.0, CLOSER, CLOSER * CLOSER];
    let [far, near, nearest] =
        parts.map(|part| line.slope(position + side * part * REACH * position.abs()));
    let (first, second) = (near - far, nearest - near);
    first > ROUNDING * near.abs() && second >= GROWTH * first && second.is_finite()
}
