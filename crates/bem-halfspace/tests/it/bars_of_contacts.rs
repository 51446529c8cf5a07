//! The error bars of depth, force, area, ends and largest pressure hold, and are of use.

use std::f64::consts::PI;

use bem_halfspace::{indent, press, slide};
use friction_analytic::impulse_to_depth;
use indenters::{
    Control, FlatCone, FlatPunch, PowerProfile, PressingLoad, Sphere, Surface, TruncatedParaboloid,
    contact_radius,
};
use numerics::Accuracy;
use rheology::{Compressible, Material};

use crate::support::{
    Scene, assert_bar, assert_bars_agree, assert_close, assert_ends, at_depth, carried, cone,
    elastic, paraboloid, power, prony, viscous,
};

/// Bodies of revolution, whose contact radius at a depth the one-dimensional model has exactly.
fn bodies() -> Vec<(String, Box<dyn Surface>)> {
    let sphere = Sphere::new(1.0).expect("a body");
    let flat = TruncatedParaboloid::new(0.1, 0.5).expect("a body");
    let flat_cone = FlatCone::new(0.1, 0.5).expect("a body");
    let mut bodies: Vec<(String, Box<dyn Surface>)> = vec![
        ("sphere".to_owned(), Box::new(sphere)),
        ("paraboloid with flat end".to_owned(), Box::new(flat)),
        ("cone with flat end".to_owned(), Box::new(flat_cone)),
    ];
    for exponent in [1.0, 1.5, 2.0, 4.0] {
        bodies.push((format!("r^{exponent}"), Box::new(power(0.5, exponent))));
    }
    bodies
}

#[test]
fn the_bars_of_an_elastic_contact_hold() {
    let material = Compressible::new(&elastic(3.0), 0.3).expect("a ratio");
    let depth = 0.02;
    for (name, body) in &bodies() {
        // The surface is 2 (1 − ν) times as compliant as that of an incompressible half space.
        let profile = body.as_axisymmetric().expect("a body of revolution");
        let force = impulse_to_depth(profile, &viscous(1.0), depth).expect("a force") * 3.0 / 1.4;
        let radius = contact_radius(profile, depth).expect("a radius");
        for accuracy in [Accuracy::Elements(24), 5e-3.into()] {
            for control in [
                Control::IndentationDepth(depth),
                Control::NormalForce(force),
            ] {
                let got = press(body, &material, control, accuracy).expect("a contact");
                let what = (name, control, accuracy);
                assert_bar(what, got.normal_force, force, 0.2);
                let got_depth = got.indentation_depth.expect("a depth");
                assert_bar(what, got_depth, depth, 0.2);
                // Of sixteen elements along the contact some touch or not by chance.
                assert_bar(what, got.contact_area, PI * radius * radius, 1.0);
                let ends = [got.finest.contact_x, got.finest.contact_y];
                assert_ends(what, ends, [[-radius, radius]; 2], got.contact_box_error);
                if let (Control::NormalForce(_), Some(field)) = (control, &got.finest.pressure) {
                    assert_close(what, carried(field), force, 1e-9);
                }
                assert!(got.finest.pressure.is_some(), "{what:?}: a pressure");
            }
        }
    }
}

/// Hertz: p₀ = 3F/(2πa²).
#[test]
fn the_largest_pressure_has_a_bar_where_it_has_a_limit() {
    let (depth, radius) = (0.01, 0.1);
    let control = Control::IndentationDepth(depth);
    let scene = Scene::new(paraboloid(0.5), elastic(3.0), at_depth(depth, 1.0));
    let pressed = |body: &dyn Surface, accuracy| {
        let pressed = press(body, &scene.material, control, accuracy);
        pressed.expect("a contact").peak_pressure
    };
    // F = (16/3) G √R d^(3/2), R = 1.
    let force = 16.0 * depth.powf(1.5);
    let expected = 1.5 * force / (PI * radius * radius);
    for accuracy in [Accuracy::Elements(16), Accuracy::Elements(50), 2e-3.into()] {
        let peak = pressed(&scene.body, accuracy).expect("a limit");
        assert_bar("pressed", peak, expected, 0.5);
        let sliding = scene.steady(accuracy);
        let peak = sliding.peak_pressure.expect("a limit");
        assert_bar("sliding", peak, expected, 0.5);
        assert_bar("area", sliding.contact_area, PI * depth, 0.3);
        assert_bar("force", sliding.normal_force, force, 0.2);
        let (ends, allowed) = (
            [sliding.finest.contact_x, sliding.finest.contact_y],
            sliding.contact_box_error,
        );
        assert_ends(accuracy, ends, [[-radius, radius]; 2], allowed);
    }
    let (apex, rim): (PowerProfile, _) = (cone(0.3), FlatPunch::new(0.3).expect("a body"));
    let without = [&apex as &dyn Surface, &rim].map(|body| pressed(body, Accuracy::Elements(16)));
    assert_eq!(without, [None; 2], "an apex and a rim");
}

/// A held depth relaxes like G(t); a constant force makes the depth of the elastic body of compliance J(t).
#[test]
fn pressing_for_a_time_scales_an_elastic_contact() {
    let solid = prony([1.0, 0.0], &[(4.0, 0.5)]);
    let (body, grid) = (paraboloid(0.5), Accuracy::Elements(16));
    let pressed = |control| {
        let load = PressingLoad::new(control, 0.4).expect("a load");
        indent(&body, &solid, &load, grid).expect("a contact")
    };
    let held = Control::IndentationDepth(0.01);
    let spring = elastic(1.0 + 4.0 * (-0.8_f64).exp());
    let expected = press(&body, &spring, held, grid).expect("a contact");
    let force = pressed(held).normal_force.value;
    assert_close("force", force, expected.normal_force.value, 1e-12);
    let pressure = pressed(Control::NormalForce(0.1)).finest.pressure;
    assert_eq!(pressure, None, "under a force");
}

/// A march and the direct solution, with nothing in common but the elements.
#[test]
fn marches_and_stationary_solutions_agree_within_their_bars() {
    let scene = Scene::unit(2.0);
    let solid = prony([0.5, 0.0], &[(3.0, 0.1)]);
    let materials: [(_, &dyn Material); 2] = [("dashpot", &scene.material), ("solid", &solid)];
    for (name, material) in materials {
        let march = slide(&scene.body, material, &scene.load, Accuracy::Elements(12));
        let march = march.expect("a march");
        let direct = Scene::new(scene.body, material, scene.load).steady(1e-3);
        for (what, one, other) in [
            (
                "friction",
                march.friction_coefficient,
                direct.friction_coefficient,
            ),
            ("area", march.contact_area, direct.contact_area),
            ("force", march.normal_force, direct.normal_force),
        ] {
            assert_bars_agree((name, what), one, other);
            assert!(one.error < 0.6 * one.value, "{name}, {what}: {one:?}");
        }
        let last = march.finest.last();
        assert_ends(
            name,
            [last.contact_x, last.contact_y],
            [direct.finest.contact_x, direct.finest.contact_y],
            march.contact_box_error + direct.contact_box_error,
        );
        let depths = [march.indentation_depth, direct.indentation_depth];
        for depth in depths {
            assert_eq!(depth.is_some(), name == "solid", "{name}: a depth");
        }
    }
}
