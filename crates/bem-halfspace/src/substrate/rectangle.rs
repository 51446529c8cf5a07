//! Integrals of a kernel over a rectangle, accurate to rounding near and far.
//!
//! The closed form, a second difference of the double antiderivative between the four corners, is exact near the rectangle.
//! Far away it loses (r/Δ)² units in the last place. Along a direction whose edge is short compared with the distance to the
//! singularities, a Gauss rule of at most eight points has no cancellation. The choice is made per direction, so that slender
//! rectangles are as accurate as squares.
//!
//! Theory: docs/theory/transient-half-space.md, "Elements and steps".

/// Distance to the singularities, in edges, from which on the Gauss rule of eight points is used. Derived: its error is below
/// (1/16)^16, or 5e-20, of the integrand.
pub(crate) const EIGHT_POINT_DISTANCE: f64 = 8.0;

/// Gauss–Legendre rule on [−1, 1] (NIST DLMF 3.5): the weight of the middle, and positive nodes with their weights.
type Rule = (f64, &'static [(f64, f64)]);

/// Gauss–Legendre rule of two points on [−1, 1] (NIST DLMF 3.5), in the form of [`Rule`].
const TWO_POINTS: Rule = (0.0, &[(0.577_350_269_189_625_8, 1.0)]);
/// Gauss–Legendre rule of three points on [−1, 1] (NIST DLMF 3.5), in the form of [`Rule`].
const THREE_POINTS: Rule = (8.0 / 9.0, &[(0.774_596_669_241_483_4, 5.0 / 9.0)]);
/// Gauss–Legendre rule of four points on [−1, 1] (NIST DLMF 3.5), in the form of [`Rule`].
const FOUR_POINTS: Rule = (
    0.0,
    &[
        (0.339_981_043_584_856_3, 0.652_145_154_862_546_1),
        (0.861_136_311_594_052_6, 0.347_854_845_137_453_85),
    ],
);
/// Gauss–Legendre rule of five points on [−1, 1] (NIST DLMF 3.5), in the form of [`Rule`].
const FIVE_POINTS: Rule = (
    0.568_888_888_888_888_9,
    &[
        (0.538_469_310_105_683_1, 0.478_628_670_499_366_47),
        (0.906_179_845_938_664, 0.236_926_885_056_189_1),
    ],
);
/// Gauss–Legendre rule of six points on [−1, 1] (NIST DLMF 3.5), in the form of [`Rule`].
const SIX_POINTS: Rule = (
    0.0,
    &[
        (0.238_619_186_083_196_9, 0.467_913_934_572_691),
        (0.661_209_386_466_264_5, 0.360_761_573_048_138_6),
        (0.932_469_514_203_152, 0.171_324_492_379_170_35),
    ],
);
/// Gauss–Legendre rule of eight points on [−1, 1] (NIST DLMF 3.5), in the form of [`Rule`].
const EIGHT_POINTS: Rule = (
    0.0,
    &[
        (0.183_434_642_495_649_8, 0.362_683_783_378_362),
        (0.525_532_409_916_329, 0.313_706_645_877_887_27),
        (0.796_666_477_413_626_7, 0.222_381_034_453_374_48),
        (0.960_289_856_497_536_3, 0.101_228_536_290_376_26),
    ],
);

/// Rules for kernels that are singular on the plane, each with the smallest distance in edges at which its error is below rounding:
/// with n points the error is below (1/(2 distance))^(2n) of the integrand.
const SINGULAR_KERNEL_RULES: [(f64, Rule); 6] = [
    (8192.0, TWO_POINTS),
    (320.0, THREE_POINTS),
    (64.0, FOUR_POINTS),
    (24.0, FIVE_POINTS),
    (12.0, SIX_POINTS),
    (EIGHT_POINT_DISTANCE, EIGHT_POINTS),
];

/// Rules for the smooth correction of a kernel, each with the smallest distance in edges. Their error is 1e-12 of the integral of
/// the singular kernel over the rectangle itself, which is larger than the correction.
const SMOOTH_KERNEL_RULES: [(f64, Rule); 4] = [
    (250.0, TWO_POINTS),
    (25.0, THREE_POINTS),
    (8.0, FOUR_POINTS),
    (2.5, SIX_POINTS),
];

/// A kernel k on the plane that is singular on the axis y = 0 only, with its antiderivatives.
pub(crate) trait PlaneKernel {
    /// The kernel k at (x, y).
    fn value(x: f64, y: f64) -> f64;

    /// Integral ∫ k(x', y) dx' over an interval of the length `a` around x.
    fn strip_along_x(x: f64, a: f64, y: f64) -> f64;

    /// Integral ∫ k(x, y') dy' over an interval of the length `b` around y.
    fn strip_along_y(x: f64, y: f64, b: f64) -> f64;

    /// Double antiderivative Φ with ∂²Φ/∂x∂y = k, up to functions of x or y alone.
    fn corner(x: f64, y: f64) -> f64;
}

/// Integral ∬ k(x − x', y − y') dA' over a rectangle around the origin, at the offset [x, y] with y ≥ 0; lengths in any one unit.
pub(crate) fn integrate<K: PlaneKernel>(offset: [f64; 2], edges: [f64; 2]) -> f64 {
    let ([x, y], [a, b]) = (offset, edges);
    // Find the distances from the rectangle to the singularities of the integrands along x and along y.
    let distances = [
        distance(x, (y - 0.5 * b).max(0.0)),
        distance(y, (x - 0.5 * a).max(0.0)),
    ];
    match (
        fewest_points(&SINGULAR_KERNEL_RULES, distances[0], a),
        fewest_points(&SINGULAR_KERNEL_RULES, distances[1], b),
    ) {
        // If the singularities are far in at least one direction, integrate along it by a Gauss rule.
        (Some(along_x), Some(along_y)) => {
            gauss(along_x, x, a, |x| gauss(along_y, y, b, |y| K::value(x, y)))
        }
        (Some(along_x), None) => gauss(along_x, x, a, |x| K::strip_along_y(x, y, b)),
        (None, Some(along_y)) => gauss(along_y, y, b, |y| K::strip_along_x(x, a, y)),
        // If the singularities are near in both directions, take the closed form, a second difference between the corners.
        (None, None) => {
            let [left, right, lower, upper] = [x - 0.5 * a, x + 0.5 * a, y - 0.5 * b, y + 0.5 * b];
            K::corner(right, upper) - K::corner(left, upper) - K::corner(right, lower)
                + K::corner(left, lower)
        }
    }
}

/// Integral ∬ f(x', y') dA' over a rectangle with its `centre` and `edges`, for a `function` f of the distance r from the origin
/// alone that is singular at r = ±i `singular` only; lengths in any one unit. Rectangles that are too large for all rules are halved.
pub(crate) fn integrate_smooth(
    singular: f64,
    centre: [f64; 2],
    edges: [f64; 2],
    function: &impl Fn(f64, f64) -> f64,
) -> f64 {
    let ([x, y], [a, b]) = (centre, edges);
    // Find the distance from the rectangle to the singularities at r = ±i `singular`.
    let [beside, above] = [x.abs() - 0.5 * a, y.abs() - 0.5 * b].map(|gap| gap.max(0.0));
    let to_singularity = (beside * beside + above * above + singular * singular).sqrt();
    let half = |centre, edges| integrate_smooth(singular, centre, edges, function);
    match (
        fewest_points(&SMOOTH_KERNEL_RULES, to_singularity, a),
        fewest_points(&SMOOTH_KERNEL_RULES, to_singularity, b),
    ) {
        (Some(along_x), Some(along_y)) => {
            gauss(along_x, x, a, |x| gauss(along_y, y, b, |y| function(x, y)))
        }
        // A rectangle that is too long for all rules is halved along x, and then along y.
        (None, _) => {
            let halves = [x - 0.25 * a, x + 0.25 * a];
            halves.into_iter().map(|x| half([x, y], [0.5 * a, b])).sum()
        }
        (_, None) => {
            let halves = [y - 0.25 * b, y + 0.25 * b];
            halves.into_iter().map(|y| half([x, y], [a, 0.5 * b])).sum()
        }
    }
}

/// The rule of fewest points that is accurate over an `edge` at a `distance` from the singularities, both in one unit; `None` if
/// they are too near for all rules.
fn fewest_points(rules: &[(f64, Rule)], distance: f64, edge: f64) -> Option<Rule> {
    let suits = |(min_distance, _): &&(f64, Rule)| distance >= min_distance * edge;
    rules.iter().find(suits).map(|(_, rule)| *rule)
}

/// Integral of a function by a Gauss rule over the interval of the length `edge` around `centre`.
fn gauss((middle, nodes): Rule, centre: f64, edge: f64, function: impl Fn(f64) -> f64) -> f64 {
    let half = 0.5 * edge;
    let pair = |&(node, weight): &(f64, f64)| {
        weight * (function(centre - half * node) + function(centre + half * node))
    };
    let pairs = nodes.iter().map(pair).sum::<f64>();
    if middle > 0.0 {
        half * (pairs + middle * function(centre))
    } else {
        half * pairs
    }
}

/// Distance √(x² + y²) of lengths in edges of an element, whose squares neither overflow nor underflow.
pub(crate) fn distance(x: f64, y: f64) -> f64 {
    (x * x + y * y).sqrt()
}

/// Product x asinh(y / |x|), with the limit 0 at x = 0.
pub(crate) fn product_asinh(x: f64, y: f64) -> f64 {
    if x == 0.0 {
        0.0
    } else {
        x * (y / x.abs()).asinh()
    }
}
