use casebook::assert_close;
use friction_analytic::{
    DivergenceCause, ElasticContact, FrictionError, high_speed_friction, low_speed_friction,
};
use indenters::{Axisymmetric, FlatCone, PowerProfile, stretch};
use rheology::{StandardSolid, StandardSolidParameters};

fn solid([g1, g2, tau]: [f64; 3]) -> StandardSolid {
    StandardSolid::new(StandardSolidParameters {
        equilibrium_modulus: g1,
        maxwell_modulus: g2,
        viscosity: g2 * tau,
    })
    .unwrap()
}

#[test]
fn elastic_limits_match() {
    for case in casebook::group("FRI-05") {
        if case.expected("mu_fast").is_none() {
            continue;
        }
        let p = case.input("p");
        let profile = PowerProfile::new(case.input("kappa_c") / stretch(p).unwrap(), p).unwrap();
        let solid = solid(["G1", "G2", "tau"].map(|name| case.input(name)));
        let at = |speed: &str| ElasticContact {
            contact_radius: case.input("a"),
            velocity: case.input(speed),
        };
        let slow = low_speed_friction(&profile, &solid, at("v_slow")).unwrap();
        // The tolerance of the group is that of a solver at finite speed; the limits themselves are exact.
        case.check_within("mu_slow_mdr", slow.line, 1e-12);
        case.check_within("mu_slow_3d", slow.half_space, 1e-12);
        let fast = high_speed_friction(&profile, &solid, at("v_fast")).unwrap();
        case.check_within("mu_fast", fast.line, 1e-12);
        case.check_within("mu_fast", fast.half_space, 1e-12);
    }
}

/// ∫ p ∇²h dA = 8 G ∫₀^a h̃'² dx. With G = η_0 = v = 1 the right side is the tangential force on the line.
#[test]
fn pressure_times_curvature_is_the_slope_energy() {
    for case in casebook::group("FRI-05") {
        if case.expected("int_p_laplacian_h").is_none() {
            continue;
        }
        let body = case.body();
        let contact = ElasticContact {
            contact_radius: case.input("a"),
            velocity: 1.0,
        };
        let slow = low_speed_friction(body.as_ref(), &solid([1.0, 1.0, 1.0]), contact).unwrap();
        case.check_within("int_p_laplacian_h", slow.line * slow.normal_force, 1e-10);
    }
}

/// μ_slow = (η v/G₁) κ c p (p + 1)/(2p − 1) a^(p − 2), μ_fast = (α/(G_g v)) κ c 2p/(2p + 1) a^p.
#[test]
fn power_profiles_have_both_limits_in_closed_form() {
    let (g1, g2, tau, a, v, c) = (0.2, 3.0, 0.5, 0.7, 2.0, 0.4);
    let solid = solid([g1, g2, tau]);
    let contact = ElasticContact {
        contact_radius: a,
        velocity: v,
    };
    for p in [0.3, 0.51, 0.75, 1.0, 1.5, 2.0, 4.0, 10.0] {
        let profile = PowerProfile::new(c, p).unwrap();
        let kc = profile.stretch() * c;
        let fast = high_speed_friction(&profile, &solid, contact).unwrap();
        let rate = g2 / tau / (g1 + g2);
        let expected = rate / v * kc * 2.0 * p / (2.0 * p + 1.0) * a.powf(p);
        assert_close!(fast.half_space => expected, within 1e-11; "fast μ, p = {p}");
        let force = 8.0 * (g1 + g2) * p / (p + 1.0) * profile.line_height(a) * a;
        assert_close!(fast.normal_force => force, within 1e-12; "fast F, p = {p}");
        if p <= 0.5 {
            continue;
        }
        let slow = low_speed_friction(&profile, &solid, contact).unwrap();
        let expected = g2 * tau * v / g1 * kc * p * (p + 1.0) / (2.0 * p - 1.0) * a.powf(p - 2.0);
        assert_close!(slow.line => expected, within 1e-11; "slow μ, p = {p}");
        assert_close!(slow.normal_force => force * g1 / (g1 + g2), within 1e-12; "slow F, p = {p}");
    }
}

#[test]
fn slow_friction_diverges_where_the_viscous_one_does_and_fast_friction_does_not() {
    let solid = solid([1.0, 2.0, 3.0]);
    let contact = ElasticContact {
        contact_radius: 0.7,
        velocity: 1.0,
    };
    let cone = FlatCone::new(0.5, 0.3).unwrap();
    let sharp = PowerProfile::new(0.3, 0.4).unwrap();
    let bodies: [&dyn Axisymmetric; 2] = [&cone, &sharp];
    let causes = [
        DivergenceCause::SlopeJump {
            radius: 0.5,
            jump: 0.3,
        },
        DivergenceCause::ApexExponent { exponent: 0.4 },
    ];
    for (body, expected) in bodies.into_iter().zip(causes) {
        let result = low_speed_friction(body, &solid, contact);
        let Err(FrictionError::FrictionDiverges { cause, .. }) = result else {
            panic!("{result:?} instead of {expected}");
        };
        assert_eq!(cause, expected, "cause of the divergence");
        let fast = high_speed_friction(body, &solid, contact).unwrap();
        assert!(fast.line > 0.0, "fast friction {fast:?}");
    }
}
