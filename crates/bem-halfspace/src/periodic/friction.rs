//! Friction of a stationary state, in two ways.
//!
//! ```text
//! μ ⟨p⟩ = ⟨p ∂h/∂x⟩ = Σ_q 2 |p̂|² (|q_x|/|q|) Im E*(|q_x| v)/|E*|²
//! ```

use crate::BemError;
use crate::periodic::kernel::Kernel;
use crate::periodic::search::Problem;
use crate::periodic::waves::Waves;

pub(super) struct Friction {
    pub(super) from_slopes: f64,
    pub(super) from_dissipation: f64,
}

impl Friction {
    pub(super) fn of(problem: &Problem, pressure: &[f64]) -> Result<Self, BemError> {
        let kernel = Kernel::new(problem.sliding, problem.grid)?;
        let mut waves = Waves::new(problem.grid);
        let mut field = vec![0.0; pressure.len()];
        let mean = |field: &[f64]| {
            let products = field
                .iter()
                .zip(pressure)
                .map(|(value, pressure)| value * pressure);
            products.sum::<f64>() / pressure.iter().sum::<f64>()
        };
        kernel.slopes(&mut waves, problem.heights, &mut field);
        let from_slopes = mean(&field);
        kernel.dissipate(&mut waves, pressure, &mut field);
        Ok(Self {
            from_slopes,
            from_dissipation: mean(&field),
        })
    }
}
