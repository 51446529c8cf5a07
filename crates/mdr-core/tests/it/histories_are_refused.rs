//! Histories that cannot be followed are refused by name.

use indenters::{Control, PowerTerm, Sphere, Superposition};
use mdr_core::{Follow, HistoryPoint, MdrError, indent_along};

use crate::histories_match_quadrature::{body, material};

#[test]
fn wrong_histories_are_refused() {
    let depth = |time: f64, depth: f64| HistoryPoint {
        time,
        control: Control::IndentationDepth(depth),
    };
    let force = |time: f64, force: f64| HistoryPoint {
        time,
        control: Control::NormalForce(force),
    };
    let cases = [
        (
            vec![depth(1.0, 0.0), depth(0.5, 1e-3)],
            "time between two points",
        ),
        (vec![depth(f64::NAN, 0.0)], "time"),
        (vec![depth(0.0, f64::INFINITY)], "indentation_depth"),
        (vec![force(0.0, -1.0)], "normal_force"),
        (vec![depth(0.0, 0.0), force(1.0, 1.0)], "control"),
        (
            vec![depth(0.0, 1e-3), depth(1.0, 1e-3)],
            "time between two depths",
        ),
    ];
    for (history, parameter) in cases {
        let result = indent_along(
            &*body("cone"),
            &material("kelvin-voigt"),
            &history,
            &Follow::default(),
        );
        match result {
            Err(MdrError::InvalidParameter(refused)) => {
                assert_eq!(refused.parameter, parameter, "{history:?}");
            }
            other => panic!("{history:?}: {other:?}"),
        }
    }
}

#[test]
fn no_points_and_a_line_that_turns_down_are_refused() {
    let nothing = indent_along(&*body("cone"), &material("solid"), &[], &Follow::default());
    assert_eq!(
        nothing,
        Err(MdrError::Empty { list: "history" }),
        "no points"
    );
    let term = |coefficient, exponent| PowerTerm {
        coefficient,
        exponent,
    };
    let hump = Superposition::new(vec![term(1.0, 1.0), term(-1.0, 2.0)]).expect("a body");
    let deep = [0.0, 1.0].map(|depth| HistoryPoint {
        time: depth,
        control: Control::IndentationDepth(depth),
    });
    let result = indent_along(&hump, &material("solid"), &deep, &Follow::default());
    assert!(
        matches!(result, Err(MdrError::Indenter(_))),
        "the line turns down: {result:?}"
    );
}

#[test]
fn a_sphere_is_not_pressed_beyond_its_equator() {
    let sphere = Sphere::new(5e-6).expect("a sphere");
    for control in [Control::IndentationDepth(1e-2), Control::NormalForce(10.0)] {
        let start = match control {
            Control::NormalForce(_) => Control::NormalForce(0.0),
            Control::IndentationDepth(_) => Control::IndentationDepth(0.0),
        };
        let history = [(0.0, start), (1.0, control)];
        let history = history.map(|(time, control)| HistoryPoint { time, control });
        let result = indent_along(&sphere, &material("solid"), &history, &Follow::default());
        let refused = matches!(
            result,
            Err(MdrError::DepthBeyondEdge { position: 5e-6, .. })
        );
        assert!(refused, "{control:?}: {result:?}");
    }
}
