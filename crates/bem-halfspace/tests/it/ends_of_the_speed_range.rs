//! At very low and very high speed friction is a small difference of large pressures, and its limits are known.

use friction_analytic::{ElasticContact, high_speed_friction, low_speed_friction, slow_sliding};
use indenters::Axisymmetric;
use numerics::Estimate;

use crate::support::{Scene, assert_bars_agree, power, three_elements, under_force};

/// A body whose contact has the radius 1 on the relaxed three-element solid, and the speed at which the memory length is `memory`
/// radii.
fn scene(
    exponent: f64,
    gamma: f64,
    memory: f64,
) -> (Scene<impl rheology::Material>, ElasticContact) {
    let solid = three_elements(1.0, gamma.recip() - 1.0, 1.0);
    let contact = ElasticContact {
        contact_radius: 1.0,
        velocity: memory * gamma,
    };
    let body = power(0.1, exponent);
    let elastic = low_speed_friction(&body, &solid, contact).expect("an elastic contact");
    let load = under_force(elastic.normal_force, contact.velocity);
    (Scene::new(body, solid, load), contact)
}

#[test]
fn slow_sliding_is_that_of_the_expansion_to_second_order() {
    for (exponent, gamma, memory) in [
        (1.0, 0.02, 0.06),
        (1.3, 0.1, 0.05),
        (1.5, 0.9, 0.06),
        (2.0, 0.5, 0.05),
        (3.0, 0.1, 0.04),
    ] {
        let what = format!("h = 0.1 r^{exponent}, G_∞/G(0+) = {gamma}, λv/a = {memory}");
        let (scene, contact) = scene(exponent, gamma, memory);
        let first = low_speed_friction(&scene.body, &scene.material, contact);
        let first = Estimate::exact(first.expect("friction").half_space);
        let slow = slow_sliding(&scene.body, &scene.material, contact).expect("friction");
        let found = scene.steady(2e-3);
        assert_bars_agree(&what, found.friction_coefficient, slow.friction_coefficient);
        assert_bars_agree(&what, found.contact_area, slow.contact_area);
        let rear = Estimate::new(found.finest.contact_x[0], found.contact_box_error);
        assert_bars_agree(&what, rear, slow.rear);
        let depth = scene.body.line_height(contact.contact_radius);
        let depth = Estimate::new(depth, slow.elastic_error * depth);
        let found_depth = found.indentation_depth.expect("a depth");
        assert_bars_agree(&what, found_depth, depth);
        // The first order alone, and the whole disc, are well outside.
        let missed = (first.value - found.friction_coefficient.value).abs();
        assert!(
            missed > 3.0 * found.friction_coefficient.error,
            "{what}: {missed} is hidden"
        );
    }
}

/// |μ/μ_limit − 1| is of the order of the ratio of the lengths that are far apart.
#[test]
fn the_ends_of_the_speed_range_are_reached_to_the_error_asked_for() {
    for exponent in [1.0, 2.0] {
        for (gamma, memory, apart) in [(0.1, 1e-4, 1e-4), (0.1, 1e5, 1e-4), (0.01, 1e9, 1e-6)] {
            let (scene, contact) = scene(exponent, gamma, memory);
            let what = format!("h = 0.1 r^{exponent}, G_∞/G(0+) = {gamma}, λv/a = {memory:e}");
            let found = scene.steady(1e-3).friction_coefficient;
            // Where it is fast, the body is held by a stiffer half space, on a smaller circle.
            let shrinks = gamma.powf(1.0 / (exponent + 1.0));
            let limit = if memory < 1.0 {
                low_speed_friction(&scene.body, &scene.material, contact)
            } else {
                let contact_radius = shrinks;
                let contact = ElasticContact {
                    contact_radius,
                    ..contact
                };
                high_speed_friction(&scene.body, &scene.material, contact)
            };
            let limit = limit.expect("a limit").half_space;
            let limit = Estimate::new(limit, 2.0 * apart * limit);
            assert_bars_agree(&what, found, limit);
        }
    }
}

/// Elements longer than the memory length do not resolve the asymmetry between front and rear.
#[test]
fn the_bar_covers_memory_lengths_below_an_element() {
    for exponent in [1.0, 2.0, 3.0] {
        for memory in [1e-3, 3e-3, 1e-2] {
            let (scene, contact) = scene(exponent, 0.1, memory);
            let what = format!("h = 0.1 r^{exponent}, λv/a = {memory}");
            let slow = slow_sliding(&scene.body, &scene.material, contact).expect("friction");
            let found = scene.steady(1e-2).friction_coefficient;
            assert_bars_agree(&what, found, slow.friction_coefficient);
        }
    }
}
