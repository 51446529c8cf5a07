//! A free part of the surface, which recovers in the modes of the foundation.

use super::foundation::{Branch, Foundation, Mode};

/// Displacement of a free part of the surface, which recovers since the last separation.
pub(crate) struct FreeSurface {
    /// Displacement at separation, in depths.
    pub(crate) displacement: f64,
    /// Amplitudes β_k of the modes at separation, in depths.
    amplitudes: Vec<f64>,
    /// Distance ξ since the separation, \[m]; infinite if it was never loaded.
    pub(crate) distance: f64,
}

impl Foundation {
    /// The free surface immediately after a separation at a displacement, in depths, with the stresses of the branches.
    pub(crate) fn release(&self, displacement: f64, stresses: &[f64]) -> FreeSurface {
        let amplitude = |mode: &Mode| self.amplitude(mode, displacement, stresses);
        FreeSurface {
            displacement,
            amplitudes: self.modes.iter().map(amplitude).collect(),
            distance: 0.0,
        }
    }

    /// A free surface that recovers to the undeformed state, from the present `amplitudes` of the modes, in depths: its displacement
    /// is minus their sum.
    pub(crate) fn recovering_surface(&self, amplitudes: &[f64]) -> FreeSurface {
        FreeSurface {
            displacement: -amplitudes.iter().sum::<f64>(),
            amplitudes: amplitudes.to_vec(),
            distance: 0.0,
        }
    }

    /// Amplitudes β_k e^(−ξ/L_k) of the modes of a free surface at a distance \[m] behind its present position, in depths; 0 if it
    /// was never in contact.
    pub(crate) fn remaining_amplitudes(&self, surface: &FreeSurface, distance: f64) -> Vec<f64> {
        let xi = surface.distance + distance;
        let amplitude = |k: usize| surface.amplitudes.get(k).copied().unwrap_or(0.0);
        let modes = self.modes.iter().enumerate();
        modes
            .map(|(k, mode)| amplitude(k) * (-xi / mode.length).exp())
            .collect()
    }

    /// The longest distance of recovery, \[m]; 0 for an elastic foundation.
    pub(crate) fn longest_recovery(&self) -> f64 {
        self.modes
            .iter()
            .map(|mode| mode.length)
            .fold(0.0, f64::max)
    }

    /// Displacement u₀ + Σ β_k (1 − e^(−ξ/L_k)) of a free surface at a distance \[m] behind its present position, in depths.
    pub(crate) fn free_displacement(&self, surface: &FreeSurface, distance: f64) -> f64 {
        let xi = surface.distance + distance;
        let modes = self.modes.iter().zip(&surface.amplitudes);
        let recovered = modes.map(|(mode, beta)| -beta * (-xi / mode.length).exp_m1());
        surface.displacement + recovered.sum::<f64>()
    }

    /// Stresses e_i in the branches of a free surface at a distance \[m] behind its present position, in depths times the unit of
    /// stress.
    pub(crate) fn free_stresses(&self, surface: &FreeSurface, distance: f64) -> Vec<f64> {
        let xi = surface.distance + distance;
        let modes = self.modes.iter().zip(&surface.amplitudes);
        let amplitudes: Vec<f64> = modes
            .map(|(mode, beta)| beta * (-xi / mode.length).exp())
            .collect();
        let stress = |branch: &Branch| Self::free_stress(branch, &amplitudes);
        self.branches.iter().map(stress).collect()
    }
}

impl FreeSurface {
    /// A surface that was never in contact.
    pub(crate) fn untouched() -> Self {
        Self {
            displacement: 0.0,
            amplitudes: Vec::new(),
            distance: f64::INFINITY,
        }
    }
}
