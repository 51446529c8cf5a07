//! Integrals of a kernel over a rectangle, accurate near and far.
//!
//! The closed form, a difference of the double antiderivative between the four corners, is exact near the rectangle; far
//! away it loses (r/Δ)² units in the last place. Along a direction whose edge is short compared with the distance of
//! the singularities, a Gauss rule of at most eight points integrates to rounding without any cancellation. The two are chosen
//! per direction, so that slender rectangles are as accurate as squares.

/// From this many edges on the Gauss rule errs by less than (1/16)^16 of the integrand.
pub(crate) const FAR: f64 = 8.0;

/// Gauss–Legendre rules on [−1, 1] (NIST DLMF 3.5) as positive nodes and weights, each with the distance in edges from
/// which it errs by less than rounding: with n points the error is below (1/2·distance)^(2n) of the integrand.
const RULES: [(f64, &[(f64, f64)]); 3] = [
    (8192.0, &[(0.577_350_269_189_625_8, 1.0)]),
    (
        64.0,
        &[
            (0.339_981_043_584_856_3, 0.652_145_154_862_546_1),
            (0.861_136_311_594_052_6, 0.347_854_845_137_453_85),
        ],
    ),
    (
        FAR,
        &[
            (0.183_434_642_495_649_8, 0.362_683_783_378_362),
            (0.525_532_409_916_329, 0.313_706_645_877_887_27),
            (0.796_666_477_413_626_7, 0.222_381_034_453_374_48),
            (0.960_289_856_497_536_3, 0.101_228_536_290_376_26),
        ],
    ),
];

/// The rule of six points.
const SIX: &[(f64, f64)] = &[
    (0.238_619_186_083_196_9, 0.467_913_934_572_691),
    (0.661_209_386_466_264_5, 0.360_761_573_048_138_6),
    (0.932_469_514_203_152, 0.171_324_492_379_170_35),
];

/// A kernel on the plane, singular on the axis y = 0 only, and its antiderivatives.
pub(crate) trait PlaneKernel {
    /// k(x, y).
    fn value(x: f64, y: f64) -> f64;

    /// ∫ k dx' over the edge `a` around x.
    fn strip_along_x(x: f64, a: f64, y: f64) -> f64;

    /// ∫ k dy' over the edge `b` around y.
    fn strip_along_y(x: f64, y: f64, b: f64) -> f64;

    /// The double antiderivative, up to functions of x or y alone.
    fn corner(x: f64, y: f64) -> f64;
}

/// ∬ k(x − x', y − y') dA' over the rectangle with edges [a, b] around the origin, for y ≥ 0.
pub(crate) fn integrate<K: PlaneKernel>([x, y]: [f64; 2], [a, b]: [f64; 2]) -> f64 {
    // How far the singularities of the integrand lie from the edge along x, and along y.
    let clearance = [
        x.hypot((y - 0.5 * b).max(0.0)),
        y.hypot((x - 0.5 * a).max(0.0)),
    ];
    match (rule(clearance[0], a), rule(clearance[1], b)) {
        (Some(along_x), Some(along_y)) => gauss((along_x, x, a), |x| {
            gauss((along_y, y, b), |y| K::value(x, y))
        }),
        (Some(along_x), None) => gauss((along_x, x, a), |x| K::strip_along_y(x, y, b)),
        (None, Some(along_y)) => gauss((along_y, y, b), |y| K::strip_along_x(x, a, y)),
        (None, None) => {
            let [left, right, lower, upper] = [x - 0.5 * a, x + 0.5 * a, y - 0.5 * b, y + 0.5 * b];
            K::corner(right, upper) - K::corner(left, upper) - K::corner(right, lower)
                + K::corner(left, lower)
        }
    }
}

/// The same of a function that is analytic up to `distance` from every point of the plane, along either direction: by
/// rules of six points on panels that are at most 0.4 times as long, or of four to two where that gives twelve digits.
pub(crate) fn integrate_smooth(
    distance: f64,
    ([x, y], [a, b]): ([f64; 2], [f64; 2]),
    function: impl Fn(f64, f64) -> f64,
) -> f64 {
    along(distance, [x - 0.5 * a, x + 0.5 * a], &|x| {
        along(distance, [y - 0.5 * b, y + 0.5 * b], &|y| function(x, y))
    })
}

fn along(distance: f64, [start, end]: [f64; 2], function: &impl Fn(f64) -> f64) -> f64 {
    let length = end - start;
    let nearest = if start < 0.0 && end > 0.0 {
        0.0
    } else {
        start.abs().min(end.abs())
    };
    // The singularities lie around 0, and are the farther away the farther that is.
    let ratio = (nearest * nearest + distance * distance).sqrt() / length;
    let middle = start + 0.5 * length;
    if ratio < 2.5 {
        return along(distance, [start, middle], function)
            + along(distance, [middle, end], function);
    }
    let rule = match ratio {
        250.0.. => RULES[0].1,
        25.0.. => {
            // Of three points, the one in the middle is its own image.
            let side = 0.6_f64.sqrt() * 0.5 * length;
            let sides = function(middle - side) + function(middle + side);
            return length / 18.0 * (5.0 * sides + 8.0 * function(middle));
        }
        8.0.. => RULES[1].1,
        _ => SIX,
    };
    gauss((rule, middle, length), function)
}

/// The shortest rule for an edge whose singularities are that far; none near.
fn rule(clearance: f64, edge: f64) -> Option<&'static [(f64, f64)]> {
    let suits = |(distance, _): &&(f64, &'static [(f64, f64)])| clearance >= distance * edge;
    RULES.iter().find(suits).map(|(_, rule)| *rule)
}

/// Integral of a function by a rule over the edge around `centre`.
fn gauss((rule, centre, edge): (&[(f64, f64)], f64, f64), function: impl Fn(f64) -> f64) -> f64 {
    let half = 0.5 * edge;
    let pair = |&(node, weight): &(f64, f64)| {
        weight * (function(centre - half * node) + function(centre + half * node))
    };
    half * rule.iter().map(pair).sum::<f64>()
}

/// x asinh(y / |x|), continued by 0 to x = 0.
pub(crate) fn product_asinh(x: f64, y: f64) -> f64 {
    if x == 0.0 {
        0.0
    } else {
        x * (y / x.abs()).asinh()
    }
}
