//! How the stationary state is approached, and when it counts as reached.

use bem_halfspace::BemError;
use casebook::group;

use crate::support::Scene;

/// The surface ahead sinks like ln t, so the depth grows by D/π per unit of ln(distance), for ever.
#[test]
fn depth_drifts_like_the_logarithm_of_the_distance() {
    let case = group("BEM-07")
        .into_iter()
        .find(|case| case.id().ends_with("log drift"))
        .expect("the log drift");
    let scene = Scene::unit(2.0);
    let transient = scene.slide(4.0, 96.0);
    let n = transient.rows.len();
    let depth_scale = scene.load.require_normal_force().expect("a force")
        / (4.0 * scene.material.viscosity() * scene.load.velocity());
    let per_logarithm = |count: usize| {
        let [late, early] = [count, count / 2].map(|count| &transient.rows[count - 1]);
        let deepened = late.indentation_depth - early.indentation_depth;
        deepened / (late.sliding_distance / early.sliding_distance).ln() / depth_scale
    };
    // The next term of the expansion falls like 1/distance; what is left after its elimination is of the second order
    // in (contact length)/(distance) = 1/48, with a factor of order one.
    case.check_within(
        "dd_dln_over_D",
        2.0 * per_logarithm(n) - per_logarithm(n / 2),
        3e-3,
    );
}

/// In contact w = η v ∂h/∂ξ > 0: only the rising, front half of the body touches.
#[test]
fn only_the_front_half_stays_in_contact() {
    for exponent in [1.0, 2.0, 4.0] {
        let scene = Scene::unit(exponent);
        let transient = scene.slide(8.0, 24.0);
        let spacing = scene.contact_length() / 8.0;
        let [rear, front] = transient.last().contact_x;
        assert!(
            rear >= -0.51 * spacing,
            "p = {exponent}: rear {rear}, spacing {spacing}"
        );
        assert!(
            front > 0.9 * scene.contact_length(),
            "p = {exponent}: front {front}"
        );
    }
}

#[test]
fn extrapolation_in_the_distance_agrees_with_a_longer_run() {
    for (exponent, elements) in [(1.0, 4.0), (1.0, 5.0), (1.0, 6.0), (2.0, 4.0), (2.0, 5.0)] {
        let scene = Scene::unit(exponent);
        let name = format!("p = {exponent}, {elements} elements");
        let slide = |lengths| scene.slide(elements, lengths);
        let [short, long] = [24.0, 192.0].map(|lengths| {
            let state = slide(lengths).stationary(0.02);
            state.expect("a stationary state")
        });
        let deviation = (short.friction_coefficient - long.friction_coefficient).abs();
        let allowed = short.distance_error + long.distance_error;
        assert!(deviation <= allowed, "{name}: {short:?} and {long:?}");
        assert!(
            short.distance_error < 2e-2 * short.friction_coefficient,
            "{name}: {short:?}"
        );
        // The drift is, to leading order, the distance that is left to the limit.
        let left = 1.0 - slide(24.0).last().friction_coefficient / long.friction_coefficient;
        assert!(
            (left / short.drift - 1.0).abs() < 0.35,
            "{name}: left {left}, {short:?}"
        );
    }
}

#[test]
fn a_drifting_state_is_not_called_stationary() {
    let transient = Scene::unit(2.0).slide(6.0, 2.0);
    match transient.stationary(1e-3) {
        Err(BemError::NotStationary {
            drift, tolerance, ..
        }) => {
            assert!(
                drift > 0.1 && tolerance < 2e-3,
                "drift {drift}, tolerance {tolerance}"
            );
        }
        other => panic!("{other:?} of a state in transition"),
    }
}
