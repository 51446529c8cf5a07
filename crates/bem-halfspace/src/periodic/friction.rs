//! Friction of a stationary state, in two ways.
//!
//! ```text
//! μ ⟨p⟩ = ⟨p ∂h/∂x⟩ = Σ_q 2 |p̂|² (|q_x|/|q|) Im E*(|q_x| v)/|E*|²
//! ```

use crate::periodic::equations::Equations;
use crate::periodic::search::Problem;

pub(super) struct Friction {
    pub(super) from_slopes: f64,
    pub(super) from_dissipation: f64,
}

impl Friction {
    pub(super) fn of(problem: &Problem, equations: &mut Equations, pressure: &[f64]) -> Self {
        let Equations { kernel, waves, .. } = equations;
        let mut field = vec![0.0; pressure.len()];
        let mean = |field: &[f64]| {
            let products = field
                .iter()
                .zip(pressure)
                .map(|(value, pressure)| value * pressure);
            products.sum::<f64>() / pressure.iter().sum::<f64>()
        };
        kernel.slopes(waves, problem.heights, &mut field);
        let from_slopes = mean(&field);
        kernel.dissipate(waves, pressure, &mut field);
        Self {
            from_slopes,
            from_dissipation: mean(&field),
        }
    }
}
