use casebook::{Case, assert_close, assert_matches};
use friction_analytic::{
    FrictionError, StationarySliding, axisymmetric_sliding, line_sliding,
    one_sided_sinking_velocity, sinking_velocity,
};
use indenters::{AnalyticLine, Axisymmetric, EquivalentLine, Hyperboloid, RigidLine, SampledLine};

use crate::support::with_depth;

/// e (x³/3 − 3x²/2 + 2x), moving to the right, or its mirror image on the same interval.
fn cubic(e: f64, domain: [f64; 2], direction: f64) -> impl RigidLine {
    let position = move |x: f64| {
        if direction > 0.0 {
            x
        } else {
            domain[0] + domain[1] - x
        }
    };
    let height = move |x: f64| {
        let x = position(x);
        e * x * (x * (x / 3.0 - 1.5) + 2.0)
    };
    let slope = move |x: f64| {
        let x = position(x);
        direction * e * (x - 1.0) * (x - 2.0)
    };
    AnalyticLine::new(height, slope, domain).unwrap()
}

#[test]
fn leading_edge_carries_the_load() {
    for case in casebook::group("FRI-03") {
        if !case.has_input("eps") {
            continue;
        }
        let e = case.input("eps");
        let domain = case.input_list("X");
        let direction = if case.has_input("direction") {
            case.input("direction")
        } else {
            1.0
        };
        let line = cubic(e, [domain[0], domain[1]], direction);
        let depth = case.input("D_over_eps") * e;
        let (material, load) = with_depth(depth);
        match line_sliding(&line, &material, &load) {
            Ok(state) => check_contact(&case, depth, &state),
            Err(FrictionError::NoStationaryState {
                needed_depth,
                available_depth,
            }) => {
                assert_eq!(
                    case.expected_error(),
                    Some("NoStationaryState"),
                    "{}",
                    case.id()
                );
                assert_close!(needed_depth => depth, within 1e-15);
                let offered = if direction > 0.0 { 1.5 * e } else { 0.0 };
                let difference = (available_depth - offered).abs();
                assert!(
                    difference <= 1e-14 * e,
                    "{}: {available_depth} of {offered}",
                    case.id()
                );
            }
            Err(other) => panic!("{}: {other}", case.id()),
        }
    }
}

fn check_contact(case: &Case, depth: f64, state: &StationarySliding) {
    case.check("mu", state.friction_coefficient);
    assert_close!(state.indentation_depth => depth, within 1e-15);
    let ends: Vec<f64> = state.contact_line.concat();
    let expected = case
        .expected_list("intervals")
        .expect("intervals are expected");
    assert_eq!(ends.len(), expected.len(), "{}: {ends:?}", case.id());
    for (end, expected) in ends.iter().zip(&expected) {
        // The slope at the fronts is at least e/2, so heights of order e give them to a few units in the last place.
        let difference = (end - expected).abs();
        assert!(
            difference <= 1e-14,
            "{}: {ends:?} instead of {expected}",
            case.id()
        );
    }
}

/// On a table every piece contributes its slope times the height it gains on the leading edge.
#[test]
fn a_table_slides_on_the_visible_parts_of_its_pieces() {
    let group = casebook::group("FRI-03");
    let case = group
        .iter()
        .find(|case| case.id() == "FRI-03/discrete/steady");
    let case = case.expect("the group has the row of the table");
    let (heights, spacing, depth) = (case.input_list("h"), case.input("dx"), case.input("D"));
    let increments = case
        .expected_list("increments")
        .expect("increments are expected");
    let slopes = heights.windows(2).map(|pair| (pair[1] - pair[0]) / spacing);
    let sum: f64 = slopes
        .zip(&increments)
        .map(|(slope, gained)| slope * gained)
        .sum();
    let positions = (0..heights.len()).scan(0.0, |next, _| {
        let position = *next;
        *next += spacing;
        Some(position)
    });
    let line = SampledLine::new(positions.collect(), heights).unwrap();
    let (material, load) = with_depth(depth);
    let state = line_sliding(&line, &material, &load).unwrap();
    assert_close!(state.friction_coefficient => sum / depth, within 1e-14);
    let velocity = sinking_velocity(&line, &state.contact_line, &material, &load).unwrap();
    assert!(
        velocity.abs() <= 1e-14 * load.velocity(),
        "the stationary contact sinks with {velocity:e}"
    );
}

#[test]
fn the_front_half_of_a_body_is_a_line_with_the_same_friction() {
    let body = Hyperboloid::new(0.5, 0.3).unwrap();
    let line =
        AnalyticLine::new(|x| body.line_height(x), |x| body.line_slope(x), [-1.0, 1.0]).unwrap();
    for depth in [1e-3, 0.1] {
        let (material, load) = with_depth(depth);
        let from_line = line_sliding(&line, &material, &load).unwrap();
        let from_body = axisymmetric_sliding(&body, &material, &load).unwrap();
        assert_close!(
            from_line.friction_coefficient => from_body.friction_coefficient,
            within 1e-12
        );
        assert_close!(from_line.contact_length() => from_body.contact_length(), within 1e-12);
    }
}

#[test]
fn the_stationary_contact_does_not_sink() {
    let e = 0.05;
    let line = cubic(e, [0.0, 3.0], 1.0);
    let depth = 1.2 * e;
    let (material, load) = with_depth(depth);
    let state = line_sliding(&line, &material, &load).unwrap();
    let speed = load.velocity();
    for velocity in [
        sinking_velocity(&line, &state.contact_line, &material, &load).unwrap(),
        one_sided_sinking_velocity(&line, &state.contact_line, &material, &load).unwrap(),
    ] {
        // D minus the rise cancels; what is left is the rounding of both, over the contact length.
        assert!(
            velocity.abs() <= 1e-14 * speed,
            "v_z = {velocity:e} at v = {speed}"
        );
    }
}

/// (15) v_z = F/(4 η a) − v d/a while only the leading flank touches.
#[test]
fn one_sided_contact_follows_equation_15() {
    let slope = 0.2;
    let line = AnalyticLine::new(
        |x: f64| slope * x.abs(),
        |x: f64| slope * x.signum(),
        [-1.0, 1.0],
    )
    .unwrap();
    let (force, eta, v) = (0.3, 3.0, 0.25);
    let (material, load) = crate::support::material_and_load([force, eta, v]);
    let a = 0.4;
    let expected = force / (4.0 * eta * a) - v * slope * a / a;
    for function in [sinking_velocity, one_sided_sinking_velocity] {
        let velocity = function(&line, &[[0.0, a]], &material, &load).unwrap();
        assert_close!(velocity => expected, within 1e-14);
    }
}

#[test]
fn equation_15_is_refused_where_it_does_not_hold() {
    let line = AnalyticLine::new(
        |x: f64| 0.2 * x.abs(),
        |x: f64| 0.2 * x.signum(),
        [-1.0, 1.0],
    )
    .unwrap();
    let (material, load) = with_depth(0.1);
    // Both flanks touch: the rise is zero, and only the load resists.
    let both = [[-0.2, 0.2]];
    let result = one_sided_sinking_velocity(&line, &both, &material, &load);
    assert_matches!(result, Err(FrictionError::NotOneSided { .. }));
    let velocity = sinking_velocity(&line, &both, &material, &load).unwrap();
    assert_close!(velocity => load.velocity() * 0.1 / 0.4, within 1e-14);
    for contact in [[[0.1, 0.4]], [[-0.1, 0.4]]] {
        let result = one_sided_sinking_velocity(&line, &contact, &material, &load);
        assert_matches!(
            result,
            Err(FrictionError::NotOneSided { .. }),
            "{contact:?}"
        );
    }
    let result = one_sided_sinking_velocity(&line, &[[0.0, 0.6]], &material, &load);
    assert_matches!(
        result,
        Err(FrictionError::BeyondStationaryDepth { .. }),
        " at depth 0.12 of 0.1"
    );
}

#[test]
fn contacts_that_are_no_contacts_are_refused() {
    let line = cubic(0.05, [0.0, 3.0], 1.0);
    let (material, load) = with_depth(0.05);
    for contact in [
        vec![[0.3, 0.3]],
        vec![[0.5, 0.2]],
        vec![[0.0, 0.5], [0.4, 0.6]],
        vec![[f64::NAN, 1.0]],
        vec![[0.0, f64::INFINITY]],
    ] {
        let result = sinking_velocity(&line, &contact, &material, &load);
        assert_matches!(
            result,
            Err(FrictionError::InvalidContact { .. }),
            "{contact:?}"
        );
    }
    for contact in [vec![], vec![[2.0, 4.0]]] {
        let result = sinking_velocity(&line, &contact, &material, &load);
        assert_matches!(result, Err(FrictionError::OutOfRange { .. }), "{contact:?}");
    }
}

#[test]
fn a_line_without_an_end_is_refused() {
    let body = Hyperboloid::new(0.5, 0.3).unwrap();
    let (material, load) = with_depth(0.1);
    let result = line_sliding(&EquivalentLine(&body), &material, &load);
    assert_matches!(result, Err(FrictionError::Indenter(_)));
}
