use casebook::assert_close;
use proptest::prelude::*;
use rheology::Material;

use crate::support::{fixed_cases, solid};

#[test]
fn creep_survives_a_vanishing_spring() {
    for case in casebook::group("EXT-04") {
        if case.expected("J_t").is_none() {
            continue;
        }
        let g2 = case.input("G2");
        let solid = solid([case.input("G1"), g2, case.input("tau") * g2]);
        // Each of the four factors of J is rounded once: far below the tolerance of the group.
        case.check_within(
            "J_t",
            solid.creep_compliance(case.input("t")).unwrap(),
            1e-15,
        );
    }
}

#[test]
fn creep_starts_in_the_glass_and_ends_in_the_equilibrium() {
    let solid = solid([2.0, 6.0, 3.0]);
    assert_close!(solid.creep_compliance(0.0).unwrap() => 1.0 / 8.0, within 1e-16);
    assert_close!(solid.creep_compliance(1e6).unwrap() => 1.0 / 2.0, within 1e-15);
    assert_close!(solid.relaxation_modulus(0.0).unwrap() => 8.0, within 1e-16);
    assert_close!(solid.relaxation_modulus(1e6).unwrap() => 2.0, within 1e-16);
}

/// ∫₀ᵗ G(t − s) J(s) ds = t, what makes one the inverse of the other.
#[test]
fn creep_is_the_inverse_of_relaxation() {
    let solid = solid([0.3, 1.0, 2.0]);
    for t in [0.01, 1.0, 30.0] {
        // Simpson's rule with 2000 intervals: the error is (t/2000)^4 t/180 |f''''| < 1e-10 t at t = 30.
        let n = 2000_u32;
        let width = t / f64::from(n);
        let sum: f64 = (0..=n)
            .map(|k| {
                let s = width * f64::from(k);
                let weight = match k {
                    0 => 1.0,
                    k if k == n => 1.0,
                    k if k % 2 == 1 => 4.0,
                    _ => 2.0,
                };
                weight
                    * solid.relaxation_modulus(t - s).unwrap()
                    * solid.creep_compliance(s).unwrap()
            })
            .sum();
        assert_close!(sum * width / 3.0 => t, within 1e-9);
    }
}

proptest! {
    #![proptest_config(fixed_cases())]

    /// The textbook form, where it does not cancel.
    #[test]
    fn creep_has_the_textbook_form(gamma in 0.1_f64..10.0, log_time in -2.0_f64..3.0, log_scale in -12.0_f64..12.0) {
        let scale = 10_f64.powf(log_scale);
        let (g1, g2, eta) = (gamma * scale, scale, 7.0);
        let solid = solid([g1, g2, eta]);
        let time = 10_f64.powf(log_time) * solid.relaxation_time();
        let decay = (-time / solid.retardation_time()).exp();
        let textbook = 1.0 / g1 - g2 / (g1 * (g1 + g2)) * decay;
        assert_close!(solid.creep_compliance(time).unwrap() => textbook, within 1e-13);
    }
}
