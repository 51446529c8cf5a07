use casebook::assert_close;
use rheology::{Material, StandardSolid};

use crate::support::solid;

/// Over 600 decades the three functions agree with one another and with their leading terms.
#[test]
fn no_frequency_overflows() {
    for gamma in [1e-12, 1e-3, 0.2, 1.0, 1e6] {
        let solid = solid([gamma, 1.0, 1.0]);
        for exponent in -300..=300 {
            let omega = 10_f64.powi(exponent);
            let modulus = solid.complex_modulus(omega).unwrap();
            let tangent = solid.loss_tangent(omega).unwrap();
            let what = format!("Ω = {omega:e}, γ = {gamma:e}");
            // Each of the three is rounded a handful of times.
            assert_close!(tangent => modulus.loss / modulus.storage, within 2e-15; "{what}");
            let asymptote = omega.min(omega.recip());
            let expected = asymptote / (1.0 + asymptote * asymptote);
            assert_close!(modulus.loss => expected, within 1e-15; "{what}");
        }
    }
}

#[test]
fn loss_peak_and_viscous_window_match_the_closed_forms() {
    for case in casebook::group("RHE-02") {
        if !case.has_input("gamma") {
            case.check("gamma_c", StandardSolid::LARGEST_VISCOUS_RATIO);
            continue;
        }
        // A relaxation time other than 1 shows that ω and Ω are distinguished.
        let (g2, tau) = (4.0, 0.25);
        let solid = solid([case.input("gamma") * g2, g2, g2 * tau]);
        let peak = solid.loss_peak();
        case.check("W_star", peak.angular_frequency * tau);
        case.check("tan_delta_max", peak.loss_tangent);
        case.check("tau_c_over_tau", solid.retardation_time() / tau);
        match (solid.viscous_window(), case.expected("W_minus")) {
            (Some([lower, upper]), Some(_)) => {
                case.check("W_minus", lower * tau);
                case.check("W_plus", upper * tau);
            }
            (window, expected) => {
                assert_eq!(window.map(|[lower, _]| lower), expected, "{}", case.id());
            }
        }
    }
}

#[test]
fn window_is_closed_from_its_threshold_up() {
    let threshold = StandardSolid::LARGEST_VISCOUS_RATIO;
    let window = |gamma| solid([gamma, 1.0, 1.0]).viscous_window();
    assert_eq!(window(threshold), None, "at the threshold");
    let [lower, upper] = window(threshold * (1.0 - 1e-14)).expect("just below it is open");
    // Half width √(1 − 4γ(1+γ)) / (2 (1+γ)) with 1 − 4γ(1+γ) = 4 √2 · 1e-14 γ_c to leading order; γ itself is
    // rounded to 1e-16, that is to 1 % of its distance from the threshold.
    let half_width = (4.0 * 2_f64.sqrt() * 1e-14 * threshold).sqrt() / (2.0 * (1.0 + threshold));
    assert_close!(0.5 * (upper - lower) => half_width, within 0.01);
}
