//! The discrete contact problem has one solution, and both controls find it.

use bem_halfspace::Control;
use casebook::{Case, group};
use indenters::PowerProfile;

use crate::support::{centred_heights, elastic_contact};

fn indenter(case: &Case) -> PowerProfile {
    let profile = match case.input_text("shape") {
        "paraboloid" => PowerProfile::paraboloid(0.5 / case.input("R")),
        _ => PowerProfile::cone(case.input("slope")),
    };
    profile.expect("a valid indenter")
}

#[test]
fn contact_at_given_depth_is_the_unique_discrete_solution() {
    for case in group("BEM-04") {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "N is a small count"
        )]
        let n = case.input("N") as usize;
        let heights = centred_heights(&indenter(&case), n, 1.0);
        let (contact, state) =
            elastic_contact(&heights, [n, n], Control::IndentationDepth(case.input("d")));
        case.check("F", contact.normal_force);
        case.check_within("n_contact", contact.n_contact as f64, 0.0);
        let centre = if n % 2 == 1 {
            n * n / 2
        } else {
            n * n / 2 + n / 2
        };
        case.check("p_centre", state.pressure()[centre]);
    }
}

#[test]
fn contact_at_given_force_has_the_depth_that_causes_the_force() {
    for case in group("BEM-04") {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "N is a small count"
        )]
        let n = case.input("N") as usize;
        let heights = centred_heights(&indenter(&case), n, 1.0);
        let force = case.expected("F").expect("a force");
        let (contact, _) = elastic_contact(&heights, [n, n], Control::NormalForce(force));
        let depth = case.input("d");
        let difference = (contact.indentation_depth / depth - 1.0).abs();
        assert!(
            difference < 1e-9,
            "{}: depth {} instead of {depth}",
            case.id(),
            contact.indentation_depth
        );
        case.check_within("n_contact", contact.n_contact as f64, 0.0);
    }
}
