use casebook::assert_matches;
use indenters::{Axisymmetric, IndenterError, PiecewiseLinearProfile, contact_radius};

#[test]
fn table_lines_agree_with_the_casebook() {
    for case in casebook::group("IND-04") {
        let table = PiecewiseLinearProfile::new(case.input_list("r"), case.input_list("h"));
        let (table, x) = (table.unwrap(), case.input("x"));
        if case.expected_error().is_none() {
            case.check("g", table.line_height(x));
            continue;
        }
        assert_eq!(
            table.checked_line_height(x),
            Err(IndenterError::OutOfDomain {
                position: 3.5,
                lower: 0.0,
                upper: 3.0
            }),
            "{} must not extrapolate",
            case.id()
        );
    }
}

#[test]
fn collinear_rows_are_no_kink() {
    // 0.1 k and 0.3 k are not exact: slopes of neighbouring pieces differ in the last digits.
    let rows = |step: f64| (0..50).map(|k| step * f64::from(k)).collect();
    let table = PiecewiseLinearProfile::new(rows(0.1), rows(0.3)).unwrap();
    assert_eq!(table.kinks(), Vec::new(), "the table is a cone");
    let expected = std::f64::consts::FRAC_PI_2 * 3.0 * 3.33;
    let actual = table.line_height(3.33);
    assert!(
        (actual / expected - 1.0).abs() < 1e-14,
        "line {actual}, expected {expected}"
    );
}

#[test]
fn a_downward_kink_limits_the_contact() {
    let table =
        PiecewiseLinearProfile::new(vec![0.0, 1.0, 2.0, 3.0], vec![0.0, 0.1, 0.5, 0.6]).unwrap();
    let limit = table.line_height(2.0);
    let below = contact_radius(&table, 0.999 * limit).unwrap();
    assert!(
        below > 1.9 && below < 2.0,
        "contact radius {below} just below the edge at 2"
    );
    let expected = IndenterError::NonMonotoneLine {
        limiting_radius: 2.0,
        limiting_depth: limit,
        depth: 1.001 * limit,
    };
    assert_eq!(
        contact_radius(&table, 1.001 * limit),
        Err(expected),
        "the line falls outside the edge at 2"
    );
}

#[test]
fn a_notch_narrower_than_the_search_is_seen_at_its_edge() {
    let radii = vec![0.0, 1.0, 1.001, 2.0];
    let table = PiecewiseLinearProfile::new(radii, vec![0.0, 1.0, 1.0, 2.0]).unwrap();
    let result = contact_radius(&table, 3.0);
    assert_matches!(
        result,
        Err(IndenterError::NonMonotoneLine { limiting_radius, .. }) if (limiting_radius - 1.0).abs() <= 0.0,
        "{result:?} instead of the edge at 1"
    );
}
