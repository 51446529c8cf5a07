//! A line that comes back to the same place: between sliding over fresh ground and over what has relaxed.

use indenters::{Control, EquivalentLine, IndenterError, MovingLoad, MovingPoint, Sphere};
use mdr_core::{MdrError, SteadySliding, move_along, press, slide, steady};
use numerics::Accuracy;
use rheology::{Material as _, Maxwell, StandardSolid, StandardSolidParameters};

use crate::support::{at_depth, load};

const VELOCITY: f64 = 0.1;

fn ball() -> Sphere {
    Sphere::new(5e-3).expect("a sphere")
}

fn rubber() -> StandardSolid {
    let parameters = StandardSolidParameters {
        equilibrium_modulus: 1e6,
        maxwell_modulus: 1e7,
        viscosity: 1e5,
    };
    StandardSolid::new(parameters).expect("a solid")
}

fn on(track: f64, velocity: f64) -> SteadySliding {
    let load = load(2.0, velocity).on_track(track).expect("a track");
    let state = steady(&EquivalentLine(&ball()), &rubber(), &load, 1e-5);
    state.expect("a stationary state")
}

/// After a track of length L the fraction e^(−L/(v λ)) of the displacement behind the line remains, and the friction changes
/// in proportion.
#[test]
fn a_long_track_is_fresh_ground_but_for_the_rest_of_the_last_pass() {
    let straight = steady(
        &EquivalentLine(&ball()),
        &rubber(),
        &load(2.0, VELOCITY),
        1e-9,
    );
    let straight = straight
        .expect("a stationary state")
        .indentation_depth
        .value;
    let time = rubber().creep().elements()[0].retardation_time;
    let change = |lengths: f64| {
        on(lengths * VELOCITY * time, VELOCITY)
            .indentation_depth
            .value
            - straight
    };
    for lengths in [6.0, 9.0, 12.0] {
        let ratio = change(lengths + 1.0) / change(lengths);
        let expected = (-1.0_f64).exp();
        assert!(
            (ratio / expected - 1.0).abs() < 0.02,
            "{lengths} v λ: {ratio}, expected {expected}"
        );
    }
}

/// With v λ ≫ L the slow retardation element follows the mean load of the track. The contact is that of the instantaneous
/// spring on a surface that has sunk by J₁ F/(4 L), and the friction is in proportion to L/(v λ).
#[test]
fn on_a_short_track_the_slow_element_carries_the_mean_load() {
    let (track, force) = (4e-3, 2.0);
    let line = ball();
    let line = EquivalentLine(&line);
    let element = rubber().creep().elements()[0];
    let sunk = element.compliance * 0.25 * force / track;
    let glass = rheology::Elastic::new(1.1e7).expect("a spring");
    let glassy = press(&line, &glass, Control::NormalForce(force), 1e-9).expect("a contact");
    let expected = sunk + glassy.indentation_depth.value;
    let mut before = f64::INFINITY;
    for velocity in [1e2, 1e3, 1e4] {
        let state = on(track, velocity);
        let ratio = track / (velocity * element.retardation_time);
        let difference = (state.indentation_depth.value / expected - 1.0).abs();
        assert!(
            difference < 2.0 * ratio,
            "{velocity} m/s: {state:?}, expected {expected}"
        );
        let friction = state.friction_coefficient.value;
        assert!(
            friction < 0.2 * before,
            "{velocity} m/s: {friction} after {before}"
        );
        before = friction;
    }
}

/// A stroke in one direction, lifted on the way back so quickly that nothing recovers, is a track.
#[test]
fn laps_of_a_motion_end_in_the_state_on_the_track() {
    let (depth, track, laps) = (1e-4, 8e-3, 12);
    let lap = track / VELOCITY;
    let back = 1e-6 * lap;
    let point = |time, position, depth| MovingPoint {
        time,
        position,
        control: Control::IndentationDepth(depth),
    };
    let points = (0..laps).flat_map(|number| {
        let start = f64::from(number) * (lap + 3.0 * back);
        [
            point(start, 0.0, depth),
            point(start + lap, track, depth),
            point(start + lap + back, track, -1e-3),
            point(start + lap + 2.0 * back, 0.0, -1e-3),
        ]
    });
    let motion = MovingLoad::through_points(&points.collect::<Vec<_>>()).expect("a motion");
    let line = ball();
    let line = EquivalentLine(&line);
    let moved = move_along(&line, &rubber(), &motion, Accuracy::Elements(96)).expect("laps");
    let load = at_depth(depth, VELOCITY);
    let on_track = load.on_track(track).expect("a track");
    let state = steady(&line, &rubber(), &on_track, 1e-6).expect("a state");
    let straight = steady(&line, &rubber(), &load, 1e-6).expect("a state");
    // In the middle of the last lap, where neither of its ends is near.
    let last = f64::from(laps - 1) * (lap + 3.0 * back);
    let steps = moved.steps.iter().filter(|step| {
        let part = (step.time - last) / lap;
        (0.55..0.65).contains(&part)
    });
    let forces: Vec<f64> = steps.map(|step| step.normal_force).collect();
    let got = forces.iter().sum::<f64>() / forces.len() as f64;
    let expected = state.normal_force.value;
    assert!(
        (got / expected - 1.0).abs() < 3e-3,
        "{got}, expected {expected}"
    );
    assert!(
        (straight.normal_force.value / expected - 1.0).abs() > 0.02,
        "{straight:?}"
    );
}

#[test]
fn tracks_that_have_no_state_are_refused() {
    let line = ball();
    let line = EquivalentLine(&line);
    let straight = load(2.0, VELOCITY);
    let on = |track| straight.on_track(track).expect("a track");
    let short = steady(&line, &rubber(), &on(1e-3), 1e-3);
    assert!(
        matches!(short, Err(MdrError::TrackTooShort { .. })),
        "{short:?}"
    );
    let fluid = Maxwell::new(1e6, 1e5).expect("a fluid");
    let flows = steady(&line, &fluid, &on(0.1), 1e-3);
    assert_eq!(flows, Err(MdrError::NoCycle), "a fluid");
    let none = straight.on_track(0.0);
    assert!(
        matches!(none, Err(IndenterError::InvalidParameter(_))),
        "{none:?}"
    );
    let marched = slide(&line, &rubber(), &on(0.1), 1e-2);
    assert!(
        matches!(
            marched,
            Err(MdrError::Indenter(IndenterError::NoTrack { .. }))
        ),
        "{marched:?}"
    );
    let ends = on(0.1).after(1.0).expect("a distance");
    assert_eq!(ends.track(), None, "a load that ends");
}
