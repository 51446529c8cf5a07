//! The error bars of depth, force, area, ends and largest pressure hold, and are of use.

use std::f64::consts::PI;

use bem_halfspace::indent::PressEstimate;
use bem_halfspace::steady::SteadySliding;
use bem_halfspace::{BemError, indent, press, slide, steady};
use friction_analytic::impulse_to_depth;
use indenters::{
    Axisymmetric, Control, FlatCone, FlatPunch, PowerProfile, PressingLoad, SlidingLoad, Sphere,
    Surface, TruncatedParaboloid, contact_radius,
};
use numerics::{Accuracy, Estimate};
use rheology::{Compressible, Elastic, Material, Viscous};

use crate::support::{Scene, prony};

/// Checks a bar, and that it is at most a part of the value.
fn check(what: &str, got: Estimate, expected: f64, widest: f64) {
    let Estimate { value, error } = got;
    assert!(
        (value - expected).abs() <= error && error <= widest * expected,
        "{what}: {value} ± {error} instead of {expected}"
    );
}

/// Bodies with the radius of the contact at a depth of 0.02 m, from the one-dimensional model, which is exact here.
fn check_pressed(name: &str, body: &dyn Axisymmetric, estimate: &PressEstimate) {
    let depth = 0.02;
    let radius = contact_radius(body, depth).expect("a radius");
    check(
        &format!("{name}, area"),
        estimate.contact_area,
        PI * radius * radius,
        // Of sixteen elements along the contact some touch or not by chance.
        1.0,
    );
    for end in [estimate.finest.contact_x, estimate.finest.contact_y].as_flattened() {
        assert!(
            (end.abs() - radius).abs() <= estimate.contact_box_error,
            "{name}: the contact ends at {end} ± {} instead of {radius}",
            estimate.contact_box_error
        );
    }
}

#[test]
fn the_bars_of_an_elastic_contact_hold() {
    let material = Compressible::new(&Elastic::new(3.0).expect("a modulus"), 0.3).expect("a ratio");
    let sphere = Sphere::new(1.0).expect("a body");
    let powers = [1.0, 1.5, 2.0, 4.0].map(|p| PowerProfile::new(0.5, p).expect("a body"));
    let flat = TruncatedParaboloid::new(0.1, 0.5).expect("a body");
    let cone = FlatCone::new(0.1, 0.5).expect("a body");
    let mut bodies: Vec<(String, Box<dyn Surface>)> = vec![
        ("sphere".to_owned(), Box::new(sphere)),
        ("paraboloid with flat end".to_owned(), Box::new(flat)),
        ("cone with flat end".to_owned(), Box::new(cone)),
    ];
    for body in powers {
        bodies.push((format!("r^{}", body.exponent()), Box::new(body)));
    }
    let dashpot = Viscous::new(1.0).expect("a material");
    for (name, body) in &bodies {
        // The surface is 2 (1 − ν) times as compliant as that of an incompressible half space.
        let profile = body.as_axisymmetric().expect("a body of revolution");
        let force = impulse_to_depth(profile, &dashpot, 0.02).expect("a force") * 3.0 / 1.4;
        for accuracy in [Accuracy::Elements(24), 5e-3.into()] {
            let held = press(
                &**body,
                &material,
                Control::IndentationDepth(0.02),
                accuracy,
            );
            let held = held.expect("a contact");
            check(&format!("{name}, force"), held.normal_force, force, 0.2);
            check_pressed(name, profile, &held);
            let pressed = press(body, &material, Control::NormalForce(force), accuracy);
            let pressed = pressed.expect("a contact");
            check(
                &format!("{name}, depth"),
                pressed.indentation_depth,
                0.02,
                0.2,
            );
            check_pressed(name, profile, &pressed);
            let carried = pressed.finest.pressure.expect("a pressure");
            let sum: f64 = carried.pressure.iter().sum();
            let sum = sum * carried.grid.element_area();
            assert!(
                (sum / force - 1.0).abs() < 1e-9,
                "{name}: {sum} of {force} N"
            );
        }
    }
}

/// Hertz: p₀ = 3F/(2πa²).
#[test]
fn the_largest_pressure_has_a_bar_where_it_has_a_limit() {
    let material = Elastic::new(3.0).expect("a material");
    let paraboloid = PowerProfile::paraboloid(0.5).expect("a body");
    let (depth, radius) = (0.01, 0.1);
    let control = Control::IndentationDepth(depth);
    // F = (16/3) G √R d^(3/2), R = 1.
    let expected = 1.5 * 16.0 * depth.powf(1.5) / (PI * radius * radius);
    for accuracy in [Accuracy::Elements(16), Accuracy::Elements(50), 2e-3.into()] {
        let pressed = press(&paraboloid, &material, control, accuracy).expect("a contact");
        check(
            "pressed",
            pressed.peak_pressure.expect("a limit"),
            expected,
            0.5,
        );
        let load = SlidingLoad::at_depth(depth, 1.0).expect("a load");
        let sliding = steady(&paraboloid, &material, &load, accuracy).expect("a contact");
        check(
            "sliding",
            sliding.peak_pressure.expect("a limit"),
            expected,
            0.5,
        );
        check("area", sliding.contact_area, PI * depth, 0.3);
        let finest = &sliding.finest;
        for end in [finest.contact_x, finest.contact_y].as_flattened() {
            assert!(
                (end.abs() - radius).abs() <= sliding.contact_box_error,
                "the contact ends at {end} ± {}",
                sliding.contact_box_error
            );
        }
    }
    let cone = PowerProfile::cone(0.3).expect("a body");
    let punch = FlatPunch::new(0.3).expect("a body");
    let accuracy = Accuracy::Elements(16);
    let without = [
        press(&cone, &material, control, accuracy)
            .expect("a contact")
            .peak_pressure,
        press(&punch, &material, control, accuracy)
            .expect("a contact")
            .peak_pressure,
    ];
    assert_eq!(without, [None; 2], "an apex and a rim");
}

/// A held depth relaxes like G(t); a constant force makes the depth of the elastic body of compliance J(t).
#[test]
fn pressing_for_a_time_scales_an_elastic_contact() {
    let solid = prony([1.0, 0.0], &[(4.0, 0.5)]);
    let body = PowerProfile::paraboloid(0.5).expect("a body");
    let grid = Accuracy::Elements(16);
    let load = |control| PressingLoad::new(control, 0.4).expect("a load");
    let held = Control::IndentationDepth(0.01);
    let got = indent(&body, &solid, &load(held), grid).expect("a contact");
    let modulus = 1.0 + 4.0 * (-0.8_f64).exp();
    let spring = Elastic::new(modulus).expect("a material");
    let expected = press(&body, &spring, held, grid).expect("a contact");
    let ratio = got.normal_force.value / expected.normal_force.value;
    assert!(
        (ratio - 1.0).abs() < 1e-12,
        "{got:?} instead of {expected:?}"
    );
    let pressed = indent(&body, &solid, &load(Control::NormalForce(0.1)), grid);
    assert_eq!(
        pressed.expect("a contact").finest.pressure,
        None,
        "under a force"
    );
    let viscous = Viscous::new(1.0).expect("a material");
    let refused = press(&body, &viscous, held, grid).err();
    assert_eq!(
        refused,
        Some(BemError::NoEquilibrium),
        "a material that flows"
    );
    let relaxed = PressingLoad::new(held, 1e6).expect("a load");
    let fluid = prony([0.0, 0.0], &[(4.0, 0.5)]);
    let refused = indent(&body, &fluid, &relaxed, grid).err();
    assert!(
        matches!(refused, Some(BemError::InvalidParameter { .. })),
        "{refused:?}"
    );
}

/// A march and the direct solution, with nothing in common but the elements.
#[test]
fn marches_and_stationary_solutions_agree_within_their_bars() {
    let scene = Scene::unit(2.0);
    let solid = prony([0.5, 0.0], &[(3.0, 0.1)]);
    for (name, material) in [
        ("dashpot", &scene.material as &dyn Material),
        ("solid", &solid),
    ] {
        let march = slide(&scene.body, material, &scene.load, Accuracy::Elements(12));
        let march = march.expect("a march");
        let direct = steady(&scene.body, material, &scene.load, 1e-3).expect("a state");
        for (what, one, other) in [
            (
                "friction",
                march.friction_coefficient,
                direct.friction_coefficient,
            ),
            ("area", march.contact_area, direct.contact_area),
            ("force", march.normal_force, direct.normal_force),
        ] {
            let deviation = (one.value - other.value).abs();
            assert!(
                deviation <= one.error + other.error && one.error < 0.6 * one.value,
                "{name}, {what}: {one:?} and {other:?}"
            );
        }
        let last = march.finest.last();
        assert_ends(
            name,
            [last.contact_x, last.contact_y],
            [direct.finest.contact_x, direct.finest.contact_y],
            march.contact_box_error + direct.contact_box_error,
        );
        assert_eq!(
            direct.indentation_depth.is_some(),
            name == "solid",
            "{name}: a depth"
        );
        assert_eq!(
            march.indentation_depth.is_some(),
            name == "solid",
            "{name}: a depth"
        );
    }
}

#[test]
fn a_march_at_a_depth_needs_a_distance() {
    let Scene { body, material, .. } = Scene::unit(2.0);
    let load = SlidingLoad::at_depth(0.1, 1.0).expect("a load");
    let refused = slide(&body, &material, &load, 1e-2).err();
    assert!(
        matches!(refused, Some(BemError::SlidingDistanceMissing { .. })),
        "{refused:?}"
    );
}

/// Every bar of the stationary state holds against a much finer solution.
#[test]
fn bars_of_the_stationary_state_hold_against_finer_solutions() {
    let solid = prony([0.5, 0.0], &[(3.0, 0.4), (1.0, 2.0)]);
    for exponent in [1.0, 1.5, 2.0, 3.0] {
        let Scene { body, load, .. } = Scene::unit(exponent);
        let fine = steady(&body, &solid, &load, 5e-4).expect("a state");
        for accuracy in [Accuracy::Elements(12), Accuracy::Elements(30), 1e-2.into()] {
            let coarse = steady(&body, &solid, &load, accuracy).expect("a state");
            let depths = [&coarse, &fine].map(|state| state.indentation_depth.expect("a depth"));
            let mut pairs = vec![
                (
                    "friction",
                    coarse.friction_coefficient,
                    fine.friction_coefficient,
                ),
                ("depth", depths[0], depths[1]),
                ("area", coarse.contact_area, fine.contact_area),
            ];
            pairs.extend(
                coarse
                    .peak_pressure
                    .zip(fine.peak_pressure)
                    .map(|(c, f)| ("peak", c, f)),
            );
            for (what, one, other) in pairs {
                assert!(
                    (one.value - other.value).abs() <= one.error + other.error,
                    "p = {exponent}, {accuracy:?}, {what}: {one:?} and {other:?}"
                );
            }
            let ends = |state: &SteadySliding| [state.contact_x, state.contact_y];
            assert_ends(
                &format!("p = {exponent}"),
                ends(&coarse.finest),
                ends(&fine.finest),
                coarse.contact_box_error + fine.contact_box_error,
            );
        }
    }
}

fn assert_ends(name: &str, one: [[f64; 2]; 2], other: [[f64; 2]; 2], allowed: f64) {
    for (one, other) in one.as_flattened().iter().zip(other.as_flattened()) {
        assert!(
            (one - other).abs() <= allowed,
            "{name}: ends {one} and {other} ± {allowed}"
        );
    }
}
