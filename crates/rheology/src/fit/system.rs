//! The linear least-squares system behind a Prony series with given relaxation times.
//!
//! ```text
//! G'(ω) = G_∞ + Σ G_k Ω²/(1 + Ω²)    G''(ω) = Σ G_k Ω/(1 + Ω²)    G(t) = G_∞ + Σ G_k e^(−t/τ_k)
//! ```
//! Every row is divided by the magnitude of the measured modulus at its frequency or time, so that the sum of squares is
//! that of relative errors of the complex modulus.

use super::curve::{MeasuredCurve, Points};
use crate::complex::debye;

#[derive(Debug, Clone, Copy)]
enum Quantity {
    Storage,
    Loss,
    Relaxation,
}

/// One measured number.
#[derive(Debug, Clone, Copy)]
pub(super) struct Row {
    quantity: Quantity,
    /// ω or t.
    at: f64,
    pub(super) value: f64,
    /// Inverse of the magnitude of the modulus.
    pub(super) weight: f64,
}

/// Rows of all measured numbers.
pub(super) fn rows(curve: &MeasuredCurve) -> Vec<Row> {
    match curve.points() {
        Points::Oscillation(points) => points
            .iter()
            .flat_map(|point| {
                let row = |quantity, value| Row {
                    quantity,
                    at: point.angular_frequency,
                    value,
                    weight: point.storage.hypot(point.loss).recip(),
                };
                [
                    row(Quantity::Storage, point.storage),
                    row(Quantity::Loss, point.loss),
                ]
            })
            .collect(),
        Points::Relaxation(points) => points
            .iter()
            .map(|point| Row {
                quantity: Quantity::Relaxation,
                at: point.time,
                value: point.modulus,
                weight: point.modulus.recip(),
            })
            .collect(),
    }
}

impl Row {
    /// Whether both numbers belong to one measurement.
    pub(super) fn same_point(&self, other: &Self) -> bool {
        self.at.to_bits() == other.at.to_bits()
    }

    /// What a spring of unit modulus contributes.
    pub(super) const fn spring(&self) -> f64 {
        match self.quantity {
            Quantity::Storage | Quantity::Relaxation => 1.0,
            Quantity::Loss => 0.0,
        }
    }

    /// What a branch of unit modulus contributes, and its derivative by ln τ.
    pub(super) fn branch(&self, relaxation_time: f64) -> [f64; 2] {
        match self.quantity {
            Quantity::Storage => {
                let [in_phase, out_of_phase] = debye(self.at * relaxation_time);
                [in_phase, 2.0 * out_of_phase * out_of_phase]
            }
            Quantity::Loss => {
                let [in_phase, out_of_phase] = debye(self.at * relaxation_time);
                [out_of_phase, out_of_phase * (1.0 - 2.0 * in_phase)]
            }
            Quantity::Relaxation => {
                let x = self.at / relaxation_time;
                let decay = (-x).exp();
                // The product of infinity and zero would be NaN.
                [decay, if decay > 0.0 { x * decay } else { 0.0 }]
            }
        }
    }
}
