//! A motion with error bars: its end is steady sliding, and the bars of coarse grids hold finer values.

use bem_halfspace::indenters::{MovingLoad, MovingPoint, Shape, Sphere, Stroke};
use bem_halfspace::numerics::Accuracy;
use bem_halfspace::rheology::{Maxwell, StandardSolid, StandardSolidParameters};
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

#[test]
fn a_long_path_ends_in_steady_sliding() {
    let (velocity, distance) = (0.1, 1.5e-2);
    let point = |time: f64| MovingPoint {
        time,
        position: velocity * time,
        control: Control::NormalForce(FORCE),
    };
    let path = [0.0, distance / velocity].map(point);
    let load = MovingLoad::through(&path).expect("a motion");
    let moved = move_along(&ball(), &rubber(), &load, Accuracy::Elements(12)).expect("a motion");
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
        (5e-3, 2.0, Control::NormalForce(FORCE)),
        (5e-4, 10.0, Control::NormalForce(FORCE)),
        (2e-3, 5.0, Control::IndentationDepth(1e-4)),
    ] {
        let motion = to_and_fro(length, frequency, control);
        let on = |elements| {
            move_along(&ball(), &rubber(), &motion, Accuracy::Elements(elements)).expect("a cycle")
        };
        let fine = on(20);
        for elements in [8, 12] {
            let coarse = on(elements);
            for (name, coarse, fine) in [
                (
                    "friction",
                    coarse.friction_coefficient,
                    fine.friction_coefficient,
                ),
                ("peak", coarse.peak_friction, fine.peak_friction),
                (
                    "energy",
                    coarse.dissipated_energy.expect("of a cycle"),
                    fine.dissipated_energy.expect("of a cycle"),
                ),
            ] {
                let error = (coarse.value - fine.value).abs();
                assert!(
                    error <= coarse.error + fine.error,
                    "{name}, {elements} elements, {control:?}: {coarse:?}, {fine:?}"
                );
            }
        }
    }
}

#[test]
fn a_fluid_has_no_cycle() {
    let fluid = Maxwell::new(1e6, 1e5).expect("a fluid");
    let motion = to_and_fro(1e-3, 1.0, Control::NormalForce(FORCE));
    let refused = move_along(&ball(), &fluid, &motion, 1e-2);
    assert_eq!(refused, Err(BemError::NoCycle), "to and fro");
}
