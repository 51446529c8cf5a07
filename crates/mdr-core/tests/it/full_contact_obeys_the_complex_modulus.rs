//! In full contact a wavy line measures G''(k v) (casebook FRI-06): every further wave adds the same friction.

use std::f64::consts::TAU;

use friction_analytic::{WavyLine, wavy_sliding};
use indenters::AnalyticLine;
use mdr_core::steady;

use crate::support::{assert_close, at_depth, model};

/// Friction force \[N] of `n_waves` of amplitude 1 and length 1 behind a runner.
fn friction(n_waves: f64, mean_depth: f64, velocity: f64) -> f64 {
    let height = |x: f64| {
        if x > 0.0 {
            1.0 + 40.0 * x * x
        } else {
            (TAU * x).cos()
        }
    };
    let slope = |x: f64| {
        if x > 0.0 {
            80.0 * x
        } else {
            -TAU * (TAU * x).sin()
        }
    };
    let line = AnalyticLine::new(height, slope, [-n_waves, 1.0]).expect("a line");
    // The lowest point lies one amplitude below the mean.
    let load = at_depth(mean_depth + 1.0, velocity);
    let state = steady(&line, &model("W4"), &load, 1e-11).expect("a state");
    assert_eq!(state.contacts.len(), 1, "full contact: {state:?}");
    state.friction_coefficient.value * state.normal_force.value
}

/// Forty waves later nothing is left of the front, except from a branch that relaxes over ten waves, e⁻⁴⁰ of it too.
#[test]
fn every_wave_has_the_friction_of_the_loss_modulus() {
    for velocity in [1e-9, 1e-3, 0.01, 0.1] {
        let line = WavyLine {
            amplitude: 1.0,
            wavelength: 1.0,
            velocity,
        };
        let expected = wavy_sliding(line, &model("W4")).expect("full contact");
        let depth = 1.5 * expected.least_depth;
        let [before, after] = [40.0, 41.0].map(|n_waves| friction(n_waves, depth, velocity));
        // The difference of two sums of forty waves.
        let friction = expected.friction_per_length;
        assert_close([after - before, friction], 1e-8, 0.0, &(velocity, before));
    }
}
