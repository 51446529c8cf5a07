use casebook::{Case, assert_matches};
use indenters::{
    AnalyticLine, EquivalentLine, IndenterError, LeadingEdgeOptions, PiecewiseLinearProfile,
    PowerProfile, RigidLine, SampledLine, contact_line, leading_edge, leading_edge_with,
    leading_indices, running_minimum,
};
use proptest::prelude::*;

use crate::fixed_seed::fixed_seed;

/// The line e (x³/3 − 3x²/2 + 2x) on [0, 3], in a unit of length, or run through backwards.
fn cubic(case: &Case, unit: f64) -> impl RigidLine {
    let epsilon = case.input("eps");
    let backwards = case.has_input("direction");
    let turn = move |x: f64| if backwards { -x / unit } else { x / unit };
    let sign = if backwards { -1.0 } else { 1.0 };
    let height = move |x: f64| {
        let x = turn(x);
        unit * epsilon * x * (x * (x / 3.0 - 1.5) + 2.0)
    };
    let slope = move |x: f64| sign * epsilon * (turn(x) - 1.0) * (turn(x) - 2.0);
    let domain = if backwards { [-3.0, 0.0] } else { [0.0, 3.0] };
    AnalyticLine::new(height, slope, domain.map(|end| end * unit)).unwrap()
}

fn cubic_cases() -> Vec<Case> {
    let cases = casebook::group("FRI-03").into_iter();
    cases.filter(|case| case.has_input("eps")).collect()
}

#[test]
fn contact_lines_of_the_cubic_agree_with_the_casebook() {
    for case in cubic_cases() {
        for unit in [1e-12, 1.0, 1e12] {
            let depth = unit * case.input("D_over_eps") * case.input("eps");
            let result = contact_line(&cubic(&case, unit), depth);
            let Some(expected) = case.expected_list("intervals") else {
                assert_matches!(
                    result,
                    Err(IndenterError::NotHighEnough { available, .. }) if available < depth,
                    "{} in the unit {unit}: {result:?}", case.id()
                );
                continue;
            };
            let ends: Vec<f64> = result.unwrap().intervals.concat();
            let close = |(actual, expected): (&f64, &f64)| {
                (actual / unit - expected).abs() <= case.relative_tolerance() * expected
            };
            assert!(
                ends.len() == expected.len() && ends.iter().zip(&expected).all(close),
                "{} in the unit {unit}: intervals {ends:?}, expected {expected:?}",
                case.id()
            );
        }
    }
}

#[test]
fn the_edge_of_the_cubic_does_not_depend_on_the_sampling() {
    let case = &cubic_cases()[0];
    let line = cubic(case, 1.0);
    for samples in [2, 7, 100, 1024, 3000] {
        let edge = leading_edge_with(&line, &LeadingEdgeOptions { samples }).unwrap();
        let expected = [0.0, 0.5, 2.0, 3.0];
        let ends = edge.intervals.concat();
        let close = |(actual, expected): (&f64, &f64)| (actual - expected).abs() <= 1e-14;
        assert!(
            ends.len() == 4 && ends.iter().zip(&expected).all(close),
            "{samples} samples: {ends:?}, expected {expected:?}"
        );
        let highest = 1.5 * case.input("eps");
        assert!(
            edge.lowest.abs() <= 0.0 && (edge.highest / highest - 1.0).abs() < 1e-15,
            "{samples} samples: from {} to {}, expected 0 to {highest}",
            edge.lowest,
            edge.highest
        );
    }
}

#[test]
fn separate_points_agree_with_the_casebook() {
    for case in casebook::group("FRI-03") {
        if !case.has_input("h") {
            continue;
        }
        let heights = case.input_list("h");
        if let Some(expected) = case.expected_list("A") {
            let actual: Vec<f64> = leading_indices(&heights)
                .into_iter()
                .map(|i| f64::from(u32::try_from(i).unwrap()))
                .collect();
            assert_eq!(actual, expected, "leading edge of {}", case.id());
            case.check("h0", running_minimum(&heights)[0]);
            continue;
        }
        let minima = running_minimum(&heights);
        let expected = case.expected_list("running_min").unwrap();
        assert_eq!(minima, expected, "running minimum of {}", case.id());
        let increments: Vec<f64> = minima.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let until_contact_ends = case.expected_list("increments").unwrap().len();
        let capped = increments.iter().take(until_contact_ends);
        let level = case.input("D");
        let sum: f64 = capped
            .scan(0.0, |sum, step| {
                let step = step.min(level - *sum);
                *sum += step;
                Some(step)
            })
            .sum();
        case.check("sum_increments", sum);
    }
}

#[test]
fn of_a_plateau_only_the_right_end_belongs() {
    let line = SampledLine::new(vec![0.0, 1.0, 2.0, 3.0, 4.0], vec![0.0, 1.0, 1.0, 1.0, 2.0]);
    let edge = leading_edge(&line.unwrap()).unwrap();
    assert_eq!(edge.intervals, [[0.0, 1.0], [3.0, 4.0]], "{edge:?}");
}

#[test]
fn a_flank_that_starts_at_a_later_minimum_is_hidden() {
    let line = SampledLine::new(vec![0.0, 1.0, 2.0, 3.0, 4.0], vec![0.0, 1.0, 2.0, 1.0, 3.0]);
    let edge = leading_edge(&line.unwrap()).unwrap();
    assert_eq!(edge.intervals, [[0.0, 1.0], [3.0, 4.0]], "{edge:?}");
}

#[test]
fn at_a_vertex_the_slope_looks_forward() {
    let line = SampledLine::new(vec![0.0, 1.0, 3.0], vec![0.0, 2.0, 1.0]).unwrap();
    for (x, expected) in [(0.0, 2.0), (1.0, -0.5), (3.0, -0.5)] {
        let actual = line.slope(x);
        assert!(
            (actual - expected).abs() < 1e-15,
            "slope {actual} at {x}, expected {expected}"
        );
    }
}

#[test]
fn a_falling_line_has_an_edge_of_one_point() {
    let line = SampledLine::new(vec![0.0, 1.0, 2.0], vec![5.0, 4.0, 3.0]).unwrap();
    let edge = leading_edge(&line).unwrap();
    assert_eq!(edge.intervals, [[2.0, 2.0]], "{edge:?}");
    assert_eq!(
        contact_line(&line, 0.1),
        Err(IndenterError::NotHighEnough {
            available: 0.0,
            depth: 0.1
        }),
        "one point carries nothing"
    );
}

#[test]
fn sampled_lines_are_cut_between_their_points() {
    // Falls to 1, rises to 3, falls to 2 (which hides what is above 2), rises to 4.
    let line = SampledLine::new(vec![0.0, 1.0, 3.0, 4.0, 6.0], vec![2.0, 1.0, 3.0, 2.0, 4.0]);
    let line = line.unwrap();
    let edge = leading_edge(&line).unwrap();
    assert_eq!(edge.intervals, [[1.0, 2.0], [4.0, 6.0]], "{edge:?}");
    let contact = contact_line(&line, 1.5).unwrap();
    assert_eq!(contact.intervals, [[1.0, 2.0], [4.0, 4.5]], "{contact:?}");
    assert!((contact.length() - 1.5).abs() < 1e-15, "{contact:?}");
}

#[test]
fn kinks_of_a_body_are_seen() {
    // A cone with a sunken ring: its line falls outside the downward kink at 2 and rises again.
    let table =
        PiecewiseLinearProfile::new(vec![0.0, 1.0, 2.0, 3.0, 6.0], vec![0.0, 0.1, 0.5, 0.6, 3.0]);
    let table = table.unwrap();
    let line = EquivalentLine(&table);
    let edge = leading_edge(&line).unwrap();
    assert_eq!(edge.intervals.len(), 2, "{edge:?}");
    let [[start, hidden], [valley, end]] = [edge.intervals[0], edge.intervals[1]];
    assert!(
        start.abs() <= 0.0 && hidden < 2.0 && valley > 2.0 && (end - 6.0).abs() <= 0.0,
        "{edge:?}"
    );
    let [left, right] = [hidden, valley].map(|x| line.height(x));
    assert!(
        (left / right - 1.0).abs() < 1e-14,
        "the valley at {valley} has the height {right}, the hidden flank begins at {left}"
    );
}

#[test]
fn a_body_without_an_end_is_referred_to_its_radius() {
    let cone = PowerProfile::cone(0.3).unwrap();
    let result = leading_edge(&EquivalentLine(&cone));
    assert_matches!(
        result,
        Err(IndenterError::InvalidParameter { parameter: "end of the domain", value, .. }) if value == f64::NEG_INFINITY
    );
}

proptest! {
    #![proptest_config(fixed_seed())]

    #[test]
    fn sampled_edges_hold_the_definition(heights in prop::collection::vec(0_u8..12, 2..30)) {
        let heights: Vec<f64> = heights.into_iter().map(f64::from).collect();
        let positions: Vec<f64> = (0_u32..).take(heights.len()).map(f64::from).collect();
        let line = SampledLine::new(positions, heights.clone()).unwrap();
        let edge = leading_edge(&line).unwrap();
        // Vertices decide: the definition holds on the line exactly where it does among finely divided points.
        let fine = 8 * (heights.len() - 1);
        let x = |i: usize| f64::from(u32::try_from(i).unwrap()) / 8.0;
        let points: Vec<f64> = (0..=fine).map(|i| line.height(x(i))).collect();
        let last = edge.intervals.len() - 1;
        for i in 0..=fine {
            let expected = points[i + 1..].iter().all(|later| points[i] < *later);
            let inside = |(k, [start, end]): (usize, &[f64; 2])| {
                x(i) >= *start && (x(i) < *end || (k == last && x(i) <= *end))
            };
            let actual = edge.intervals.iter().enumerate().any(inside);
            // A crossing level lies between two points of the division or on one of them, where rounding decides.
            let on_an_end = edge.intervals.iter().any(|[_, end]| (x(i) - end).abs() < 1e-12);
            prop_assert!(
                actual == expected || on_an_end,
                "x = {}: in the edge {actual}, by definition {expected}; {edge:?} of {heights:?}",
                x(i)
            );
        }
        prop_assert!(edge.lowest <= points.iter().copied().fold(f64::INFINITY, f64::min));
    }
}
