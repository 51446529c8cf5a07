//! Waves of a surface in full contact with a half space (casebook VIS-03).

use std::f64::consts::TAU;

use casebook::{Case, assert_matches};
use friction_analytic::{FrictionError, SurfaceWave, WavySliding, wavy_surface_sliding};
use rheology::{Prony, RelaxationBranch, RelaxationSpectrum};

/// The solid of the rows that name it without its numbers.
const STANDARD_SOLID: [f64; 3] = [2e5, 1e6, 0.02];

fn material(case: &Case) -> Prony {
    let [equilibrium, modulus, time] = STANDARD_SOLID;
    let (equilibrium, viscosity, moduli, times) = if case.has_input("Ge") {
        (
            case.input("Ge"),
            case.input("eta"),
            case.input_list("G"),
            case.input_list("tau"),
        )
    } else {
        (equilibrium, 0.0, vec![modulus], vec![time])
    };
    let branches = moduli
        .into_iter()
        .zip(times)
        .map(|(modulus, relaxation_time)| RelaxationBranch {
            modulus,
            relaxation_time,
        });
    Prony::new(RelaxationSpectrum::new(equilibrium, viscosity, branches.collect()).unwrap())
        .unwrap()
}

fn waves(case: &Case) -> Vec<SurfaceWave> {
    if case.has_input("nx") {
        let unit = TAU / case.input("period");
        let numbers = case.input_list("nx").into_iter().zip(case.input_list("ny"));
        return numbers
            .zip(case.input_list("h"))
            .map(|((along, across), amplitude)| SurfaceWave {
                amplitude,
                wave_vector: [unit * along, unit * across],
            })
            .collect();
    }
    let (amplitude, k) = (case.input("h0"), TAU / case.input("wavelength"));
    if case.id().contains("egg-box") {
        // cos kx cos ky is half the sum of two oblique waves.
        return [k, -k]
            .map(|across| SurfaceWave {
                amplitude: 0.5 * amplitude,
                wave_vector: [k, across],
            })
            .to_vec();
    }
    vec![SurfaceWave {
        amplitude,
        wave_vector: [k, 0.0],
    }]
}

fn sliding(case: &Case) -> WavySliding {
    wavy_surface_sliding(&waves(case), &material(case), case.input("v")).unwrap()
}

#[test]
fn waves_in_full_contact_match_the_casebook() {
    for case in casebook::group("VIS-03") {
        let state = sliding(&case);
        case.check("tau_f", state.friction_stress);
        if case.expected("mu_at_limit").is_some() {
            case.check("p_mean_min", state.full_contact_pressure);
            case.check("mu_at_limit", state.friction_coefficient);
        } else {
            // The casebook samples the pressure, whose amplitudes need not meet.
            let sampled = case.expected("p_mean_min").unwrap();
            assert!(
                state.full_contact_pressure >= sampled * (1.0 - 1e-3),
                "{}: {state:?} below {sampled}",
                case.id()
            );
        }
    }
}

#[test]
fn waves_across_the_motion_press_and_do_not_rub() {
    let case = &casebook::group("VIS-03")[0];
    let along = waves(case)[0];
    let [k, _] = along.wave_vector;
    let across = SurfaceWave {
        wave_vector: [0.0, k],
        ..along
    };
    let alone = sliding(case);
    let both = wavy_surface_sliding(&[along, across], &material(case), case.input("v")).unwrap();
    assert!(
        both.friction_stress
            .total_cmp(&alone.friction_stress)
            .is_eq()
            && both.full_contact_pressure > alone.full_contact_pressure,
        "{both:?} and {alone:?}"
    );
}

#[test]
fn waves_that_interfere_or_are_none_are_refused() {
    let case = &casebook::group("VIS-03")[0];
    let good = waves(case)[0];
    let [k, _] = good.wave_vector;
    let with_vector = |wave_vector| SurfaceWave {
        wave_vector,
        ..good
    };
    for bad in [
        vec![],
        vec![good, good],
        vec![good, with_vector([-k, -0.0])],
        vec![with_vector([0.0, 0.0])],
        vec![with_vector([f64::NAN, k])],
        vec![SurfaceWave {
            amplitude: -1.0,
            ..good
        }],
    ] {
        let result = wavy_surface_sliding(&bad, &material(case), 1.0);
        assert_matches!(
            result,
            Err(FrictionError::InvalidParameter { .. }),
            "{bad:?}"
        );
    }
    let result = wavy_surface_sliding(&[good], &material(case), f64::MAX);
    assert_matches!(result, Err(FrictionError::OutOfRange { .. }));
}
