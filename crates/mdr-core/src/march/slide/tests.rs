//! Steps on a stated spacing, and the parts of the error that one resolution gives.

use casebook::{fixed_cases, standard_solid};
use indenters::{
    AnalyticLine, Axisymmetric, EquivalentLine, FlatCone, PowerProfile, SampledLine,
    TruncatedParaboloid,
};
use proptest::prelude::*;
use rheology::Viscous;

use super::*;

/// The load with which a line on a dashpot of 50 Pa s has the stationary depth (12).
fn load_for_depth(depth: f64) -> SlidingLoad {
    SlidingLoad::new(20.0 * depth, 0.1).expect("a load")
}

fn dashpot() -> Viscous {
    Viscous::new(50.0).expect("a material")
}

/// FRI-04: a kink that rises makes the integral (16) infinite: the sum grows by the same amount with every decade of the
/// spacing. Behind the kink h̃ ∼ √s (1 + O(s)) at the distance s, so that the amount approaches its limit to first
/// order; a quarter of the spacing leaves a quarter of what is missing, and the extrapolation only the noise of the
/// contact's front.
#[test]
fn friction_behind_a_kink_grows_with_the_logarithm_of_the_spacing() {
    for case in casebook::group("FRI-04") {
        let body: Box<dyn Axisymmetric> = if case.id().ends_with("cone") {
            Box::new(FlatCone::new(0.5, 0.3).expect("a cone"))
        } else {
            Box::new(TruncatedParaboloid::new(0.5, 0.25).expect("a paraboloid"))
        };
        let (line, load) = (EquivalentLine(&*body), load_for_depth(case.input("D")));
        let problem = SlidingProblem::new(&line, &dashpot(), &load).expect("a problem");
        let friction = |elements| {
            let record = problem.solve_on(elements, &|_| ()).expect("a state");
            problem.end_values(&record.steps)[0]
        };
        let [coarse, fine] = [25, 100].map(|n| friction(10 * n) - friction(n));
        let extrapolated = (4.0 * fine - coarse) / 3.0;
        case.check_within("mu_increment_per_decade_of_dx", extrapolated, 0.003);
    }
}

/// The steps before the drift is 1e-5 leave the change that the truncation says; rounding is far below.
#[test]
fn a_longer_motion_changes_the_friction_by_the_truncation_at_most() {
    let load = SlidingLoad::new(4.0, 1.0).expect("a load");
    let body = PowerProfile::paraboloid(1.0).expect("a body");
    let line = EquivalentLine(&body);
    for time in [0.1, 1.0, 10.0] {
        let material = standard_solid([1.0, 3.0, 3.0 * time]).expect("a material");
        let problem = SlidingProblem::new(&line, &material, &load).expect("a problem");
        let SlidingRecord {
            steps, elements, ..
        } = problem.solve_on(32, &|_| ()).expect("a motion");
        let is_settled = |end: &usize| relative_change(&steps[..*end], elements.spacing) <= 1e-5;
        let end = (1..=steps.len()).find(is_settled).expect("a settled state");
        let part = problem.truncation_errors(&steps[..end])[0];
        let part = part.truncation.expect("a part");
        let [friction, limit] = [end, steps.len()].map(|end| steps[end - 1].friction_coefficient);
        let change = (limit - friction).abs();
        assert!(
            change <= 1.01 * part && part < 1e-3 * friction,
            "{time} s: {change:e}, and the part is {part:e}"
        );
    }
}

#[test]
fn too_short_a_distance_returns_the_steps_in_the_error() {
    let (body, load) = (
        PowerProfile::paraboloid(0.4).expect("a body"),
        load_for_depth(0.1),
    );
    let line = EquivalentLine(&body);
    let problem = SlidingProblem::new(&line, &dashpot(), &load).expect("a problem");
    let length = problem.contact.length;
    let sampled = ElementHeights::below(&line, length / 40.0, 0.1).expect("elements");
    // `limit` is the friction coefficient of the stationary state, (22) of Kürschner (2014).
    let limit = 8.0 / 3.0 * 0.4 * length;
    let Err(MdrError::NotStationary {
        drift,
        drift_tolerance,
        sliding_distance,
        steps,
    }) = problem.run(sampled, 80.0, &|_| ()).map(|_| ())
    else {
        panic!("two contact lengths are enough");
    };
    assert!(
        drift > drift_tolerance
            && drift < 0.3
            && (sliding_distance / length - 2.0).abs() < 1e-12
            && steps.len() == 80
            && (0.8..1.0).contains(&(steps[79].friction_coefficient / limit)),
        "{drift}, {sliding_distance} m, {} steps, last {:?}, limit {limit}",
        steps.len(),
        steps.last()
    );
}

/// On an infinite domain a foot is seen although it stands a hundred contact lengths ahead of the lowest point.
#[test]
fn a_far_foot_on_a_long_domain_is_seen() {
    let height = |x: f64| x.abs().min(0.05 + 0.5 * (x - 30.0).abs());
    let feet = AnalyticLine::new(height, |_| 0.0, [-1e3, 1e3]).expect("a line");
    let load = load_for_depth(0.3);
    let problem = SlidingProblem::new(&feet, &dashpot(), &load).expect("a problem");
    let sampled = ElementHeights::below(&feet, 0.05, 0.3).expect("elements");
    let record = problem
        .run(sampled, 1e5, &|_| ())
        .expect("a state")
        .expect("high enough");
    let [_, _, rear, front] = problem.end_values(&record.steps);
    assert!(rear.abs() < 1e-9, "{rear}");
    assert!((front - 30.45).abs() < 0.051, "{front}");
}

/// The friction coefficient on a table, Σ increment_j (h_{j+1} − h_j) / (Δx D).
fn discrete_friction(line: &SampledLine, depth: f64) -> f64 {
    let heights = line.heights();
    let mut sum = 0.0;
    for node in 0..heights.len() - 1 {
        let ahead = heights[node + 1..].iter().copied().fold(depth, f64::min);
        if heights[node] < ahead {
            sum += (ahead - heights[node]) * (heights[node + 1] - heights[node]);
        }
    }
    sum / (line.positions()[1] * depth)
}

proptest! {
    #![proptest_config(fixed_cases(128))]

    /// On a dashpot the depth only grows, and never beyond the stationary one.
    #[test]
    fn any_line_sinks_to_its_stationary_depth_and_no_further(
        inner in prop::collection::vec(0.0..1.0_f64, 4..30),
        depth in 0.3..1.0_f64,
        spacing in 1e-3..1e3_f64,
    ) {
        // The foremost of the two lowest nodes is the second, so that three elements are in contact.
        let mut heights = vec![0.0, 0.0, 0.1, 0.2];
        heights.extend(inner.iter().map(|height| 0.3 + 0.7 * height));
        heights.push(1.0);
        let positions = (0..heights.len()).map(|k| k as f64 * spacing);
        let line = SampledLine::new(positions.collect(), heights).expect("a line");
        let load = load_for_depth(depth);
        let problem = SlidingProblem::new(&line, &dashpot(), &load).expect("a problem");
        let sampled = ElementHeights::below(&line, spacing, depth).expect("elements");
        let record = problem.run(sampled, 1e5, &|_| ()).expect("a state").expect("high enough");
        let mut before = 0.0;
        // `slack` allows for the rounding of a sum over at most 35 elements, divided by their number.
        let slack = 4.0 * f64::EPSILON * depth;
        for step in &record.steps {
            let now = step.indentation_depth;
            prop_assert!(now >= before - slack && now <= depth + slack, "{now} after {before}, limit {depth}");
            before = now;
        }
        let [friction, reached, ..] = problem.end_values(&record.steps);
        let expected = discrete_friction(&line, depth);
        prop_assert!((reached / depth - 1.0).abs() < 1e-9, "{reached}, limit {depth}");
        prop_assert!((friction / expected - 1.0).abs() < 2e-9, "{friction}, expected {expected}");
    }
}
