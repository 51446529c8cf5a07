//! A measured surface slides: heights, a material, a load and an error are all that is needed.

#![expect(clippy::print_stdout, reason = "an example shows its results")]

use bem_halfspace::steady;
use indenters::{HeightMap, SlidingLoad};
use rheology::{StandardSolid, StandardSolidParameters};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    // A tip that is twice as long as wide, on a grid of 20 µm.
    let (n, spacing) = (161, 2e-5);
    let place = |index: usize| (index as f64 - 80.0) * spacing;
    // Heights point out of the body, and x runs along a row.
    let height = |k: usize| -100.0 * place(k % n).powi(2) - 400.0 * place(k / n).powi(2);
    let heights: Vec<f64> = (0..n * n).map(height).collect();
    let map = HeightMap::from_heights([n, n], [spacing; 2], &heights)?;
    let rubber = StandardSolid::new(StandardSolidParameters {
        equilibrium_modulus: 1e6,
        maxwell_modulus: 1e7,
        viscosity: 1e4,
    })?;
    let state = steady(&map, &rubber, &SlidingLoad::new(0.05, 0.3)?, 2e-2)?;
    let friction = state.friction_coefficient;
    println!("μ = {:.4} ± {:.0e}", friction.value, friction.error);
    println!("contact from {:?} m", state.finest.contact_x);
    assert!(
        friction.value > 0.0 && friction.error < 3e-2 * friction.value,
        "{friction:?}"
    );
    Ok(())
}
