//! A material as the elements of the foundation see it while the line passes over them.
//!
//! ```text
//! w = G_∞ u + η₀ v du/dξ + Σ e_i,   l_i de_i/dξ + e_i = l_i G_i du/dξ,   l_i = v τ_i        under the line
//! w = 0,   u = u₀ + Σ β_k (1 − e^(−ξ/L_k)),   L_k = v λ_k                                   behind it
//! ```
//! Displacements are in units of the depth and moduli in one of the material, and with them w. ξ is the distance by which the line has moved on. The stresses e_i decompose into the modes of free recovery like
//! into eigenvectors: with the relaxation times as poles, both directions are sums over 1/(L_k − l_i).

use numerics::positive;
use rheology::{Material, check_spectra};

use super::branch::{BranchStress, MAX_TERMS, branch_stress};
use super::legendre::{derivative, square_integral, start_value, value};
use super::segment::Segment;
use crate::MdrError;

/// Change of the dissipation per change of the displacement: the mean change of the rate over a segment, times 2 √2
/// from the square.
const DISSIPATION_SENSITIVITY: f64 = 8.0;

/// The foundation at one speed; all times are distances.
pub(crate) struct Foundation {
    /// Unit of all stresses, so that their squares stay numbers: the modulus at once, or η₀ v of a lone dashpot over 1 m,
    /// \[Pa].
    pub(crate) unit: f64,
    /// G_∞.
    pub(crate) spring: f64,
    /// η₀ v, \[m].
    pub(crate) dashpot: f64,
    pub(crate) branches: Vec<Branch>,
    pub(crate) modes: Vec<Mode>,
}

pub(crate) struct Branch {
    pub(crate) modulus: f64,
    pub(crate) length: f64,
    /// l/(L_k − l) of all modes.
    ratios: Vec<f64>,
}

#[derive(Debug)]
pub(crate) struct Mode {
    pub(crate) compliance: f64,
    pub(crate) length: f64,
    /// l_i/(L − l_i) of all branches.
    ratios: Vec<f64>,
}

impl Mode {
    /// Part that recovers within a time, or over a distance.
    pub(crate) fn recovered(&self, time: f64) -> f64 {
        -(-time / self.length).exp_m1()
    }
}

/// A boundary layer `amplitude · e^(−ratio (1 + t))`.
pub(super) struct Layer {
    pub(super) amplitude: f64,
    pub(super) ratio: f64,
}

/// What the foundation does under one segment.
pub(super) struct SegmentSolution {
    smooth: [f64; MAX_TERMS],
    n_terms: usize,
    pub(super) layers: Vec<Layer>,
    /// ∫ w dξ, \[m].
    pub(super) load: f64,
    /// Work that the dashpots take, ∫ (η₀ v u'² + Σ e_i²/(G_i l_i)) dξ.
    pub(super) dissipation: f64,
    /// How much that changes at most per change of the displacement.
    pub(super) dissipation_change: f64,
    /// Error of the work by rounding.
    pub(super) dissipation_rounding: f64,
    /// Stresses of the branches at the end.
    pub(super) stresses: Vec<f64>,
}

/// A part of the surface that nothing touches, since it was last left.
pub(super) struct FreeSurface {
    /// Displacement when it was left, in depths.
    pub(super) displacement: f64,
    /// β_k, in depths.
    amplitudes: Vec<f64>,
    /// Distance ξ since then, \[m]; infinite if it was never loaded.
    pub(super) distance: f64,
}

impl Foundation {
    /// The foundation of a line that moves with `velocity` \[m/s].
    pub(crate) fn new(material: &dyn Material, velocity: f64) -> Result<Self, MdrError> {
        check_spectra(material)?;
        let (relaxation, creep) = (material.relaxation(), material.creep());
        let factor = material.half_space_factor();
        let dashpot = relaxation.viscosity() * velocity / factor;
        let moduli = relaxation.branches().iter().map(|branch| branch.modulus);
        let spring = relaxation.equilibrium_modulus() / factor;
        let at_once = spring + moduli.sum::<f64>() / factor;
        let unit = if at_once > 0.0 { at_once } else { dashpot };
        let unit = positive("stiffness of the foundation", unit)?;
        let lengths = |times: Vec<f64>, name| {
            let lengths = times
                .into_iter()
                .map(|time| positive(name, velocity * time));
            lengths.collect::<Result<Vec<f64>, _>>()
        };
        let times = relaxation.branches().iter().map(|b| b.relaxation_time);
        let relaxing = lengths(times.collect(), "distance of relaxation")?;
        let times = creep.elements().iter().map(|e| e.retardation_time);
        let recovery_lengths = lengths(times.collect(), "distance of retardation")?;
        let ratio = |branch: f64, mode: f64| branch / (mode - branch);
        let branches = relaxation.branches().iter().zip(&relaxing);
        let branches = branches.map(|(branch, &length)| Branch {
            modulus: branch.modulus / factor / unit,
            length,
            ratios: recovery_lengths
                .iter()
                .map(|&mode| ratio(length, mode))
                .collect(),
        });
        let modes = creep.elements().iter().zip(&recovery_lengths);
        let modes = modes.map(|(element, &length)| Mode {
            compliance: element.compliance * factor * unit,
            length,
            ratios: relaxing
                .iter()
                .map(|&branch| ratio(branch, length))
                .collect(),
        });
        Ok(Self {
            unit,
            spring: spring / unit,
            dashpot: dashpot / unit,
            branches: branches.collect(),
            modes: modes.collect(),
        })
    }

    /// The shortest distance in which anything relaxes, \[m]; 0 with a lone dashpot, infinite without any.
    pub(super) fn shortest_length(&self) -> f64 {
        if self.dashpot > 0.0 {
            return 0.0;
        }
        let lengths = self.branches.iter().map(|branch| branch.length);
        lengths.fold(f64::INFINITY, f64::min)
    }

    pub(crate) fn has_dashpot(&self) -> bool {
        self.dashpot > 0.0
    }

    pub(crate) fn is_elastic(&self) -> bool {
        self.branches.is_empty() && !self.has_dashpot()
    }

    /// How far a displacement δ on a segment of this length can change ∫ w dξ, relative to δ, \[m].
    pub(super) fn stiffness(&self, length: f64) -> f64 {
        let branches = self.branches.iter();
        let relaxing: f64 = branches.map(|b| b.modulus * length.min(b.length)).sum();
        self.spring * length + self.dashpot + relaxing
    }

    /// The modulus in the mean over a time after a compression at once.
    pub(crate) fn mean_modulus(&self, time: f64) -> f64 {
        if time <= 0.0 {
            return 0.0;
        }
        let branches = self.branches.iter();
        let left = |b: &Branch| -(-time / b.length).exp_m1() * b.length / time;
        let relaxing: f64 = branches.map(|b| b.modulus * left(b)).sum();
        self.spring + self.dashpot / time + relaxing
    }

    /// Compresses the branches at once.
    pub(crate) fn apply_strain_jump(&self, stresses: &mut [f64], compression: f64) {
        for (stress, branch) in stresses.iter_mut().zip(&self.branches) {
            *stress += branch.modulus * compression;
        }
    }

    /// How much a jump δ at a place where the displacement changes by `rate` per metre can change ∫ w dξ and the work of the
    /// lone dashpot, relative to δ.
    pub(super) fn damping(&self, rate: f64) -> [f64; 2] {
        [self.dashpot, self.dashpot * rate.abs()]
    }

    /// The same under a contact of this length \[m] where the branches do not see the jump either: what relaxes at once
    /// works over its own distance, and what hardly relaxes gives back what it takes.
    pub(super) fn resistance(&self, rate: f64, length: f64) -> [f64; 2] {
        let part = |b: &Branch| {
            let own = b.length * rate.abs();
            own.min(4.0 * length / b.length).min(1.0)
        };
        let moduli: f64 = self.branches.iter().map(|b| b.modulus * part(b)).sum();
        [self.stiffness(length), self.damping(rate)[1] + moduli]
    }

    /// Elastic energy of the springs, (G_∞ u² + Σ e_i²/G_i)/2.
    pub(crate) fn stored_energy(&self, displacement: f64, stresses: &[f64]) -> f64 {
        let branches = self.branches.iter().zip(stresses);
        let stored: f64 = branches.map(|(b, e)| e * (e / b.modulus)).sum();
        0.5 * (self.spring * displacement * displacement + stored)
    }

    /// Follows the foundation under a segment of the line.
    pub(super) fn pass(&self, segment: &Segment, stresses: &[f64]) -> SegmentSolution {
        let rates = derivative(&segment.displacements);
        let per_length = 2.0 / segment.length;
        let square_rate = square_integral(&rates);
        let dashpot = self.dashpot * per_length;
        let rise = segment.end() - start_value(&segment.displacements);
        let mut solution = SegmentSolution {
            smooth: [0.0; MAX_TERMS],
            n_terms: rates.len(),
            layers: Vec::with_capacity(self.branches.len()),
            load: self.spring * segment.length * segment.displacements[0] + self.dashpot * rise,
            dissipation: dashpot * square_rate,
            dissipation_change: DISSIPATION_SENSITIVITY * dashpot * square_rate.sqrt(),
            dissipation_rounding: dashpot * segment.rounding * segment.rounding,
            stresses: Vec::with_capacity(self.branches.len()),
        };
        for (k, rate) in rates.iter().enumerate() {
            solution.smooth[k] = self.spring * segment.displacements[k] + dashpot * rate;
        }
        let n_rates = segment.degree.max(1);
        for (branch, start) in self.branches.iter().zip(stresses) {
            let ratio = 0.5 * segment.length / branch.length;
            let driven = rates.map(|rate| branch.modulus * rate);
            let stress = branch_stress(ratio, *start, &driven[..n_rates]);
            solution.add(&stress, ratio);
            solution.load += 0.5 * segment.length * stress.integral;
            solution.dissipation += ratio * (stress.square_integral / branch.modulus);
            solution.dissipation_change +=
                DISSIPATION_SENSITIVITY * ratio.min(1.0) * stress.square_integral.sqrt();
        }
        solution
    }

    /// Lets go of a surface with this displacement and these stresses.
    pub(super) fn release(&self, displacement: f64, stresses: &[f64]) -> FreeSurface {
        let amplitude = |mode: &Mode| self.amplitude(mode, displacement, stresses);
        FreeSurface {
            displacement,
            amplitudes: self.modes.iter().map(amplitude).collect(),
            distance: 0.0,
        }
    }

    /// β of a mode of a surface that is let go with this displacement and these stresses.
    pub(crate) fn amplitude(&self, mode: &Mode, displacement: f64, stresses: &[f64]) -> f64 {
        let pulls = mode.ratios.iter().zip(stresses).map(|(r, e)| r * e);
        mode.compliance * (pulls.sum::<f64>() - self.spring * displacement)
    }

    /// A free surface that recovers to where it was before all loads, of which so much is left in each mode.
    pub(super) fn surface_with_remainders(&self, left: &[f64]) -> FreeSurface {
        FreeSurface {
            displacement: -left.iter().sum::<f64>(),
            amplitudes: left.to_vec(),
            distance: 0.0,
        }
    }

    /// What is left in each mode of a free surface, a distance after where it is now.
    pub(super) fn remaining_amplitudes(&self, recovery: &FreeSurface, distance: f64) -> Vec<f64> {
        let xi = recovery.distance + distance;
        let amplitude = |k: usize| recovery.amplitudes.get(k).copied().unwrap_or(0.0);
        let modes = self.modes.iter().enumerate();
        modes
            .map(|(k, mode)| amplitude(k) * (-xi / mode.length).exp())
            .collect()
    }

    /// The longest distance of recovery, \[m]; 0 without any.
    pub(super) fn longest_recovery(&self) -> f64 {
        self.modes
            .iter()
            .map(|mode| mode.length)
            .fold(0.0, f64::max)
    }

    /// Displacement of a free surface, a distance after where it is now, in depths.
    pub(super) fn free_displacement(&self, recovery: &FreeSurface, distance: f64) -> f64 {
        let xi = recovery.distance + distance;
        let modes = self.modes.iter().zip(&recovery.amplitudes);
        let recovered = modes.map(|(mode, beta)| -beta * (-xi / mode.length).exp_m1());
        recovery.displacement + recovered.sum::<f64>()
    }

    /// Stresses in the branches of a free surface, a distance after where it is now.
    pub(super) fn free_stresses(&self, recovery: &FreeSurface, distance: f64) -> Vec<f64> {
        let xi = recovery.distance + distance;
        let modes = self.modes.iter().zip(&recovery.amplitudes);
        let left = modes.map(|(mode, beta)| beta * (-xi / mode.length).exp());
        let left: Vec<f64> = left.collect();
        let stress = |branch: &Branch| Self::free_stress(branch, &left);
        self.branches.iter().map(stress).collect()
    }

    /// Stress in a branch of a free surface of which `left` β e^(−ξ/L) is left in each mode.
    pub(crate) fn free_stress(branch: &Branch, left: &[f64]) -> f64 {
        let modes = branch.ratios.iter().zip(left);
        branch.modulus * modes.map(|(r, beta)| r * beta).sum::<f64>()
    }
}

impl SegmentSolution {
    fn add(&mut self, stress: &BranchStress, ratio: f64) {
        self.n_terms = self.n_terms.max(stress.n_terms);
        for (sum, term) in self.smooth.iter_mut().zip(&stress.smooth[..stress.n_terms]) {
            *sum += term;
        }
        self.stresses.push(stress.end);
        if stress.layer != 0.0 {
            self.layers.push(Layer {
                amplitude: stress.layer,
                ratio,
            });
        }
    }

    /// Load potential w at −1 ≤ t ≤ 1.
    pub(super) fn potential(&self, t: f64) -> f64 {
        let layers = self.layers.iter();
        let decaying = layers.map(|layer| layer.amplitude * (-layer.ratio * (1.0 + t)).exp());
        value(&self.smooth[..self.n_terms], t) + decaying.sum::<f64>()
    }
}

impl FreeSurface {
    /// A surface that was never touched.
    pub(super) fn untouched() -> Self {
        Self {
            displacement: 0.0,
            amplitudes: Vec::new(),
            distance: f64::INFINITY,
        }
    }
}
