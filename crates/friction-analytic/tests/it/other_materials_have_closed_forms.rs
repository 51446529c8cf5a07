//! Kelvin–Voigt and Maxwell foundations (casebook MDR-03, MDR-04), and waves in full contact with a foundation (FRI-06) and
//! with a half space (VIS-03).

use std::f64::consts::{FRAC_PI_2, TAU};

use casebook::{Case, assert_close, model, prony};
use friction_analytic::{
    SlidingContact, SurfaceWave, ViscoelasticSliding, WavyLine, kelvin_voigt_sliding,
    maxwell_sliding, wavy_sliding, wavy_surface_sliding,
};
use indenters::PowerProfile;
use rheology::{Compressible, KelvinVoigt, Maxwell, Prony};

use crate::support::power;

/// The profile of the line s |x| or k x², and the contact.
fn scene(case: &Case) -> (PowerProfile, SlidingContact) {
    let profile = if case.has_input("s") {
        power(case.input("s") / FRAC_PI_2, 1.0)
    } else {
        power(0.5 * case.input("k"), 2.0)
    };
    let contact = SlidingContact {
        front: case.input("x_r"),
        velocity: case.input("v"),
    };
    (profile, contact)
}

/// How much stiffer and more viscous the foundations are than in the casebook, where G = 1.
const STIFFER: f64 = 4.0;

fn check(case: &Case, state: &ViscoelasticSliding) {
    case.check("x_l", state.contact[0]);
    case.check("F", state.normal_force / STIFFER);
    case.check("mu", state.friction_coefficient);
    if case.expected("d").is_some() {
        case.check("d", state.indentation_depth);
    }
}

#[test]
fn kelvin_voigt_foundations_match_the_casebook() {
    for case in casebook::group("MDR-03") {
        let [modulus, viscosity] = ["G", "eta"].map(|name| STIFFER * case.input(name));
        let material = KelvinVoigt::new(modulus, viscosity).unwrap();
        let (profile, contact) = scene(&case);
        let state = kelvin_voigt_sliding(&profile, &material, contact);
        check(&case, &state.unwrap());
    }
}

/// The friction of the fastest rows is below the absolute tolerance of the group; it keeps its digits all the same.
#[test]
fn maxwell_foundations_match_the_casebook_without_cancellation() {
    for case in casebook::group("MDR-04") {
        let modulus = STIFFER * case.input("G");
        let material = Maxwell::new(modulus, modulus * case.input("tau")).unwrap();
        let (profile, contact) = scene(&case);
        let state = maxwell_sliding(&profile, &material, contact).unwrap();
        check(&case, &state);
        let expected = case.expected("mu").unwrap();
        assert_close!(state.friction_coefficient => expected, within 1e-10; "{}", case.id());
    }
}

#[test]
fn a_wavy_line_in_full_contact_matches_the_casebook() {
    let material = compressible(model("P3"));
    for case in casebook::group("FRI-06") {
        let line = WavyLine {
            amplitude: case.input("g0"),
            wavelength: case.input("wavelength"),
            velocity: case.input("v"),
        };
        let state = wavy_sliding(line, &material).unwrap();
        case.check("Fh_per_length", SOFTER * state.friction_per_length);
        case.check("d_m_limit", state.least_depth);
        case.check("mu_limit", state.largest_friction_coefficient);
    }
}

/// 2 (1 − ν) of materials that are incompressible in the casebook.
const SOFTER: f64 = 1.6;

fn compressible(material: Prony) -> Compressible {
    Compressible::new(&material, 0.2).unwrap()
}

/// The material of a row of VIS-03; some name it without its numbers.
fn material(case: &Case) -> Compressible {
    compressible(if case.has_input("Ge") {
        case.material()
    } else {
        prony([2e5, 0.0], &[(1e6, 0.02)])
    })
}

fn waves(case: &Case) -> Vec<SurfaceWave> {
    let waves: Vec<(f64, [f64; 2])> = if case.has_input("nx") {
        let unit = TAU / case.input("period");
        let [amplitudes, along, across] = ["h", "nx", "ny"].map(|name| case.input_list(name));
        let vectors = along.into_iter().zip(across);
        let vectors = vectors.map(|(x, y)| [unit * x, unit * y]);
        amplitudes.into_iter().zip(vectors).collect()
    } else {
        let (amplitude, k) = (case.input("h0"), TAU / case.input("wavelength"));
        if case.id().contains("egg-box") {
            // cos kx cos ky is half the sum of two oblique waves.
            [[k, k], [k, -k]]
                .map(|vector| (0.5 * amplitude, vector))
                .into()
        } else {
            vec![(amplitude, [k, 0.0])]
        }
    };
    let wave = |(amplitude, wave_vector)| SurfaceWave {
        amplitude,
        wave_vector,
    };
    waves.into_iter().map(wave).collect()
}

#[test]
fn waves_in_full_contact_with_a_half_space_match_the_casebook() {
    for case in casebook::group("VIS-03") {
        let state = wavy_surface_sliding(&waves(&case), &material(&case), case.input("v")).unwrap();
        case.check("tau_f", SOFTER * state.friction_stress);
        if case.expected("mu_at_limit").is_some() {
            case.check("p_mean_min", SOFTER * state.full_contact_pressure);
            case.check("mu_at_limit", state.friction_coefficient);
        } else {
            // The casebook samples the pressure, whose amplitudes need not meet.
            let sampled = case.expected("p_mean_min").unwrap();
            let pressure = SOFTER * state.full_contact_pressure;
            let is_enough = pressure >= sampled * (1.0 - 1e-3);
            assert!(is_enough, "{}: {pressure} below {sampled}", case.id());
        }
    }
}
