//! Persson's theory against the casebook, in full contact, and as the sum over many waves.

use std::f64::consts::TAU;

use casebook::{assert_close, assert_matches, numbers, prony, refused, refuses};
use friction_analytic::{
    EnergyFactor, FrictionError, PerssonSliding, RoughLoad, SelfAffineSpectrum, SurfaceWave,
    persson_of_spectrum, persson_of_waves,
};
use numerics::Estimate;
use rheology::{Elastic, Prony};

/// v, area, μ with S = 1, μ with S = (1 + P²)/2 and μ with S = P = 1 under the mean pressure 0.05. The frictions
/// are good to 1e-10: with the quadrature in three other variables that at v = 0.5 ends 1.0e-10 lower.
const ROWS: &str = include_str!("../data/persson.txt");
const PRESSURE: f64 = 0.05;

/// Waves from 1/4 to 1/64 of a unit length, with H = 0.8 and the slope 0.1.
const SPECTRUM: SelfAffineSpectrum = SelfAffineSpectrum {
    hurst_exponent: 0.8,
    rms_slope: 0.1,
    longest_wavelength: 0.25,
    roll_off_wavelength: 0.25,
    shortest_wavelength: 1.0 / 64.0,
};

/// E* from 1 to 10 with ν = 1/2.
fn material() -> Prony {
    prony([0.25, 0.0], &[(2.25, 1.0)])
}

fn load(mean_pressure: f64, velocity: f64) -> RoughLoad {
    RoughLoad {
        mean_pressure,
        velocity,
    }
}

/// Area fraction, and friction with the energy factors of 2001 and 2006.
fn area_and_frictions(state: PerssonSliding) -> [Estimate; 3] {
    [
        state.area_fraction,
        state.friction_coefficient(EnergyFactor::PERSSON_2001),
        state.friction_coefficient(EnergyFactor::PERSSON_2006),
    ]
}

fn theory(mean_pressure: f64, velocity: f64, relative_error: f64) -> PerssonSliding {
    let load = load(mean_pressure, velocity);
    persson_of_spectrum(&SPECTRUM, &material(), load, relative_error).expect("a friction")
}

#[test]
fn area_and_friction_are_those_of_the_casebook() {
    for row in numbers::<5>(ROWS) {
        let v = row[0];
        for relative_error in [1e-3, 1e-9] {
            let state = theory(PRESSURE, v, relative_error);
            for (estimate, exact) in area_and_frictions(state).into_iter().zip(&row[1..]) {
                let off = (estimate.value - exact).abs();
                let holds = off <= estimate.error + 1.5e-10 * exact;
                let is_requested = estimate.error <= relative_error * exact;
                assert!(
                    holds && is_requested,
                    "v = {v}: {estimate:?} instead of {exact}"
                );
            }
        }
        // A million times the pressure closes all gaps.
        let state = theory(1e6 * PRESSURE, v, 1e-10);
        for factor in [
            EnergyFactor::PERSSON_2001,
            EnergyFactor::PERSSON_2006,
            EnergyFactor::WANG_MUSER_2017,
        ] {
            let friction = state.friction_coefficient(factor).value;
            assert_close!(friction => 1e-6 * row[4], within 1e-10; "v = {v}");
        }
    }
}

/// The spectrum as waves in the middle of cells of ln q and of the angle.
fn waves(rings: u32, angles: u32) -> Vec<SurfaceWave> {
    let step = 16.0_f64.ln() / f64::from(rings);
    // 2π ∫ q³ C dq = slope².
    let total = TAU * (16.0_f64.powf(0.4) - 1.0) / 0.4;
    let mut waves = Vec::new();
    for ring in 0..rings {
        let x = (step * (f64::from(ring) + 0.5)).exp();
        for angle in 0..angles {
            let turn = TAU * (f64::from(angle) + 0.5) / f64::from(angles);
            let q = 4.0 * TAU * x;
            // Half of the square of the slope of the wave is q⁴ C of its cell.
            let square = 0.01 * x.powf(0.4) / total * step * TAU / f64::from(angles);
            waves.push(SurfaceWave {
                amplitude: (2.0 * square).sqrt() / q,
                wave_vector: [q * turn.cos(), q * turn.sin()],
            });
        }
    }
    waves
}

#[test]
fn many_waves_have_the_friction_of_the_spectrum() {
    let exact = area_and_frictions(theory(PRESSURE, 0.004, 1e-10));
    let off = |rings: u32| {
        let state = persson_of_waves(&waves(rings, 64), &material(), load(PRESSURE, 0.004));
        let state = area_and_frictions(state.expect("a friction"));
        [0, 1, 2].map(|index| state[index].value / exact[index].value - 1.0)
    };
    // The midpoint rule is of second order.
    for (coarse, fine) in off(16).into_iter().zip(off(32)) {
        let order = (coarse / fine).log2();
        assert!(
            fine.abs() < 2e-3 && (1.8..2.2).contains(&order),
            "{coarse:e}, then {fine:e}"
        );
    }
}

#[test]
fn an_elastic_material_has_the_area_of_its_modulus_and_no_friction() {
    let elastic = Elastic::new(0.25).expect("a material");
    for spectrum in [SPECTRUM, spectrum_with(0.8, 0.1), spectrum_with(0.3, 0.05)] {
        let state = persson_of_spectrum(&spectrum, &elastic, load(PRESSURE, 1.0), 1e-10);
        let state = state.expect("an area");
        let friction = state.friction_coefficient(EnergyFactor::PERSSON_2001);
        assert!(friction.value.abs() < 1e-300, "{state:?}");
        // G = (E* slope/σ₀)²/8 with 2π ∫ q³ C dq = slope² and E* = 1, and erf(1/(2 √G)) = erf(1/√2).
        let expected = 0.682_689_492_137_085_9;
        assert_close!(state.area_fraction.value => expected, within 1e-10);
    }
}

/// The spectrum with another Hurst exponent and another roll-off.
fn spectrum_with(hurst_exponent: f64, roll_off_wavelength: f64) -> SelfAffineSpectrum {
    SelfAffineSpectrum {
        hurst_exponent,
        roll_off_wavelength,
        ..SPECTRUM
    }
}

/// All waves of one wavelength count with the same area fraction, however many they are.
#[test]
fn a_wave_equals_the_sum_of_its_parts() {
    let [whole, parts] = [(0.1, 1), (0.05, 4)].map(|(amplitude, n_waves)| {
        let wave = SurfaceWave {
            amplitude,
            wave_vector: [5.0, 3.0],
        };
        let state = persson_of_waves(&vec![wave; n_waves], &material(), load(PRESSURE, 0.1));
        area_and_frictions(state.expect("a friction"))[1].value
    });
    assert_close!(parts => whole, within 1e-14);
}

/// The friction of a wave is that with S = 1, times S after half of the wave.
#[test]
fn energy_factors_weight_the_friction_of_each_wave() {
    let waves = waves(6, 1);
    let state = |waves: &[SurfaceWave]| {
        persson_of_waves(waves, &material(), load(PRESSURE, 0.004)).expect("a friction")
    };
    let of_2001 = |waves: &[SurfaceWave]| match waves {
        [] => 0.0,
        _ => area_and_frictions(state(waves))[1].value,
    };
    let mut expected = [0.0; 3];
    for last in 0..waves.len() {
        let mut half = waves[..=last].to_vec();
        half[last].amplitude *= 0.5_f64.sqrt();
        let square = state(&half).area_fraction.value.powi(2);
        let added = of_2001(&waves[..=last]) - of_2001(&waves[..last]);
        let factors = [
            0.5 * (1.0 + square),
            (5.0 - 2.0 * square + 6.0 * square * square) / 9.0,
            0.4 + 0.6 * square,
        ];
        for (sum, factor) in expected.iter_mut().zip(factors) {
            *sum += added * factor;
        }
    }
    let factors = [
        EnergyFactor::PERSSON_2006,
        EnergyFactor::WANG_MUSER_2017,
        EnergyFactor::interpolated(0.4).expect("a factor"),
    ];
    let state = state(&waves);
    for (factor, expected) in factors.into_iter().zip(expected) {
        let friction = state.friction_coefficient(factor).value;
        assert_close!(friction => expected, within 1e-13; "{factor:?}");
    }
}

/// The area of Xu is Persson's area of a surface whose squared slopes are smaller by γ + (1 − γ) A.
#[test]
fn the_area_of_xu_is_that_of_persson_with_smaller_slopes() {
    let elastic = Elastic::new(0.25).expect("a material");
    let state = |pressure: f64, part: f64| {
        let spectrum = SelfAffineSpectrum {
            rms_slope: SPECTRUM.rms_slope * part.sqrt(),
            ..SPECTRUM
        };
        persson_of_spectrum(&spectrum, &elastic, load(pressure, 1.0), 1e-10).expect("an area")
    };
    for pressure in [1e-7, 1e-3, PRESSURE, 0.2, 10.0] {
        let all = state(pressure, 1.0);
        for gamma in [0.1, 0.45, 1.0] {
            let area = all.area_fraction_of_xu(gamma).expect("an area");
            let expected = state(pressure, gamma + (1.0 - gamma) * area.value).area_fraction;
            assert_close!(area.value => expected.value, within 1e-9; "{gamma} {pressure}");
            assert!(area.error < 2e-10, "{area:?}");
        }
    }
    let refused = |gamma| state(PRESSURE, 1.0).area_fraction_of_xu(gamma);
    refuses("gamma", &[0.0, -1.0, 1.1, f64::NAN], refused);
}

#[test]
fn invalid_spectra_and_loads_are_refused() {
    let good = load(PRESSURE, 1.0);
    let flat = SelfAffineSpectrum {
        rms_slope: 0.0,
        ..SPECTRUM
    };
    let narrow = SelfAffineSpectrum {
        shortest_wavelength: 0.25,
        ..SPECTRUM
    };
    let rows = [
        (flat, good, "rms_slope"),
        (narrow, good, "longest_wavelength"),
        (spectrum_with(1.0, 0.25), good, "hurst_exponent"),
        (spectrum_with(0.8, 0.3), good, "roll_off_wavelength"),
        (spectrum_with(0.8, 0.01), good, "roll_off_wavelength"),
        (SPECTRUM, load(0.0, 1.0), "mean_pressure"),
        (SPECTRUM, load(1.0, -1.0), "velocity"),
    ];
    for (spectrum, load, parameter) in rows {
        let result = persson_of_spectrum(&spectrum, &material(), load, 1e-3);
        refused(parameter, result);
    }
    let none = persson_of_waves(&[], &material(), good);
    assert_matches!(none, Err(FrictionError::InvalidParameter(_)));
    let theory = |error| persson_of_spectrum(&SPECTRUM, &material(), good, error);
    refuses("relative_error", &[1e-12, 1.0, f64::NAN], theory);
}
