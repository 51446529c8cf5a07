//! The influence of a rectangle is Love's closed form, and that of a sliding one on a dashpot the integral of ln(ξ + r),
//! near and far, ahead, beside and behind, for any aspect ratio; the fast convolution is the sum over all pairs of
//! elements.

use std::f64::consts::PI;

use bem_halfspace::steady::wake_influence;
use bem_halfspace::{Convolution, Grid, influence};
use casebook::group;

use crate::support::{assert_close, assert_near, difference};

#[test]
fn influence_is_that_of_the_casebook() {
    for case in group("BEM-02") {
        let numbers = |names: [&str; 2]| names.map(|name| case.input(name));
        if case.has_input("i") {
            case.check_within("K", influence(numbers(["i", "j"]), [1.0, 1.0]), 1e-13);
        } else if case.has_input("hx") {
            let per_rectangle = influence(numbers(["x", "y"]), numbers(["hx", "hy"]));
            case.check_within("K", per_rectangle, 1e-13);
        } else {
            let own = influence([0.0, 0.0], [1.0, 1.0]);
            case.check("K00", own);
            case.check("u_self_per_f_over_Gh", own / (4.0 * PI));
        }
    }
}

/// Offset ξ, y, edges a, b, and the integral; mpmath 1.3.0 at 40 digits, the four-corner difference of
/// `x*y*log(x+r) - x*y + x**2*asinh(y/abs(x))/2 - y*r/2`, checked there against `mpmath.quad` at (2.25, 0.7) and
/// (-3.5, 0.3).
const REFERENCE: [([f64; 4], f64); 24] = [
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
    // Slender elements, next to them and over them.
    ([0.3e-12, 0.4, 1e-12, 1.0], -1.325_082_973_374_197_7e-12),
    ([-3.25e-12, 0.4, 1e-12, 1.0], -1.325_082_973_566_542_6e-12),
    ([6e-12, 1.3, 1e-12, 1.0], 2.365_308_378_800_476e-13),
    ([0.4, 0.3e-12, 1.0, 1e-12], -5.936_332_918_238_03e-12),
    ([-3.25, 6e-12, 1.0, 1e-12], -5.354_867_202_013_691e-11),
    ([0.3e-12, 0.4e-12, 1e-12, 1.0], -1.693_147_180_542_388_3e-12),
];

#[test]
fn the_wake_has_thirteen_digits() {
    for ([x, y, a, b], expected) in REFERENCE {
        for y in [y, -y] {
            let actual = wake_influence([x, y], [a, b]);
            assert_close([x, y, a, b], actual, expected, 1e-13);
        }
    }
}

/// The branches near, far and behind meet: a rectangle is the sum of its quarters at every distance and aspect ratio.
#[test]
fn a_rectangle_is_the_sum_of_its_quarters() {
    for [a, b] in [
        [1.0, 1.0],
        [1.0, 0.5],
        [1.0, 1e-4],
        [1e-4, 1.0],
        [3e-9, 5e-9],
    ] {
        let near = [(0.0, 0.0), (0.3, 0.1), (-0.4, 0.1), (-0.7, 0.0)].into_iter();
        let border = [(7.9, 0.3), (8.1, 0.0), (-8.1, 0.2), (0.2, 7.99)];
        let far = [(5.0, 6.0), (1e5, 3.0), (-1e5, 3.0)];
        for (x, y) in near.chain(border).chain(far) {
            for offset in [[x * a, y * a], [x * a, y * b]] {
                let halved = |kernel: fn([f64; 2], [f64; 2]) -> f64| -> f64 {
                    let quarters = [[-1.0, -1.0], [-1.0, 1.0], [1.0, -1.0], [1.0, 1.0]];
                    let parts = quarters.map(|[i, j]| {
                        let centre = [offset[0] + 0.25 * i * a, offset[1] + 0.25 * j * b];
                        kernel(centre, [0.5 * a, 0.5 * b])
                    });
                    parts.iter().sum()
                };
                let (what, edges) = ((offset, [a, b]), [a, b]);
                assert_close(what, influence(offset, edges), halved(influence), 2e-13);
                // The logarithm passes through zero: the scale is the area.
                let wake = wake_influence(offset, edges);
                assert_near(what, wake, halved(wake_influence), 1e-12 * a * b);
            }
        }
    }
}

/// A field without any symmetry.
fn pressure(n: usize) -> Vec<f64> {
    let value = |index: usize| (index as f64 * 1.7).cos() + 0.01 * index as f64;
    (0..n).map(value).collect()
}

fn sum_over_pairs(grid: &Grid, pressure: &[f64]) -> Vec<f64> {
    let columns = grid.shape()[1];
    let [dx, dy] = grid.spacing();
    let at = |to: usize| -> f64 {
        let term = |(from, value): (usize, &f64)| {
            let rows = (to / columns) as f64 - (from / columns) as f64;
            let cross = (to % columns) as f64 - (from % columns) as f64;
            influence([rows * dx, cross * dy], [dx, dy]) * value
        };
        pressure.iter().enumerate().map(term).sum()
    };
    (0..pressure.len()).map(at).collect()
}

#[test]
fn convolution_equals_the_sum_over_pairs() {
    for (shape, spacing) in [
        ([1, 1], [2.0, 3.0]),
        ([7, 12], [1.0, 1.0]),
        ([13, 5], [1e-6, 3e-4]),
        ([1, 9], [1.0, 0.2]),
    ] {
        let grid = Grid::new(shape, spacing).expect("a valid grid");
        let convolution = Convolution::new(&grid);
        let pressure = pressure(grid.n_elements());
        let mut actual = vec![0.0; grid.n_elements()];
        let (mut workspace, rows) = (convolution.workspace(), 0..shape[0]);
        let (pressed, moved) = ((&pressure[..], rows.clone()), (&mut actual[..], rows));
        convolution.apply(&mut workspace, pressed, moved);
        // Rounding of transforms of a few hundred values.
        let error = difference(&actual, &sum_over_pairs(&grid, &pressure));
        assert!(error < 1e-14, "{shape:?}: off by {error:e}");
    }
}

#[test]
fn rows_that_are_left_out_change_nothing() {
    let grid = Grid::new([12, 10], [1.0, 1.0]).expect("a valid grid");
    let convolution = Convolution::new(&grid);
    let mut loaded = pressure(120);
    loaded[..30].fill(0.0);
    loaded[70..].fill(0.0);
    let mut workspace = convolution.workspace();
    let (mut all, mut some) = (vec![0.0; 120], vec![f64::NAN; 120]);
    convolution.apply(&mut workspace, (&loaded, 0..12), (&mut all, 0..12));
    convolution.apply(&mut workspace, (&loaded, 3..7), (&mut some, 5..9));
    let wanted = 50..90;
    assert_eq!(all[wanted.clone()], some[wanted.clone()], "to the last bit");
    let others = [&some[..50], &some[90..]].concat();
    assert!(others.iter().all(|value| value.is_nan()), "left: {some:?}");
}

/// 2 b asinh(a/b) + 2 a asinh(b/a) in the middle of an element of edges a and b, a neighbour as the difference of longer
/// elements; far away 1/r + h²/(24 r³) times the area, with an error of the order (h/r)⁴.
#[test]
fn slender_and_far_elements_keep_their_digits() {
    for decade in -12..=12 {
        let aspect = 10_f64.powi(decade);
        let middle = |x: f64| 2.0 * (aspect * (x / aspect).asinh() + x * (aspect / x).asinh());
        let own = influence([0.0; 2], [1.0, aspect]);
        assert_close(aspect, own, middle(1.0), 1e-14);
        let neighbour = influence([1.0, 0.0], [1.0, aspect]);
        // The difference loses a digit or two where the elements are long.
        let expected = 0.5 * (middle(3.0) - middle(1.0));
        assert_close(aspect, neighbour, expected, 2e-13);
    }
    for decade in 4..=12 {
        let distance = 10_f64.powi(decade);
        let expected = (1.0 + 1.0 / (24.0 * distance * distance)) / distance;
        let far = influence([distance, 0.0], [1.0, 1.0]);
        assert_close(distance, far, expected, 1e-14);
    }
}
