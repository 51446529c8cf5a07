//! The fast convolution is the sum over all pairs of elements, and its ranges of rows change nothing.

use bem_halfspace::{Convolution, Grid, influence};

use crate::support::difference;

/// A field without any symmetry.
fn pressure(n: usize) -> Vec<f64> {
    let value = |index: usize| (index as f64 * 1.7).cos() + 0.01 * index as f64;
    (0..n).map(value).collect()
}

fn sum_over_pairs(grid: &Grid, pressure: &[f64]) -> Vec<f64> {
    let columns = grid.shape()[1];
    let [dx, dy] = grid.spacing();
    let pair = |to: usize, from: usize| {
        let rows = (to / columns) as f64 - (from / columns) as f64;
        let cross = (to % columns) as f64 - (from % columns) as f64;
        influence([rows * dx, cross * dy], [dx, dy])
    };
    let at = |to: usize| -> f64 {
        let terms = pressure.iter().enumerate();
        terms.map(|(from, value)| pair(to, from) * value).sum()
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
        convolution.apply(
            &mut convolution.workspace(),
            (&pressure, 0..shape[0]),
            (&mut actual, 0..shape[0]),
        );
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
    let mut others = (0..120).filter(|index| !wanted.contains(index));
    assert!(
        others.all(|index| some[index].is_nan()),
        "other rows are left as they are"
    );
}
