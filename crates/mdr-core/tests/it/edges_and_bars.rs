//! No body is pressed deeper than its profile exists, springs have no friction, and bars hold.

use friction_analytic::transient_sliding;
use indenters::{
    Axisymmetric, Control, EquivalentLine, FlatPunch, Hyperboloid, PiecewiseLinearProfile,
    PowerProfile, PressingLoad, RigidLine, RoundTippedCone, SlidingLoad, Sphere, contact_radius,
};
use mdr_core::{MdrError, indent, press, slide, steady};
use numerics::{Accuracy, Estimate};
use proptest::prelude::*;
use rheology::{Compressible, Elastic, Material, Prony, Springpot, Viscous};

use crate::support::{
    Line, assert_agree, assert_close, at_depth, body, decades, fixed_cases, last, load, named,
    power, prony, slid,
};

fn spring(modulus: f64) -> Elastic {
    Elastic::new(modulus).expect("a spring")
}

fn is_edge(error: &MdrError) -> bool {
    matches!(
        error,
        MdrError::ForceBeyondEdge { .. }
            | MdrError::DepthBeyondEdge { .. }
            | MdrError::ContactReachesEdge { .. }
    )
}

/// A modulus of 1 Pa where 1 MPa was meant: a depth of 50 m, and a friction coefficient of 2491, was answered once.
#[test]
fn no_body_is_pressed_beyond_its_edge() {
    let table = PiecewiseLinearProfile::new(vec![0.0, 0.005], vec![0.0, 0.001]);
    let bodies: [Box<dyn Axisymmetric>; 3] = [
        Box::new(Sphere::new(0.005).expect("a sphere")),
        Box::new(table.expect("a cone")),
        Box::new(FlatPunch::new(0.005).expect("a punch")),
    ];
    let (force, sliding) = (Control::NormalForce(2.0), load(2.0, 0.01));
    let deep = at_depth(50.0, 0.01);
    let pressing = PressingLoad::new(force, 1.0).expect("a load");
    for (body, modulus) in bodies.iter().zip([1.0, 316.0, 1.0]) {
        let (line, spring) = (EquivalentLine(&**body), spring(modulus));
        for (method, error) in [
            ("steady", steady(&line, &spring, &sliding, 1e-3).err()),
            ("at depth", steady(&line, &spring, &deep, 1e-3).err()),
            ("slide", slide(&line, &spring, &sliding, 1e-3).err()),
            ("indent", indent(&line, &spring, &pressing, 1e-3).err()),
            ("press", press(&line, &spring, force, 1e-3).err()),
        ] {
            let error = error.unwrap_or_else(|| panic!("{method} answered"));
            let named = error.to_string().contains("edge at position 0.005");
            assert!(is_edge(&error) && named, "{method}: {error:?}");
        }
    }
}

/// Compares a march with the stationary state under the force that belongs to a depth, or under a force.
fn bar_holds(
    body: &dyn Axisymmetric,
    material: &dyn Material,
    motion: &SlidingLoad,
    elements: usize,
) {
    let line = EquivalentLine(body);
    let Ok(exact) = steady(&line, material, motion, 1e-7) else {
        return;
    };
    let load = load(exact.normal_force.value, motion.velocity());
    let Ok(got) = slide(&line, material, &load, Accuracy::Elements(elements)) else {
        return;
    };
    let [rear, front] = got.ends;
    let (friction, depth) = (got.friction_coefficient, got.indentation_depth);
    let estimates = [friction, depth, got.normal_force, rear, front];
    for (got, (name, exact)) in estimates.into_iter().zip(named(&exact)) {
        assert_agree([got, exact], &(name, elements));
    }
}

/// A tip, or a part of the contact behind the lowest point, that no element of a few resolutions sees.
#[test]
fn bars_hold_what_is_shorter_than_one_element() {
    let sphere = Sphere::new(0.44).expect("a sphere");
    let hyperboloids = [[5.3365, 0.18575], [0.0215, 0.0813], [0.215, 0.3267]]
        .map(|[radius, slope]| Hyperboloid::new(radius, slope).expect("a hyperboloid"));
    let [wide, sharp, tip] = &hyperboloids;
    let round = RoundTippedCone::new(0.01736, 0.5792).expect("a cone");
    let kelvin_voigt = |[modulus, viscosity]: [f64; 2]| prony([modulus, viscosity], &[]);
    let fluid = |viscosity: f64, branches: &[(f64, f64)]| prony([0.0, viscosity], branches);
    let flowing = fluid(0.011, &[(0.3707, 1.011), (0.2736, 1.306)]);
    let cone = PowerProfile::cone(0.0131).expect("a cone");
    // It leaves the contact just behind the tip.
    let springpot = Springpot::new(1.006e-3, 0.831).expect("a springpot");
    let springpot = springpot.expand([6e-5, 60.0], 1e-6).expect("a series");
    let springpot = Prony::new(springpot.spectrum).expect("a material");
    let cases: [(&dyn Axisymmetric, Prony, [f64; 2]); 6] = [
        (&cone, springpot, [2.9e-6, 2.44]),
        (
            wide,
            kelvin_voigt([166_537.0, 15_146.0]),
            [220_535.0, 276.2],
        ),
        (&sphere, kelvin_voigt([1.158, 1.3245]), [0.0157, 2.636]),
        (sharp, fluid(0.936, &[]), [0.0657, 0.0186]),
        (tip, flowing, [0.6189, 0.00556]),
        (&round, fluid(0.189, &[(0.354, 0.0104)]), [0.339, 0.0355]),
    ];
    for (body, material, [force, velocity]) in cases {
        for elements in [16, 17, 40] {
            bar_holds(body, &material, &load(force, velocity), elements);
        }
    }
}

/// A distance that is shorter than the contact, or its element, is divided into steps too: twice the friction was known to
/// 13 digits once.
#[test]
fn distances_are_slid_exactly_and_bars_see_their_steps() {
    let (dashpot, motion) = (Viscous::new(2.0).expect("a material"), load(0.8, 0.5));
    for (exponent, part) in [1.0, 2.0]
        .into_iter()
        .flat_map(|exponent| [3e-3, 0.05, 0.17, 0.3, 1.0, 7.3, 120.0].map(|part| (exponent, part)))
    {
        let body = PowerProfile::new(0.3, exponent).expect("a body");
        let distance = part * body.line_position(0.2);
        let exact = transient_sliding(&body, &dashpot, &motion, distance / motion.velocity());
        let exact = exact.expect("a closed form");
        let load = motion.after(distance).expect("a distance");
        let line = EquivalentLine(&body);
        for accuracy in [0.1, 1e-2, 2e-3] {
            let got = slide(&line, &dashpot, &load, accuracy).expect("a march");
            let case = (exponent, part, accuracy);
            for (got, exact) in [
                (got.friction_coefficient, exact.friction_coefficient),
                (got.indentation_depth, exact.indentation_depth),
                (got.ends[0], exact.contact_line[0]),
                (got.ends[1], exact.contact_line[1]),
            ] {
                assert_agree([got, Estimate::exact(exact)], &case);
            }
            // Once stationary it stays.
            let slid = last(&got).sliding_distance;
            if got.error_parts.truncation.is_none() {
                assert_close([slid, distance], 1e-14, 0.0, &case);
            }
        }
    }
}

proptest! {
    #![proptest_config(fixed_cases(64))]

    #[test]
    fn springs_have_no_friction(
        kind in 0..6_usize,
        size in decades(2.0),
        depth in decades(1.0),
        units in [decades(6.0), decades(6.0), decades(6.0)],
        poisson_ratio in 0.0..0.5_f64,
    ) {
        let [length, modulus, velocity] = units;
        let body = body(kind, size, length);
        let (line, spring) = (EquivalentLine(&*body), spring(modulus));
        let spring = Compressible::new(&spring, poisson_ratio).expect("a material");
        let none = Estimate::exact(0.0);
        let state = slid(&line, &spring, &at_depth(depth * length, velocity));
        prop_assert_eq!(state.friction_coefficient, none, "steady at a depth");
        let load = load(state.normal_force.value, velocity);
        let state = slid(&line, &spring, &load);
        prop_assert_eq!(state.friction_coefficient, none, "steady under a force");
        match slide(&line, &spring, &load, Accuracy::Elements(32)) {
            Ok(state) => prop_assert_eq!(state.friction_coefficient, none, "slide"),
            // Few elements are wider than what is left up to the equator.
            Err(error) => prop_assert!(kind == 0 && is_edge(&error), "slide: {error:?}"),
        }
        let pressed = press(&line, &spring, load.control(), 1e-6).expect("a contact");
        assert_close([pressed.indentation_depth.value, depth * length], 1e-5, 0.0, &pressed);
    }

    /// Elements and steps much longer than the edge of a flat end and the shortest relaxation leave a bar that holds.
    #[test]
    fn bars_of_flat_ends_hold_where_no_step_resolves_the_relaxation(
        kind in 4..6_usize,
        size in decades(2.0),
        depth in decades(2.0),
        branches in prop::collection::vec((decades(2.5), decades(3.5)), 1..3),
        elements in prop::sample::select(vec![16_usize, 32, 64, 128]),
    ) {
        let body = body(kind, size, 1.0);
        let spacing = 2.0 * contact_radius(&*body, depth).expect("a radius") / elements as f64;
        let branches: Vec<(f64, f64)> = branches.iter().map(|(g, tau)| (*g, tau * spacing)).collect();
        bar_holds(&*body, &prony([1.0, 0.0], &branches), &at_depth(depth, 1.0), elements);
    }

    /// Polynomials, rounding of positions and slivers of contact: what they do to a state is within its bar. Kinks that are
    /// none make other polynomials of the same line.
    #[test]
    fn bars_hold_for_other_pieces_of_the_same_line(
        kind in 0..6_usize,
        size in decades(2.0),
        depth in decades(1.0),
        velocity in decades(3.0),
        viscosity in decades(2.0),
        branches in prop::collection::vec((decades(2.0), decades(4.0)), 0..3),
        at in prop::collection::vec(-1.0..1.0_f64, 5),
    ) {
        let viscosity = if kind < 4 { viscosity } else { 0.0 };
        prop_assume!(viscosity > 0.0 || !branches.is_empty());
        let body = body(kind, size, 1.0);
        let material = prony([1.0, viscosity], &branches);
        let radius = contact_radius(&*body, depth).expect("a radius");
        let line = EquivalentLine(&*body);
        let mut kinks = line.kinks();
        kinks.extend(at.iter().map(|x| x * radius));
        kinks.sort_by(f64::total_cmp);
        let broken = Line { height: |x: f64| line.height(x), domain: line.domain(), kinks };
        let load = at_depth(depth, velocity);
        for asked in [1e-3, 1e-6, 1e-10] {
            let one = steady(&line, &material, &load, asked);
            let other = steady(&broken, &material, &load, asked);
            let (Ok(one), Ok(other)) = (one, other) else { continue };
            for (one, other) in named(&one).into_iter().zip(named(&other)) {
                assert_agree([one.1, other.1], &(one.0, asked));
            }
        }
    }
}

/// F_N = 8 G d a p/(p + 1), the elastic contact of a power, and a force that relaxes to it.
#[test]
fn a_power_at_rest_is_an_elastic_contact() {
    for material in [prony([3.0, 0.0], &[]), prony([3.0, 1.0], &[(50.0, 0.1)])] {
        for exponent in [0.4, 1.0, 2.0, 5.0] {
            let (body, depth) = (power(exponent), 0.04);
            let control = Control::IndentationDepth(depth);
            let pressed = press(&EquivalentLine(&body), &material, control, 1e-8);
            let pressed = pressed.expect("a contact");
            let radius = body.line_position(depth);
            let force = 8.0 * 3.0 * depth * radius * exponent / (exponent + 1.0);
            for (actual, expected) in [
                (pressed.normal_force, force),
                (pressed.ends[0], -radius),
                (pressed.ends[1], radius),
            ] {
                assert_agree([actual, Estimate::exact(expected)], &(exponent, &material));
            }
        }
    }
    let fluid = prony([0.0, 0.0], &[(1.0, 1.0)]);
    let (body, force) = (power(2.0), Control::NormalForce(1.0));
    let refused = press(&EquivalentLine(&body), &fluid, force, 1e-3);
    assert_eq!(refused, Err(MdrError::NoEquilibrium), "a fluid at rest");
}
