//! Friction converges with the grid: to first order with the slope at the end of a step, and much faster with its mean
//! over the step, to which the pressure of the step belongs.

use crate::support::Scene;

/// Friction coefficients [mean slope, slope at the end] after two contact lengths.
fn friction(exponent: f64, elements: f64) -> [f64; 2] {
    let transient = Scene::unit(exponent).slide(elements, 2.0);
    let last = transient.last();
    [
        last.friction_coefficient,
        last.friction_coefficient_end_of_step,
    ]
}

#[test]
fn the_slope_at_the_end_of_a_step_is_of_first_order() {
    for exponent in [1.0, 1.5, 2.0, 4.0] {
        let [coarse, middle, fine] = [6.0, 12.0, 24.0].map(|elements| friction(exponent, elements));
        let order = ((middle[1] - coarse[1]) / (fine[1] - middle[1])).log2();
        assert!(
            (order - 1.0).abs() < 0.2,
            "p = {exponent}: order {order}: {coarse:?}, {middle:?}, {fine:?}"
        );
    }
}

#[test]
fn the_mean_slope_is_far_more_accurate_on_the_same_grid() {
    // A higher power is steeper at the front, where the pressure is, and wants a finer grid to begin with.
    for (exponent, elements, gain) in [
        (1.0, 6.0, 8.0),
        (1.5, 6.0, 8.0),
        (2.0, 6.0, 8.0),
        (4.0, 8.0, 3.0),
    ] {
        let [coarse, middle, fine] =
            [1.0, 2.0, 4.0].map(|refinement| friction(exponent, refinement * elements));
        // Both rules have the same limit; extrapolated from the slow one by its order.
        let limit = 2.0 * fine[1] - middle[1];
        let error = (fine[0] / limit - 1.0).abs();
        assert!(
            error < 5e-3,
            "p = {exponent}: {} instead of {limit}",
            fine[0]
        );
        let changes = [(coarse[0] - fine[0]).abs(), (coarse[1] - fine[1]).abs()];
        assert!(
            gain * changes[0] < changes[1],
            "p = {exponent}: changes by refinement {changes:?}"
        );
    }
}
