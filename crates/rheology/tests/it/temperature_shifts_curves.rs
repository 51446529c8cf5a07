use casebook::{assert_close, assert_matches};
use rheology::{ArrheniusShift, Material, RheologyError, Viscous, WlfShift};

use crate::support::named_spectrum;

#[test]
fn wlf_matches_exact_numbers_about_any_reference() {
    for case in casebook::group("RHE-07") {
        let (c1, c2, difference) = (case.input("C1"), case.input("C2"), case.input("dT"));
        let law = WlfShift::new(c1, c2, 20.0).unwrap();
        let shift = law.log10_factor(20.0 + difference);
        if case.expected_error().is_some() {
            let about = law
                .with_reference(20.0 + difference)
                .map(|law| law.constants()[1]);
            for result in [shift, about] {
                assert_matches!(result, Err(RheologyError::BelowWlfPole { pole, .. }) if (pole - 20.0 + c2).abs() < 1e-13);
            }
            continue;
        }
        let shift = shift.unwrap();
        case.check("log10_aT", shift);
        case.check("aT", 10_f64.powf(shift));
        let other = law.with_reference(20.0 + difference).unwrap();
        case.check("C1_new", other.constants()[0]);
        case.check("C2_new", other.constants()[1]);
        // a_T(T; T_r') = a_T(T; T_r)/a_T(T_r'; T_r)
        let composed = law.log10_factor(33.0).unwrap() - shift;
        assert_close!(other.log10_factor(33.0).unwrap() => composed, within 1e-12);
    }
}

#[test]
fn wlf_constants_come_back_from_their_shifts() {
    let law = WlfShift::new(8.86, 101.6, 50.0).unwrap();
    let shifts = [10.0, 30.0, 50.0, 70.0, 120.0].map(|t| [t, law.log10_factor(t).unwrap()]);
    // The two equations are a few hundred times worse conditioned than the shifts.
    for enough in [&shifts, &shifts[1..4]] {
        let [c1, c2] = WlfShift::fit(enough, 50.0).unwrap().constants();
        assert_close!(c1 => 8.86, within 1e-12);
        assert_close!(c2 => 101.6, within 1e-12);
    }
    let too_few = WlfShift::fit(&shifts[1..3], 50.0).unwrap_err();
    let message = "at least 2 points are needed, but there are 1";
    assert_eq!(too_few.to_string(), message, "one besides 50");
}

/// ln a_T = E_a/R (1/T − 1/T_r): 80 kJ/mol from 25 °C to 35 °C, with R = 8.314462618 J/(mol K).
#[test]
fn arrhenius_shifts_by_its_activation_energy() {
    let law = ArrheniusShift::new(80e3, 298.15).unwrap();
    let expected = 80e3 / 8.314_462_618 * (1.0 / 308.15 - 1.0 / 298.15) / 10_f64.ln();
    assert_close!(law.log10_factor(308.15).unwrap() => expected, within 1e-9);
}

/// G*(ω, T) = G*(a_T ω, T_r)
#[test]
fn a_shift_multiplies_every_time() {
    let dashpot = Viscous::new(3.0).unwrap().relaxation();
    let cold = named_spectrum("P10").in_parallel_with(&dashpot).unwrap();
    let shifted = cold.shifted(1e-3).unwrap();
    assert_close!(shifted.viscosity() => 3e-3, within 1e-15);
    for omega in [1e-3, 1.0, 1e6] {
        let here = shifted.complex_modulus(omega).unwrap();
        let there = cold.complex_modulus(1e-3 * omega).unwrap();
        assert_close!(here.storage => there.storage, within 1e-14);
        assert_close!(here.loss => there.loss, within 1e-14);
    }
}

#[cfg(feature = "fit")]
mod isotherms {
    use super::*;
    use rheology::fit::{
        Isotherm, ModulusPoint, SuperpositionOptions, automatic_master_curve, shifted_master_curve,
    };

    fn law() -> WlfShift {
        WlfShift::new(8.86, 101.6, 42.0).unwrap()
    }

    /// Three decades at each of nine temperatures, with a deterministic scatter.
    fn isotherms(scatter: f64) -> Vec<Isotherm> {
        let material = named_spectrum("P10");
        let isotherm = |temperature: f64| {
            let factor = 10_f64.powf(law().log10_factor(temperature).unwrap());
            let point = |k: f64| {
                let angular_frequency = 10_f64.powf(-1.0 + 0.125 * k);
                let modulus = material.complex_modulus(angular_frequency * factor);
                let modulus = modulus.unwrap();
                let noise = |seed: f64| 1.0 + scatter * (seed * k + temperature).sin();
                ModulusPoint {
                    angular_frequency,
                    storage: modulus.storage * noise(12.9898),
                    loss: modulus.loss * noise(78.233),
                }
            };
            Isotherm {
                temperature,
                points: (0..=24).map(f64::from).map(point).collect(),
            }
        };
        let temperatures = (0..9).map(|k| 10.0 + 8.0 * f64::from(k));
        temperatures.map(isotherm).collect()
    }

    #[test]
    fn isotherms_find_their_place_by_themselves() {
        // Exact data: what is left is the curvature between points an eighth of a decade apart.
        for (scatter, tolerance) in [(0.0, 0.01), (0.01, 0.03)] {
            let found =
                automatic_master_curve(&isotherms(scatter), 42.0, &SuperpositionOptions::default())
                    .unwrap();
            for shift in found.shifts {
                let (temperature, log) = (shift.temperature, shift.log10_factor);
                let exact = law().log10_factor(temperature).unwrap();
                let off = (log - exact).abs();
                assert!(
                    off <= tolerance,
                    "{scatter}: {log}, not {exact}, at {temperature}"
                );
            }
        }
    }

    #[test]
    fn a_given_law_puts_the_points_onto_the_curve() {
        let shift = |temperature| law().log10_factor(temperature);
        let master = shifted_master_curve(
            &isotherms(0.0),
            42.0,
            shift,
            &SuperpositionOptions::default(),
        )
        .unwrap();
        let material = named_spectrum("P10");
        let n_points = master.points.len();
        assert_eq!(n_points, 9 * 25, "no two reduced frequencies meet");
        for point in master.points {
            let exact = material.complex_modulus(point.angular_frequency).unwrap();
            assert_close!(point.storage => exact.storage, within 1e-12);
            assert_close!(point.loss => exact.loss, within 1e-12);
        }
    }

    #[test]
    fn points_that_meet_are_averaged() {
        let two = &isotherms(0.0)[..2];
        let master =
            shifted_master_curve(two, 42.0, |_| Ok(0.0), &SuperpositionOptions::default()).unwrap();
        assert_eq!(master.points.len(), 25, "every point meets another");
        let pairs = two[0].points.iter().zip(&two[1].points);
        for (mean, (one, other)) in master.points.iter().zip(pairs) {
            assert_close!(mean.storage => 0.5 * (one.storage + other.storage), within 1e-15);
            assert_close!(mean.loss => 0.5 * (one.loss + other.loss), within 1e-15);
        }
    }

    #[test]
    fn isotherms_without_common_moduli_are_refused() {
        let mut two = isotherms(0.0);
        two.truncate(2);
        for point in &mut two[1].points {
            point.storage *= 1e-4;
        }
        let error = automatic_master_curve(&two, 42.0, &SuperpositionOptions::default());
        assert_matches!(error, Err(RheologyError::NoOverlap { .. }));
    }
}
