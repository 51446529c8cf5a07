//! Numbers depend on the question, not on its units, also near the smallest and largest ones, where squares of depths are
//! no numbers any more.

use indenters::{EquivalentLine, PowerProfile};
use mdr_core::Sliding;

use crate::support::{assert_close, last, load, march, material, prony, slid};

/// One unit of length, force and time, in units of SI.
type Units = [f64; 3];

/// The exponents mix the three units, so that none can hide behind another.
fn all_units() -> impl Iterator<Item = Units> {
    let decades = (-12..=12).step_by(3).map(f64::from);
    decades.flat_map(|scale| {
        [
            [scale, 0.0, 0.0],
            [0.0, scale, 0.0],
            [0.0, 0.0, scale],
            [scale, -scale, scale],
        ]
        .map(|exponents| exponents.map(|exponent| 10.0_f64.powf(exponent)))
    })
}

fn marched(exponent: f64, [length, force, time]: Units) -> Sliding {
    let coefficient = 0.4 * length.powf(1.0 - exponent);
    let body = PowerProfile::new(coefficient, exponent).expect("a power profile");
    let dashpot = material(50.0 * force * time / (length * length));
    let load = load(2.0 * force, 0.1 * length / time);
    march(&EquivalentLine(&body), &dashpot, &load, 24)
}

#[test]
fn marches_are_the_same_over_twenty_four_decades() {
    for exponent in [0.75, 1.0, 2.0] {
        let reference = marched(exponent, [1.0; 3]);
        for units in all_units() {
            let [length, _, time] = units;
            let transient = marched(exponent, units);
            let frictions =
                [&transient, &reference].map(|sliding| last(sliding).friction_coefficient);
            // The drift decides on the last step within rounding; all steps that both have are compared. So does the count of
            // elements, where one is touched and not compressed.
            assert_close(frictions, 1e-9, 0.0, &units);
            for (row, expected) in transient.steps.iter().zip(&reference.steps) {
                for pair in [
                    [row.friction_coefficient, expected.friction_coefficient],
                    [row.indentation_depth / length, expected.indentation_depth],
                    [row.time / time, expected.time],
                    [row.sliding_distance / length, expected.sliding_distance],
                ] {
                    assert_close(pair, 1e-12, 0.0, &units);
                }
            }
        }
    }
}

/// (22) with a curvature, a viscosity and a speed of one: d = F/4, μ = 4/3 √(2 d).
#[test]
fn extreme_forces_keep_their_digits() {
    let profile = PowerProfile::paraboloid(1.0).expect("a profile");
    let (line, dashpot) = (EquivalentLine(&profile), material(1.0));
    for force in [
        1e-300, 1e-200, 1e-150, 1e-100, 1e100, 1e150, 1e200, 1e300_f64,
    ] {
        let depth = 0.25 * force;
        let friction = 4.0 / 3.0 * (2.0 * depth).sqrt();
        let state = slid(&line, &dashpot, &load(force, 1.0));
        let row = last(&march(&line, &dashpot, &load(force, 1.0), 50));
        // A march is of second order in the spacing.
        for (actual, expected, tolerance) in [
            (state.indentation_depth.value, depth, 1e-8),
            (state.friction_coefficient.value, friction, 1e-8),
            (row.indentation_depth, depth, 50.0_f64.powi(-2)),
            (row.friction_coefficient, friction, 50.0_f64.powi(-2)),
        ] {
            assert_close([actual, expected], tolerance, 0.0, &force);
        }
    }
}

/// Moduli as well: the paraboloid on a Maxwell foundation whose distance of relaxation is the same part of its front.
#[test]
fn stiff_and_soft_materials_keep_their_digits() {
    let profile = PowerProfile::paraboloid(1.0).expect("a profile");
    let friction = |unit: f64| {
        let maxwell = prony([0.0; 2], &[(unit, 1.0)]);
        let state = slid(&EquivalentLine(&profile), &maxwell, &load(unit, 1.0));
        state.friction_coefficient.value
    };
    for unit in [1e-300, 1e-200, 1e200, 1e300] {
        assert_close([friction(unit), friction(1.0)], 1e-12, 0.0, &unit);
    }
}
