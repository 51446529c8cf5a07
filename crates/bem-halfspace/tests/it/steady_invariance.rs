//! The stationary solution satisfies the contact conditions, and the symmetries of the scene.

use bem_halfspace::SlidingLoad;
use bem_halfspace::steady::{SteadyOptions, SteadySliding, steady_on_grid};
use casebook::group;
use indenters::{Surface, Unmirrored};

use crate::support::{Scene, prony};

fn options(scene: &Scene, elements: f64, phase: [f64; 2]) -> SteadyOptions {
    let spacing = scene.contact_length() / elements;
    let footprint = scene.options(elements).footprint;
    SteadyOptions {
        phase,
        tolerance: 1e-10,
        ..SteadyOptions::new([spacing, 0.5 * spacing], footprint)
    }
}

fn solve(scene: &Scene, elements: f64, phase: [f64; 2]) -> SteadySliding {
    steady_on_grid(
        &scene.body,
        &scene.material,
        &scene.load,
        &options(scene, elements, phase),
    )
    .expect("a solution")
}

#[test]
fn pressure_is_positive_symmetric_and_balances_the_force() {
    for phase in [[0.0, 0.0], [0.25, 0.5], [-0.4, 0.3]] {
        let scene = Scene::unit(2.0);
        let solution = solve(&scene, 8.0, phase);
        let field = &solution.pressure;
        assert!(
            solution.residual <= 1e-10,
            "residual {:e}",
            solution.residual
        );
        assert!(
            field.pressure.iter().all(|pressure| *pressure >= 0.0),
            "phase {phase:?}: tension"
        );
        let force = field.pressure.iter().sum::<f64>() * field.grid.element_area();
        let expected = scene.load.normal_force().expect("a force");
        assert!(
            (force / expected - 1.0).abs() < 1e-12,
            "phase {phase:?}: force {force} instead of {expected}"
        );
        let sides = solution.contact_y;
        if phase[1].abs() < 0.1 || phase[1] > 0.4 {
            assert!(
                (sides[0] + sides[1]).abs() < 1e-12,
                "phase {phase:?}: sides {sides:?}"
            );
        }
    }
}

/// Both are the same discrete problem, solved to 1e-10 of the depth scale.
fn assert_half_is_whole(half: &SteadySliding, whole: &SteadySliding) {
    // Elements on the axis are their own image.
    assert!(
        whole.unknowns > half.unknowns + half.unknowns / 2 && whole.unknowns <= 2 * half.unknowns,
        "{} unknowns of the half, {} of the whole",
        half.unknowns,
        whole.unknowns
    );
    for (name, half, whole) in [
        (
            "friction",
            half.friction_coefficient,
            whole.friction_coefficient,
        ),
        ("force", half.normal_force, whole.normal_force),
        ("area", half.contact_area, whole.contact_area),
    ] {
        let error = (half / whole - 1.0).abs();
        assert!(
            error < 1e-9,
            "{name} {half} of the half, {whole} of the whole"
        );
    }
}

#[test]
fn half_of_a_symmetric_scene_has_the_friction_of_the_whole() {
    for (elements, power) in [(6.0, 1.0), (6.0, 2.0), (16.0, 2.0)] {
        for phase in [[0.0, 0.0], [0.0, 0.5]] {
            let scene = Scene::unit(power);
            let options = options(&scene, elements, phase);
            let whole = Unmirrored(&scene.body);
            let whole = steady_on_grid(&whole, &scene.material, &scene.load, &options);
            let half = solve(&scene, elements, phase);
            assert_half_is_whole(&half, &whole.expect("a solution"));
        }
    }
}

#[test]
fn half_of_a_symmetric_scene_at_a_depth_has_the_force_of_the_whole() {
    let scene = Scene::unit(2.0);
    let solid = prony([0.5, 0.0], &[(3.0, 0.4), (1.0, 2.0)]);
    let load = SlidingLoad::at_depth(0.2, scene.load.velocity()).expect("a load");
    let options = options(&scene, 4.0, [0.0; 2]);
    let half = steady_on_grid(&scene.body, &solid, &load, &options);
    let whole = steady_on_grid(&Unmirrored(&scene.body), &solid, &load, &options);
    assert_half_is_whole(&half.expect("a solution"), &whole.expect("a solution"));
}

#[test]
fn stationary_friction_is_invariant_under_a_change_of_units() {
    let reference = solve(&Scene::unit(1.5), 7.0, [0.0, 0.0]);
    for (metre, newton, second) in [(1e12, 1.0, 1.0), (1e-12, 1e9, 1e3), (1e3, 1e-12, 1e12)] {
        let coefficient = 0.3 * f64::powf(metre, -0.5);
        let viscosity = 2.0 * newton * second / metre / metre;
        let scene = Scene::new(
            [coefficient, 1.5],
            viscosity,
            [0.5 * newton, 0.7 * metre / second],
        );
        let solution = solve(&scene, 7.0, [0.0, 0.0]);
        let ratio = solution.friction_coefficient / reference.friction_coefficient;
        assert!(
            (ratio - 1.0).abs() < 1e-9,
            "units {metre}, {newton}, {second}: ratio {ratio}"
        );
        let front = solution.contact_x[1] / metre / reference.contact_x[1];
        assert!(
            (front - 1.0).abs() < 1e-9,
            "units {metre}, {newton}, {second}: front {front}"
        );
    }
}

/// Two bumps side by side, the second higher: two separate patches share the load.
struct TwoBumps;

impl Surface for TwoBumps {
    fn height(&self, [x, y]: [f64; 2]) -> f64 {
        (x * x + y * y).min(x * x + (y - 3.0).powi(2) + 0.05)
    }

    fn gradient(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        let first = x * x + y * y < x * x + (y - 3.0).powi(2) + 0.05;
        [2.0 * x, if first { 2.0 * y } else { 2.0 * (y - 3.0) }]
    }
}

#[test]
fn separate_patches_are_found() {
    let scene = Scene::new([1.0, 2.0], 1.0, [1.5, 1.0]);
    let footprint = bem_halfspace::Footprint {
        x: [-1.0, 2.0],
        y: [-2.0, 5.0],
    };
    let options = SteadyOptions {
        tolerance: 1e-10,
        ..SteadyOptions::new([0.1, 0.1], footprint)
    };
    let solution =
        steady_on_grid(&TwoBumps, &scene.material, &scene.load, &options).expect("a solution");
    let field = &solution.pressure;
    let columns = field.grid.shape()[1];
    let loaded = |column: usize| {
        field
            .pressure
            .iter()
            .skip(column)
            .step_by(columns)
            .any(|pressure| *pressure > 0.0)
    };
    let patches = (1..columns)
        .filter(|&column| loaded(column) && !loaded(column - 1))
        .count()
        + usize::from(loaded(0));
    assert_eq!(patches, 2, "contact from {:?}", solution.contact_y);
}

/// The paraboloid of the casebook in three systems of units; its line has the friction of the row.
#[test]
fn friction_is_the_same_in_every_system_of_units() {
    let friction: Vec<f64> = group("EXT-06")
        .iter()
        .map(|case| {
            let load = [case.input("F"), case.input("v")];
            let scene = Scene::new([case.input("c"), 2.0], case.input("eta"), load);
            solve(&scene, 7.0, [0.0, 0.0]).friction_coefficient
        })
        .collect();
    assert_eq!(friction.len(), 3, "three systems of units");
    for value in &friction {
        assert!((value / friction[0] - 1.0).abs() < 1e-9, "{friction:?}");
    }
}
