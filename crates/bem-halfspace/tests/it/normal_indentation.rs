//! Normal indentation under a constant force follows the exact law d(t) of Lee & Radok, which is also that of the line
//! model.

use bem_halfspace::{Footprint, GridOptions};
use casebook::group;
use indenters::PowerProfile;
use rheology::{Compressible, Material, Viscous};

use crate::support::{TIGHT, pressed, prony};

/// Exact depth of a power profile under a constant force (casebook MDR-01).
fn exact_depth(body: &PowerProfile, impulse_over_viscosity: f64) -> f64 {
    let p = body.exponent();
    let line = body.stretch() * body.coefficient();
    ((p + 1.0) / p * line.powf(1.0 / p) * impulse_over_viscosity / 8.0).powf(p / (p + 1.0))
}

#[test]
fn the_impulse_rule_holds_on_any_grid_with_any_steps() {
    for case in group("BEM-05") {
        let body = PowerProfile::paraboloid(0.5 / case.input("R")).expect("a paraboloid");
        let material = Viscous::new(case.input("eta")).expect("a material");
        let half = 0.5 * case.input("N");
        // Room beyond the contact changes nothing: elements without pressure do not matter.
        let options = GridOptions {
            contact: TIGHT,
            ..GridOptions::new([1.0, 1.0], Footprint::square(half + 1.0))
        };
        let end = case.expected("t").expect("a time");
        for times in [vec![end], vec![1e-6 * end, 0.1 * end, 0.35 * end, end]] {
            let steps = pressed(&body, &material, (case.input("F"), &times), &options);
            let depth = steps[steps.len() - 1].indentation_depth;
            let expected = case.input("d");
            let error = (depth / expected - 1.0).abs();
            assert!(
                error < 1e-9,
                "{} in {} steps: depth {depth} instead of {expected}",
                case.id(),
                times.len()
            );
        }
    }
}

/// Root-mean-square relative error of the depth over a decade of time, which averages over the position of the edge of
/// the contact inside its elements.
fn depth_error(material: &dyn Material, exponent: f64, elements: f64) -> f64 {
    let body = PowerProfile::new(0.4, exponent).expect("a power profile");
    let force = 2.0;
    let yielded = |time: f64| {
        material.half_space_factor() * material.creep_compliance(time).expect("a compliance")
    };
    let times: Vec<f64> = (0..24)
        .map(|k| 0.5 * 10.0_f64.powf(f64::from(k) / 24.0))
        .collect();
    let largest_depth = exact_depth(&body, force * yielded(5.0));
    let radius = body.line_position(largest_depth);
    let options = GridOptions::new([radius / elements; 2], Footprint::square(1.2 * radius));
    let steps = pressed(&body, material, (force, &times), &options);
    let squares = steps.iter().map(|step| {
        (step.indentation_depth / exact_depth(&body, force * yielded(step.time)) - 1.0).powi(2)
    });
    (squares.sum::<f64>() / times.len() as f64).sqrt()
}

/// The piecewise constant pressure makes a second-order error in the depth once the position of the edge is averaged.
#[test]
fn depth_converges_to_the_exact_law_with_second_order() {
    let [dashpot, fluid] = [
        prony([0.0, 50.0], &[]),
        prony([0.0, 0.0], &[(40.0, 2.0), (8.0, 0.3)]),
    ];
    let compressible = Compressible::new(&fluid, 0.2).expect("a Poisson ratio");
    let scenes: [(&dyn Material, f64); 4] = [
        (&dashpot, 1.0),
        (&dashpot, 2.0),
        (&dashpot, 4.0),
        (&compressible, 2.0),
    ];
    for (material, exponent) in scenes {
        let errors = [8.0, 16.0, 32.0].map(|elements| depth_error(material, exponent, elements));
        let order = (errors[0] / errors[2]).log2() / 2.0;
        assert!(
            (order - 2.0).abs() < 0.35,
            "{material:?}, p = {exponent}: order {order} from errors {errors:?}"
        );
        assert!(
            errors[2] < 2e-4,
            "{material:?}, p = {exponent}: errors {errors:?}"
        );
    }
}

/// The contact radius grows as the line model says; the area of whole elements resolves it to an element.
#[test]
fn contact_radius_grows_like_that_of_the_line() {
    for case in group("MDR-01")
        .iter()
        .filter(|case| case.has_input("p") && case.input("t") > 1.0)
    {
        let p = case.input("p");
        if p < 1.0 {
            continue;
        }
        let body = PowerProfile::new(case.input("c"), p).expect("a power profile");
        let material = Viscous::new(case.input("eta")).expect("a material");
        let radius = case.expected("a").expect("a radius");
        let spacing = radius / 24.0;
        let options = GridOptions::new([spacing; 2], Footprint::square(1.2 * radius));
        let load = (case.input("F"), &[case.input("t")][..]);
        let steps = pressed(&body, &material, load, &options);
        case.check_within("d", steps[0].indentation_depth, 1e-3);
        let actual = (steps[0].contact_area / std::f64::consts::PI).sqrt();
        assert!(
            (actual - radius).abs() < 0.5 * spacing,
            "{}: radius {actual} instead of {radius}",
            case.id()
        );
    }
}
