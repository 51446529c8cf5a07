//! A flat square punch of N × N elements has the stiffness of the dense solution.

use bem_halfspace::Control;
use casebook::group;

use crate::support::elastic_contact;

#[test]
fn stiffness_of_a_square_punch() {
    for case in group("BEM-03").iter().filter(|case| case.has_input("N")) {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "N is a small count"
        )]
        let n = case.input("N") as usize;
        let heights = vec![0.0; n * n];
        let (contact, state) = elastic_contact(&heights, [n, n], Control::IndentationDepth(1.0));
        case.check("F_over_GdL", contact.normal_force / n as f64);
        if case.expected("p_centre_over_G").is_some() {
            case.check("p_centre_over_G", state.pressure()[n * n / 2]);
        }
    }
}
