//! A motion with error bars: its end is steady sliding, and the bars of coarse grids hold finer values.

use bem_halfspace::indenters::{
    Moved, MovingLoad, MovingPoint, PowerProfile, Shape, Sphere, Stroke,
};
use bem_halfspace::numerics::{Accuracy, Estimate};
use bem_halfspace::rheology::{KelvinVoigt, Maxwell, StandardSolid, StandardSolidParameters};
use bem_halfspace::{BemError, Control, SlidingLoad, move_along, steady};

const FORCE: f64 = 2.0;

fn ball() -> Sphere {
    Sphere::new(5e-3).expect("a sphere")
}

fn rubber() -> StandardSolid {
    let parameters = StandardSolidParameters {
        equilibrium_modulus: 1e6,
        maxwell_modulus: 1e7,
        viscosity: 1e5,
    };
    StandardSolid::new(parameters).expect("a solid")
}

fn to_and_fro(length: f64, frequency: f64, control: Control) -> MovingLoad {
    let stroke = Stroke {
        length,
        frequency,
        shape: Shape::Sinusoidal,
    };
    MovingLoad::reciprocating(control, stroke).expect("a motion")
}

/// At the end e^(−S/vλ) of the tilt that the first touch leaves is still there, 0.2 % of the friction.
#[test]
fn a_long_path_ends_in_steady_sliding() {
    let (velocity, distance) = (0.1, 1.5e-2);
    let point = |time: f64| MovingPoint {
        time,
        position: velocity * time,
        control: Control::NormalForce(FORCE),
    };
    let path = [0.0, distance / velocity].map(point);
    let load = MovingLoad::through_points(&path).expect("a motion");
    let moved = move_along(&ball(), &rubber(), &load, Accuracy::Elements(8)).expect("a motion");
    let load = SlidingLoad::new(FORCE, velocity).expect("a load");
    let state = steady(&ball(), &rubber(), &load, 1e-2).expect("a stationary state");
    let expected = state.friction_coefficient.value * FORCE;
    let got = moved.points[moved.points.len() - 1].tangential_force;
    let allowed = got.error + state.friction_coefficient.error * FORCE;
    assert!(
        (got.value - expected).abs() <= allowed,
        "{got:?}, expected {expected}"
    );
    assert!(got.error < 0.1 * expected, "{got:?}");
}

#[test]
fn bars_of_coarse_grids_hold_finer_cycles() {
    for (length, frequency, control) in [
        (3e-3, 2.0, Control::NormalForce(FORCE)),
        (5e-4, 10.0, Control::NormalForce(FORCE)),
        (1.5e-3, 5.0, Control::IndentationDepth(1e-4)),
    ] {
        let motion = to_and_fro(length, frequency, control);
        let on = |elements| {
            move_along(&ball(), &rubber(), &motion, Accuracy::Elements(elements)).expect("a cycle")
        };
        let [coarse, fine] = [8, 12].map(on);
        let energy = |cycle: &Moved| cycle.dissipated_energy.expect("of a cycle");
        for (name, coarse, fine) in [
            (
                "friction",
                coarse.friction_coefficient,
                fine.friction_coefficient,
            ),
            ("peak", coarse.peak_friction, fine.peak_friction),
            ("energy", energy(&coarse), energy(&fine)),
        ] {
            let error = (coarse.value - fine.value).abs();
            assert!(
                error <= coarse.error + fine.error,
                "{name}, {control:?}: {coarse:?}, {fine:?}"
            );
        }
    }
}

/// A solid of an equilibrium modulus of 1 MPa and one branch of a modulus \[Pa] and a relaxation time \[s].
fn one_branch(modulus: f64, relaxation_time: f64) -> StandardSolid {
    let parameters = StandardSolidParameters {
        equilibrium_modulus: 1e6,
        maxwell_modulus: modulus,
        viscosity: modulus * relaxation_time,
    };
    StandardSolid::new(parameters).expect("a solid")
}

/// Friction is of either sign behind a turning point, where the work of a step is not the force at its end times its length. The
/// expected values come from a chain of Love rectangles with projected conjugate gradients, extrapolated from three resolutions.
#[test]
fn coarse_grids_know_the_friction_of_short_strokes() {
    let cone = PowerProfile::new(0.2, 1.0).expect("a cone");
    let stroke = Stroke {
        length: 4.69e-4,
        frequency: 3.9,
        shape: Shape::Triangular,
    };
    let load = MovingLoad::reciprocating(Control::NormalForce(0.3), stroke).expect("a motion");
    let accuracy = Accuracy::Elements(8);
    let moved = move_along(&cone, &one_branch(4e6, 8.9e-3), &load, accuracy).expect("a cycle");
    assert_holds(moved.friction_coefficient, Estimate::new(0.06015, 4e-5));

    let paraboloid = PowerProfile::new(100.0, 2.0).expect("a paraboloid");
    let load = to_and_fro(6.55e-4, 3.0, Control::IndentationDepth(5.15e-5));
    let solid = one_branch(5e6, 0.02);
    let moved = move_along(&paraboloid, &solid, &load, accuracy).expect("a cycle");
    assert_holds(moved.peak_friction, Estimate::new(0.03594, 4e-5));
}

fn assert_within_bars(got: Estimate, expected: Estimate) {
    let error = (got.value - expected.value).abs();
    assert!(
        error <= got.error + expected.error,
        "{got:?}, expected {expected:?}"
    );
}

fn assert_holds(got: Estimate, expected: Estimate) {
    assert_within_bars(got, expected);
    assert!(got.error < 0.02 * expected.value, "{got:?}");
}

/// Memory length of many cycles under a stroke as long as the contact.
#[test]
fn a_long_memory_needs_few_elements() {
    let paraboloid = PowerProfile::new(100.0, 2.0).expect("a paraboloid");
    let load = to_and_fro(6.55e-4, 2.0, Control::NormalForce(0.3));
    let accuracy = Accuracy::Elements(8);
    let moved = move_along(&paraboloid, &one_branch(2e6, 0.5), &load, accuracy).expect("a cycle");
    let friction = moved.friction_coefficient;
    assert!(friction.error < 0.02 * friction.value, "{friction:?}");
}

/// A triangular stroke of a profile c r^p at a depth of 0.1 mm, five times a second, on a Kelvin–Voigt material.
///
/// After many strokes the body runs in a groove that is nearly as deep as itself: few elements are in contact, at some times none.
fn groove(profile: (f64, f64), retardation_time: f64, length: f64, elements: usize) -> Estimate {
    let (coefficient, exponent) = profile;
    let body = PowerProfile::new(coefficient, exponent).expect("a body");
    let material = KelvinVoigt::new(1e6, 1e6 * retardation_time).expect("a material");
    let stroke = Stroke {
        length,
        frequency: 5.0,
        shape: Shape::Triangular,
    };
    let load =
        MovingLoad::reciprocating(Control::IndentationDepth(1e-4), stroke).expect("a motion");
    let moved = move_along(&body, &material, &load, Accuracy::Elements(elements));
    moved.expect("a limit cycle").friction_coefficient
}

/// The search for the limit cycle passes states in which the surface lies below the body everywhere, and nothing changes any force.
#[test]
fn a_cycle_without_contact_is_not_the_limit() {
    let cone = (0.05, 1.0);
    let (coarse, fine) = (
        groove(cone, 0.506, 3.5e-4, 8),
        groove(cone, 0.506, 3.5e-4, 16),
    );
    assert_within_bars(coarse, fine);
    assert!(coarse.value > 0.03, "{coarse:?}");
    let paraboloid = (50.0, 2.0);
    let (stroke, relaxation_time) = (4.0975e-4, 1.18395);
    let on = |elements| groove(paraboloid, relaxation_time, stroke, elements);
    assert_within_bars(on(8), on(12));
}

/// On eight elements along the stationary contact, fewer are in contact with the groove, and coarse grids agree by chance to 0.8 %.
/// This function on 32 elements gives 0.03393 ± 0.00016.
#[test]
fn bars_hold_on_few_elements_in_contact() {
    let coarse = groove((2.0, 1.5), 1.2, 1.6e-3, 8);
    let deviation = (coarse.value - 0.03393).abs();
    assert!(deviation <= coarse.error, "{coarse:?}");
    assert!(coarse.error < 0.2 * coarse.value, "{coarse:?}");
}

#[test]
fn a_fluid_has_no_cycle() {
    let fluid = Maxwell::new(1e6, 1e5).expect("a fluid");
    let motion = to_and_fro(1e-3, 1.0, Control::NormalForce(FORCE));
    let refused = move_along(&ball(), &fluid, &motion, 1e-2);
    assert_eq!(refused, Err(BemError::NoCycle), "to and fro");
}
