//! Influence coefficient of a uniformly loaded rectangle on the half space.
//!
//! ```text
//! K(x, y) = ∬ dA' / |r − r'|   over the rectangle around the origin        (Love 1929)
//! ```
//!
//! Theory: docs/theory/transient-half-space.md, "Elements and steps".

use crate::substrate::rectangle::{PlaneKernel, distance, integrate, product_asinh};

/// Distance from the centre, in units of the longer edge, beyond which monopole and multipoles of the orders 2 and 4 are exact
/// to rounding. Derived: the next multipole is below 0.02 r⁻⁶ of the whole.
const MULTIPOLE_DISTANCE: f64 = 256.0;

/// Integral of 1/r over a rectangle, \[m].
///
/// `offset` is the position of the field point relative to the centre of the rectangle and `edges` its edges, both
/// along x and y in \[m]. The surface of an elastic half space under the uniform pressure P moves by `P K / (4 π G)`,
/// the surface of a viscous one at the rate `P K / (4 π η)`.
pub fn influence(offset: [f64; 2], edges: [f64; 2]) -> f64 {
    // Lengths in units of the longer edge neither overflow nor underflow when they are squared.
    let unit = edges[0].max(edges[1]);
    let [offset, edges] = [offset, edges].map(|lengths| lengths.map(|length| length.abs() / unit));
    // Take the multipole expansion far away, and the closed form or a Gauss rule near the rectangle.
    let [x, y] = offset;
    if x * x + y * y >= MULTIPOLE_DISTANCE * MULTIPOLE_DISTANCE {
        return unit * multipoles(offset, edges);
    }
    unit * integrate::<Reciprocal>(offset, edges)
}

/// Multipole expansion of K up to order 4 at the offset [x, y] from the centre of a rectangle with the edges [a, b], all in units
/// of one length. Its terms are means over the rectangle of Legendre polynomials of the angle between field point and source point.
fn multipoles(offset: [f64; 2], edges: [f64; 2]) -> f64 {
    let ([x, y], [a, b]) = (offset, edges);
    let square = x * x + y * y;
    // Compute the squares of the direction cosines, and the mean moments of the rectangle of the orders 2 and 4.
    let [p, q] = [x * x / square, y * y / square];
    let [x2, y2] = [a * a / 12.0, b * b / 12.0];
    let [x4, x2y2, y4] = [1.8 * x2 * x2, x2 * y2, 1.8 * y2 * y2];
    let quadrupole = 3.0 * (p * x2 + q * y2) - (x2 + y2);
    let hexadecapole = 35.0 * (p * p * x4 + 6.0 * p * q * x2y2 + q * q * y4)
        - 30.0 * (p * (x4 + x2y2) + q * (x2y2 + y4))
        + 3.0 * (x4 + 2.0 * x2y2 + y4);
    let correction = (quadrupole / 2.0 + hexadecapole / 8.0 / square) / square;
    a * b / square.sqrt() * (1.0 + correction)
}

/// The kernel 1/r of the half space, with its integrals in closed form (Love 1929).
struct Reciprocal;

impl PlaneKernel for Reciprocal {
    /// 1/√(x² + y²).
    fn value(x: f64, y: f64) -> f64 {
        1.0 / distance(x, y)
    }

    /// ∫ dx'/r over the edge `a` around x.
    fn strip_along_x(x: f64, a: f64, y: f64) -> f64 {
        strip_integral(x, a, y)
    }

    /// ∫ dy'/r over the edge `b` around y.
    fn strip_along_y(x: f64, y: f64, b: f64) -> f64 {
        strip_integral(y, b, x)
    }

    /// Double antiderivative x asinh(y/|x|) + y asinh(x/|y|) of 1/r.
    fn corner(x: f64, y: f64) -> f64 {
        product_asinh(x, y) + product_asinh(y, x)
    }
}

/// Integral ∫ dx' / √(x'² + height²) over an interval of the length `edge` around `x` ≥ 0.
fn strip_integral(x: f64, edge: f64, height: f64) -> f64 {
    let (lower, upper) = (x - 0.5 * edge, x + 0.5 * edge);
    if lower > 0.0 {
        // This form of the logarithm also holds for a height of 0.
        return ((upper + distance(upper, height)) / (lower + distance(lower, height))).ln();
    }
    (upper / height.abs()).asinh() - (lower / height.abs()).asinh()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn multipoles_continue_the_integral() {
        for edges in [[1.0, 1.0], [1.0, 0.5], [1.0, 1e-6], [0.3, 1.0]] {
            for distance in [MULTIPOLE_DISTANCE, 3e3, 1e6] {
                for degrees in [0.0, 17.0, 45.0, 80.0, 90.0] {
                    let (sine, cosine) = f64::to_radians(degrees).sin_cos();
                    let offset = [distance * cosine, distance * sine];
                    let expected = integrate::<Reciprocal>(offset, edges);
                    let actual = multipoles(offset, edges);
                    let error = (actual / expected - 1.0).abs();
                    assert!(error < 4.0 * f64::EPSILON, "at {offset:?}, {edges:?}");
                }
            }
        }
    }
}
