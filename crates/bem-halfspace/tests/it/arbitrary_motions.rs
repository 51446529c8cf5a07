//! An indenter may move by any amount in a step, stop, go back and be lifted.

use bem_halfspace::slide::{March, Motion, MotionRow, follow, slide_on_grid};
use bem_halfspace::{BemError, Control, Footprint, GridOptions};
use indenters::{PowerProfile, SlidingLoad, Surface};

use crate::support::{TIGHT, every_kind_of_material, prony};

const FORCE: f64 = 0.5;

fn options(spacing: f64, half_width: f64) -> GridOptions {
    GridOptions::new([spacing; 2], Footprint::square(half_width))
}

fn tight(spacing: f64, half_width: f64) -> GridOptions {
    GridOptions {
        contact: TIGHT,
        ..options(spacing, half_width)
    }
}

fn body() -> PowerProfile {
    PowerProfile::paraboloid(0.5).expect("a body")
}

/// Motions through (time, position) under a constant force.
fn under_force(path: impl Iterator<Item = (f64, f64)>) -> Vec<Motion> {
    let motion = |(time, position)| Motion {
        time,
        position,
        control: Control::NormalForce(FORCE),
    };
    path.map(motion).collect()
}

#[test]
fn slide_moves_by_whole_elements() {
    let (spacing, velocity) = (0.1, 0.7);
    let load = SlidingLoad::new(FORCE, velocity).and_then(|load| load.after(2.0));
    let load = load.expect("a load");
    for (name, material) in every_kind_of_material() {
        let tight = tight(spacing, 1.6);
        let slid = slide_on_grid(&body(), &*material, &load, &tight).expect("a transient");
        let path = (1..=20).map(|k| spacing * f64::from(k));
        let motions = under_force(path.map(|x| (x / velocity, x)));
        let rows = follow(&body(), &*material, &motions, &tight).expect("rows");
        for (row, expected) in rows.iter().zip(&slid.rows) {
            let friction = row.tangential_force / row.normal_force;
            assert!(
                (friction - expected.friction_coefficient).abs() < 1e-10
                    && (row.indentation_depth / expected.indentation_depth - 1.0).abs() < 1e-10,
                "{name}: {row:?} instead of {expected:?}"
            );
        }
    }
}

/// Friction and depth after a distance by steps of a part of an element.
fn by_parts(part: f64, elements: f64) -> [f64; 2] {
    let material = prony([0.1, 0.0], &[(2.0, 0.5)]);
    let spacing = 1.0 / elements;
    let n_steps = (2.0 * elements / part).round();
    let x = |k: f64| 2.0 * k / n_steps;
    #[expect(clippy::cast_possible_truncation, reason = "some hundreds")]
    let path = (1..=n_steps as i32).map(|k| (x(f64::from(k)) / 0.7, x(f64::from(k))));
    let motions = under_force(path);
    let rows = follow(&body(), &material, &motions, &options(spacing, 1.6)).expect("rows");
    // The outline follows the elements, which the friction feels: mean over the last two elements.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "some tens"
    )]
    let last = &rows[rows.len() - (2.0 / part).round() as usize..];
    let mean =
        |value: fn(&MotionRow) -> f64| last.iter().map(value).sum::<f64>() / last.len() as f64;
    [
        mean(|row| row.tangential_force / row.normal_force),
        mean(|row| row.indentation_depth),
    ]
}

/// Steps of half, a third or a quarter of an element, and of two: the same friction to first order in their length.
#[test]
fn friction_does_not_depend_on_the_parts_of_an_element_that_a_step_is() {
    let reference = by_parts(0.25, 16.0);
    for part in [0.5, 1.0 / 3.0, 1.0, 2.0] {
        let actual = by_parts(part, 16.0);
        for (name, actual, expected) in [
            ("friction", actual[0], reference[0]),
            ("depth", actual[1], reference[1]),
        ] {
            // One step of an element is 1/20 of the contact, of which the error is a part.
            assert!(
                (actual / expected - 1.0).abs() < 0.02 * part.max(0.5),
                "{part} elements per step: {name} {actual} instead of {expected}"
            );
        }
    }
}

/// There and back: a mirrored body that moves the other path has the opposite force.
#[test]
fn motion_to_the_other_side_is_the_mirror_image() {
    let material = prony([0.1, 0.0], &[(2.0, 0.5)]);
    let path = |sign: f64| {
        let there = (1..=30).map(|k| 0.03 * f64::from(k));
        let back = (1..=15).map(|k| 0.9 - 0.05 * f64::from(k));
        let all = there.chain(std::iter::repeat_n(0.9, 5)).chain(back);
        let timed = all
            .enumerate()
            .map(move |(k, x)| (0.05 * (k + 1) as f64, sign * x));
        under_force(timed)
    };
    let tight = tight(0.1, 1.6);
    let [right, left] =
        [1.0, -1.0].map(|sign| follow(&body(), &material, &path(sign), &tight).expect("rows"));
    for (right, left) in right.iter().zip(&left) {
        assert!(
            (right.tangential_force + left.tangential_force).abs() < 1e-9 * FORCE
                && (right.indentation_depth / left.indentation_depth - 1.0).abs() < 1e-9,
            "{right:?} and {left:?}"
        );
    }
    // The dent in front resists, and after the turn the one that was behind.
    assert!(
        right[29].tangential_force > 0.0 && right[49].tangential_force < 0.0,
        "{:?} before and {:?} after the turn",
        right[29],
        right[49]
    );
}

/// Room around the path of the contact changes nothing: nothing is lost behind, and what enters ahead has been moved by
/// all past pressure.
#[test]
fn the_footprint_does_not_matter() {
    let material = prony([0.1, 0.3], &[(2.0, 0.5)]);
    let path = (1..=24).map(|k| {
        let time = 0.1 * f64::from(k);
        (time, (1.3 * time).sin())
    });
    let motions = under_force(path);
    let run = |half_width: f64| {
        let tight = tight(0.1, half_width);
        follow(&body(), &material, &motions, &tight).expect("rows")
    };
    for (small, large) in run(1.3).iter().zip(&run(3.1)) {
        assert!(
            (small.tangential_force - large.tangential_force).abs() < 1e-9 * FORCE
                && (small.indentation_depth / large.indentation_depth - 1.0).abs() < 1e-9
                && small.n_contact == large.n_contact,
            "{small:?} and {large:?}"
        );
    }
}

/// Waiting at a place is pressing: the depth is that of a body that never moved, if it was lifted meanwhile.
#[test]
fn a_body_pressed_elsewhere_meets_a_fresh_surface() {
    let material = prony([0.4, 0.0], &[(2.0, 0.5)]);
    let motion = |time: f64, position: f64, control| Motion {
        time,
        position,
        control,
    };
    let far = 40.0;
    let motions = [
        motion(1.0, 0.0, Control::NormalForce(FORCE)),
        motion(1.5, far, Control::IndentationDepth(-1.0)),
        motion(2.5, far, Control::NormalForce(FORCE)),
    ];
    let tight = tight(0.1, 1.6);
    let rows = follow(&body(), &material, &motions, &tight).expect("rows");
    assert_eq!(rows[1].contact_x, None, "lifted");
    // The old dent, which recovers, is felt like a point force at that distance.
    let dent = FORCE / (4.0 * std::f64::consts::PI * 0.4 * far);
    let difference = rows[2].indentation_depth - rows[0].indentation_depth;
    assert!(
        difference > 0.0 && difference < dent,
        "depth {} after {}, the dent reaches {dent}",
        rows[2].indentation_depth,
        rows[0].indentation_depth
    );
}

/// A given depth, reached by force control before, needs that force.
#[test]
fn force_and_depth_control_agree() {
    let material = prony([0.1, 0.0], &[(2.0, 0.5)]);
    let motions = under_force((1..=12).map(|k| (0.1 * f64::from(k), 0.13 * f64::from(k))));
    let tight = tight(0.15, 1.6);
    let pressed = follow(&body(), &material, &motions, &tight).expect("rows");
    let held: Vec<Motion> = motions
        .iter()
        .zip(&pressed)
        .map(|(motion, row)| Motion {
            control: Control::IndentationDepth(row.indentation_depth),
            ..*motion
        })
        .collect();
    let held = follow(&body(), &material, &held, &tight).expect("rows");
    for (pressed, held) in pressed.iter().zip(&held) {
        assert!(
            (held.normal_force / FORCE - 1.0).abs() < 1e-8
                && (held.tangential_force - pressed.tangential_force).abs() < 1e-8 * FORCE,
            "{held:?} instead of {pressed:?}"
        );
    }
}

#[test]
fn motions_out_of_range_are_refused() {
    let material = prony([0.1, 0.0], &[(2.0, 0.5)]);
    let good = under_force([(0.1, 0.1), (0.2, 0.2)].into_iter());
    let refused = |motions: &[Motion]| {
        let result = March::new(&body(), &material, motions, &options(0.1, 1.6)).map(|_| ());
        assert!(
            matches!(result, Err(BemError::InvalidParameter { .. })),
            "{motions:?}: {result:?}"
        );
    };
    refused(&[]);
    refused(&[good[1], good[0]]);
    refused(&[good[0], good[0]]);
    for value in [f64::NAN, f64::INFINITY] {
        refused(&[Motion {
            time: value,
            ..good[0]
        }]);
        refused(&[Motion {
            position: value,
            ..good[0]
        }]);
        for control in [Control::NormalForce, Control::IndentationDepth] {
            refused(&[Motion {
                control: control(value),
                ..good[0]
            }]);
        }
    }
    refused(&[Motion {
        control: Control::NormalForce(-1.0),
        ..good[0]
    }]);
    let body = body();
    let far = March::new(
        &body,
        &material,
        &[
            good[0],
            Motion {
                position: 1e12,
                ..good[1]
            },
        ],
        &options(0.1, 1.6),
    );
    assert!(
        matches!(far, Err(BemError::GridTooLarge { .. })),
        "a path too long"
    );
}

/// Nothing below the footprint.
struct Nowhere;

impl Surface for Nowhere {
    fn height(&self, _: [f64; 2]) -> f64 {
        f64::INFINITY
    }

    fn gradient(&self, _: [f64; 2]) -> [f64; 2] {
        [0.0, 0.0]
    }
}

#[test]
fn a_surface_that_is_nowhere_is_refused() {
    let material = prony([0.1, 0.0], &[(2.0, 0.5)]);
    let motions = under_force([(0.1, 0.1)].into_iter());
    let result = March::new(&Nowhere, &material, &motions, &options(0.1, 1.6)).map(|_| ());
    assert!(
        matches!(result, Err(BemError::InvalidParameter { .. })),
        "{result:?}"
    );
}
