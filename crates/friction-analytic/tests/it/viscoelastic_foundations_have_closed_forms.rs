//! Kelvin–Voigt and Maxwell foundations (casebook MDR-03, MDR-04) and a wavy line in full contact (FRI-06).

use std::f64::consts::FRAC_PI_2;

use casebook::{Case, assert_close, assert_matches};
use friction_analytic::{
    FrictionError, SlidingContact, ViscoelasticSliding, WavyLine, kelvin_voigt_sliding,
    maxwell_sliding, wavy_sliding,
};
use indenters::PowerProfile;
use rheology::{KelvinVoigt, Maxwell, Prony, RelaxationBranch, RelaxationSpectrum};

fn profile(case: &Case) -> PowerProfile {
    if case.has_input("s") {
        PowerProfile::cone(case.input("s") / FRAC_PI_2).unwrap()
    } else {
        PowerProfile::paraboloid(0.5 * case.input("k")).unwrap()
    }
}

fn contact(case: &Case) -> SlidingContact {
    SlidingContact {
        front: case.input("x_r"),
        velocity: case.input("v"),
    }
}

fn check(case: &Case, state: &ViscoelasticSliding) {
    case.check("x_l", state.contact[0]);
    case.check("F", state.normal_force);
    case.check("mu", state.friction_coefficient);
    if case.expected("d").is_some() {
        case.check("d", state.indentation_depth);
    }
}

#[test]
fn kelvin_voigt_foundations_match_the_casebook() {
    for case in casebook::group("MDR-03") {
        let material = KelvinVoigt::new(case.input("G"), case.input("eta")).unwrap();
        check(
            &case,
            &kelvin_voigt_sliding(&profile(&case), &material, contact(&case)).unwrap(),
        );
    }
}

/// The friction of the fastest rows is below the absolute tolerance of the group; it keeps its digits all the same.
#[test]
fn maxwell_foundations_match_the_casebook_without_cancellation() {
    for case in casebook::group("MDR-04") {
        let (modulus, time) = (case.input("G"), case.input("tau"));
        let material = Maxwell::new(modulus, modulus * time).unwrap();
        let state = maxwell_sliding(&profile(&case), &material, contact(&case)).unwrap();
        check(&case, &state);
        assert_close!(
            state.friction_coefficient => case.expected("mu").unwrap(),
            within 1e-10; "{}", case.id()
        );
    }
}

#[test]
fn a_wavy_line_in_full_contact_matches_the_casebook() {
    let branches =
        [(5e8, 1e-6), (2e7, 0.01), (3e5, 1e3)].map(|(modulus, relaxation_time)| RelaxationBranch {
            modulus,
            relaxation_time,
        });
    let relaxation = RelaxationSpectrum::new(1e5, 0.0, branches.to_vec()).unwrap();
    let material = Prony::new(relaxation).unwrap();
    for case in casebook::group("FRI-06") {
        let line = WavyLine {
            amplitude: case.input("g0"),
            wavelength: case.input("wavelength"),
            velocity: case.input("v"),
        };
        let state = wavy_sliding(line, &material).unwrap();
        case.check("Fh_per_length", state.friction_per_length);
        case.check("d_m_limit", state.least_depth);
        case.check("mu_limit", state.largest_friction_coefficient);
    }
}

#[test]
fn other_profiles_and_contacts_that_cannot_be_are_refused() {
    let material = KelvinVoigt::new(1.0, 1.0).unwrap();
    let good = SlidingContact {
        front: 1.0,
        velocity: 1.0,
    };
    let result = kelvin_voigt_sliding(&PowerProfile::new(1.0, 1.5).unwrap(), &material, good);
    assert_matches!(result, Err(FrictionError::UnsupportedExponent { .. }));
    let cone = PowerProfile::cone(1.0).unwrap();
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        for contact in [
            SlidingContact { front: bad, ..good },
            SlidingContact {
                velocity: bad,
                ..good
            },
        ] {
            let result = kelvin_voigt_sliding(&cone, &material, contact);
            assert_matches!(result, Err(FrictionError::InvalidParameter { .. }), "{bad}");
        }
    }
}
