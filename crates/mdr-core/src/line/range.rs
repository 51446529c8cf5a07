//! The part of a line that can be in contact at a depth.

use indenters::RigidLine;
use numerics::bracketed_root;

use super::element_heights::{checked_height, lowest_candidate};
use super::profile::MIN_PIECE_LENGTH;
use crate::MdrError;
use crate::error::non_finite;

/// Number of samples of the line per doubling of the distance from the anchor. Chosen: parts that come down again between kinks
/// may be overlooked if they are narrower than 2^(1/16) − 1, or 4 %, of that distance. Twice as many samples find parts half as
/// wide.
const SAMPLES_PER_OCTAVE: f64 = 16.0;
/// Ratio of the distance at which the search on an endless line begins to that at which the line first rises above the height
/// limit. Chosen: a part that comes down farther out is overlooked. Each doubling costs [`SAMPLES_PER_OCTAVE`] samples.
const SEARCH_DISTANCE_RATIO: f64 = 1024.0;
/// Factor on the distance from the anchor from one step to the next, in the search for a first height above the height limit on
/// an endless line. Chosen: it decides where the search inwards begins, and so the number of its samples.
const OUTWARD_STRIDE: f64 = 8.0;

/// Distance from a vertical edge, such as the equator of a sphere, up to which a body is followed, as a part of its length from
/// the lowest point. Derived: closer to the edge the nodes of a piece are at the rounding of positions.
const EDGE_INSET: f64 = MIN_PIECE_LENGTH;

/// Positions between which all heights below the height limit lie.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Range {
    /// Rear and front, \[m].
    pub(crate) ends: [f64; 2],
    /// Height of the line at the anchor, to which heights are relative, \[m].
    pub(crate) anchor_height: f64,
    /// Height of the front end above the anchor, \[m].
    front_height: f64,
    /// True if the front of the range is the front end of the line.
    ends_in_front: bool,
}

impl Range {
    /// The range of all points at most `depth` \[m] above the lowest of the kinks, the ends, and x = 0.
    ///
    /// Refuses a depth that is negative or not a number, as a search that overflows may give it.
    pub(crate) fn below(line: &dyn RigidLine, depth: f64) -> Result<Self, MdrError> {
        if depth.is_nan() || depth < 0.0 {
            return Err(non_finite("indentation depth", depth, 0.0));
        }
        let anchor = lowest_candidate(line)?;
        let anchor_height = checked_height(line, anchor)?;
        let excess = |x: f64| Ok(checked_height(line, x)? - anchor_height - depth);
        let [rear_end, front_end] = line.domain();

        // Each end of the range is sought from outside to inside, over the whole line and over the pieces between its kinks.
        let mut stops = line.kinks();
        stops.retain(|x| *x > rear_end && *x < front_end);
        stops.insert(0, rear_end);
        stops.push(front_end);
        let backwards = stops.windows(2).map(|ends| [ends[1], ends[0]]);
        let forwards = stops.windows(2).rev().map(|ends| [ends[0], ends[1]]);
        let rear = outermost_of(excess, anchor, rear_end, backwards)?;
        let front = outermost_of(excess, anchor, front_end, forwards)?;
        Ok(Self {
            ends: [rear, front],
            anchor_height,
            front_height: checked_height(line, front)? - anchor_height,
            ends_in_front: front >= front_end,
        })
    }

    /// Refuses a line that ends in front before it reaches the height limit.
    ///
    /// `lowest` is the lowest height relative to the anchor, \[m], known to the `tolerance` in depths.
    pub(crate) fn check_front(
        &self,
        lowest: f64,
        depth: f64,
        tolerance: f64,
    ) -> Result<(), MdrError> {
        let available = self.front_height - lowest;
        if self.ends_in_front && available < depth * (1.0 - tolerance) {
            return Err(MdrError::DepthBeyondEdge {
                position: self.ends[1],
                available,
                indentation_depth: depth,
            });
        }
        Ok(())
    }
}

/// Where a body ends with a vertical edge in front.
#[derive(Debug, Clone, Copy)]
pub(crate) struct VerticalEdge {
    /// Position of the edge on the line, \[m].
    pub(crate) position: f64,
    /// Height of the line next to the edge, above its lowest point, \[m].
    pub(crate) height: f64,
}

/// The vertical edge at the front end of a line, if it has one.
pub(crate) fn vertical_edge(line: &dyn RigidLine) -> Result<Option<VerticalEdge>, MdrError> {
    let [_, position] = line.domain();
    if position.is_infinite() || checked_height(line, position)?.is_finite() {
        return Ok(None);
    }
    let anchor = lowest_candidate(line)?;
    let inside = position - EDGE_INSET * (position - anchor);
    let height = checked_height(line, inside)? - checked_height(line, anchor)?;
    Ok(Some(VerticalEdge { position, height }))
}

/// The outermost position \[m] between the anchor and the end at which the line lies below the height limit.
///
/// `excess` is the height above the limit at a position, \[m]. `pieces` are the intervals `[inner, outer]` between kinks, the
/// outermost first; a piece beyond a gap is found by its inner end.
fn outermost_of(
    excess: impl Fn(f64) -> Result<f64, MdrError> + Copy,
    anchor: f64,
    end: f64,
    mut pieces: impl Iterator<Item = [f64; 2]>,
) -> Result<f64, MdrError> {
    let found = outermost(excess, anchor, end)?;
    let is_beyond = |x: f64| (x - found) * (end - anchor) > 0.0;
    let is_low =
        |[inner, _]: &[f64; 2]| is_beyond(*inner) && excess(*inner).is_ok_and(|e| e <= 0.0);
    let piece = pieces.find(is_low);
    piece.map_or(Ok(found), |[inner, outer]| outermost(excess, inner, outer))
}

/// The outermost position \[m] between `anchor` and `end` at which the line lies below the height limit, by samples from outside.
///
/// `excess` is the height above the limit at a position, \[m].
fn outermost(
    excess: impl Fn(f64) -> Result<f64, MdrError>,
    anchor: f64,
    end: f64,
) -> Result<f64, MdrError> {
    if end.is_finite() && excess(end)? <= 0.0 {
        return Ok(end);
    }
    // `outside` is the distance of a point above the height limit, from which the samples go inwards.
    let mut outside = if end.is_finite() {
        end - anchor
    } else {
        SEARCH_DISTANCE_RATIO * first_above(&excess, anchor, end.signum())?
    };
    // The sum of two positions may be rounded beyond the end.
    let within = |x: f64| if end > anchor { x.min(end) } else { x.max(end) };
    // The anchor itself lies below the height limit, so that the loop ends.
    loop {
        let inside = outside * (-1.0 / SAMPLES_PER_OCTAVE).exp2();
        // The smallest numbers are rounded up to themselves.
        if inside.total_cmp(&outside).is_eq() {
            return Ok(anchor);
        }
        if excess(anchor + inside)? <= 0.0 {
            let plain = |x: f64| excess(x).unwrap_or(f64::NAN);
            let [near, far] = [inside, outside].map(|offset| within(anchor + offset));
            return Ok(bracketed_root(plain, [near, far]).unwrap_or(far));
        }
        outside = inside;
    }
}

/// A distance \[m] from the anchor, with the `sign` of its side, at which an endless line lies above the height limit;
/// [`MdrError::NotRising`] if there is none.
fn first_above(
    excess: impl Fn(f64) -> Result<f64, MdrError>,
    anchor: f64,
    sign: f64,
) -> Result<f64, MdrError> {
    let mut distance = sign;
    while excess(anchor + distance)? <= 0.0 {
        distance *= OUTWARD_STRIDE;
        if !distance.is_finite() {
            return Err(MdrError::NotRising { position: anchor });
        }
    }
    Ok(distance)
}

#[cfg(test)]
mod tests {
    use indenters::{EquivalentLine, Sphere};

    use super::Range;

    #[test]
    fn a_body_of_the_smallest_size_ends_the_search() {
        let sphere = Sphere::new(5e-324).expect("a radius");
        let found = Range::below(&EquivalentLine(&sphere), 5e-324);
        assert!(found.is_ok_and(|found| found.ends[0] <= found.ends[1]));
    }

    #[test]
    fn a_depth_that_is_none_ends_the_search() {
        let sphere = Sphere::new(5e-3).expect("a radius");
        let line = EquivalentLine(&sphere);
        for depth in [f64::NAN, -1e-6, f64::NEG_INFINITY] {
            assert!(Range::below(&line, depth).is_err(), "{depth}");
        }
        let found = Range::below(&line, 1e-6).expect("a range");
        assert!(found.ends[1] > 0.0, "{found:?}");
    }
}
