//! How the stationary state is approached, and how friction converges with the grid.

use casebook::group;

use crate::support::{Scene, assert_close, assert_near};

/// The surface ahead sinks like ln t, so the depth grows by D/π per unit of ln(distance), for ever.
#[test]
fn depth_drifts_like_the_logarithm_of_the_distance() {
    let cases = group("BEM-07");
    let case = cases.iter().find(|case| case.id().ends_with("log drift"));
    let scene = Scene::unit(2.0);
    let transient = scene.slide(4.0, 96.0);
    let n = transient.rows.len();
    let depth_scale = 0.5 / (4.0 * scene.material.viscosity() * scene.load.velocity());
    let per_logarithm = |count: usize| {
        let [late, early] = [count, count / 2].map(|count| &transient.rows[count - 1]);
        let deepened = late.indentation_depth - early.indentation_depth;
        deepened / (late.sliding_distance / early.sliding_distance).ln() / depth_scale
    };
    // The next term of the expansion falls like 1/distance; what is left after its elimination is of the second order
    // in (contact length)/(distance) = 1/48, with a factor of order one.
    let drift = 2.0 * per_logarithm(n) - per_logarithm(n / 2);
    case.expect("the log drift")
        .check_within("dd_dln_over_D", drift, 3e-3);
}

/// In contact w = η v ∂h/∂ξ > 0: only the rising, front half of the body touches.
#[test]
fn only_the_front_half_stays_in_contact() {
    for exponent in [1.0, 2.0, 4.0] {
        let scene = Scene::unit(exponent);
        let [rear, front] = scene.slide(8.0, 24.0).last().contact_x;
        let ends = [rear, front].map(|end| end / scene.contact_length());
        assert!(
            ends[0] >= -0.51 / 8.0 && ends[1] > 0.9,
            "p = {exponent}: ends {ends:?}"
        );
    }
}

#[test]
fn extrapolation_in_the_distance_agrees_with_a_longer_run() {
    for (exponent, elements) in [(1.0, 4.0), (1.0, 5.0), (1.0, 6.0), (2.0, 4.0), (2.0, 5.0)] {
        let what = (exponent, elements);
        let marches = [24.0, 192.0].map(|lengths| Scene::unit(exponent).slide(elements, lengths));
        let [short, long] = [0, 1].map(|index| {
            let state = marches[index].stationary(0.02);
            state.expect("a stationary state")
        });
        let limit = long.friction_coefficient;
        let allowed = short.distance_error + long.distance_error;
        assert_near(what, short.friction_coefficient, limit, allowed);
        assert!(
            short.distance_error < 2e-2 * short.friction_coefficient,
            "{what:?}: {short:?}"
        );
        // The drift is, to leading order, the distance that is left to the limit.
        let left = 1.0 - marches[0].last().friction_coefficient / limit;
        assert_near((what, "drift"), left / short.drift, 1.0, 0.35);
    }
}

/// To first order with the slope at the end of a step, and much faster with its mean over the step, to which the pressure
/// of the step belongs.
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
