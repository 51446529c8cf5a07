//! Peaks of the friction under flat ends, behind whose kinks a force has no limit.

use indenters::{Control, EquivalentLine, FlatCone};
use mdr_core::move_along;
use numerics::Accuracy;
use rheology::{Prony, RelaxationBranch, RelaxationSpectrum};

use crate::motions::reciprocating;

/// The element that passes a steep kink has a force without limit, which is none of the body.
#[test]
fn the_peak_under_a_flat_end_is_that_of_the_body() {
    let body = FlatCone::new(2e-4, 0.2).expect("a flat cone");
    let line = EquivalentLine(&body);
    let branch = RelaxationBranch::new(3e6, 0.05);
    let spectrum = RelaxationSpectrum::new(1e6, 0.0, vec![branch]).expect("a spectrum");
    let material = Prony::new(spectrum).expect("a material");
    let motion = reciprocating(1e-3, 2.0, Control::NormalForce(0.3));
    for elements in [128, 256] {
        let request = Accuracy::Elements(elements);
        let moved = move_along(&line, &material, &motion, request).expect("a cycle");
        let peak = moved.peak_friction;
        let error = (peak.value - 0.0989).abs();
        assert!(
            error <= peak.error && error < 0.05 * peak.value,
            "{elements} elements: {peak:?}"
        );
    }
}
