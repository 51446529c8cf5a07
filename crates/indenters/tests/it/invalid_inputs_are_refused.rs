use casebook::{NOT_POSITIVE, assert_close, assert_matches, refused, refuses};
use indenters::{
    AnalyticLine, Axisymmetric, Cylinder, FlatCone, FlatPunch, Hyperboloid, IndenterError,
    PiecewiseLinearProfile, PowerProfile, PowerTerm, PressingLoad, RoundTippedCone, SampledLine,
    SlidingLoad, Sphere, Superposition, TruncatedParaboloid, contact_line, contact_radius,
    inverse_abel, leading_edge, stretch,
};

use crate::support::out_of_domain;

/// EXT-01 rows 09, 10, 11: zero, negative, NaN and infinite parameters.
#[test]
fn every_parameter_of_every_shape_is_checked() {
    let bad = NOT_POSITIVE;
    refuses("exponent", bad, stretch);
    refuses("exponent", bad, |x| PowerProfile::new(1.0, x));
    refuses("coefficient", bad, |x| PowerProfile::new(x, 1.0));
    refuses("slope", bad, PowerProfile::cone);
    refuses("curvature", bad, PowerProfile::paraboloid);
    refuses("radius", bad, Sphere::new);
    refuses("radius", bad, Cylinder::new);
    refuses("radius", bad, FlatPunch::new);
    refuses("radius", bad, |x| FlatCone::new(x, 1.0));
    refuses("slope", bad, |x| FlatCone::new(1.0, x));
    refuses("radius", bad, |x| TruncatedParaboloid::new(x, 1.0));
    refuses("curvature", bad, |x| TruncatedParaboloid::new(1.0, x));
    refuses("radius", bad, |x| RoundTippedCone::new(x, 1.0));
    refuses("slope", bad, |x| RoundTippedCone::new(1.0, x));
    refuses("radius", bad, |x| Hyperboloid::new(x, 1.0));
    refuses("slope", bad, |x| Hyperboloid::new(1.0, x));
    refuses("normal_force", bad, |x| SlidingLoad::new(x, 1.0));
    refuses("velocity", bad, |x| SlidingLoad::new(1.0, x));
    let load = SlidingLoad::new(2.0, 1.0).unwrap();
    assert_eq!(load.normal_force(), Some(2.0), "{load:?}");
    refuses("sliding_distance", bad, |x| load.after(x));
    refuses("duration", bad, |x| PressingLoad::new(load.control(), x));
    refuses("slope", bad, PowerProfile::pyramid);
    // F = 0.7453 E* d²/s instead of (2/π) E* d²/s.
    let pyramid = PowerProfile::pyramid(0.3).unwrap().coefficient();
    assert_close!(pyramid * 0.7453 => std::f64::consts::FRAC_2_PI * 0.3, within 1e-15);
}

#[test]
fn questions_are_checked_too() {
    let cone = PowerProfile::cone(0.1).unwrap();
    let line = SampledLine::new(vec![0.0, 1.0], vec![0.0, 1.0]).unwrap();
    let bad = NOT_POSITIVE;
    refuses("depth", bad, |x| contact_radius(&cone, x));
    refuses("depth", bad, |x| contact_line(&line, x));
    refuses("radius", bad, |x| inverse_abel(&line, x, 1e-9));
    refuses("relative_tolerance", bad, |x| inverse_abel(&line, 0.5, x));
}

#[test]
fn superpositions_need_a_body() {
    let new = |second: (f64, f64)| {
        let terms = [(1.0, 2.0), second].map(|(coefficient, exponent)| PowerTerm {
            coefficient,
            exponent,
        });
        Superposition::new(terms.to_vec())
    };
    let none = Superposition::new(Vec::new());
    assert_matches!(
        none,
        Err(IndenterError::TooFew {
            list: "terms",
            needed: 1,
            length: 0
        })
    );
    refuses("exponent", NOT_POSITIVE, |x| new((1.0, x)));
    refuses("exponent", &[2.0], |x| new((3.0, x)));
    let no_coefficient = &[0.0, -0.0, f64::NAN, f64::INFINITY];
    refuses("coefficient", no_coefficient, |x| new((x, 1.0)));
    let lowest = "coefficient of the lowest exponent";
    refuses(lowest, &[-1.0], |x| new((x, 1.0)));
}

/// An entry that does not increase from the 1 before it is named.
fn not_increasing(list: &'static str, index: usize, value: f64) -> Result<(), IndenterError> {
    Err(IndenterError::NotIncreasing {
        list,
        index,
        value,
        previous: 1.0,
    })
}

const NOT_FINITE: &[f64] = &[f64::NAN, f64::INFINITY, f64::NEG_INFINITY];

/// EXT-01 rows 17, 18, 19.
#[test]
fn tables_are_checked_row_by_row() {
    type New = fn(Vec<f64>, Vec<f64>) -> Result<(), IndenterError>;
    let kinds: [(&'static str, New); 2] = [
        ("radii", |x, h| PiecewiseLinearProfile::new(x, h).map(drop)),
        ("positions", |x, h| SampledLine::new(x, h).map(drop)),
    ];
    for (list, new) in kinds {
        refuses("heights", NOT_FINITE, |x| new(vec![0.0, 1.0], vec![0.0, x]));
        refuses(list, NOT_FINITE, |x| new(vec![0.0, x], vec![0.0, 1.0]));
        let mismatch = new(vec![0.0, 1.0], vec![0.0]);
        assert_matches!(
            mismatch,
            Err(IndenterError::LengthMismatch { first, first_length: 2, second: "heights", second_length: 1 })
                if first == list
        );
        let short = new(vec![0.0], vec![0.0]);
        assert_matches!(
            short,
            Err(IndenterError::TooFew { list: name, needed: 2, length: 1 }) if name == list
        );
        for last in [1.0, 0.5] {
            let stuck = new(vec![0.0, 1.0, last], vec![0.0; 3]);
            assert_eq!(stuck, not_increasing(list, 2, last), "{list} to {last}");
        }
    }
}

#[test]
fn a_profile_table_starts_at_the_apex() {
    let new = |r: f64, h: f64| PiecewiseLinearProfile::new(vec![r, 1.0], vec![h, 1.0]);
    refuses("first radius", &[0.1], |x| new(x, 0.0));
    refuses("first height", &[0.1], |x| new(0.0, x));
    refuses("heights", &[-0.1], |x| {
        PiecewiseLinearProfile::new(vec![0.0, 1.0], vec![0.0, x])
    });
}

/// EXT-01 row 20.
#[test]
fn the_sphere_ends_at_its_equator() {
    let sphere = Sphere::new(1.0).unwrap();
    for x in [1.0, -1.5] {
        let height = sphere.checked_line_height(x);
        assert_eq!(height, Err(out_of_domain(f64::abs(x), 1.0)), "at {x}");
    }
    let nowhere = sphere.checked_line_height(f64::NAN);
    assert_matches!(nowhere, Err(IndenterError::OutOfDomain { position, .. }) if position.is_nan());
}

#[test]
fn lines_need_a_finite_domain_and_finite_heights() {
    let on = |domain: [f64; 2]| AnalyticLine::new(|x| x, |_| 1.0, domain);
    refuses("end of the domain", NOT_FINITE, |x| on([0.0, x]));
    refuses("end of the domain", NOT_FINITE, |x| on([x, 0.0]));
    for upper in [1.0, 0.5] {
        let stuck = on([1.0, upper]).map(drop);
        assert_eq!(stuck, not_increasing("domain", 1, upper), "to {upper}");
    }
    let height = "height of the line";
    refused(height, AnalyticLine::new(f64::ln, f64::recip, [0.0, 1.0]));
    let gap = |x: f64| if (0.4..0.6).contains(&x) { f64::NAN } else { x };
    let gap = AnalyticLine::new(gap, |_| 1.0, [0.0, 1.0]).unwrap();
    refused(height, leading_edge(&gap));
    // Finite at both ends, with a pole at the turning point 1/2.
    let slope = |x: f64| if x < 0.5 { 1.0 } else { -1.0 };
    let pole = AnalyticLine::new(|x| 1.0 / (x - 0.5).powi(2), slope, [0.0, 1.0]).unwrap();
    refused(height, leading_edge(&pole));
    // Its slope contradicts its height everywhere, which must not lead to an endless search.
    let wrong = AnalyticLine::new(|x| -x, |_| 1.0, [0.0, 1.0]).unwrap();
    assert!(leading_edge(&wrong).is_ok(), "{wrong:?}");
}
