use casebook::{assert_close, assert_matches};
use friction_analytic::{
    FrictionError, Indentation, impulse_to_depth, indentation_after_impulse,
    power_indentation_after_impulse, time_to_depth,
};
use indenters::{
    Axisymmetric, FlatPunch, IndenterError, PowerProfile, PowerTerm, Sphere, Superposition,
};
use numerics::integrate;
use proptest::prelude::*;
use rheology::Viscous;

use crate::support::{Bare, fixed_cases};

#[test]
fn impulse_decides_indentation() {
    for case in casebook::group("MDR-01") {
        let material = Viscous::new(case.input("eta")).unwrap();
        let impulse = case
            .expected("impulse")
            .unwrap_or_else(|| case.input("F") * case.input("t"));
        let general = if case.has_input("p") {
            let profile = PowerProfile::new(case.input("c"), case.input("p")).unwrap();
            let closed = power_indentation_after_impulse(&profile, &material, impulse).unwrap();
            case.check("d", closed.indentation_depth);
            case.check("a", closed.contact_radius);
            let time = time_to_depth(
                &profile,
                &material,
                closed.indentation_depth,
                case.input("F"),
            )
            .unwrap();
            // Depth and time are powers of each other: d^(1 + 1/p) ~ t.
            case.check_within("t_check", time, 1e-12);
            indentation_after_impulse(&profile, &material, impulse)
        } else if case.has_input("F0") {
            let paraboloid = PowerProfile::paraboloid(0.5 / case.input("R")).unwrap();
            indentation_after_impulse(&paraboloid, &material, impulse)
        } else {
            indentation_after_impulse(&Sphere::new(case.input("R")).unwrap(), &material, impulse)
        }
        .unwrap();
        case.check("d", general.indentation_depth);
        case.check("a", general.contact_radius);
    }
}

/// With η in place of G the impulse is the elastic force.
#[test]
fn impulse_is_the_elastic_force_with_viscosity_for_modulus() {
    let material = Viscous::new(1.0).unwrap();
    for case in casebook::group("IND-05") {
        let body = case.body();
        let force = case.expected("F").expect("a force is expected");
        let depth = case.expected("d").unwrap_or_else(|| case.input("d"));
        let from_depth = impulse_to_depth(body.as_ref(), &material, depth).unwrap();
        case.check("F", from_depth);
        let contact = indentation_after_impulse(body.as_ref(), &material, force).unwrap();
        assert_close!(
            contact.contact_radius => case.input("a"),
            within case.relative_tolerance(); "{}: a", case.id()
        );
        assert_close!(
            contact.indentation_depth => depth,
            within case.relative_tolerance(); "{}: d", case.id()
        );
        // dF/dd = 8 G a: central difference over 1e-4 d, whose error is of the order of 1e-8.
        let step = 1e-4 * depth;
        let [below, above] = [-step, step]
            .map(|step| impulse_to_depth(body.as_ref(), &material, depth + step).unwrap());
        case.check_within("dFdd", (above - below) / (2.0 * step), 1e-7);
    }
}

/// Betti's theorem with the pressure of a flat punch, p = 4 G/(π √(a² − r²)) per unit depth: F = ∫ p (d − h) dA.
#[test]
fn the_reciprocal_theorem_gives_the_same_force() {
    let material = Viscous::new(1.0).unwrap();
    for case in casebook::group("BEM-06") {
        let body = if case.has_input("R") {
            PowerProfile::paraboloid(0.5 / case.input("R")).unwrap()
        } else {
            PowerProfile::cone(case.input("tan_theta")).unwrap()
        };
        let radius = case.input("a");
        let depth = body.line_height(radius);
        // ∫ 2π r p (d − h) dr with r = a sin φ.
        let integrand = |phi: f64| {
            let r = radius * phi.sin();
            8.0 * r * (depth - body.profile_height(r))
        };
        let reciprocal = integrate(integrand, [0.0, std::f64::consts::FRAC_PI_2], 1e-13).value;
        case.check("F", reciprocal);
        case.check("F", impulse_to_depth(&body, &material, depth).unwrap());
    }
}

#[test]
fn any_shape_is_integrated_without_its_line() {
    let material = Viscous::new(3.0).unwrap();
    let sphere = Sphere::new(2.0).unwrap();
    for impulse in [1e-9, 0.5, 20.0, 200.0] {
        let closed_line = indentation_after_impulse(&sphere, &material, impulse).unwrap();
        let bare = indentation_after_impulse(&Bare(&sphere), &material, impulse).unwrap();
        assert_close!(bare.contact_radius => closed_line.contact_radius, within 1e-12);
        assert_close!(bare.indentation_depth => closed_line.indentation_depth, within 1e-11);
    }
}

#[test]
fn no_impulse_makes_no_contact() {
    let material = Viscous::new(1.0).unwrap();
    let cone = PowerProfile::cone(1.0).unwrap();
    let nothing = Indentation {
        contact_radius: 0.0,
        indentation_depth: 0.0,
    };
    assert_eq!(
        power_indentation_after_impulse(&cone, &material, 0.0),
        Ok(nothing),
        "closed form"
    );
    assert_eq!(
        indentation_after_impulse(&cone, &material, 0.0),
        Ok(nothing),
        "root search"
    );
}

#[test]
fn a_punch_sinks_in_proportion_to_the_impulse() {
    let (radius, eta) = (0.5, 3.0);
    let punch = FlatPunch::new(radius).unwrap();
    let material = Viscous::new(eta).unwrap();
    for impulse in [1e-6, 1.0, 1e6] {
        let contact = indentation_after_impulse(&punch, &material, impulse).unwrap();
        assert_close!(contact.contact_radius => radius, within 1e-16);
        assert_close!(contact.indentation_depth => impulse / (8.0 * eta * radius), within 1e-15);
    }
}

#[test]
fn bad_impulses_depths_and_bodies_are_refused() {
    let material = Viscous::new(1.0).unwrap();
    let cone = PowerProfile::cone(1.0).unwrap();
    for impulse in [-1.0, f64::NAN, f64::INFINITY] {
        for result in [
            power_indentation_after_impulse(&cone, &material, impulse),
            indentation_after_impulse(&cone, &material, impulse),
        ] {
            assert_matches!(
                result,
                Err(FrictionError::InvalidParameter {
                    parameter: "impulse",
                    ..
                }),
                "impulse {impulse}"
            );
        }
    }
    for depth in [0.0, -1.0, f64::NAN] {
        let result = impulse_to_depth(&cone, &material, depth);
        assert_matches!(
            result,
            Err(FrictionError::Indenter(IndenterError::InvalidParameter {
                parameter: "depth",
                ..
            })),
            "depth {depth}"
        );
    }
    for force in [0.0, -1.0, f64::NAN] {
        let result = time_to_depth(&cone, &material, 1.0, force);
        assert_matches!(
            result,
            Err(FrictionError::InvalidParameter {
                parameter: "normal_force",
                ..
            }),
            "force {force}"
        );
    }
    // h̃ = (π/2) x − 2 x² falls from x = π/8 on, and so does its moment later.
    let terms = [(1.0, 1.0), (-1.0, 2.0)].map(|(coefficient, exponent)| PowerTerm {
        coefficient,
        exponent,
    });
    let falling = Superposition::new(terms.to_vec()).unwrap();
    let result = indentation_after_impulse(&falling, &material, 1e6);
    assert!(result.is_err(), "{result:?} of a body that turns downwards");
}

proptest! {
    #![proptest_config(fixed_cases(64))]

    #[test]
    fn root_search_agrees_with_the_closed_form(
        p in 0.2_f64..30.0,
        log_impulse in -12.0_f64..12.0,
        log_length in -9.0_f64..9.0,
    ) {
        let length = 10_f64.powf(log_length);
        let profile = PowerProfile::new(0.7 * length.powf(1.0 - p), p).unwrap();
        let material = Viscous::new(5.0).unwrap();
        let impulse = 10_f64.powf(log_impulse) * length * length;
        let closed = power_indentation_after_impulse(&profile, &material, impulse).unwrap();
        let searched = indentation_after_impulse(&profile, &material, impulse).unwrap();
        assert_close!(searched.contact_radius => closed.contact_radius, within 1e-12);
        // d = κ c a^p multiplies the rounding of a with p.
        assert_close!(
            searched.indentation_depth => closed.indentation_depth,
            within 1e-12 + 1e-14 * p
        );
    }
}
