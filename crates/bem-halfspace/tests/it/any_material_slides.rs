//! Sliding from first touch on any linear viscoelastic half space.

use bem_halfspace::slide::{March, StationaryOptions, slide_to_stationary};
use casebook::group;
use rheology::{KelvinVoigt, Material, Maxwell};

use crate::support::{
    Formula, Scene, after, assert_all_close, assert_near, body_of_unit_line, cone, elastic,
    every_kind_of_material, paraboloid, power, slid, solid_of, squares, three_elements, tight,
    under_force, viscous,
};

#[test]
fn a_material_has_the_fields_that_it_needs() {
    let body = paraboloid(0.5);
    let load = after(under_force(0.5, 0.7), 10.0);
    let options = squares(0.25, 1.0);
    // Of nine columns, those in front of the mirror through the fifth.
    let columns = 5;
    for (name, material) in every_kind_of_material() {
        let march = March::sliding(&body, &*material, &load, &options).expect("a march");
        let creep = material.creep();
        let fields = creep.elements().len() + usize::from(creep.fluidity() > 0.0);
        assert_eq!(march.n_fields(), fields, "fields of the {name} material");
        // A material without memory needs no elements outside the footprint of nine rows.
        let rows = if fields == 0 { 9 } else { 9 + 39 };
        assert_eq!(march.n_elements(), rows * columns, "elements, {name}");
    }
}

#[test]
fn an_elastic_half_space_has_no_friction_and_is_at_rest_at_once() {
    let load = after(under_force(0.5, 0.7), 0.4);
    let options = tight(squares(0.05, 1.2));
    let rows = slid(&cone(0.5), &elastic(1.5), &load, &options).rows;
    for row in &rows {
        // Rounding of slopes of order one half.
        assert_near(row, row.friction_coefficient, 0.0, 1e-10);
        let ratio = row.indentation_depth / rows[0].indentation_depth;
        assert_near(row, ratio, 1.0, 1e-10);
    }
    // Without symmetry the sum over elements is zero to their order only; with the slope half a step before the end it
    // would be Δx/2 ⟨h_xx⟩ = 0.05.
    let skew = Formula::new(
        |[x, y]: [f64; 2]| x * x + 0.6 * x * y + 0.6 * y * y + 0.2 * x * x * x,
        |[x, y]: [f64; 2]| [2.0 * x + 0.6 * y + 0.6 * x * x, 0.6 * x + 1.2 * y],
    );
    let skew = slid(&skew, &elastic(1.5), &load, &options);
    assert_near("skew", skew.last().friction_coefficient, 0.0, 1e-3);
}

/// Kelvin–Voigt with a vanishing spring is the dashpot, and so are Maxwell and the standard solid with a stiff one.
#[test]
fn materials_that_tend_to_the_dashpot_have_its_friction() {
    let scene = Scene::unit(2.0);
    let (load, options) = (scene.load_over(6.0), scene.options(6.0));
    let numbers = |material: &dyn Material| {
        let march = slid(&scene.body, material, &load, &options);
        let last = march.last();
        [last.friction_coefficient, last.indentation_depth]
    };
    let stationary = |material: &dyn Material| {
        let estimate = Scene::new(scene.body, material, scene.load).steady(1e-3);
        [estimate.friction_coefficient.value]
    };
    let nearly: [Box<dyn Material>; 3] = [
        Box::new(KelvinVoigt::new(1e-9, 2.0).expect("a material")),
        Box::new(Maxwell::new(2e9, 2.0).expect("a material")),
        Box::new(three_elements(1e-9, 2e9, 1e-9)),
    ];
    let expected = (numbers(&scene.material), stationary(&scene.material));
    for material in nearly {
        assert_all_close(&material, numbers(&material), expected.0, 1e-7);
        assert_all_close(&material, stationary(&material), expected.1, 1e-5);
    }
}

/// Against the stationary friction of another method, from two grids (casebook VIS-06).
#[test]
fn friction_on_a_solid_is_that_of_the_casebook() {
    let cases = group("VIS-06");
    for (name, distance) in [
        ("paraboloid/gamma=0.1/v=0.01", 4.0),
        ("paraboloid/gamma=0.1/v=0.3", 24.0),
        ("cone/gamma=0.1/v=0.1", 8.0),
        ("cone/gamma=0.1/v=1", 40.0),
    ] {
        let case = cases.iter().find(|case| case.id().ends_with(name));
        let case = case.expect("a case");
        let load = after(under_force(case.input("F"), case.input("v")), distance);
        let [coarse, fine] = [7.0, 14.0].map(|elements| {
            let options = squares(1.0 / elements, 1.5);
            let march = slid(&body_of_unit_line(case), &solid_of(case), &load, &options);
            march.last().friction_coefficient
        });
        case.check("mu_3d", 2.0 * fine - coarse);
        case.check_within("mu_3d", fine, 0.015);
    }
}

/// In a step an element creeps to its end, and lags far less than an element behind (FRI-05).
#[test]
fn slow_friction_on_a_solid_has_its_exact_limit() {
    let cases = group("FRI-05").into_iter();
    for case in cases.filter(|case| case.has_input("v_slow")) {
        let [p, a, line] = ["p", "a", "kappa_c"].map(|name| case.input(name));
        let body = power(line / power(1.0, p).stretch(), p);
        let force = 8.0 * case.input("G1") * line * p / (p + 1.0) * a.powf(p + 1.0);
        let load = after(under_force(force, case.input("v_slow")), 0.5 * a);
        let options = tight(squares(a / 12.0, 1.4 * a));
        let march = slid(&body, &solid_of(&case), &load, &options);
        // The elements are 1/24 of the contact. The cone's pressure is singular where its slope jumps.
        let tolerance = if p < 2.0 { 0.03 } else { 1e-3 };
        let friction = march.last().friction_coefficient;
        case.check_within("mu_slow_3d", friction, tolerance);
    }
}

#[test]
fn a_march_stops_when_the_friction_is_stationary() {
    let (body, options) = (paraboloid(0.5), squares(0.2, 2.4));
    let load = |distance| after(under_force(1.5, 0.3), distance);
    let wanted = StationaryOptions {
        tolerance: 1e-3,
        over_distance: 3.0,
    };
    let materials: [(&str, Box<dyn Material>, f64); 3] = [
        ("solid", Box::new(three_elements(0.1, 1.0, 1.0)), 1e-3),
        ("dashpot", Box::new(viscous(1.2)), 3e-3),
        ("elastic", Box::new(elastic(1.2)), 0.0),
    ];
    for (name, material, error) in materials {
        let state = slide_to_stationary(&body, &*material, &load(90.0), &options, &wanted);
        let state = state.expect("a stationary state");
        let distance = state.transient.last().sliding_distance;
        assert!(
            distance < 60.0 && state.change <= wanted.tolerance,
            "{name}: stopped after {distance} at a change of {}",
            state.change
        );
        let long = slid(&body, &*material, &load(3.0 * distance), &options);
        let limit = if name == "dashpot" {
            long.stationary(0.1).expect("a limit").friction_coefficient
        } else {
            long.last().friction_coefficient
        };
        // Rounding on the elastic half space.
        let allowed = error * limit.abs() + 1e-6;
        assert_near(name, state.friction_coefficient, limit, allowed);
    }
}
