//! A layer on a rigid base: its factor, its potential, pressing against an integral equation, and its limits.

use std::f64::consts::{PI, TAU};

use bem_halfspace::{
    Control, Convolution, Elastomer, Grid, Layer, PeriodicLoad, PeriodicOptions, SteadyBody::Line,
    layer_factor, periodic, press, slide, steady,
};
use casebook::refuses;
use friction_analytic::{BondedLayer, power_sliding, winkler_line_force};
use indenters::{Axisymmetric, Cylinder, FlatPunch, Surface};
use numerics::{Accuracy, Estimate};
use rheology::{Compressible, Material, Prony};

use crate::support::{
    after, assert_bar, assert_bars_agree, assert_close, assert_near, assert_refused, cone, elastic,
    paraboloid, prony, three_elements, under_force, viscous,
};

/// ν, s and M(s); casebook-2.json, "layer".
const FACTORS: [[f64; 3]; 7] = [
    [0.0, 0.05, 0.024_999_992_201_426_974],
    [0.0, 3.0, 0.953_820_617_645_123_9],
    [0.3, 0.3, 0.123_138_581_660_434_59],
    [0.3, 10.0, 0.999_999_491_307_521_4],
    [0.45, 1.0, 0.304_116_812_406_668_66],
    [0.5, 0.05, 8.296_003_684_674_766e-5],
    [0.5, 3.0, 0.886_720_854_075_309_1],
];

/// Bodies, materials and layers that are known at run time only.
#[test]
fn trait_objects_have_the_answer_of_their_types() {
    let (ball, solid) = (paraboloid(0.5), solid());
    let layer = Layer::new(&solid, 0.1).unwrap();
    let material: &dyn Material = &solid;
    let of_object = Layer::new(material, 0.1).unwrap();
    let copy = of_object.clone();
    let elastomers: [&dyn Elastomer; 4] = [&solid, &material, &layer, &copy];
    let surface: &dyn Surface = &ball;
    let control = Control::NormalForce(0.02);
    let found = elastomers.map(|elastomer| press(surface, elastomer, control, 0.02).unwrap());
    let [half_space, layer] = [
        press(&ball, &solid, control, 0.02),
        press(&ball, &layer, control, 0.02),
    ]
    .map(Result::unwrap);
    for (found, expected) in found.iter().zip([&half_space, &half_space, &layer, &layer]) {
        assert_eq!(found.contact_area, expected.contact_area, "area");
    }
    assert!(
        half_space.contact_area.value > layer.contact_area.value,
        "the layer is stiffer"
    );
}

#[test]
fn the_factor_is_known_to_rounding_for_all_waves() {
    for [nu, s, expected] in FACTORS {
        assert_close("M", layer_factor(s, nu), expected, 2e-15);
    }
    for nu in [-0.9, 0.0, 0.3, 0.4999, 0.499_999, 0.5] {
        for decade in -6..=6 {
            let s = 10.0_f64.powi(decade);
            // Both terms of the numerator; one dominates unless s² is about 1 − 2ν.
            let long =
                s * (0.5 * (1.0 - 2.0 * nu) + (3.0 - 4.0 * nu) * s * s / 6.0) / (1.0 - nu).powi(2);
            let expected = if s < 1.0 { long } else { 1.0 };
            let allowed = if s < 1.0 {
                5.0 * s * s
            } else {
                8.0 * (s + 1.0).powi(2) * (-2.0 * s).exp()
            };
            assert_close("M", layer_factor(s, nu), expected, allowed.max(1e-13));
        }
    }
}

/// A layer of E* = 1.
fn material(poisson_ratio: f64) -> Compressible {
    Compressible::new(&elastic(0.5 * (1.0 - poisson_ratio)), poisson_ratio).unwrap()
}

/// The depth is given, so that the deviation is that of the force.
#[test]
fn pressing_agrees_with_an_integral_equation() {
    for (row, nu) in [0.0, 0.45, 0.5].into_iter().enumerate() {
        let bonded = BondedLayer::new(1.0, nu).unwrap();
        for (column, a) in [0.05, 1.0, 10.0].into_iter().enumerate() {
            let punch = FlatPunch::new(a).unwrap();
            let bodies: [(&str, &dyn Axisymmetric); 3] = [
                ("paraboloid", &paraboloid(1.0)),
                ("cone", &cone(1.0)),
                ("punch", &punch),
            ];
            // A Latin square: each body has every Poisson ratio and every contact radius once.
            let (name, body) = bodies[(row + column) % 3];
            let (force, depth) = if name == "punch" {
                (2.0 * bonded.equivalent_punch_radius(a).unwrap(), 1.0)
            } else {
                let contact = bonded.press(body, a).unwrap();
                (contact.force_per_modulus, contact.indentation_depth)
            };
            let material = material(nu);
            let layer = Layer::new(&material, 1.0).unwrap();
            let control = Control::IndentationDepth(depth);
            let found = press(&body, &layer, control, 2e-4).unwrap();
            let scene = format!("{name}, ν = {nu}, a = {a} t");
            assert_close(&scene, found.normal_force.value, force, 1e-4);
            assert_within_bar(&scene, found.normal_force, force);
            assert_within_bar(&scene, found.contact_area, PI * a * a);
        }
    }
}

#[track_caller]
fn assert_within_bar(what: &str, found: Estimate, expected: f64) {
    assert_near(what, found.value, expected, found.error);
}

fn solid() -> Prony {
    three_elements(0.25, 2.25, 1.0)
}

/// casebook-2.json, "line": a collocation method of another author, with 1e-8 of friction and length and 6e-6 of the depth.
#[test]
fn a_cylinder_slides_as_an_independent_solver_finds() {
    let solid = solid();
    let layer = Layer::new(&solid, 0.1).unwrap();
    let load = under_force(0.02, 0.01);
    let found = steady(Line(&Cylinder::new(1.0).unwrap()), &layer, &load, 1e-5).unwrap();
    let (peak, depth) = (found.peak_pressure, found.indentation_depth);
    assert_within_bar("μ", found.friction_coefficient, 0.038_570_761_236_354_46);
    assert_within_bar("width", found.contact_area, 2.0 * 0.073_904_070_412_448_22);
    assert_within_bar("peak", peak.unwrap(), 0.215_895_694_783_608_37);
    assert_within_bar("depth", depth.unwrap(), 0.003_948_654_133_675_425);
}

/// Without friction the depth has the error asked for: that of the body pressed, and in plane strain that of a finer solution.
#[test]
fn what_slides_over_an_elastic_layer_is_pressed_into_it() {
    let spring = material(0.3);
    let layer = Layer::new(&spring, 0.1).unwrap();
    let (body, load) = (paraboloid(0.5), under_force(0.001, 0.1));
    let slid = steady(&body, &layer, &load, 1e-3).unwrap();
    assert_eq!(slid.friction_coefficient, Estimate::exact(0.0), "friction");
    let pressed = press(&body, &layer, Control::NormalForce(0.001), 2e-4).unwrap();
    let [slid, pressed] = [slid.indentation_depth, pressed.indentation_depth].map(Option::unwrap);
    assert_bars_agree("body", slid, pressed);
    assert!(slid.error <= 1e-3 * slid.value, "{slid:?}");
    let cylinder = Cylinder::new(1.0).unwrap();
    let [rough, fine] = [1e-3, 1e-4].map(|error| {
        let found = steady(Line(&cylinder), &layer, &load, error).unwrap();
        assert_eq!(found.friction_coefficient, Estimate::exact(0.0), "friction");
        found.indentation_depth.unwrap()
    });
    assert_bar("cylinder", rough, fine.value, 1e-3);
}

/// A march also reaches the stationary state on a layer that flows, into which a body does not sink without limit.
#[test]
fn a_march_comes_to_the_stationary_state() {
    let body = paraboloid(0.5);
    let materials: [&dyn Material; 2] = [&viscous(1.0), &solid()];
    for nu in [0.3, 0.5] {
        for material in materials {
            let material = Compressible::new(material, nu).unwrap();
            let layer = Layer::new(&material, 0.1).unwrap();
            let load = under_force(0.001, 0.1);
            let stationary = steady(&body, &layer, &load, 1e-3).unwrap();
            let marched = slide(&body, &layer, &after(load, 1.5), Accuracy::Elements(10)).unwrap();
            let scene = format!("{material:?}");
            let friction = stationary.friction_coefficient.value;
            assert_within_bar(&scene, marched.friction_coefficient, friction);
            let depth = stationary.indentation_depth.unwrap();
            assert_within_bar(&scene, marched.indentation_depth.unwrap(), depth.value);
        }
    }
}

/// The body does not sink without limit into a liquid on a rigid base, so that nothing is extrapolated, and what the surface
/// remembers is as long as the layer is thick.
#[test]
fn a_march_over_a_liquid_layer_goes_on_until_it_is_stationary() {
    let branches = [(1613.36, 1.025_686e-4), (1015.92, 1.526_37e-3)];
    let liquid = prony([0.0; 2], &branches);
    let layer = Layer::new(&liquid, 2.386e-4).unwrap();
    let (body, load) = (paraboloid(86.4), under_force(3.0945e-6, 0.042_263));
    let stationary = steady(&body, &layer, &load, 1e-2).unwrap();
    let marched = slide(&body, &layer, &load, 0.05).unwrap();
    let frictions = [
        stationary.friction_coefficient,
        marched.friction_coefficient,
    ];
    assert_bars_agree("friction", frictions[0], frictions[1]);
}

/// The difference from the half space falls like a/t: to the depth on a solid, and to the friction on a dashpot, on which the
/// depth grows by F/(4πηv) ln 2.
#[test]
fn a_thick_layer_is_a_half_space() {
    let (body, solid) = (paraboloid(0.5), solid());
    let load = under_force(0.001, 0.1);
    let control = Control::NormalForce(0.001);
    let friction_and_depth = |thickness: f64| {
        let layer = Layer::new(&solid, thickness).unwrap();
        let slid = steady(&body, &layer, &load, 1e-3).unwrap();
        let pressed = press(&body, &layer, control, 1e-3).unwrap();
        let depth = pressed.indentation_depth.unwrap();
        [slid.friction_coefficient, depth]
    };
    let [friction, depth] = friction_and_depth(f64::INFINITY);
    let [thick_friction, thick_depth] = friction_and_depth(12.0);
    assert_within_bar("friction at t = 100 a", thick_friction, friction.value);
    let [missing, half] =
        [thick_depth, friction_and_depth(6.0)[1]].map(|thick| depth.value - thick.value);
    assert_close("order of approach", half / missing, 2.0, 0.05);
    let dashpot = viscous(1.0);
    let flowing = |thickness: f64| {
        let layer = Layer::new(&dashpot, thickness).unwrap();
        steady(&body, &layer, &load, 1e-4).unwrap()
    };
    let [half_space, thinner, thicker] = [f64::INFINITY, 6.0, 12.0].map(flowing);
    let friction = half_space.friction_coefficient.value;
    let [one, half] = [&thinner, &thicker].map(|layer| friction - layer.friction_coefficient.value);
    assert_close("order of approach of the friction", one / half, 2.0, 0.02);
    let [one, two] = [thinner, thicker].map(|layer| layer.indentation_depth.unwrap().value);
    let sunken = 0.001 / (4.0 * PI * 0.1) * 2.0_f64.ln();
    assert_close("sinking", two - one, sunken, 0.02);
}

/// A wave that is in full contact, in closed form, and the mean, which is the depth.
#[test]
fn a_periodic_layer_moves_by_its_factor() {
    let grid = Grid::new([32, 32], [1.0 / 32.0; 2]).unwrap();
    let wave = |element: usize| 1e-3 * (TAU * ((element / 32) as f64 / 32.0)).cos();
    let heights: Vec<f64> = (0..grid.n_elements()).map(wave).collect();
    let (solid, thickness, velocity) = (Compressible::new(&solid(), 0.3).unwrap(), 0.2, 0.1);
    let layer = Layer::new(&solid, thickness).unwrap();
    let load = PeriodicLoad::new(1.0, velocity).unwrap();
    let options = PeriodicOptions::default();
    let state = periodic::steady_on_grid(&grid, &heights, &layer, &load, &options).unwrap();
    // μ = p̂ h̃ q sin δ/2 over the mean pressure, with |p̂| = ½ |E*| q h̃/M.
    let modulus = solid.complex_modulus(TAU * velocity).unwrap().loss * 2.0 / 0.7;
    let friction = 0.25 * modulus * (TAU * 1e-3).powi(2) / layer_factor(TAU * thickness, 0.3);
    assert_close("friction", state.friction_coefficient, friction, 1e-9);
    let mean = thickness * 0.4 / (2.0 * 0.25 * 0.7);
    assert_close("depth", state.mean_depth, mean, 1e-9);
    // The displacement by a convolution.
    let convolution = Convolution::periodic_for_elastomer(&layer, &grid);
    let pressure: Vec<f64> = heights.iter().map(|height| 1.0 + height).collect();
    let (mut moved, mut workspace) = (heights.clone(), convolution.workspace());
    convolution.apply(&mut workspace, &pressure, &mut moved);
    let expected = TAU * thickness * 0.4 / (2.0 * 0.49) + layer_factor(TAU * thickness, 0.3) * 1e-3;
    assert_close("crest", moved[0], expected, 1e-13);
}

/// Springs side by side are the one-dimensional model, so that a cylinder on a thin layer of a dashpot follows Kürschner's
/// eq. (22); on a thick one it has a contact at all, which it has not on the half space.
#[test]
fn a_cylinder_slides_over_a_layer_that_flows() {
    let dashpot = Compressible::new(&viscous(1e4), 0.0).unwrap();
    let friction = |thickness: f64, force: f64| {
        let layer = Layer::new(&dashpot, thickness).unwrap();
        let load = under_force(force, 1e-3);
        let found = steady(Line(&Cylinder::new(1e-2).unwrap()), &layer, &load, 1e-3).unwrap();
        found.friction_coefficient.value
    };
    let line = paraboloid(25.0);
    let force = winkler_line_force(&dashpot, 1e-3, 100.0).unwrap();
    let load = under_force(force, 1e-3);
    let theorem = power_sliding(&line, &viscous(5e3), &load).unwrap();
    assert_close(
        "thin",
        friction(1e-3, 100.0),
        theorem.friction_coefficient,
        1e-3,
    );
    assert!(friction(3e-2, 9e-3) > 0.0);
}

/// The smallest discs of elements are alike, so that no error could come of them, and the largest are beyond all grids.
#[test]
fn a_punch_needs_elements_and_not_too_many() {
    let (punch, spring) = (FlatPunch::new(1.0).unwrap(), elastic(1.0));
    let pressed = |elements| {
        let elements = Accuracy::Elements(elements);
        press(&punch, &spring, Control::IndentationDepth(0.01), elements)
    };
    for (elements, name) in [
        (2, "GridTooCoarse"),
        (6, "GridTooCoarse"),
        (usize::MAX, "GridTooLarge"),
    ] {
        assert_refused(elements, pressed(elements), name);
    }
    for elements in 7..=16 {
        assert_within_bar("disc", pressed(elements).unwrap().normal_force, 0.08);
    }
}

#[test]
fn a_thickness_is_a_number_above_zero() {
    let solid = solid();
    refuses("thickness", &[0.0, -1.0, f64::NAN], |t| {
        Layer::new(&solid, t)
    });
}
