//! Friction of a sphere that slides on a rubber with two relaxation times, with its error bar.

#![expect(clippy::print_stdout, reason = "an example shows its results")]

use bem_halfspace::steady;
use indenters::{SlidingLoad, Sphere};
use rheology::{Prony, RelaxationBranch, RelaxationSpectrum};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let branch = RelaxationBranch::new;
    let branches = vec![branch(1e7, 1e-3), branch(3e6, 1e-1)];
    let rubber = Prony::new(RelaxationSpectrum::new(1e6, 0.0, branches)?)?;
    let sphere = Sphere::new(5e-3)?;
    for velocity in [1e-3, 1e-2, 1e-1, 1.0] {
        let state = steady(&sphere, &rubber, &SlidingLoad::new(2.0, velocity)?, 1e-3)?;
        let (friction, area) = (state.friction_coefficient, state.contact_area);
        println!(
            "v = {velocity:5} m/s: μ = {:.5} ± {:.0e}, area {:.2e} ± {:.0e} m²",
            friction.value, friction.error, area.value, area.error
        );
        assert!(
            friction.error <= 2e-3 * friction.value,
            "the error asked for"
        );
    }
    Ok(())
}
