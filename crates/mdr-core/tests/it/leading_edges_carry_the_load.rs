//! On a dashpot the leading edge carries the load and nothing else does, also where it consists of several intervals: by
//! marching and directly (casebook FRI-03).

use casebook::Case;
use indenters::SampledLine;
use mdr_core::{MdrError, steady};
use numerics::Estimate;
use proptest::prelude::*;

use crate::support::{
    ASKED, VISCOSITY, assert_agree, assert_close, fixed_cases, load_for_depth, material, slid,
    slide_to,
};

/// The gaps and fronts at 1/2, 2, 5/2 fall on elements; the error of the mean slope is below n⁻² with n elements per
/// unit length.
fn cubic_cases(refused: bool) -> Vec<Case> {
    let cases = casebook::group("FRI-03").into_iter();
    cases
        .filter(|case| case.id().contains("/cubic/") && case.expected_error().is_some() == refused)
        .collect()
}

fn depth_of(case: &Case) -> f64 {
    case.input("eps") * case.input("D_over_eps")
}

#[test]
fn friction_and_ends_of_the_cubic_agree_with_the_casebook() {
    let n = 200.0;
    for case in cubic_cases(false) {
        let line = case.cubic(1.0);
        let state = slide_to(&line, depth_of(&case), 1.0 / n, 1e-11);
        let row = state.expect("a state").last;
        case.check_within("mu", row.friction_coefficient, n.powi(-2));
        let intervals = case.expected_list("intervals").expect("intervals");
        let lengths: f64 = intervals.chunks(2).map(|ends| ends[1] - ends[0]).sum();
        for (value, expected, allowed) in [
            (row.contact[0], intervals[0], 1.0),
            (row.contact[1], intervals[intervals.len() - 1], 1.0),
            (row.contact_length, lengths, 0.5 * intervals.len() as f64),
        ] {
            let expected = Estimate::new(expected, 1.0001 * allowed / n);
            assert_agree([Estimate::exact(value), expected], &case.id());
        }

        let load = load_for_depth(depth_of(&case));
        let state = slid(&line, &material(VISCOSITY), &load);
        case.check_within("mu", state.friction_coefficient.value, 1e-9);
        assert_eq!(2 * state.contacts.len(), intervals.len(), "{state:?}");
        for (end, expected) in state.contacts.concat().into_iter().zip(intervals) {
            // An interval ends where the line is level, so that the rounding of its height counts by the square root.
            assert_close([end, expected], 1e-7, 1.0, &case.id());
        }
    }
}

#[test]
fn too_low_a_leading_edge_has_no_stationary_state() {
    let cases = cubic_cases(true);
    assert_eq!(cases.len(), 2, "rows of the casebook");
    for case in cases {
        let (line, depth) = (case.cubic(1.0), depth_of(&case));
        // Mirrored, the leading edge is the lowest point alone.
        let lowest = [1.5 * case.input("eps"), 0.0];
        let height = lowest[usize::from(case.has_input("direction"))];
        let marched = slide_to(&line, depth, 0.02, 1e-11).err();
        let directly = steady(&line, &material(VISCOSITY), &load_for_depth(depth), ASKED).err();
        for (error, tolerance) in [(marched, 1e-14), (directly, 1e-9)] {
            let Some(MdrError::ForceBeyondEdge {
                normal_force,
                carried_force,
                available,
                ..
            }) = error
            else {
                panic!("{}: {error:?}", case.id());
            };
            let carried = carried_force / normal_force;
            assert_close([carried, height / depth], tolerance, 1.0, &case.id());
            assert_close([available, height], tolerance, 1.0, &case.id());
        }
    }
}

fn table(heights: Vec<f64>, spacing: f64) -> SampledLine {
    let positions = (0..heights.len()).map(|k| k as f64 * spacing);
    SampledLine::new(positions.collect(), heights).expect("a line")
}

/// The friction coefficient on a table, Σ increment_j (h_{j+1} − h_j) / (Δx D).
fn discrete_friction(line: &SampledLine, depth: f64) -> f64 {
    let heights = line.heights();
    let mut sum = 0.0;
    for node in 0..heights.len() - 1 {
        let ahead = heights[node + 1..].iter().copied().fold(depth, f64::min);
        if heights[node] < ahead {
            sum += (ahead - heights[node]) * (heights[node + 1] - heights[node]);
        }
    }
    sum / (line.positions()[1] * depth)
}

proptest! {
    #![proptest_config(fixed_cases(128))]

    /// During the march the depth only grows, and never beyond the stationary one; this bounds the foundation.
    #[test]
    fn any_line_sinks_to_its_stationary_depth_and_no_further(
        inner in prop::collection::vec(0.0..1.0_f64, 4..30),
        depth in 0.3..1.0_f64,
        spacing in 1e-3..1e3_f64,
    ) {
        // The foremost of the two lowest nodes is the second, so that three elements are in contact.
        let mut heights = vec![0.0, 0.0, 0.1, 0.2];
        heights.extend(inner.iter().map(|height| 0.3 + 0.7 * height));
        heights.push(1.0);
        let line = table(heights, spacing);
        let transient = slide_to(&line, depth, spacing, 1e-12).expect("a state");
        let mut before = 0.0;
        // Rounding of a sum over at most 35 elements, divided by their number.
        let slack = 4.0 * f64::EPSILON * depth;
        for row in &transient.rows {
            let now = row.indentation_depth;
            prop_assert!(now >= before - slack && now <= depth + slack, "{now} after {before}, limit {depth}");
            before = now;
        }
        let row = transient.last;
        assert_close([row.indentation_depth, depth], 1e-11, 0.0, &row);
        let friction = discrete_friction(&line, depth);
        assert_close([row.friction_coefficient, friction], 1e-9, 0.0, &row);
    }
}
