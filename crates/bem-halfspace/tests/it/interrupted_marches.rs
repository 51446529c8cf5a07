//! A march that is interrupted and resumed makes the same steps to the last bit.

use bem_halfspace::slide::{March, MarchState, Motion, MotionRow};
use bem_halfspace::{BemError, Control, Footprint, GridOptions};
use indenters::{PowerProfile, Unmirrored};
use rheology::Elastic;

use crate::support::prony;

/// Pressed, released to a much smaller contact, slid by fractions of an element, lifted, and pressed elsewhere.
fn motions() -> Vec<Motion> {
    let motion = |k: usize| {
        let time = 0.1 * k as f64;
        let control = match k {
            1..4 => Control::NormalForce(6.0),
            18..22 => Control::IndentationDepth(-0.5),
            _ => Control::NormalForce(0.4 + 0.3 * (0.3 * k as f64).sin()),
        };
        let position = (0.07 * k as f64).min(1.9);
        Motion {
            time,
            position,
            control,
        }
    };
    (1..=32).map(motion).collect()
}

fn resolution() -> GridOptions {
    GridOptions::new([0.1; 2], Footprint::square(1.6))
}

fn rest(march: &mut March<'_>) -> Vec<MotionRow> {
    let mut rows = Vec::new();
    while let Some(row) = march.step().expect("a step") {
        rows.push(row);
    }
    rows
}

#[test]
fn a_resumed_march_makes_the_same_steps_to_the_last_bit() {
    let body = PowerProfile::new(0.5, 1.5).expect("a body");
    let material = prony([0.2, 0.0], &[(2.0, 0.3), (1.0, 2.0)]);
    let new = || March::new(&body, &material, &motions(), &resolution()).expect("a march");
    let expected = rest(&mut new());
    for interruption in [0, 1, 4, 9, 12, 19, 25, 32] {
        let mut first = new();
        let mut rows: Vec<MotionRow> = (0..interruption)
            .map(|_| first.step().expect("a step").expect("a row"))
            .collect();
        let state = through_text(&first.state());
        assert_eq!(state.steps_done(), interruption, "steps in the state");
        let mut second = new();
        second.resume(&state).expect("a state of the same scene");
        assert_eq!(
            second.pressure(),
            first.pressure(),
            "pressure after {interruption} steps"
        );
        rows.extend(rest(&mut second));
        assert_eq!(rows, expected, "interrupted after {interruption} steps");
    }
}

#[cfg(feature = "serde")]
fn through_text(state: &MarchState) -> MarchState {
    let text = serde_json::to_string(state).expect("a text");
    serde_json::from_str(&text).expect("a state")
}

#[cfg(not(feature = "serde"))]
fn through_text(state: &MarchState) -> MarchState {
    state.clone()
}

#[test]
fn a_state_of_another_scene_is_refused() {
    let body = PowerProfile::new(0.5, 1.5).expect("a body");
    let [one, two] = [
        prony([0.2, 0.0], &[(2.0, 0.3)]),
        prony([0.2, 0.0], &[(2.0, 0.3), (1.0, 2.0)]),
    ];
    let mut first = March::new(&body, &one, &motions(), &resolution()).expect("a march");
    for _ in 0..3 {
        first.step().expect("a step");
    }
    let mut other = March::new(&body, &two, &motions(), &resolution()).expect("a march");
    let refused = other.resume(&first.state());
    assert!(
        matches!(
            refused,
            Err(BemError::LengthMismatch {
                field: "memory",
                ..
            })
        ),
        "{refused:?}"
    );
    let mut shorter = March::new(&body, &one, &motions()[..2], &resolution()).expect("a march");
    let refused = shorter.resume(&first.state());
    assert!(
        matches!(
            refused,
            Err(BemError::InvalidParameter {
                parameter: "steps done",
                ..
            })
        ),
        "{refused:?}"
    );
}

/// The footprint of one has both sides, that of the other one.
#[test]
fn states_with_and_without_a_mirror_do_not_fit() {
    let body = PowerProfile::new(0.5, 1.5).expect("a body");
    let whole = Unmirrored(&body);
    let elastic = Elastic::new(2.0).expect("a material");
    let mut mirrored = March::new(&body, &elastic, &motions(), &resolution()).expect("a march");
    let mut all = March::new(&whole, &elastic, &motions(), &resolution()).expect("a march");
    for step in [mirrored.step(), all.step()] {
        step.expect("a step");
    }
    let [front, both] = [mirrored.state(), all.state()];
    for refused in [mirrored.resume(&both), all.resume(&front)] {
        assert!(
            matches!(
                refused,
                Err(BemError::InvalidParameter {
                    parameter: "columns of the footprint",
                    ..
                })
            ),
            "{refused:?}"
        );
    }
}

#[cfg(feature = "serde")]
#[test]
fn a_state_with_an_impossible_box_is_refused() {
    let body = PowerProfile::new(0.5, 1.5).expect("a body");
    let elastic = Elastic::new(2.0).expect("a material");
    let mut march = March::new(&body, &elastic, &motions(), &resolution()).expect("a march");
    march.step().expect("a step");
    let mut state = serde_json::to_value(march.state()).expect("a value");
    state["contact_box"][0][0] = serde_json::json!(usize::MAX);
    let refused = march.resume(&serde_json::from_value(state).expect("a state"));
    assert!(
        matches!(
            refused,
            Err(BemError::InvalidParameter {
                parameter: "start of the contact box",
                ..
            })
        ),
        "{refused:?}"
    );
}
