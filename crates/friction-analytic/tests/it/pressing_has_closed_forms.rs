//! The force of ramps of the depth on any material, the pressure under bodies of revolution, and thin layers.

use std::f64::consts::{PI, TAU};

use casebook::{NOT_POSITIVE, assert_close, model, prony, refused, refuses};
use friction_analytic::{
    DepthRamp, ThinLayer, impulse_to_depth, indentation_pressure, power_peak_pressure, ramp_force,
    winkler_line_force,
};
use indenters::{Axisymmetric, FlatPunch, Sphere, stretch};
use numerics::integrate;
use rheology::{Compressible, Material};

use crate::support::{power, viscous};

/// The force at a time, with a depth rate of 1.
fn force(exponent: f64, material: &dyn Material, time: f64) -> f64 {
    let indentation_depth = time;
    let ramp = DepthRamp {
        indentation_depth,
        time,
    };
    ramp_force(&power(0.4, exponent), material, ramp).unwrap()
}

/// M = 2 (y − 1 + e^(−y))/y² for a cone, and (1 − e^(−y))/y for the steepest profiles.
#[test]
fn ramps_of_cones_and_steep_profiles_have_elementary_forces() {
    let maxwell = prony([0.0, 0.0], &[(3.0, 0.5)]);
    let compressible = Compressible::new(&maxwell, 0.2).unwrap();
    for y in [1e-3_f64, 0.3, 4.0, 90.0, 1e6] {
        let elastic = |p| force(p, &prony([3.0, 0.0], &[]), 0.5 * y);
        let decay = -(-y).exp_m1();
        let cone = if y < 0.01 {
            1.0 - y / 3.0 + y * y / 12.0
        } else {
            2.0 * (y - decay) / (y * y)
        };
        assert_close!(force(1.0, &maxwell, 0.5 * y) => cone * elastic(1.0), within 1e-10; "{y}");
        assert_close!(force(1.0, &compressible, 0.5 * y) => cone * elastic(1.0) / 1.6, within 1e-10; "{y}");
        assert_close!(force(1e9, &maxwell, 0.5 * y) => decay / y * elastic(1e9), within 1e-7; "{y}");
    }
}

/// The impulse of a ramp on a dashpot is that to its depth, and on a branch F + τ dF/dt = τ dF_e/dt.
#[test]
fn ramps_satisfy_the_rate_equation_of_their_material() {
    for p in [0.3, 1.5, 2.0, 7.0] {
        // F ~ t^(1/p).
        let impulse = 0.7 * force(p, &viscous(2.0), 0.7) * p / (p + 1.0);
        let expected = impulse_to_depth(&power(0.4, p), &viscous(2.0), 0.7).unwrap();
        assert_close!(impulse => expected, within 1e-10; "{p}");
        let [elastic, maxwell] = [prony([3.0, 0.0], &[]), prony([0.0, 0.0], &[(3.0, 0.5)])];
        let both = prony([3.0, 0.0], &[(3.0, 0.5)]);
        for time in [0.02, 0.4, 5.0] {
            let rate = |material| {
                let step = 1e-4 * time;
                (force(p, material, time + step) - force(p, material, time - step)) / (2.0 * step)
            };
            let left = force(p, &maxwell, time) + 0.5 * rate(&maxwell);
            assert_close!(left => 0.5 * rate(&elastic), within 1e-6; "{p}, {time}");
            let sum = force(p, &elastic, time) + force(p, &maxwell, time);
            assert_close!(force(p, &both, time) => sum, within 1e-14; "{p}, {time}");
        }
    }
}

#[test]
fn pressures_are_those_of_hertz_and_sneddon() {
    let middle = indentation_pressure(&power(0.5, 2.0), 1.0, 0.0).unwrap();
    assert_close!(middle => 8.0 / PI, within 1e-12);
    for r in [1e-6_f64, 0.2, 0.9, 0.999] {
        let root = ((1.0 - r) * (1.0 + r)).sqrt();
        // h = r²/2 is 1 deep with a = 1: (4/π) ∫ 2x dx/√(x² − r²).
        let paraboloid = indentation_pressure(&power(0.5, 2.0), 1.0, r).unwrap();
        assert_close!(paraboloid => 8.0 / PI * root, within 1e-10; "{r}");
        // h = r is π/2 deep: (4/π) (π/2) arcosh(1/r).
        let cone = indentation_pressure(&power(1.0, 1.0), 0.5 * PI, r).unwrap();
        assert_close!(cone => 2.0 * r.recip().acosh(), within 1e-9; "{r}");
        let punch = indentation_pressure(&FlatPunch::new(1.0).unwrap(), 0.3, r).unwrap();
        assert_close!(punch => 1.2 / PI / root, within 1e-10; "{r}");
    }
}

/// f(ρ) of [`power_peak_pressure`] is √2/3 at ρ = 1/√2 for p = 4, and Dawson's function √(2/p) 0.541… for p → ∞.
#[test]
fn the_largest_pressure_of_a_steep_power_is_off_the_axis() {
    let peak = |p: f64| power_peak_pressure(&power(stretch(p).unwrap().recip(), p), 1.0).unwrap();
    for (p, f) in [(1.5, 2.0), (2.0, 1.0), (4.0, 2.0_f64.sqrt() / 3.0)] {
        assert_close!(peak(p) => 4.0 / PI * p * f, within 1e-12; "{p}");
    }
    let steep = 4.0 / PI * 2e12_f64.sqrt() * 0.541_044_224_635_181_7;
    assert_close!(peak(1e12) => steep, within 1e-9);
    for p in [1.1, 2.001, 2.5, 3.0, 9.0, 60.0] {
        let body = power(stretch(p).unwrap().recip(), p);
        let pressure = |i: u32| indentation_pressure(&body, 1.0, 1e-3 * f64::from(i)).unwrap();
        let sampled = (0..1000).map(pressure).fold(0.0, f64::max);
        let excess = peak(p) / sampled - 1.0;
        assert!(
            (-1e-12..1e-3).contains(&excess),
            "p = {p}: {excess:e} above samples"
        );
    }
    refused("exponent", power_peak_pressure(&power(0.4, 1.0), 1.0));
    refuses("contact_radius", NOT_POSITIVE, |radius| {
        power_peak_pressure(&power(0.4, 3.0), radius)
    });
}

#[test]
fn the_pressure_carries_the_force() {
    let sphere = Sphere::new(1.0).unwrap();
    let bodies: [&dyn Axisymmetric; 3] = [&sphere, &power(2.0, 0.8), &power(0.4, 5.0)];
    for body in bodies {
        let radius = indenters::contact_radius(body, 0.2).unwrap();
        let ring = |r: f64| TAU * r * indentation_pressure(body, 0.2, r).unwrap();
        // The pressure vanishes at the edge, where the radius is rounded.
        let force = integrate(ring, [0.0, radius * (1.0 - 1e-9)], 1e-10).value;
        let expected = impulse_to_depth(body, &viscous(1.0), 0.2).unwrap();
        assert_close!(force => expected, within 1e-7; "{}", body.profile_exponent());
    }
}

#[test]
fn pressing_refuses_what_has_no_number() {
    let cone = power(1.0, 1.0);
    for radius in [0.0, -1.0, f64::NAN, 1.0] {
        refused("radius", indentation_pressure(&cone, 0.5 * PI, radius));
    }
    let p10 = model("P10");
    let ramp = |indentation_depth, time| {
        let ramp = DepthRamp {
            indentation_depth,
            time,
        };
        ramp_force(&cone, &p10, ramp)
    };
    refuses("time", NOT_POSITIVE, |time| ramp(1.0, time));
    refuses("indentation_depth", NOT_POSITIVE, |depth| ramp(depth, 1.0));
}

/// F = 2π K ∫ (d − h) r dr on the foundation. In the film p' = −(3G/t³) (1/r) ∫₀^r (d − h) s ds, and F = −π ∫ p' r² dr.
#[test]
fn thin_layers_carry_what_their_equations_say() {
    let layer = |poisson_ratio| ThinLayer::new(3.0, poisson_ratio, 0.2);
    let [foundation, film] = [0.2, 0.5].map(|ratio| layer(ratio).unwrap());
    for p in [0.7, 2.0, 5.0] {
        let (profile, depth) = (power(0.4, p), 0.05);
        let height = |r: f64| profile.profile_height(r);
        let pressure = |r: f64| TAU * r * 40.0 * (depth - height(r));
        let flow = |r: f64| PI * r.powi(3) * 1125.0 * (0.5 * depth - height(r) / (p + 2.0));
        let [pressed, squeezed] = [
            foundation.press_winkler(&profile, depth).unwrap(),
            film.press_film(&profile, depth).unwrap(),
        ];
        for (state, integrand) in [
            (pressed, &pressure as &dyn Fn(f64) -> f64),
            (squeezed, &flow),
        ] {
            let end = state.contact_radius;
            assert!(
                integrand(end).abs() < 1e-12,
                "{state:?} ends where p = {p} does not"
            );
            let force = integrate(integrand, [0.0, end], 1e-12).value;
            assert_close!(state.normal_force => force, within 1e-10; "{p}");
        }
    }
    let dashpot = Compressible::new(&viscous(1.0), 0.2).unwrap();
    let line = winkler_line_force(&dashpot, 0.2, 7.0);
    assert_close!(line.unwrap() => 7.0 * 0.6 * 0.2 / 0.64, within 1e-15);
    refuses("poisson_ratio", &[-1.0, 0.500_1, f64::NAN], layer);
    refused(
        "poisson_ratio",
        foundation.press_film(&power(1.0, 2.0), 1.0),
    );
    refused("poisson_ratio", film.winkler_modulus());
}
