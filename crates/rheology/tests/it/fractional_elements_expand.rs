use casebook::assert_close;
use rheology::{Elastic, Material, Springpot};

use crate::support::fractional_maxwell;

#[test]
fn springpot_has_its_closed_forms() {
    for case in casebook::group("RHE-10") {
        if !case.id().contains("springpot") {
            continue;
        }
        let springpot = Springpot::new(case.input("K"), case.input("a")).unwrap();
        let (t, omega) = (case.input("t"), case.input("omega"));
        let modulus = springpot.complex_modulus(omega).unwrap();
        case.check_within("G_storage", modulus.storage, 1e-14);
        case.check_within("G_loss", modulus.loss, 1e-14);
        case.check_within("tan_delta", springpot.loss_tangent(), 1e-14);
        case.check_within("G_t", springpot.relaxation_modulus(t).unwrap(), 1e-14);
        case.check_within("J_t", springpot.creep_compliance(t).unwrap(), 1e-14);
        let soft = Springpot::new(0.25 * case.input("K"), case.input("a")).unwrap();
        case.check_within("J_t", 0.25 * soft.creep_compliance(t).unwrap(), 1e-14);
        // The same numbers from the series: what is right over the band of frequencies is right in time.
        let expansion = springpot.expand([1e-3, 1e3], 1e-10).unwrap();
        let series = &expansion.spectrum;
        case.check("G_storage", series.complex_modulus(omega).unwrap().storage);
        case.check("G_t", series.relaxation_modulus(t).unwrap());
        let creep = series.to_creep().unwrap();
        case.check("J_t", creep.creep_compliance(t).unwrap());
    }
}

/// E_a(−x) is the relaxation of a spring and a springpot in series at (t/τ)^a = x.
#[test]
fn fractional_maxwell_relaxes_like_the_mittag_leffler_function() {
    for case in casebook::group("RHE-10") {
        if case.expected("E").is_none() {
            continue;
        }
        let (exponent, x) = (case.input("a"), case.input("x"));
        let time = x.powf(exponent.recip());
        let element = fractional_maxwell([1.0, 1.0, exponent]).unwrap();
        let expansion = element.expand([1e-3 / time, 1e3 / time], 1e-10);
        let series = expansion.unwrap().spectrum;
        case.check("E", series.relaxation_modulus(time).unwrap());
    }
}

/// The error is the one stated, on frequencies between those where it was measured.
#[test]
fn expansions_keep_to_the_error_asked_for_anywhere_in_the_band() {
    for exponent in [0.01, 0.3, 0.5, 0.7, 0.99] {
        for error in [1e-1, 1e-3, 1e-6, 1e-9] {
            let springpot = Springpot::new(1e7, exponent).unwrap();
            let expansion = springpot.expand([1e-6, 1e6], error).unwrap();
            let is_kept = expansion.relative_error <= error;
            assert!(is_kept, "a = {exponent}: {expansion:?}");
            let mut omega = 1.01e-6;
            while omega < 1e6 {
                let exact = springpot.complex_modulus(omega).unwrap();
                let series = expansion.spectrum.complex_modulus(omega).unwrap();
                let off = (series.storage - exact.storage).hypot(series.loss - exact.loss);
                let off = off / exact.storage.hypot(exact.loss);
                // The maximum of a smooth ripple between samples 7 % apart.
                let is_within = off <= 1.05 * error;
                assert!(is_within, "a = {exponent}, ω = {omega:e}: {off:e}");
                omega *= 1.37;
            }
        }
    }
}

/// J(t) = 1/G₁ − G₂/(G₁ (G₁ + G₂)) E_a(−(t/τ_c)^a) with τ_c^a = τ^a (G₁ + G₂)/G₁, here for a = 1/2, where
/// E_a(−x) = e^(x²) erfc(x).
#[test]
fn fractional_standard_solid_creeps_like_its_closed_form() {
    let (g1, g2, tau) = (2.0, 6.0, 3.0);
    let expansion = fractional_maxwell([g2, tau, 0.5]).unwrap();
    let expansion = expansion.expand([1e-6, 1e6], 1e-10);
    let spring = Elastic::new(g1).unwrap().relaxation();
    let solid = expansion.unwrap().spectrum.in_parallel_with(&spring);
    let creep = solid.unwrap().to_creep().unwrap();
    for time in [1e-3, 0.1, 1.0, 10.0, 1e3] {
        let x: f64 = (time / tau).sqrt() * g1 / (g1 + g2);
        let relaxed = (x * x).exp() * libm::erfc(x);
        let exact = 1.0 / g1 - g2 / (g1 * (g1 + g2)) * relaxed;
        assert_close!(creep.creep_compliance(time).unwrap() => exact, within 1e-9; "J({time})");
    }
}

/// Another unit of time changes the rounding only.
#[test]
fn the_series_does_not_depend_on_the_unit_of_time() {
    for unit in [2.0_f64.powi(-7), 3.0, 1e12] {
        let springpot = |unit: f64| {
            let element = Springpot::new(1e6 * unit.powf(0.4), 0.4).unwrap();
            let expansion = element.expand([1e-2 / unit, 1e4 / unit], 1e-6);
            expansion.unwrap().spectrum
        };
        let (seconds, others) = (springpot(1.0), springpot(unit));
        let [one, other] = [&seconds, &others].map(|spectrum| spectrum.branches());
        assert_eq!(one.len(), other.len(), "branches, unit {unit:e}");
        for (one, other) in one.iter().zip(other) {
            let pairs = [
                (one.modulus, other.modulus),
                (one.relaxation_time, other.relaxation_time / unit),
            ];
            for (expected, found) in pairs {
                let deviation = (found / expected - 1.0).abs();
                assert!(deviation < 1e-12, "{found} of {expected}, unit {unit:e}");
            }
        }
    }
}
