//! Numbers depend on the question, not on its units, and are the same every time.

use indenters::{EquivalentLine, PowerProfile};
use mdr_core::{SlideOptions, Transient, slide_on_grid, steady};

use crate::support::{ASKED, indent, load, material, prony};

/// One unit of length, force and time, in units of SI.
type Units = [f64; 3];

const SCALES: [f64; 9] = [-12.0, -9.0, -6.0, -3.0, 0.0, 3.0, 6.0, 9.0, 12.0];

fn scaled(exponents: [f64; 3]) -> Units {
    exponents.map(|exponent| 10.0_f64.powf(exponent))
}

fn march(exponent: f64, [length, force, time]: Units) -> Transient {
    let coefficient = 0.4 * length.powf(1.0 - exponent);
    let body = PowerProfile::new(coefficient, exponent).expect("a power profile");
    let material = material(50.0 * force * time / (length * length));
    let load = load(2.0 * force, 0.1 * length / time);
    let options = SlideOptions {
        drift_tolerance: 1e-13,
        ..SlideOptions::with_elements(24, &EquivalentLine(&body), &material, &load)
            .expect("a contact")
    };
    slide_on_grid(&EquivalentLine(&body), &material, &load, &options).expect("a stationary state")
}

fn assert_same(transient: &Transient, reference: &Transient, units: Units) {
    let [length, _, time] = units;
    // The drift decides on the last row within rounding; all rows that both have are compared. So does the count of
    // elements, where one is touched and not compressed.
    for (row, expected) in transient.rows.iter().zip(&reference.rows) {
        for (name, actual, expected) in [
            (
                "friction",
                row.friction_coefficient,
                expected.friction_coefficient,
            ),
            (
                "depth",
                row.indentation_depth / length,
                expected.indentation_depth,
            ),
            ("time", row.time / time, expected.time),
            (
                "distance",
                row.sliding_distance / length,
                expected.sliding_distance,
            ),
        ] {
            assert!(
                (actual / expected - 1.0).abs() < 1e-12,
                "{name} {actual} instead of {expected} at {expected}, units {units:?}"
            );
        }
    }
    let (last, expected) = (transient.last, reference.last);
    let change = last.friction_coefficient / expected.friction_coefficient - 1.0;
    assert!(
        change.abs() < 1e-12,
        "stationary friction off by {change}, units {units:?}"
    );
}

/// The exponents mix the three units, so that none can hide behind another.
#[test]
fn results_are_the_same_over_twenty_four_decades() {
    for exponent in [0.75, 1.0, 2.0] {
        let reference = march(exponent, [1.0; 3]);
        for scale in SCALES {
            for mixed in [
                [scale, 0.0, 0.0],
                [0.0, scale, 0.0],
                [0.0, 0.0, scale],
                [scale, -scale, scale],
            ] {
                let units = scaled(mixed);
                assert_same(&march(exponent, units), &reference, units);
            }
        }
    }
}

/// Casebook EXT-06: the paraboloid in three systems of units, 64 elements, 1/(4 n²) below the integral.
#[test]
fn casebook_units_give_one_friction_coefficient() {
    let frictions: Vec<f64> = casebook::group("EXT-06")
        .iter()
        .map(|case| {
            let body = PowerProfile::paraboloid(case.input("c")).expect("a paraboloid");
            let material = material(case.input("eta"));
            let load = load(case.input("F"), case.input("v"));
            let options = SlideOptions {
                drift_tolerance: 1e-12,
                ..SlideOptions::with_elements(64, &EquivalentLine(&body), &material, &load)
                    .expect("a contact")
            };
            let row = slide_on_grid(&EquivalentLine(&body), &material, &load, &options)
                .expect("a stationary state")
                .last;
            case.check("d", row.indentation_depth);
            case.check_within(
                "mu",
                row.friction_coefficient / (1.0 - 0.25 / 4096.0),
                1e-11,
            );
            row.friction_coefficient
        })
        .collect();
    for friction in &frictions {
        assert!(
            (friction / frictions[0] - 1.0).abs() < 1e-12,
            "{friction} instead of {}",
            frictions[0]
        );
    }
}

#[test]
fn the_same_question_has_the_same_answer_to_the_last_bit() {
    let [first, second] = [march(1.5, [1.0; 3]), march(1.5, [1.0; 3])];
    assert_eq!(first, second, "two runs of one question");
}

#[test]
fn indentation_is_the_same_over_twenty_four_decades() {
    let depth = |[length, force, time]: Units| {
        let body = PowerProfile::paraboloid(0.4 / length).expect("a paraboloid");
        let material = material(50.0 * force * time / (length * length));
        let spacing = 0.01 * length;
        let times = [1.0 * time, 3.0 * time];
        let line = EquivalentLine(&body);
        let rows = indent(&line, &material, 2.0 * force, &times, spacing).expect("a contact");
        rows[1].indentation_depth / length
    };
    let expected = depth([1.0; 3]);
    for scale in SCALES {
        let actual = depth(scaled([scale, -scale, 0.5 * scale]));
        assert!(
            (actual / expected - 1.0).abs() < 1e-12,
            "{actual} instead of {expected}, scale {scale}"
        );
    }
}

/// A solid with a dashpot of its own, at a speed at which everything relaxes.
#[test]
fn the_stationary_state_is_the_same_over_twenty_four_decades() {
    let state = |[length, force, time]: Units| {
        let modulus = force / (length * length);
        let branches = [(2.0 * modulus, 0.3 * time), (5.0 * modulus, 10.0 * time)];
        let material = prony([modulus, 0.1 * modulus * time], &branches);
        let body = PowerProfile::new(0.4 * length.powf(-0.5), 1.5).expect("a power profile");
        let line = EquivalentLine(&body);
        let load = load(2.0 * force, 0.7 * length / time);
        let state = steady(&line, &material, &load, ASKED).expect("a state");
        [
            state.friction_coefficient.value,
            state.indentation_depth.value / length,
            state.contacts[0][0] / length,
        ]
    };
    let expected = state([1.0; 3]);
    for scale in SCALES {
        for mixed in [
            [scale, 0.0, 0.0],
            [0.0, scale, 0.0],
            [0.0, 0.0, scale],
            [scale, -scale, scale],
        ] {
            for (actual, expected) in state(scaled(mixed)).iter().zip(expected) {
                // The pieces of the line depend on where the range was found, the error asked for is 1e-8.
                assert!(
                    (actual / expected - 1.0).abs() < 1e-10,
                    "{actual} instead of {expected}, units {mixed:?}"
                );
            }
        }
    }
}
