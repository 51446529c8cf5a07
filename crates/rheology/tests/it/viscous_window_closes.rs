use casebook::assert_close;
use rheology::{Material, StandardSolid};

use crate::support::solid;

#[test]
fn loss_peak_and_viscous_window_match_the_closed_forms() {
    for case in casebook::group("RHE-02") {
        if !case.has_input("gamma") {
            case.check("gamma_c", StandardSolid::LARGEST_VISCOUS_RATIO);
            continue;
        }
        // A relaxation time other than 1 shows that ω and Ω are told apart.
        let (maxwell_modulus, tau) = (4.0, 0.25);
        let solid = solid([
            case.input("gamma") * maxwell_modulus,
            maxwell_modulus,
            maxwell_modulus * tau,
        ]);
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
fn loss_tangent_is_one_at_the_ends_of_the_window_and_larger_inside() {
    for gamma in [1e-12, 1e-4, 0.05, 0.2, 0.207] {
        let solid = solid([gamma, 1.0, 3.0]);
        let [lower, upper] = solid.viscous_window().expect("the window is open");
        for end in [lower, upper] {
            assert_close!(solid.loss_tangent(end).unwrap() => 1.0, within 1e-14);
        }
        let peak = solid.loss_peak();
        assert!(
            lower < peak.angular_frequency && peak.angular_frequency < upper,
            "γ = {gamma}: the peak {peak:?} lies outside [{lower}, {upper}]"
        );
        let at_peak = solid.loss_tangent(peak.angular_frequency).unwrap();
        assert_close!(at_peak => peak.loss_tangent, within 1e-15);
        for shift in [0.9, 1.1] {
            let beside = solid.loss_tangent(shift * peak.angular_frequency).unwrap();
            assert!(
                beside < at_peak,
                "γ = {gamma}: {beside} beside the peak {at_peak}"
            );
        }
    }
}

#[test]
fn window_is_closed_from_its_threshold_up() {
    let threshold = StandardSolid::LARGEST_VISCOUS_RATIO;
    assert_eq!(
        solid([threshold, 1.0, 1.0]).viscous_window(),
        None,
        "at the threshold"
    );
    let [lower, upper] = solid([threshold * (1.0 - 1e-14), 1.0, 1.0])
        .viscous_window()
        .expect("just below the threshold the window is open");
    // Half width √(1 − 4γ(1+γ)) / (2 (1+γ)) with 1 − 4γ(1+γ) = 4 √2 · 1e-14 γ_c to leading order; γ itself is
    // rounded to 1e-16, that is to 1 % of its distance from the threshold.
    let half_width = (4.0 * 2_f64.sqrt() * 1e-14 * threshold).sqrt() / (2.0 * (1.0 + threshold));
    assert_close!(0.5 * (upper - lower) => half_width, within 0.01);
}
