//! Histories that cannot be followed are refused by name.

use casebook::{assert_matches, superposition};
use friction_analytic::{BondedLayer, LayerProfile};
use indenters::{Axisymmetric, Control, HistoryPoint, PowerProfile, Sphere};
use mdr_core::{CurvePoint, HistoryOptions, MdrError, indent_along};

use crate::histories_match_quadrature::{body, material};
use crate::support::history;

use Control::{IndentationDepth, NormalForce};

fn follow(
    body: &dyn Axisymmetric,
    on: &str,
    history: &[HistoryPoint],
) -> Result<Vec<CurvePoint>, MdrError> {
    indent_along(&body, &material(on), history, &HistoryOptions::default())
}

#[test]
fn wrong_histories_are_refused() {
    let depths = |points: &[[f64; 2]]| history(points.iter().copied(), IndentationDepth);
    let forces = |points: &[[f64; 2]]| history(points.iter().copied(), NormalForce);
    let mixed = [depths(&[[0.0; 2]]), forces(&[[1.0; 2]])].concat();
    let (back, jump) = ([[1.0, 0.0], [0.5, 1e-3]], [[0.0, 1e-3], [1.0, 1e-3]]);
    for (history, parameter) in [
        (depths(&back), "time between two points"),
        (depths(&[[f64::NAN, 0.0]]), "time"),
        (depths(&[[0.0, f64::INFINITY]]), "indentation_depth"),
        (forces(&[[0.0, -1.0]]), "normal_force"),
        (mixed, "control"),
        (depths(&jump), "time between two depths"),
    ] {
        assert_matches!(
            follow(&*body("cone"), "kelvin-voigt", &history),
            Err(MdrError::InvalidParameter(ref refused)) if refused.parameter == parameter,
            "{parameter}"
        );
    }
    let nothing = follow(&*body("cone"), "solid", &[]);
    let empty = Err(MdrError::Empty { list: "history" });
    assert_eq!(nothing, empty, "no points");
}

#[test]
fn a_body_is_not_pressed_where_its_line_turns_down_or_beyond_its_equator() {
    let rising = |to, control| history([[0.0, 0.0], [1.0, to]], control);
    let hump = superposition(&[(1.0, 1.0), (-1.0, 2.0)]);
    let result = follow(&hump, "solid", &rising(1.0, IndentationDepth));
    assert_matches!(result, Err(MdrError::Indenter(_)));
    let sphere = Sphere::new(5e-6).expect("a sphere");
    let result = follow(&sphere, "solid", &rising(1e-2, IndentationDepth));
    assert_matches!(
        result,
        Err(MdrError::DepthBeyondEdge { position: 5e-6, .. })
    );
    // No depth is named that was not asked for.
    let result = follow(&sphere, "solid", &rising(10.0, NormalForce));
    assert_matches!(
        result,
        Err(MdrError::ForceBeyondEdge { normal_force: 10.0, available, .. }) if available < 1e-4
    );
}

/// A profile which stands for a surface whose elements are not independent is followed while the contact grows once and shrinks once.
#[test]
fn a_profile_of_a_layer_is_not_pressed_again() {
    let ball = PowerProfile::paraboloid(0.5).expect("a ball");
    let layer = BondedLayer::new(0.2, 0.5).expect("a layer");
    let profile = LayerProfile::new(&ball, &layer, 0.05).expect("a profile");
    let solid = material("solid");
    let follow = |points: &[[f64; 2]], control| {
        let history = history(points.iter().copied(), control);
        indent_along(&profile, &solid, &history, &HistoryOptions::default())
    };
    let once = [[0.0, 0.0], [1.0, 0.02], [2.0, 0.02], [3.0, 0.0]];
    let again = [[0.0, 0.0], [1.0, 0.02], [1.2, 0.01], [3.0, 0.01]];
    for control in [IndentationDepth, NormalForce] {
        let curve = follow(&once, control).expect("a curve");
        assert!(curve[1].contact_radius.value > 0.1, "{:?}", curve[1]);
        let refused = follow(&again, control);
        assert_matches!(refused, Err(MdrError::TouchedAgain { time: 3.0 }));
    }
}
