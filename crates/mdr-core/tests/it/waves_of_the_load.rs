//! The waves of the load dissipate what friction takes: on a line w = G* u of every wave, so that
//! F_h v = 4 ∫₀^∞ |ŵ(k)|² ω J''(ω) dk/π with ω = k v.

use std::f64::consts::PI;

use indenters::{EquivalentLine, PowerProfile};
use mdr_core::{slide, steady};
use numerics::{Accuracy, fourier_power};
use rheology::{Material, Prony};

use crate::support::{load, prony};

/// The integral over waves, equally spaced in their logarithm, for a load per length 4 w.
fn power(load: &[[f64; 2]], material: &dyn Material, velocity: f64) -> f64 {
    let (first, last) = (load[0], load[load.len() - 1]);
    let steps = 800;
    let of_wave = |step: i32| {
        let wave = 10_f64.powf(f64::from(step) / 80.0 - 4.0) / (last[0] - first[0]);
        let compliance = material.complex_compliance(wave * velocity);
        let loss = compliance.expect("a frequency").loss;
        fourier_power(load, wave) * (wave * velocity * loss) * wave
    };
    (0..steps).map(of_wave).sum::<f64>() * (10_f64.ln() / 80.0) / (4.0 * PI)
}

#[test]
fn waves_of_the_load_dissipate_what_friction_takes() {
    let solid = || prony([1e6, 0.0], &[(1e7, 1e-3)]);
    let cases: [(f64, Prony, f64); 6] = [
        (1.0, prony([0.0, 1e4], &[]), 0.1),
        (2.0, prony([1e6, 2e2], &[]), 0.1),
        (2.0, prony([0.0, 0.0], &[(1e6, 1e-2)]), 0.1),
        (2.0, solid(), 1e-2),
        (2.0, solid(), 10.0),
        // What is left behind the contact touches again, or the load jumps at the edge of a piece.
        (1.5, prony([1e5, 0.0], &[(1e8, 1e-4), (1e6, 0.1)]), 0.3),
    ];
    for (exponent, material, velocity) in cases {
        let body = PowerProfile::new(if exponent > 1.0 { 50.0 } else { 0.1 }, exponent);
        let (body, motion) = (body.expect("a body"), load(2.0, velocity));
        let line = EquivalentLine(&body);
        let state = steady(&line, &material, &motion, 1e-6).expect("a state");
        let marched = slide(&line, &material, &motion, Accuracy::Elements(400)).expect("a march");
        let friction = state.friction_coefficient.value * 2.0 * velocity;
        let case = format!("{exponent}, {velocity} m/s, {} points", state.load.len());
        for (load, within) in [(&state.load, 2e-3), (&marched.load, 5e-3)] {
            let part = power(load, &material, velocity) / friction;
            assert!((part - 1.0).abs() <= within, "{case}: {part}");
        }
    }
}
