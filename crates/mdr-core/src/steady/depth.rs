//! The depth at which a line in stationary motion carries a force.
//!
//! The force grows with the depth at least in proportion, and between two speeds or sizes like a power; so the root is
//! sought in logarithms, from a bracket that proportion gives.

use numerics::try_bracketed_root;

use crate::MdrError;
use crate::error::non_finite;

/// Depth at which the search starts, \[m]. Any other would do: it changes the number of evaluations only.
const SEARCH_START: f64 = 1.0;
/// Largest number of steps of the secant method. Chosen: each step multiplies the number of exact digits, so that most searches
/// end before; the others go on with a bracket.
const MAX_SECANT_STEPS: usize = 12;
/// Relative margin of the bracket that proportion gives. Chosen: proportion may be exact, and the force then rounded to the wrong
/// side. Without the margin the bracket would be widened, which costs evaluations only.
const BRACKET_MARGIN: f64 = 1e-6;
/// Factor on the far end of a bracket that does not contain the depth. Chosen: a larger one takes fewer steps, and leaves a wider
/// bracket. It changes the number of evaluations only.
const BRACKET_STRIDE: f64 = 8.0;
/// Largest number of times that a bracket is widened. Derived: 200 widenings by [`BRACKET_STRIDE`] span 8²⁰⁰, or 180 decades.
const MAX_BRACKET_STRIDES: usize = 200;

/// The depth \[m] at which `load`, a function of the depth, is `target`, in the same unit.
///
/// Refuses a target that no depth carries: [`MdrError::ForceBeyondEdge`], [`MdrError::NonFinite`].
pub(super) fn depth_of_load(
    load: impl Fn(f64) -> Result<f64, MdrError>,
    target: f64,
) -> Result<f64, MdrError> {
    let bracket = bracket(&load, target)?;
    // The line reaches the depths at both ends of the bracket, which the rounding of exp and ln must not exceed.
    let depth = |logarithm: f64| logarithm.exp().clamp(bracket[0], bracket[1]);
    let log_ratio = |logarithm: f64| load(depth(logarithm)).map(|load| (load / target).ln());
    let root = try_bracketed_root(log_ratio, bracket.map(f64::ln))?;
    root.map(depth)
        .ok_or(non_finite("normal force", load(bracket[0])?, 0.0))
}

/// The depth \[m] at which `load`, a function of the depth, is `target`, by the secant method in logarithms from a depth `start`
/// near it.
pub(super) fn refined_depth(
    load: impl Fn(f64) -> Result<f64, MdrError>,
    target: f64,
    start: f64,
) -> Result<f64, MdrError> {
    // The secant method works in the logarithms of force and depth, from a start within reach of the line.
    let (mut depth, at_depth) = within_reach(&load, start, target)?;
    let mut log_ratio = (at_depth / target).ln();
    // Force and depth are nearly a power law, whose exponent the steps find. The first one assumes an exponent between fluid
    // and solid; on springs under a cusp x^p it is 1 + 1/p, and this step is too long.
    let mut exponent = 1.5;
    for step_number in 0..MAX_SECANT_STEPS {
        if log_ratio.abs() <= f64::EPSILON {
            break;
        }
        let step = -log_ratio / exponent;
        let (next, at_next) = within_reach(&load, depth * step.exp(), target)?;
        let next_log_ratio = (at_next / target).ln();
        let slope = (next_log_ratio - log_ratio) / (next / depth).ln();
        if slope.is_finite() && slope > 0.5 {
            exponent = slope;
        }

        // The search stops when the deviation does not fall any more, because what remains is rounding.
        if next_log_ratio.abs() < log_ratio.abs() {
            (depth, log_ratio) = (next, next_log_ratio);
        } else if step_number > 0 {
            break;
        }
    }
    Ok(depth)
}

/// A depth with less load than the target and one with more, \[m].
fn bracket(
    load: &impl Fn(f64) -> Result<f64, MdrError>,
    target: f64,
) -> Result<[f64; 2], MdrError> {
    // The load at one depth decides whether the other end is sought above or below.
    let (start, at_start) = within_reach(load, SEARCH_START, target)?;
    let exceeds_target = at_start > target;
    let mut near = start;
    let [margin, stride] = if exceeds_target {
        [1.0 - BRACKET_MARGIN, BRACKET_STRIDE.recip()]
    } else {
        [1.0 + BRACKET_MARGIN, BRACKET_STRIDE]
    };

    // The force grows at least in proportion to the depth, which gives the other end of the bracket; else it is widened.
    let mut far = start * (target / at_start) * margin;
    for _ in 0..MAX_BRACKET_STRIDES {
        if far <= f64::MIN_POSITIVE || !far.is_finite() {
            break;
        }
        let (reached, at_far) = within_reach(load, far, target)?;
        if (at_far > target) != exceeds_target {
            return Ok([reached.min(near), reached.max(near)]);
        }
        near = reached;
        far = reached * stride;
    }
    Err(non_finite("indentation depth", far, 0.0))
}

/// A depth \[m] and the quarter force \[N] at it; the largest depth of the line if `depth` is beyond it. Refuses a line whose
/// largest depth carries less than `target`.
fn within_reach(
    load: &impl Fn(f64) -> Result<f64, MdrError>,
    depth: f64,
    target: f64,
) -> Result<(f64, f64), MdrError> {
    let (position, available) = match load(depth) {
        Err(MdrError::DepthBeyondEdge {
            position,
            available,
            ..
        }) => (position, available),
        other => return Ok((depth, other?)),
    };
    // A line whose lowest point is its front end has no leading edge.
    let has_edge = available > 0.0;
    let carried = if has_edge { load(available)? } else { 0.0 };
    if carried < target {
        return Err(MdrError::ForceBeyondEdge {
            position,
            available,
            carried_force: 4.0 * carried,
            normal_force: 4.0 * target,
        });
    }
    Ok((available, carried))
}
