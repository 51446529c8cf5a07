//! Sliding from first touch on any linear viscoelastic half space.

use bem_halfspace::slide::{March, StationaryOptions, slide_on_grid, slide_to_stationary};
use bem_halfspace::{BemError, Footprint, GridOptions};
use casebook::{Case, group};
use indenters::{PowerProfile, SlidingLoad, Surface};
use rheology::{Elastic, Material, Prony, Viscous};

use crate::support::{Scene, TIGHT, every_kind_of_material, prony};

fn options(spacing: f64, half_width: f64) -> GridOptions {
    GridOptions::new([spacing; 2], Footprint::square(half_width))
}

fn load([force, velocity]: [f64; 2], distance: f64) -> SlidingLoad {
    let load = SlidingLoad::new(force, velocity).expect("a load");
    load.after(distance).expect("a distance")
}

fn friction(
    body: &PowerProfile,
    material: &dyn Material,
    load: &SlidingLoad,
    options: &GridOptions,
) -> f64 {
    let transient = slide_on_grid(body, material, load, options).expect("a transient");
    transient.last().friction_coefficient
}

#[test]
fn a_material_has_the_fields_that_it_needs() {
    let body = PowerProfile::paraboloid(0.5).expect("a body");
    let load = load([0.5, 0.7], 10.0);
    let options = options(0.25, 1.0);
    // Of nine columns, those in front of the mirror through the fifth.
    let columns = 5;
    let footprint = 9 * columns;
    for (name, material) in every_kind_of_material() {
        let march = March::sliding(&body, &*material, &load, &options).expect("a march");
        let creep = material.creep();
        let expected = creep.elements().len() + usize::from(creep.fluidity() > 0.0);
        assert_eq!(march.n_fields(), expected, "fields of the {name} material");
        // A material without memory needs no elements outside the footprint.
        let elements = if expected == 0 {
            footprint
        } else {
            footprint + 39 * columns
        };
        assert_eq!(
            march.n_elements(),
            elements,
            "elements of the {name} material"
        );
    }
}

/// A body without symmetry.
struct Skew;

impl Surface for Skew {
    fn height(&self, [x, y]: [f64; 2]) -> f64 {
        x * x + 0.6 * x * y + 0.6 * y * y + 0.2 * x * x * x
    }

    fn gradient(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [2.0 * x + 0.6 * y + 0.6 * x * x, 0.6 * x + 1.2 * y]
    }
}

#[test]
fn an_elastic_half_space_has_no_friction_and_is_at_rest_at_once() {
    let elastic = Elastic::new(1.5).expect("a material");
    let load = load([0.5, 0.7], 0.4);
    let options = GridOptions {
        contact: TIGHT,
        ..options(0.05, 1.2)
    };
    let cone = PowerProfile::cone(0.5).expect("a body");
    let transient = slide_on_grid(&cone, &elastic, &load, &options).expect("a transient");
    for row in &transient.rows {
        // Rounding of slopes of order one half.
        assert!(row.friction_coefficient.abs() < 1e-10, "{row:?}");
        let first = transient.rows[0].indentation_depth;
        assert!(
            (row.indentation_depth / first - 1.0).abs() < 1e-10,
            "{row:?}"
        );
    }
    // Without symmetry the sum over elements is zero to their order only; with the slope half a step before the end it
    // would be Δx/2 ⟨h_xx⟩ = 0.05.
    let skew = slide_on_grid(&Skew, &elastic, &load, &options).expect("a transient");
    let friction = skew.last().friction_coefficient;
    assert!(friction.abs() < 1e-3, "friction {friction}");
}

/// Kelvin–Voigt with a vanishing spring is the dashpot; the standard solid with vanishing or infinite speed is elastic.
#[test]
fn materials_that_tend_to_the_dashpot_have_its_friction() {
    let scene = Scene::unit(2.0);
    let (load, options) = (scene.load_over(6.0), scene.options(6.0));
    let expected = scene.slide(6.0, 6.0).last().clone();
    let nearly: [(&str, Prony); 3] = [
        ("a weak spring beside it", prony([1e-9, 2.0], &[])),
        (
            "a stiff spring before it",
            prony([0.0, 0.0], &[(2e9, 1e-9)]),
        ),
        ("both", prony([1e-9, 0.0], &[(2e9, 1e-9)])),
    ];
    for (name, material) in nearly {
        let rows = slide_on_grid(&scene.body, &material, &load, &options).expect("a transient");
        let actual = rows.last();
        let ratios = [
            actual.friction_coefficient / expected.friction_coefficient,
            actual.indentation_depth / expected.indentation_depth,
        ];
        for ratio in ratios {
            assert!(
                (ratio - 1.0).abs() < 1e-7,
                "{name}: {actual:?} instead of {expected:?}"
            );
        }
    }
}

fn casebook_body(case: &Case) -> PowerProfile {
    if case.input_text("shape").starts_with("cone") {
        PowerProfile::cone(std::f64::consts::FRAC_2_PI)
    } else {
        PowerProfile::paraboloid(0.5)
    }
    .expect("a body")
}

fn solid_of(case: &Case) -> Prony {
    let branch = (case.input("G2"), case.input("tau"));
    prony([case.input("G1"), 0.0], &[branch])
}

/// Against the stationary friction of another method, from two grids (casebook VIS-06).
#[test]
fn friction_on_a_solid_is_that_of_the_casebook() {
    for (name, distance) in [
        ("paraboloid/gamma=0.1/v=0.01", 4.0),
        ("paraboloid/gamma=0.1/v=0.3", 24.0),
        ("cone/gamma=0.1/v=0.1", 8.0),
        ("cone/gamma=0.1/v=1", 40.0),
    ] {
        let cases = group("VIS-06");
        let case = cases
            .iter()
            .find(|case| case.id().ends_with(name))
            .expect("a case");
        let load = load([case.input("F"), case.input("v")], distance);
        let on = |elements: f64| {
            let options = options(1.0 / elements, 1.5);
            friction(&casebook_body(case), &solid_of(case), &load, &options)
        };
        let [coarse, fine] = [on(7.0), on(14.0)];
        case.check("mu_3d", 2.0 * fine - coarse);
        assert!(
            (fine / case.expected("mu_3d").expect("a friction") - 1.0).abs() < 0.015,
            "{name}: {fine} with 14 elements"
        );
    }
}

/// In a step an element creeps to its end, and lags far less than an element behind (FRI-05).
#[test]
fn slow_friction_on_a_solid_has_its_exact_limit() {
    for case in group("FRI-05") {
        if !case.has_input("v_slow") {
            continue;
        }
        let [p, a] = ["p", "a"].map(|name| case.input(name));
        let stretch = PowerProfile::new(1.0, p).expect("a body").stretch();
        let body = PowerProfile::new(case.input("kappa_c") / stretch, p).expect("a body");
        let line_force = case.input("kappa_c") * p / (p + 1.0) * a.powf(p + 1.0);
        let force = 8.0 * case.input("G1") * line_force;
        let load = load([force, case.input("v_slow")], 0.5 * a);
        let options = GridOptions {
            contact: TIGHT,
            ..options(a / 12.0, 1.4 * a)
        };
        let actual = friction(&body, &solid_of(&case), &load, &options);
        // The elements are 1/24 of the contact. The cone's pressure is singular where its slope jumps.
        let tolerance = if p < 2.0 { 0.03 } else { 1e-3 };
        case.check_within("mu_slow_3d", actual, tolerance);
    }
}

#[test]
fn a_march_stops_when_the_friction_is_stationary() {
    let body = PowerProfile::paraboloid(0.5).expect("a body");
    let wanted = StationaryOptions {
        tolerance: 1e-3,
        over_distance: 3.0,
    };
    let solid = prony([0.1, 0.0], &[(1.0, 1.0)]);
    let materials: [(&str, Box<dyn Material>, f64); 3] = [
        ("solid", Box::new(solid), 1e-3),
        (
            "dashpot",
            Box::new(Viscous::new(1.2).expect("a material")),
            3e-3,
        ),
        (
            "elastic",
            Box::new(Elastic::new(1.2).expect("a material")),
            0.0,
        ),
    ];
    for (name, material, error) in materials {
        let (grid, load) = (options(0.2, 2.4), |distance| load([1.5, 0.3], distance));
        let state = slide_to_stationary(&body, &*material, &load(90.0), &grid, &wanted)
            .expect("a stationary state");
        let distance = state.transient.last().sliding_distance;
        assert!(distance < 60.0, "{name}: stopped after {distance}");
        assert!(
            state.change <= wanted.tolerance,
            "{name}: change {}",
            state.change
        );
        let long = slide_on_grid(&body, &*material, &load(3.0 * distance), &grid);
        let long = long.expect("a transient");
        let limit = if name == "dashpot" {
            long.stationary(0.1).expect("a limit").friction_coefficient
        } else {
            long.last().friction_coefficient
        };
        let difference = (state.friction_coefficient - limit).abs();
        // Rounding on the elastic half space.
        assert!(
            difference <= error * limit.abs() + 1e-6,
            "{name}: {} instead of {limit}",
            state.friction_coefficient
        );
    }
}

#[test]
fn a_distance_too_short_for_the_stationary_state_is_an_error() {
    let body = PowerProfile::paraboloid(0.5).expect("a body");
    let viscous = Viscous::new(1.2).expect("a material");
    let wanted = StationaryOptions {
        tolerance: 1e-3,
        over_distance: 3.0,
    };
    let too_short = load([1.5, 0.3], 4.0);
    let result = slide_to_stationary(&body, &viscous, &too_short, &options(0.2, 2.4), &wanted);
    assert!(
        matches!(result, Err(BemError::NotStationary { drift, .. }) if drift > 1e-3),
        "{result:?}"
    );
}

/// Metre, newton and second scaled over many decades.
#[test]
fn friction_on_a_solid_does_not_depend_on_the_units() {
    let run = |metre: f64, newton: f64, second: f64| {
        let body = PowerProfile::paraboloid(0.5 / metre).expect("a body");
        let pascal = newton / metre / metre;
        let solid = prony([0.1 * pascal, 0.0], &[(pascal, second)]);
        let load = load([1.5 * newton, 0.3 * metre / second], 4.0 * metre);
        let options = options(0.2 * metre, 2.4 * metre);
        friction(&body, &solid, &load, &options)
    };
    let expected = run(1.0, 1.0, 1.0);
    for [metre, newton, second] in [[1e-12, 1e12, 1.0], [1e12, 1e-12, 1e12], [1e-6, 1e-9, 1e-12]] {
        let actual = run(metre, newton, second);
        assert!(
            (actual / expected - 1.0).abs() < 1e-9,
            "units {metre}, {newton}, {second}: {actual} instead of {expected}"
        );
    }
}
