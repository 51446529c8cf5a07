//! The discrete contact problem has one solution, and both controls find it.

use bem_halfspace::Control;
use casebook::{Case, group};
use indenters::PowerProfile;

use crate::support::{Pressing, count};

fn pressing(case: &Case) -> Pressing {
    let profile = match case.input_text("shape") {
        "paraboloid" => PowerProfile::paraboloid(0.5 / case.input("R")),
        _ => PowerProfile::cone(case.input("slope")),
    };
    Pressing::centred(&profile.expect("a valid indenter"), count(case, "N"), 1.0)
}

#[test]
fn contact_at_given_depth_is_the_unique_discrete_solution() {
    for case in group("BEM-04") {
        let n = count(&case, "N");
        let (contact, state) = pressing(&case).solve(Control::IndentationDepth(case.input("d")));
        case.check("F", contact.normal_force);
        case.check_within("n_contact", contact.n_contact as f64, 0.0);
        case.check("p_centre", state.pressure()[n / 2 * n + n / 2]);
    }
}

#[test]
fn contact_at_given_force_has_the_depth_that_causes_the_force() {
    for case in group("BEM-04") {
        let force = case.expected("F").expect("a force");
        let (contact, _) = pressing(&case).solve(Control::NormalForce(force));
        let [depth, expected] = [contact.indentation_depth, case.input("d")];
        let error = (depth / expected - 1.0).abs();
        assert!(error < 1e-9, "{}: {depth} not {expected}", case.id());
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
