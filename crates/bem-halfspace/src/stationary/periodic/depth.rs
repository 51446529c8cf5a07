//! The mean pressure under which the mean plane of a surface has a given depth.

use std::cell::RefCell;

use numerics::{in_range, try_bracketed_root};

use crate::BemError;
use crate::stationary::periodic::PeriodicSliding;
use crate::stationary::periodic::kernel::Sliding;

/// Steps of the logarithm of the pressure until the depth lies between two of them, and the longest of them.
const MOST_STEPS_OF_PRESSURE: usize = 200;
const LONGEST_STEP: f64 = 4.0;

/// The root mean square of the heights, if their mean plane can have the depth.
pub(super) fn check_depth(depth: f64, heights: &[f64], sliding: &Sliding) -> Result<f64, BemError> {
    let n = heights.len() as f64;
    let mean = heights.iter().sum::<f64>() / n;
    let lowest = heights.iter().copied().fold(f64::INFINITY, f64::min);
    let deepest = if sliding.is_on_rigid_base() {
        f64::INFINITY
    } else {
        0.0
    };
    let touches = lowest - mean < depth && depth < deepest;
    let allowed = "above minus the height of the mean plane over the lowest point, and on a half space below 0";
    in_range("mean_depth", depth, touches, allowed)?;
    let squares = heights.iter().map(|height| (height - mean).powi(2));
    Ok((squares.sum::<f64>() / n).sqrt())
}

/// The mean pressure under which the mean plane has a depth, the contact, and by which part of the roughness the depth is
/// missed. The pressure grows about like the exponential function of the depth over the roughness (Persson 2007).
pub(super) fn at_depth(
    [depth, roughness, tolerance]: [f64; 3],
    start: f64,
    under: impl Fn(f64) -> Result<PeriodicSliding, BemError>,
) -> Result<(f64, PeriodicSliding, f64), BemError> {
    let at = |logarithm: f64| -> Result<(f64, PeriodicSliding, f64), BemError> {
        let state = under(logarithm.exp())?;
        let missing = (state.mean_depth - depth) / roughness;
        Ok((logarithm, state, missing))
    };
    let mut first = at(start.ln())?;
    for _ in 0..MOST_STEPS_OF_PRESSURE {
        if first.2.abs() <= tolerance {
            break;
        }
        let step = (2.0 * first.2).clamp(-LONGEST_STEP, LONGEST_STEP);
        let second = at(first.0 - step)?;
        if first.2 * second.2 < 0.0 {
            let ends = [(first.0, first.2), (second.0, second.2)];
            let last = RefCell::new(second);
            let missing = |logarithm: f64| -> Result<f64, BemError> {
                let is_known = |end: &&(f64, f64)| end.0.total_cmp(&logarithm).is_eq();
                if let Some((_, missing)) = ends.iter().find(is_known) {
                    return Ok(*missing);
                }
                let found = at(logarithm)?;
                let missing = found.2;
                *last.borrow_mut() = found;
                Ok(if missing.abs() <= tolerance {
                    0.0
                } else {
                    missing
                })
            };
            try_bracketed_root(missing, ends.map(|end| end.0))?;
            first = last.into_inner();
            break;
        }
        first = second;
    }
    let (logarithm, state, missing) = first;
    Ok((logarithm.exp(), state, missing.abs()))
}
