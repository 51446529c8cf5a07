//! Rigid lines of the one-dimensional model, and where they turn up or down.

use auto_impl::auto_impl;

use crate::Axisymmetric;
use numerics::bracketed_root;

/// Halvings of an interval whose slopes contradict its heights, all together, before it is taken as it is.
const MAX_BISECTIONS: u32 = 40;

/// A continuous rigid line h̃(x) on a closed interval, which moves towards positive x.
#[auto_impl(&, Box, Arc)]
pub trait RigidLine {
    /// Height h̃(x), \[m], at a position of the domain; `+∞` outside.
    fn height(&self, x: f64) -> f64;

    /// Slope h̃'(x), at a position of the domain; at a kink one of the two one-sided slopes, finite where one of them is.
    fn slope(&self, x: f64) -> f64;

    /// The interval X on which the line is given, \[m]. Its ends may be infinite.
    fn domain(&self) -> [f64; 2];

    /// Positions inside the domain at which the slope jumps or is singular, increasing.
    fn kinks(&self) -> Vec<f64> {
        Vec::new()
    }

    /// Exponent p of the line h̃ ∼ |x|^p around its lowest point; 1 where nothing is known.
    fn apex_exponent(&self) -> f64 {
        1.0
    }

    /// Positions, increasing, from end to end of the finite domain, between which the line only rises or only falls.
    ///
    /// Found by looking for one change of sign of the slope in each of `samples` equal intervals. A line that knows its
    /// turning points overrides this.
    fn monotone_breaks(&self, samples: usize) -> Vec<f64> {
        find_breaks(self, samples)
    }
}

/// The equivalent line of a body of revolution, `h̃(x)`, with its apex at `x = 0`.
#[derive(Debug, PartialEq)]
pub struct EquivalentLine<'a, P: ?Sized>(pub &'a P);

// Not derived, because the body itself need not be one that can be copied.
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

/// Positions, increasing, from end to end of the domain, between which the line only rises or only falls.
///
/// Searches `samples` equal intervals of the (finite) domain, finer between kinks, for a change of sign of the slope. Two
/// turning points inside one of them are not seen.
fn find_breaks(line: &(impl RigidLine + ?Sized), samples: usize) -> Vec<f64> {
    let [lower, upper] = line.domain();
    let mut breaks = line.kinks();
    breaks.retain(|x| *x > lower && *x < upper);
    breaks.insert(0, lower);
    breaks.push(upper);
    let spacing = (upper - lower) / samples.max(1) as f64;
    let stations = stations(&breaks, spacing);
    // Slope with which the last interval ended, zero as long as the line is level.
    let mut heading = 0.0_f64;
    for ends in stations.windows(2) {
        let [left, right] = [ends[0], ends[1]];
        let [start, end] = inside([left, right]).map(|x| line.slope(x));
        let rise = line.height(right) - line.height(left);
        let entry = first_not_zero([start, rise, heading]);
        // A height that is not finite is handed on to whoever evaluates the line at the breaks.
        if heading.signum() * entry < 0.0 || !line.height(left).is_finite() {
            breaks.push(left);
        }
        let mut bisections = 0;
        breaks.extend(turning_point(line, [left, right], &mut bisections));
        heading = first_not_zero([end, entry, heading]);
    }
    breaks.sort_by(f64::total_cmp);
    breaks.dedup();
    breaks
}

/// The fixed positions, and between them others at most 1.5 spacings apart.
fn stations(fixed: &[f64], spacing: f64) -> Vec<f64> {
    let mut stations = Vec::new();
    for gap in fixed.windows(2) {
        stations.push(gap[0]);
        let between = (1_usize..).map(|step| gap[0] + step as f64 * spacing);
        // No sliver is left before the end of the gap.
        stations.extend(between.take_while(|x| x + 0.5 * spacing < gap[1]));
    }
    stations.extend(fixed.last());
    stations
}

/// One step inside, so that at a kink the slope is that on the side of this interval.
fn inside([left, right]: [f64; 2]) -> [f64; 2] {
    [left.next_up(), right.next_down()]
}

fn first_not_zero(candidates: [f64; 3]) -> f64 {
    let found = candidates.into_iter().find(|slope| *slope != 0.0);
    found.unwrap_or(candidates[2])
}

/// The position inside an interval without kinks at which the slope changes its sign.
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
