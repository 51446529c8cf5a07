use std::fmt::Debug;

use casebook::assert_matches;
use indenters::{
    AnalyticLine, Axisymmetric, Cylinder, FlatCone, FlatPunch, Hyperboloid, IndenterError,
    InvalidParameter, PiecewiseLinearProfile, PowerProfile, PowerTerm, RoundTippedCone,
    SampledLine, SlidingLoad, Sphere, Superposition, TruncatedParaboloid, contact_line,
    contact_radius, inverse_abel, leading_edge, stretch,
};

const BAD: [f64; 6] = [0.0, -0.0, -1.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY];

fn assert_names<T: Debug>(result: Result<T, IndenterError>, name: &str, bad: f64) {
    match result {
        Err(IndenterError::InvalidParameter(InvalidParameter {
            parameter, value, ..
        })) => {
            assert_eq!(parameter, name, "the refused value was {bad}");
            assert_eq!(value.to_bits(), bad.to_bits(), "value named for {name}");
        }
        other => panic!("{name} = {bad}: {other:?}"),
    }
}

/// An entry that does not increase from the 1 before it is named.
fn assert_not_increasing<T: Debug>(
    result: Result<T, IndenterError>,
    list: &str,
    entry: (usize, f64),
) {
    match result {
        Err(IndenterError::NotIncreasing {
            list: name,
            index,
            value,
            previous,
        }) => {
            assert_eq!(
                (name, (index, value), previous),
                (list, entry, 1.0),
                "what is named"
            );
        }
        other => panic!("{list} with the entry {entry:?}: {other:?}"),
    }
}

/// EXT-01 rows 09, 10, 11: zero, negative, NaN and infinite parameters.
#[test]
fn every_parameter_of_every_shape_is_checked() {
    for bad in BAD {
        assert_names(stretch(bad), "exponent", bad);
        assert_names(PowerProfile::new(1.0, bad), "exponent", bad);
        assert_names(PowerProfile::new(bad, 1.0), "coefficient", bad);
        assert_names(PowerProfile::cone(bad), "slope", bad);
        assert_names(PowerProfile::paraboloid(bad), "curvature", bad);
        assert_names(Sphere::new(bad), "radius", bad);
        assert_names(Cylinder::new(bad), "radius", bad);
        assert_names(FlatPunch::new(bad), "radius", bad);
        assert_names(FlatCone::new(bad, 1.0), "radius", bad);
        assert_names(FlatCone::new(1.0, bad), "slope", bad);
        assert_names(TruncatedParaboloid::new(bad, 1.0), "radius", bad);
        assert_names(TruncatedParaboloid::new(1.0, bad), "curvature", bad);
        assert_names(RoundTippedCone::new(bad, 1.0), "radius", bad);
        assert_names(RoundTippedCone::new(1.0, bad), "slope", bad);
        assert_names(Hyperboloid::new(bad, 1.0), "radius", bad);
        assert_names(Hyperboloid::new(1.0, bad), "slope", bad);
        assert_names(SlidingLoad::new(bad, 1.0), "normal_force", bad);
        assert_names(SlidingLoad::new(1.0, bad), "velocity", bad);
    }
}

#[test]
fn questions_are_checked_too() {
    let cone = PowerProfile::cone(0.1).unwrap();
    let line = SampledLine::new(vec![0.0, 1.0], vec![0.0, 1.0]).unwrap();
    for bad in BAD {
        assert_names(contact_radius(&cone, bad), "depth", bad);
        assert_names(contact_line(&line, bad), "depth", bad);
        assert_names(inverse_abel(&line, bad, 1e-9), "radius", bad);
        assert_names(inverse_abel(&line, 0.5, bad), "relative_tolerance", bad);
    }
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
    for bad in BAD {
        assert_names(new((1.0, bad)), "exponent", bad);
    }
    for bad in [0.0, -0.0, f64::NAN, f64::INFINITY] {
        assert_names(new((bad, 1.0)), "coefficient", bad);
    }
    assert_names(new((-1.0, 1.0)), "coefficient of the lowest exponent", -1.0);
    assert_names(new((3.0, 2.0)), "exponent", 2.0);
}

/// EXT-01 rows 17, 18, 19.
#[test]
fn tables_are_checked_row_by_row() {
    type New = fn(Vec<f64>, Vec<f64>) -> Result<(), IndenterError>;
    let kinds: [(&str, New); 2] = [
        ("radii", |x, h| PiecewiseLinearProfile::new(x, h).map(drop)),
        ("positions", |x, h| SampledLine::new(x, h).map(drop)),
    ];
    for (list, new) in kinds {
        for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert_names(new(vec![0.0, 1.0], vec![0.0, bad]), "heights", bad);
            assert_names(new(vec![0.0, bad], vec![0.0, 1.0]), list, bad);
        }
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
            assert_not_increasing(stuck, list, (2, last));
        }
    }
}

#[test]
fn a_profile_table_starts_at_the_apex() {
    let new = |r: f64, h: f64| PiecewiseLinearProfile::new(vec![r, 1.0], vec![h, 1.0]);
    assert_names(new(0.1, 0.0), "first radius", 0.1);
    assert_names(new(0.0, 0.1), "first height", 0.1);
    let sunken = PiecewiseLinearProfile::new(vec![0.0, 1.0], vec![0.0, -0.1]);
    assert_names(sunken, "heights", -0.1);
}

/// EXT-01 row 20.
#[test]
fn the_sphere_ends_at_its_equator() {
    let sphere = Sphere::new(1.0).unwrap();
    let lower = 0.0;
    for position in [1.0, 1.5, -0.1] {
        let upper = 1.0;
        let expected = IndenterError::OutOfDomain {
            position,
            lower,
            upper,
        };
        assert_eq!(
            sphere.checked_height(position),
            Err(expected),
            "height at {position}"
        );
    }
    assert!(
        sphere.checked_height(f64::NAN).is_err() && sphere.checked_line_height(1.0).is_err(),
        "NaN and the equator are outside"
    );
}

#[test]
fn lines_need_a_finite_domain_and_finite_heights() {
    let on = |domain: [f64; 2]| AnalyticLine::new(|x| x, |_| 1.0, domain);
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        assert_names(on([0.0, bad]), "end of the domain", bad);
        assert_names(on([bad, 0.0]), "end of the domain", bad);
    }
    for upper in [1.0, 0.5] {
        assert_not_increasing(on([1.0, upper]), "domain", (1, upper));
    }
    let endless = AnalyticLine::new(f64::ln, f64::recip, [0.0, 1.0]);
    assert_names(endless, "height of the line", f64::NEG_INFINITY);
    let gap = |x: f64| if (0.4..0.6).contains(&x) { f64::NAN } else { x };
    let gap = AnalyticLine::new(gap, |_| 1.0, [0.0, 1.0]).unwrap();
    assert_names(leading_edge(&gap), "height of the line", f64::NAN);
    // Finite at both ends, with a pole at the turning point 1/2.
    let slope = |x: f64| if x < 0.5 { 1.0 } else { -1.0 };
    let pole = AnalyticLine::new(|x| 1.0 / (x - 0.5).powi(2), slope, [0.0, 1.0]).unwrap();
    let result = leading_edge(&pole);
    assert_matches!(
        result,
        Err(IndenterError::InvalidParameter(invalid)) if invalid.parameter == "height of the line"
    );
}
