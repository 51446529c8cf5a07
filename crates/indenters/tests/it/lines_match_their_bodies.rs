use casebook::{assert_close, assert_matches};
use indenters::{
    AnalyticLine, Axisymmetric, EquivalentLine, FlatCone, FlatPunch, IndenterError, PowerProfile,
    ProfilePoint, RigidLine, Sphere, Surface, abel_height, abel_slope, inverse_abel,
    surface_of_revolution,
};

use crate::support::{CLOSED_RADII, all_shapes, boxed, out_of_domain, table};

#[test]
fn heights_and_lines_agree_with_the_casebook() {
    for case in casebook::group("IND-02") {
        let (body, x) = (case.body(), case.input("x"));
        let line = EquivalentLine(&*body);
        case.check("h", body.profile_height(x));
        case.check("g", line.height(x));
        case.check("dg", line.slope(x));
        assert_close!(line.height(-x) => line.height(x), within 0.0; "{}", case.id());
        assert_close!(line.slope(-x) => -line.slope(x), within 0.0; "{}", case.id());
    }
}

#[test]
fn table_lines_agree_with_the_casebook() {
    for case in casebook::group("IND-04") {
        let table = table(&case.input_list("r"), &case.input_list("h"));
        let height = table.checked_line_height(case.input("x"));
        if case.expected_error().is_none() {
            case.check("g", height.unwrap());
            continue;
        }
        let beyond = out_of_domain(3.5, 3.0);
        assert_eq!(height, Err(beyond), "{} must not extrapolate", case.id());
    }
}

#[test]
fn collinear_rows_are_no_kink() {
    // 0.1 k and 0.3 k are not exact: slopes of neighbouring pieces differ in the last digits.
    let rows = |step: f64| -> Vec<f64> { (0..50).map(|k| step * f64::from(k)).collect() };
    let table = table(&rows(0.1), &rows(0.3));
    assert_eq!(table.kinks(), Vec::new(), "the table is a cone");
    let expected = std::f64::consts::FRAC_PI_2 * 3.0 * 3.33;
    assert_close!(table.line_height(3.33) => expected, within 1e-14);
}

#[test]
fn closed_lines_equal_the_numerical_transform() {
    // The quadrature is asked for 1e-14 of the integral of the modulus; 1e-12 leaves room for cancellation.
    for (name, body) in all_shapes() {
        let inside = |x: &f64| *x <= body.max_radius();
        for x in [1e-6, 0.01, 0.3, 0.50001, 0.55, 0.9, 1.05]
            .into_iter()
            .filter(inside)
        {
            assert_close!(abel_height(&*body, x) => body.line_height(x), within 1e-12; "{name}, x = {x}");
            assert_close!(abel_slope(&*body, x) => body.line_slope(x), within 1e-12; "{name}, x = {x}");
            let radius = body.closed_radius(body.line_height(x));
            let is_inverse = radius.map(|radius| (radius / x - 1.0).abs() < 1e-13);
            let is_known = CLOSED_RADII.contains(&name);
            assert!(is_inverse == is_known.then_some(true), "{name}: {radius:?}");
        }
        // h̃ ∼ x^p at the apex; both are 0 below a flat end.
        let exponent = EquivalentLine(&*body).apex_exponent();
        let local = 1e-9 * body.line_slope(1e-9) / body.line_height(1e-9);
        let is_flat = local.is_nan() && exponent.is_infinite();
        let is_same = is_flat || (local / exponent - 1.0).abs() < 1e-6;
        assert!(is_same, "{name}: {local} and {exponent}");
        let [slope, closed] = [abel_slope(&*body, 0.0), body.line_slope(0.0)];
        let is_same = slope.to_bits() == closed.to_bits() || (slope - closed).abs() < 1e-15;
        assert!(is_same, "{name}: {slope} and {closed} at the apex");
    }
}

#[test]
fn lines_near_a_kink_keep_their_digits() {
    // Just outside the flat end, x = b (1 + ε): h̃ = t b √(2ε) and h̃' = t / √(2ε) up to O(ε).
    let epsilon = 2.0_f64.powi(-44);
    let cone = FlatCone::new(0.5, 0.3).unwrap();
    let x = 0.5 * (1.0 + epsilon);
    let root = (2.0 * epsilon).sqrt();
    assert_close!(cone.line_height(x) => 0.3 * 0.5 * root, within 1e-12);
    assert_close!(cone.line_slope(x) => 0.3 / root, within 1e-12);
}

#[test]
fn gradients_and_curvatures_are_derivatives() {
    // Central differences of step δ: truncation h''' δ²/6 and rounding ε h / δ are both below 1e-9 at δ = 1e-5.
    let step = 1e-5;
    let check = |what: &str, actual: f64, at: &dyn Fn(f64) -> f64, size: f64| {
        let expected = (at(step) - at(-step)) / (2.0 * step);
        let is_close = (actual - expected).abs() < 1e-7 * (1.0 + size);
        assert!(is_close, "{what}: {actual}, by differences {expected}");
    };
    for (name, body) in all_shapes() {
        let across = [0.1, 0.25, -0.33, -0.6, 0.1];
        for (x, y) in [0.3, -0.2, 0.0, -0.6, 0.95].into_iter().zip(across) {
            let [along, across] = body.gradient([x, y]);
            let size = along.hypot(across);
            let place = format!("gradient of {name} at [{x}, {y}]");
            check(&place, along, &|d| body.height([x + d, y]), size);
            check(&place, across, &|d| body.height([x, y + d]), size);
        }
        for r in [0.1, 0.3, 0.6, 0.9] {
            let curvature = body.profile(r).curvature;
            let place = format!("curvature of {name} at {r}");
            let slope = |d: f64| body.profile_slope(r + d);
            check(&place, curvature, &slope, curvature.abs());
        }
    }
}

#[test]
fn shapes_are_numbers_everywhere() {
    let mut shapes = all_shapes();
    shapes.push(("flat punch", boxed(FlatPunch::new(0.5))));
    shapes.push(("steep", boxed(PowerProfile::new(1e300, 1e6))));
    for (name, body) in shapes {
        for r in [0.0, 5e-324, 1e-300, 0.5, 1.1, 2.0, 1e12, 1e200] {
            let [x, y] = body.gradient([r, 0.0]);
            let line = [body.line_height(r), body.line_slope(r), body.line_slope(-r)];
            let values = [[body.profile_height(r), x, y], line];
            let are_numbers = values.as_flattened().iter().all(|value| !value.is_nan());
            assert!(are_numbers, "{name} at r = {r}: {values:?}");
        }
    }
}

/// A cone that ends, whose formulas do not know it.
struct Stub;

impl Axisymmetric for Stub {
    fn profile(&self, radius: f64) -> ProfilePoint {
        ProfilePoint {
            height: if radius > 1.0 { f64::INFINITY } else { radius },
            slope: 1.0,
            curvature: 0.0,
        }
    }

    fn profile_exponent(&self) -> f64 {
        1.0
    }

    fn max_radius(&self) -> f64 {
        1.0
    }
}

surface_of_revolution!(Stub);

#[test]
fn gradients_vanish_where_there_is_no_body() {
    let sphere = Sphere::new(1.1).unwrap();
    for (place, gradient) in [
        ("the equator", sphere.gradient([1.1, 0.0])),
        ("beyond the equator", sphere.gradient([1.0, -1.0])),
        ("beyond the stub", Stub.gradient([0.0, 1.5])),
        ("the apex", Stub.gradient([0.0, 0.0])),
    ] {
        let steepness = gradient[0].hypot(gradient[1]);
        assert!(steepness <= 0.0, "gradient {gradient:?} at {place}");
    }
}

#[test]
fn the_inverse_transform_recovers_the_body() {
    for case in casebook::group("IND-03") {
        let (body, radius) = (case.body(), case.input("r"));
        // Known kinks leave nothing to search: also the kinked rows reach the smooth tolerance.
        let height = inverse_abel(&EquivalentLine(&*body), radius, 1e-12).unwrap();
        case.check_within("h", height, 1e-9);
        let (height, slope) = (|x| body.line_height(x), |x| body.line_slope(x));
        let without_kinks = AnalyticLine::new(height, slope, [0.0, radius]).unwrap();
        let tolerance = 0.1 * case.relative_tolerance();
        let height = inverse_abel(&without_kinks, radius, tolerance);
        case.check("h", height.unwrap());
    }
}

#[test]
fn an_inverse_transform_that_cannot_be_is_refused() {
    let line = AnalyticLine::new(|x| x, |_| 1.0, [0.0, 1.0]).unwrap();
    let result = inverse_abel(&line, 1.5, 1e-9);
    assert_eq!(result, Err(out_of_domain(1.5, 1.0)), "the line ends at 1");
    // Infinitely many waves towards x = 0, as high there as anywhere.
    let height = |x: f64| if x < 1e-300 { 0.0 } else { x.recip().sin() };
    let line = AnalyticLine::new(height, |_| 0.0, [0.0, 1.0]).unwrap();
    let result = inverse_abel(&line, 0.7, 1e-12);
    assert_matches!(result, Err(IndenterError::NotConverged { reached, .. }) if reached > 1e-12);
}
