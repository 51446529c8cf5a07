//! What is left out is not missed: with the work done all the same, every answer stays what it was.
//!
//! Both are the same discrete problem, so that answers differ by what the tolerance of 1e-11 leaves open only.

use allocation_counter::measure;
use bem_halfspace::GridOptions;
use bem_halfspace::slide::{March, MotionRow, SlideOmission};
use bem_halfspace::steady::{SteadyOmission, SteadyOptions, SteadySliding};
use rheology::{Material, Prony};

use crate::support::{Scene, assert_all_close, assert_near, at_depth, prony, tight};

const SAME: f64 = 1e-10;

fn solid() -> Prony {
    prony([0.5, 0.0], &[(3.0, 0.4), (1.0, 2.0)])
}

/// The unit scene on another material.
fn unit<M: Material>(material: M) -> Scene<M> {
    let Scene { body, load, .. } = Scene::unit(2.0);
    Scene::new(body, material, load)
}

/// The solution without the omitted work and with it, compared; and the bytes that both take and give back: the buffer
/// that a thread keeps from its first factorisation is none of them.
fn compare(
    scene: &Scene<impl Material>,
    elements: f64,
    omission: SteadyOmission,
) -> [(SteadySliding, f64); 2] {
    let solved = [None, Some(omission)].map(|redundant_work| {
        let options = SteadyOptions {
            redundant_work,
            tolerance: 1e-11,
            ..scene.steady_options(elements)
        };
        let mut state = None;
        let memory = measure(|| state = Some(scene.steady_on(&options)));
        let bytes = memory.bytes_total as f64 - memory.bytes_current as f64;
        (state.expect("a result"), bytes)
    });
    let [(expected, _), (got, _)] = &solved;
    let friction = [got, expected].map(|state| state.friction_coefficient);
    let allowed = SAME * expected.mean_slope;
    assert_near(omission, friction[0], friction[1], allowed);
    let numbers = |state: &SteadySliding| {
        [
            state.contact_area,
            state.normal_force,
            state.depth.reference_depth,
        ]
    };
    assert_all_close(omission, numbers(got), numbers(expected), SAME);
    // Where the smaller field is, relative to the mean pressure.
    let mean = expected.normal_force / expected.contact_area;
    let [got, expected] = [&got.pressure, &expected.pressure];
    assert_eq!(got.grid, expected.grid, "the box around the contact");
    for (got, expected) in got.pressure.iter().zip(&expected.pressure) {
        // A gap of 1e-11 of the depth scale over one element is about so much of the mean pressure.
        assert_near(omission, *got, *expected, 1e-8 * mean);
    }
    solved
}

#[test]
fn a_factorised_contact_is_that_of_the_iteration() {
    let scene = Scene::unit(2.0);
    let held = Scene {
        load: at_depth(0.2, 0.7),
        ..unit(solid())
    };
    for [(factorised, _), (iterated, _)] in [
        compare(&scene, 6.0, SteadyOmission::Transforms),
        compare(&held, 4.0, SteadyOmission::Transforms),
    ] {
        let kinds = [factorised, iterated].map(|state| state.is_factorised());
        assert_eq!(kinds, [true, false], "whether equations are factorised");
    }
}

#[test]
fn a_box_around_the_contact_has_the_answer_of_the_footprint() {
    for [(in_box, bytes), (_, other_bytes)] in [
        compare(&Scene::unit(2.0), 24.0, SteadyOmission::OutsideContact),
        compare(&unit(solid()), 24.0, SteadyOmission::OutsideContact),
    ] {
        assert!(!in_box.is_factorised(), "{} unknowns", in_box.unknowns);
        // Each contact is solved in a workspace as large as its box; the gaps outside take the footprint in both.
        assert!(
            other_bytes > 1.1 * bytes,
            "{bytes} bytes in boxes, {other_bytes} on the footprint"
        );
    }
}

fn march(redundant_work: Option<SlideOmission>) -> (Vec<MotionRow>, u64) {
    let scene = Scene::unit(2.0);
    let load = scene.load_over(3.0);
    let options = GridOptions {
        redundant_work,
        ..tight(scene.options(8.0))
    };
    let mut rows = Vec::new();
    let memory = measure(|| {
        let march = March::sliding(&scene.body, &scene.material, &load, &options);
        let mut march = march.expect("a march");
        while let Some(row) = march.step().expect("a step") {
            rows.push(row);
        }
    });
    (rows, memory.bytes_max)
}

#[test]
fn a_march_on_the_whole_footprint_makes_the_same_steps() {
    let (expected, bytes) = march(None);
    for (omission, costs_memory) in [
        (SlideOmission::OutsideContact, true),
        (SlideOmission::RowsBehind, false),
    ] {
        let (got, other_bytes) = march(Some(omission));
        assert_eq!(got.len(), expected.len(), "steps, {omission:?}");
        for (got, expected) in got.iter().zip(&expected) {
            let place = (omission, expected.position);
            assert_eq!(got.n_contact, expected.n_contact, "contact, {place:?}");
            let numbers = |row: &MotionRow| [row.tangential_force, row.indentation_depth];
            assert_all_close(place, numbers(got), numbers(expected), SAME);
        }
        // Rows behind are in the memory anyway; what else differs are a few lists.
        assert_eq!(
            10 * other_bytes > 11 * bytes,
            costs_memory,
            "{omission:?}: {bytes} bytes without, {other_bytes} with it"
        );
    }
}
