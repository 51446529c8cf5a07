use casebook::{NEGATIVE, NOT_POSITIVE, assert_matches, prony, refused, refuses, superposition};
use friction_analytic::{
    ElasticContact, FrictionError, SlidingContact, SurfaceWave, WavySliding,
    cone_depth_by_equation_15, cylinder_half_width_after_impulse, high_speed_friction,
    impulse_to_depth, indentation_after_impulse, kelvin_voigt_sliding, low_speed_friction,
    power_indentation_after_impulse, power_sliding, sliding_distance_to_depth, stationary_depth,
    transient_sliding, wavy_surface_sliding,
};
use indenters::{Cylinder, IndenterError, SlidingLoad, Sphere};
use rheology::{KelvinVoigt, Prony};

use crate::support::{material_and_load, power, viscous, with_depth};

fn solid() -> Prony {
    prony([1.0, 0.0], &[(2.0, 1.5)])
}

#[test]
fn numbers_that_are_negative_or_not_finite_are_named() {
    let ((material, load), cone) = (with_depth(0.1), power(1.0, 1.0));
    let cylinder = Cylinder::new(0.01).unwrap();
    let of_power = |x| power_indentation_after_impulse(&cone, &material, x);
    refuses("impulse", NEGATIVE, of_power);
    let of_body = |x| indentation_after_impulse(&cone, &material, x);
    refuses("impulse", NEGATIVE, of_body);
    let width = |x| cylinder_half_width_after_impulse(&cylinder, &material, x);
    refuses("impulse_per_length", NEGATIVE, width);
    let transient = |x| transient_sliding(&cone, &material, &load, x);
    refuses("time", NEGATIVE, transient);
    let printed = |x| cone_depth_by_equation_15(&cone, &material, &load, x);
    refuses("time", NEGATIVE, printed);
    let distance = |x| sliding_distance_to_depth(&cone, &material, &load, x);
    refuses("fraction", NEGATIVE, distance);
    refuses("fraction", &[1.0], distance);
}

fn wave(amplitude: f64, wave_vector: [f64; 2]) -> SurfaceWave {
    SurfaceWave {
        amplitude,
        wave_vector,
    }
}

fn slide_over(waves: &[SurfaceWave]) -> Result<WavySliding, FrictionError> {
    wavy_surface_sliding(waves, &solid(), 1.0)
}

#[test]
fn numbers_that_must_be_positive_are_named() {
    let depth = |x| impulse_to_depth(&power(1.0, 1.0), &viscous(1.0), x);
    refuses("depth", NOT_POSITIVE, depth);
    let foundation = KelvinVoigt::new(1.0, 1.0).unwrap();
    let on_line = |front, velocity| {
        let contact = SlidingContact { front, velocity };
        kelvin_voigt_sliding(&power(1.0, 1.0), &foundation, contact)
    };
    refuses("velocity", NOT_POSITIVE, |x| on_line(1.0, x));
    refuses("front", NOT_POSITIVE, |x| on_line(x, 1.0));
    let sphere = Sphere::new(2.0).unwrap();
    for limit in [low_speed_friction, high_speed_friction] {
        let elastic = |contact_radius, velocity| {
            let contact = ElasticContact {
                contact_radius,
                velocity,
            };
            limit(&sphere, &solid(), contact)
        };
        refuses("velocity", NOT_POSITIVE, |x| elastic(0.5, x));
        refuses("contact_radius", NOT_POSITIVE, |x| elastic(x, 1.0));
    }
    let amplitude = |x| slide_over(&[wave(x, [1.0, 0.0])]);
    refuses("amplitude", NOT_POSITIVE, amplitude);
    let velocity = |x| wavy_surface_sliding(&[wave(1.0, [1.0, 0.0])], &solid(), x);
    refuses("velocity", NOT_POSITIVE, velocity);
    let vector = |x| slide_over(&[wave(1.0, [x, x])]);
    refuses("length of a wave vector", &[0.0, f64::NAN], vector);
}

#[test]
fn waves_that_interfere_are_refused() {
    refused("number of waves", slide_over(&[]));
    for [x, y] in [[2.0, 0.0], [0.0, 2.0], [2.0, 3.0], [2.0, -3.0]] {
        for other in [[x, y], [-x, -y]] {
            let waves = [[x, y], other].map(|wave_vector| wave(1e-3, wave_vector));
            refused("wave vector", slide_over(&waves));
        }
    }
}

#[test]
fn loads_of_another_kind_are_refused() {
    let ((material, load), cone) = (with_depth(0.1), power(1.0, 1.0));
    let passing = power_sliding(&cone, &material, &load.after(2.0).unwrap());
    assert!(passing.is_err(), "{passing:?}");
    let held = SlidingLoad::at_depth(0.1, 1.0).unwrap();
    let sinking = transient_sliding(&cone, &material, &held, 1.0);
    assert!(sinking.is_err(), "{sinking:?}");
}

#[test]
fn overflow_and_underflow_are_refused() {
    let [deep, flat] = [[1e300, 1e-300, 1.0], [1e-300, 1e300, 1.0]].map(|numbers| {
        let (material, load) = material_and_load(numbers);
        power_sliding(&power(1.0, 1.0), &material, &load).map(drop)
    });
    let (material, load) = with_depth(1.0);
    let sharp = power_sliding(&power(1e-300, 0.6), &material, &load).map(drop);
    let fast = wavy_surface_sliding(&[wave(1e-3, [2.0, 0.0])], &solid(), f64::MAX).map(drop);
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
    // h̃ = (π/2) x − 2 x² rises up to x = π/8, where the moment ∫ x h̃' dx, which is the impulse over 8 η, is π³/768. The crest at 1/2
    // touches before.
    let falling = superposition(&[(1.0, 1.0), (-1.0, 2.0)]);
    let limit = |impulse: f64| match indentation_after_impulse(&falling, &material, impulse) {
        Err(FrictionError::Indenter(IndenterError::NonMonotoneLine {
            limiting_radius,
            limiting_depth,
            ..
        })) => [limiting_radius, limiting_depth],
        other => panic!("{other:?}"),
    };
    let largest = 8.0 * std::f64::consts::PI.powi(3) / 768.0;
    let [turn, _] = limit(1.000_001 * largest);
    assert!(
        (turn * 8.0 / std::f64::consts::PI - 1.0).abs() < 1e-9,
        "{turn}"
    );
    let [radius, depth] = limit(0.999_999 * largest);
    assert!(radius < 0.9 * turn, "{radius}");
    let impulse = impulse_to_depth(&falling, &material, 0.999 * depth).unwrap();
    let pressed = indentation_after_impulse(&falling, &material, impulse).unwrap();
    assert!(
        (pressed.indentation_depth / (0.999 * depth) - 1.0).abs() < 1e-9,
        "{pressed:?}"
    );
    // h̃ = (π/2) x − 2 x² + 0.15 π x³ falls from 0.47 to 2.4, and is higher again at 4.
    let dented = superposition(&[(1.0, 1.0), (-1.0, 2.0), (0.2, 3.0)]);
    let contact_radius = 4.0;
    let beyond = ElasticContact {
        contact_radius,
        ..beyond
    };
    let elastic = low_speed_friction(&dented, &solid(), beyond);
    assert!(elastic.is_err(), "{elastic:?}");
    let viscous = indentation_after_impulse(&dented, &material, 150.0);
    assert!(viscous.is_err(), "{viscous:?}");
}
