//! The part of a moving rigid line that can touch, and the part that does.
//!
//! ```text
//! A   = { x ∈ X : h̃(x) < h̃(ξ) for all ξ > x }              (Kürschner 2014, Definition 1)
//! A_d = { x ∈ A : h̃(x) ≤ h_0 + d },   h_0 = min h̃          (Definition 2)
//! ```
//!
//! The paper writes Definition 2 with d instead of `h_0 + d`; its proof of Theorem 3 uses `h_0 + d`.

use crate::error::{finite, positive};
use crate::{IndenterError, RigidLine};
use numerics::bracketed_root;

/// How finely a line is sampled.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct LeadingEdgeOptions {
    /// Equal intervals of the domain searched for one turning point each; without effect on a
    /// [`SampledLine`](crate::SampledLine), which is known exactly.
    pub samples: usize,
}

impl Default for LeadingEdgeOptions {
    fn default() -> Self {
        Self { samples: 1024 }
    }
}

/// The leading edge A of a rigid line that moves towards positive x.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[must_use]
pub struct LeadingEdge {
    /// Intervals `[α, β]` of A by increasing position, \[m].
    ///
    /// The last one is closed; all others are open at β. The height increases over each and from each to the next. A falling
    /// line has the single interval `[β, β]` at its end.
    pub intervals: Vec<[f64; 2]>,
    /// Height h_0 of the lowest point, \[m].
    pub lowest: f64,
    /// Height of the highest point of A, which is the end of the line, \[m].
    pub highest: f64,
}

impl LeadingEdge {
    /// Largest indentation depth \[m] for which a contact line exists.
    #[must_use]
    pub fn available_depth(&self) -> f64 {
        self.highest - self.lowest
    }
}

/// The contact line A_d: the part of the leading edge up to an indentation depth.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[must_use]
pub struct ContactLine {
    /// Intervals `[α, β]` of A_d by increasing position, \[m], none of them of zero length.
    pub intervals: Vec<[f64; 2]>,
    /// Height h_0 of the lowest point of the line, \[m].
    pub lowest: f64,
}

impl ContactLine {
    /// Sum of the lengths of the intervals, \[m].
    #[must_use]
    pub fn length(&self) -> f64 {
        self.intervals.iter().map(|[start, end]| end - start).sum()
    }
}

/// Finds the leading edge of a line with a finite domain.
///
/// The equivalent line of a body without an end has the leading edge `[0, ∞[`; ask
/// [`contact_radius`](crate::contact_radius) for its contact line `[0, a]`.
///
/// # Errors
/// [`IndenterError::InvalidParameter`] when the domain is infinite or a height is not finite.
pub fn leading_edge(line: &(impl RigidLine + ?Sized)) -> Result<LeadingEdge, IndenterError> {
    leading_edge_with(line, &LeadingEdgeOptions::default())
}

/// Like [`leading_edge`], with the resolution chosen by the caller.
///
/// # Errors
/// Like [`leading_edge`].
pub fn leading_edge_with(
    line: &(impl RigidLine + ?Sized),
    options: &LeadingEdgeOptions,
) -> Result<LeadingEdge, IndenterError> {
    for end in line.domain() {
        finite("end of the domain", end)?;
    }
    let breaks = line.monotone_breaks(options.samples);
    let heights: Vec<f64> = breaks
        .iter()
        .map(|x| finite("height of the line", line.height(*x)))
        .collect::<Result<_, _>>()?;
    let end = breaks.len().checked_sub(1).ok_or(IndenterError::TooFew {
        list: "monotone_breaks",
        needed: 1,
        length: 0,
    })?;
    let mut backwards = vec![[breaks[end], breaks[end]]];
    // Minimum over all breaks to the right of the piece.
    let mut later = f64::INFINITY;
    for i in (0..end).rev() {
        let piece = Piece {
            ends: [breaks[i], breaks[i + 1]],
            heights: [heights[i], heights[i + 1]],
        };
        if let Some(interval) = piece.visible_below(line, later)? {
            prepend(&mut backwards, interval, later > heights[i + 1]);
        }
        later = later.min(heights[i + 1]);
    }
    backwards.reverse();
    Ok(LeadingEdge {
        intervals: backwards,
        lowest: later.min(heights[0]),
        highest: heights[end],
    })
}

/// A stretch of the line over which it only rises or only falls.
struct Piece {
    ends: [f64; 2],
    heights: [f64; 2],
}

impl Piece {
    /// The part of the piece that belongs to A when the lowest later height is `later`.
    fn visible_below(
        &self,
        line: &(impl RigidLine + ?Sized),
        later: f64,
    ) -> Result<Option<[f64; 2]>, IndenterError> {
        let [start, end] = self.heights;
        if start >= end || start >= later {
            return Ok(None);
        }
        let last = if later >= end {
            self.ends[1]
        } else {
            crossing(line, self.ends, later)?
        };
        Ok(Some([self.ends[0], last]))
    }
}

/// Adds an interval before the others, joined to the next one when its end belongs to A.
fn prepend(backwards: &mut Vec<[f64; 2]>, interval: [f64; 2], closed: bool) {
    match backwards.last_mut() {
        Some(next) if closed => next[0] = interval[0],
        _ => backwards.push(interval),
    }
}

/// Where the rising line passes a height between those at the two ends.
fn crossing(
    line: &(impl RigidLine + ?Sized),
    ends: [f64; 2],
    height: f64,
) -> Result<f64, IndenterError> {
    let checked = |x: f64| line.height(x) - height;
    bracketed_root(checked, ends).ok_or(IndenterError::InvalidParameter {
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
    contact_line_with(line, depth, &LeadingEdgeOptions::default())
}

/// Like [`contact_line`], with the resolution chosen by the caller.
///
/// # Errors
/// Like [`contact_line`].
pub fn contact_line_with(
    line: &(impl RigidLine + ?Sized),
    depth: f64,
    options: &LeadingEdgeOptions,
) -> Result<ContactLine, IndenterError> {
    let depth = positive("depth", depth)?;
    let edge = leading_edge_with(line, options)?;
    let available = edge.available_depth();
    if depth > available {
        return Err(IndenterError::NotHighEnough { available, depth });
    }
    let level = edge.lowest + depth;
    let mut intervals = Vec::new();
    for [start, end] in edge.intervals {
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
        lowest: edge.lowest,
    })
}
