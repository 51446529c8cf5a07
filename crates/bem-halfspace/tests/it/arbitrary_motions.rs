//! An indenter may move by any amount in a step, stop, go back and be lifted.

use std::f64::consts::PI;
use std::iter::repeat_n;

use bem_halfspace::slide::{MotionRow, slide_along};
use bem_halfspace::{Control, GridOptions};
use numerics::whole_part;
use rheology::Material;

use crate::support::{
    after, assert_all_close, assert_close, assert_near, every_kind_of_material, motions,
    paraboloid, prony, slid, squares, three_elements, tight, under_force,
};

const FORCE: f64 = 0.5;
const VELOCITY: f64 = 0.7;

/// Moves a paraboloid through (time, position) under a constant force.
fn moved(
    path: impl IntoIterator<Item = (f64, f64)>,
    material: &dyn Material,
    options: &GridOptions,
) -> Vec<MotionRow> {
    let under_force = |(time, position)| (time, position, Control::NormalForce(FORCE));
    let motions = motions(path.into_iter().map(under_force));
    slide_along(&paraboloid(0.5), &material, &motions, options).expect("rows")
}

fn solid() -> impl Material {
    three_elements(0.1, 2.0, 0.5)
}

#[test]
fn slide_moves_by_whole_elements() {
    let load = after(under_force(FORCE, VELOCITY), 2.0);
    let options = tight(squares(0.1, 1.6));
    for (name, material) in every_kind_of_material() {
        let expected = slid(&paraboloid(0.5), &*material, &load, &options);
        let path = (1..=20).map(|k| 0.1 * f64::from(k));
        let rows = moved(path.map(|x| (x / VELOCITY, x)), &*material, &options);
        for (row, expected) in rows.iter().zip(&expected.rows) {
            let friction = row.tangential_force / row.normal_force;
            assert_near(name, friction, expected.friction_coefficient, 1e-10);
            let depth = expected.indentation_depth;
            assert_close(name, row.indentation_depth, depth, 1e-10);
        }
    }
}

/// Friction and depth after a distance of 2 by steps of the given length, in elements of which 16 have the length 1.
fn by_parts(part: f64) -> [f64; 2] {
    let [n_steps, last] = [32.0, 2.0].map(|elements: f64| whole_part((elements / part).round()));
    let x = |k: usize| 2.0 * k as f64 / n_steps as f64;
    let path = (1..=n_steps).map(|k| (x(k) / VELOCITY, x(k)));
    let rows = moved(path, &solid(), &squares(1.0 / 16.0, 1.6));
    // The outline follows the elements, which the friction feels: mean over the last two elements.
    let rows = &rows[rows.len() - last..];
    let mean = |value: fn(&MotionRow) -> f64| rows.iter().map(value).sum::<f64>() / last as f64;
    let friction = mean(|row| row.tangential_force / row.normal_force);
    [friction, mean(|row| row.indentation_depth)]
}

/// Steps of half, a third or a quarter of an element, and of two: the same friction to first order in their length.
#[test]
fn friction_does_not_depend_on_the_length_of_a_step_in_elements() {
    let reference = by_parts(0.25);
    for part in [0.5, 1.0 / 3.0, 1.0, 2.0] {
        // The error is a fraction of a step over the contact, 1/20 for steps of one element.
        assert_all_close(part, by_parts(part), reference, 0.02 * part.max(0.5));
    }
}

/// Compares the contacts, forces and depths of steps, where the tangential force may have the other sign.
fn assert_same_rows(rows: &[MotionRow], expected: &[MotionRow], sign: f64, tolerance: f64) {
    for (row, expected) in rows.iter().zip(expected) {
        let allowed = tolerance * FORCE;
        let tangential_force = sign * expected.tangential_force;
        assert_near(row, row.tangential_force, tangential_force, allowed);
        assert_close(row, row.normal_force, expected.normal_force, tolerance);
        let depth = expected.indentation_depth;
        assert_close(row, row.indentation_depth, depth, tolerance);
        assert_eq!(row.n_contact, expected.n_contact, "{row:?}");
    }
}

/// A mirrored body on the mirrored path has the opposite force, also after a turn.
#[test]
fn motion_to_the_other_side_is_the_mirror_image() {
    let there = (1..=30).map(|k| 0.03 * f64::from(k));
    let back = (1..=15).map(|k| 0.9 - 0.05 * f64::from(k));
    let path = there.chain(repeat_n(0.9, 5)).chain(back).enumerate();
    let options = tight(squares(0.1, 1.6));
    let [right, left] = [1.0, -1.0].map(|sign| {
        let timed = |(k, x)| (0.05 * (k + 1) as f64, sign * x);
        moved(path.clone().map(timed), &solid(), &options)
    });
    assert_same_rows(&right, &left, -1.0, 1e-9);
    // The dent in front resists, and after the turn the one that was behind.
    let [before, after] = [29, 49].map(|step| right[step].tangential_force);
    assert!(before > 0.0 && after < 0.0, "{before} and then {after}");
}

/// The size of the footprint does not change the result: rows ahead that enter it are displaced by all past pressure.
#[test]
fn the_footprint_does_not_matter() {
    let material = prony([0.1, 0.3], &[(2.0, 0.5)]);
    let [small, large] = [1.3, 3.1].map(|half_width| {
        let times = (1..=24).map(|k| 0.1 * f64::from(k));
        let path = times.map(|time| (time, (1.3 * time).sin()));
        moved(path, &material, &tight(squares(0.1, half_width)))
    });
    assert_same_rows(&small, &large, 1.0, 1e-9);
}

/// A return at the end does not change the steps before it, although rows to which the body returns are followed longer.
#[test]
fn a_return_at_the_end_changes_nothing_before() {
    let path = (1..=24).map(|k| 0.1 * f64::from(k)).map(|x| (x, x));
    let options = tight(squares(0.1, 1.3));
    let away = moved(path.clone(), &solid(), &options);
    let back = moved(path.chain([(2.5, 0.1)]), &solid(), &options);
    assert_same_rows(&away, &back, 1.0, 1e-9);
}

/// A body that is lifted, moved and pressed again has the depth of a body that never moved.
#[test]
fn a_body_pressed_elsewhere_meets_a_fresh_surface() {
    let far = 40.0;
    let motions = motions([
        (1.0, 0.0, Control::NormalForce(FORCE)),
        (1.5, far, Control::IndentationDepth(-1.0)),
        (2.5, far, Control::NormalForce(FORCE)),
    ]);
    let (material, options) = (three_elements(0.4, 2.0, 0.5), tight(squares(0.1, 1.6)));
    let rows = slide_along(&paraboloid(0.5), &material, &motions, &options).expect("rows");
    assert_eq!(rows[1].contact_x, None, "lifted");
    // The old dent, which recovers, is felt like a point force at that distance.
    let dent = FORCE / (4.0 * PI * 0.4 * far);
    let [first, last] = [0, 2].map(|row: usize| rows[row].indentation_depth);
    let is_fresh = last > first && last < first + dent;
    assert!(is_fresh, "depth {last} after {first}, a dent of {dent}");
}
