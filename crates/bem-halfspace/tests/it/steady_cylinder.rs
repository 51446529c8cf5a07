//! A cylinder slides in plane strain as in closed form (Hunter 1961) and as in the spectral reference (Morland 1967).

use std::f64::consts::PI;

use bem_halfspace::steady::{LineEstimate, LineOptions, steady_line, steady_line_on_grid};
use casebook::{Case, group};
use indenters::Cylinder;
use rheology::Prony;

use crate::support::{assert_bar, assert_close, assert_near, three_elements, under_force};

/// A material, the speed, and the load per length of a cylinder of radius 1 with a contact of the half length 1.
struct Scene {
    material: Prony,
    velocity: f64,
    line_load: f64,
}

fn unit_cylinder() -> Cylinder {
    Cylinder::new(1.0).expect("a cylinder")
}

impl Scene {
    /// Lengths in units of half the contact l, times in those of τ: the speed is 1/z, the load P π G₁.
    fn hunter([gamma, z, load]: [f64; 3]) -> Self {
        Self {
            material: three_elements(gamma, 1.0, 1.0),
            velocity: 1.0 / z,
            line_load: load * PI * gamma,
        }
    }

    fn of(case: &Case) -> Self {
        let load = case.expected("P").expect("a load");
        Self::hunter([case.input("gamma"), case.input("z"), load])
    }

    fn solve(&self, relative_error: f64) -> LineEstimate {
        let load = under_force(self.line_load, self.velocity);
        let solved = steady_line(&unit_cylinder(), &self.material, &load, relative_error);
        solved.expect("a friction coefficient")
    }

    fn check(&self, name: &str, relative_error: f64, expected: f64) {
        let friction = self.solve(relative_error).friction_coefficient;
        assert_bar(name, friction, expected, relative_error);
    }
}

#[test]
fn a_cylinder_on_a_three_element_solid_is_hunters_within_the_error_bar() {
    for case in group("VIS-04") {
        let expected = case.expected("muR_over_l").expect("a friction coefficient");
        for relative_error in [1e-2, 1e-3, 1e-4] {
            Scene::of(&case).check(case.id(), relative_error, expected);
        }
    }
}

/// γ, z, P and μR/l of Hunter's closed form, evaluated with mpmath 1.3 and 60 digits.
const EXTREME: [[f64; 4]; 7] = [
    [1e-6, 1.0, 892775.379762957, 6.3389082332772695],
    [1e-3, 1e-3, 1000.999868040761, 0.007084135726821092],
    [1.0, 1e-6, 1.9999999999962188, 3.718647313538869e-6],
    [1.0, 1e-3, 1.9999979457936135, 0.001991706581706198],
    [1e3, 1.0, 1.0006803903756958, 0.0003195540655378719],
    [1e-3, 30.0, 60.21048988923658, 3.68922486546635],
    [1.0, 1e6, 1.00000100000025, 9.9999850000075e-7],
];

#[test]
fn slow_and_fast_cylinders_and_stiff_solids_are_hunters_too() {
    for [gamma, z, load, expected] in EXTREME {
        let name = format!("γ = {gamma}, z = {z}");
        Scene::hunter([gamma, z, load]).check(&name, 1e-2, expected);
    }
}

/// What the solver leaves is a part of the bar, whether slopes of one sign or of both are loaded.
#[test]
fn the_residual_is_a_part_of_the_error() {
    for scene in [[0.1, 2.0, 6.612], [1.0, 100.0, 1.0]] {
        let estimate = Scene::hunter(scene).solve(1e-2);
        let (bar, parts) = (estimate.friction_coefficient.error, estimate.error_parts);
        assert_close(scene, parts.sum(), bar, 1e-12);
        let iteration = parts.iteration.expect("a part");
        assert!(iteration > 0.0 && iteration < bar, "{parts:?} of {bar:e}");
    }
}

#[test]
fn a_cylinder_on_three_branches_is_that_of_the_spectral_reference() {
    for case in group("VIS-05") {
        let scene = Scene {
            material: case.material(),
            velocity: case.input("v"),
            line_load: case.expected("line_force").expect("a load"),
        };
        let expected = case.expected("mu").expect("a friction coefficient");
        scene.check(case.id(), 1e-3, expected);
    }
}

/// The pressure sums up to the load, and the contact ends within two elements of where Hunter's does.
#[test]
fn one_grid_carries_the_load_between_the_ends_of_the_contact() {
    let spacing = 1.0 / 32.0;
    let options = LineOptions {
        spacing,
        phase: 0.25,
        footprint: [-3.0, 5.0],
        tolerance: 1e-10,
        max_iterations: 500,
    };
    for case in group("VIS-04") {
        let scene = Scene::of(&case);
        let load = under_force(scene.line_load, scene.velocity);
        let state = steady_line_on_grid(&unit_cylinder(), &scene.material, &load, &options);
        let state = state.expect("a solution");
        let carried: f64 = state.pressure.iter().map(|[_, p]| p * spacing).sum();
        assert_close(case.id(), carried, scene.line_load, 1e-12);
        let middle = case.expected("x0_over_l").expect("a middle");
        for (end, expected) in state.contact.into_iter().zip([middle - 1.0, middle + 1.0]) {
            assert_near(case.id(), end, expected, 2.0 * spacing);
        }
    }
}
