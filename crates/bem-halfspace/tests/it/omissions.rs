//! What is left out is not missed: with the work done all the same, every answer stays what it was.
//!
//! Both are the same discrete problem, so that answers differ by what the tolerance of 1e-11 leaves open only.

use std::fmt::Debug;

use allocation_counter::{AllocationInfo, measure};
use bem_halfspace::GridOptions;
use bem_halfspace::slide::{March, SlideOmission};
use bem_halfspace::steady::{SteadyOmission, SteadyOptions};
use rheology::{Material, Prony};

use crate::support::{Scene, assert_close, at_depth, prony, tight};

/// The memory of a solution without the omitted work and with it, which has the same numbers.
fn compare<W: Copy + Debug>(work: W, solve: impl Fn(Option<W>) -> Vec<f64>) -> [AllocationInfo; 2] {
    let [(expected, without), (got, with)] = [None, Some(work)].map(|work| {
        let mut numbers = Vec::new();
        let memory = measure(|| numbers = solve(work));
        (numbers, memory)
    });
    assert_eq!(got.len(), expected.len(), "{work:?}");
    for (got, expected) in got.into_iter().zip(expected) {
        assert_close(work, got, expected, 1e-10);
    }
    [without, with]
}

/// On a dashpot, and at a depth on a solid with two relaxation times.
fn scenes() -> (Scene, Scene<Prony>) {
    let dashpot = Scene::unit(2.0);
    let solid = prony([0.5, 0.0], &[(3.0, 0.4), (1.0, 2.0)]);
    let on_solid = Scene::new(dashpot.body, solid, at_depth(0.2, 0.7));
    (dashpot, on_solid)
}

/// The numbers of a stationary state, whose equations are factorised where `is_factorised` says so.
fn steady(
    scene: &Scene<impl Material>,
    elements: f64,
    redundant_work: Option<SteadyOmission>,
    is_factorised: bool,
) -> Vec<f64> {
    let state = scene.steady_on(&SteadyOptions {
        redundant_work,
        tolerance: 1e-11,
        ..scene.steady_options(elements)
    });
    assert_eq!(state.is_factorised(), is_factorised, "{redundant_work:?}");
    // Friction is a difference of slopes, and known to a part of their mean modulus.
    let uphill = 1.0 + state.friction_coefficient / state.mean_slope;
    let depth = state.depth.reference_depth;
    vec![uphill, state.contact_area, state.normal_force, depth]
}

#[test]
fn a_factorised_contact_is_that_of_the_iteration() {
    let (dashpot, solid) = scenes();
    let work = SteadyOmission::Transforms;
    compare(work, |work| steady(&dashpot, 6.0, work, work.is_none()));
    compare(work, |work| steady(&solid, 4.0, work, work.is_none()));
}

#[test]
fn a_box_around_the_contact_has_the_answer_of_the_footprint() {
    let (dashpot, solid) = scenes();
    let work = SteadyOmission::OutsideContact;
    // Each contact is solved in a workspace as large as its box; the gaps outside take the footprint in both. The buffer
    // that a thread keeps from its first factorisation is none of them.
    for memory in [
        compare(work, |work| steady(&dashpot, 24.0, work, false)),
        compare(work, |work| steady(&solid, 24.0, work, false)),
    ] {
        let [in_box, on_footprint] =
            memory.map(|memory| memory.bytes_total as f64 - memory.bytes_current as f64);
        assert!(on_footprint > 1.1 * in_box, "{memory:?}");
    }
}

#[test]
fn a_march_on_the_whole_footprint_makes_the_same_steps() {
    let (scene, _) = scenes();
    let load = scene.load_over(3.0);
    let march = |redundant_work| {
        let options = GridOptions {
            redundant_work,
            ..tight(scene.options(8.0))
        };
        let march = March::sliding(&scene.body, &scene.material, &load, &options);
        let mut march = march.expect("a march");
        let rows = std::iter::from_fn(|| march.step().expect("a step"));
        rows.flat_map(|row| {
            [
                row.tangential_force,
                row.indentation_depth,
                row.contact_area,
            ]
        })
        .collect()
    };
    let [in_box, on_footprint] = compare(SlideOmission::OutsideContact, march);
    let bytes = [in_box, on_footprint].map(|memory| memory.bytes_max);
    assert!(10 * bytes[1] > 11 * bytes[0], "{bytes:?} bytes");
    // Rows behind are in the memory anyway.
    compare(SlideOmission::RowsBehind, march);
}
