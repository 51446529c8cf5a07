use casebook::{assert_close, assert_matches};
use friction_analytic::{
    FrictionError, StationarySliding, line_sliding, one_sided_sinking_velocity, sinking_velocity,
};
use indenters::{AnalyticLine, RigidLine, SampledLine};

use crate::support::{material_and_load, with_depth};

/// 0.2 |x| + 3 on [−1, 1].
fn wedge() -> impl RigidLine {
    let (height, slope) = (|x: f64| 0.2 * x.abs() + 3.0, |x: f64| 0.2 * x.signum());
    AnalyticLine::new(height, slope, [-1.0, 1.0]).unwrap()
}

fn slide(line: &impl RigidLine, depth: f64) -> Result<StationarySliding, FrictionError> {
    let (material, load) = with_depth(depth);
    line_sliding(line, &material, &load)
}

/// What (15) gives, corrected and as printed, over a contact under the load of a stationary depth.
fn sink(
    line: &impl RigidLine,
    contact: &[[f64; 2]],
    depth: f64,
) -> [Result<f64, FrictionError>; 2] {
    let (material, load) = with_depth(depth);
    [
        sinking_velocity(line, contact, &material, &load),
        one_sided_sinking_velocity(line, contact, &material, &load),
    ]
}

#[test]
fn leading_edge_carries_the_load() {
    for case in casebook::group("FRI-03") {
        if !case.has_input("eps") {
            continue;
        }
        let (e, line) = (case.input("eps"), case.cubic(1.0));
        let depth = case.input("D_over_eps") * e;
        if case.expected_error() == Some("NoStationaryState") {
            let is_mirrored = case.has_input("direction");
            let offered = if is_mirrored { 0.0 } else { 1.5 * e };
            assert_matches!(
                slide(&line, depth),
                Err(FrictionError::NoStationaryState { needed_depth, available_depth })
                    if (needed_depth - depth).abs() <= 1e-15 * depth
                        && (available_depth - offered).abs() <= 1e-14 * e,
                "{}", case.id()
            );
            continue;
        }
        let state = slide(&line, depth).unwrap();
        let mu = state.friction_coefficient;
        case.check_within("mu", mu, state.error / mu);
        assert!(state.error < 1e-13 * mu, "{}: {state:?}", case.id());
        assert_close!(state.indentation_depth => depth, within 1e-15);
        let ends = case.expected_list("intervals").expect("intervals");
        let length = ends.chunks(2).map(|ends| ends[1] - ends[0]).sum();
        assert_close!(state.contact_length() => length, within 1e-14; "{}", case.id());
    }
}

/// On a table every piece contributes its slope times the height it gains on the leading edge.
#[test]
fn a_table_slides_on_the_visible_parts_of_its_pieces() {
    let mut group = casebook::group("FRI-03").into_iter();
    let case = group.find(|case| case.id() == "FRI-03/discrete/steady");
    let case = case.expect("the group has the row of the table");
    let (heights, spacing, depth) = (case.input_list("h"), case.input("dx"), case.input("D"));
    let increments = case.expected_list("increments").expect("increments");
    let slopes = heights.windows(2).map(|pair| (pair[1] - pair[0]) / spacing);
    let pairs = slopes.zip(&increments);
    let work = pairs.map(|(slope, gained)| slope * gained);
    let expected = work.sum::<f64>() / depth;
    let positions = (0..heights.len()).map(|i| i as f64 * spacing).collect();
    let line = SampledLine::new(positions, heights).unwrap();
    let state = slide(&line, depth).unwrap();
    assert_close!(state.friction_coefficient => expected, within 1e-14);
}

#[test]
fn the_stationary_contact_does_not_sink() {
    let line = casebook::group("FRI-03")[0].cubic(1.0);
    let state = slide(&line, 1.2 * 0.05).unwrap();
    for velocity in sink(&line, &state.contact_line, 1.2 * 0.05) {
        // D minus the rise cancels; what is left is the rounding of both, over the contact length.
        let velocity = velocity.unwrap();
        assert!(velocity.abs() <= 0.5e-14, "v_z = {velocity:e} at v = 0.5");
    }
}

/// (15) v_z = F/(4 η a) − v d/a while only the leading flank touches.
#[test]
fn one_sided_contact_follows_equation_15() {
    let (force, eta, v, a) = (0.3, 3.0, 0.25, 0.4);
    let (material, load) = material_and_load([force, eta, v]);
    let expected = force / (4.0 * eta * a) - v * 0.2 * a / a;
    for function in [sinking_velocity, one_sided_sinking_velocity] {
        let velocity = function(&wedge(), &[[0.0, a]], &material, &load).unwrap();
        assert_close!(velocity => expected, within 1e-14);
    }
}

#[test]
fn equation_15_is_refused_where_it_does_not_hold() {
    // Where both flanks touch, the rise is zero, and only the load resists.
    let [velocity, _] = sink(&wedge(), &[[-0.2, 0.2]], 0.1);
    assert_close!(velocity.unwrap() => 0.5 * 0.1 / 0.4, within 1e-14);
    for contact in [[-0.2, 0.2], [0.1, 0.4], [-0.1, 0.4]] {
        let [_, printed] = sink(&wedge(), &[contact], 0.1);
        assert_matches!(printed, Err(FrictionError::NotOneSided { .. }));
    }
    let [_, deep] = sink(&wedge(), &[[0.0, 0.6]], 0.1);
    assert_matches!(deep, Err(FrictionError::BeyondStationaryDepth { .. }));
}

#[test]
fn invalid_contact_intervals_are_refused() {
    let line = casebook::group("FRI-03")[0].cubic(1.0);
    let sink = |contact: &[[f64; 2]]| sink(&line, contact, 0.05)[0].clone();
    // Of no length, and beyond the end of the line.
    for result in [sink(&[]), sink(&[[2.0, 4.0]])] {
        assert_matches!(result, Err(FrictionError::OutOfRange { .. }));
    }
    for result in [
        sink(&[[0.3, 0.3]]),
        sink(&[[0.5, 0.2]]),
        sink(&[[0.0, 0.5], [0.4, 0.6]]),
        sink(&[[f64::NAN, 1.0]]),
        sink(&[[0.0, f64::INFINITY]]),
    ] {
        assert_matches!(result, Err(FrictionError::InvalidContact { .. }));
    }
}
