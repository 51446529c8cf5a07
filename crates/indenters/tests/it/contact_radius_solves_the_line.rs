use casebook::assert_matches;
use indenters::{
    Axisymmetric, FlatCone, FlatPunch, IndenterError, PiecewiseLinearProfile, PowerProfile, Sphere,
    contact_radius,
};
use numerics::{bracketed_root, integrate};
use proptest::prelude::*;

use crate::casebook_bodies::{GaussianDip, body, superposition};
use crate::fixed_seed::fixed_seed;

#[test]
fn elastic_relations_agree_with_the_casebook() {
    for case in casebook::group("IND-05") {
        let (body, radius) = (body(&case), case.input("a"));
        let depth = case.expected("d").unwrap_or_else(|| case.input("d"));
        if case.expected("d").is_some() {
            case.check("d", body.line_height(radius));
        }
        let found = contact_radius(&*body, depth).unwrap();
        assert!(
            (found / radius - 1.0).abs() < 1e-12,
            "{}: contact radius {found}, expected {radius}",
            case.id()
        );
        case.check(
            "F",
            8.0 * case.input("G") * area_above(&*body, depth, radius),
        );
    }
}

/// ∫₀^a (d − h̃) dx, split at the kinks.
fn area_above(body: &dyn Axisymmetric, depth: f64, radius: f64) -> f64 {
    let mut ends = vec![0.0];
    ends.extend(body.kinks().iter().map(|kink| kink.radius));
    ends.retain(|end| *end < radius);
    ends.push(radius);
    ends.windows(2)
        .map(|piece| integrate(|x| depth - body.line_height(x), [piece[0], piece[1]], 1e-14).value)
        .sum()
}

#[test]
fn a_line_that_turns_down_names_its_limit() {
    for case in casebook::group("IND-06") {
        let result = if case.has_input("c2") {
            let body = superposition(&[(case.input("c2"), 2.0), (-case.input("c4"), 4.0)]);
            contact_radius(&body, 1.0)
        } else {
            contact_radius(&GaussianDip { length: 1.0 }, 1.3)
        };
        let Err(IndenterError::NonMonotoneLine {
            limiting_radius,
            limiting_depth,
            ..
        }) = result
        else {
            panic!("{}: {result:?} instead of NonMonotoneLine", case.id());
        };
        case.check("x_limit", limiting_radius);
        case.check("g_max", limiting_depth);
    }
}

#[test]
fn the_line_turns_before_the_body_does() {
    let cases = casebook::group("IND-06");
    let case = cases.iter().find(|case| case.has_input("c2")).unwrap();
    let body = superposition(&[(case.input("c2"), 2.0), (-case.input("c4"), 4.0)]);
    let [limit, depth] = ["x_limit", "g_max"].map(|name| case.expected(name).unwrap());
    case.check("F_max_G1", 8.0 * area_above(&body, depth, limit));
    let turns_at = bracketed_root(|r| body.profile_slope(r), [limit, 2.0 * limit]).unwrap();
    case.check("h_turns_at", turns_at);
}

#[test]
fn the_limit_is_found_in_every_unit() {
    // d/dx of the line vanishes at 1.501975268… lengths; it is found as a root, to rounding of the slope.
    let cases = casebook::group("IND-06");
    let dip = cases.iter().find(|case| !case.has_input("c2")).unwrap();
    for length in [1e-12, 1e-6, 1.0, 1e5, 1e12] {
        let body = GaussianDip { length };
        let Err(IndenterError::NonMonotoneLine {
            limiting_radius, ..
        }) = contact_radius(&body, 1.3 * length)
        else {
            panic!("length {length}: the line turns down below 1.3 lengths");
        };
        dip.check("x_limit", limiting_radius / length);
        let shallow = 0.5 * length;
        let radius = contact_radius(&body, shallow).unwrap();
        let reached = body.line_height(radius);
        assert!(
            (reached / shallow - 1.0).abs() < 1e-12 && radius < limiting_radius,
            "length {length}: depth {reached} at {radius}, expected {shallow}"
        );
    }
}

/// A paraboloid with a small pit around its apex, where the line turns down.
struct PittedParaboloid {
    pit: GaussianDip,
}

impl Axisymmetric for PittedParaboloid {
    fn profile_height(&self, radius: f64) -> f64 {
        radius * radius + self.pit.profile_height(radius)
    }

    fn profile_slope(&self, radius: f64) -> f64 {
        2.0 * radius + self.pit.profile_slope(radius)
    }

    fn profile_curvature(&self, radius: f64) -> f64 {
        2.0 + self.pit.profile_curvature(radius)
    }

    fn profile_exponent(&self) -> f64 {
        2.0
    }
}

#[test]
fn a_turn_far_below_the_contact_radius_is_not_overlooked() {
    let length = 1e-6;
    let body = PittedParaboloid {
        pit: GaussianDip { length },
    };
    let result = contact_radius(&body, 3.0);
    // The paraboloid moves the turn of the pit by a relative 1e-6.
    assert_matches!(
        result,
        Err(IndenterError::NonMonotoneLine { limiting_radius, .. }) if (limiting_radius / (1.501_975_268 * length) - 1.0).abs() < 1e-5
    );
}

#[test]
fn extreme_exponents_agree_with_the_casebook() {
    for case in casebook::group("EXT-03") {
        if case.expected("x_d").is_some() {
            let body = PowerProfile::new(case.input("c"), case.input("p")).unwrap();
            case.check("x_d", contact_radius(&body, case.input("D")).unwrap());
        }
    }
}

#[test]
fn a_flat_punch_touches_with_its_whole_end() {
    let punch = FlatPunch::new(0.3).unwrap();
    let table = PiecewiseLinearProfile::new(vec![0.0, 0.1, 0.3], vec![0.0; 3]).unwrap();
    for depth in [1e-300, 1.0, 1e300] {
        for found in [contact_radius(&punch, depth), contact_radius(&table, depth)] {
            assert_eq!(found, Ok(0.3), "flat end of radius 0.3 at depth {depth}");
        }
    }
}

#[test]
fn a_flat_end_is_always_in_contact() {
    // Near the edge d = t b √(2 (a/b − 1)), up to a relative (a/b − 1).
    let cone = FlatCone::new(0.5, 0.3).unwrap();
    let depth: f64 = 1e-6;
    let expected = 0.5 * (depth / (0.3 * 0.5)).powi(2);
    let excess = contact_radius(&cone, depth).unwrap() / 0.5 - 1.0;
    // One ulp of the radius is 1e-5 of the excess.
    assert!(
        (excess / expected - 1.0).abs() < 2e-5,
        "a/b − 1 = {excess}, expected {expected}"
    );
}

#[test]
fn a_body_that_ends_is_not_high_enough() {
    let table = PiecewiseLinearProfile::new(vec![0.0, 2.0], vec![0.0, 1.0]).unwrap();
    let available = table.line_height(2.0);
    assert_eq!(
        contact_radius(&table, 2.0),
        Err(IndenterError::NotHighEnough {
            available,
            depth: 2.0
        }),
        "the line of the cone ends at π/2"
    );
    let nearly = contact_radius(&table, available).unwrap();
    assert!(
        (nearly / 2.0 - 1.0).abs() < 1e-15,
        "at the full height the radius is {nearly}, expected 2"
    );
}

#[test]
fn a_deep_sphere_is_in_contact_up_to_its_equator() {
    let radius = contact_radius(&Sphere::new(2.0).unwrap(), 1e6).unwrap();
    assert!(
        radius <= 2.0 && radius > 2.0 * (1.0 - 1e-15),
        "contact radius {radius}"
    );
}

#[test]
fn depths_beyond_the_numbers_are_refused() {
    // (1 / 2)^(1e6) and 2^(1e6) metres are no numbers.
    let flat = PowerProfile::new(1.0, 1e-6).unwrap();
    let low = contact_radius(&flat, 0.5);
    assert_matches!(
        low,
        Err(IndenterError::InvalidParameter {
            parameter: "depth",
            ..
        })
    );
    let high = contact_radius(&flat, 2.0);
    assert_matches!(high, Err(IndenterError::NotHighEnough { available, .. }) if available < 1.01);
}

proptest! {
    #![proptest_config(fixed_seed())]

    #[test]
    fn contact_radius_inverts_the_line(
        exponent in 0.2..40.0_f64,
        slope in 1e-3..10.0_f64,
        decades in -12.0..12.0_f64,
        fraction in 0.1..3.0_f64,
    ) {
        // Coefficient for a body of the size `length`: h / length = slope (r / length)^p.
        let length = 10.0_f64.powf(decades);
        let coefficient = slope * length.powf(1.0 - exponent);
        prop_assume!(coefficient.is_normal());
        let body = PowerProfile::new(coefficient, exponent).unwrap();
        let expected = fraction * length;
        let depth = body.line_height(expected);
        let actual = contact_radius(&body, depth).unwrap();
        // One ulp of depth is 1/p ulps of radius.
        let allowed = 4.0 * f64::EPSILON * (1.0 + 1.0 / exponent);
        prop_assert!(
            (actual / expected - 1.0).abs() <= allowed,
            "radius {actual:e}, expected {expected:e} of {body:?}"
        );
    }

    #[test]
    fn contact_radius_inverts_sums_of_powers(
        first in 0.3..2.0_f64,
        second in 2.1..6.0_f64,
        ratio in -0.2..5.0_f64,
        decades in -12.0..12.0_f64,
        fraction in 0.01..0.5_f64,
    ) {
        prop_assume!(ratio != 0.0);
        let length = 10.0_f64.powf(decades);
        let body = superposition(&[
            (length.powf(1.0 - first), first),
            (ratio * length.powf(1.0 - second), second),
        ]);
        let expected = fraction * length;
        let actual = contact_radius(&body, body.line_height(expected)).unwrap();
        // One ulp of depth is h̃ / (x h̃') ulps of radius; the local exponent is at least 0.2 here.
        prop_assert!(
            (actual / expected - 1.0).abs() <= 1e-14,
            "radius {actual:e}, expected {expected:e} of {body:?}"
        );
    }
}
