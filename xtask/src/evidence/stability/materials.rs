//! Materials: steps of any length, time constants over fifteen decades, springs that vanish.

use anyhow::Result;
use rheology::{
    ExponentialStep, KelvinVoigt, Material, Maxwell, Prony, RelaxationBranch, RelaxationSpectrum,
    Springpot,
};

use super::case::{Comparison, Finding, compare};
use crate::scene::solid;

/// A few roundings.
const ROUNDING: f64 = 8.0 * f64::EPSILON;

/// The response to two steps of a length, of which the first is held over the second.
fn two_steps(step: &ExponentialStep, first: f64) -> (f64, f64) {
    let mut state = vec![0.0; step.n_fields()];
    let mut held = [0.0];
    step.advance(&[first], &mut state);
    step.history(&state, &mut held);
    (step.response(), held[0])
}

/// Two steps from rest under constant load are J(2Δt) w, and one step is J(Δt) w.
pub(super) fn creep_steps(ratio: f64) -> Result<Finding> {
    let material = KelvinVoigt::new(1.0, 1.0)?;
    let (response, history) = two_steps(&ExponentialStep::creep(&material.creep(), ratio)?, 1.0);
    let exact = |time: f64| -(-time).exp_m1();
    compare!(within ROUNDING;
        "first step" => response, exact(ratio);
        "second step" => response + history, exact(2.0 * ratio))
}

/// A ramp u = t over one step, held over a second: φ(x), then φ(x) e^(−x), times the strain of the first.
pub(super) fn relaxation_steps(ratio: f64) -> Result<Finding> {
    let relaxation = Maxwell::new(1.0, 1.0)?.relaxation();
    let (response, held) = two_steps(&ExponentialStep::relaxation(&relaxation, ratio)?, ratio);
    let ramp = -(-ratio).exp_m1();
    compare!(within ROUNDING;
        "ramp" => response * ratio, ramp;
        "held" => held, ramp * (-ratio).exp())
}

/// Sixteen branches of different moduli, over so many decades of time constants around 1 s.
pub(super) fn prony_over(n_decades: f64) -> Result<Prony> {
    let branch = |index: i32| RelaxationBranch {
        modulus: 1.0 + 0.5 * f64::from(index).sin(),
        relaxation_time: 10_f64.powf(n_decades * (f64::from(index) / 15.0 - 0.5)),
    };
    let branches = (0..16).map(branch).collect();
    Ok(Prony::new(RelaxationSpectrum::new(0.1, 0.0, branches)?)?)
}

pub(super) fn many_branches(n_decades: f64) -> Result<Finding> {
    reciprocal_spectra(&prony_over(n_decades)?.relaxation())
}

/// The same two branches whether they are told apart or not: 1/(1 + ε) and 1 have nearly the moduli of one branch.
///
/// Times closer than one part in 10⁸ become one, which moves a modulus by the square of that.
pub(super) fn close_branches(difference: f64) -> Result<Finding> {
    let branches = [1.0, 1.0 + difference].map(|relaxation_time| RelaxationBranch {
        modulus: 1.0,
        relaxation_time,
    });
    reciprocal_spectra(&RelaxationSpectrum::new(1.0, 0.0, branches.to_vec())?)
}

/// s Ĝ(s) · s Ĵ(s) = 1 on s = iω, over all time constants and three decades beyond.
fn reciprocal_spectra(relaxation: &RelaxationSpectrum) -> Result<Finding> {
    let creep = relaxation.to_creep()?;
    let mut comparisons = Vec::new();
    for tenth in -105..=105 {
        let omega = 10_f64.powf(0.1 * f64::from(tenth));
        let stiff = relaxation.complex_modulus(omega)?;
        let soft = creep.complex_compliance(omega)?;
        let size = stiff.storage.hypot(stiff.loss) * soft.storage.hypot(soft.loss);
        // (G' + iG'')(J' − iJ'') = 1
        let real = stiff.storage * soft.storage + stiff.loss * soft.loss;
        let imaginary = stiff.loss * soft.storage - stiff.storage * soft.loss;
        let compare = |quantity, got, expected| {
            Comparison::relative(quantity, got, expected, 1e-13).in_units_of(size)
        };
        comparisons.push(compare("real part", real, 1.0));
        comparisons.push(compare("imaginary part", imaginary, 0.0));
    }
    Ok(Finding::of(&comparisons))
}

/// Retardation time (1 + γ)/γ, compliance 1/(γ (1 + γ)), largest loss tangent 1/(2 √(γ (1 + γ))), J(1) by Taylor where
/// the spring hardly acts.
pub(super) fn three_elements(gamma: f64) -> Result<Finding> {
    let solid = solid(gamma)?;
    let creep = solid.creep();
    let element = creep.elements()[0];
    let rate = gamma / (1.0 + gamma);
    let delayed = -(-rate).exp_m1() / (gamma * (1.0 + gamma));
    let peak = 0.5 / (gamma * (1.0 + gamma)).sqrt();
    compare!(within ROUNDING;
        "retardation time" => element.retardation_time, 1.0 / rate;
        "delayed compliance" => element.compliance, 1.0 / (gamma * (1.0 + gamma));
        "compliance at τ" => solid.creep_compliance(1.0)?, 1.0 / (1.0 + gamma) + delayed;
        "largest loss tangent" => solid.loss_peak().loss_tangent, peak)
}

/// The series promises its error in a band of eight decades; between the samples that it was fitted to it may exceed it
/// by little.
pub(super) fn springpot(exponent: f64) -> Result<Finding> {
    let element = Springpot::new(1.0, exponent)?;
    let expansion = element.expand([1e-4, 1e4], 1e-6)?;
    let mut comparisons = Vec::new();
    for step in -40..=40 {
        let omega = 10_f64.powf(0.1 * f64::from(step));
        let exact = element.complex_modulus(omega)?;
        let series = expansion.spectrum.complex_modulus(omega)?;
        let size = exact.storage.hypot(exact.loss);
        let compare = |quantity, got, expected| {
            Comparison::relative(quantity, got, expected, 1.01e-6).in_units_of(size)
        };
        comparisons.push(compare("storage modulus", series.storage, exact.storage));
        comparisons.push(compare("loss modulus", series.loss, exact.loss));
    }
    Ok(Finding::of(&comparisons))
}
