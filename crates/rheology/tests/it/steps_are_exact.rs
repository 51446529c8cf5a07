use casebook::assert_close;
use rheology::ExponentialStep;

use crate::support::{named_spectrum, spectrum};

/// Output of one point with an input, whose state moves on.
fn output(step: &ExponentialStep, input: f64, state: &mut [f64]) -> f64 {
    let mut history = [f64::NAN];
    step.history(state, &mut history);
    step.advance(&[input], state);
    step.response() * input + history[0]
}

/// x φ₁(x) = 1 − e^(−x) is the compliance of a single element.
#[test]
fn coefficients_keep_their_digits_at_any_ratio_of_step_and_time() {
    for case in casebook::group("RHE-08") {
        let x = case.input("x");
        // G = η δ(t) + 1 is a Kelvin-Voigt solid of J = 1 and λ = 1.
        let creep = spectrum(1.0, 1.0, &[], &[]).to_creep().unwrap();
        let creeping = ExponentialStep::creep(&creep, x).unwrap();
        case.check("phi1", creeping.response() / x);
        let mut state = [1.0];
        creeping.advance(&[0.0], &mut state);
        case.check("decay", state[0]);
    }
}

/// Steps of a constant load add up to the creep compliance, however long they are.
#[test]
fn constant_load_creeps_exactly_for_any_step() {
    let fluid = spectrum(0.0, 0.0, &[1.0, 2.0, 0.5], &[0.1, 3.0, 40.0]);
    for model in [named_spectrum("P3"), named_spectrum("P10"), fluid] {
        let creep = model.to_creep().unwrap();
        for time_step in [1e-9, 1e-3, 1.0, 1e5] {
            let step = ExponentialStep::creep(&creep, time_step).unwrap();
            let mut state = vec![0.0; step.n_fields()];
            for count in 1..=50 {
                let displacement = output(&step, 1.0, &mut state);
                let exact = creep.creep_compliance(time_step * f64::from(count));
                let exact = exact.unwrap();
                assert_close!(
                    displacement => exact,
                    within 1e-14; "{model:?}: J after {count} steps of {time_step}"
                );
            }
        }
    }
}

/// A linear load that turns meets the complex compliance up to the square of the step, and a held one to the first order.
#[test]
fn linear_loads_are_of_the_second_order() {
    for model in [named_spectrum("P3"), named_spectrum("P10")] {
        let creep = model.to_creep().unwrap();
        let omega = 1.0;
        let exact = creep.complex_compliance(omega).unwrap();
        let error = |step: &ExponentialStep, time_step: f64| {
            let got = step.harmonic_response(omega * time_step);
            (got.storage - exact.storage).hypot(got.loss - exact.loss)
        };
        let of = |time_step: f64| {
            let held = ExponentialStep::creep(&creep, time_step).unwrap();
            let linear = ExponentialStep::creep_linear(&creep, time_step).unwrap();
            assert!(linear.linear_share() >= 1.0, "{model:?}: no part is held");
            [error(&held, time_step), error(&linear, time_step)]
        };
        let [coarse, fine] = [of(0.02), of(0.01)];
        let ratios = [0, 1].map(|k| coarse[k] / fine[k]);
        assert!((1.8..2.2).contains(&ratios[0]), "{model:?}: {ratios:?}");
        assert!((3.8..4.2).contains(&ratios[1]), "{model:?}: {ratios:?}");
        assert!(fine[1] < 1e-4 * exact.storage, "{model:?}: {fine:?}");
    }
}

/// The state moves as the response of many steps says.
#[test]
fn linear_steps_follow_a_load_that_turns() {
    let creep = named_spectrum("P3").to_creep().unwrap();
    let (time_step, angle) = (0.3, 0.2_f64);
    let step = ExponentialStep::creep_linear(&creep, time_step).unwrap();
    let mut state = vec![0.0; step.n_fields()];
    let slowest = creep.elements().iter().map(|one| one.retardation_time);
    let n_steps = (40.0 * slowest.fold(0.0, f64::max) / time_step).ceil();
    let mut count = 0.0;
    while count < n_steps {
        output(&step, (angle * count).cos(), &mut state);
        count += 1.0;
    }
    let (sin, cos) = (angle * count).sin_cos();
    let response = step.harmonic_response(angle);
    let got = output(&step, cos, &mut state);
    assert_close!(got => response.storage * cos + response.loss * sin, within 1e-11);
}

/// A load that rises evenly leaves the integral of the creep compliance, for any step.
#[test]
fn a_ramp_creeps_exactly() {
    let creep = named_spectrum("P3").to_creep().unwrap();
    for time_step in [1e-3, 1.0, 1e3] {
        let step = ExponentialStep::creep_linear(&creep, time_step).unwrap();
        let mut state = vec![0.0; step.n_fields()];
        for count in 1..=20 {
            let count = f64::from(count);
            let got = output(&step, count, &mut state);
            // ∫₀ᵗ J dt/Δt, of a load of one per step.
            let time = count * time_step;
            let delayed = creep.elements().iter().map(|one| {
                let part = one.retardation_time * -(-time / one.retardation_time).exp_m1();
                one.compliance * (time - part)
            });
            let exact = creep.instantaneous_compliance() * time + delayed.sum::<f64>();
            assert_close!(got => exact / time_step, within 1e-11; "{time_step}");
        }
    }
}

/// Where a surface that is pushed would answer the load of a step with minus that of the step before, loads are held.
#[test]
fn loads_without_instantaneous_compliance_are_held_over_short_steps() {
    let dashpot = spectrum(0.0, 1.0, &[], &[]).to_creep().unwrap();
    let step = ExponentialStep::creep_linear(&dashpot, 0.1).unwrap();
    assert!(step.linear_share() <= 0.0, "all of it is held: {step:?}");
    assert_close!(step.response() => 0.1, within 1e-15);
    let kelvin_voigt = spectrum(1.0, 1.0, &[], &[]).to_creep().unwrap();
    for (time_step, expected) in [(1e-3, 0.0..0.01), (0.5, 0.01..0.99), (10.0, 1.0..1.1)] {
        let step = ExponentialStep::creep_linear(&kelvin_voigt, time_step).unwrap();
        let share = step.linear_share();
        assert!(expected.contains(&share), "{time_step}: {share}");
    }
}
