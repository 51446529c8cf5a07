//! The mean pressure under which the mean plane of a surface has a given depth.

use std::cell::RefCell;

use numerics::{in_range, try_bracketed_root};

use crate::stationary::periodic::contact::PeriodicContact;
use crate::stationary::periodic::kernel::Sliding;
use crate::stationary::periodic::{PeriodicControl, PeriodicOptions, PeriodicSliding};
use crate::{BemError, Grid};

/// Steps of the logarithm of the pressure until the depth lies between two of them, and the longest of them.
const MOST_STEPS_OF_PRESSURE: usize = 200;
const LONGEST_STEP: f64 = 4.0;

/// Tolerance of a depth that is given, as a part of the root mean square of the heights, over that of the contact.
const DEPTH_TOLERANCE: f64 = 3.0;

/// A surface on a grid whose mean pressure is not known yet.
pub(super) struct Surface<'a> {
    pub(super) sliding: &'a Sliding,
    pub(super) grid: &'a Grid,
    /// At the centres of the elements, \[m].
    pub(super) heights: &'a [f64],
    pub(super) options: PeriodicOptions,
}

impl<'a> Surface<'a> {
    const fn under(&self, mean_pressure: f64) -> PeriodicContact<'a> {
        PeriodicContact {
            sliding: self.sliding,
            grid: self.grid,
            heights: self.heights,
            mean_pressure,
            tolerance: self.options.tolerance,
            max_products: self.options.max_products,
        }
    }
}

/// A contact that was solved for a control.
#[cfg_attr(
    not(feature = "rough"),
    expect(
        dead_code,
        reason = "what else is known is for estimates of rough surfaces"
    )
)]
pub(super) struct Held {
    /// \[Pa].
    pub(super) mean_pressure: f64,
    pub(super) state: PeriodicSliding,
    /// Part of the roughness by which a given depth is missed.
    pub(super) missed: f64,
}

/// Holds a mean pressure, or finds that of a depth, near `start` \[Pa] if that is known.
pub(super) fn hold(
    control: PeriodicControl,
    surface: &Surface,
    start: Option<f64>,
    solve: impl Fn(PeriodicContact) -> Result<PeriodicSliding, BemError>,
) -> Result<Held, BemError> {
    let under = |mean_pressure| solve(surface.under(mean_pressure));
    match control {
        PeriodicControl::MeanPressure(mean_pressure) => Ok(Held {
            mean_pressure,
            state: under(mean_pressure)?,
            missed: 0.0,
        }),
        PeriodicControl::MeanDepth(depth) => {
            let roughness = check_depth(depth, surface)?;
            let length = surface.grid.shape()[0] as f64 * surface.grid.spacing()[0];
            let first = || surface.sliding.pressure_of(length, roughness);
            let start = start.map_or_else(first, Ok)?;
            let tolerance = DEPTH_TOLERANCE * surface.options.tolerance;
            at_depth([depth, roughness, tolerance], start, under)
        }
    }
}

/// The root mean square of the heights, if their mean plane can have the depth.
fn check_depth(depth: f64, surface: &Surface) -> Result<f64, BemError> {
    let heights = surface.heights;
    let n = heights.len() as f64;
    let mean = heights.iter().sum::<f64>() / n;
    let lowest = heights.iter().copied().fold(f64::INFINITY, f64::min);
    let deepest = if surface.sliding.is_on_rigid_base() {
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
fn at_depth(
    [depth, roughness, tolerance]: [f64; 3],
    start: f64,
    under: impl Fn(f64) -> Result<PeriodicSliding, BemError>,
) -> Result<Held, BemError> {
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
    Ok(Held {
        mean_pressure: logarithm.exp(),
        state,
        missed: missing.abs(),
    })
}
