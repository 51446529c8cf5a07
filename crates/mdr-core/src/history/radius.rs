//! The radius of the contact circle as a function of the depth, in polynomials.
//!
//! ```text
//! h̃(a(d)) = d        ∫ e^(−(t − s)/τ) a(d(s)) ḋ ds   is exact for a polynomial
//! ```
//! h̃(x) is the height of the equivalent line of the body above its lowest point, and a(d) the contact radius at the depth d.
//! The integral is that of a branch with the relaxation time τ.

use std::f64::consts::PI;

use indenters::EquivalentProfile;
use numerics::bracketed_root;

use crate::MdrError;

/// Number of coefficients of the polynomial on one piece. Chosen: pieces are halved until it is enough, so that it decides the
/// number of pieces and the time.
pub(super) const N_COEFFICIENTS: usize = 16;
/// Size of the last two coefficients, relative to the radius, below which a piece is not divided. Chosen: the missing
/// coefficients are a hundredth of that, which is nine units in the last place; a smaller tolerance would divide pieces for their
/// rounding.
pub(super) const TAIL_TOLERANCE: f64 = 2e-13;
/// Distance from a vertical edge, such as the equator of a sphere, up to which a contact counts as having reached the edge, and
/// is refused as [`MdrError::DepthBeyondEdge`]. It is relative to the radius of the edge. Chosen: closer to the edge the rounding
/// of radii is more than 1e-6 of the distance from it.
const EDGE_MARGIN: f64 = 1e-10;
/// Largest area of a piece that is not divided further, as a fraction of the area a d, with a the largest radius and d the
/// largest depth. Chosen: 45 units in the last place of the area, which no sum over the contact can show.
const NEGLIGIBLE_AREA: f64 = 1e-14;

/// Contact radius a(d) from first contact to the largest depth, as piecewise polynomials.
#[derive(Debug, Clone)]
pub(super) struct Radii {
    /// Pieces by increasing depth.
    pieces: Vec<RadiusPiece>,
    /// Bound of the error of ∫ a dd by the polynomials, \[m²].
    pub(super) area_error: f64,
}

/// A polynomial of ξ ∈ [−1, 1] between two depths.
#[derive(Debug, Clone, Copy)]
struct RadiusPiece {
    /// Depths at ξ = −1 and ξ = 1, \[m].
    depths: [f64; 2],
    /// Coefficients of the radius over the powers of ξ, \[m].
    coefficients: [f64; N_COEFFICIENTS],
}

impl Radii {
    /// The radii of a body whose line rises up to the largest depth > 0 \[m]; refuses a depth beyond a vertical edge.
    pub(super) fn new(body: &dyn EquivalentProfile, deepest: f64) -> Result<Self, MdrError> {
        let mut radii = Self {
            pieces: Vec::new(),
            area_error: 0.0,
        };
        let largest = body.position(deepest)?;
        let end = body.end();
        let edge = (1.0 - EDGE_MARGIN) * end;
        if largest > edge && body.height_at(end) == f64::INFINITY {
            return Err(MdrError::DepthBeyondEdge {
                position: end,
                available: body.height_at(edge),
                indentation_depth: deepest,
            });
        }
        let negligible = NEGLIGIBLE_AREA * deepest * largest;
        let exponent = body.apex_exponent();
        // The table holds the cosines of all multiples of π/(2 n), with n the number of coefficients. `cosine` takes cos(order
        // · angle) at the angle π (2 node + 1)/(2 n) of a node from it.
        let table: [f64; 4 * N_COEFFICIENTS] =
            std::array::from_fn(|n| (0.5 * PI * n as f64 / N_COEFFICIENTS as f64).cos());
        let cosine = |node, order| table[order * (2 * node + 1) % (4 * N_COEFFICIENTS)];
        let cosines = std::array::from_fn(|node| std::array::from_fn(|order| cosine(node, order)));

        // Halve the range of depths until each piece is resolved; the halves are pushed so that the lower one comes first.
        let mut open = vec![([0.0, deepest], [0.0, largest])];
        while let Some((depths, radii_at_depths)) = open.pop() {
            let [[low, high], [inner, outer]] = [depths, radii_at_depths];
            let middle = 0.5 * (low + high);
            let is_tiny = outer * (high - low) <= negligible || middle <= low || middle >= high;
            // At the apex of a power x^p the radius is like d^(1/p), which is a polynomial only for a cone and for a flat end.
            let is_root =
                low == 0.0 && exponent.is_finite() && (exponent - 1.0).abs() > f64::EPSILON;
            if is_tiny || !is_root {
                let (piece, tail) = RadiusPiece::fitted(body, depths, radii_at_depths, &cosines);
                if is_tiny || tail <= TAIL_TOLERANCE * outer {
                    // At the apex the tail says nothing about a root of the depth, and the radius itself bounds the error.
                    let tail = if is_root { outer } else { tail };
                    radii.area_error += 0.01 * tail * (high - low);
                    radii.pieces.push(piece);
                    continue;
                }
            }
            let between = radius(body, middle, [inner, outer]);
            open.push(([middle, high], [between, outer]));
            open.push(([low, middle], [inner, between]));
        }
        Ok(radii)
    }

    /// The piece that begins at a depth or contains it.
    fn piece_at(&self, depth: f64) -> &RadiusPiece {
        let all_but_last = &self.pieces[..self.pieces.len() - 1];
        &self.pieces[all_but_last.partition_point(|piece| piece.depths[1] <= depth)]
    }

    /// The largest depth, \[m].
    pub(super) fn deepest(&self) -> f64 {
        self.pieces[self.pieces.len() - 1].depths[1]
    }

    /// Integral ∫ a dd up to the largest depth, \[m²].
    pub(super) fn area(&self) -> f64 {
        self.pieces.iter().map(|piece| piece.area(1.0)).sum()
    }

    /// The depth at which ∫ a dd is `area` \[m²]; the largest depth if it is less everywhere.
    pub(super) fn depth_of_area(&self, area: f64) -> f64 {
        let mut below = 0.0;
        for piece in &self.pieces {
            let whole = piece.area(1.0);
            if below + whole >= area {
                let excess = |position: f64| below + piece.area(position) - area;
                let position = bracketed_root(excess, [-1.0, 1.0]).unwrap_or(-1.0);
                let [low, high] = piece.depths;
                return low + 0.5 * (high - low) * (1.0 + position);
            }
            below += whole;
        }
        self.deepest()
    }

    /// The depth \[m] up to which one polynomial holds from `depth` on.
    pub(super) fn end_of_piece(&self, depth: f64) -> f64 {
        self.piece_at(depth).depths[1]
    }

    /// The radius over θ ∈ [0, 1] while the depth increases linearly from one to the other of `depths`, within a piece.
    pub(super) fn polynomial_between(&self, depths: [f64; 2]) -> Polynomial {
        let [from, to] = depths;
        // The piece is found by the middle of the two depths, because rounding may put the ends into the pieces next to it.
        let piece = self.piece_at(0.5 * (from + to));
        let start = piece.position(from);
        let length = piece.position(to) - start;
        // The radius is analytic in a circle of radius 2 around any point of a piece, or the piece would have been divided.
        let fourth = (0.5 * length).powi(4);
        let enough = |quarters: &i32| fourth.powi(*quarters) < 0.1 * f64::EPSILON;
        let quarters = (2..4).find(enough).map_or(4, i32::unsigned_abs);
        let n_terms = 4 * quarters as usize;
        let mut coefficients = match quarters {
            2 => piece.taylor_coefficients::<8>(start),
            3 => piece.taylor_coefficients::<12>(start),
            _ => piece.taylor_coefficients::<N_COEFFICIENTS>(start),
        };
        let mut scale = 1.0;
        for coefficient in &mut coefficients[..n_terms] {
            *coefficient *= scale;
            scale *= length;
        }
        Polynomial {
            coefficients,
            n_terms,
        }
    }

    /// Radius \[m] and its derivative by the depth, at the second of two depths in one piece.
    pub(super) fn radius_and_slope(&self, depths: [f64; 2]) -> [f64; 2] {
        let [from, depth] = depths;
        let piece = self.piece_at(0.5 * (from + depth));
        let position = piece.position(depth);
        let powers = piece.coefficients.iter().rev();
        let [radius, slope] = powers.fold([0.0; 2], |[value, slope], coefficient| {
            [coefficient + position * value, value + position * slope]
        });
        [radius, 2.0 * slope / (piece.depths[1] - piece.depths[0])]
    }
}

/// A radius as a polynomial of θ ∈ [0, 1].
#[derive(Debug, Clone, Copy)]
pub(super) struct Polynomial {
    /// Coefficients of the powers of θ, \[m].
    coefficients: [f64; N_COEFFICIENTS],
    /// Number of coefficients that matter.
    n_terms: usize,
}

impl Polynomial {
    /// Coefficients of the powers of θ, \[m].
    pub(super) fn terms(&self) -> &[f64] {
        &self.coefficients[..self.n_terms]
    }

    /// The polynomial over [0, `part`], as one over [0, 1].
    pub(super) fn up_to(mut self, part: f64) -> Self {
        let mut power = 1.0;
        for coefficient in &mut self.coefficients[..self.n_terms] {
            *coefficient *= power;
            power *= part;
        }
        self
    }
}

impl RadiusPiece {
    /// Taylor coefficients of the radius at ξ = `start`, by repeated synthetic division; only the first `N_TERMS` are exact.
    fn taylor_coefficients<const N_TERMS: usize>(&self, start: f64) -> [f64; N_COEFFICIENTS] {
        let mut coefficients = self.coefficients;
        for first in 0..N_TERMS {
            for order in (first..N_COEFFICIENTS - 1).rev() {
                coefficients[order] += start * coefficients[order + 1];
            }
        }
        coefficients
    }

    /// Integral ∫ a dd from the beginning of the piece up to ξ, \[m²].
    fn area(&self, position: f64) -> f64 {
        let antiderivative = |position: f64| {
            let terms = self.coefficients.iter().enumerate().rev();
            position * terms.fold(0.0, |sum, (n, c)| sum * position + c / (n as f64 + 1.0))
        };
        0.5 * (self.depths[1] - self.depths[0]) * (antiderivative(position) - antiderivative(-1.0))
    }

    /// Position ξ ∈ [−1, 1] of a depth \[m] of the piece.
    fn position(&self, depth: f64) -> f64 {
        let [low, high] = self.depths;
        (depth - low) / (0.5 * (high - low)) - 1.0
    }

    /// Interpolates the radius between two depths \[m] at the zeros of the Chebyshev polynomial T_n; returns also the size of the last
    /// two terms \[m], a measure of the error.
    ///
    /// `cosines` are T_order at the nodes, one row for each node; `radii` are those at both depths.
    fn fitted(
        body: &dyn EquivalentProfile,
        depths: [f64; 2],
        radii: [f64; 2],
        cosines: &[[f64; N_COEFFICIENTS]; N_COEFFICIENTS],
    ) -> (Self, f64) {
        let [low, high] = depths;
        // The radii at the nodes are found from the outermost inwards, so that each is a bound for the next one.
        let mut previous_radius = radii[1];
        let values: [f64; N_COEFFICIENTS] = std::array::from_fn(|node| {
            let depth = low + 0.5 * (high - low) * (1.0 + cosines[node][1]);
            previous_radius = radius(body, depth, [radii[0], previous_radius]);
            previous_radius
        });
        // The Chebyshev series through these radii is computed first, and from it the coefficients of the powers of ξ.
        let scaled = values.map(|value| 2.0 / N_COEFFICIENTS as f64 * value);
        let mut series = sum_of_rows(&scaled, cosines);
        series[0] *= 0.5;
        let coefficients = sum_of_rows(&series, &CHEBYSHEV);
        let piece = Self {
            depths,
            coefficients,
        };
        let tail = series[N_COEFFICIENTS - 2].abs() + series[N_COEFFICIENTS - 1].abs();
        (piece, tail)
    }
}

/// Coefficients of the powers of ξ in the Chebyshev polynomials, one polynomial in each row.
const CHEBYSHEV: [[f64; N_COEFFICIENTS]; N_COEFFICIENTS] = {
    let mut rows = [[0.0; N_COEFFICIENTS]; N_COEFFICIENTS];
    (rows[0][0], rows[1][1]) = (1.0, 1.0);
    let mut row = 2;
    while row < N_COEFFICIENTS {
        rows[row][0] = -rows[row - 2][0];
        let mut power = 1;
        while power <= row {
            rows[row][power] = 2.0 * rows[row - 1][power - 1] - rows[row - 2][power];
            power += 1;
        }
        row += 1;
    }
    rows
};

/// Sum Σ_k factor_k row_k, row by row, so that the compiler sums all columns together.
fn sum_of_rows(
    factors: &[f64; N_COEFFICIENTS],
    rows: &[[f64; N_COEFFICIENTS]; N_COEFFICIENTS],
) -> [f64; N_COEFFICIENTS] {
    let mut sums = [0.0; N_COEFFICIENTS];
    for (factor, row) in factors.iter().zip(rows) {
        for (sum, value) in sums.iter_mut().zip(row) {
            *sum += factor * value;
        }
    }
    sums
}

/// The radius \[m] between two others at which the line reaches a height \[m], from its closed form if it has one; the outer
/// radius if the line is lower up to there, as the flat end of a punch.
fn radius(body: &dyn EquivalentProfile, height: f64, bracket: [f64; 2]) -> f64 {
    let closed = body.closed_position(height);
    let excess = |x: f64| body.height_at(x) - height;
    closed.unwrap_or_else(|| bracketed_root(excess, bracket).unwrap_or(bracket[1]))
}
