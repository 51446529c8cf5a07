//! Contact radius of a body of revolution at a given depth.
//!
//! ```text
//! h̃(a) = d,   h̃ rising on [0, a]
//! ```

use crate::leading_edge::crossing;
use crate::{Axisymmetric, EquivalentLine, IndenterError};
use numerics::{InvalidParameter, bracketed_root, in_range, positive};

/// Step of the search, the eighth part of an octave.
const STEP: f64 = 1.090_507_732_665_257_7;
/// Octaves over which the line must follow its leading power before everything below it is taken as the apex.
const APEX_OCTAVES: u32 = 40;
/// How closely it must do so there, relative to the exponent.
const APEX_DEVIATION: f64 = 1e-2;
/// A fall below this, relative to height over radius, is rounding.
const ROUNDING: f64 = 1e-12;

/// Radius a \[m] of the contact circle at an indentation `depth` d > 0 \[m]: the smallest with h̃(a) = d.
///
/// A body that is flat to its end, as [`FlatPunch`](crate::FlatPunch), has its own radius at every depth. The line is
/// searched from the apex outwards in steps of a tenth of the radius; valleys narrower than that are not seen unless they
/// begin at a kink. The error of an unreachable depth holds the limiting radius.
///
/// # Errors
/// [`IndenterError::NonMonotoneLine`] when the line turns down first, `NotHighEnough` when the body ends first,
/// `InvalidParameter` when the depth is out of its range, already exceeded at the smallest radius that is a number, or the
/// line is not a number somewhere.
pub fn contact_radius(
    body: &(impl Axisymmetric + ?Sized),
    depth: f64,
) -> Result<f64, IndenterError> {
    let depth = positive("depth", depth)?;
    let search = Search { body, depth };
    // Where the slope jumps downwards; just outside the line falls.
    let mut falling = body.kinks();
    falling.retain(|kink| kink.slope_jump < 0.0);
    let edges: Vec<f64> = falling.iter().map(|kink| kink.radius).collect();
    let mut inner = search.apex_side()?;
    loop {
        if edges.contains(&inner) {
            return Err(search.turns_down_at(inner));
        }
        let next = (inner * STEP).min(body.max_radius());
        let edge = edges.iter().find(|edge| **edge > inner);
        let outer = edge.map_or(next, |edge| next.min(*edge));
        if outer <= inner || outer.is_infinite() {
            return search.end_of_body(inner);
        }
        let turn = search.turning_point([inner, outer])?;
        let reached = turn.unwrap_or(outer);
        if search.line(reached)? >= depth {
            return Ok(crossing(&EquivalentLine(body), [inner, reached], depth)?);
        }
        if turn.is_some() {
            return Err(search.turns_down_at(reached));
        }
        inner = outer;
    }
}

struct Search<'a, P: ?Sized> {
    body: &'a P,
    depth: f64,
}

impl<P: Axisymmetric + ?Sized> Search<'_, P> {
    fn line(&self, x: f64) -> Result<f64, InvalidParameter> {
        let value = self.body.line_height(x);
        let holds = !value.is_nan();
        in_range("height of the equivalent line", value, holds, "a number")
    }

    /// A radius below the contact radius, inside which the line rises like its leading power.
    fn apex_side(&self) -> Result<f64, InvalidParameter> {
        // Where the descent begins has no influence on what it finds; 1 m stands for "anywhere".
        let first_kink = self.body.kinks().first().map(|kink| kink.radius);
        let end = Some(self.body.max_radius()).filter(|end| end.is_finite());
        let mut x = end.or(first_kink).unwrap_or(1.0);
        let mut candidate = None;
        let mut octaves = 0;
        while octaves < APEX_OCTAVES && x >= f64::MIN_POSITIVE {
            let height = self.line(x)?;
            if height == 0.0 {
                candidate = candidate.or(Some(x));
                break;
            }
            let exponent = x * self.body.line_slope(x) / height;
            let deviation = (exponent / self.body.profile_exponent() - 1.0).abs();
            if height < self.depth && deviation <= APEX_DEVIATION {
                candidate = candidate.or(Some(x));
                octaves += 1;
            } else {
                (candidate, octaves) = (None, 0);
            }
            x *= 0.5;
        }
        candidate.ok_or(InvalidParameter {
            parameter: "depth",
            value: self.depth,
            allowed: "greater than the height of the line at the smallest positive radius",
        })
    }

    /// The highest point inside the interval when the line falls somewhere in it.
    fn turning_point(&self, [inner, outer]: [f64; 2]) -> Result<Option<f64>, InvalidParameter> {
        let Some(falling) = self.falling_point([inner, outer])? else {
            return Ok(None);
        };
        // Where the line is still flat (or its height underflows) it has not turned yet.
        let slope = |x: f64| match self.body.line_slope(x) {
            0.0 => f64::MIN_POSITIVE,
            other => other,
        };
        // One step outside, because at a kink the slope is the one inside.
        let first = inner.next_up();
        if slope(first) < 0.0 {
            return Ok(Some(inner));
        }
        let turn = bracketed_root(slope, [first, falling]).unwrap_or(f64::NAN);
        let holds = !turn.is_nan();
        in_range("slope of the equivalent line", turn, holds, "a number").map(Some)
    }

    fn falling_point(&self, [inner, outer]: [f64; 2]) -> Result<Option<f64>, InvalidParameter> {
        let [mut start, mut end] = [inner, outer];
        while !self.falls(end)? {
            let lost = self.line(start)? - self.line(end)?;
            let middle = 0.5 * (start + end);
            let lowered = lost > ROUNDING * self.line(start)?;
            if !lowered || middle <= start || middle >= end {
                return Ok(None);
            }
            // The line falls over at least one half.
            if self.line(middle)? < self.line(start)? {
                end = middle;
            } else {
                start = middle;
            }
        }
        Ok(Some(end))
    }

    fn falls(&self, x: f64) -> Result<bool, InvalidParameter> {
        Ok(x * self.body.line_slope(x) < -ROUNDING * self.line(x)?)
    }

    fn turns_down_at(&self, radius: f64) -> IndenterError {
        IndenterError::NonMonotoneLine {
            limiting_radius: radius,
            limiting_depth: self.body.line_height(radius),
            depth: self.depth,
        }
    }

    fn end_of_body(&self, radius: f64) -> Result<f64, IndenterError> {
        let available = self.line(radius)?;
        let flat = available == 0.0 && self.body.profile_exponent() == f64::INFINITY;
        if flat && radius >= self.body.max_radius() {
            return Ok(radius);
        }
        Err(IndenterError::NotHighEnough {
            available,
            depth: self.depth,
        })
    }
}
