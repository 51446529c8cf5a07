//! Heights of a rigid line over the elements of a Winkler foundation.
//!
//! One element lies at the lowest point of the line. A kink there (the apex of a cone, the cusp of a power p < 1) then
//! falls between two steps and never inside one, so that the slopes on its two sides are not mixed.

use indenters::RigidLine;
use numerics::{golden_section, in_range, positive};

use crate::MdrError;

/// Largest number of elements of a foundation. Chosen to limit memory and computing time: with 200 bytes for an element without
/// its history variables they take 0.8 GiB. More are refused as [`MdrError::TooManyElements`].
pub(crate) const MAX_ELEMENTS: usize = 1 << 22;
/// Ratio of the distance up to which a line on an infinite domain is sampled to the distance at which it was last below the
/// largest needed height. Chosen: a part of the body that comes down farther out is overlooked. Each doubling costs 44 samples,
/// 64 ln 2 by the [`STRIDE_DIVISOR`].
const SAMPLED_DISTANCE_RATIO: usize = 1024;
/// Distance from the anchor, in elements, up to which every element is sampled in the search for the last one below the largest
/// needed height; farther out the stride is the distance over this number. Chosen: a part that comes down again is overlooked if
/// it is narrower than 1/64 of its distance. Twice the number finds parts half as wide, with twice as many samples.
const STRIDE_DIVISOR: usize = 64;
/// Margin above the height asked for, relative to that height, so that rounding cannot lift the contact beyond the last element.
/// Chosen far above the rounding of heights; the elements that it adds are not in contact.
const MAX_HEIGHT_MARGIN: f64 = 1e-9;

/// The elements under the part of a line that can come into contact.
pub(crate) struct ElementHeights {
    /// Heights above the lowest element, \[m], from the rear to the front.
    pub(crate) heights: Vec<f64>,
    /// Height of the lowest element on the line, \[m].
    pub(crate) lowest_height: f64,
    /// Height above the lowest element up to which no element is missing, \[m]; infinite with the whole line.
    pub(crate) max_height: f64,
    /// Position of the lowest point, or of the foremost of several, \[m].
    anchor: f64,
    /// Index of the element at the lowest point.
    pub(crate) anchor_index: usize,
    /// Spacing of the elements, \[m].
    pub(crate) spacing: f64,
}

impl ElementHeights {
    /// All elements at which the line lies at most `height` above its lowest point, those between them, and one more
    /// on each side where the domain has one.
    ///
    /// Parts that come down to that height again farther out are found when they are wider than 1/64 of their distance
    /// from the lowest point.
    pub(crate) fn below(line: &dyn RigidLine, spacing: f64, height: f64) -> Result<Self, MdrError> {
        positive("spacing", spacing)?;
        let start = lowest_candidate(line)?;
        let sampled = Self::around(line, start, spacing, height)?;
        let is_lowest = |height: &f64| *height <= 0.0;
        match sampled.heights.iter().position(is_lowest) {
            Some(lowest) if !is_lowest(&sampled.heights[sampled.anchor_index]) => {
                let refined = refine_lowest(line, sampled.position(lowest), spacing);
                Self::around(line, refined, spacing, height)
            }
            _ => Ok(sampled),
        }
    }

    /// Position of an element on the line, \[m].
    pub(crate) fn position(&self, element: usize) -> f64 {
        // The element lies ahead of the anchor or behind it. Indices have no sign, so that the other one of the two differences
        // is cut off at 0.
        let ahead = element.saturating_sub(self.anchor_index) as f64;
        let behind = self.anchor_index.saturating_sub(element) as f64;
        self.anchor + (ahead - behind) * self.spacing
    }

    /// The elements at a `spacing` \[m] on both sides of an anchor \[m], up to a `height` above it \[m].
    fn around(
        line: &dyn RigidLine,
        anchor: f64,
        spacing: f64,
        height: f64,
    ) -> Result<Self, MdrError> {
        let resolved = anchor + spacing > anchor && anchor - spacing < anchor;
        let allowed = "large enough to tell neighbouring positions on the line apart";
        in_range("spacing", spacing, resolved, allowed)?;
        let anchor_height = checked_height(line, anchor)?;
        let ray = |step| Ray {
            line,
            anchor,
            step,
            max_height: anchor_height + height * (1.0 + MAX_HEIGHT_MARGIN),
        };
        let too_many = || MdrError::TooManyElements {
            allowed: MAX_ELEMENTS,
            spacing,
            height,
        };

        // The heights on both sides of the anchor are joined to one list, from the rear to the front.
        let rear = ray(-spacing).heights()?.ok_or_else(too_many)?;
        let front = ray(spacing).heights()?.ok_or_else(too_many)?;
        let anchor_index = rear.len();
        let mut heights: Vec<f64> = rear.into_iter().rev().collect();
        heights.push(anchor_height);
        heights.extend(front);

        // From here on the heights are counted from the lowest element.
        let lowest_height = heights.iter().copied().fold(anchor_height, f64::min);
        for height in &mut heights {
            *height -= lowest_height;
        }
        let anchor_rise = anchor_height - lowest_height;
        Ok(Self {
            heights,
            lowest_height,
            max_height: (height + anchor_rise) * (1.0 + MAX_HEIGHT_MARGIN),
            anchor,
            anchor_index,
            spacing,
        })
    }
}

/// The elements on one side of the anchor, numbered from 1.
struct Ray<'a> {
    /// Line whose heights are sampled.
    line: &'a dyn RigidLine,
    /// Position of the anchor, \[m].
    anchor: f64,
    /// Distance from element to element with its sign, \[m].
    step: f64,
    /// Height of the line up to which elements are needed, \[m].
    max_height: f64,
}

impl Ray<'_> {
    /// The heights \[m] up to one element beyond the last one below the largest needed height, from the anchor outwards; `None` if
    /// they are more than [`MAX_ELEMENTS`].
    fn heights(&self) -> Result<Option<Vec<f64>>, MdrError> {
        let Some(n_needed) = self.count_needed()? else {
            return Ok(None);
        };
        let mut heights = Vec::with_capacity(n_needed);
        let mut last_below = 0;
        for element in 1..=n_needed {
            let Some(position) = self.position(element) else {
                break;
            };
            let height = checked_height(self.line, position)?;
            // A vertical edge, as the equator of a sphere, ends the line.
            if height == f64::INFINITY {
                break;
            }
            if height <= self.max_height {
                last_below = element;
            }
            heights.push(height);
        }
        heights.truncate(last_below + 1);
        Ok(Some(heights))
    }

    /// Number of elements beyond which no sample of the line lies below the largest needed height; `None` if it exceeds [`MAX_ELEMENTS`].
    fn count_needed(&self) -> Result<Option<usize>, MdrError> {
        let is_bounded = self.end().is_finite();
        let mut element = 1;
        let (mut last_below, mut n_needed) = (0, 1);
        // Look ahead with growing strides for the last element below the largest needed height.
        while let Some(position) = self.position(element) {
            let next = element.saturating_add(1 + element / STRIDE_DIVISOR);
            if checked_height(self.line, position)? <= self.max_height {
                (last_below, n_needed) = (element, next);
            }
            if n_needed > MAX_ELEMENTS {
                return Ok(None);
            }
            if next == usize::MAX
                || !is_bounded && element > SAMPLED_DISTANCE_RATIO * (last_below + 1)
            {
                break;
            }
            element = next;
        }
        Ok(Some(n_needed))
    }

    /// Position of an element, \[m]; `None` beyond the end of the line.
    fn position(&self, element: usize) -> Option<f64> {
        /// Relative rounding by which a last element may miss the end of the domain; it then lies on the end. Derived: the
        /// spacing, its multiple and the length of the domain round by up to half a unit each; the rest is a margin.
        const DOMAIN_END_ROUNDING: f64 = 4.0 * f64::EPSILON;
        let end = self.end();
        let distance = element as f64 * self.step;
        let available = end - self.anchor;
        if distance.abs() > available.abs() * (1.0 + DOMAIN_END_ROUNDING) {
            return None;
        }
        let position = self.anchor + distance;
        Some(if self.step > 0.0 {
            position.min(end)
        } else {
            position.max(end)
        })
    }

    /// End of the domain of the line on this side, \[m].
    fn end(&self) -> f64 {
        let [rear, front] = self.line.domain();
        if self.step > 0.0 { front } else { rear }
    }
}

/// Position of the lowest among the kinks, the ends of the domain, and x = 0, \[m].
///
/// The foremost of several equal ones, where the leading edge begins.
pub(crate) fn lowest_candidate(line: &dyn RigidLine) -> Result<f64, MdrError> {
    let [rear, front] = line.domain();
    let mut candidates = line.kinks();
    candidates.extend([0.0, rear, front]);
    let inside = |x: &f64| x.is_finite() && *x >= rear && *x <= front;
    let positions = candidates.into_iter().filter(inside);
    let heights = positions.map(|x| (line.height(x), x));
    let known = heights.filter(|(height, _)| height.is_finite());
    let lowest = known.min_by(|a, b| a.0.total_cmp(&b.0).then(b.1.total_cmp(&a.1)));
    let failed = || invalid_height(rear, line.height(rear));
    lowest.map(|(_, position)| position).ok_or_else(failed)
}

/// Position \[m] of the lowest point within one `spacing` of the lowest sample, which is at `position`, by golden section.
fn refine_lowest(line: &dyn RigidLine, position: f64, spacing: f64) -> f64 {
    let [rear, front] = line.domain();
    let [low, high] = [position - spacing, position + spacing];
    let lowest = golden_section(|x| line.height(x), [low.max(rear), high.min(front)]);
    let is_lower = line.height(lowest) <= line.height(position);
    if is_lower { lowest } else { position }
}

/// Height of the line, \[m]; `+∞` is allowed (no body there), `−∞` and NaN are [`MdrError::InvalidHeight`].
pub(crate) fn checked_height(line: &dyn RigidLine, position: f64) -> Result<f64, MdrError> {
    let height = line.height(position);
    if height.is_nan() || height == f64::NEG_INFINITY {
        return Err(invalid_height(position, height));
    }
    Ok(height)
}

/// The error for a height that is not a number or −∞.
pub(crate) const fn invalid_height(position: f64, value: f64) -> MdrError {
    MdrError::InvalidHeight { position, value }
}
