//! The discrete contact problem has one solution, and both controls find it: on bodies of the casebook, in the smallest
//! contacts, and as a dense active-set method has it.

use std::f64::consts::PI;

use bem_halfspace::{Contact, ContactState, Control, influence};
use casebook::{Case, group};
use faer::linalg::solvers::Solve;
use faer::{Mat, Side};

use crate::support::{Pressing, assert_close, assert_near, cone, count, difference, paraboloid};

fn pressing(case: &Case) -> Pressing {
    let body = match case.input_text("shape") {
        "paraboloid" => paraboloid(0.5 / case.input("R")),
        _ => cone(case.input("slope")),
    };
    Pressing::centred(&body, count(case, "N"), 1.0)
}

#[test]
fn contact_at_given_depth_or_force_is_the_unique_discrete_solution() {
    for case in group("BEM-04") {
        let (n, body) = (count(&case, "N"), pressing(&case));
        let (contact, state) = body.solve(Control::IndentationDepth(case.input("d")));
        case.check("F", contact.normal_force);
        case.check_within("n_contact", contact.n_contact as f64, 0.0);
        case.check("p_centre", state.pressure()[n / 2 * n + n / 2]);
        let force = case.expected("F").expect("a force");
        let (contact, _) = body.solve(Control::NormalForce(force));
        assert_close(case.id(), contact.indentation_depth, case.input("d"), 1e-9);
        case.check_within("n_contact", contact.n_contact as f64, 0.0);
    }
}

/// A flat square punch of N × N elements has the stiffness of the dense solution.
#[test]
fn stiffness_of_a_square_punch() {
    for case in group("BEM-03").iter().filter(|case| case.has_input("N")) {
        let n = count(case, "N");
        let punch = Pressing::on_unit_elements([n, n], &vec![0.0; n * n]);
        let (contact, state) = punch.solve(Control::IndentationDepth(1.0));
        case.check("F_over_GdL", contact.normal_force / n as f64);
        if case.expected("p_centre_over_G").is_some() {
            case.check("p_centre_over_G", state.pressure()[n * n / 2]);
        }
    }
}

fn contact(shape: [usize; 2], heights: &[f64], control: Control) -> (Contact, ContactState) {
    Pressing::on_unit_elements(shape, heights).solve(control)
}

/// One element has the stiffness of its self-influence, and two isolated ones share the load: where there is no body
/// (height +∞) there is no contact.
#[test]
fn the_smallest_contacts_are_those_of_the_casebook() {
    let deep = Control::IndentationDepth(1.0);
    let (one, _) = contact([1, 1], &[0.0], deep);
    let (at_force, _) = contact([1, 1], &[0.0], Control::NormalForce(one.normal_force));
    assert_near("depth", at_force.indentation_depth, 1.0, 1e-14);
    let mut heights = [f64::INFINITY; 6];
    (heights[0], heights[5]) = (0.0, 0.0);
    let (two, state) = contact([6, 1], &heights, deep);
    assert_eq!(state.contact(), [0, 5], "only elements with a body");
    let cases = group("EXT-02");
    for (id, name, force) in [
        ("BEM single cell h=1 G=1 d=1", "F", one.normal_force),
        (
            "two equal isolated cells at distance 5h, h=1 G=1 d=1",
            "F_total",
            two.normal_force,
        ),
    ] {
        let case = cases
            .iter()
            .find(|case| case.id() == format!("EXT-02/{id}"));
        case.expect("a case of this name").check(name, force);
    }
}

#[test]
fn without_force_or_depth_nothing_is_in_contact() {
    let heights = [0.3, 0.0, 0.2];
    let (unloaded, state) = contact([3, 1], &heights, Control::NormalForce(0.0));
    let pressure = state.pressure();
    assert!(pressure.iter().all(|value| *value == 0.0), "{pressure:?}");
    assert_near("touch", unloaded.indentation_depth, 0.0, f64::MIN_POSITIVE);
    let (held, _) = contact([1, 3], &heights, Control::IndentationDepth(-0.1));
    for contact in [unloaded, held] {
        let carried = (contact.n_contact, contact.normal_force);
        assert_eq!(carried, (0, 0.0), "{contact:?}");
    }
}

fn coefficient(n: usize, to: usize, from: usize) -> f64 {
    let distance = |a: usize, b: usize| a as f64 - b as f64;
    let offset = [distance(to / n, from / n), distance(to % n, from % n)];
    influence(offset, [1.0, 1.0]) / (4.0 * PI)
}

/// Pressures at the given depth: factorises the influence matrix of the contact (faer) and changes the active set until
/// there is neither tension nor penetration; it shares only the influence coefficient with the solver.
fn dense_solution(heights: &[f64], n: usize, depth: f64) -> Vec<f64> {
    let mut contact: Vec<usize> = (0..n * n).filter(|&to| heights[to] < depth).collect();
    for _ in 0..100 {
        let size = contact.len();
        let entry = |i: usize, j: usize| coefficient(n, contact[i], contact[j]);
        let right = Mat::from_fn(size, 1, |i, _| depth - heights[contact[i]]);
        let factors = Mat::from_fn(size, size, entry).llt(Side::Lower);
        let solution = factors.expect("positive definite").solve(&right);
        let mut pressure = vec![0.0; n * n];
        for (i, &element) in contact.iter().enumerate() {
            pressure[element] = solution[(i, 0)];
        }
        let is_next = |&to: &usize| {
            let displacements = contact
                .iter()
                .map(|&from| coefficient(n, to, from) * pressure[from]);
            let gap = || heights[to] + displacements.sum::<f64>() - depth;
            pressure[to] > 0.0 || !contact.contains(&to) && gap() < 0.0
        };
        let next: Vec<usize> = (0..n * n).filter(is_next).collect();
        if next == contact {
            return pressure;
        }
        contact = next;
    }
    panic!("the reference did not find its active set");
}

/// Two bumps of different height and an inclined, wavy ground.
#[test]
fn several_patches_without_symmetry_are_those_of_a_dense_method() {
    let n = 16;
    let height = |index: usize| {
        let (x, y) = ((index / n) as f64 - 4.0, (index % n) as f64 - 3.0);
        let far = ((x - 6.0).powi(2) + 2.0 * (y - 7.0).powi(2)).mul_add(0.03, 0.15);
        (0.02 * (x * x + 1.5 * y * y + x * y)).min(far) + 0.01 * (x + 2.0 * y).sin()
    };
    let heights: Vec<f64> = (0..n * n).map(height).collect();
    for depth in [0.02, 0.3, 0.9] {
        let expected = dense_solution(&heights, n, depth);
        for control in [
            Control::IndentationDepth(depth),
            Control::NormalForce(expected.iter().sum()),
        ] {
            let (contact, state) = contact([n, n], &heights, control);
            assert_close(control, contact.indentation_depth, depth, 1e-10);
            // Relative to the largest pressure, which is less than the force on unit elements.
            let error = difference(state.pressure(), &expected);
            assert_near(control, error, 0.0, 1e-10);
        }
    }
}
