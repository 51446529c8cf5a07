use casebook::{GaussianDip, assert_close, assert_matches, fixed_cases, superposition};
use indenters::{
    Axisymmetric, FlatCone, FlatPunch, IndenterError, PowerProfile, ProfilePoint, Sphere,
    contact_radius, line_radius,
};
use numerics::{bracketed_root, integrate};
use proptest::prelude::*;

use crate::support::table;

#[test]
fn elastic_relations_agree_with_the_casebook() {
    for case in casebook::group("IND-05") {
        let (body, radius) = (case.body(), case.input("a"));
        let depth = case.expected("d").unwrap_or_else(|| case.input("d"));
        if case.expected("d").is_some() {
            case.check("d", body.line_height(radius));
        }
        assert_close!(contact_radius(&*body, depth).unwrap() => radius, within 1e-12; "{}", case.id());
    }
}

/// The radius and depth that the error names as the last ones before the line turns down.
fn limits(body: &dyn Axisymmetric, depth: f64) -> [f64; 2] {
    match contact_radius(body, depth) {
        Err(IndenterError::NonMonotoneLine {
            limiting_radius,
            limiting_depth,
            ..
        }) => [limiting_radius, limiting_depth],
        other => panic!("{other:?} instead of NonMonotoneLine at depth {depth}"),
    }
}

#[test]
fn a_line_that_turns_down_names_its_limit_in_every_unit() {
    for case in casebook::group("IND-06") {
        if case.has_input("c2") {
            let body = superposition(&[(case.input("c2"), 2.0), (-case.input("c4"), 4.0)]);
            let [limit, depth] = limits(&body, 1.0);
            case.check("x_limit", limit);
            case.check("g_max", depth);
            let area = integrate(|x| depth - body.line_height(x), [0.0, limit], 1e-14);
            case.check("F_max_G1", 8.0 * area.value);
            // The body itself turns later, and ends there.
            case.check("h_turns_at", body.max_radius());
            continue;
        }
        // It is found as a root, to rounding of the slope.
        for length in [1e-12, 1e-6, 1.0, 1e5, 1e12] {
            let body = GaussianDip { length };
            let [limit, depth] = limits(&body, 1.3 * length);
            case.check("x_limit", limit / length);
            case.check("g_max", depth / length);
            let radius = contact_radius(&body, 0.5 * length).unwrap();
            assert_close!(body.line_height(radius) => 0.5 * length, within 1e-12);
            assert!(radius < limit, "{radius} beyond the limit {limit}");
        }
    }
}

/// A paraboloid with a small pit around its apex, where the line turns down.
struct PittedParaboloid(GaussianDip);

impl Axisymmetric for PittedParaboloid {
    fn profile(&self, radius: f64) -> ProfilePoint {
        let pit = self.0.profile(radius);
        ProfilePoint {
            height: radius * radius + pit.height,
            slope: 2.0 * radius + pit.slope,
            curvature: 2.0 + pit.curvature,
        }
    }

    fn profile_exponent(&self) -> f64 {
        2.0
    }
}

#[test]
fn turns_that_are_narrow_or_far_below_are_not_overlooked() {
    // The paraboloid moves the turn of the pit by a relative 1e-6.
    let pitted = PittedParaboloid(GaussianDip { length: 1e-6 });
    assert_close!(limits(&pitted, 3.0)[0] => 1.501_975_268e-6, within 1e-5);
    // Narrower than the steps of the search.
    let notched = table(&[0.0, 1.0, 1.001, 2.0], &[0.0, 1.0, 1.0, 2.0]);
    assert_close!(limits(&notched, 3.0)[0] => 1.0, within 0.0);
}

#[test]
fn a_downward_kink_limits_the_contact() {
    let body = table(&[0.0, 1.0, 2.0, 3.0], &[0.0, 0.1, 0.5, 0.6]);
    let limit = body.line_height(2.0);
    let below = line_radius(&body, 0.999 * limit).unwrap();
    let is_near = (1.9..2.0).contains(&below);
    assert!(is_near, "radius {below} just below the edge at 2");
    let [radius, depth] = limits(&body, 1.001 * limit);
    assert_close!(radius => 2.0, within 0.0);
    assert_close!(depth => limit, within 0.0);
    // The flat flank beyond the kink touches before: there the gap closes at the end of the body.
    let [radius, _] = limits(&body, 0.999 * limit);
    assert!(radius > 1.7 && radius < 1.9, "radius {radius}");
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
    let table = table(&[0.0, 0.1, 0.3], &[0.0; 3]);
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
    let excess = contact_radius(&cone, depth).unwrap() / 0.5 - 1.0;
    // One ulp of the radius is 1e-5 of the excess.
    assert_close!(excess => 0.5 * (depth / (0.3 * 0.5)).powi(2), within 2e-5);
}

#[test]
fn a_body_that_ends_is_not_high_enough() {
    let cone = table(&[0.0, 2.0], &[0.0, 1.0]);
    let available = cone.line_height(2.0);
    let depth = 2.0;
    let refused = Err(IndenterError::NotHighEnough { available, depth });
    assert_eq!(contact_radius(&cone, depth), refused, "it ends at π/2");
    assert_close!(contact_radius(&cone, available).unwrap() => 2.0, within 1e-15);
    // The line of a sphere is infinite at its end.
    let radius = contact_radius(&Sphere::new(2.0).unwrap(), 1e6).unwrap();
    assert!(radius <= 2.0, "{radius} beyond the equator");
    assert_close!(radius => 2.0, within 1e-15);
}

#[test]
fn depths_beyond_the_numbers_are_refused() {
    // (1 / 2)^(1e6) and 2^(1e6) metres are no numbers.
    let flat = PowerProfile::new(1.0, 1e-6).unwrap();
    let low = contact_radius(&flat, 0.5);
    assert_matches!(
        low,
        Err(IndenterError::InvalidParameter(invalid)) if invalid.parameter == "depth"
    );
    let high = contact_radius(&flat, 2.0);
    assert_matches!(high, Err(IndenterError::NotHighEnough { available, .. }) if available < 1.01);
}

proptest! {
    #![proptest_config(fixed_cases(256))]

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
        assert_close!(actual => expected, within 1e-14; "{body:?}");
    }
}

/// The contact of a body that turns down at a radius of 1 closes its gap there before its line turns.
#[test]
fn a_body_that_touches_farther_out_has_no_contact_radius() {
    // h = r²/2 − r⁴/4, h̃ = x² − 2 x⁴/3.
    let body = superposition(&[(0.5, 2.0), (-0.25, 4.0)]);
    let gap_at_crest = |a: f64| {
        let depth = body.line_height(a);
        // ∫ x² and ∫ x⁴ over √(1 − x²) from a to 1, in closed form.
        let (root, angle) = ((1.0 - a * a).sqrt(), a.acos());
        let square = 0.5 * (angle + a * root);
        let fourth = 0.25 * (a.powi(3) * root + 3.0 * square);
        square - 2.0 / 3.0 * fourth - depth * angle
    };
    let limit = bracketed_root(gap_at_crest, [0.3, 0.86]).unwrap();
    let [radius, depth] = limits(&body, body.line_height(0.5 * (limit + 0.75_f64.sqrt())));
    assert_close!(radius => limit, within 1e-8);
    assert_close!(depth => body.line_height(limit), within 1e-8);
    let inside = body.line_height(0.999 * limit);
    assert_close!(contact_radius(&body, inside).unwrap() => 0.999 * limit, within 1e-12);
    assert!(
        line_radius(&body, depth * 1.001).is_ok(),
        "the line itself still rises"
    );
}
