//! Leading edge and contact line of a moving rigid line.
//!
//! ```text
//! A   = { x ∈ X : h̃(x) < h̃(ξ) for all ξ > x }              (Kürschner 2014, Definition 1)
//! A_d = { x ∈ A : h̃(x) ≤ h_0 + d },   h_0 = min h̃          (Definition 2)
//! ```
//!
//! The leading edge can touch; the contact line does. The paper writes Definition 2 with d instead of `h_0 + d`; its proof
//! of Theorem 3 uses `h_0 + d`.

use crate::table::check_min_length;
use crate::{IndenterError, RigidLine};
use numerics::{InvalidParameter, bracketed_root, finite, positive};

/// Default number of intervals of the domain that are searched for one turning point each. Chosen: of two turning points in one
/// interval both may be missed.
const DEFAULT_SAMPLES: usize = 1024;

/// The leading edge A of a rigid line that moves towards positive x.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[must_use]
pub struct LeadingEdge {
    /// Intervals `[α, β]` of A by increasing position, \[m].
    ///
    /// The last interval is closed; all others are open at β. The height increases over each interval and from each to the
    /// next. A falling line has the single interval `[β, β]` at its end.
    pub intervals: Vec<[f64; 2]>,
    /// Height h_0 of the lowest point, \[m].
    pub lowest: f64,
    /// Height of the highest point of A, which is the end of the line, \[m].
    pub highest: f64,
}

impl LeadingEdge {
    /// Largest indentation depth \[m] for which a contact line exists.
    pub fn available_depth(&self) -> f64 {
        self.highest - self.lowest
    }

    /// Contact line: the part of the leading edge of this `line` up to an indentation `depth` d > 0 \[m].
    ///
    /// # Errors
    /// Like [`contact_line`].
    pub fn contact_line(
        &self,
        line: &(impl RigidLine + ?Sized),
        depth: f64,
    ) -> Result<ContactLine, IndenterError> {
        let depth = positive("depth", depth)?;
        let available = self.available_depth();
        if depth > available {
            return Err(IndenterError::NotHighEnough { available, depth });
        }
        // Keep the intervals that begin below the depth, and cut the one that reaches beyond it.
        let level = self.lowest + depth;
        let mut intervals = Vec::new();
        for &[start, end] in &self.intervals {
            if start < end && line.height(start) < level {
                let last = if line.height(end) <= level {
                    end
                } else {
                    crossing(line, [start, end], level)?
                };
                intervals.push([start, last]);
            }
        }
        Ok(ContactLine {
            intervals,
            lowest: self.lowest,
        })
    }
}

/// The contact line A_d: the part of the leading edge up to an indentation depth.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[must_use]
pub struct ContactLine {
    /// Intervals `[α, β]` of A_d by increasing position, all of positive length, \[m].
    pub intervals: Vec<[f64; 2]>,
    /// Height h_0 of the lowest point of the line, \[m].
    pub lowest: f64,
}

impl ContactLine {
    /// Sum of the lengths of the intervals, \[m].
    pub fn length(&self) -> f64 {
        self.intervals.iter().map(|[start, end]| end - start).sum()
    }
}

/// Finds the leading edge of a line with a finite domain.
///
/// The equivalent line of an infinite body has the leading edge `[0, ∞[`; [`contact_radius`](crate::contact_radius) gives
/// its contact line `[0, a]`.
///
/// # Errors
/// [`IndenterError::InvalidParameter`] when the domain is infinite or a height is not finite.
pub fn leading_edge(line: &(impl RigidLine + ?Sized)) -> Result<LeadingEdge, IndenterError> {
    leading_edge_with(line, DEFAULT_SAMPLES)
}

/// Finds the leading edge with a search for one turning point in each of `samples` equal intervals of the domain.
///
/// The number has no effect on a [`SampledLine`](crate::SampledLine), whose turning points are known.
///
/// # Errors
/// Like [`leading_edge`].
pub fn leading_edge_with(
    line: &(impl RigidLine + ?Sized),
    samples: usize,
) -> Result<LeadingEdge, IndenterError> {
    for end in line.domain() {
        finite("end of the domain", end)?;
    }
    // Split the line where it turns into pieces that only rise or only fall, and find its height at their ends.
    let breaks = line.monotone_breaks(samples);
    let heights: Vec<f64> = breaks
        .iter()
        .map(|x| finite("height of the line", line.height(*x)))
        .collect::<Result<_, _>>()?;
    check_min_length(1, "monotone_breaks", breaks.len())?;
    let last = breaks.len() - 1;
    // Walk backwards from the end of the line, and keep the lowest height at all breaks to the right of the present piece.
    let mut backwards = vec![[breaks[last]; 2]];
    let mut later = f64::INFINITY;
    for (ends, heights) in breaks.windows(2).zip(heights.windows(2)).rev() {
        let [low, high] = [heights[0], heights[1]];
        if low < high.min(later) {
            let [start, mut front] = [ends[0], ends[1]];
            if later < high {
                front = crossing(line, [start, front], later)?;
            }
            match backwards.last_mut() {
                // The end of the piece belongs to A, and so to the next interval.
                Some(next) if later > high => next[0] = start,
                _ => backwards.push([start, front]),
            }
        }
        later = later.min(high);
    }
    backwards.reverse();
    Ok(LeadingEdge {
        intervals: backwards,
        lowest: later.min(heights[0]),
        highest: heights[last],
    })
}

/// Position at which a rising line reaches a `height` between those at the two ends, \[m].
pub(crate) fn crossing(
    line: &(impl RigidLine + ?Sized),
    ends: [f64; 2],
    height: f64,
) -> Result<f64, InvalidParameter> {
    let excess = |x: f64| line.height(x) - height;
    bracketed_root(excess, ends).ok_or(InvalidParameter {
        parameter: "height of the line",
        value: line.height(0.5 * (ends[0] + ends[1])),
        allowed: "continuous and finite",
    })
}

/// Finds the contact line for an indentation `depth` d > 0 \[m] above the lowest point of the line.
///
/// # Errors
/// Like [`leading_edge`]; [`IndenterError::NotHighEnough`] when the leading edge ends below the depth, and
/// [`IndenterError::InvalidParameter`] when the depth is not finite and greater than zero.
pub fn contact_line(
    line: &(impl RigidLine + ?Sized),
    depth: f64,
) -> Result<ContactLine, IndenterError> {
    leading_edge(line)?.contact_line(line, depth)
}
