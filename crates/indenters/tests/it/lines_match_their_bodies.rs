use casebook::Case;
use indenters::{
    Axisymmetric, EquivalentLine, FlatCone, FlatPunch, Hyperboloid, PiecewiseLinearProfile,
    PowerProfile, RigidLine, RoundTippedCone, Sphere, Surface, TruncatedParaboloid, abel_height,
    abel_slope, surface_of_revolution,
};

use crate::casebook_bodies::{body, boxed, superposition};

#[test]
fn heights_and_lines_agree_with_the_casebook() {
    for case in casebook::group("IND-02") {
        let (body, x): (_, f64) = (body(&case), case.input("x"));
        case.check("h", body.profile_height(x));
        case.check("g", body.line_height(x));
        case.check("dg", body.line_slope(x));
        check_symmetry(&case, &*body, x);
    }
}

fn check_symmetry(case: &Case, body: &dyn Axisymmetric, x: f64) {
    let line = EquivalentLine(body);
    let pairs = [
        (line.height(-x), line.height(x)),
        (line.slope(-x), -line.slope(x)),
    ];
    for (mirrored, expected) in pairs {
        assert!(
            (mirrored - expected).abs() <= 0.0,
            "{}: mirrored value {mirrored}, expected {expected}",
            case.id()
        );
    }
}

/// Every shape of the crate with the size 1, or about that.
fn all_shapes() -> Vec<(&'static str, Box<dyn Axisymmetric>)> {
    let table = PiecewiseLinearProfile::new(vec![0.0, 0.4, 0.7, 2.0], vec![0.0, 0.1, 0.4, 1.0]);
    let sum = superposition(&[(1.0, 2.0), (0.2, 0.7), (-0.5, 4.0)]);
    vec![
        ("root", boxed(PowerProfile::new(0.3, 0.5))),
        ("needle", boxed(PowerProfile::new(0.3, 0.05))),
        ("cone", boxed(PowerProfile::cone(0.3))),
        ("paraboloid", boxed(PowerProfile::paraboloid(2.0))),
        ("power 7.3", boxed(PowerProfile::new(2.0, 7.3))),
        ("sphere", boxed(Sphere::new(1.1))),
        ("flat cone", boxed(FlatCone::new(0.5, 0.3))),
        ("worn paraboloid", boxed(TruncatedParaboloid::new(0.5, 0.3))),
        ("round-tipped cone", boxed(RoundTippedCone::new(0.5, 0.3))),
        ("hyperboloid", boxed(Hyperboloid::new(0.5, 0.3))),
        ("superposition", Box::new(sum)),
        ("table", boxed(table)),
    ]
}

#[test]
fn closed_lines_equal_the_numerical_transform() {
    // The quadrature is asked for 1e-14 of the integral of the modulus; 1e-12 leaves room for cancellation.
    for (name, body) in all_shapes() {
        for x in [1e-6, 0.01, 0.3, 0.50001, 0.55, 0.9, 1.05] {
            let pairs = [
                ("height", body.line_height(x), abel_height(&*body, x)),
                ("slope", body.line_slope(x), abel_slope(&*body, x)),
            ];
            for (quantity, closed, numerical) in pairs {
                assert!(
                    (closed - numerical).abs() <= 1e-12 * closed.abs(),
                    "{name}, x = {x}: {quantity} {closed}, by quadrature {numerical}"
                );
            }
        }
    }
}

#[test]
fn lines_near_a_kink_keep_their_digits() {
    // Just outside the flat end, x = b (1 + ε): h̃ = t b √(2ε) and h̃' = t / √(2ε) up to O(ε).
    let epsilon = 2.0_f64.powi(-44);
    let (radius, slope) = (0.5, 0.3);
    let cone = FlatCone::new(radius, slope).unwrap();
    let x = radius * (1.0 + epsilon);
    let root = (2.0 * epsilon).sqrt();
    let pairs = [
        (cone.line_height(x), slope * radius * root),
        (cone.line_slope(x), slope / root),
    ];
    for (actual, expected) in pairs {
        assert!(
            (actual / expected - 1.0).abs() < 1e-12,
            "{actual}, expected {expected}"
        );
    }
}

#[test]
fn gradients_are_the_derivatives_of_heights() {
    // Central differences of step δ: truncation h''' δ²/6 and rounding ε h / δ are both below 1e-9 at δ = 1e-5.
    let step = 1e-5;
    for (name, body) in all_shapes() {
        for [x, y] in [
            [0.3, 0.1],
            [-0.2, 0.25],
            [0.0, -0.33],
            [-0.6, -0.6],
            [0.95, 0.1],
        ] {
            let at = |dx, dy| body.height([x + dx, y + dy]);
            let expected = [
                (at(step, 0.0) - at(-step, 0.0)) / (2.0 * step),
                (at(0.0, step) - at(0.0, -step)) / (2.0 * step),
            ];
            let actual = body.gradient([x, y]);
            let error = (actual[0] - expected[0]).hypot(actual[1] - expected[1]);
            let size = 1.0 + actual[0].hypot(actual[1]);
            assert!(
                error < 1e-7 * size,
                "{name} at [{x}, {y}]: gradient {actual:?}, by differences {expected:?}"
            );
        }
    }
}

#[test]
fn curvatures_are_the_derivatives_of_slopes() {
    let step = 1e-5;
    for (name, body) in all_shapes() {
        for r in [0.1, 0.3, 0.6, 0.9] {
            let expected =
                (body.profile_slope(r + step) - body.profile_slope(r - step)) / (2.0 * step);
            let actual = body.profile_curvature(r);
            assert!(
                (actual - expected).abs() < 1e-7 * (1.0 + actual.abs()),
                "{name} at {r}: curvature {actual}, by differences {expected}"
            );
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
            let values = [
                body.profile_height(r),
                body.line_height(r),
                body.line_slope(r),
                body.line_slope(-r),
                x,
                y,
            ];
            assert!(
                values.iter().all(|value| !value.is_nan()),
                "{name} at r = {r}: {values:?}"
            );
        }
    }
}

#[test]
fn lines_scale_with_the_unit_of_length() {
    // The same bodies in other units of length: heights scale like the unit, slopes not at all.
    for unit in [1e-12, 1e-3, 1e12] {
        let shapes = |unit: f64| {
            [
                boxed(Sphere::new(2.0 * unit)),
                boxed(FlatCone::new(0.5 * unit, 0.3)),
                boxed(RoundTippedCone::new(0.5 * unit, 0.3)),
                boxed(TruncatedParaboloid::new(0.5 * unit, 0.3 / unit)),
            ]
        };
        for (base, scaled) in shapes(1.0).into_iter().zip(shapes(unit)) {
            let expected = [base.line_height(0.9) * unit, base.line_slope(0.9)];
            let actual = [
                scaled.line_height(0.9 * unit),
                scaled.line_slope(0.9 * unit),
            ];
            for (actual, expected) in actual.iter().zip(expected) {
                assert!(
                    (actual / expected - 1.0).abs() < 1e-14,
                    "unit {unit}: {actual}, expected {expected}"
                );
            }
        }
    }
}

/// A cone that ends, whose formulas do not know it.
struct Stub;

impl Axisymmetric for Stub {
    fn profile_height(&self, radius: f64) -> f64 {
        if radius > 1.0 { f64::INFINITY } else { radius }
    }

    fn profile_slope(&self, _radius: f64) -> f64 {
        1.0
    }

    fn profile_curvature(&self, _radius: f64) -> f64 {
        0.0
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
    let pairs = [
        ("the equator", sphere.gradient([1.1, 0.0])),
        ("beyond the equator", sphere.gradient([1.0, -1.0])),
        ("beyond the stub", Stub.gradient([0.0, 1.5])),
        ("the apex", Stub.gradient([0.0, 0.0])),
    ];
    for (place, gradient) in pairs {
        let steepness = gradient[0].hypot(gradient[1]);
        assert!(steepness <= 0.0, "gradient {gradient:?} at {place}");
    }
}
