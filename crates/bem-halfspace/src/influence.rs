//! The potential of a uniformly loaded rectangle.
//!
//! ```text
//! K(x, y) = ∬ dA' / |r − r'|   over the rectangle around the origin        (Love 1929)
//! ```
//!
//! Near the rectangle the closed form is exact; it is a second difference and loses (r/Δ)² units in the last place.
//! Along a direction whose edge is short compared with the distance of the point, a Gauss rule of eight points
//! integrates to rounding without any cancellation. The two are chosen per direction, so that slender rectangles are
//! as accurate as squares.

/// From this many edges on the Gauss rule errs by less than (1/16)^16 of the integrand.
pub(crate) const FAR: f64 = 8.0;

/// Positive nodes and weights of the Gauss–Legendre rule with eight points on [−1, 1] (NIST DLMF 3.5).
const GAUSS: [(f64, f64); 4] = [
    (0.183_434_642_495_649_8, 0.362_683_783_378_362),
    (0.525_532_409_916_329, 0.313_706_645_877_887_27),
    (0.796_666_477_413_626_7, 0.222_381_034_453_374_48),
    (0.960_289_856_497_536_3, 0.101_228_536_290_376_26),
];

/// Integral of 1/r over a rectangle, \[m].
///
/// `offset` is the position of the field point relative to the centre of the rectangle and `edges` its edges, both
/// [x, y] in \[m]. The surface of an elastic half space under the uniform pressure P moves by `P K / (4 π G)`, the
/// surface of a viscous one at the rate `P K / (4 π η)`.
#[must_use]
pub fn influence(offset: [f64; 2], edges: [f64; 2]) -> f64 {
    let [x, y] = [offset[0].abs(), offset[1].abs()];
    let [a, b] = edges;
    // How far the singularities of the integrand lie from the edge along x, and along y.
    let clearance = [
        x.hypot((y - 0.5 * b).max(0.0)),
        y.hypot((x - 0.5 * a).max(0.0)),
    ];
    match (clearance[0] >= FAR * a, clearance[1] >= FAR * b) {
        (true, true) => gauss(x, a, |x| gauss(y, b, |y| 1.0 / x.hypot(y))),
        (true, false) => gauss(x, a, |x| strip(y, b, x)),
        (false, true) => gauss(y, b, |y| strip(x, a, y)),
        (false, false) => {
            corner(x + 0.5 * a, y + 0.5 * b)
                - corner(x - 0.5 * a, y + 0.5 * b)
                - corner(x + 0.5 * a, y - 0.5 * b)
                + corner(x - 0.5 * a, y - 0.5 * b)
        }
    }
}

/// Double antiderivative of 1/r.
fn corner(x: f64, y: f64) -> f64 {
    product_asinh(x, y) + product_asinh(y, x)
}

/// x asinh(y / |x|), continued by 0 to x = 0.
pub(crate) fn product_asinh(x: f64, y: f64) -> f64 {
    if x == 0.0 {
        0.0
    } else {
        x * (y / x.abs()).asinh()
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

/// Integral of a function over the edge around `centre`.
pub(crate) fn gauss(centre: f64, edge: f64, function: impl Fn(f64) -> f64) -> f64 {
    let half = 0.5 * edge;
    let pair = |&(node, weight): &(f64, f64)| {
        weight * (function(centre - half * node) + function(centre + half * node))
    };
    half * GAUSS.iter().map(pair).sum::<f64>()
}
