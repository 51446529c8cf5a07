use casebook::{assert_close, fixed_cases};
use friction_analytic::{FrictionError, power_sliding, stationary_depth};
use indenters::stretch;
use proptest::prelude::*;

use crate::support::{material_and_load, power, sliding};

#[test]
fn power_profiles_slide_in_closed_form() {
    for case in casebook::group("FRI-01") {
        let p = case.input("p");
        let profile = power(case.input("c"), p);
        let (material, load) = sliding(&case);
        case.check("d", stationary_depth(&material, &load));
        match power_sliding(&profile, &material, &load) {
            Ok(state) => {
                let mu = state.friction_coefficient;
                case.check("d", state.indentation_depth);
                case.check("x_d", state.contact_length());
                case.check("mu", mu);
                // The estimate of the rounding is honest. The table was made for the decimal p, whose last place
                // weighs 1/(2p − 1).
                let decimal = f64::EPSILON / (2.0 * p - 1.0);
                case.check_within("mu", mu, state.error / mu + decimal);
            }
            Err(FrictionError::FrictionDiverges {
                indentation_depth,
                contact_length,
                ..
            }) => {
                let expected = case.expected_error();
                assert_eq!(expected, Some("FrictionDiverges"), "{}", case.id());
                case.check("d", indentation_depth);
                case.check("x_d", contact_length);
            }
            Err(other) => panic!("{}: {other}", case.id()),
        }
    }
}

proptest! {
    #![proptest_config(fixed_cases(256))]

    /// μ = C_p c^(1/p) (F/(η v))^(1 − 1/p) over 20 decades of each of the four, and never below d/x_d, which is the
    /// inequality of Cauchy and Schwarz.
    #[test]
    fn similarity_holds_over_twenty_decades(
        logs in prop::array::uniform4(-10.0_f64..10.0),
        p in 0.55_f64..20.0,
    ) {
        let [force, eta, v, c] = logs.map(|log| 10_f64.powf(log));
        let (material, load) = material_and_load([force, eta, v]);
        let state = power_sliding(&power(c, p), &material, &load).unwrap();
        let inverse = p.recip();
        let number = p * p / (2.0 * p - 1.0) * stretch(p).unwrap().powf(inverse) * 4_f64.powf(inverse - 1.0);
        let unit = c.powf(inverse) * (force / (eta * v)).powf(1.0 - inverse);
        assert_close!(state.friction_coefficient => number * unit, within 1e-12; "p = {p}");
        prop_assert!(state.error <= 1e-13 * state.friction_coefficient, "{:?}", state);
        let smallest = state.indentation_depth / state.contact_length();
        prop_assert!(
            state.friction_coefficient >= smallest * (1.0 - 1e-12),
            "μ = {} is below d/x_d = {smallest} for p = {p}", state.friction_coefficient
        );
    }
}
