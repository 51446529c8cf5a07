use casebook::{assert_matches, prony, superposition};
use friction_analytic::{
    ElasticContact, FrictionError, SlidingContact, SurfaceWave, cone_depth_by_equation_15,
    cylinder_half_width_after_impulse, high_speed_friction, impulse_to_depth,
    indentation_after_impulse, kelvin_voigt_sliding, low_speed_friction,
    power_indentation_after_impulse, power_sliding, sliding_distance_to_depth, stationary_depth,
    transient_sliding, wavy_surface_sliding,
};
use indenters::{Cylinder, IndenterError, Sphere};
use rheology::{KelvinVoigt, Prony};

use crate::support::{assert_refused, material_and_load, power, viscous, with_depth};

fn solid() -> Prony {
    prony([1.0, 0.0], &[(2.0, 1.5)])
}

#[test]
fn numbers_that_are_negative_or_not_finite_are_named() {
    let ((material, load), cone) = (with_depth(0.1), power(1.0, 1.0));
    let cylinder = Cylinder::new(0.01).unwrap();
    for bad in [-1.0, f64::NAN, f64::INFINITY] {
        assert_refused(
            "impulse",
            power_indentation_after_impulse(&cone, &material, bad),
        );
        assert_refused("impulse", indentation_after_impulse(&cone, &material, bad));
        let width = cylinder_half_width_after_impulse(&cylinder, &material, bad);
        assert_refused("impulse_per_length", width);
        assert_refused("time", transient_sliding(&cone, &material, &load, bad));
        assert_refused(
            "time",
            cone_depth_by_equation_15(&cone, &material, &load, bad),
        );
        for fraction in [bad, 1.0] {
            let distance = sliding_distance_to_depth(&cone, &material, &load, fraction);
            assert_refused("fraction", distance);
        }
    }
}

#[test]
fn numbers_that_must_be_positive_are_named() {
    let wave = |name: &str, amplitude: f64, wave_vector: [f64; 2]| {
        let wave = SurfaceWave {
            amplitude,
            wave_vector,
        };
        assert_refused(name, wavy_surface_sliding(&[wave], &solid(), 1.0));
    };
    let contact = |name: &str, front: f64, velocity: f64| {
        let foundation = KelvinVoigt::new(1.0, 1.0).unwrap();
        let on_line = SlidingContact { front, velocity };
        assert_refused(
            name,
            kelvin_voigt_sliding(&power(1.0, 1.0), &foundation, on_line),
        );
    };
    let elastic = |name: &str, contact_radius: f64, velocity: f64| {
        let contact = ElasticContact {
            contact_radius,
            velocity,
        };
        let sphere = Sphere::new(2.0).unwrap();
        assert_refused(name, low_speed_friction(&sphere, &solid(), contact));
        assert_refused(name, high_speed_friction(&sphere, &solid(), contact));
    };
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert_refused(
            "depth",
            impulse_to_depth(&power(1.0, 1.0), &viscous(1.0), bad),
        );
        elastic("velocity", 0.5, bad);
        elastic("contact_radius", bad, 1.0);
        contact("velocity", 1.0, bad);
        contact("front", bad, 1.0);
        wave("amplitude", bad, [1.0, 0.0]);
    }
    wave("length of a wave vector", 1.0, [0.0, 0.0]);
    wave("length of a wave vector", 1.0, [f64::NAN, 1.0]);
}

#[test]
fn waves_that_interfere_are_refused() {
    let wave = |wave_vector: [f64; 2]| SurfaceWave {
        amplitude: 1e-3,
        wave_vector,
    };
    let slide = |waves: &[SurfaceWave]| wavy_surface_sliding(waves, &solid(), 1.0);
    assert_refused("number of waves", slide(&[]));
    for other in [[2.0, 0.0], [-2.0, -0.0]] {
        assert_refused("wave vector", slide(&[wave([2.0, 0.0]), wave(other)]));
    }
}

#[test]
fn results_beyond_the_numbers_are_refused() {
    let [deep, flat] = [[1e300, 1e-300, 1.0], [1e-300, 1e300, 1.0]].map(|numbers| {
        let (material, load) = material_and_load(numbers);
        power_sliding(&power(1.0, 1.0), &material, &load).map(drop)
    });
    let (material, load) = with_depth(1.0);
    let sharp = power_sliding(&power(1e-300, 0.6), &material, &load).map(drop);
    let wave = SurfaceWave {
        amplitude: 1e-3,
        wave_vector: [2.0, 0.0],
    };
    let fast = wavy_surface_sliding(&[wave], &solid(), f64::MAX).map(drop);
    for (named, result) in [
        ("indentation depth", deep),
        ("indentation depth", flat),
        ("contact length", sharp),
        ("angular frequency", fast),
    ] {
        assert_matches!(result, Err(FrictionError::OutOfRange { quantity, .. }) if quantity == named);
    }
}

#[test]
fn no_intermediate_product_overflows() {
    for [force, eta, v] in [
        [1e-200, 1e200, 1e-200],
        [1e-200, 1e-200, 1e200],
        [1e200, 1e-200, 1e200],
        [1e200, 1e200, 1e-200],
        [1e300, 1e300, 1e300],
    ] {
        let (material, load) = material_and_load([force, eta, v]);
        let depth = stationary_depth(&material, &load);
        let logarithm = force.log10() - eta.log10() - v.log10() - 4_f64.log10();
        // The logarithm is rounded in its last place, that is to 1e-13.
        assert!(
            (depth.log10() - logarithm).abs() < 1e-12,
            "F = {force:e}, η = {eta:e}, v = {v:e}: d = {depth:e} instead of 1e{logarithm}"
        );
    }
}

#[test]
fn profiles_without_a_closed_form_are_refused() {
    let (material, load) = with_depth(0.1);
    let foundation = KelvinVoigt::new(1.0, 1.0).unwrap();
    let contact = SlidingContact {
        front: 1.0,
        velocity: 1.0,
    };
    for p in [0.5, 1.5, 2.000_000_1, 3.0, 2.0] {
        let profile = power(1.0, p);
        let results = [
            cone_depth_by_equation_15(&profile, &material, &load, 1.0).map(drop),
            transient_sliding(&profile, &material, &load, 1.0).map(drop),
            sliding_distance_to_depth(&profile, &material, &load, 0.5).map(drop),
            kelvin_voigt_sliding(&profile, &foundation, contact).map(drop),
        ];
        // For a paraboloid only Eq. (15) has no closed form.
        let refused = if (p - 2.0_f64).abs() > 0.0 { 4 } else { 1 };
        for result in results.into_iter().take(refused) {
            assert_matches!(result, Err(FrictionError::UnsupportedExponent { .. }));
        }
    }
}

#[test]
fn contacts_beyond_the_body_are_refused() {
    let material = viscous(1.0);
    let sphere = Sphere::new(0.005).unwrap();
    let beyond = ElasticContact {
        contact_radius: 0.005,
        velocity: 1.0,
    };
    let result = low_speed_friction(&sphere, &solid(), beyond);
    let outside = IndenterError::OutOfDomain {
        position: 0.005,
        lower: 0.0,
        upper: 0.005,
    };
    assert_eq!(result, Err(outside.into()), "at the equator");
    for result in [
        indentation_after_impulse(&sphere, &material, 1e3).map(drop),
        impulse_to_depth(&sphere, &material, 1e3).map(drop),
    ] {
        assert_matches!(result, Err(FrictionError::BeyondEdge { radius }) if radius.total_cmp(&0.005).is_eq());
        let expected = "the contact would reach the edge of the body at radius 0.005 m (of a sphere: its equator): lower \
             normal_force or indentation_depth, or check the unit of shear_modulus or viscosity";
        assert_eq!(result.unwrap_err().to_string(), expected, "the message");
    }
    // h̃ = (π/2) x − 2 x² falls from x = π/8 on, and so does its moment later.
    let falling = superposition(&[(1.0, 1.0), (-1.0, 2.0)]);
    let result = indentation_after_impulse(&falling, &material, 1e6);
    assert!(result.is_err(), "{result:?} of a body that turns downwards");
}
