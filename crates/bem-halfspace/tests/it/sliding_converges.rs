//! Friction converges with the grid: to first order with the slope at the end of a step, and much faster with its mean
//! over the step, to which the pressure of the step belongs.

use crate::support::{Scene, assert_close, assert_near};

#[test]
fn the_mean_slope_is_far_more_accurate_than_that_at_the_end_of_a_step() {
    // A higher power is steeper at the front, where the pressure is, and wants a finer grid to begin with.
    for (exponent, elements, gain) in [
        (1.0, 6.0, 8.0),
        (1.5, 6.0, 8.0),
        (2.0, 6.0, 8.0),
        (4.0, 8.0, 3.0),
    ] {
        let [coarse, middle, fine] = [1.0, 2.0, 4.0].map(|refinement| {
            let transient = Scene::unit(exponent).slide(refinement * elements, 2.0);
            transient.last().clone()
        });
        let at_end = [&coarse, &middle, &fine].map(|row| row.friction_coefficient_end_of_step);
        let order = ((at_end[1] - at_end[0]) / (at_end[2] - at_end[1])).log2();
        assert_near((exponent, "order"), order, 1.0, 0.2);
        // Both rules have the same limit; extrapolated from the slow one by its order.
        let limit = 2.0 * at_end[2] - at_end[1];
        assert_close(exponent, fine.friction_coefficient, limit, 5e-3);
        let change = (coarse.friction_coefficient - fine.friction_coefficient).abs();
        let change_at_end = (at_end[0] - at_end[2]).abs();
        assert!(
            gain * change < change_at_end,
            "p = {exponent}: changes by refinement {change}, {change_at_end} at the end"
        );
    }
}
