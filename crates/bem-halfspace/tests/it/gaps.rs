//! The gap around a contact is that of closed forms, and complementary to the pressure.

use std::f64::consts::PI;

use bem_halfspace::indenters::Cylinder;
use bem_halfspace::slide::{PressureField, slide_on_grid};
use bem_halfspace::steady::{SteadyOptions, gap};
use bem_halfspace::{
    Accuracy, Control, Footprint, GapField, PressingLoad, SteadyBody::Line, indent, steady,
    steady_on_grid,
};
use indenters::FlatPunch;

use crate::support::{
    after, assert_refused, elastic, every_kind_of_material, paraboloid, squares, under_force,
};

/// Distance of the centre from the lowest point \[m], and gap \[m], of each element.
fn by_distance(field: &GapField) -> impl Iterator<Item = (f64, f64)> {
    let ([_, columns], [dx, dy]) = (field.grid.shape(), field.grid.spacing());
    let [x, y] = field.origin;
    (field.gap.iter().enumerate()).map(move |(index, gap)| {
        let [row, column] = [index / columns, index % columns].map(|at| at as f64);
        ((x + row * dx).hypot(y + column * dy), *gap)
    })
}

/// Gap outside the contact of a ball of radius 1 on an elastic half space (Hertz 1882).
fn hertz(distance: f64, radius: f64) -> f64 {
    let ratio = distance / radius;
    let root = (ratio * ratio - 1.0).sqrt();
    radius * radius / PI * (root + (ratio * ratio - 2.0) * ratio.recip().acos())
}

/// Gap outside the contact of a cylinder of radius 1 on an elastic half space.
fn line_hertz(distance: f64, half_width: f64) -> f64 {
    let ratio = distance / half_width;
    let root = (ratio * ratio - 1.0).sqrt();
    0.5 * half_width * half_width * (ratio * root - ratio.acosh())
}

/// Compares gaps with a closed form. The largest is that at a corner of the field; its `error` is relative.
#[track_caller]
fn check(field: &GapField, closed: impl Fn(f64) -> f64, radius: f64, error: f64) {
    let largest = field.gap.iter().copied().fold(0.0, f64::max);
    let mut farthest = 0.0_f64;
    for (distance, gap) in by_distance(field) {
        let expected = if distance > radius {
            closed(distance)
        } else {
            0.0
        };
        let difference = (gap - expected).abs();
        assert!(
            difference <= error * largest,
            "{gap:e} at {distance:e}, expected {expected:e}"
        );
        farthest = farthest.max(distance / radius);
    }
    assert!(farthest > 1.4, "the field ends at {farthest} contact radii");
}

/// Gaps are at most the tolerance where there is pressure, and at least minus the tolerance elsewhere; some are greater.
#[track_caller]
pub(crate) fn check_complementary(
    name: &str,
    field: &GapField,
    pressure: &PressureField,
    tolerance: f64,
) {
    let [_, columns] = field.grid.shape();
    let [dx, dy] = field.grid.spacing();
    let mut n_loaded = 0;
    for (index, gap) in field.gap.iter().enumerate() {
        let x = field.origin[0] + (index / columns) as f64 * dx;
        let y = field.origin[1] + (index % columns) as f64 * dy;
        let is_loaded = pressure.pressure_at([x, y]) > 0.0;
        n_loaded += usize::from(is_loaded);
        let allowed = if is_loaded { tolerance } else { f64::INFINITY };
        assert!(
            (-tolerance..=allowed).contains(gap),
            "{name}: {gap:e} at {x:e}, {y:e}"
        );
    }
    let loaded = pressure.pressure.iter().filter(|pressure| **pressure > 0.0);
    assert_eq!(
        n_loaded,
        loaded.count(),
        "{name}: the field covers the contact"
    );
    let largest = field.gap.iter().copied().fold(0.0, f64::max);
    assert!(
        largest > 1e3 * tolerance,
        "{name}: the largest gap is {largest:e}"
    );
}

#[test]
fn around_an_elastic_contact_it_is_that_of_hertz() {
    // With E* = 4 G the contact radius is (3 F R/(4 E*))^(1/3).
    let (ball, rubber) = (paraboloid(0.5), elastic(1.0));
    let force = 0.01;
    let radius = (0.75 * force / 4.0_f64).cbrt();
    let load = under_force(force, 1.0);
    let elements = Accuracy::Elements(48);
    let sliding = steady(&ball, &rubber, &load, elements).expect("a state");
    let around = gap(
        &ball,
        &rubber,
        &load,
        &sliding.options,
        &sliding.finest.pressure,
    );
    let around = around.expect("a gap").expect("a field");
    check(&around, |distance| hertz(distance, radius), radius, 0.01);
    let pressing = PressingLoad::new(Control::NormalForce(force), 1.0).expect("a load");
    let pressed = indent(&ball, &rubber, &pressing, elements).expect("a state");
    let field = pressed.finest.gap.expect("a field");
    check(&field, |distance| hertz(distance, radius), radius, 0.01);

    // The half width of a line is √(4 F' R/(π E*)).
    let cylinder = Cylinder::new(1.0).expect("a cylinder");
    let half_width = (force / PI).sqrt();
    let line = steady(Line(&cylinder), &rubber, &load, elements).expect("a state");
    let found = gap(
        Line(&cylinder),
        &rubber,
        &load,
        &line.options,
        &line.finest.pressure,
    );
    let found = found.expect("a gap").expect("a field");
    let closed = |distance| line_hertz(distance, half_width);
    assert_eq!(found.grid.shape()[1], 1, "a line");
    let largest = found.gap.iter().copied().fold(0.0, f64::max);
    for (distance, gap) in by_distance(&found) {
        let expected = if distance > half_width {
            closed(distance)
        } else {
            0.0
        };
        assert!(
            (gap - expected).abs() <= 0.01 * largest,
            "{gap:e} at {distance:e}"
        );
    }
}

#[test]
fn on_any_material_it_is_complementary_to_the_pressure() {
    let ball = paraboloid(0.5);
    let load = under_force(0.01, 0.3);
    let options = SteadyOptions::new([0.02; 2], Footprint::square(0.5));
    let of_march = squares(0.02, 0.4);
    for (name, material) in every_kind_of_material() {
        let material = &*material;
        let state = steady_on_grid(&ball, &material, &load, &options).expect("a state");
        let field = gap(&ball, &material, &load, &options, &state.pressure);
        let field = field.expect("a gap").expect("a field");
        check_complementary(name, &field, &state.pressure, 1e-9);
        let mut unloaded = state.pressure.clone();
        unloaded.pressure.fill(0.0);
        let refused = gap(&ball, &material, &load, &options, &unloaded);
        assert_refused(name, refused, "largest pressure");
        let marched = slide_on_grid(&ball, &material, &after(load, 0.3), &of_march);
        let marched = marched.expect("a march");
        let field = marched.gap.expect("a field");
        check_complementary(name, &field, &marched.pressure, 1e-6);
    }
}

#[test]
fn a_body_that_ends_at_the_contact_has_none() {
    let (punch, rubber) = (FlatPunch::new(1.0).expect("a punch"), elastic(1.0));
    let load = PressingLoad::new(Control::NormalForce(1.0), 1.0).expect("a load");
    let pressed = indent(&punch, &rubber, &load, Accuracy::Elements(32)).expect("a state");
    assert_eq!(pressed.finest.gap, None, "corners of its box have no body");
}
