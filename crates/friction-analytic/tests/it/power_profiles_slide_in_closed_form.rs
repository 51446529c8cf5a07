use friction_analytic::{FrictionError, power_sliding, stationary_depth};

use crate::support::{power, sliding};

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
