//! Influence function of a stationary load on a viscous half space, ahead of it and in its wake.
//!
//! In the frame of the indenter, ξ = x − v t, the viscous half space under a stationary pressure satisfies
//! `∂u/∂ξ = −w/(ηv)` with the load potential `w = (1/4π) ∬ P/r dA`. A point load therefore moves the surface by
//!
//! ```text
//! u(ξ, y) = −F/(4πηv) ln(ξ + √(ξ² + y²)) + const
//! ```
//!
//! and a uniformly loaded rectangle by the integral of the logarithm over it, which has the closed form
//!
//! ```text
//! ∂²Φ/∂ξ∂y = ln(ξ + r),   Φ = ξ y ln(ξ + r) − ξ y + ½ ξ² asinh(y/|ξ|) − ½ y r
//! ```
//!
//! Theory: docs/theory/stationary-half-space.md, "The kernel of an element".

use crate::substrate::rectangle::{
    EIGHT_POINT_DISTANCE, PlaneKernel, distance, integrate, product_asinh,
};

/// Integral of ln(ξ + r) over a rectangle with `edges` [a, b]; `offset` [ξ, y] is the vector from its centre to the field point.
///
/// Lengths are ratios to any unit. Another unit adds a constant times the area, which belongs to the undetermined constant of u.
pub fn wake_influence(offset: [f64; 2], edges: [f64; 2]) -> f64 {
    let [x, y] = [offset[0], offset[1].abs()];
    let [a, b] = edges;
    if x < -0.5 * a && y < EIGHT_POINT_DISTANCE * b {
        // In the rut, at s = −x behind the load, the kernel is ln(r − s) = 2 ln|y| − ln(s + r). The first term is singular at y =
        // 0, and is integrated in closed form.
        let rut = 2.0 * a * (logarithm_integral(y + 0.5 * b) - logarithm_integral(y - 0.5 * b));
        return rut - wake_influence([-x, y], edges);
    }
    integrate::<Logarithm>([x, y], edges)
}

/// The kernel ln(x + r) of a stationary load, with its integrals in closed form.
struct Logarithm;

impl PlaneKernel for Logarithm {
    /// ln(x + r).
    fn value(x: f64, y: f64) -> f64 {
        logarithm(x, y)
    }

    /// ∫ ln(x' + r) dx' over the edge `a` around x.
    fn strip_along_x(x: f64, a: f64, y: f64) -> f64 {
        antiderivative_along_x(x + 0.5 * a, y) - antiderivative_along_x(x - 0.5 * a, y)
    }

    /// ∫ ln(x + r) dy' over the edge `b` around y.
    fn strip_along_y(x: f64, y: f64, b: f64) -> f64 {
        antiderivative_along_y(x, y + 0.5 * b) - antiderivative_along_y(x, y - 0.5 * b)
    }

    /// Double antiderivative Φ (head of this file), up to functions of x or y alone.
    fn corner(x: f64, y: f64) -> f64 {
        let r = distance(x, y);
        // ½ y (|y| − r): with y |y|, which drops out of differences along x, nothing cancels between near corners.
        let bend = if x == 0.0 { 0.0 } else { x / (y.abs() + r) };
        x * (product_logarithm(x, y) - y + 0.5 * (product_asinh(x, y) - y * bend))
    }
}

/// The kernel ln(x + r), without cancellation behind the load.
fn logarithm(x: f64, y: f64) -> f64 {
    let r = distance(x, y);
    if x >= 0.0 {
        (x + r).ln()
    } else {
        2.0 * y.abs().ln() - (r - x).ln()
    }
}

/// Antiderivative y ln|y| − y of ln|y|.
fn logarithm_integral(y: f64) -> f64 {
    if y == 0.0 { 0.0 } else { y * y.abs().ln() - y }
}

/// Antiderivative of ln(x + r) by x.
fn antiderivative_along_x(x: f64, y: f64) -> f64 {
    x * logarithm(x, y) - distance(x, y)
}

/// Antiderivative of ln(x + r) by y.
fn antiderivative_along_y(x: f64, y: f64) -> f64 {
    product_logarithm(x, y) - y + product_asinh(x, y)
}

/// Product y ln(x + r), with the limit 0 at y = 0.
fn product_logarithm(x: f64, y: f64) -> f64 {
    if y == 0.0 { 0.0 } else { y * logarithm(x, y) }
}
