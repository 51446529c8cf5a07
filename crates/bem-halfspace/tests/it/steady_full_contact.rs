//! Waves on a long cylinder, in full contact over twelve decades of speed, rub as in their closed form.

use std::f64::consts::{PI, TAU};

use bem_halfspace::Footprint;
use bem_halfspace::steady::{SteadyOptions, SteadySliding, steady_on_grid};
use friction_analytic::{SurfaceWave, wavy_surface_sliding};
use rheology::Material;

use crate::support::{Formula, assert_near, three_elements, under_force};

/// In units of about half the length of the contact.
const WAVELENGTH: f64 = 0.5;
const AMPLITUDE: f64 = 1e-5;
const LENGTH: f64 = 1e6;
const WAVE_NUMBER: f64 = TAU / WAVELENGTH;
const SPACING: f64 = WAVELENGTH / 24.0;

/// Presses h = x²/2 + A cos kx between its ends.
fn press(amplitude: f64, material: &dyn Material, velocity: f64) -> SteadySliding {
    let height = |[x, y]: [f64; 2]| {
        if y.abs() > 0.5 * LENGTH {
            f64::INFINITY
        } else {
            0.5 * x * x + amplitude * (1.0 + (WAVE_NUMBER * x).cos())
        }
    };
    let slope = |x: f64| x - amplitude * WAVE_NUMBER * (WAVE_NUMBER * x).sin();
    let wavy_cylinder = Formula {
        mirrors: [true; 2],
        ..Formula::new(height, |[x, _]: [f64; 2]| [slope(x), 0.0])
    };
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
