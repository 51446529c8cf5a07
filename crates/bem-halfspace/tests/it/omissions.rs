//! What is left out is not missed: with the work done all the same, every answer stays what it was.
//!
//! Both are the same discrete problem, so that answers differ by what the tolerance of 1e-11 leaves open only.

use allocation_counter::measure;
use bem_halfspace::slide::{March, MotionRow, PressureField, SlideOmission};
use bem_halfspace::steady::{SteadyOmission, SteadyOptions, SteadySliding, steady_on_grid};
use bem_halfspace::{GridOptions, SlidingLoad};
use rheology::Material;

use crate::support::{Scene, TIGHT, prony};

const SAME: f64 = 1e-10;

fn assert_same(name: &str, got: f64, [expected, scale]: [f64; 2]) {
    assert!(
        (got - expected).abs() <= SAME * scale.abs(),
        "{name}: {got} instead of {expected}, on the scale {scale}"
    );
}

/// Compares pressures where the smaller field is, relative to the mean pressure.
fn assert_same_pressure(got: &PressureField, expected: &PressureField, mean: f64) {
    assert_eq!(got.grid, expected.grid, "the box around the contact");
    let pairs = got.pressure.iter().zip(&expected.pressure);
    let largest = pairs.map(|(got, expected)| (got - expected).abs());
    let largest = largest.fold(0.0, f64::max) / mean;
    // A gap of 1e-11 of the depth scale over one element is about so much of the mean pressure.
    assert!(
        largest < 1e-8,
        "pressures differ by {largest:e} of the mean"
    );
}

struct Stationary {
    scene: Scene,
    elements: f64,
}

impl Stationary {
    fn options(&self) -> SteadyOptions {
        let spacing = self.scene.contact_length() / self.elements;
        let footprint = self.scene.options(self.elements).footprint;
        SteadyOptions {
            tolerance: 1e-11,
            ..SteadyOptions::new([spacing, 0.5 * spacing], footprint)
        }
    }

    /// The solution with the omission and without it, and the bytes that both take and give back: the buffer that a
    /// thread keeps from its first factorisation is none of them.
    fn solve(
        &self,
        material: &impl Material,
        load: &SlidingLoad,
        omission: SteadyOmission,
    ) -> [(SteadySliding, f64); 2] {
        [None, Some(omission)].map(|redundant_work| {
            let options = SteadyOptions {
                redundant_work,
                ..self.options()
            };
            let mut state = None;
            let memory = measure(|| {
                state = Some(steady_on_grid(&self.scene.body, material, load, &options));
            });
            let bytes = memory.bytes_total as f64 - memory.bytes_current as f64;
            (state.expect("a result").expect("a solution"), bytes)
        })
    }

    fn check(
        &self,
        material: &impl Material,
        load: &SlidingLoad,
        omission: SteadyOmission,
    ) -> [(SteadySliding, f64); 2] {
        let solved = self.solve(material, load, omission);
        let [(expected, _), (got, _)] = &solved;
        let slope = expected.mean_slope;
        assert_same(
            "friction",
            got.friction_coefficient,
            [expected.friction_coefficient, slope],
        );
        for (name, got, expected) in [
            ("area", got.contact_area, expected.contact_area),
            ("force", got.normal_force, expected.normal_force),
            (
                "depth",
                got.depth.reference_depth,
                expected.depth.reference_depth,
            ),
        ] {
            assert_same(name, got, [expected, expected]);
        }
        let mean = expected.normal_force / expected.contact_area;
        assert_same_pressure(&got.pressure, &expected.pressure, mean);
        solved
    }
}

fn stationary(elements: f64) -> Stationary {
    Stationary {
        scene: Scene::unit(2.0),
        elements,
    }
}

#[test]
fn a_factorised_contact_is_that_of_the_iteration() {
    let problem = stationary(6.0);
    let solved = problem.check(
        &problem.scene.material,
        &problem.scene.load,
        SteadyOmission::Transforms,
    );
    for ((state, _), expected) in solved.iter().zip([true, false]) {
        assert_eq!(
            state.is_factorised(),
            expected,
            "whether {} unknowns are factorised",
            state.unknowns
        );
    }
}

#[test]
fn a_box_around_the_contact_has_the_answer_of_the_footprint() {
    let problem = stationary(24.0);
    let solid = prony([0.5, 0.0], &[(3.0, 0.4), (1.0, 2.0)]);
    let viscous = problem.check(
        &problem.scene.material,
        &problem.scene.load,
        SteadyOmission::OutsideContact,
    );
    let solid = problem.check(&solid, &problem.scene.load, SteadyOmission::OutsideContact);
    for [(in_box, bytes), (_, other_bytes)] in [viscous, solid] {
        assert!(!in_box.is_factorised(), "{} unknowns", in_box.unknowns);
        // Each contact is solved in a workspace as large as its box; the gaps outside take the footprint in both.
        assert!(
            other_bytes > 1.1 * bytes,
            "{bytes} bytes in boxes, {other_bytes} on the footprint"
        );
    }
}

#[test]
fn at_a_depth_the_same_work_is_not_missed() {
    let problem = stationary(4.0);
    let solid = prony([0.5, 0.0], &[(3.0, 0.4), (1.0, 2.0)]);
    let load = SlidingLoad::at_depth(0.2, problem.scene.load.velocity()).expect("a load");
    let [(expected, _), (got, _)] = problem.check(&solid, &load, SteadyOmission::Transforms);
    assert!(
        expected.is_factorised() && !got.is_factorised(),
        "factorised: {} after {}",
        got.is_factorised(),
        expected.is_factorised()
    );
}

fn march(redundant_work: Option<SlideOmission>) -> (Vec<MotionRow>, u64) {
    let scene = Scene::unit(2.0);
    let load = scene.load_over(3.0);
    let options = GridOptions {
        contact: TIGHT,
        redundant_work,
        ..scene.options(8.0)
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
            let place = format!("{omission:?} at {} m", expected.position);
            assert_eq!(got.n_contact, expected.n_contact, "contact, {place}");
            for (got, expected) in [
                (got.tangential_force, expected.tangential_force),
                (got.indentation_depth, expected.indentation_depth),
            ] {
                assert_same(&place, got, [expected, expected]);
            }
        }
        // Rows behind are in the memory anyway; what else differs are a few lists.
        assert_eq!(
            10 * other_bytes > 11 * bytes,
            costs_memory,
            "{omission:?}: {bytes} bytes without, {other_bytes} with it"
        );
    }
}
