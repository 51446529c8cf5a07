//! The potential of a uniformly loaded rectangle.
//!
//! ```text
//! K(x, y) = ∬ dA' / |r − r'|   over the rectangle around the origin        (Love 1929)
//! ```

use crate::rectangle::{PlaneKernel, integrate, product_asinh};

/// Integral of 1/r over a rectangle, \[m].
///
/// `offset` is the position of the field point relative to the centre of the rectangle and `edges` its edges, both
/// along x and y in \[m]. The surface of an elastic half space under the uniform pressure P moves by `P K / (4 π G)`,
/// the surface of a viscous one at the rate `P K / (4 π η)`.
#[must_use]
pub fn influence(offset: [f64; 2], edges: [f64; 2]) -> f64 {
    // Lengths in units of the longer edge neither overflow nor underflow when they are squared.
    let unit = edges[0].max(edges[1]);
    let [offset, edges] = [offset, edges].map(|lengths| lengths.map(|length| length.abs() / unit));
    unit * integrate::<Reciprocal>(offset, edges)
}

/// 1/r.
struct Reciprocal;

impl PlaneKernel for Reciprocal {
    fn value(x: f64, y: f64) -> f64 {
        1.0 / (x * x + y * y).sqrt()
    }

    fn strip_along_x(x: f64, a: f64, y: f64) -> f64 {
        strip(x, a, y)
    }

    fn strip_along_y(x: f64, y: f64, b: f64) -> f64 {
        strip(y, b, x)
    }

    fn corner(x: f64, y: f64) -> f64 {
        product_asinh(x, y) + product_asinh(y, x)
    }
}

/// ∫ dx' / √(x'² + height²) over the edge around `x` ≥ 0.
fn strip(x: f64, edge: f64, height: f64) -> f64 {
    let (lower, upper) = (x - 0.5 * edge, x + 0.5 * edge);
    if lower > 0.0 {
        // Also right where the height vanishes.
        return ((upper + upper.hypot(height)) / (lower + lower.hypot(height))).ln();
    }
    (upper / height.abs()).asinh() - (lower / height.abs()).asinh()
}
