//! The linear least-squares system behind a Prony series with given relaxation times.
//!
//! ```text
//! G'(ω) = G_∞ + Σ G_k Ω²/(1 + Ω²)    G''(ω) = Σ G_k Ω/(1 + Ω²)    G(t) = G_∞ + Σ G_k e^(−t/τ_k)
//! ```
//! Every row is divided by the scale of its number, so that the sum of squares is that of relative errors.

use crate::complex::debye;

/// A measured quantity: G'(ω), G''(ω) or G(t).
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub(super) enum Quantity {
    /// Storage modulus G' over the angular frequency.
    Storage,
    /// Loss modulus G'' over the angular frequency.
    Loss,
    /// Relaxation modulus G over the time.
    Relaxation,
}

/// One measured number.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub(super) struct Measurement {
    /// Measured quantity.
    pub(super) quantity: Quantity,
    /// Angular frequency ω \[rad/s] or time t \[s].
    pub(super) at: f64,
    /// Measured modulus, \[Pa].
    pub(super) value: f64,
    /// Scale of the relative error of this number, \[Pa].
    pub(super) size: f64,
    /// Weight of its error in the least squares, \[1/Pa]; initially the inverse of |G*| or of G(t).
    pub(super) weight: f64,
    /// Index of the isotherm of a master curve; 0 for a single curve.
    pub(super) isotherm: usize,
}

/// Smallest ratio of the scale of the errors of a modulus to |G*|. Chosen: no instrument distinguishes it from zero.
pub(super) const MIN_RELATIVE_SIZE: f64 = 1e-3;

impl Measurement {
    /// Contribution of a spring of unit modulus to the measured quantity: 1 to G' and G(t), 0 to G''.
    pub(super) const fn spring(&self) -> f64 {
        match self.quantity {
            Quantity::Storage | Quantity::Relaxation => 1.0,
            Quantity::Loss => 0.0,
        }
    }

    /// Response of a branch of unit modulus and of a relaxation time \[s], and its derivative by ln τ.
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
