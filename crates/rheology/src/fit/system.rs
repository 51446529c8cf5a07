//! The linear least-squares system behind a Prony series with given relaxation times.
//!
//! ```text
//! G'(ω) = G_∞ + Σ G_k Ω²/(1 + Ω²)    G''(ω) = Σ G_k Ω/(1 + Ω²)    G(t) = G_∞ + Σ G_k e^(−t/τ_k)
//! ```
//! Every row is divided by the size of its number, so that the sum of squares is that of relative errors.

use crate::complex::debye;

#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub(super) enum Quantity {
    Storage,
    Loss,
    Relaxation,
}

/// One measured number.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub(super) struct Measurement {
    pub(super) quantity: Quantity,
    /// ω or t.
    pub(super) at: f64,
    pub(super) value: f64,
    /// What errors of this number by itself are relative to.
    pub(super) size: f64,
    /// Of its error in the squares; inverse of the magnitude of the modulus until more is known.
    pub(super) weight: f64,
    /// Of a master curve; 0 of a single curve.
    pub(super) isotherm: usize,
}

/// Errors of a modulus that is a smaller part of |G*| are relative to this part: no instrument tells it from zero.
pub(super) const LEAST_PART: f64 = 1e-3;

impl Measurement {
    /// What a spring of unit modulus contributes.
    pub(super) const fn spring(&self) -> f64 {
        match self.quantity {
            Quantity::Storage | Quantity::Relaxation => 1.0,
            Quantity::Loss => 0.0,
        }
    }

    /// What a branch of unit modulus contributes, and its derivative by ln τ.
    pub(super) fn branch(&self, relaxation_time: f64) -> [f64; 2] {
        let [in_phase, out_of_phase] = debye(self.at * relaxation_time);
        match self.quantity {
            Quantity::Storage => [in_phase, 2.0 * out_of_phase * out_of_phase],
            Quantity::Loss => [out_of_phase, out_of_phase * (1.0 - 2.0 * in_phase)],
            Quantity::Relaxation => {
                let x = self.at / relaxation_time;
                let decay = (-x).exp();
                // The product of infinity and zero would be NaN.
                [decay, if decay > 0.0 { x * decay } else { 0.0 }]
            }
        }
    }
}
