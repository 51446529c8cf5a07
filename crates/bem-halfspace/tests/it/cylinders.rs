//! A cylinder slides in plane strain as in closed form (Hunter 1961) and as in the spectral reference (Morland 1967); and
//! waves on a long one, in full contact over twelve decades of speed, rub as in their closed form.

use std::f64::consts::{PI, TAU};
use std::fmt::Debug;

use bem_halfspace::steady::{
    LineEstimate, LineOptions, SteadyOptions, SteadySliding, steady_line, steady_line_on_grid,
    steady_on_grid,
};
use bem_halfspace::{BemError, Footprint};
use casebook::group;
use friction_analytic::{
    CylinderSliding, LineContact, SurfaceWave, cylinder_sliding, wavy_surface_sliding,
};
use indenters::Cylinder;
use numerics::Estimate;
use rheology::{Material, Prony};

use crate::support::{Formula, assert_bar, assert_close, assert_near, three_elements, under_force};

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
        let (material, velocity) = (three_elements(gamma, 1.0, 1.0), z.recip());
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

    fn solve(&self, relative_error: f64) -> Result<LineEstimate, BemError> {
        let load = under_force(self.line_load, self.velocity);
        steady_line(&unit_cylinder(), &self.material, &load, relative_error)
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
    for gamma in [0.01, 0.1, 1.0] {
        for z in [0.1, 0.3, 1.0, 3.0, 20.0] {
            let (scene, exact) = Scene::hunter(gamma, z);
            let expected = exact.friction_coefficient;
            for relative_error in [1e-2, 1e-3, 1e-4, 3e-5, 1e-5] {
                scene.check((gamma, z), relative_error, expected);
            }
            let known = match scene.solve(1e-6) {
                Err(BemError::NotReached { value, error, .. }) => Estimate { value, error },
                state => state.expect("a state").friction_coefficient,
            };
            assert_near((gamma, z), known.value, expected, known.error);
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
    for (gamma, z) in [(0.1, 0.1), (0.1, 2.0), (0.01, 5.0), (1.0, 0.5), (1.0, 20.0)] {
        let (scene, exact) = Scene::hunter(gamma, z);
        let load = under_force(scene.line_load, scene.velocity);
        let state = steady_line_on_grid(&unit_cylinder(), &scene.material, &load, &options);
        let state = state.expect("a solution");
        let carried: f64 = state.pressure.iter().map(|[_, p]| p * spacing).sum();
        assert_close((gamma, z), carried, scene.line_load, 1e-12);
        for (end, expected) in state.contact.into_iter().zip(exact.contact) {
            assert_near((gamma, z), end, expected, 2.0 * spacing);
        }
        // Where no end is nearer than four elements.
        let [rear, front] = exact.contact;
        let peak = state.pressure.iter().map(|[_, p]| *p).fold(0.0, f64::max);
        for [x, pressure] in state.pressure {
            if x - rear > 4.0 * spacing && front - x > 4.0 * spacing {
                assert_near((gamma, z, x), pressure, exact.pressure(x), 0.02 * peak);
            }
        }
    }
}

/// In units of about half the length of the contact.
const WAVELENGTH: f64 = 0.5;
const AMPLITUDE: f64 = 1e-5;
const LENGTH: f64 = 1e6;
const WAVE_NUMBER: f64 = TAU / WAVELENGTH;
const SPACING: f64 = WAVELENGTH / 24.0;

/// Presses h = x²/2 + A cos kx between its ends.
fn press(amplitude: f64, material: &dyn Material, velocity: f64) -> SteadySliding {
    let wavy_cylinder = Formula::new([true; 2], |[x, y]| {
        let (sine, cosine) = (WAVE_NUMBER * x).sin_cos();
        let wavy = 0.5 * x * x + amplitude * (1.0 + cosine);
        let is_body = y.abs() <= 0.5 * LENGTH;
        let height = if is_body { wavy } else { f64::INFINITY };
        (height, [x - amplitude * WAVE_NUMBER * sine, 0.0])
    });
    let (x, y) = ([-3.0, 5.0], [-LENGTH, LENGTH]);
    let options = SteadyOptions {
        phase: [0.5, 0.0],
        ..SteadyOptions::new([SPACING, LENGTH / 3.0], Footprint { x, y })
    };
    let compliance = material.creep().creep_compliance(1.0 / velocity);
    let force = 3.0 / compliance.expect("a compliance") * LENGTH;
    let load = under_force(force, velocity);
    steady_on_grid(&wavy_cylinder, material, &load, &options).expect("a solution")
}

/// Amplitude of the pressure that the waves add in the middle of the contact: in phase with their troughs, and with
/// their flanks that face the motion. Two wavelengths count, fading in and out.
fn added_pressure(material: &dyn Material, velocity: f64) -> [f64; 2] {
    let [plain, wavy] = [0.0, AMPLITUDE].map(|amplitude| press(amplitude, material, velocity));
    let middle = 0.5 * (plain.contact_x[0] + plain.contact_x[1]);
    let ([mut trough, mut flank], mut weights) = ([0.0; 2], 0.0);
    for step in -200..=200 {
        let x = SPACING * (f64::from(step) + 0.5);
        let place = (x - middle) / (2.0 * WAVELENGTH);
        if place.abs() < 0.5 {
            let weight = (PI * place).cos().powi(2);
            let added = wavy.pressure.at([x, 0.0]) - plain.pressure.at([x, 0.0]);
            let (sine, cosine) = (WAVE_NUMBER * x).sin_cos();
            trough -= weight * added * cosine;
            flank -= weight * added * sine;
            weights += weight;
        }
    }
    [trough, flank].map(|sum| 2.0 * sum / weights)
}

/// With 24 elements per wave both parts of the pressure are off by less than 2 % of the whole, over twelve decades of
/// speed. Up to v = λ/τ, where the loss is not small beside what the waves change at the edges of the contact, the
/// friction is off by less than 1 %.
#[test]
fn waves_in_full_contact_press_and_rub_as_their_complex_modulus_says() {
    let material = three_elements(0.01, 1.0, 1.0);
    let wave = SurfaceWave {
        amplitude: AMPLITUDE,
        wave_vector: [WAVE_NUMBER, 0.0],
    };
    for decade in [-6, -4, -3, -2, -1, 0, 1, 2, 4, 6] {
        let velocity = 10_f64.powi(decade);
        let expected = wavy_surface_sliding(&[wave], &material, velocity).expect("full contact");
        let amplitude = expected.full_contact_pressure;
        let loss = 2.0 * expected.friction_coefficient / (WAVE_NUMBER * AMPLITUDE);
        let [trough, flank] = added_pressure(&material, velocity).map(|part| part / amplitude);
        let what = |name| (name, velocity, amplitude);
        assert_near(what("storage"), trough, (1.0 - loss * loss).sqrt(), 0.02);
        assert_near(what("loss"), flank, loss, 0.02);
        if velocity <= 1.0 {
            assert_near(what("friction"), flank / loss, 1.0, 0.01);
        }
    }
}
