//! Contact radius of a body of revolution at a given depth.
//!
//! ```text
//! h̃(a) = d,   h̃ rising on [0, a]
//! ```

use std::f64::consts::FRAC_PI_2;

use crate::leading_edge::crossing;
use crate::{Axisymmetric, EquivalentLine, IndenterError};
use numerics::{InvalidParameter, bracketed_root, in_range, integrate, positive};

/// Ratio of neighbouring radii of the search, 2^(1/8). Chosen: valleys of the line that are narrower than a step are missed.
const SEARCH_STEP: f64 = 1.090_507_732_665_257_7;
/// Number of octaves over which the line must follow its leading power to count as the apex. Chosen: 12 decades, so that a power
/// of a small region is not taken for it.
const APEX_OCTAVES: u32 = 40;
/// Largest relative deviation of the local exponent from the leading exponent with which the line counts as the apex.
/// Chosen: it is far above the rounding of slopes; over [`APEX_OCTAVES`] octaves another power would deviate more.
const APEX_EXPONENT_TOLERANCE: f64 = 1e-2;
/// Largest relative fall of the line that counts as rounding: Δh̃/h̃ or x |h̃'|/h̃, with the height h̃ of the line at the radius
/// x. Chosen: some thousand roundings.
const FALL_TOLERANCE: f64 = 1e-12;

/// Relative tolerance of the gap outside a contact, of whose integral only the sign matters, and of the radius of the largest contact
/// with an open gap. Chosen: far below errors that matter for a limit.
const GAP_TOLERANCE: f64 = 1e-9;

/// Contact radius a \[m] at an indentation `depth` d > 0 \[m]: the [`line_radius`], outside of which the body does not touch.
///
/// A body that comes down again outside a circle a, as one whose slope is negative there, must leave a gap to the surface that bulges
/// around the contact (Sneddon 1965, Int. J. Eng. Sci. 3, 47):
///
/// ```text
/// g(r) = (2/π) ∫_a^r (h̃(x) − d) dx/√(r² − x²) ≥ 0
/// ```
///
/// # Errors
/// Those of [`line_radius`]; [`IndenterError::NonMonotoneLine`] also where the gap closes. It then holds the largest radius and depth
/// of a contact that is one circle.
pub fn contact_radius(
    body: &(impl Axisymmetric + ?Sized),
    depth: f64,
) -> Result<f64, IndenterError> {
    let radius = line_radius(body, depth)?;
    if gap_stays_open(body, radius, depth) {
        return Ok(radius);
    }
    // The gap falls with the depth, so that the largest radius at which it is open follows by bisection.
    let [mut open, mut closed] = [0.0, radius];
    while closed - open > GAP_TOLERANCE * closed {
        let middle = 0.5 * (open + closed);
        if gap_stays_open(body, middle, body.line_height(middle)) {
            open = middle;
        } else {
            closed = middle;
        }
    }
    Err(IndenterError::NonMonotoneLine {
        limiting_radius: open,
        limiting_depth: body.line_height(open),
        depth,
    })
}

/// Whether no point outside a contact of a radius and depth \[m] touches, on radii in steps of [`SEARCH_STEP`].
fn gap_stays_open(body: &(impl Axisymmetric + ?Sized), radius: f64, depth: f64) -> bool {
    let end = body.falling_up_to();
    let mut r = radius;
    while r < end {
        // The smallest numbers are rounded down to themselves.
        r = (r * SEARCH_STEP).max(r.next_up()).min(end);
        // The gap can only close where the line comes below the depth.
        if body.line_height(r) >= depth {
            continue;
        }
        let excess = |angle: f64| body.line_height(r * angle.sin()) - depth;
        let gap = integrate(excess, [(radius / r).asin(), FRAC_PI_2], GAP_TOLERANCE);
        if gap.value < 0.0 {
            return false;
        }
    }
    true
}

/// Radius at which the equivalent line first has the height of a `depth` d > 0, h̃(a) = d, \[m], whether or not the body touches
/// farther out.
///
/// The contact radius of a body that is flat to its end, as [`FlatPunch`](crate::FlatPunch), is its own radius. The line is
/// searched from the apex outwards in steps of an eighth of an octave (9 % of the radius). Narrower valleys are missed
/// unless they begin at a kink. The error of an unreachable depth holds the limiting radius.
///
/// # Errors
/// - [`IndenterError::NonMonotoneLine`] when the line turns down below the depth;
/// - [`IndenterError::NotHighEnough`] when the body ends below the depth;
/// - [`IndenterError::InvalidParameter`] when the depth is out of its range or exceeded at the smallest positive radius, or
///   when a height of the line is NaN.
pub fn line_radius(body: &(impl Axisymmetric + ?Sized), depth: f64) -> Result<f64, IndenterError> {
    let depth = positive("depth", depth)?;
    let search = Search { body, depth };
    // Collect the kinks at which the slope jumps down, because the line falls just outside them by an inverse square root.
    let mut falling_kinks = body.kinks();
    falling_kinks.retain(|kink| kink.slope_jump < 0.0);
    let edges: Vec<f64> = falling_kinks.iter().map(|kink| kink.radius).collect();
    // Search outwards, interval by interval, for the first radius at which the line turns down; a falling kink ends the search.
    let mut inner = search.start_radius()?;
    loop {
        if edges.contains(&inner) {
            return Err(search.turns_down_at(inner));
        }
        let next = (inner * SEARCH_STEP).min(body.max_radius());
        let edge = edges.iter().find(|edge| **edge > inner);
        let outer = edge.map_or(next, |edge| next.min(*edge));
        if outer <= inner || outer.is_infinite() {
            return search.end_of_body(inner);
        }
        let turn = search.turning_point([inner, outer])?;
        let reached = turn.unwrap_or(outer);
        if search.line_height(reached)? >= depth {
            return Ok(crossing(&EquivalentLine(body), [inner, reached], depth)?);
        }
        if turn.is_some() {
            return Err(search.turns_down_at(reached));
        }
        inner = outer;
    }
}

/// Search for the radius at which the line of a body reaches one depth.
struct Search<'a, P: ?Sized> {
    /// Body that is pressed.
    body: &'a P,
    /// Indentation depth, \[m].
    depth: f64,
}

impl<P: Axisymmetric + ?Sized> Search<'_, P> {
    /// Height of the equivalent line at a position \[m], refused if it is NaN, \[m].
    fn line_height(&self, x: f64) -> Result<f64, InvalidParameter> {
        let value = self.body.line_height(x);
        let is_number = !value.is_nan();
        in_range(
            "height of the equivalent line",
            value,
            is_number,
            "a number",
        )
    }

    /// Radius \[m] below the contact radius inside which the line rises like its leading power; refuses a depth that is exceeded at
    /// the smallest positive radius.
    fn start_radius(&self) -> Result<f64, InvalidParameter> {
        // Halve the radius from the end of the body, its first kink or 1 m; the result does not depend on the choice.
        let first_kink = self.body.kinks().first().map(|kink| kink.radius);
        let end = Some(self.body.max_radius()).filter(|end| end.is_finite());
        let mut x = end.or(first_kink).unwrap_or(1.0);
        let mut candidate = None;
        let mut octaves = 0;
        while octaves < APEX_OCTAVES && x >= f64::MIN_POSITIVE {
            let height = self.line_height(x)?;
            if height == 0.0 {
                candidate = candidate.or(Some(x));
                break;
            }
            let exponent = x * self.body.line_slope(x) / height;
            let deviation = (exponent / self.body.profile_exponent() - 1.0).abs();
            if height < self.depth && deviation <= APEX_EXPONENT_TOLERANCE {
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

    /// Radius \[m] of the highest point in an interval of radii in which the line falls; `None` if it does not fall.
    fn turning_point(&self, [inner, outer]: [f64; 2]) -> Result<Option<f64>, InvalidParameter> {
        let Some(falling) = self.falling_point([inner, outer])? else {
            return Ok(None);
        };
        // A slope of 0 counts as positive: a level line, or one whose height underflows, has not turned yet.
        let slope = |x: f64| match self.body.line_slope(x) {
            0.0 => f64::MIN_POSITIVE,
            other => other,
        };
        // Begin one unit in the last place farther outwards, because the slope at a kink is the inner one.
        let first = inner.next_up();
        if slope(first) < 0.0 {
            return Ok(Some(inner));
        }
        let turn = bracketed_root(slope, [first, falling]).unwrap_or(f64::NAN);
        let is_number = !turn.is_nan();
        in_range("slope of the equivalent line", turn, is_number, "a number").map(Some)
    }

    /// A radius \[m] in an interval at which the line falls, by bisection while the height is lower at the outer end; `None` if there
    /// is none.
    fn falling_point(&self, [inner, outer]: [f64; 2]) -> Result<Option<f64>, InvalidParameter> {
        let [mut start, mut end] = [inner, outer];
        while !self.falls(end)? {
            let fall = self.line_height(start)? - self.line_height(end)?;
            let middle = 0.5 * (start + end);
            let is_lower = fall > FALL_TOLERANCE * self.line_height(start)?;
            if !is_lower || middle <= start || middle >= end {
                return Ok(None);
            }
            // Keep the half over which the line falls; at least one of the two halves is such.
            if self.line_height(middle)? < self.line_height(start)? {
                end = middle;
            } else {
                start = middle;
            }
        }
        Ok(Some(end))
    }

    /// Whether the slope of the line at a radius \[m] is negative by more than rounding.
    fn falls(&self, x: f64) -> Result<bool, InvalidParameter> {
        Ok(x * self.body.line_slope(x) < -FALL_TOLERANCE * self.line_height(x)?)
    }

    /// Error for a line that turns down at a radius, \[m].
    fn turns_down_at(&self, radius: f64) -> IndenterError {
        IndenterError::NonMonotoneLine {
            limiting_radius: radius,
            limiting_depth: self.body.line_height(radius),
            depth: self.depth,
        }
    }

    /// Result at the end of the body, at a radius \[m]: this radius for a flat punch, otherwise an error.
    fn end_of_body(&self, radius: f64) -> Result<f64, IndenterError> {
        let available = self.line_height(radius)?;
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
