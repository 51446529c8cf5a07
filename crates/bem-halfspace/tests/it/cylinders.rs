//! A cylinder slides in plane strain as in closed form (Hunter 1961) and as in the spectral reference (Morland 1967).

use std::fmt::Debug;

use bem_halfspace::steady::{
    SteadyBody::Line, SteadyEstimate, SteadyOptions, steady, steady_on_grid,
};
use bem_halfspace::{BemError, Footprint};
use casebook::group;
use friction_analytic::{CylinderSliding, LineContact, cylinder_sliding};
use indenters::Cylinder;
use numerics::Estimate;
use rheology::{Prony, RelaxationSpectrum};

use crate::support::{assert_bar, assert_close, assert_near, three_elements, under_force};

/// A material, the speed, and the load per length of a cylinder of radius 1; of a contact of half the length 1 if it is
/// Hunter's.
struct Scene {
    material: Prony,
    velocity: f64,
    line_load: f64,
}

fn unit_cylinder() -> Cylinder {
    Cylinder::new(1.0).expect("a cylinder")
}

impl Scene {
    /// G₁ = τ = 1, with G_∞ = γ and τ v = 1/z, and Hunter's closed form.
    fn hunter(gamma: f64, z: f64) -> (Self, CylinderSliding) {
        Self::on(three_elements(gamma, 1.0, 1.0), z.recip())
    }

    fn on(material: Prony, velocity: f64) -> (Self, CylinderSliding) {
        let contact = LineContact {
            half_length: 1.0,
            velocity,
        };
        let exact = cylinder_sliding(&unit_cylinder(), &material, contact).expect("a state");
        let scene = Self {
            material,
            velocity,
            line_load: exact.line_load,
        };
        (scene, exact)
    }

    fn solve(&self, relative_error: f64) -> Result<SteadyEstimate, BemError> {
        let load = under_force(self.line_load, self.velocity);
        steady(
            Line(&unit_cylinder()),
            &self.material,
            &load,
            relative_error,
        )
    }

    fn check(&self, what: impl Debug, relative_error: f64, expected: f64) {
        let state = self.solve(relative_error).expect("a state");
        let friction = state.friction_coefficient;
        assert_bar(what, friction, expected, relative_error);
    }
}

/// Only 1e-6 may be refused, and the number that the refusal carries is within its error too.
#[test]
fn a_cylinder_on_a_three_element_solid_is_hunters_within_the_error_bar() {
    for (row, gamma) in [0.01, 0.1, 1.0].into_iter().enumerate() {
        for (column, z) in [0.1, 0.3, 1.0, 3.0, 20.0].into_iter().enumerate() {
            let (scene, exact) = Scene::hunter(gamma, z);
            let expected = exact.friction_coefficient;
            for relative_error in [1e-2, 1e-3, 1e-4, 3e-5, 1e-5] {
                scene.check((gamma, z), relative_error, expected);
            }
            // The finest in half of the cases, with each solid and at each speed.
            if (row + column) % 2 == 1 {
                continue;
            }
            let known = match scene.solve(1e-6) {
                Err(BemError::NotReached { value, error, .. }) => Estimate::new(value, error),
                state => state.expect("a state").friction_coefficient,
            };
            assert_near((gamma, z), known.value, expected, known.error);
        }
    }
    // A solid of Kelvin and Voigt that forgets within an element or two.
    let spectrum = RelaxationSpectrum::new(1.0, 1.0, Vec::new()).expect("a spectrum");
    let solid = Prony::new(spectrum).expect("a solid");
    for velocity in [0.0482, 0.0584, 0.0672, 0.0979] {
        let (scene, exact) = Scene::on(solid.clone(), velocity);
        for relative_error in [1e-2, 6e-3, 3e-3, 1e-3] {
            scene.check(velocity, relative_error, exact.friction_coefficient);
        }
    }
    // Slow and fast cylinders, and stiff solids.
    let extreme = [(1e-6, 1.0), (1e-3, 1e-3), (1e3, 1.0), (1e-3, 30.0)];
    let extreme_speeds = [1e-6, 1e-3, 1e6].map(|z| (1.0, z));
    for (gamma, z) in extreme.into_iter().chain(extreme_speeds) {
        let (scene, exact) = Scene::hunter(gamma, z);
        scene.check((gamma, z), 1e-2, exact.friction_coefficient);
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

/// Elements along x, with values along y that have no effect.
fn grid(spacing: f64, x: [f64; 2]) -> SteadyOptions {
    SteadyOptions::new([spacing; 2], Footprint { x, y: [-1.0, 1.0] })
}

/// The pressure sums up to the load, and the contact ends within two elements of where Hunter's does.
#[test]
fn one_grid_carries_the_load_between_the_ends_of_the_contact() {
    let spacing = 1.0 / 32.0;
    let options = SteadyOptions {
        phase: [0.25, 0.0],
        tolerance: 1e-10,
        ..grid(spacing, [-3.0, 5.0])
    };
    for (gamma, z) in [(0.1, 0.1), (0.1, 2.0), (0.01, 5.0), (1.0, 0.5), (1.0, 20.0)] {
        let (scene, exact) = Scene::hunter(gamma, z);
        let load = under_force(scene.line_load, scene.velocity);
        let state = steady_on_grid(Line(&unit_cylinder()), &scene.material, &load, &options);
        let state = state.expect("a solution");
        let carried: f64 = state.pressure.pressure.iter().map(|p| p * spacing).sum();
        assert_close((gamma, z), carried, scene.line_load, 1e-12);
        for (end, expected) in state.contact_x.into_iter().zip(exact.contact) {
            assert_near((gamma, z), end, expected, 2.0 * spacing);
        }
        // Where no end is nearer than four elements.
        let [rear, front] = exact.contact;
        let peak = state.pressure.largest();
        for [x, pressure] in state.pressure.along_x() {
            if x - rear > 4.0 * spacing && front - x > 4.0 * spacing {
                assert_near((gamma, z, x), pressure, exact.pressure(x), 0.02 * peak);
            }
        }
    }
}

/// It has sunk so deep that the depth alone has a larger rounding than the tolerance.
#[test]
fn a_long_memory_does_not_keep_a_line_from_any_tolerance() {
    let (scene, _) = Scene::hunter(1e-4, 1e-7);
    let load = under_force(scene.line_load, scene.velocity);
    let friction = |tolerance: f64| {
        let options = SteadyOptions {
            tolerance,
            max_iterations: 100,
            ..grid(1.0 / 16.0, [-3.0, 3.0])
        };
        let state = steady_on_grid(Line(&unit_cylinder()), &scene.material, &load, &options);
        state.expect("a state").friction_coefficient
    };
    let [rough, fine] = [1e-6, 1e-13].map(friction);
    assert!((rough - fine).abs() <= 1e-6, "{rough}, {fine}");
}
