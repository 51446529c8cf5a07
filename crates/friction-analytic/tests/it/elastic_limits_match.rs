use casebook::{assert_close, assert_matches, numbers, prony, refused};
use friction_analytic::{
    DivergenceCause, ElasticContact, FrictionError, high_speed_friction, low_speed_friction,
    slow_sliding,
};
use indenters::{Axisymmetric, FlatCone, Hyperboloid, RoundTippedCone, stretch};
use rheology::{Compressible, Prony};

use crate::support::power;

fn solid([g1, g2, tau]: [f64; 3]) -> Prony {
    prony([g1, 0.0], &[(g2, tau)])
}

const fn contact(contact_radius: f64, velocity: f64) -> ElasticContact {
    ElasticContact {
        contact_radius,
        velocity,
    }
}

#[test]
fn elastic_limits_match() {
    for case in casebook::group("FRI-05") {
        let radius = case.input("a");
        if case.expected("mu_fast").is_some() {
            let p = case.input("p");
            let profile = power(case.input("kappa_c") / stretch(p).unwrap(), p);
            let solid = solid(["G1", "G2", "tau"].map(|name| case.input(name)));
            // The tolerance of the group is that of a solver at finite speed; the limits themselves are exact.
            let slow = contact(radius, case.input("v_slow"));
            let slow = low_speed_friction(&profile, &solid, slow).unwrap();
            case.check_within("mu_slow_mdr", slow.line, 1e-12);
            case.check_within("mu_slow_3d", slow.half_space, 1e-12);
            let fast = contact(radius, case.input("v_fast"));
            let fast = high_speed_friction(&profile, &solid, fast).unwrap();
            case.check_within("mu_fast", fast.line, 1e-12);
            case.check_within("mu_fast", fast.half_space, 1e-12);
        }
        // ∫ p ∇²h dA = 8 G ∫₀^a h̃'² dx. With G = η_0 = v = 1 the right side is the tangential force on the line.
        if case.expected("int_p_laplacian_h").is_some() {
            let slow = low_speed_friction(&case.body(), &solid([1.0; 3]), contact(radius, 1.0));
            let slow = slow.unwrap();
            case.check_within("int_p_laplacian_h", slow.line * slow.normal_force, 1e-10);
        }
    }
}

/// μ_slow = (η v/G₁) κ c p (p + 1)/(2p − 1) a^(p − 2), μ_fast = (α/(G_g v)) κ c 2p/(2p + 1) a^p.
#[test]
fn power_profiles_have_both_limits_in_closed_form() {
    for [length, stress, time] in [
        [1.0, 1.0, 1.0],
        [1e-12, 1e12, 1e12],
        [1e12, 1e12, 1e-12],
        [1e-12, 1e-12, 1e-12],
    ] {
        let (g1, g2, tau) = (0.2 * stress, 3.0 * stress, 0.5 * time);
        let (a, v) = (0.7 * length, 2.0 * length / time);
        // 2 (1 − ν) = 8/5.
        let solid = Compressible::new(&solid([g1, g2, tau]), 0.2).unwrap();
        for p in [0.3, 0.51, 0.75, 1.0, 1.5, 2.0, 4.0, 10.0] {
            let c = 0.4 * length.powf(1.0 - p);
            let profile = power(c, p);
            let kc = profile.stretch() * c;
            let fast = high_speed_friction(&profile, &solid, contact(a, v)).unwrap();
            let rate = g2 / tau / (g1 + g2);
            let expected = rate / v * kc * 2.0 * p / (2.0 * p + 1.0) * a.powf(p);
            assert_close!(fast.half_space => expected, within 1e-11; "p = {p}");
            let force = 5.0 * (g1 + g2) * p / (p + 1.0) * profile.line_height(a) * a;
            assert_close!(fast.normal_force => force, within 1e-12; "p = {p}");
            if p <= 0.5 {
                continue;
            }
            let slow = low_speed_friction(&profile, &solid, contact(a, v)).unwrap();
            let expected =
                g2 * tau * v / g1 * kc * p * (p + 1.0) / (2.0 * p - 1.0) * a.powf(p - 2.0);
            assert_close!(slow.line => expected, within 1e-11; "p = {p}");
            assert_close!(slow.normal_force => force * g1 / (g1 + g2), within 1e-12; "p = {p}");
        }
    }
}

#[test]
fn slow_friction_diverges_where_the_viscous_one_does_and_fast_friction_does_not() {
    let (solid, contact) = (solid([1.0, 2.0, 3.0]), contact(0.7, 1.0));
    let jump = DivergenceCause::SlopeJump {
        radius: 0.5,
        jump: 0.3,
    };
    let apex = DivergenceCause::ApexExponent { exponent: 0.4 };
    let cone = FlatCone::new(0.5, 0.3).unwrap();
    // (2/9) ∫ (d − h̃)² dx / ∫ x h̃' dx by quadrature of 30 digits (mpmath), and (2/9) κ c 2p/(2p + 1) a^p.
    let of_cone = 0.033_973_611_898_866_51;
    let cusp = power(0.3, 0.4);
    let of_apex = 2.0 / 9.0 * cusp.stretch() * 0.3 * 0.8 / 1.8 * 0.7_f64.powf(0.4);
    for (body, expected, friction) in [
        (&cone as &dyn Axisymmetric, jump, of_cone),
        (&cusp, apex, of_apex),
    ] {
        let slow = low_speed_friction(body, &solid, contact);
        assert_matches!(slow, Err(FrictionError::FrictionDiverges { cause, contact_length, .. })
            if cause == expected && contact_length.total_cmp(&1.4).is_eq());
        let fast = high_speed_friction(body, &solid, contact).unwrap();
        assert_close!(fast.line => friction, within 1e-10);
    }
}

/// p, μ, area and rear with their errors, and that of the depth, with mpmath 1.3: Λ = Σ λ² − Σ τ² and Λ₃ = Σ λ³ − Σ τ³ over
/// the retardation times λ and the relaxation times τ, all times v.
const SLOW: &str = include_str!("../data/slow_sliding.txt");

#[test]
fn slow_sliding_has_friction_contact_and_errors_of_second_order() {
    let solid = prony([1.5, 0.0], &[(3.0, 0.003), (0.6, 0.02)]);
    let slide = |body: &dyn Axisymmetric| slow_sliding(body, &solid, contact(0.7, 2.0));
    for row in numbers::<8>(SLOW) {
        let slow = slide(&power(0.4, row[0])).unwrap();
        let found = [slow.friction_coefficient, slow.contact_area, slow.rear];
        let found = found.map(|bar| [bar.value, bar.error]);
        let found = found.as_flattened().iter().chain([&slow.elastic_error]);
        for (found, expected) in found.zip(&row[1..]) {
            assert_close!(*found => *expected, within 1e-12; "p = {}", row[0]);
        }
    }
    // A tip that is round on less than what a branch remembers.
    let [cone, round] = [
        &power(0.4, 1.0) as &dyn Axisymmetric,
        &Hyperboloid::new(1e-6, 0.4).unwrap(),
    ]
    .map(|body| slide(body).unwrap().friction_coefficient);
    let difference = (cone.value - round.value).abs();
    let holds = (cone.error..3.0 * difference).contains(&round.error) && difference < round.error;
    assert!(holds, "a cone has {cone:?}, round at its tip {round:?}");
    refused("apex exponent", slide(&power(0.4, 0.9)));
    refused("steepness", slide(&power(0.4, 11.0)));
    let fast = slow_sliding(&power(0.4, 2.0), &solid, contact(0.7, 20.0));
    refused("memory over radius", fast);
    let kinked = RoundTippedCone::new(0.1, 0.3).unwrap();
    refused("number of kinks", slide(&kinked));
}
