//! Storage modulus, loss modulus and loss tangent of a rubber over the frequency.
#![expect(clippy::print_stdout, reason = "an example shows what it found")]

use rheology::{Material, Prony, RelaxationBranch, RelaxationSpectrum, RheologyError};

fn main() -> Result<(), RheologyError> {
    let branch = RelaxationBranch::new;
    let branches = vec![branch(5e5, 1e-1), branch(5e6, 1e-3), branch(3e8, 1e-6)];
    let rubber = Prony::new(RelaxationSpectrum::new(1e6, 0.0, branches)?)?;
    let mut largest: f64 = 0.0;
    for decade in -1..=8 {
        let omega = 10.0_f64.powi(decade);
        let modulus = rubber.complex_modulus(omega)?;
        let tangent = rubber.loss_tangent(omega)?;
        largest = largest.max(tangent);
        println!(
            "{omega:8.0e} rad/s   G' {:.2e} Pa   G'' {:.2e} Pa   tan delta {tangent:.3}",
            modulus.storage, modulus.loss
        );
    }
    assert!(largest > 1.0, "the glass transition lies in this range");
    Ok(())
}
