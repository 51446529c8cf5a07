//! Friction of a sphere on rubber over the sliding speed, with the error of each number.

use std::error::Error;

use indenters::{EquivalentLine, SlidingLoad, Sphere};
use mdr_core::steady;
use rheology::{StandardSolid, StandardSolidParameters};

#[expect(clippy::print_stdout, reason = "a program")]
fn main() -> Result<(), Box<dyn Error>> {
    let sphere = Sphere::new(0.005)?;
    let rubber = StandardSolid::new(StandardSolidParameters {
        equilibrium_modulus: 1e6,
        maxwell_modulus: 1e7,
        viscosity: 1e4,
    })?;
    println!("velocity m/s  friction coefficient  depth m");
    for decade in -4..=2 {
        let velocity = 10_f64.powi(decade);
        let load = SlidingLoad::new(2.0, velocity)?;
        let state = steady(&EquivalentLine(&sphere), &rubber, &load, 1e-6)?;
        let (friction, depth) = (state.friction_coefficient, state.indentation_depth);
        println!(
            "{velocity:12.0e}  {:.6} ± {:.0e}     {:.3e}",
            friction.value, friction.error, depth.value
        );
    }
    Ok(())
}
