//! A cylinder slides in plane strain as in closed form (Hunter 1961) and as in the spectral reference (Morland 1967).

use std::f64::consts::PI;

use bem_halfspace::BemError;
use bem_halfspace::steady::{LineEstimate, LineOptions, steady_line, steady_line_on_grid};
use casebook::group;
use indenters::{Cylinder, SlidingLoad};
use numerics::Estimate;
use rheology::{
    Material, Maxwell, Prony, RelaxationBranch, RelaxationSpectrum, StandardSolid,
    StandardSolidParameters, Viscous,
};

/// A material, the speed, and the load per length of a cylinder of radius 1 with a contact of the half length 1.
struct Scene {
    material: Box<dyn Material>,
    velocity: f64,
    line_load: f64,
}

impl Scene {
    fn load(&self) -> SlidingLoad {
        SlidingLoad::new(self.line_load, self.velocity).expect("a valid load")
    }

    fn solve(&self, relative_error: f64) -> LineEstimate {
        let solved = steady_line(
            &unit_cylinder(),
            &*self.material,
            &self.load(),
            relative_error,
        );
        solved.expect("a friction coefficient")
    }

    fn check(&self, name: &str, relative_error: f64, expected: f64) {
        let Estimate { value, error } = self.solve(relative_error).friction_coefficient;
        assert!(
            (value - expected).abs() <= error && error <= relative_error * expected,
            "{name}: {value} ± {error} instead of {expected}"
        );
    }
}

fn unit_cylinder() -> Cylinder {
    Cylinder::new(1.0).expect("a cylinder")
}

/// Lengths in units of half the contact l, times in those of τ: the speed is 1/z, the load P π G₁.
fn hunter([gamma, z, load]: [f64; 3]) -> Scene {
    let material = StandardSolid::new(StandardSolidParameters {
        equilibrium_modulus: gamma,
        maxwell_modulus: 1.0,
        viscosity: 1.0,
    });
    Scene {
        material: Box::new(material.expect("a material")),
        velocity: 1.0 / z,
        line_load: load * PI * gamma,
    }
}

#[test]
fn a_cylinder_on_a_three_element_solid_is_hunters_within_the_error_bar() {
    for case in group("VIS-04") {
        let load = case.expected("P").expect("a load");
        let scene = hunter([case.input("gamma"), case.input("z"), load]);
        let expected = case.expected("muR_over_l").expect("a friction coefficient");
        for relative_error in [1e-2, 1e-3, 1e-4] {
            scene.check(case.id(), relative_error, expected);
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
        let scene = hunter([gamma, z, load]);
        scene.check(&format!("γ = {gamma}, z = {z}"), 1e-2, expected);
    }
}

/// What the solver leaves is a part of the bar, whether slopes of one sign or of both are loaded.
#[test]
fn the_residual_is_a_part_of_the_error() {
    for scene in [hunter([0.1, 2.0, 6.612]), hunter([1.0, 100.0, 1.0])] {
        let estimate = scene.solve(1e-2);
        let (bar, parts) = (estimate.friction_coefficient.error, estimate.error_parts);
        let iteration = parts.iteration.expect("a part");
        assert!(
            iteration > 0.0 && iteration < bar && (parts.sum() / bar - 1.0).abs() < 1e-12,
            "{parts:?} of {bar:e}"
        );
    }
}

#[test]
fn a_cylinder_on_three_branches_is_that_of_the_spectral_reference() {
    for case in group("VIS-05") {
        let moduli = case.input_list("G");
        let times = case.input_list("tau");
        let branch = |(&modulus, &relaxation_time): (&f64, &f64)| RelaxationBranch {
            modulus,
            relaxation_time,
        };
        let branches = moduli.iter().zip(&times).map(branch).collect();
        let spectrum =
            RelaxationSpectrum::new(case.input("Ge"), 0.0, branches).expect("a spectrum");
        let scene = Scene {
            material: Box::new(Prony::new(spectrum).expect("a material")),
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
    for case in group("VIS-04") {
        let load = case.expected("P").expect("a load");
        let scene = hunter([case.input("gamma"), case.input("z"), load]);
        let spacing = 1.0 / 32.0;
        let options = LineOptions {
            spacing,
            phase: 0.25,
            footprint: [-3.0, 5.0],
            tolerance: 1e-10,
            max_iterations: 500,
        };
        let state =
            steady_line_on_grid(&unit_cylinder(), &*scene.material, &scene.load(), &options);
        let state = state.expect("a solution");
        let carried: f64 = state.pressure.iter().map(|[_, p]| p * spacing).sum();
        assert!(
            (carried / scene.line_load - 1.0).abs() < 1e-12,
            "{}: {carried} of {} N/m",
            case.id(),
            scene.line_load
        );
        let middle = case.expected("x0_over_l").expect("a middle");
        for (end, expected) in state.contact.into_iter().zip([middle - 1.0, middle + 1.0]) {
            assert!(
                (end - expected).abs() < 2.0 * spacing,
                "{}: the contact ends at {end} instead of {expected}",
                case.id()
            );
        }
    }
}

#[test]
fn units_do_not_matter() {
    let friction = |[length, stress, time]: [f64; 3]| {
        let material = StandardSolid::new(StandardSolidParameters {
            equilibrium_modulus: 0.1 * stress,
            maxwell_modulus: stress,
            viscosity: stress * time,
        })
        .expect("a material");
        let load = SlidingLoad::new(stress * length, length / time).expect("a load");
        let cylinder = Cylinder::new(length).expect("a cylinder");
        let solved = steady_line(&cylinder, &material, &load, 1e-2).expect("a friction");
        solved.friction_coefficient.value
    };
    let expected = friction([1.0; 3]);
    for scale in [1e-12, 1e12] {
        for units in [[scale, 1.0, 1.0], [1.0, scale, 1.0], [1.0, 1.0, scale]] {
            let actual = friction(units);
            assert!(
                (actual / expected - 1.0).abs() < 1e-9,
                "units {units:?}: {actual} instead of {expected}"
            );
        }
    }
}

/// Under a line load a surface that flows sinks without limit.
#[test]
fn a_half_space_that_flows_is_refused() {
    let materials: [Box<dyn Material>; 2] = [
        Box::new(Viscous::new(2.0).expect("a material")),
        Box::new(Maxwell::new(1.0, 2.0).expect("a material")),
    ];
    let load = SlidingLoad::new(1.0, 1.0).expect("a load");
    for material in materials {
        let refused = steady_line(&unit_cylinder(), &*material, &load, 1e-2).err();
        assert!(
            matches!(
                refused,
                Some(BemError::InvalidParameter {
                    parameter: "fluidity",
                    value: 0.5,
                    ..
                })
            ),
            "{material:?}: {refused:?}"
        );
    }
}
