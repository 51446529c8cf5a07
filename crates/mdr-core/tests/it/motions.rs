//! A motion through points reaches the stationary state in its middle, and a reciprocating one has the linear response where
//! the contact stays; errors are within their estimates.

use std::f64::consts::PI;

use indenters::{
    Control, EquivalentLine, FlatCone, IndenterError, Moved, MovedPoint, MovingLoad, MovingPoint,
    PowerProfile, RigidLine, Shape, Sphere, Stroke,
};
use mdr_core::{MdrError, move_along, steady};
use numerics::Accuracy;
use rheology::{Material, Maxwell, Prony, RelaxationBranch, RelaxationSpectrum};

use crate::support::{at_depth, load};

const FORCE: f64 = 2.0;

fn ball() -> Sphere {
    Sphere::new(5e-3).expect("a sphere")
}

/// Branches of a decade and more each, from 1e-4 s on.
fn rubber(n_branches: i32) -> Prony {
    let branch = |k| RelaxationBranch::new(1e7 / f64::from(1 + k), 1e-4 * 15_f64.powi(k));
    let branches = (0..n_branches).map(branch).collect();
    let spectrum = RelaxationSpectrum::new(1e6, 0.0, branches).expect("a spectrum");
    Prony::new(spectrum).expect("a material")
}

fn through(points: &[[f64; 2]], control: Control) -> MovingLoad {
    let point = |&[time, position]: &[f64; 2]| MovingPoint {
        time,
        position,
        control,
    };
    let points: Vec<MovingPoint> = points.iter().map(point).collect();
    MovingLoad::through_points(&points).expect("a motion")
}

pub(crate) fn reciprocating(length: f64, frequency: f64, control: Control) -> MovingLoad {
    let stroke = Stroke {
        length,
        frequency,
        shape: Shape::Sinusoidal,
    };
    MovingLoad::reciprocating(control, stroke).expect("a motion")
}

/// Tangential force at the last point of the stage that ends at a time.
fn force_at(moved: &Moved, time: f64) -> numerics::Estimate {
    let at = |point: &&MovedPoint| (point.time - time).abs() < 1e-9 * time;
    moved
        .points
        .iter()
        .find(at)
        .expect("a point")
        .tangential_force
}

#[test]
fn a_long_stroke_ends_in_steady_sliding_forth_and_back() {
    let (ball, velocity) = (ball(), 0.1);
    let line = EquivalentLine(&ball);
    for (n_branches, control) in [
        (1, Control::NormalForce(FORCE)),
        (3, Control::NormalForce(FORCE)),
        (3, Control::IndentationDepth(5e-5)),
    ] {
        let material = rubber(n_branches);
        let state = match control {
            Control::NormalForce(force) => steady(&line, &material, &load(force, velocity), 1e-8),
            Control::IndentationDepth(depth) => {
                steady(&line, &material, &at_depth(depth, velocity), 1e-8)
            }
        };
        let state = state.expect("a stationary state");
        let expected = state.friction_coefficient.value * state.normal_force.value;
        let path = [[0.0, 0.0], [0.3, 0.03], [0.4, 0.03], [0.7, 0.0]];
        let moved = move_along(&line, &material, &through(&path, control), 1e-3);
        let moved = moved.map_err(|error| error.to_string()).expect("a motion");
        for (time, sign) in [(0.3, 1.0), (0.7, -1.0)] {
            let got = force_at(&moved, time);
            let error = (got.value - sign * expected).abs();
            // On the way back the elements have not yet recovered from the first stroke.
            let remembered = if sign < 0.0 { 1e-3 * expected } else { 0.0 };
            assert!(
                error <= got.error + remembered && got.error < 5e-3 * expected,
                "{n_branches} branches, {control:?}, at {time} s: {got:?}, expected {sign} {expected}"
            );
        }
    }
}

/// An element that stays in contact is compressed by −h̃' x(t), so that in a cycle it loses π G''(ω) (h̃' s/2)² per area; of
/// the contact at a depth only parts of the order of the stroke at its ends come and go.
#[test]
fn where_the_contact_stays_the_loss_is_that_of_the_loss_modulus() {
    let body = PowerProfile::paraboloid(50.0).expect("a paraboloid");
    let (line, depth) = (EquivalentLine(&body), 1e-4);
    let half_contact = (depth / 100.0_f64).sqrt();
    let slopes = 2.0 * 200.0_f64.powi(2) * half_contact.powi(3) / 3.0;
    for (n_branches, frequency) in [(1, 200.0), (3, 1.0), (3, 1e3)] {
        let material = rubber(n_branches);
        let stroke = 1e-3 * half_contact;
        let motion = reciprocating(stroke, frequency, Control::IndentationDepth(depth));
        let moved = move_along(&line, &material, &motion, Accuracy::Elements(256));
        let moved = moved.expect("a cycle");
        let loss = material
            .complex_modulus(2.0 * PI * frequency)
            .expect("a modulus")
            .loss;
        let expected = 4.0 * PI * loss * (0.5 * stroke).powi(2) * slopes;
        let got = moved.dissipated_energy.expect("of a cycle");
        assert!(
            (got.value - expected).abs() <= got.error + 5e-3 * expected
                && got.error < 0.03 * expected,
            "{n_branches} branches at {frequency} Hz: {got:?}, expected {expected}"
        );
    }
}

#[test]
fn from_fretting_to_sliding_friction_grows_with_the_stroke() {
    let ball = ball();
    let mut before = 0.0;
    for stroke in [1e-6, 1e-5, 1e-4, 1e-3, 1e-2] {
        let motion = reciprocating(stroke, 1.0, Control::NormalForce(FORCE));
        let moved = move_along(&EquivalentLine(&ball), &rubber(2), &motion, 1e-2);
        let friction = moved.expect("a cycle").friction_coefficient;
        assert!(
            friction.value > before + friction.error,
            "{stroke}: {friction:?} after {before}"
        );
        before = friction.value;
    }
}

#[test]
fn after_a_dwell_friction_begins_with_a_peak() {
    let (ball, control) = (ball(), Control::NormalForce(FORCE));
    let path = [[0.0, 0.0], [0.1, 0.01], [10.0, 0.01], [10.1, 0.02]];
    let (line, material) = (EquivalentLine(&ball), rubber(3));
    let moved = move_along(&line, &material, &through(&path, control), 1e-2);
    let moved = moved.map_err(|error| error.to_string()).expect("a motion");
    let straight = move_along(&line, &material, &through(&path[..2], control), 1e-2);
    let steady = force_at(&moved, 10.1).value.abs() / FORCE;
    let peak = moved.peak_friction;
    assert!(
        peak.value > 1.2 * steady + peak.error,
        "{peak:?} over {steady}"
    );
    let at_rest = force_at(&moved, 10.0);
    assert!(
        at_rest.value.abs() < 0.5 * steady * FORCE,
        "relaxed: {at_rest:?} of {steady}"
    );
    let first = straight.expect("a motion").points;
    let same = moved.points[0].normal_force == first[0].normal_force;
    assert!(same, "the beginning does not depend on the end");
}

#[test]
fn errors_of_coarse_foundations_hold_finer_values() {
    let ball = ball();
    let line = EquivalentLine(&ball);
    let cases = [
        (3, reciprocating(2e-3, 3.0, Control::NormalForce(FORCE))),
        (
            2,
            reciprocating(5e-5, 30.0, Control::IndentationDepth(5e-5)),
        ),
        (
            2,
            through(
                &[[0.0, 0.0], [0.1, 4e-3], [0.3, 1e-3], [0.5, 1e-3]],
                Control::NormalForce(FORCE),
            ),
        ),
    ];
    for (n_branches, motion) in cases {
        let on = |elements| {
            let request = Accuracy::Elements(elements);
            move_along(&line, &rubber(n_branches), &motion, request).expect("a motion")
        };
        let fine = on(192);
        for elements in [12, 24, 48] {
            let coarse = on(elements);
            let whole = [
                (
                    "friction",
                    coarse.friction_coefficient,
                    fine.friction_coefficient,
                ),
                ("peak", coarse.peak_friction, fine.peak_friction),
            ];
            for (name, coarse, fine) in whole {
                let error = (coarse.value - fine.value).abs();
                assert!(
                    error <= coarse.error + fine.error,
                    "{name}, {elements}: {coarse:?}, {fine:?}"
                );
            }
            let pairs = coarse.points.iter().zip(&fine.points);
            let misses = pairs.filter(|(coarse, fine)| {
                let (coarse, fine) = (coarse.tangential_force, fine.tangential_force);
                (coarse.value - fine.value).abs() > coarse.error + fine.error
            });
            // Single points, where elements come and go by chance as on the other resolutions.
            let (misses, all) = (misses.count(), coarse.points.len());
            assert!(
                20 * misses <= all,
                "{elements} elements: {misses} of {all} points"
            );
        }
    }
}

/// Under a force its mean over every step is the one that is given, and not the force at the ends of the steps: the friction
/// of round bodies has an error below the square of a step over the contact.
#[test]
fn few_elements_know_the_friction_under_a_force() {
    let ball = ball();
    let line = EquivalentLine(&ball);
    for (n_branches, length, frequency) in [(3, 1e-2, 2.0), (2, 3e-3, 10.0), (1, 5e-3, 100.0)] {
        let motion = reciprocating(length, frequency, Control::NormalForce(FORCE));
        let on = |elements| {
            let request = Accuracy::Elements(elements);
            let moved = move_along(&line, &rubber(n_branches), &motion, request);
            moved.expect("a cycle").friction_coefficient
        };
        let (coarse, fine) = (on(32), on(160));
        let error = (coarse.value - fine.value).abs();
        assert!(
            error < 0.25 * fine.value / 32_f64.powi(2) && error <= coarse.error,
            "{n_branches} branches: {coarse:?}, {fine:?}, {:e}",
            error / fine.value
        );
    }
}

/// On 16 elements this stroke would be shorter than one of them, and the resolutions alike but wrong.
#[test]
fn few_elements_do_not_know_short_strokes_by_chance() {
    let ball = Sphere::new(5.084_55e-3).expect("a sphere");
    let branch = RelaxationBranch::new;
    let branches = vec![branch(2.138e5, 0.555), branch(1.806e5, 7.3)];
    let spectrum = RelaxationSpectrum::new(2.240_388e6, 0.0, branches).expect("a spectrum");
    let rubber = Prony::new(spectrum).expect("a material");
    let load = reciprocating(
        9.439_636e-6,
        0.525_269,
        Control::IndentationDepth(3.027_064e-6),
    );
    let cycle = |error: f64| {
        let moved = move_along(&EquivalentLine(&ball), &rubber, &load, error).expect("a cycle");
        let energy = moved.dissipated_energy.expect("of a cycle");
        [moved.friction_coefficient, energy]
    };
    for (coarse, fine) in cycle(1e-2).iter().zip(cycle(1e-4)) {
        let error = (coarse.value - fine.value).abs();
        assert!(error <= coarse.error + fine.error, "{coarse:?}, {fine:?}");
    }
}

/// Where the tip of a cone is between two elements is chance, which half of an order of the errors allows for.
#[test]
fn bars_of_tips_hold() {
    let tip = PowerProfile::cone(0.226_829).expect("a cone");
    let blunt = PowerProfile::cone(0.055_699_1).expect("a cone");
    let branch = RelaxationBranch::new;
    let short = vec![
        branch(4.333_01e7, 3.452_99e-4),
        branch(2.702e7, 0.043_229_9),
        branch(118_155.0, 4.282_09e-3),
    ];
    let slow = vec![
        branch(5.457_03e6, 2.421_57),
        branch(543_618.0, 0.045_428_8),
        branch(538_614.0, 0.065_041_7),
    ];
    for (cone, branches, force, stroke) in [
        (
            tip,
            short,
            0.055_084_8,
            (1.079_05e-5, 119.198, Shape::Sinusoidal),
        ),
        (
            blunt,
            slow,
            0.015_041_5,
            (2.387_88e-4, 0.253_391, Shape::Triangular),
        ),
    ] {
        let spectrum = RelaxationSpectrum::new(1e6, 0.0, branches).expect("a spectrum");
        let rubber = Prony::new(spectrum).expect("a material");
        let (length, frequency, shape) = stroke;
        let stroke = Stroke {
            length,
            frequency,
            shape,
        };
        let load = MovingLoad::reciprocating(Control::NormalForce(force), stroke);
        let load = load.expect("a motion");
        let cycle = |error: f64| {
            let cycle = move_along(&EquivalentLine(&cone), &rubber, &load, error).expect("a cycle");
            [cycle.friction_coefficient, cycle.peak_friction]
        };
        for (coarse, fine) in cycle(1e-2).iter().zip(cycle(3e-4)) {
            let error = (coarse.value - fine.value).abs();
            assert!(error <= coarse.error + fine.error, "{coarse:?}, {fine:?}");
        }
    }
}

/// At the edge of a flat end the line is steeper than any number, and errors fall like the root of the elements.
#[test]
fn bars_of_flat_ends_hold() {
    let body = FlatCone::new(2e-4, 0.3).expect("a flat cone");
    let line = EquivalentLine(&body);
    for (control, length, frequency) in [
        (Control::IndentationDepth(1.6e-4), 3.7e-3, 0.35),
        (Control::NormalForce(2.3), 1.7e-3, 0.27),
    ] {
        let motion = reciprocating(length, frequency, control);
        let on = |elements| {
            let request = Accuracy::Elements(elements);
            let moved = move_along(&line, &rubber(3), &motion, request);
            moved.expect("a cycle").friction_coefficient
        };
        let fine = on(256);
        for elements in [16, 32, 64] {
            let coarse = on(elements);
            let error = (coarse.value - fine.value).abs();
            assert!(
                error <= coarse.error,
                "{control:?}, {elements} elements: {coarse:?}, {fine:?}"
            );
        }
    }
}

/// A date has few digits left for the steps.
#[test]
fn the_day_of_a_motion_changes_nothing_but_its_times() {
    let (line, rubber) = (EquivalentLine(&ball()), rubber(2));
    let moved = |begins: f64| {
        let points = [[begins, 0.0], [begins + 1.0, 3e-3]];
        let load = through(&points, Control::NormalForce(FORCE));
        move_along(&line, &rubber, &load, 1e-3).expect("a motion")
    };
    let (now, late) = (moved(0.0), moved(1e12));
    assert_eq!(now.friction_coefficient, late.friction_coefficient);
    for (now, late) in now.points.iter().zip(&late.points) {
        assert_eq!(now.tangential_force, late.tangential_force, "{now:?}");
        assert!((now.time + 1e12 - late.time).abs() < 1e-3, "{late:?}");
    }
}

#[test]
fn no_cycle_gives_energy_back() {
    let spring = RelaxationSpectrum::new(1e6, 0.0, Vec::new()).expect("a spectrum");
    let spring = Prony::new(spring).expect("a material");
    let load = reciprocating(1e-3, 1.0, Control::NormalForce(FORCE));
    let moved = move_along(&EquivalentLine(&ball()), &spring, &load, 1e-3).expect("a cycle");
    let energy = moved.dissipated_energy.expect("of a cycle");
    for known in [moved.friction_coefficient, energy] {
        assert!(known.value >= 0.0 && known.error > 0.0, "{known:?}");
    }
}

/// At a depth the normal force is no more exact than the friction.
#[test]
fn the_energy_of_a_cycle_at_a_depth_has_a_bar_of_its_own() {
    let branch = RelaxationBranch::new(1.940_449_157e9, 1.895_872_687e-3);
    let spectrum = RelaxationSpectrum::new(1e6, 0.0, vec![branch]).expect("a spectrum");
    let rubber = Prony::new(spectrum).expect("a material");
    let body = PowerProfile::paraboloid(100.0).expect("a paraboloid");
    let stroke = Stroke {
        length: 2.012_825_626e-5,
        frequency: 6.391_659_781,
        shape: Shape::Triangular,
    };
    let load = MovingLoad::reciprocating(Control::IndentationDepth(1e-4), stroke);
    let load = load.expect("a motion");
    let energy = |error: f64| {
        let moved = move_along(&EquivalentLine(&body), &rubber, &load, error).expect("a cycle");
        moved.dissipated_energy.expect("of a cycle")
    };
    let (coarse, fine) = (energy(1e-3), energy(1e-3 / 16.0));
    let apart = (coarse.value - fine.value).abs();
    assert!(apart <= coarse.error + fine.error, "{coarse:?}, {fine:?}");
}

/// A material of two branches; one relaxes over the given number of cycles.
fn slow_material(period: f64, cycles: f64) -> Prony {
    let slow = RelaxationBranch::new(3e6, cycles * period);
    let branches = vec![RelaxationBranch::new(5e6, 0.1 * period), slow];
    let spectrum = RelaxationSpectrum::new(1e6, 0.0, branches).expect("a spectrum");
    Prony::new(spectrum).expect("a material")
}

/// The limit cycle that is solved for is the one that a motion through the points of all cycles approaches.
#[test]
fn slow_relaxation_reaches_the_limit_of_its_cycles() {
    const PERIOD: f64 = 0.02;
    const CYCLES: u32 = 350;
    let (ball, control) = (ball(), Control::NormalForce(FORCE));
    let rubber = slow_material(PERIOD, 10.0);
    // The retardation time is four times the relaxation time.
    let left = (-f64::from(CYCLES) / 40.0).exp();
    for length in [5e-5, 3e-3] {
        let line = EquivalentLine(&ball);
        let stroke = Stroke {
            length,
            frequency: PERIOD.recip(),
            shape: Shape::Triangular,
        };
        let stroke = MovingLoad::reciprocating(control, stroke).expect("a motion");
        let cycle = move_along(&line, &rubber, &stroke, 1e-3).expect("a cycle");
        let turns = (0..=2 * CYCLES).map(|turn| {
            let place = if turn % 2 == 0 { -0.5 } else { 0.5 };
            [0.5 * PERIOD * f64::from(turn), place * length]
        });
        let path = through(&turns.collect::<Vec<_>>(), control);
        let path = move_along(&line, &rubber, &path, Accuracy::Elements(48)).expect("a motion");
        let ends = [cycle.points.last(), path.points.last()];
        let [found, followed] = ends.map(|end| end.expect("a point").indentation_depth);
        let apart = (found.value - followed.value).abs();
        assert!(
            apart <= found.error + followed.error + left * found.value,
            "stroke {length}: {found:?} and {followed:?}"
        );
    }
}

/// Where a mode hardly recovers in a cycle, only the mean load matters, and not the retardation time.
#[test]
fn relaxation_over_very_many_cycles_has_a_limit() {
    const PERIOD: f64 = 0.02;
    let ball = ball();
    for length in [5e-5, 3e-3] {
        let stroke = reciprocating(length, PERIOD.recip(), Control::NormalForce(FORCE));
        let friction = |cycles: f64| {
            let rubber = slow_material(PERIOD, cycles);
            let moved = move_along(&EquivalentLine(&ball), &rubber, &stroke, 1e-3);
            moved.expect("a cycle").friction_coefficient
        };
        let limit = friction(1e12);
        for cycles in [1e5, 1e8, 1e15] {
            let found = friction(cycles);
            let apart = (found.value - limit.value).abs();
            assert!(
                apart <= found.error + limit.error + 10.0 / cycles * limit.value,
                "stroke {length}, {cycles:e} cycles: {found:?} and {limit:?}"
            );
        }
    }
}

#[test]
fn what_cannot_move_so_is_refused() {
    let (ball, control) = (ball(), Control::NormalForce(FORCE));
    let line = EquivalentLine(&ball);
    let fluid = Maxwell::new(1e6, 1e5).expect("a fluid");
    let refused = move_along(&line, &fluid, &reciprocating(1e-3, 1.0, control), 1e-2);
    assert_eq!(refused, Err(MdrError::NoCycle), "a fluid to and fro");
    let path = through(&[[0.0, 0.0], [0.1, 1e-3], [0.2, 0.0]], control);
    assert!(
        move_along(&line, &fluid, &path, 1e-2).is_ok(),
        "a fluid once"
    );
    let far = move_along(&line, &rubber(1), &reciprocating(1e4, 1.0, control), 1e-2);
    assert!(
        matches!(
            far,
            Err(MdrError::Indenter(IndenterError::TooManySteps { .. }))
        ),
        "{far:?}"
    );
    let deep = move_along(
        &line,
        &rubber(1),
        &reciprocating(1e-3, 1.0, Control::NormalForce(1e4)),
        1e-2,
    );
    assert!(deep.is_err(), "beyond the equator: {deep:?}");
    let height = line.height(1e-3);
    assert!(height > 0.0, "a line that rises: {height}");
}
