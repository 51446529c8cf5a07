use casebook::assert_close;
use rheology::{Material, Viscous};

use crate::support::solid;

/// γ → 0: J = 1/G + t/η, G' and G'' of a spring and a dashpot in series, tan δ = 1/Ω.
#[test]
fn without_the_lone_spring_it_is_a_maxwell_fluid() {
    let (modulus, eta) = (1e6, 2e4);
    let solid = solid([1e-300, modulus, eta]);
    for exponent in -9..=9 {
        let time = 10_f64.powi(exponent);
        assert_close!(
            solid.creep_compliance(time).unwrap() => 1.0 / modulus + time / eta,
            within 1e-15
        );
        let omega = time * eta / modulus;
        let square = omega * omega;
        let storage = modulus * square / (1.0 + square);
        assert_close!(solid.storage_modulus(time).unwrap() => storage, within 1e-14);
        assert_close!(solid.loss_tangent(time).unwrap() => omega.recip(), within 1e-15);
    }
}

/// The paper's reason for a purely viscous material: where γ << Ω << 1 the dashpot carries the load alone.
#[test]
fn the_middle_range_is_viscous() {
    let solid = solid([1e-12, 1.0, 5.0]);
    let viscous = Viscous::new(5.0).unwrap();
    for exponent in -10..=-1 {
        let omega = 10_f64.powi(exponent) / solid.relaxation_time();
        let square = 10_f64.powi(2 * exponent);
        let loss = solid.loss_modulus(omega).unwrap();
        // G'' = ω η / (1 + Ω²).
        let expected = viscous.loss_modulus(omega).unwrap() / (1.0 + square);
        assert_close!(loss => expected, within 1e-14);
        assert!(
            solid.storage_modulus(omega).unwrap() < 0.11 * loss,
            "at ω = {omega} the storage modulus is not small beside {loss}"
        );
    }
}
