use std::f64::consts::PI;

use casebook::assert_matches;
use rheology::fit::expand;
use rheology::{ComplexModulus, RheologyError};

use crate::support::fractional_maxwell;

/// G(t) of e^(−√t) beside a spring.
fn stretched(time: f64) -> f64 {
    0.1 + (-time.sqrt()).exp()
}

/// G* of the same: e^(−√t) = ∫ e^(−st) e^(−1/(4s))/(2 √π s^(3/2)) ds (Lévy), by the trapezoidal rule in ln s.
fn stretched_in_oscillation(omega: f64) -> ComplexModulus {
    let step = 0.02;
    let mut modulus = ComplexModulus {
        storage: 0.1,
        loss: 0.0,
    };
    for k in -400..=3000 {
        let rate = (step * f64::from(k)).exp();
        let density = step * (-0.25 / rate).exp() / (2.0 * (PI * rate).sqrt());
        let square = rate * rate + omega * omega;
        modulus.storage += density * omega * omega / square;
        modulus.loss += density * omega * rate / square;
    }
    modulus
}

/// G(t) of a spring and a springpot of a = 1/2 in series.
fn fractional(time: f64) -> f64 {
    // e^x erfc(√x) without an overflow: a series in 1/x at late times.
    if time < 100.0 {
        return time.exp() * libm::erfc(time.sqrt());
    }
    let terms = (1..=12).rev().map(|n| 0.5 * f64::from(2 * n - 1) / time);
    terms.fold(1.0, |sum, ratio| 1.0 - ratio * sum) / (PI * time).sqrt()
}

fn fractional_in_oscillation(omega: f64) -> ComplexModulus {
    let element = fractional_maxwell([1.0, 1.0, 0.5]).unwrap();
    element.complex_modulus(omega).unwrap()
}

/// The error stated is the largest one in time and in oscillation, on times between those where it was measured.
#[test]
fn functions_of_relaxation_have_series_with_the_error_stated() {
    type Law = (fn(f64) -> f64, fn(f64) -> ComplexModulus);
    let laws: [Law; 2] = [
        (stretched, stretched_in_oscillation),
        (fractional, fractional_in_oscillation),
    ];
    for (law, (relaxation, oscillation)) in laws.into_iter().enumerate() {
        for asked in [1e-2, 5e-5, 1e-6] {
            let found = expand(&relaxation, [1e-4, 1e3], asked).unwrap();
            assert!(found.relative_error <= asked, "law {law}: {found:?}");
            let mut largest = 0.0_f64;
            let mut time = 1.01e-4;
            while time < 1e3 {
                let [exact, series] = [
                    relaxation(time),
                    found.spectrum.relaxation_modulus(time).unwrap(),
                ];
                largest = largest.max((series / exact - 1.0).abs());
                let exact = oscillation(time.recip());
                let series = found.spectrum.complex_modulus(time.recip()).unwrap();
                let off = (series.storage - exact.storage).hypot(series.loss - exact.loss);
                largest = largest.max(off / exact.storage.hypot(exact.loss));
                time *= 1.037;
            }
            let ratio = largest / found.relative_error;
            // The maximum of a ripple between samples, and linear interpolation between them; what may come from times that
            // are not sampled makes the stated error larger than the true one.
            assert!(
                (0.2..1.05).contains(&ratio),
                "law {law}, asked {asked:e}: {largest:e} is {ratio} of what is stated"
            );
        }
    }
}

#[test]
fn functions_of_no_material_are_refused() {
    let within = |law: fn(f64) -> f64| expand(&law, [1e-2, 1e2], 1e-4);
    let rising = within(|time| 1.0 + time / (1.0 + time));
    assert_matches!(
        rising,
        Err(RheologyError::ExpansionNotReached { asked: 1e-4, .. })
    );
    let wavy = within(|time| 2.0 + time.ln().sin());
    assert_matches!(
        wavy,
        Err(RheologyError::ExpansionNotReached { asked: 1e-4, .. })
    );
    for law in [|_| f64::NAN, |_| -1.0, |_| 0.0] {
        assert_matches!(
            within(law),
            Err(RheologyError::InvalidElement { list: "points", .. })
        );
    }
    for range in [[1.0, 1.0], [2.0, 1.0], [0.0, 1.0], [1.0, f64::INFINITY]] {
        let found = expand(&stretched, range, 1e-4);
        assert_matches!(found, Err(RheologyError::InvalidParameter(_)));
    }
}
