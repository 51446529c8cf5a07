//! A line as a sequence of polynomials, as many as its shape needs (docs/theory/line-viscoelastic.md, "No mesh in the
//! material").
//!
//! Pieces end at the kinks and at the turning points of the line. A piece is halved until the last terms of its
//! polynomial are negligible; towards a cusp this grades the pieces geometrically. Heights are in units of the depth, so
//! that their squares stay numbers.

use indenters::RigidLine;
use numerics::bracketed_root;

use super::element_heights::{checked_height, invalid_height};
use super::legendre::{
    DEGREE, Interpolation, Polynomial, derivative, end_value, start_value, value,
};
use super::range::Range;
use super::segment::Segment;
use crate::MdrError;

/// Number of points along the whole range, besides the nodes, at which the polynomials are compared with the line. Chosen: a detail
/// between nodes may be overlooked if it is narrower than 1/64 of the range. More points take more evaluations of the line.
const N_CHECK_POINTS: f64 = 64.0;
/// Number of samples of the slope of a piece in the search for its turning points. Chosen above twice the nine zeros that a slope
/// of degree nine may have; two zeros within a twelfth of half the piece may be overlooked.
const N_SLOPE_SAMPLES: usize = 24;

/// Largest number of polynomials of a line. Chosen to limit the time: more take seconds for each trial depth, and are refused as
/// [`MdrError::TooMuchDetail`].
const MAX_PIECES: usize = 1 << 18;
/// Ratio of the rounding in the last terms of a polynomial to that of heights and positions. Measured by `evidence tuning`: from
/// 8 to 64 nothing changes, with 1 a flat end takes 1.6 times as long, with 0 it is refused.
const TERM_ROUNDING_FACTOR: f64 = 8.0;

/// Length of the shortest piece, relative to its distance from x = 0. Derived: the outermost two of the eleven Lobatto nodes are
/// 0.033 of the length apart, which is then 34 units in the last place of their positions.
pub(super) const MIN_PIECE_LENGTH: f64 = 1024.0 * f64::EPSILON;

/// Criterion for a resolved polynomial.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Resolution {
    /// Indentation depth, \[m].
    pub(crate) depth: f64,
    /// Shortest distance of relaxation, \[m].
    pub(crate) shortest_length: f64,
    /// Size of negligible terms, in depths.
    pub(crate) tolerance: f64,
}

/// The part of a line that can come into contact, from the front to the rear.
pub(crate) struct Profile {
    /// Polynomials from the front to the rear.
    pub(crate) pieces: Vec<Piece>,
    /// Distance from its front to its rear, \[m].
    pub(crate) length: f64,
    /// Height of the lowest point relative to the anchor, in depths.
    pub(crate) lowest: f64,
    /// Interpolation by which parts of the pieces become polynomials.
    pub(crate) interpolation: Interpolation,
}

/// An interval on which the line is monotone.
pub(crate) struct Piece {
    /// Compression that the piece imposes when the lowest point of the line is one depth deep. While the pieces are made, it is
    /// relative to that of the anchor.
    pub(crate) segment: Segment,
    /// Estimated sum of the terms that are left out, in depths.
    pub(crate) tail: f64,
    /// True if the piece is as short as possible, and still not resolved.
    pub(crate) singular: bool,
}

impl Profile {
    /// Divides the line within a range into polynomials that are resolved in the sense of `resolution`.
    pub(crate) fn new(
        line: &dyn RigidLine,
        range: &Range,
        resolution: Resolution,
    ) -> Result<Self, MdrError> {
        let builder = Builder {
            drop: |x| Ok((range.anchor_height - checked_height(line, x)?) / resolution.depth),
            interpolation: Interpolation::new(),
            length: range.ends[1] - range.ends[0],
            resolution,
        };
        // The range is divided at its kinks, and each part is resolved into pieces from the front to the rear.
        let [rear, front] = range.ends;
        let mut breaks = vec![front];
        let inside = |x: &f64| *x > rear && *x < front;
        breaks.extend(line.kinks().into_iter().rev().filter(inside));
        breaks.push(rear);
        let mut pieces = Vec::new();
        for ends in breaks.windows(2) {
            builder.resolve([ends[0], ends[1]], &mut pieces)?;
        }
        // The compressions become relative to the lowest point of the line, which is one depth deep.
        let ends = |piece: &Piece| start_value(piece.terms()).max(end_value(piece.terms()));
        let lowest = -pieces.iter().map(ends).fold(0.0, f64::max);
        for piece in &mut pieces {
            piece.segment.displacements[0] += lowest + 1.0;
        }
        Ok(Self {
            pieces,
            length: builder.length,
            lowest,
            interpolation: builder.interpolation,
        })
    }
}

impl Piece {
    /// Legendre coefficients of the compression, in depths.
    fn terms(&self) -> &Polynomial {
        &self.segment.displacements
    }

    /// Position on the line, within the ends of the piece, \[m].
    fn position(&self, t: f64) -> f64 {
        let [front, rear] = self.segment.ends;
        self.segment.position(t).clamp(rear, front)
    }

    /// Bound Σ |c_k|, k ≥ 1, of the deviation of the compression from its mean, in depths.
    fn rise(&self) -> f64 {
        self.terms()[1..].iter().map(|c| c.abs()).sum()
    }

    /// True if the tail is the rounding of heights and, where the line is steep, of positions.
    ///
    /// Halving such a piece does not reduce its tail: next to a flat end pieces would be halved as long as numbers allow.
    fn is_rounding(&self) -> bool {
        let Segment { ends, length, .. } = self.segment;
        let rise = self.rise();
        let moved = rise * (ends[0].abs().max(ends[1].abs()) / length);
        self.tail <= TERM_ROUNDING_FACTOR * f64::EPSILON * (self.terms()[0].abs() + rise + moved)
    }

    /// Turning point of the line inside the piece, as −1 < t < 1; `None` without one.
    fn turning_point(&self) -> Option<f64> {
        // Because |P'_k| ≤ k (k + 1)/2, the slope has no zero if its first term outweighs all others.
        let (terms, degree) = (self.terms(), self.segment.degree);
        let bound = (2..=degree).map(|k| (k * (k + 1) / 2) as f64 * terms[k].abs());
        if terms[1].abs() >= bound.sum::<f64>() {
            return None;
        }
        let slopes = derivative(terms);
        let slope = |t: f64| value(&slopes[..degree.max(1)], t);
        let sample = |k: usize| (2 * k + 1) as f64 / N_SLOPE_SAMPLES as f64 - 1.0;
        (1..N_SLOPE_SAMPLES)
            .map(|k| [sample(k - 1), sample(k)])
            .find(|[from, to]| slope(*from) * slope(*to).signum() < 0.0)
            .and_then(|bracket| bracketed_root(slope, bracket))
    }

    /// A piece that cannot be resolved is straight between its ends: a polynomial would oscillate.
    fn straightened(mut self) -> Self {
        let [front, rear] = [start_value(self.terms()), end_value(self.terms())];
        self.segment.displacements = [0.0; DEGREE + 1];
        self.segment.displacements[0] = front.midpoint(rear);
        self.segment.displacements[1] = 0.5 * (rear - front);
        self.segment.degree = 1;
        self.singular = true;
        self
    }

    /// Sets the highest terms to 0 as long as they are rounding, and reduces the degree accordingly.
    fn trim(&mut self) {
        let segment = &mut self.segment;
        let sizes = segment.displacements.iter().map(|c| c.abs());
        let rounding = 2.0 * f64::EPSILON * sizes.fold(0.0, f64::max);
        while segment.degree > 0 && segment.displacements[segment.degree].abs() <= rounding {
            segment.displacements[segment.degree] = 0.0;
            segment.degree -= 1;
        }
    }
}

/// Division of a line into pieces.
struct Builder<D> {
    /// Depth of the line below the anchor at a position, in depths.
    drop: D,
    /// Interpolation on a piece.
    interpolation: Interpolation,
    /// Length of the range, \[m].
    length: f64,
    /// Criterion for a resolved piece.
    resolution: Resolution,
}

impl<D: Fn(f64) -> Result<f64, MdrError>> Builder<D> {
    /// Appends the pieces between two positions `[front, rear]` \[m], from the front to the rear.
    fn resolve(&self, ends: [f64; 2], pieces: &mut Vec<Piece>) -> Result<(), MdrError> {
        let mut waiting = vec![ends];
        while let Some(ends) = waiting.pop() {
            let piece = self.interpolate_piece(ends)?;
            let middle = ends[0].midpoint(ends[1]);
            let farthest = ends[0].abs().max(ends[1].abs());
            let smallest = (MIN_PIECE_LENGTH * farthest).max(f64::MIN_POSITIVE);
            let indivisible = piece.segment.length <= smallest || ends.contains(&middle);

            // Keep a resolved piece, straighten one that cannot be halved, halve the others.
            if piece.is_rounding() || self.is_resolved(&piece)? {
                self.split_at_turning_point(piece, pieces)?;
            } else if indivisible {
                pieces.push(piece.straightened());
            } else {
                if pieces.len() + waiting.len() >= MAX_PIECES {
                    return Err(MdrError::TooMuchDetail {
                        parts: "polynomials",
                        allowed: MAX_PIECES,
                        position: middle,
                    });
                }
                waiting.push([middle, ends[1]]);
                waiting.push([ends[0], middle]);
            }
        }
        Ok(())
    }

    /// Adds a piece, in two parts if the line turns inside it.
    fn split_at_turning_point(
        &self,
        piece: Piece,
        pieces: &mut Vec<Piece>,
    ) -> Result<(), MdrError> {
        let turn = piece.turning_point().map(|t| piece.position(t));
        match turn.filter(|x| !piece.segment.ends.contains(x)) {
            None => pieces.push(piece),
            Some(turn) => {
                pieces.push(self.interpolate_piece([piece.segment.ends[0], turn])?);
                pieces.push(self.interpolate_piece([turn, piece.segment.ends[1]])?);
            }
        }
        Ok(())
    }

    /// The polynomial between two positions `[front, rear]` \[m], with the estimate of its tail.
    fn interpolate_piece(&self, ends: [f64; 2]) -> Result<Piece, MdrError> {
        let mut piece = Piece {
            segment: Segment {
                displacements: [0.0; DEGREE + 1],
                degree: DEGREE,
                ends,
                length: ends[0] - ends[1],
                rounding: 0.0,
            },
            tail: 0.0,
            singular: false,
        };
        // The polynomial interpolates the depth of the line below the anchor; heights that are not finite are refused.
        let drop = |t: f64| (self.drop)(piece.position(t)).unwrap_or(f64::NAN);
        piece.segment.displacements = self.interpolation.interpolate(drop);
        if !piece.terms().iter().all(|c| c.is_finite()) {
            return Err(self.bad_height(&piece));
        }
        // Estimate the error, and leave out negligible terms.
        piece.tail = estimate_tail(piece.terms());
        piece.trim();
        Ok(piece)
    }

    /// The error that names the first node of a piece at which the line has no finite height.
    fn bad_height(&self, piece: &Piece) -> MdrError {
        for k in 0..=2 * DEGREE {
            let position = piece.position(k as f64 / DEGREE as f64 - 1.0);
            match (self.drop)(position) {
                Err(error) => return error,
                Ok(drop) if !drop.is_finite() => return invalid_height(position, -drop),
                Ok(_) => {}
            }
        }
        invalid_height(piece.position(0.0), f64::INFINITY)
    }

    /// True if the tail is negligible, and the line agrees with the polynomial between the nodes.
    fn is_resolved(&self, piece: &Piece) -> Result<bool, MdrError> {
        let tolerance = self.resolution.tolerance;
        let (rise, length) = (piece.rise(), piece.segment.length);
        // A tail relative to the rise matters for the dissipation ∫ u'² dx of branches that relax within the piece. A piece that is
        // shorter than the shortest distance of relaxation acts through the heights of its ends alone.
        let steep = length > self.resolution.shortest_length
            && piece.tail > tolerance * rise
            && piece.tail * rise * (self.length / length) > tolerance;
        Ok(piece.tail <= tolerance && !steep && self.agrees_with_line(piece)?)
    }

    /// True if the line agrees with the polynomial at points between the nodes.
    fn agrees_with_line(&self, piece: &Piece) -> Result<bool, MdrError> {
        let share = N_CHECK_POINTS * piece.segment.length / self.length;
        /// Stride of the points as a fraction of the piece, the golden ratio minus 1. It is irrational, so that the points are not
        /// commensurate with a periodic line.
        const CHECK_POINT_STRIDE: f64 = 0.618_033_988_749_894_9;
        let mut point = 1.0;
        while point <= share.ceil() {
            let t = 2.0 * (point * CHECK_POINT_STRIDE).fract() - 1.0;
            let difference = (self.drop)(piece.position(t))? - value(piece.terms(), t);
            let is_close = difference.abs() <= 8.0 * self.resolution.tolerance;
            if !is_close {
                return Ok(false);
            }
            point += 1.0;
        }
        Ok(true)
    }
}

/// Sum of the terms that are left out, by a geometric series through the last two pairs of terms, in depths.
///
/// Pairs, because an even line has no odd terms. Towards a cusp the terms decay like a power, and all of the tail matters.
fn estimate_tail(coefficients: &Polynomial) -> f64 {
    let pair = |k: usize| coefficients[k].abs() + coefficients[k - 1].abs();
    let (last, before) = (pair(DEGREE), pair(DEGREE - 2));
    match last / before {
        ratio if last < before => last * ratio / (1.0 - ratio).max(MIN_PAIR_DECAY),
        _ => last,
    }
}

/// Smallest value of 1 − q in the geometric series of [`estimate_tail`], where q is the ratio of the last pair of terms to the
/// pair before. A ratio closer to 1 is rounding, whose terms add up to nothing. Chosen: the tail is then four times the product
/// of q and the last pair (case of `evidence tuning`).
const MIN_PAIR_DECAY: f64 = 0.25;
