//! The fast convolution is the sum over all pairs of elements, and its ranges of rows change nothing.

use bem_halfspace::{Convolution, Grid, influence};

/// A field without any symmetry.
fn pressure(n: usize) -> Vec<f64> {
    (0..n)
        .map(|index| (index as f64 * 1.7).cos() + 0.01 * index as f64)
        .collect()
}

fn sum_over_pairs(grid: &Grid, pressure: &[f64]) -> Vec<f64> {
    let columns = grid.shape()[1];
    let [dx, dy] = grid.spacing();
    let pair = |to: usize, from: usize| {
        let rows = (to / columns) as f64 - (from / columns) as f64;
        let cross = (to % columns) as f64 - (from % columns) as f64;
        influence([rows * dx, cross * dy], [dx, dy])
    };
    (0..pressure.len())
        .map(|to| {
            pressure
                .iter()
                .enumerate()
                .map(|(from, value)| pair(to, from) * value)
                .sum()
        })
        .collect()
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
        let expected = sum_over_pairs(&grid, &pressure);
        let mut actual = vec![0.0; grid.n_elements()];
        convolution.apply(
            &mut convolution.workspace(),
            (&pressure, 0..shape[0]),
            (&mut actual, 0..shape[0]),
        );
        let scale = expected
            .iter()
            .fold(0.0, |largest: f64, value| largest.max(value.abs()));
        for (index, (actual, expected)) in actual.iter().zip(&expected).enumerate() {
            let error = (actual - expected).abs() / scale;
            // Rounding of transforms of a few hundred values.
            assert!(
                error < 1e-14,
                "{shape:?} element {index}: {actual} instead of {expected}"
            );
        }
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
    assert_eq!(
        all[50..90],
        some[50..90],
        "the wanted rows are the same to the last bit"
    );
    assert!(
        some[..50]
            .iter()
            .chain(&some[90..])
            .all(|value| value.is_nan()),
        "other rows are left alone"
    );
}
