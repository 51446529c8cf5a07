//! The covariance of fitted moduli, against materials that are known.

use std::f64::consts::LN_10;

use rheology::fit::{
    Control, IdentifyOptions, Isotherm, MeasuredCurve, ModuliCovariance, ModulusPoint,
    RelaxationPoint, SuperpositionOptions, automatic_master_curve, identify, shifted_master_curve,
};
use rheology::{RelaxationBranch, RelaxationSpectrum, WlfShift};

use crate::experiments::{Random, dissipation, uncertainty};

/// A rubber whose moduli follow a power of frequency.
fn rubber() -> RelaxationSpectrum {
    let branch = |k: i32| {
        let time = 10_f64.powf(0.25 * f64::from(k) - 9.0);
        RelaxationBranch::new(4e5 * time.powf(-0.3), time)
    };
    RelaxationSpectrum::new(1e6, 0.0, (0..48).map(branch).collect()).expect("a rubber")
}

const MIDDLE: f64 = 20.0;

fn law() -> WlfShift {
    WlfShift::new(8.86, 101.6, MIDDLE).expect("a law")
}

/// Isotherms with noise of 2 %, temperatures that are off by 0.3 K, and factors by 0.5 %, times a scale.
fn measured(truth: &RelaxationSpectrum, seed: u64, scale: f64) -> Vec<Isotherm> {
    let mut random = Random(seed.wrapping_mul(0x1234_5678_9abc_def1));
    let isotherm = |place: u32| {
        let temperature = MIDDLE + 8.0 * (f64::from(place) - 3.0);
        let own = temperature + scale * 0.3 * random.normal();
        let factor = 1.0 + scale * 0.005 * random.normal();
        let shift = (LN_10 * law().log10_factor(own).expect("a factor")).exp();
        let mut error = || factor * (1.0 + scale * 0.02 * random.normal());
        let points = (0..12).map(|k| {
            let omega = 10_f64.powf(0.2 * f64::from(k));
            let modulus = truth.complex_modulus(shift * omega).expect("moduli");
            ModulusPoint {
                angular_frequency: omega,
                storage: modulus.storage * error(),
                loss: modulus.loss * error(),
            }
        });
        let points = points.collect();
        Isotherm {
            temperature,
            points,
        }
    };
    (0..6).map(isotherm).collect()
}

/// Expects 95 per cent of 200 experiments within 1.96 standard errors, give or take 1.5 by chance; bands half as wide hold
/// only two thirds.
#[test]
fn bands_hold_the_true_material_as_often_as_they_say() {
    const COUNT: u32 = 200;
    let truth = rubber();
    let expected = dissipation(&truth);
    let mut deviations = Vec::new();
    for seed in 0..COUNT {
        let isotherms = measured(&truth, u64::from(seed), 1.0);
        let master = automatic_master_curve(&isotherms, MIDDLE, &SuperpositionOptions::default())
            .expect("a master curve");
        let found = identify(&master.curve, &IdentifyOptions::default()).expect("a series");
        let covariance = found.covariance.expect("a covariance");
        let error = uncertainty(&found.spectrum, &covariance);
        deviations.push((dissipation(&found.spectrum) - expected) / error);
    }
    let share = |width: f64| {
        let inside = deviations
            .iter()
            .filter(|deviation| deviation.abs() <= width);
        inside.count() as f64 / f64::from(COUNT)
    };
    let [full, half] = [1.96, 0.98].map(share);
    assert!(
        (0.905..=0.995).contains(&full),
        "{full} are within the band"
    );
    assert!(half < 0.85, "{half} are within half of it");
}

fn fitted(curve: &MeasuredCurve, control: Control) -> ModuliCovariance {
    let options = IdentifyOptions {
        control,
        ..IdentifyOptions::default()
    };
    let found = identify(curve, &options).expect("a series");
    found.covariance.expect("a covariance")
}

/// More branches than points leave combinations of moduli that nothing is known of: they are known to themselves.
#[test]
fn moduli_that_the_data_do_not_know_are_known_to_themselves() {
    let truth = rubber();
    let points = (0..4).map(|k| {
        let omega = 10_f64.powi(k);
        let modulus = truth.complex_modulus(omega).expect("moduli");
        ModulusPoint {
            angular_frequency: omega,
            storage: modulus.storage * (1.0 + 0.02 * f64::from(k % 2)),
            loss: modulus.loss,
        }
    });
    let curve = MeasuredCurve::oscillation(points.collect()).expect("a curve");
    let control = Control::Smooth {
        n_branches: 30,
        weight: 1.0,
    };
    let known = fitted(&curve, control);
    let errors = known.standard_errors();
    let largest = errors.iter().copied().fold(0.0, f64::max);
    assert!((0.5..1.5).contains(&largest), "{errors:?}");
    for (row, entries) in known.relative.iter().enumerate() {
        for (column, entry) in entries.iter().enumerate() {
            let mirrored = known.relative[column][row];
            let is_bound = entry.abs() <= errors[row] * errors[column] * (1.0 + 1e-9);
            assert!(
                entry.to_bits() == mirrored.to_bits() && is_bound,
                "{row}, {column}: {entry}"
            );
        }
    }
}

/// With four times the errors of the data four times the scatter is found. A single curve says nothing of factors and temperatures.
#[test]
fn errors_of_moduli_follow_those_of_the_data() {
    let truth = rubber();
    let control = Control::Parsimony { tolerance: 0.02 };
    let noise = |scale: f64| {
        let isotherms = measured(&truth, 7, scale);
        let log10_factor = |temperature| law().log10_factor(temperature);
        let master = shifted_master_curve(
            &isotherms,
            MIDDLE,
            log10_factor,
            &SuperpositionOptions::default(),
        )
        .expect("a curve");
        let known = fitted(&master.curve, control);
        assert!(
            known.factor.is_some() && known.temperature.is_some(),
            "{known:?}"
        );
        known.noise[0]
    };
    let [small, large] = [0.5, 2.0].map(noise);
    assert!((3.0..5.0).contains(&(large / small)), "{small}, {large}");
    let points = (0..40).map(|k| {
        let time = 10_f64.powf(0.1 * f64::from(k) - 4.0);
        let modulus = truth.relaxation_modulus(time).expect("a modulus");
        RelaxationPoint { time, modulus }
    });
    let curve = MeasuredCurve::relaxation(points.collect()).expect("a curve");
    let known = fitted(&curve, control);
    assert!(
        known.factor.is_none() && known.temperature.is_none(),
        "{known:?}"
    );
    assert!(known.noise.len() == 1 && known.noise[0] < 1e-3, "{known:?}");
    let words = known.description();
    assert!(
        words.contains("of G(t)") && words.contains("in common"),
        "{words}"
    );
}
