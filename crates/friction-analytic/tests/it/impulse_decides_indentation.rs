use casebook::{Case, assert_close};
use friction_analytic::{
    Indentation, cylinder_half_width_after_impulse, impulse_to_depth, indentation_after_impulse,
    power_indentation_after_impulse,
};
use indenters::{Axisymmetric, Cylinder, Sphere};

use crate::support::{power, viscous};

fn check(case: &Case, contact: Indentation) {
    case.check("d", contact.indentation_depth);
    case.check("a", contact.contact_radius);
}

#[test]
fn impulse_decides_indentation() {
    for case in casebook::group("MDR-01") {
        let material = viscous(case.input("eta"));
        let impulse = case.expected("impulse");
        let impulse = impulse.unwrap_or_else(|| case.input("F") * case.input("t"));
        let body: Box<dyn Axisymmetric> = if case.has_input("p") {
            let profile = power(case.input("c"), case.input("p"));
            let closed = power_indentation_after_impulse(&profile, &material, impulse).unwrap();
            check(&case, closed);
            let impulse = impulse_to_depth(&profile, &material, closed.indentation_depth).unwrap();
            // Depth and time are powers of each other: d^(1 + 1/p) ~ t.
            case.check_within("t_check", impulse / case.input("F"), 1e-12);
            Box::new(profile)
        } else if case.has_input("F0") {
            Box::new(power(0.5 / case.input("R"), 2.0))
        } else {
            Box::new(Sphere::new(case.input("R")).unwrap())
        };
        let state = indentation_after_impulse(&body, &material, impulse);
        check(&case, state.unwrap());
    }
}

/// With η in place of G the impulse is the elastic force, also of a body without a closed form of its line.
#[test]
fn impulse_is_the_elastic_force_with_viscosity_for_modulus() {
    for case in casebook::group("IND-05") {
        let body = case.body();
        let force = |depth: f64| impulse_to_depth(&body, &viscous(1.0), depth).unwrap();
        let depth = case.expected("d").unwrap_or_else(|| case.input("d"));
        case.check("F", force(depth));
        let pressed = case.expected("F").expect("a force is expected");
        let contact = indentation_after_impulse(&body, &viscous(1.0), pressed).unwrap();
        let tolerance = case.relative_tolerance();
        assert_close!(contact.contact_radius => case.input("a"), within tolerance; "{}", case.id());
        assert_close!(contact.indentation_depth => depth, within tolerance; "{}", case.id());
        // dF/dd = 8 G a: central difference over 1e-4 d, whose error is of the order of 1e-8.
        let step = 1e-4 * depth;
        let slope = (force(depth + step) - force(depth - step)) / (2.0 * step);
        case.check_within("dFdd", slope, 1e-7);
    }
}

#[test]
fn no_impulse_makes_no_contact() {
    let (material, cone) = (viscous(1.0), power(1.0, 1.0));
    let nothing = Indentation::default();
    let closed = power_indentation_after_impulse(&cone, &material, 0.0);
    assert_eq!(closed, Ok(nothing), "closed form");
    let searched = indentation_after_impulse(&cone, &material, 0.0);
    assert_eq!(searched, Ok(nothing), "root search");
    let width = cylinder_half_width_after_impulse(&Cylinder::new(0.01).unwrap(), &material, 0.0);
    assert_eq!(width, Ok(0.0), "cylinder");
}

/// b = √(4 F' R/(π E*)) with E* = 4 G, where the impulse over the viscosity stands for F'/G.
#[test]
fn the_contact_of_a_cylinder_is_that_of_hertz_at_every_scale() {
    for scale in [1e-100, 1.0, 1e100] {
        let cylinder = Cylinder::new(0.01 * scale).unwrap();
        let width = cylinder_half_width_after_impulse(&cylinder, &viscous(1e6), 2000.0 * scale);
        let expected = (4.0 * 2000.0 * 0.01 / (std::f64::consts::PI * 4e6)).sqrt();
        assert_close!(width.unwrap() / scale => expected, within 1e-14; "scale {scale:e}");
    }
}
