use casebook::{Case, assert_close, assert_matches, fixed_cases};
use indenters::{
    AnalyticLine, EquivalentLine, IndenterError, PowerProfile, RigidLine, contact_line,
    leading_edge, leading_edge_with,
};
use proptest::prelude::*;

use crate::support::{sampled, table};

fn cubic_cases() -> Vec<Case> {
    let cases = casebook::group("FRI-03").into_iter();
    cases.filter(|case| case.has_input("eps")).collect()
}

fn assert_ends(intervals: &[[f64; 2]], expected: &[f64], tolerance: f64, what: &str) {
    let ends = intervals.as_flattened();
    let close =
        |(actual, expected): (&f64, &f64)| (actual - expected).abs() <= tolerance * expected;
    assert!(
        ends.len() == expected.len() && ends.iter().zip(expected).all(close),
        "{what}: intervals {intervals:?}, expected {expected:?}"
    );
}

#[test]
fn contact_lines_of_the_cubic_agree_with_the_casebook() {
    for case in cubic_cases() {
        for unit in [1e-12, 1.0, 1e12] {
            let what = format!("{} in the unit {unit}", case.id());
            let depth = unit * case.input("D_over_eps") * case.input("eps");
            let result = contact_line(&case.cubic(unit), depth);
            let Some(expected) = case.expected_list("intervals") else {
                assert_matches!(
                    result,
                    Err(IndenterError::NotHighEnough { available, .. }) if available < depth, "{what}"
                );
                continue;
            };
            let scaled = |interval: [f64; 2]| interval.map(|end| end / unit);
            let intervals: Vec<_> = result.unwrap().intervals.into_iter().map(scaled).collect();
            let tolerance = 2.0 * case.relative_tolerance();
            assert_ends(&intervals, &expected, tolerance, &what);
        }
    }
}

#[test]
fn the_edge_of_the_cubic_does_not_depend_on_the_sampling() {
    let case = &cubic_cases()[0];
    for samples in [2, 7, 100, 1024, 3000] {
        let edge = leading_edge_with(&case.cubic(1.0), samples).unwrap();
        let what = format!("{samples} samples");
        assert_ends(&edge.intervals, &[0.0, 0.5, 2.0, 3.0], 3e-15, &what);
        assert_close!(edge.lowest => 0.0, within 0.0; "{samples} samples");
        assert_close!(edge.highest => 1.5 * case.input("eps"), within 1e-15; "{samples} samples");
    }
}

#[test]
fn at_a_vertex_the_slope_looks_forward() {
    let line = sampled(&[0.0, 1.0, 3.0], &[0.0, 2.0, 1.0]);
    for (x, expected) in [(0.0, 2.0), (1.0, -0.5), (3.0, -0.5)] {
        assert_close!(line.slope(x) => expected, within 1e-15; "x = {x}");
    }
}

#[test]
fn sampled_lines_are_cut_between_their_points() {
    // Falls to 1, rises to 3, falls to 2 (which hides what is above 2), rises to 4.
    let line = sampled(&[0.0, 1.0, 3.0, 4.0, 6.0], &[2.0, 1.0, 3.0, 2.0, 4.0]);
    let contact = contact_line(&line, 1.5).unwrap();
    assert_eq!(contact.intervals, [[1.0, 2.0], [4.0, 4.5]], "{contact:?}");
    assert_close!(contact.length() => 1.5, within 1e-15);
    assert_close!(leading_edge(&line).unwrap().available_depth() => 3.0, within 0.0);
    assert_eq!(line.kinks(), [1.0, 3.0, 4.0], "{line:?}");
}

#[test]
fn the_edge_of_a_level_stretch_is_its_end() {
    let level = |x: f64| (x.abs() - 0.3).max(0.0);
    let slope = |x: f64| if x.abs() > 0.3 { x.signum() } else { 0.0 };
    let line = AnalyticLine::new(level, slope, [-1.0, 1.0]).unwrap();
    let edge = leading_edge_with(&line, 100).unwrap();
    let is_end = edge.intervals.len() == 1 && (0.28..=0.3).contains(&edge.intervals[0][0]);
    assert!(is_end, "{edge:?}");
}

#[test]
fn kinks_of_a_body_are_seen() {
    // A cone with a sunken ring: its line falls outside the downward kink at 2 and rises again.
    let table = table(&[0.0, 1.0, 2.0, 3.0, 6.0], &[0.0, 0.1, 0.5, 0.6, 3.0]);
    let line = EquivalentLine(&table);
    let edge = leading_edge(&line).unwrap();
    let [[start, hidden], [valley, end]] = edge.intervals[..] else {
        panic!("two intervals were expected: {edge:?}");
    };
    assert_eq!((start.abs(), end), (0.0, 6.0), "{edge:?}");
    assert!(hidden < 2.0 && valley > 2.0, "{edge:?}");
    assert_close!(line.height(hidden) => line.height(valley), within 1e-14);
}

#[test]
fn a_body_without_an_end_is_referred_to_its_radius() {
    let cone = PowerProfile::cone(0.3).unwrap();
    let result = leading_edge(&EquivalentLine(&cone));
    assert_matches!(
        result,
        Err(IndenterError::InvalidParameter(invalid))
            if invalid.parameter == "end of the domain" && invalid.value == f64::NEG_INFINITY
    );
}

proptest! {
    #![proptest_config(fixed_cases(256))]

    #[test]
    fn sampled_edges_hold_the_definition(heights in prop::collection::vec(0_u8..12, 2..30)) {
        let heights: Vec<f64> = heights.into_iter().map(f64::from).collect();
        let positions: Vec<f64> = (0..heights.len()).map(|i| i as f64).collect();
        let line = sampled(&positions, &heights);
        let edge = leading_edge(&line).unwrap();
        // Vertices decide: the definition holds on the line exactly where it does among finely divided points.
        let fine = 8 * (heights.len() - 1);
        let points: Vec<f64> = (0..=fine).map(|i| line.height(i as f64 / 8.0)).collect();
        let last = edge.intervals.len() - 1;
        for i in 0..=fine {
            let x = i as f64 / 8.0;
            let expected = points[i + 1..].iter().all(|later| points[i] < *later);
            let actual = edge.intervals.iter().enumerate().any(|(k, [start, end])| {
                x >= *start && (x < *end || (k == last && x <= *end))
            });
            // A crossing level lies between two points of the division or on one of them, where rounding decides.
            let on_an_end = edge.intervals.iter().any(|[_, end]| (x - end).abs() < 1e-12);
            prop_assert!(
                actual == expected || on_an_end,
                "x = {x}: in the edge {actual}, by definition {expected}; {edge:?} of {heights:?}"
            );
        }
        prop_assert!(edge.lowest <= points.iter().copied().fold(f64::INFINITY, f64::min));
    }
}
