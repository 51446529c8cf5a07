//! On a dashpot the leading edge carries the load and nothing else does, also where it consists of several intervals: by
//! marching and directly (casebook FRI-03).

use casebook::Case;
use mdr_core::{MdrError, steady};
use numerics::{Estimate, whole_part};

use crate::support::{
    ASKED, VISCOSITY, assert_agree, assert_close, last, load_for_depth, material, slid, slide_to,
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
        let intervals = case.expected_list("intervals").expect("intervals");
        let span = intervals[intervals.len() - 1] - intervals[0];
        let elements = whole_part(n * span + 0.5);
        let sliding = slide_to(&line, depth_of(&case), elements).expect("a state");
        let row = last(&sliding);
        case.check_within("mu", row.friction_coefficient, n.powi(-2));
        let lengths: f64 = intervals.chunks(2).map(|ends| ends[1] - ends[0]).sum();
        for (value, expected, allowed) in [
            (row.contact[0], intervals[0], 1.0),
            (row.contact[1], intervals[intervals.len() - 1], 1.0),
            (
                row.n_contact as f64 * sliding.spacing,
                lengths,
                0.5 * intervals.len() as f64,
            ),
        ] {
            let expected = Estimate::new(expected, 1.0001 * allowed * sliding.spacing);
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
        let marched = slide_to(&line, depth, 50).err();
        let directly = steady(&line, &material(VISCOSITY), &load_for_depth(depth), ASKED).err();
        for error in [marched, directly] {
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
            assert_close([carried, height / depth], 1e-9, 1.0, &case.id());
            assert_close([available, height], 1e-9, 1.0, &case.id());
        }
    }
}
