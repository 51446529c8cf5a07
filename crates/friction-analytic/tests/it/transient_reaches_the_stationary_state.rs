use casebook::assert_close;
use friction_analytic::{
    TransientSliding, cone_depth_by_equation_15, power_sliding, sliding_distance_to_depth,
    transient_sliding,
};
use indenters::{Axisymmetric, PowerProfile};

use crate::support::{power, sliding, with_depth};

/// Stationary depth of the scenes, in which 4 η v = 1 and v = 1/2.
const DEPTH: f64 = 0.1;
const VELOCITY: f64 = 0.5;

fn cone_and_paraboloid() -> [PowerProfile; 2] {
    [power(0.3, 1.0), power(2.0, 2.0)]
}

/// The state after a sliding distance, in stationary contact lengths.
fn after(profile: &PowerProfile, slid: f64) -> TransientSliding {
    at(profile, slid * profile.line_position(DEPTH) / VELOCITY)
}

fn at(profile: &PowerProfile, time: f64) -> TransientSliding {
    let (material, load) = with_depth(DEPTH);
    transient_sliding(profile, &material, &load, time).unwrap()
}

fn distance(profile: &PowerProfile, fraction: f64) -> f64 {
    let (material, load) = with_depth(DEPTH);
    let distance = sliding_distance_to_depth(profile, &material, &load, fraction);
    distance.unwrap() / profile.line_position(DEPTH)
}

#[test]
fn depth_friction_and_contact_match_the_exact_solution() {
    for case in casebook::group("MDR-02") {
        let profile = match case.input_text("shape") {
            "" => {
                // The row of the 99 per cent distance.
                let [cone, paraboloid] =
                    cone_and_paraboloid().map(|profile| distance(&profile, 0.99));
                case.check("cone_vt_over_xd", cone);
                case.check("paraboloid_vt_over_xd", paraboloid);
                continue;
            }
            // The rows give the line, s |x| or k x²; the body is flatter by κ.
            "cone" => power(case.input("s") / std::f64::consts::FRAC_PI_2, 1.0),
            _ => power(case.input("k") / 2.0, 2.0),
        };
        let ((material, load), time) = (sliding(&case), case.input("t"));
        let state = transient_sliding(&profile, &material, &load, time).unwrap();
        case.check("d", state.indentation_depth);
        case.check("mu", state.friction_coefficient);
        case.check("x_trail", state.contact_line[0]);
        // Where Eq. (8) takes the line to the depth.
        let height = profile.line_height(state.contact_line[1]);
        assert_close!(height => state.indentation_depth, within 1e-13; "{}", case.id());
        if case.expected("d_eq15").is_some() {
            let depth = cone_depth_by_equation_15(&profile, &material, &load, time).unwrap();
            case.check("d_eq15", depth);
        }
    }
}

#[test]
fn distance_and_depth_are_inverse() {
    for profile in cone_and_paraboloid() {
        for fraction in [
            0.0, 1e-9, 0.1, 0.25, 0.25001, 0.4, 0.5, 0.50001, 0.9, 0.99, 0.999_999,
        ] {
            let depth = after(&profile, distance(&profile, fraction)).indentation_depth;
            assert_close!(depth => fraction * DEPTH, within 1e-13; "p = {}", profile.exponent());
        }
    }
}

#[test]
fn late_and_early_times_keep_their_digits() {
    let (material, load) = with_depth(DEPTH);
    for profile in cone_and_paraboloid() {
        let stationary = power_sliding(&profile, &material, &load).unwrap();
        let late = after(&profile, 1e6);
        assert_close!(late.indentation_depth => stationary.indentation_depth, within 1e-15);
        assert_close!(late.friction_coefficient => stationary.friction_coefficient, within 1e-14);
        assert_eq!(at(&profile, f64::MAX), late, "after the longest time");
        let start = at(&profile, 0.0).indentation_depth;
        assert_eq!(start.to_bits(), 0, "depth at the start: {start:?}");
        // d ~ t^(p/(p + 1)) while sliding is slower than sinking.
        let [first, second] = [1e-30, 1e-28].map(|slid| after(&profile, slid).indentation_depth);
        let p = profile.exponent();
        assert_close!(second / first => 100_f64.powf(p / (p + 1.0)), within 1e-13);
    }
}

/// The paper's Eq. (15) from first touch: twice the compression is fed, so √2 times the depth at early times; the same
/// depth at late ones.
#[test]
fn equation_15_overestimates_early_depths_by_root_two() {
    let (material, load) = with_depth(DEPTH);
    let [cone, _] = cone_and_paraboloid();
    for slid in [1e-14_f64, 1e-10, 1e-6, 40.0] {
        // −q − ln(1 − q) = T means q = √(2T) − 2T/3 + O(T^(3/2)), beside q = √T of the exact solution.
        let root = (2.0 * slid).sqrt();
        let (expected, tolerance) = if slid < 1.0 {
            (2_f64.sqrt() * (1.0 - root / 3.0), slid + 1e-14)
        } else {
            (1.0, 1e-15)
        };
        let time = slid * cone.line_position(DEPTH) / VELOCITY;
        let printed = cone_depth_by_equation_15(&cone, &material, &load, time).unwrap();
        let exact = at(&cone, time).indentation_depth;
        assert_close!(printed / exact => expected, within tolerance; "v t/x_d = {slid:e}");
    }
}
