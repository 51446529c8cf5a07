//! Control of a stationary periodic contact: a prescribed mean pressure, or the mean pressure for a prescribed depth.

use std::cell::RefCell;

use numerics::{in_range, try_bracketed_root};

use crate::stationary::periodic::contact::PeriodicContact;
use crate::stationary::periodic::kernel::Sliding;
use crate::stationary::periodic::{PeriodicControl, PeriodicOptions, PeriodicSliding};
use crate::{BemError, Grid};

/// Maximum number of steps of the pressure until two of them bracket the depth; chosen.
const MAX_BRACKETING_STEPS: usize = 200;
/// Largest step of the logarithm of the pressure; chosen.
const MAX_LOG_PRESSURE_STEP: f64 = 4.0;

/// Tolerance of a prescribed depth, relative to the root mean square of the heights, over the tolerance of the contact; chosen.
const DEPTH_TOLERANCE_RATIO: f64 = 3.0;

/// A sliding surface on a grid, without its mean pressure.
pub(super) struct SlidingSurface<'a> {
    pub(super) sliding: &'a Sliding,
    pub(super) grid: &'a Grid,
    /// Heights at the centres of the elements, \[m].
    pub(super) heights: &'a [f64],
    pub(super) options: PeriodicOptions,
}

impl<'a> SlidingSurface<'a> {
    /// The contact problem under a mean pressure \[Pa].
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

/// The contact for a prescribed pressure or depth.
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
    /// Error of a prescribed depth, relative to the root mean square of the heights.
    pub(super) depth_error: f64,
}

/// Solves for a prescribed mean pressure, or finds the mean pressure of a prescribed depth.
///
/// The search for the pressure begins at `start` \[Pa]; without it, at the pressure that displaces a half space by the roughness
/// along one period.
pub(super) fn hold(
    control: PeriodicControl,
    surface: &SlidingSurface,
    start: Option<f64>,
    solve: impl Fn(PeriodicContact) -> Result<PeriodicSliding, BemError>,
) -> Result<Held, BemError> {
    let under = |mean_pressure| solve(surface.under(mean_pressure));
    match control {
        PeriodicControl::MeanPressure(mean_pressure) => Ok(Held {
            mean_pressure,
            state: under(mean_pressure)?,
            depth_error: 0.0,
        }),
        PeriodicControl::MeanDepth(depth) => {
            let roughness = check_depth(depth, surface)?;
            let length = surface.grid.shape()[0] as f64 * surface.grid.spacing()[0];
            let estimated = || surface.sliding.pressure_of(length, roughness);
            let target = DepthTarget {
                depth,
                roughness,
                tolerance: DEPTH_TOLERANCE_RATIO * surface.options.tolerance,
            };
            find_pressure(&target, start.map_or_else(estimated, Ok)?, under)
        }
    }
}

/// Checks that the mean plane can have the depth, and returns the root mean square of the heights, \[m].
fn check_depth(depth: f64, surface: &SlidingSurface) -> Result<f64, BemError> {
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

/// A prescribed depth of the mean plane.
struct DepthTarget {
    /// \[m].
    depth: f64,
    /// Root mean square of the heights, \[m].
    roughness: f64,
    /// Tolerance of the depth, relative to `roughness`.
    tolerance: f64,
}

/// A contact on the way to a prescribed depth.
struct Trial {
    log_pressure: f64,
    state: PeriodicSliding,
    /// Excess of the depth, relative to the roughness.
    excess: f64,
}

/// The contact whose mean plane has a depth, by bracketing and root finding over the logarithm of the mean pressure.
///
/// The pressure grows about like the exponential function of the depth over the roughness (Persson 2007).
fn find_pressure(
    target: &DepthTarget,
    start: f64,
    under: impl Fn(f64) -> Result<PeriodicSliding, BemError>,
) -> Result<Held, BemError> {
    let try_at = |log_pressure: f64| -> Result<Trial, BemError> {
        let state = under(log_pressure.exp())?;
        let excess = (state.mean_depth - target.depth) / target.roughness;
        Ok(Trial {
            log_pressure,
            state,
            excess,
        })
    };
    let mut trial = try_at(start.ln())?;
    for _ in 0..MAX_BRACKETING_STEPS {
        if trial.excess.abs() <= target.tolerance {
            break;
        }

        // Step towards the depth until two trials bracket it.
        let step = (2.0 * trial.excess).clamp(-MAX_LOG_PRESSURE_STEP, MAX_LOG_PRESSURE_STEP);
        let next = try_at(trial.log_pressure - step)?;
        if trial.excess * next.excess < 0.0 {
            // Find the root in between; an excess within the tolerance counts as zero.
            let ends = [&trial, &next].map(|end| (end.log_pressure, end.excess));
            let last = RefCell::new(next);
            let excess = |log_pressure: f64| -> Result<f64, BemError> {
                let is_known = |end: &&(f64, f64)| end.0.total_cmp(&log_pressure).is_eq();
                if let Some((_, excess)) = ends.iter().find(is_known) {
                    return Ok(*excess);
                }
                let found = try_at(log_pressure)?;
                let excess = found.excess;
                *last.borrow_mut() = found;
                Ok(if excess.abs() <= target.tolerance {
                    0.0
                } else {
                    excess
                })
            };
            try_bracketed_root(excess, ends.map(|end| end.0))?;
            trial = last.into_inner();
            break;
        }
        trial = next;
    }
    Ok(Held {
        mean_pressure: trial.log_pressure.exp(),
        state: trial.state,
        depth_error: trial.excess.abs(),
    })
}
