use casebook::assert_close;
use rheology::Material;

use crate::support::solid;

#[test]
fn moduli_match_equation_2() {
    for case in casebook::group("RHE-01") {
        let solid = solid(["G1", "G2", "eta"].map(|name| case.input(name)));
        let omega = case.input("omega");
        case.check("G_storage", solid.storage_modulus(omega).unwrap());
        case.check("G_loss", solid.loss_modulus(omega).unwrap());
        case.check("tan_delta", solid.loss_tangent(omega).unwrap());
    }
}

/// Over 600 decades the three functions agree with one another and with their leading terms.
#[test]
fn no_frequency_overflows() {
    for gamma in [1e-12, 1e-3, 0.2, 1.0, 1e6] {
        let solid = solid([gamma, 1.0, 1.0]);
        for exponent in -300..=300 {
            let omega = 10_f64.powi(exponent);
            let storage = solid.storage_modulus(omega).unwrap();
            let loss = solid.loss_modulus(omega).unwrap();
            let tangent = solid.loss_tangent(omega).unwrap();
            let what = format!("tan δ at Ω = {omega:e}, γ = {gamma:e}");
            // Each of the three is rounded a handful of times.
            assert_close!(tangent => loss / storage, within 2e-15; "{what}");
            let asymptote = omega.min(omega.recip());
            let deviation = asymptote * asymptote;
            let what = format!("G'' at Ω = {omega:e}, γ = {gamma:e}");
            assert_close!(loss => asymptote / (1.0 + deviation), within 1e-15; "{what}");
        }
    }
}
