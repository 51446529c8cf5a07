//! A body that comes back to the same place, as a ball on a disc does: between sliding over fresh ground and over what has
//! relaxed.

use std::f64::consts::PI;

use bem_halfspace::steady::sensitivity::SteadySensitivity;
use bem_halfspace::steady::{SteadyOptions, SteadySliding, steady_grid, steady_on_grid};
use bem_halfspace::{BemError, Elastomer, Layer, SteadyBody::Line, slide, steady};
use indenters::{Cylinder, IndenterError, SlidingLoad, Sphere};
use numerics::Accuracy;
use rheology::{Elastic, Material as _, Maxwell, StandardSolid, StandardSolidParameters};

use crate::support::{assert_bars_agree, assert_close, under_force};

const RADIUS: f64 = 5e-3;
const FORCE: f64 = 2.0;

fn ball() -> Sphere {
    Sphere::new(RADIUS).expect("a sphere")
}

/// A solid whose instantaneous modulus is a multiple of its equilibrium modulus.
fn rubber(factor: f64) -> StandardSolid {
    let parameters = StandardSolidParameters {
        equilibrium_modulus: 1e6,
        maxwell_modulus: 1e6 * (factor - 1.0),
        viscosity: 1e4 * (factor - 1.0),
    };
    StandardSolid::new(parameters).expect("a solid")
}

fn on(load: SlidingLoad, track: f64) -> SlidingLoad {
    load.on_track(track).expect("a track")
}

/// The state on one grid, so that elements change nothing between two of them.
fn on_grid(
    elastomer: &impl Elastomer,
    load: &SlidingLoad,
    options: &SteadyOptions,
) -> SteadySliding {
    let options = SteadyOptions {
        tolerance: 1e-12,
        ..*options
    };
    steady_on_grid(&ball(), elastomer, load, &options).expect("a state")
}

/// The potential V of the nearest image has a kink half a track ahead, where its slope turns from that ahead of a load to that
/// behind it. The part of it in a retardation element of the memory length l decays until it is under the load: the change is
/// proportional to e^(−L/2l) (l V' + l³ V''' + …) half a track ahead, where V is that of a point load.
#[test]
fn a_long_track_differs_from_a_straight_one_by_the_memory_of_half_of_it() {
    let (solid, straight) = (rubber(4.0), under_force(FORCE, 0.5));
    let memory = 0.5 * solid.creep().elements()[0].retardation_time;
    let options = steady_grid(&ball(), &solid, &straight, 12).expect("a grid");
    let fresh = on_grid(&solid, &straight, &options);
    let change = |lengths: f64| {
        let state = on_grid(&solid, &on(straight, lengths * memory), &options);
        [
            state.depth.reference_depth - fresh.depth.reference_depth,
            state.friction_coefficient - fresh.friction_coefficient,
        ]
    };
    let expected = |lengths: f64| {
        let half = 0.5 * lengths;
        // 1!/s² + 3!/s⁴ + … diverges; so far its terms fall.
        let terms = [1.0, 6.0, 120.0, 5040.0].into_iter().zip([2, 4, 6, 8]);
        let sum: f64 = terms
            .map(|(factor, power)| factor * half.powi(-power))
            .sum();
        (-half).exp() * sum
    };
    let (mut before, mut length) = (change(20.0), 20.0);
    for (longer, allowed) in [(24.0, 0.03), (28.0, 0.01)] {
        let now = change(longer);
        for (after, before) in now.into_iter().zip(before) {
            let what = ("from", length, "to", longer, before);
            let ratio = expected(longer) / expected(length);
            assert_close(what, after / before, ratio, allowed);
        }
        (before, length) = (now, longer);
    }
}

/// With l ≫ L the retardation element carries the mean load of the whole track: a Hertz contact with the instantaneous modulus, on a
/// groove under the line load F/L, whose depth differs by J₁ F/(2π L) ln|y/y'| between two places across. To first order the
/// depth of the body is the mean of the groove under the load of Hertz, `¾ (1 − y²)` across, with the load of a flat punch,
/// which is even across. Friction is that of what still changes, in proportion to 1/l.
#[test]
fn on_a_short_track_the_slow_element_carries_the_mean_load() {
    let (solid, track) = (rubber(1.2), 0.2);
    let glass = Elastic::new(1.2e6).expect("a modulus");
    let compliance = solid.creep().elements()[0].compliance;
    let radius = (3.0 / 16.0 * FORCE * RADIUS / 1.2e6).cbrt();
    let straight = under_force(FORCE, 1e3);
    let options = steady_grid(&ball(), &glass, &straight, 24).expect("a grid");
    let glassy = on_grid(&glass, &straight, &options).depth.reference_depth;
    // Both loads by the midpoint rule on strips.
    let strips = 400;
    let place = |index: i32| (f64::from(index) + 0.5) * 2.0 / f64::from(strips) - 1.0;
    let (mut mean, mut weights) = (0.0, 0.0);
    for (under, at) in (0..strips).flat_map(|under| (0..strips).map(move |at| (under, at))) {
        let y = place(under);
        let apart = (y - place(at)).abs().max(0.5 / f64::from(strips));
        let weight = 1.0 - y * y;
        mean -= weight * apart.ln();
        weights += weight;
    }
    let groove = compliance * FORCE / (2.0 * PI * track) * ((track / radius).ln() + mean / weights);
    let mut before = f64::INFINITY;
    for velocity in [1e2, 1e3, 1e4] {
        let state = on_grid(&solid, &on(under_force(FORCE, velocity), track), &options);
        let sunk = state.depth.reference_depth - glassy;
        let friction = state.friction_coefficient;
        let forgotten = track / (velocity * solid.creep().elements()[0].retardation_time);
        assert_close(velocity, sunk, groove, 2e-3 + 1e-2 * forgotten);
        assert!(
            friction > 0.0 && friction < 0.12 * before,
            "{velocity} m/s: {friction} after {before}"
        );
        before = friction;
    }
}

/// Slopes under the pressure and the dissipated power are the same friction, in plane strain and on layers too, and the bars
/// hold against a quarter of the error.
#[test]
fn both_frictions_agree_on_tracks_and_their_bars_hold() {
    let solid = rubber(8.0);
    let layer = Layer::new(&solid, 2e-3).expect("a thickness");
    let half_space = Layer::new(&solid, f64::INFINITY).expect("a half space");
    for (name, elastomer, velocity, track) in [
        ("half space", &half_space, 0.02, 12e-3),
        ("half space", &half_space, 0.2, 16e-3),
        ("half space", &half_space, 3.0, 12e-3),
        ("layer", &layer, 0.2, 12e-3),
    ] {
        let load = on(under_force(FORCE, velocity), track);
        let state = steady(&ball(), elastomer, &load, 1e-2).expect("a state");
        let better = steady(&ball(), elastomer, &load, 2.5e-3).expect("a state");
        let what = (name, velocity, track);
        let last = better.refinements.last().expect("a refinement");
        let [slopes, power] = [last.friction_coefficient, last.friction_from_dissipation];
        assert_close(what, slopes.value, power.value, 0.01);
        assert_bars_agree(
            what,
            state.friction_coefficient,
            better.friction_coefficient,
        );
        let depths = [&state, &better].map(|state| state.indentation_depth.expect("a depth"));
        assert_bars_agree(what, depths[0], depths[1]);
    }
}

/// In plane strain a constant in the potential is a constant in what the track has left.
#[test]
fn cylinders_meet_their_tracks_too() {
    let (roll, solid) = (Cylinder::new(RADIUS).expect("a roll"), rubber(8.0));
    let load = under_force(500.0, 0.1);
    let friction = |load: &SlidingLoad| {
        let state = steady(Line(&roll), &solid, load, 1e-3).expect("a state");
        state.friction_coefficient
    };
    let straight = friction(&load);
    let long = friction(&on(load, 10.0));
    assert_close("a long track", long.value, straight.value, 1e-6);
    let short = friction(&on(load, 15e-3));
    assert!(
        short.value < 0.99 * straight.value,
        "{short:?}, {straight:?}"
    );
    let elements = steady(
        Line(&roll),
        &solid,
        &on(load, 15e-3),
        Accuracy::Elements(96),
    );
    let elements = elements.expect("a state").friction_coefficient;
    assert_bars_agree("of given elements", elements, short);
}

#[test]
fn a_track_on_a_spring_has_no_memory() {
    let glass = Elastic::new(1e6).expect("a modulus");
    let straight = under_force(FORCE, 1.0);
    let options = steady_grid(&ball(), &glass, &straight, 16).expect("a grid");
    let states = [straight, on(straight, 0.1)].map(|load| on_grid(&glass, &load, &options));
    assert!(states[0] == states[1], "with and without a track");
}

#[test]
fn tracks_that_have_no_state_are_refused() {
    let (solid, load) = (rubber(4.0), under_force(FORCE, 0.1));
    let short = steady(&ball(), &solid, &on(load, 2e-3), 1e-2);
    let Err(BemError::TrackTooShort { track, needed }) = short else {
        panic!("{short:?}");
    };
    assert!(track < needed && needed < 2e-2, "{track}, {needed}");
    let fluid = Maxwell::new(1e6, 1e5).expect("a fluid");
    let flows = steady(&ball(), &fluid, &on(load, 0.1), 1e-2);
    assert!(matches!(flows, Err(BemError::NoCycle)), "{flows:?}");
    let refused = |error: BemError| {
        let is_track = matches!(error, BemError::Indenter(IndenterError::NoTrack { .. }));
        assert!(is_track, "{error}");
    };
    let marched = slide(&ball(), &solid, &on(load, 0.1), 1e-2);
    refused(marched.expect_err("a march"));
    let options = steady_grid(&ball(), &solid, &on(load, 0.1), 8).expect("a grid");
    let near = SteadySensitivity::new(&ball(), &solid, &on(load, 0.1), &options);
    let near = near.expect("derivatives");
    refused(near.by_moduli(&[1.0, 2.0]).expect_err("waves"));
}
