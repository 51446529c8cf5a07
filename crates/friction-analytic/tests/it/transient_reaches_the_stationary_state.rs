use casebook::{Case, assert_close, assert_matches};
use friction_analytic::{
    FrictionError, cone_depth_by_equation_15, power_sliding, sinking_velocity,
    sliding_distance_to_depth, stationary_depth, transient_sliding,
};
use indenters::{Axisymmetric, EquivalentLine, PowerProfile, SlidingLoad};
use rheology::Viscous;

use crate::support::{sliding, with_depth};

/// The rows give the line, s |x| or k x²; the body is flatter by κ.
fn profile(case: &Case) -> PowerProfile {
    if case.input_text("shape") == "cone" {
        return PowerProfile::cone(case.input("s") / std::f64::consts::FRAC_PI_2).unwrap();
    }
    PowerProfile::paraboloid(case.input("k") / 2.0).unwrap()
}

fn cone_and_paraboloid() -> [PowerProfile; 2] {
    [PowerProfile::cone(0.3), PowerProfile::paraboloid(2.0)].map(Result::unwrap)
}

#[test]
fn depth_friction_and_contact_match_the_exact_solution() {
    for case in casebook::group("MDR-02") {
        if !case.has_input("shape") {
            continue;
        }
        let profile = profile(&case);
        let (material, load) = sliding(&case);
        let state = transient_sliding(&profile, &material, &load, case.input("t")).unwrap();
        case.check("d", state.indentation_depth);
        case.check("mu", state.friction_coefficient);
        case.check("x_trail", state.contact_line[0]);
        // Where Eq. (8) takes the line to the depth.
        assert_close!(
            profile.line_height(state.contact_line[1]) => state.indentation_depth,
            within 1e-13
        );
        if case.expected("d_eq15").is_some() {
            let depth =
                cone_depth_by_equation_15(&profile, &material, &load, case.input("t")).unwrap();
            case.check("d_eq15", depth);
        }
    }
}

#[test]
fn distance_to_99_percent_matches() {
    let case = casebook::group("MDR-02")
        .into_iter()
        .find(|case| !case.has_input("shape"));
    let case = case.expect("the group has the row of the 99 per cent distance");
    let (material, load) = with_depth(0.1);
    let names = ["cone_vt_over_xd", "paraboloid_vt_over_xd"];
    for (name, profile) in names.into_iter().zip(cone_and_paraboloid()) {
        let distance = sliding_distance_to_depth(&profile, &material, &load, 0.99).unwrap();
        let length = profile.line_position(stationary_depth(&material, &load));
        case.check(name, distance / length);
    }
}

#[test]
fn distance_and_depth_are_inverse() {
    let (material, load) = with_depth(0.1);
    for profile in cone_and_paraboloid() {
        let (early, late) = (
            [0.0, 1e-9, 0.1, 0.25, 0.25001],
            [0.4, 0.5, 0.50001, 0.9, 0.99],
        );
        for fraction in early.into_iter().chain(late).chain([1.0 - 1e-6]) {
            let distance = sliding_distance_to_depth(&profile, &material, &load, fraction).unwrap();
            let time = distance / load.velocity();
            let state = transient_sliding(&profile, &material, &load, time).unwrap();
            let what = format!("d/D after {distance} with p = {}", profile.exponent());
            assert_close!(state.indentation_depth => fraction * 0.1, within 1e-13; "{what}");
        }
        for fraction in [-0.1, 1.0, f64::NAN] {
            let result = sliding_distance_to_depth(&profile, &material, &load, fraction);
            assert_matches!(
                result,
                Err(FrictionError::InvalidParameter {
                    parameter: "fraction",
                    ..
                }),
                "fraction {fraction}"
            );
        }
    }
}

/// The balance that the solution was derived from: the rate of the depth is the sinking velocity of the contact, and
/// friction is the moment ∫ 4 η (v_z + v h̃') h̃' dx over it.
#[test]
fn the_exact_solution_satisfies_the_balance_of_forces() {
    let (material, load) = with_depth(0.1);
    let v = load.velocity();
    for profile in cone_and_paraboloid() {
        let length = profile.line_position(0.1);
        for slid in [0.01, 0.1, 0.16, 0.3, 1.0, 3.0] {
            let time = slid * length / v;
            let at = |time: f64| transient_sliding(&profile, &material, &load, time).unwrap();
            let state = at(time);
            let velocity = sinking_velocity(
                &EquivalentLine(&profile),
                &[state.contact_line],
                &material,
                &load,
            )
            .unwrap();
            let step = 1e-5 * time;
            let rate = (at(time + step).indentation_depth - at(time - step).indentation_depth)
                / (2.0 * step);
            let what = format!("dd/dt at v t/x_d = {slid}, p = {}", profile.exponent());
            // Central difference: 1e-10 from the step, 1e-16/1e-5 from rounding, over a rate that has fallen to e^-3.
            assert_close!(rate => velocity, within 1e-9; "{what}");
            let friction = friction_of(&profile, &material, &load, (state.contact_line, velocity));
            let what = format!("μ at v t/x_d = {slid}, p = {}", profile.exponent());
            assert_close!(state.friction_coefficient => friction, within 1e-11; "{what}");
        }
    }
}

fn friction_of(
    profile: &PowerProfile,
    material: &Viscous,
    load: &SlidingLoad,
    ([rear, front], velocity): ([f64; 2], f64),
) -> f64 {
    let force = |x: f64| {
        let slope = profile.line_slope(x);
        4.0 * material.viscosity() * (velocity + load.velocity() * slope) * slope
    };
    let part = |interval| numerics::integrate(force, interval, 1e-13).value;
    let behind = if rear < 0.0 { part([rear, 0.0]) } else { 0.0 };
    (behind + part([0.0, front])) / load.normal_force().expect("a force")
}

#[test]
fn late_and_early_times_keep_their_digits() {
    let (material, load) = with_depth(0.1);
    for profile in cone_and_paraboloid() {
        let stationary = power_sliding(&profile, &material, &load).unwrap();
        let length = stationary.contact_length();
        let late =
            transient_sliding(&profile, &material, &load, 1e6 * length / load.velocity()).unwrap();
        assert_close!(late.indentation_depth => stationary.indentation_depth, within 1e-15);
        assert_close!(late.friction_coefficient => stationary.friction_coefficient, within 1e-14);
        let endless = transient_sliding(&profile, &material, &load, f64::MAX).unwrap();
        assert_eq!(endless, late, "after the longest time");
        let start = transient_sliding(&profile, &material, &load, 0.0).unwrap();
        assert_eq!(
            start.indentation_depth.to_bits(),
            0,
            "depth at the start: {start:?}"
        );
        // d ~ t^(p/(p + 1)) while sliding is slower than sinking.
        let [first, second] = [1e-30, 1e-28].map(|slid| {
            let time = slid * length / load.velocity();
            transient_sliding(&profile, &material, &load, time)
                .unwrap()
                .indentation_depth
        });
        let p = profile.exponent();
        assert_close!(second / first => 100_f64.powf(p / (p + 1.0)), within 1e-13);
    }
}

/// The paper's Eq. (15) from first touch: twice the compression is fed, so √2 times the depth at early times; the same
/// depth at late ones.
#[test]
fn equation_15_overestimates_early_depths_by_root_two() {
    let (material, load) = with_depth(0.1);
    let cone = PowerProfile::cone(0.3).unwrap();
    let length = cone.line_position(0.1);
    for slid in [1e-14_f64, 1e-10, 1e-6, 40.0] {
        // −q − ln(1 − q) = T means q = √(2T) − 2T/3 + O(T^(3/2)), beside q = √T of the exact solution.
        let root = (2.0 * slid).sqrt();
        let (expected, tolerance) = if slid < 1.0 {
            (2_f64.sqrt() * (1.0 - root / 3.0), slid + 1e-14)
        } else {
            (1.0, 1e-15)
        };
        let time = slid * length / load.velocity();
        let printed = cone_depth_by_equation_15(&cone, &material, &load, time).unwrap();
        let exact = transient_sliding(&cone, &material, &load, time)
            .unwrap()
            .indentation_depth;
        assert_close!(printed / exact => expected, within tolerance; "ratio at v t/x_d = {slid:e}");
    }
}

#[test]
fn other_profiles_and_bad_times_are_refused() {
    let (material, load) = with_depth(0.1);
    for p in [0.5, 1.5, 2.000_000_1, 3.0] {
        let profile = PowerProfile::new(1.0, p).unwrap();
        let results = [
            transient_sliding(&profile, &material, &load, 1.0).map(|_| ()),
            sliding_distance_to_depth(&profile, &material, &load, 0.5).map(|_| ()),
            cone_depth_by_equation_15(&profile, &material, &load, 1.0).map(|_| ()),
        ];
        for result in results {
            assert_matches!(
                result,
                Err(FrictionError::UnsupportedExponent { .. }),
                "p = {p}"
            );
        }
    }
    let paraboloid = PowerProfile::paraboloid(1.0).unwrap();
    let result = cone_depth_by_equation_15(&paraboloid, &material, &load, 1.0);
    assert_matches!(result, Err(FrictionError::UnsupportedExponent { .. }));
    let cone = PowerProfile::cone(1.0).unwrap();
    for time in [-1.0, f64::NAN, f64::INFINITY] {
        for result in [
            transient_sliding(&cone, &material, &load, time).map(|_| ()),
            cone_depth_by_equation_15(&cone, &material, &load, time).map(|_| ()),
        ] {
            assert_matches!(
                result,
                Err(FrictionError::InvalidParameter {
                    parameter: "time",
                    ..
                }),
                "time {time}"
            );
        }
    }
}
