//! Rigid lines of the one-dimensional model, and their turning points.

use auto_impl::auto_impl;

use crate::Axisymmetric;
use numerics::bracketed_root;

/// Largest number of bisections of search intervals whose slopes contradict their heights. Chosen, as a bound of the time
/// for lines with rounding errors, whose slopes and heights never agree.
const MAX_BISECTIONS: u32 = 40;

/// A continuous rigid line h̃(x) on a closed interval, which moves towards positive x.
#[auto_impl(&, Box, Arc)]
pub trait RigidLine {
    /// Height h̃(x), \[m], at a position of the domain; `+∞` outside.
    fn height(&self, x: f64) -> f64;

    /// Slope h̃'(x) at a position of the domain; at a kink a one-sided slope, finite if one of the two is.
    fn slope(&self, x: f64) -> f64;

    /// Interval X on which the line is given, \[m]; its ends may be infinite.
    fn domain(&self) -> [f64; 2];

    /// Positions inside the domain at which the slope jumps or is singular, increasing.
    fn kinks(&self) -> Vec<f64> {
        Vec::new()
    }

    /// Exponent p of the line h̃ ∼ |x|^p around its lowest point; 1 if unknown.
    fn apex_exponent(&self) -> f64 {
        1.0
    }

    /// Increasing positions from end to end of the finite domain between which the line is monotone.
    ///
    /// The default searches each of `samples` equal intervals for one change of sign of the slope. A line whose turning
    /// points are known overrides it.
    fn monotone_breaks(&self, samples: usize) -> Vec<f64> {
        find_breaks(self, samples)
    }
}

/// The equivalent line of a body of revolution, `h̃(x)`, with its apex at `x = 0`.
#[derive(Debug, PartialEq)]
pub struct EquivalentLine<'a, P: ?Sized>(pub &'a P);

// This is not derived, because a derive would require that the body itself is `Clone`.
impl<P: ?Sized> Clone for EquivalentLine<'_, P> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<P: ?Sized> Copy for EquivalentLine<'_, P> {}

impl<P: Axisymmetric + ?Sized> RigidLine for EquivalentLine<'_, P> {
    fn height(&self, x: f64) -> f64 {
        self.0.line_height(x)
    }

    fn slope(&self, x: f64) -> f64 {
        self.0.line_slope(x)
    }

    fn domain(&self) -> [f64; 2] {
        [-self.0.max_radius(), self.0.max_radius()]
    }

    fn apex_exponent(&self) -> f64 {
        self.0.profile_exponent()
    }

    fn kinks(&self) -> Vec<f64> {
        let radii: Vec<f64> = self.0.kinks().iter().map(|kink| kink.radius).collect();
        let mirrored = radii.iter().rev().map(|radius| -radius);
        mirrored.chain([0.0]).chain(radii.iter().copied()).collect()
    }
}

/// Increasing positions \[m] from end to end of the domain between which the line is monotone.
///
/// Searches `samples` equal intervals of the (finite) domain, split at kinks, for a change of sign of the slope. Two
/// turning points inside one interval are missed.
fn find_breaks(line: &(impl RigidLine + ?Sized), samples: usize) -> Vec<f64> {
    let [lower, upper] = line.domain();
    let mut breaks = line.kinks();
    breaks.retain(|x| *x > lower && *x < upper);
    breaks.insert(0, lower);
    breaks.push(upper);
    let spacing = (upper - lower) / samples.max(1) as f64;
    let stations = stations(&breaks, spacing);
    // Keep the slope at the end of the previous interval; it is zero as long as the line is level.
    let mut previous_slope = 0.0_f64;
    for ends in stations.windows(2) {
        let [left, right] = [ends[0], ends[1]];
        let [start, end] = inside([left, right]).map(|x| line.slope(x));
        let rise = line.height(right) - line.height(left);
        let entry_slope = first_nonzero([start, rise, previous_slope]);
        // Record a turn at the station itself, where the slope changes its sign. A height that is not finite becomes a break, so
        // that callers refuse it there.
        if previous_slope.signum() * entry_slope < 0.0 || !line.height(left).is_finite() {
            breaks.push(left);
        }
        // Record a turn inside the interval, which is found by bisection.
        let mut bisections = 0;
        breaks.extend(turning_point(line, [left, right], &mut bisections));
        previous_slope = first_nonzero([end, entry_slope, previous_slope]);
    }
    breaks.sort_by(f64::total_cmp);
    breaks.dedup();
    breaks
}

/// The fixed positions with others between them, at most 1.5 spacings apart, \[m].
fn stations(fixed: &[f64], spacing: f64) -> Vec<f64> {
    let mut stations = Vec::new();
    for gap in fixed.windows(2) {
        stations.push(gap[0]);
        let between = (1_usize..).map(|step| gap[0] + step as f64 * spacing);
        // Stations end half a spacing before the gap does, so that no narrow interval is left there.
        stations.extend(between.take_while(|x| x + 0.5 * spacing < gap[1]));
    }
    stations.extend(fixed.last());
    stations
}

/// The ends of an interval, moved inwards by one unit in the last place: a slope at a kink is then the one of this side.
fn inside([left, right]: [f64; 2]) -> [f64; 2] {
    [left.next_up(), right.next_down()]
}

/// The first slope that is not zero; the last one if all are zero.
fn first_nonzero(candidates: [f64; 3]) -> f64 {
    let found = candidates.into_iter().find(|slope| *slope != 0.0);
    found.unwrap_or(candidates[2])
}

/// Position \[m] inside an interval without kinks at which the slope changes its sign; `None` if it does not.
///
/// If heights and slopes at the ends contradict each other, the interval is bisected; `bisections` counts them.
fn turning_point(
    line: &(impl RigidLine + ?Sized),
    [left, right]: [f64; 2],
    bisections: &mut u32,
) -> Option<f64> {
    let inside = inside([left, right]);
    let [start, end] = inside.map(|x| line.slope(x));
    if start * end.signum() < 0.0 {
        return bracketed_root(|x| line.slope(x), inside);
    }
    let rise = line.height(right) - line.height(left);
    let contradicts = rise * start < 0.0 || rise * end < 0.0;
    if !contradicts || *bisections == MAX_BISECTIONS {
        return None;
    }
    *bisections += 1;
    let middle = 0.5 * (left + right);
    turning_point(line, [left, middle], bisections)
        .or_else(|| turning_point(line, [middle, right], bisections))
}
