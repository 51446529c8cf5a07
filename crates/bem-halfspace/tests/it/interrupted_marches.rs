//! A march that is interrupted and resumed makes the same steps to the last bit.

use bem_halfspace::Control;
use bem_halfspace::slide::{March, MotionRow};
use indenters::{Surface, Unmirrored};
use rheology::Material;

use crate::support::{assert_refused, elastic, motions, power, prony, squares};

/// Pressed, released to a much smaller contact, slid by fractions of an element, lifted, and pressed elsewhere.
fn path(k: usize) -> (f64, f64, Control) {
    let k_th = k as f64;
    let control = match k {
        1..4 => Control::NormalForce(6.0),
        18..22 => Control::IndentationDepth(-0.5),
        _ => Control::NormalForce(0.4 + 0.3 * (0.3 * k_th).sin()),
    };
    (0.1 * k_th, (0.07 * k_th).min(1.9), control)
}

fn march<'a>(body: &'a dyn Surface, material: &dyn Material, n_steps: usize) -> March<'a> {
    let motions = motions((1..=n_steps).map(path));
    March::new(body, material, &motions, &squares(0.1, 1.6)).expect("a march")
}

/// Makes at most so many steps.
fn step(march: &mut March<'_>, n_steps: usize) -> Vec<MotionRow> {
    let step = |_| march.step().expect("a step");
    (0..n_steps).map_while(step).collect()
}

#[test]
fn a_resumed_march_makes_the_same_steps_to_the_last_bit() {
    let body = power(0.5, 1.5);
    let material = prony([0.2, 0.0], &[(2.0, 0.3), (1.0, 2.0)]);
    let new = || march(&body, &material, 32);
    let expected = step(&mut new(), 33);
    assert_eq!(expected.len(), 32, "steps of the motion");
    for interruption in [0, 1, 4, 9, 12, 19, 25, 32] {
        let mut first = new();
        let mut rows = step(&mut first, interruption);
        let state = first.state();
        #[cfg(feature = "serde")]
        let text = serde_json::to_string(&state).expect("a text");
        #[cfg(feature = "serde")]
        let state = serde_json::from_str(&text).expect("a state");
        let mut second = new();
        second.resume(&state).expect("a state of the same scene");
        assert_eq!(state.steps_done(), interruption, "steps in the state");
        let pressures = [&first, &second].map(|march| march.pressure());
        assert_eq!(pressures[0], pressures[1], "after {interruption} steps");
        rows.extend(step(&mut second, 33));
        assert_eq!(rows, expected, "after {interruption} steps");
    }
}

#[test]
fn a_state_of_another_scene_is_refused() {
    let body = power(0.5, 1.5);
    let whole = Unmirrored(&body);
    let branches = [(2.0, 0.3), (1.0, 2.0)];
    let [one, two] = [1, 2].map(|n| prony([0.2, 0.0], &branches[..n]));
    let mut first = march(&body, &one, 32);
    step(&mut first, 3);
    let refused = march(&body, &two, 32).resume(&first.state());
    assert!(format!("{refused:?}").contains("\"memory\""), "{refused:?}");
    assert_refused("branches", refused, "LengthMismatch");
    let refused = march(&body, &one, 2).resume(&first.state());
    assert_refused("two steps", refused, "steps done");
    // The footprint of one has both sides, that of the other one.
    let elastic = elastic(2.0);
    let mut mirrored = march(&body, &elastic, 32);
    let mut all = march(&whole, &elastic, 32);
    step(&mut mirrored, 1);
    step(&mut all, 1);
    let [front, both] = [mirrored.state(), all.state()];
    for refused in [mirrored.resume(&both), all.resume(&front)] {
        assert_refused("a mirror", refused, "columns of the footprint");
    }
    #[cfg(feature = "serde")]
    {
        let mut state = serde_json::json!(both);
        state["contact_box"][0][0] = serde_json::json!(usize::MAX);
        let refused = all.resume(&serde_json::from_value(state).expect("a state"));
        assert_refused("a box", refused, "start of the contact box");
    }
}
