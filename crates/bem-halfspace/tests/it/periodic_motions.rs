//! Motions of periodic surfaces: cycles in full contact are the linear answer, and others agree with what else is known.

use std::f64::consts::{PI, TAU};

use bem_halfspace::numerics::Accuracy;
use bem_halfspace::{BemError, Control, Layer, PeriodicLoad, layer_factor, periodic};
use indenters::rough::{PeriodicSurface, Wave};
use indenters::{MovingLoad, MovingPoint, Shape, Stroke};
use rheology::{Compressible, Material, Prony};
use rustfft::num_complex::Complex;

use crate::support::{assert_bars_agree, assert_close, assert_refused, prony};

const PERIOD: [f64; 2] = [2.0, 1.0];

fn surface(waves: &[([i32; 2], f64)]) -> PeriodicSurface {
    let wave = |&(numbers, amplitude): &([i32; 2], f64)| Wave {
        numbers,
        amplitude,
        phase: 0.7 * f64::from(numbers[0]) + 0.3,
    };
    PeriodicSurface::new(PERIOD, waves.iter().map(wave).collect()).expect("a surface")
}

fn rough() -> PeriodicSurface {
    surface(&[
        ([1, 0], 0.01),
        ([1, 1], 0.012),
        ([3, -2], 0.005),
        ([4, 1], 0.004),
        ([0, 2], 0.008),
    ])
}

fn rubber() -> Prony {
    prony([1.0, 0.0], &[(9.0, 0.3), (30.0, 0.02)])
}

fn cycle(mean_pressure: f64, stroke: Stroke) -> MovingLoad {
    let force = Control::NormalForce(mean_pressure * PERIOD[0] * PERIOD[1]);
    MovingLoad::reciprocating(force, stroke).expect("a motion")
}

/// |c_n|² of e^(−i q x(t)), for x of a stroke s: J_n(q s/2)² of a cosine (Jacobi and Anger), and that of a triangle by hand.
fn harmonic(shape: Shape, q: f64, length: f64, order: i32) -> f64 {
    match shape {
        Shape::Sinusoidal => libm::jn(order, 0.5 * q * length).powi(2),
        Shape::Triangular => {
            let turn = |sign: f64| {
                let angle = q * length / PI + sign * f64::from(order);
                (Complex::from_polar(1.0, -PI * angle) - 1.0) / (Complex::i() * (-TAU * angle))
            };
            (turn(1.0) + turn(-1.0)).norm_sqr()
        }
    }
}

/// The energy of a cycle in full contact: Σ_q |q| |ĥ|² Σ_n T n ω G''(n ω) |c_n|²/((1 − ν) M) times the area.
fn linear_energy(
    surface: &PeriodicSurface,
    material: &impl Material,
    thickness: f64,
    stroke: Stroke,
) -> f64 {
    let nu = material.poisson_ratio();
    let of_wave = |wave: &Wave| {
        let [q_x, q_y] = surface.wave_vector(wave);
        let q = q_x.hypot(q_y);
        let orders = match stroke.shape {
            Shape::Sinusoidal => 300,
            Shape::Triangular => 30_000,
        };
        let of_order = |order: i32| {
            let omega = TAU * stroke.frequency * f64::from(order);
            let loss = material.complex_modulus(omega).expect("a modulus").loss;
            TAU * f64::from(order) * loss * harmonic(stroke.shape, q_x, stroke.length, order)
        };
        // Orders of both signs, and both waves of a cosine, each of half the amplitude.
        let harmonics = 2.0 * (1..orders).map(of_order).sum::<f64>();
        let stiffness = q / layer_factor(q * thickness, nu) / (1.0 - nu);
        0.5 * wave.amplitude.powi(2) * stiffness * harmonics
    };
    PERIOD[0] * PERIOD[1] * surface.waves().iter().map(of_wave).sum::<f64>()
}

#[test]
fn a_cycle_in_full_contact_is_the_linear_answer() {
    let surface = rough();
    for (length, frequency) in [(1e-3, 1.0), (0.4, 0.5), (0.4, 500.0), (7.3, 0.5)] {
        for (shape, thickness, nu) in [
            (Shape::Sinusoidal, f64::INFINITY, 0.5),
            (Shape::Sinusoidal, 0.2, 0.4),
            (Shape::Triangular, f64::INFINITY, 0.3),
        ] {
            let solid = Compressible::new(&rubber(), nu).expect("a solid");
            let layer = Layer::new(&solid, thickness).expect("a thickness");
            let stroke = Stroke {
                length,
                frequency,
                shape,
            };
            let load = cycle(30.0, stroke);
            let found = periodic::move_along(&surface, &layer, &load, 1e-3).expect("a cycle");
            let energy = found.dissipated_energy.expect("energy");
            let expected = linear_energy(&surface, &solid, thickness, stroke);
            let what = (stroke, thickness);
            assert_close(what, energy.value, expected, 1e-10);
            // Of forces times slopes that nearly cancel.
            let rounding =
                2e-12 * surface.rms_slope() * 30.0 * PERIOD[0] * PERIOD[1] * 2.0 * length;
            let allowed = 1e-11 * expected + rounding;
            assert!(energy.error <= allowed, "{what:?}: {energy:?}");
            assert_eq!(found.n_cycles, 0, "{what:?}");
        }
    }
}

/// Contacts of a few per cent to nearly all of the area, from strokes below a contact to some periods.
#[test]
fn bars_of_coarse_grids_hold_finer_cycles() {
    let surface = rough();
    for (mean_pressure, length, shape) in [
        (0.1, 0.02, Shape::Sinusoidal),
        (0.1, 0.5, Shape::Triangular),
        (0.3, 0.5, Shape::Sinusoidal),
        (0.8, 2.5, Shape::Sinusoidal),
    ] {
        let stroke = Stroke {
            length,
            frequency: 0.5,
            shape,
        };
        let load = cycle(mean_pressure, stroke);
        let on = |elements| {
            let accuracy = Accuracy::Elements(elements);
            periodic::move_along(&surface, &rubber(), &load, accuracy).expect("a cycle")
        };
        let [coarse, fine] = [32, 48].map(on);
        let what = (mean_pressure, stroke);
        assert_bars_agree(what, coarse.friction_coefficient, fine.friction_coefficient);
        assert_bars_agree(what, coarse.peak_friction, fine.peak_friction);
        for (one, other) in coarse.points.iter().zip(&fine.points) {
            assert_bars_agree(what, one.tangential_force, other.tangential_force);
            assert_bars_agree(what, one.indentation_depth, other.indentation_depth);
        }
        let bar = fine.friction_coefficient;
        assert!(bar.error < 0.07 * bar.value, "{what:?}: {bar:?}");
    }
}

/// The material forgets within a hundredth of the stroke, whose middle is passed with a constant speed.
#[test]
fn the_middle_of_a_long_stroke_is_steady_sliding() {
    let (surface, rubber) = (rough(), prony([1.0, 0.0], &[(9.0, 0.05)]));
    let (mean_pressure, length, frequency) = (0.3, 2.0, 0.25);
    let stroke = Stroke {
        length,
        frequency,
        shape: Shape::Triangular,
    };
    let load = cycle(mean_pressure, stroke);
    let moved = periodic::move_along(&surface, &rubber, &load, Accuracy::Elements(48));
    let points = moved.expect("a cycle").points;
    let velocity = 2.0 * length * frequency;
    let load = PeriodicLoad::new(mean_pressure, velocity).expect("a load");
    let steady = periodic::steady(&surface, &rubber, &load, 1e-2).expect("a stationary state");
    let force = mean_pressure * PERIOD[0] * PERIOD[1];
    let expected = steady.friction_coefficient * force;
    // Both directions; the surface is not its own mirror image, but here its friction nearly is.
    let forth = points[points.len() / 4];
    assert!((forth.position).abs() < 0.05, "{forth:?}");
    assert_bars_agree("forth", forth.tangential_force, expected);
    assert!(
        forth.tangential_force.error < 0.1 * expected.value,
        "{forth:?}"
    );
}

/// A path from rest with one speed is the march from rest, whose elements go with the surface.
#[test]
fn a_straight_path_is_sliding_from_rest() {
    let (surface, rubber) = (rough(), rubber());
    let (mean_pressure, velocity, distance) = (0.3, 0.5, 0.4);
    let force = Control::NormalForce(mean_pressure * PERIOD[0] * PERIOD[1]);
    let point = |time: f64| MovingPoint {
        time,
        position: 5.0 + velocity * time,
        control: force,
    };
    let path =
        MovingLoad::through_points(&[3.0, 3.0 + distance / velocity].map(point)).expect("a path");
    let moved = periodic::move_along(&surface, &rubber, &path, Accuracy::Elements(64));
    let points = moved.expect("a motion").points;
    let last = points[points.len() - 1];
    let load = PeriodicLoad::new(mean_pressure, velocity).and_then(|load| load.after(distance));
    let slid = periodic::slide(&surface, &rubber, &load.expect("a load"), 0.1).expect("a march");
    let expected = slid.friction_coefficient * force.value();
    assert_bars_agree("force", last.tangential_force, expected);
    assert_bars_agree("depth", last.indentation_depth, slid.mean_depth);
    assert!(
        last.tangential_force.error < 0.1 * expected.value,
        "{last:?}, {expected:?}"
    );
}

/// A fluid sinks into full contact of crests along the motion, but not within the time of a path; without a load there is
/// no friction.
#[test]
fn paths_are_followed_on_fluids_and_lifted() {
    let fluid = prony([0.0, 1.0], &[(3.0, 0.5)]);
    let point = |(time, position, pressure): (f64, f64, f64)| MovingPoint {
        time,
        position,
        control: Control::NormalForce(pressure * PERIOD[0] * PERIOD[1]),
    };
    let points = [
        (0.0, 0.0, 0.2),
        (0.5, 0.2, 0.2),
        (0.8, 0.2, 0.0),
        (1.0, 0.0, 0.1),
    ];
    let path = MovingLoad::through_points(&points.map(point)).expect("a path");
    let moved = periodic::move_along(&rough(), &fluid, &path, Accuracy::Elements(32));
    let moved = moved.expect("a motion");
    let lifted = moved
        .points
        .iter()
        .filter(|point| point.normal_force.value == 0.0);
    for point in lifted {
        let force = point.tangential_force;
        assert!(force.value.abs() <= force.error + 1e-12, "{point:?}");
    }
    assert!(moved.peak_friction.value > 0.0, "{:?}", moved.peak_friction);
    let stroke = Stroke {
        length: 0.1,
        frequency: 1.0,
        shape: Shape::Sinusoidal,
    };
    let refused = periodic::move_along(&rough(), &fluid, &cycle(0.3, stroke), 0.1);
    assert_eq!(refused, Err(BemError::NoCycle), "a fluid");
}

#[test]
fn unsupported_motions_of_waves_are_refused() {
    let stroke = |length| Stroke {
        length,
        frequency: 1.0,
        shape: Shape::Sinusoidal,
    };
    let depth = Control::IndentationDepth(0.01);
    let at_depth = MovingLoad::reciprocating(depth, stroke(1.0)).expect("a motion");
    let long = cycle(0.1, stroke(1e4));
    let coarse = Accuracy::Elements(16);
    for (what, refused, name) in [
        (
            "a depth",
            periodic::move_along(&rough(), &rubber(), &at_depth, 0.1),
            "DepthFromRest",
        ),
        (
            "a long stroke",
            periodic::move_along(&rough(), &rubber(), &long, 0.1),
            "Indenter(TooManySteps",
        ),
        (
            "few elements",
            periodic::move_along(&rough(), &rubber(), &cycle(0.1, stroke(1.0)), coarse),
            "PeriodTooCoarse",
        ),
    ] {
        assert_refused(what, refused, name);
    }
}
