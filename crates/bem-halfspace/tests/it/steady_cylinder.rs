//! A cylinder slides in plane strain as in closed form (Hunter 1961) and as in the spectral reference (Morland 1967).

use std::f64::consts::PI;

use bem_halfspace::BemError;
use bem_halfspace::steady::{
    LineFriction, LineLadder, LineOptions, steady_line, steady_line_friction,
};
use casebook::group;
use indenters::{Cylinder, SlidingLoad};
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

    fn ladder(&self) -> LineLadder {
        let ladder = LineLadder::of_profile(&unit_cylinder(), &*self.material, &self.load());
        ladder.expect("a ladder")
    }

    fn friction(&self, relative_error: f64) -> Result<LineFriction, BemError> {
        let scene = (&*self.material, &self.load());
        steady_line_friction(&unit_cylinder(), scene, &self.ladder(), relative_error)
    }

    fn check(&self, name: &str, relative_error: f64, expected: f64) {
        let LineFriction {
            friction_coefficient,
            error,
            ..
        } = self.friction(relative_error).expect("a friction");
        assert!(
            (friction_coefficient - expected).abs() <= error && error <= relative_error * expected,
            "{name}: {friction_coefficient} ± {error} instead of {expected}"
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

/// A load that acts only on slopes that meet it has their mean as friction, whatever the gaps; a slow cylinder is met on
/// both sides.
#[test]
fn gaps_are_a_part_of_the_error_where_slopes_of_both_signs_are_loaded() {
    for (scene, has_gaps) in [
        (hunter([0.1, 2.0, 6.612]), false),
        (hunter([1.0, 100.0, 1.0]), true),
    ] {
        let LineFriction {
            error, gap_error, ..
        } = scene.friction(1e-2).expect("a friction");
        assert_eq!(gap_error > 0.0, has_gaps, "part of the gaps: {gap_error:e}");
        assert!(
            gap_error < error,
            "{gap_error:e} of gaps in an error of {error:e}"
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
            footprint: scene.ladder().footprint,
            tolerance: 1e-10,
            max_iterations: 500,
        };
        let state = steady_line(&unit_cylinder(), &*scene.material, &scene.load(), &options);
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
        let ladder = LineLadder::of_profile(&cylinder, &material, &load).expect("a ladder");
        steady_line_friction(&cylinder, (&material, &load), &ladder, 1e-2).expect("a friction")
    };
    let expected = friction([1.0; 3]).friction_coefficient;
    for scale in [1e-12, 1e12] {
        for units in [[scale, 1.0, 1.0], [1.0, scale, 1.0], [1.0, 1.0, scale]] {
            let actual = friction(units).friction_coefficient;
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
        let ladder = LineLadder::of_profile(&unit_cylinder(), &*material, &load);
        assert!(
            matches!(
                ladder,
                Err(BemError::InvalidParameter {
                    parameter: "fluidity",
                    value: 0.5,
                    ..
                })
            ),
            "{material:?}: {ladder:?}"
        );
    }
}
