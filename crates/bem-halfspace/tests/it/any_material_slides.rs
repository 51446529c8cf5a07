//! Sliding on any linear viscoelastic half space, from first touch and stationary: limits, references, and an independent
//! sum.

use std::f64::consts::PI;

use bem_halfspace::influence;
use bem_halfspace::slide::{March, PressureField, StationaryOptions, slide_to_stationary};
use casebook::group;
use indenters::Surface;
use numerics::integrate;
use rheology::{Compressible, KelvinVoigt, Material, Maxwell};

use crate::support::{
    Formula, Scene, after, assert_all_close, assert_close, assert_near, body_of_unit_line, cone,
    elastic, every_kind_of_material, paraboloid, power, slid, solid_of, squares, three_elements,
    tight, under_force, viscous,
};

#[test]
fn a_material_has_the_fields_that_it_needs() {
    let body = paraboloid(0.5);
    let load = after(under_force(0.5, 0.7), 10.0);
    let options = squares(0.25, 1.0);
    // Nine columns with a mirror through the fifth: five are followed.
    let columns = 5;
    for (name, material) in every_kind_of_material() {
        let march = March::sliding(&body, &material, &load, &options).expect("a march");
        let creep = material.creep();
        let fields = creep.elements().len() + usize::from(creep.fluidity() > 0.0);
        assert_eq!(march.n_fields(), fields, "fields of the {name} material");
        // Without history variables no elements outside the footprint of nine rows are needed.
        let rows = if fields == 0 { 9 } else { 9 + 39 };
        assert_eq!(march.n_elements(), rows * columns, "elements, {name}");
    }
}

#[test]
fn an_elastic_half_space_has_no_friction_and_is_at_rest_immediately() {
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
    let skew = Formula::new([false; 2], |[x, y]| {
        let height = x * x + 0.6 * x * y + 0.6 * y * y + 0.2 * x * x * x;
        (height, [2.0 * x + 0.6 * y + 0.6 * x * x, 0.6 * x + 1.2 * y])
    });
    let skew = slid(&skew, &elastic(1.5), &load, &options);
    assert_near("skew", skew.last().friction_coefficient, 0.0, 1e-3);
}

/// Kelvin–Voigt with a vanishing spring is the dashpot, and so are Maxwell and the standard solid with a stiff spring.
#[test]
fn materials_that_tend_to_the_dashpot_have_its_friction() {
    let scene = Scene::unit(2.0);
    let (load, options) = (scene.load_over(6.0), scene.options(6.0));
    let marched = |material: &dyn Material| {
        let march = slid(&scene.body, material, &load, &options);
        let last = march.last();
        [last.friction_coefficient, last.indentation_depth]
    };
    let stationary = |material: &dyn Material| {
        let estimate = Scene::new(scene.body, material, scene.load).steady(1e-3);
        estimate.friction_coefficient.value
    };
    let expected = (marched(&scene.material), stationary(&scene.material));
    let kelvin_voigt = KelvinVoigt::new(1e-9, 2.0).expect("a material");
    let maxwell = Maxwell::new(2e9, 2.0).expect("a material");
    let nearly: [&dyn Material; 3] = [&kelvin_voigt, &maxwell, &three_elements(1e-9, 2e9, 1e-9)];
    for material in nearly {
        assert_all_close(material, marched(material), expected.0, 1e-7);
        assert_close(material, stationary(material), expected.1, 1e-5);
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

#[test]
fn a_march_stops_when_the_friction_is_stationary() {
    let (body, options) = (paraboloid(0.5), squares(0.2, 2.4));
    let load = |distance| after(under_force(1.5, 0.3), distance);
    let wanted = StationaryOptions {
        tolerance: 1e-3,
        over_distance: 3.0,
    };
    let materials: [(&str, &dyn Material, f64); 3] = [
        ("solid", &three_elements(0.1, 1.0, 1.0), 1e-3),
        ("dashpot", &viscous(1.2), 3e-3),
        ("elastic", &elastic(1.2), 0.0),
    ];
    for (name, material, error) in materials {
        let state = slide_to_stationary(&body, &material, &load(90.0), &options, &wanted);
        let state = state.expect("a stationary state");
        let (distance, change) = (state.transient.last().sliding_distance, state.change);
        let is_at_rest = distance < 60.0 && change <= wanted.tolerance;
        assert!(is_at_rest, "{name}: after {distance} at {change}");
        let long = slid(&body, material, &load(3.0 * distance), &options);
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

/// Slow friction is half that of the line (FRI-05). Every retardation element relaxes within a step, and the pressure lags far less
/// than the length of a boundary element.
#[test]
fn a_slow_march_has_the_exact_friction() {
    for case in group("FRI-05").iter().filter(|case| case.has_input("G1")) {
        // F = 8 G ∫ x g' dx with the line g = κc x^p.
        let [p, line, a] = ["p", "kappa_c", "a"].map(|name| case.input(name));
        let body = power(line / power(1.0, p).stretch(), p);
        let force = 8.0 * case.input("G1") * line * p * a.powf(p + 1.0) / (p + 1.0);
        let load = after(under_force(force, case.input("v_slow")), 0.5 * a);
        let options = tight(squares(a / 12.0, 1.4 * a));
        let march = slid(&body, &solid_of(case), &load, &options);
        // The elements are 1/24 of the contact. The cone's pressure is singular where its slope jumps.
        let tolerance = if p < 2.0 { 0.03 } else { 1e-3 };
        let friction = march.last().friction_coefficient;
        case.check_within("mu_slow_3d", friction, tolerance);
    }
}

/// Between the ends, against an independent computation (VIS-06) whose stated uncertainty is 1e-3 and tolerance 1e-2.
#[test]
fn friction_and_depth_agree_with_the_reference_at_middle_speeds() {
    for case in group("VIS-06") {
        let load = under_force(case.input("F"), case.input("v"));
        let scene = Scene::new(body_of_unit_line(&case), solid_of(&case), load);
        let estimate = scene.steady(2e-3);
        case.check_within("mu_3d", estimate.friction_coefficient.value, 4e-3);
        let depth = estimate.indentation_depth.expect("the depth of a solid");
        case.check_within("d_3d", depth.value, 4e-3);
    }
}

/// The displacement at a point by direct integration of its history, without tables or recursions:
/// u = J₀ w + (1/v) ∫ J' w, with a substitution-free quadrature between all scales.
fn displacement(
    field: &PressureField,
    material: &dyn Material,
    velocity: f64,
    at: [f64; 2],
) -> f64 {
    let (edges, [rows, columns]) = (field.grid.spacing(), field.grid.shape());
    let potential = |x: f64| -> f64 {
        let of_element = |(index, pressure): (usize, &f64)| {
            let x = x - field.origin[0] - (index / columns) as f64 * edges[0];
            let y = at[1] - field.origin[1] - (index % columns) as f64 * edges[1];
            pressure * influence([x, y], edges) / (4.0 * PI)
        };
        let elements = field.pressure.iter().enumerate();
        let loaded = elements.filter(|(_, pressure)| **pressure > 0.0);
        loaded.map(of_element).sum()
    };
    let creep = material.creep();
    let edge = |row: usize| field.origin[0] + (row as f64 - 0.5) * edges[0];
    let mut total = creep.instantaneous_compliance() * potential(at[0]);
    for element in creep.elements() {
        let length = velocity * element.retardation_time;
        let end = edge(rows) + 40.0 * length;
        let outside = (0..60).map(|power| edge(rows) + edges[0] * 2.0_f64.powi(power));
        let inside = (0..=rows).map(edge).chain([at[0], end]);
        let mut ends: Vec<f64> = inside.chain(outside).collect();
        ends.retain(|x| (at[0]..=end).contains(x));
        ends.sort_by(f64::total_cmp);
        let rate = |x: f64| (-(x - at[0]) / length).exp() / length * potential(x);
        let parts = ends.windows(2).filter(|pair| pair[0] < pair[1]);
        let integrals = parts.map(|pair| integrate(rate, [pair[0], pair[1]], 1e-9).value);
        total += element.compliance * integrals.sum::<f64>();
    }
    material.half_space_factor() * total
}

/// The gap closes in contact, at the depth of the solution, and is open elsewhere, when the displacement is integrated
/// over its history.
#[test]
fn the_contact_conditions_hold_for_displacements_integrated_directly() {
    let material = Compressible::new(&three_elements(0.1, 1.0, 1.0), 0.3).expect("a material");
    for velocity in [0.03, 0.5, 8.0] {
        let scene = Scene::new(paraboloid(1.0), &material, under_force(1.0, velocity));
        let options = scene.steady_options(4.0);
        let (spacing, solution) = (options.spacing, scene.steady_on(&options));
        let depth = solution.depth.reference_depth;
        let field = &solution.pressure;
        let compliance = material.complex_compliance(PI * velocity / spacing[0]);
        let compliance = compliance.expect("a compliance");
        let shift = -compliance.loss.atan2(compliance.storage) / PI * spacing[0];
        let [rows, columns] = field.grid.shape();
        // The first row behind and the first ahead of the contact, and some in between.
        for (row, column) in [(0, 1), (1, 3), (2, 2), (3, 4), (4, 1), (rows + 1, 2)] {
            let point = [
                field.origin[0] + (row as f64 - 1.0) * spacing[0] + shift,
                field.origin[1] + column as f64 * spacing[1],
            ];
            let moved = displacement(field, &material, velocity, point);
            let gap = scene.body.height(point) - depth + moved;
            let loaded =
                (1..=rows).contains(&row) && field.pressure[(row - 1) * columns + column] > 0.0;
            // The solver leaves 1e-10 of the depth scale, the quadrature 1e-9 of the displacement.
            let holds = gap > -1e-8 * depth && (!loaded || gap < 1e-8 * depth);
            assert!(holds, "{velocity}, {row}, {column}, {loaded}: {gap:e}");
        }
    }
}
