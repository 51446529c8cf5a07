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
