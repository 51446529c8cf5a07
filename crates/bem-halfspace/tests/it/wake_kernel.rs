//! The stationary kernel is the integral of ln(ξ + r) over a rectangle, from the element itself to 10⁶ elements away,
//! ahead, beside and behind, for any aspect ratio.

use bem_halfspace::steady::wake_influence;

/// Offset ξ, y, edges a, b, and the integral; mpmath 1.3.0 at 40 digits, the four-corner difference of
/// `x*y*log(x+r) - x*y + x**2*asinh(y/abs(x))/2 - y*r/2`, checked there against `mpmath.quad` at (2.25, 0.7) and
/// (-3.5, 0.3).
const REFERENCE: [([f64; 4], f64); 18] = [
    ([0.0, 0.0, 1.0, 1.0], -1.693_147_180_559_945_3),
    ([-0.5, 0.0, 1.0, 0.5], -2.292_775_814_136_655_6),
    ([0.5, 0.0, 1.0, 0.5], -0.093_518_546_983_234_99),
    ([-1.5, 0.0, 1.0, 0.5], -2.927_306_706_124_064_3),
    ([-1.5, 0.5, 1.0, 0.5], -1.293_891_405_897_199_5),
    ([7.5, 3.0, 1.0, 0.5], 1.372_657_809_196_099_5),
    ([9.0, 0.0, 1.0, 1.0], 2.890_114_695_300_743),
    ([-9.5, 0.0, 1.0, 1.0], -6.330_502_612_025_057),
    ([-30.5, 2.5, 1.0, 0.5], -1.141_636_195_595_865_7),
    ([100.5, 37.0, 1.0, 2.0], 10.671_179_590_106_17),
    ([-1000.5, 0.0, 1.0, 1.0], -10.987_696_674_891_11),
    ([-1000.5, 777.0, 1.0, 1.0], 5.584_544_826_683_467),
    ([1e6, 3.0, 1.0, 1.0], 14.508_657_738_526_449),
    ([-1e6, 3.0, 1.0, 1.0], -12.320_770_618_429_648),
    ([-0.5, 1000.0, 1.0, 1.0], 6.907_255_237_315_467),
    ([4.0, 0.001, 1.0, 1e-4], 2.076_825_092_205_634e-4),
    ([0.001, 4.0, 1e-4, 1.0], 1.383_929_210_185_032e-4),
    ([-5.0, 0.0, 1e-4, 1.0], -5.689_710_919_833_407e-4),
];

#[test]
fn the_kernel_has_thirteen_digits() {
    for ([x, y, a, b], expected) in REFERENCE {
        for side in [1.0, -1.0] {
            let actual = wake_influence([x, side * y], [a, b]);
            let error = (actual / expected - 1.0).abs();
            assert!(
                error < 1e-13,
                "({x}, {y}), edges {a}, {b}: {actual:e} instead of {expected:e}, off by {error:e}"
            );
        }
    }
}

/// The branches near, far and behind meet: a rectangle is the sum of its quarters.
#[test]
fn a_rectangle_is_the_sum_of_its_quarters() {
    for [a, b] in [[1.0, 1.0], [1.0, 0.5], [1.0, 1e-4], [1e-4, 1.0]] {
        for (x, y) in [
            (0.0, 0.0),
            (0.3, 0.1),
            (-0.3, 0.1),
            (-0.7, 0.0),
            (7.9, 0.3),
            (-8.1, 0.2),
            (0.2, 7.99),
            (-1e5, 3.0),
        ] {
            let offset = [x * a, y * b];
            let whole = wake_influence(offset, [a, b]);
            let quarters: f64 = [(-0.25, -0.25), (-0.25, 0.25), (0.25, -0.25), (0.25, 0.25)]
                .iter()
                .map(|(i, j)| {
                    wake_influence([offset[0] + i * a, offset[1] + j * b], [0.5 * a, 0.5 * b])
                })
                .sum();
            // The logarithm passes through zero: the scale is the area.
            let error = (whole - quarters).abs() / (a * b);
            assert!(
                error < 1e-12,
                "{offset:?}, edges {a}, {b}: {whole} and {quarters}"
            );
        }
    }
}

/// An independent way: the integrand itself, by double exponential quadrature whose step is halved until it settles.
#[test]
fn adaptive_quadrature_finds_the_same_kernel() {
    for [a, b] in [[1.0, 1.0], [1.0, 0.5], [0.25, 1.0], [1.0, 1e-2]] {
        for [x, y] in [
            [0.0, 0.0],
            [-0.5, 0.0],
            [0.5, 0.3],
            [-1.5, 0.5],
            [-3.25, 1.0],
            [2.75, -4.0],
            [-40.5, 7.0],
            [1e3, -1e2],
            [-1e5, 3.0],
            [-0.5, 1e3],
        ] {
            let offset = [x * a, y * b];
            let expected = settled(|step| rectangle_sum(offset, [a, b], step));
            let actual = wake_influence(offset, [a, b]);
            let error = (actual - expected).abs() / (a * b * logarithm(a, b).abs().max(1.0));
            assert!(
                error < 1e-11,
                "{offset:?}, edges {a}, {b}: {actual:e} instead of {expected:e}"
            );
        }
    }
}

/// The value at which halving the step changes nothing any more.
fn settled(value: impl Fn(f64) -> f64) -> f64 {
    let (mut step, mut last) = (0.25, f64::INFINITY);
    loop {
        let next = value(step);
        if (next - last).abs() <= 1e-13 * next.abs() || step < 0.02 {
            return next;
        }
        (step, last) = (0.5 * step, next);
    }
}

/// ln(ξ + r) over the rectangle that the load covers as the field point sees it, in parts that end where ξ or y vanish.
fn rectangle_sum([x, y]: [f64; 2], [a, b]: [f64; 2], step: f64) -> f64 {
    let along_x = parts([x - 0.5 * a, x + 0.5 * a]);
    let along_y = parts([y - 0.5 * b, y + 0.5 * b]);
    let line = |y: f64| {
        along_x
            .iter()
            .map(|ends| line_sum(*ends, step, |x| logarithm(x, y)))
            .sum()
    };
    along_y.iter().map(|ends| line_sum(*ends, step, line)).sum()
}

fn parts([first, last]: [f64; 2]) -> Vec<[f64; 2]> {
    if first < 0.0 && last > 0.0 {
        vec![[first, 0.0], [0.0, last]]
    } else {
        vec![[first, last]]
    }
}

/// ∫ f over an interval (Takahasi & Mori 1974), with nodes measured from the nearer end.
fn line_sum([first, last]: [f64; 2], step: f64, f: impl Fn(f64) -> f64) -> f64 {
    let length = last - first;
    let mut sum = 0.0;
    let mut t = 0.0_f64;
    while t < 4.0 {
        let fraction = 1.0 / (1.0 + (std::f64::consts::PI * t.sinh()).exp());
        let weight = fraction * (1.0 - fraction) * std::f64::consts::PI * t.cosh() * step * length;
        sum += weight * f(first + fraction * length);
        if t > 0.0 {
            sum += weight * f(last - fraction * length);
        }
        t += step;
    }
    sum
}

fn logarithm(x: f64, y: f64) -> f64 {
    let r = x.hypot(y);
    if x >= 0.0 {
        (x + r).ln()
    } else {
        2.0 * y.abs().ln() - (r - x).ln()
    }
}
