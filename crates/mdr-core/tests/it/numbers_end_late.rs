//! Forces near the smallest and largest numbers, where squares of depths are no numbers any more.

use indenters::{EquivalentLine, PowerProfile, SlidingLoad};
use mdr_core::{SlideOptions, slide_on_grid, steady};
use rheology::{Maxwell, Viscous};

use crate::support::ASKED;

/// (22) with a curvature, a viscosity and a speed of one: d = F/4, μ = 4/3 √(2 d).
fn expected(force: f64) -> [f64; 2] {
    let depth = 0.25 * force;
    [depth, 4.0 / 3.0 * (2.0 * depth).sqrt()]
}

fn assert_close(got: [f64; 2], force: f64, tolerance: f64) {
    for (got, expected) in got.into_iter().zip(expected(force)) {
        assert!(
            (got / expected - 1.0).abs() <= tolerance,
            "F = {force:e}: {got:e}, expected {expected:e} within {tolerance:e}"
        );
    }
}

const FORCES: [f64; 8] = [1e-300, 1e-200, 1e-150, 1e-100, 1e100, 1e150, 1e200, 1e300];

#[test]
fn stationary_friction_keeps_its_digits() {
    let (profile, material) = scene();
    for force in FORCES {
        let load = SlidingLoad::new(force, 1.0).expect("a load");
        let state = steady(&EquivalentLine(&profile), &material, &load, ASKED).expect("a state");
        let got = [state.indentation_depth, state.friction_coefficient].map(|number| number.value);
        assert_close(got, force, ASKED);
    }
}

#[test]
fn the_march_keeps_its_digits() {
    let (profile, material) = scene();
    for force in FORCES {
        let load = SlidingLoad::new(force, 1.0).expect("a load");
        let options = SlideOptions::with_elements(50, &EquivalentLine(&profile), &material, &load)
            .expect("options");
        let transient = slide_on_grid(&EquivalentLine(&profile), &material, &load, &options);
        let state = transient.expect("a state").last;
        let got = [state.indentation_depth, state.friction_coefficient];
        // Second order in the spacing.
        assert_close(got, force, 1.0 / 50.0_f64.powi(2));
    }
}

/// Moduli as well: the paraboloid on a Maxwell foundation whose distance of relaxation is the same part of its front.
#[test]
fn stiff_and_soft_materials_keep_their_digits() {
    let profile = PowerProfile::paraboloid(1.0).expect("a profile");
    let friction = |unit: f64| {
        let material = Maxwell::new(unit, unit).expect("a material");
        let load = SlidingLoad::new(unit, 1.0).expect("a load");
        let state = steady(&EquivalentLine(&profile), &material, &load, ASKED);
        state.expect("a state").friction_coefficient.value
    };
    let usual = friction(1.0);
    for unit in [1e-300, 1e-200, 1e200, 1e300] {
        let got = friction(unit);
        assert!(
            (got / usual - 1.0).abs() <= 1e-12,
            "modulus {unit:e}: {got}, expected {usual}"
        );
    }
}

fn scene() -> (PowerProfile, Viscous) {
    (
        PowerProfile::paraboloid(1.0).expect("a profile"),
        Viscous::new(1.0).expect("a material"),
    )
}
