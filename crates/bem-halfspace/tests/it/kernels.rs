//! The influence of a rectangle is Love's closed form, and that of a sliding one on a dashpot the integral of ln(ξ + r),
//! near and far, ahead, beside and behind, for any aspect ratio; the fast convolution is the sum over all pairs of
//! elements.

use std::f64::consts::PI;

use bem_halfspace::steady::wake_influence;
use bem_halfspace::{Convolution, Grid, Rows, influence};
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

/// Offset ξ, y, edges a, b, and the integral.
const WAKE: &str = include_str!("../data/wake.txt");

#[test]
fn the_wake_has_thirteen_digits() {
    for row in WAKE.lines().filter(|line| !line.starts_with('#')) {
        let numbers = row.split(' ').map(|number| number.parse().expect(row));
        let numbers: Vec<f64> = numbers.collect();
        let [x, y, a, b, expected] = numbers[..] else {
            panic!("five numbers and not {row}")
        };
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
        convolution.apply(&mut convolution.workspace(), &pressure, &mut actual);
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
    convolution.apply(&mut workspace, &loaded, &mut all);
    let rows = Rows {
        loaded: 3..7,
        wanted: 5..9,
    };
    convolution.apply_in(&rows, &mut workspace, &loaded, &mut some);
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
