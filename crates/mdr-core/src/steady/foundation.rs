//! Law of an element of the Winkler foundation under a line that moves at constant speed.
//!
//! ```text
//! w = G_∞ u + η₀ v du/dξ + Σ e_i,   l_i de_i/dξ + e_i = l_i G_i du/dξ,   l_i = v τ_i        under the line
//! w = 0,   u = u₀ + Σ β_k (1 − e^(−ξ/L_k)),   L_k = v λ_k                                   behind it
//! ```
//! Displacements are in units of the depth, moduli and w in a unit of the material. ξ is the distance by which the line has
//! moved on. The stresses e_i decompose into the modes of free recovery as into eigenvectors: both directions are sums over
//! 1/(L_k − l_i).
//!
//! Theory: docs/theory/line-viscoelastic.md, "One law".

use numerics::positive;
use rheology::{Material, check_spectra};

use super::branch::{BranchStress, MAX_TERMS, branch_stress};
use super::legendre::{derivative, square_integral, start_value, value};
use super::segment::Segment;
use crate::MdrError;

/// Change of the dissipation per change of the displacement: the mean change of the rate over a segment, times 2 √2
/// from the square.
const DISSIPATION_SENSITIVITY: f64 = 8.0;

/// The foundation at one speed, with distances v τ and v λ in the place of times.
pub(crate) struct Foundation {
    /// Unit of all stresses, \[Pa], so that their squares stay in range: the instantaneous modulus, or η₀ v over 1 m for a lone
    /// dashpot.
    pub(crate) unit: f64,
    /// G_∞ over the unit.
    pub(crate) spring: f64,
    /// η₀ v over the unit, \[m].
    pub(crate) dashpot: f64,
    pub(crate) branches: Vec<Branch>,
    pub(crate) modes: Vec<Mode>,
}

/// A Maxwell branch.
pub(crate) struct Branch {
    /// G_i over the unit.
    pub(crate) modulus: f64,
    /// l_i = v τ_i, \[m].
    pub(crate) length: f64,
    /// l_i/(L_k − l_i) of all modes.
    ratios: Vec<f64>,
}

/// A mode of free recovery.
#[derive(Debug)]
pub(crate) struct Mode {
    /// J_k times the unit.
    pub(crate) compliance: f64,
    /// L_k = v λ_k, \[m].
    pub(crate) length: f64,
    /// l_i/(L_k − l_i) of all branches.
    ratios: Vec<f64>,
}

impl Mode {
    /// Fraction that recovers within a time, or over a distance, in the unit of the length.
    pub(crate) fn recovered(&self, time: f64) -> f64 {
        -(-time / self.length).exp_m1()
    }
}

/// Bounds of changes of a contact by a jump δ of the displacement, relative to δ.
pub(super) struct JumpSensitivity {
    /// Change of ∫ w dξ, \[m].
    pub(super) load: f64,
    /// Change of the work.
    pub(super) work: f64,
}

/// A boundary layer `amplitude · e^(−ratio (1 + t))`.
pub(super) struct Layer {
    pub(super) amplitude: f64,
    pub(super) ratio: f64,
}

/// Solution of the foundation under one segment of the line.
pub(super) struct SegmentSolution {
    /// Legendre coefficients of the smooth part of w.
    smooth: [f64; MAX_TERMS],
    n_terms: usize,
    /// Boundary layers of w.
    pub(super) layers: Vec<Layer>,
    /// ∫ w dξ, \[m].
    pub(super) load: f64,
    /// Energy that the dashpots dissipate, ∫ (η₀ v u'² + Σ e_i²/(G_i l_i)) dξ.
    pub(super) dissipation: f64,
    /// Bound of its change per change of the displacement.
    pub(super) dissipation_change: f64,
    /// Its error by rounding.
    pub(super) dissipation_rounding: f64,
    /// Stresses of the branches at the end.
    pub(super) stresses: Vec<f64>,
}

/// A free part of the surface, which recovers since the last separation.
pub(super) struct FreeSurface {
    /// Displacement at separation, in depths.
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

        // Unit of stress.
        let dashpot = relaxation.viscosity() * velocity / factor;
        let moduli = relaxation.branches().iter().map(|branch| branch.modulus);
        let spring = relaxation.equilibrium_modulus() / factor;
        let instantaneous = spring + moduli.sum::<f64>() / factor;
        let stiffness = if instantaneous > 0.0 {
            instantaneous
        } else {
            dashpot
        };
        let unit = positive("stiffness of the foundation", stiffness)?;

        // Distances of relaxation and retardation.
        let lengths = |times: Vec<f64>, name| {
            let lengths = times
                .into_iter()
                .map(|time| positive(name, velocity * time));
            lengths.collect::<Result<Vec<f64>, _>>()
        };
        let times = relaxation.branches().iter().map(|b| b.relaxation_time);
        let relaxation_lengths = lengths(times.collect(), "distance of relaxation")?;
        let times = creep.elements().iter().map(|e| e.retardation_time);
        let recovery_lengths = lengths(times.collect(), "distance of retardation")?;

        // Branches and modes with the coefficients of the transformation between them.
        let ratio = |branch: f64, mode: f64| branch / (mode - branch);
        let branch_lengths = relaxation.branches().iter().zip(&relaxation_lengths);
        let branches = branch_lengths.map(|(branch, &length)| Branch {
            modulus: branch.modulus / factor / unit,
            length,
            ratios: recovery_lengths
                .iter()
                .map(|&mode| ratio(length, mode))
                .collect(),
        });
        let mode_lengths = creep.elements().iter().zip(&recovery_lengths);
        let modes = mode_lengths.map(|(element, &length)| Mode {
            compliance: element.compliance * factor * unit,
            length,
            ratios: relaxation_lengths
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

    /// The shortest distance of relaxation, \[m]; 0 with a lone dashpot, infinite for an elastic foundation.
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

    /// Bound of the change of ∫ w dξ by a displacement δ on a segment of this length, relative to δ, \[m].
    pub(super) fn stiffness(&self, length: f64) -> f64 {
        let branches = self.branches.iter();
        let relaxing: f64 = branches.map(|b| b.modulus * length.min(b.length)).sum();
        self.spring * length + self.dashpot + relaxing
    }

    /// Mean modulus over a time after an instantaneous compression.
    pub(crate) fn mean_modulus(&self, time: f64) -> f64 {
        if time <= 0.0 {
            return 0.0;
        }
        let branches = self.branches.iter();
        let left = |b: &Branch| -(-time / b.length).exp_m1() * b.length / time;
        let relaxing: f64 = branches.map(|b| b.modulus * left(b)).sum();
        self.spring + self.dashpot / time + relaxing
    }

    /// Applies an instantaneous compression to the stresses of the branches.
    pub(crate) fn apply_strain_jump(&self, stresses: &mut [f64], compression: f64) {
        for (stress, branch) in stresses.iter_mut().zip(&self.branches) {
            *stress += branch.modulus * compression;
        }
    }

    /// Bounds of the changes by a jump δ of the displacement that the branches account for: only the lone dashpot is left.
    ///
    /// The displacement changes by `rate` per metre at the jump.
    pub(super) fn dashpot_sensitivity(&self, rate: f64) -> JumpSensitivity {
        JumpSensitivity {
            load: self.dashpot,
            work: self.dashpot * rate.abs(),
        }
    }

    /// Bounds of the changes by a jump δ that is neglected altogether, under a contact of this length \[m].
    ///
    /// A fast branch works over its own distance of relaxation, and a slow one returns most of the energy that it takes up.
    pub(super) fn sensitivity(&self, rate: f64, length: f64) -> JumpSensitivity {
        let part = |b: &Branch| {
            let own = b.length * rate.abs();
            own.min(4.0 * length / b.length).min(1.0)
        };
        let moduli: f64 = self.branches.iter().map(|b| b.modulus * part(b)).sum();
        JumpSensitivity {
            load: self.stiffness(length),
            work: self.dashpot_sensitivity(rate).work + moduli,
        }
    }

    /// Elastic energy of the springs, (G_∞ u² + Σ e_i²/G_i)/2.
    pub(crate) fn stored_energy(&self, displacement: f64, stresses: &[f64]) -> f64 {
        let branches = self.branches.iter().zip(stresses);
        let stored: f64 = branches.map(|(b, e)| e * (e / b.modulus)).sum();
        0.5 * (self.spring * displacement * displacement + stored)
    }

    /// Solves the foundation under a segment of the line, from the stresses of the branches at its front end.
    pub(super) fn solve_segment(&self, segment: &Segment, stresses: &[f64]) -> SegmentSolution {
        let rates = derivative(&segment.displacements);
        let per_length = 2.0 / segment.length;
        let square_rate = square_integral(&rates);
        let dashpot = self.dashpot * per_length;
        let rise = segment.end() - start_value(&segment.displacements);

        // The spring and the lone dashpot.
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

        // The branches.
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

    /// The free surface after a separation with this displacement and these stresses.
    pub(super) fn release(&self, displacement: f64, stresses: &[f64]) -> FreeSurface {
        let amplitude = |mode: &Mode| self.amplitude(mode, displacement, stresses);
        FreeSurface {
            displacement,
            amplitudes: self.modes.iter().map(amplitude).collect(),
            distance: 0.0,
        }
    }

    /// Amplitude β of a mode after a separation with this displacement and these stresses.
    pub(crate) fn amplitude(&self, mode: &Mode, displacement: f64, stresses: &[f64]) -> f64 {
        let terms = mode.ratios.iter().zip(stresses).map(|(r, e)| r * e);
        mode.compliance * (terms.sum::<f64>() - self.spring * displacement)
    }

    /// A free surface that recovers to the undeformed state, with the amplitudes that are left in the modes.
    pub(super) fn recovering_surface(&self, left: &[f64]) -> FreeSurface {
        FreeSurface {
            displacement: -left.iter().sum::<f64>(),
            amplitudes: left.to_vec(),
            distance: 0.0,
        }
    }

    /// Amplitudes left in the modes of a free surface, at a distance behind its present position.
    pub(super) fn remaining_amplitudes(&self, surface: &FreeSurface, distance: f64) -> Vec<f64> {
        let xi = surface.distance + distance;
        let amplitude = |k: usize| surface.amplitudes.get(k).copied().unwrap_or(0.0);
        let modes = self.modes.iter().enumerate();
        modes
            .map(|(k, mode)| amplitude(k) * (-xi / mode.length).exp())
            .collect()
    }

    /// The longest distance of recovery, \[m]; 0 for an elastic foundation.
    pub(super) fn longest_recovery(&self) -> f64 {
        self.modes
            .iter()
            .map(|mode| mode.length)
            .fold(0.0, f64::max)
    }

    /// Displacement of a free surface at a distance behind its present position, in depths.
    pub(super) fn free_displacement(&self, surface: &FreeSurface, distance: f64) -> f64 {
        let xi = surface.distance + distance;
        let modes = self.modes.iter().zip(&surface.amplitudes);
        let recovered = modes.map(|(mode, beta)| -beta * (-xi / mode.length).exp_m1());
        surface.displacement + recovered.sum::<f64>()
    }

    /// Stresses in the branches of a free surface at a distance behind its present position.
    pub(super) fn free_stresses(&self, surface: &FreeSurface, distance: f64) -> Vec<f64> {
        let xi = surface.distance + distance;
        let modes = self.modes.iter().zip(&surface.amplitudes);
        let left = modes.map(|(mode, beta)| beta * (-xi / mode.length).exp());
        let left: Vec<f64> = left.collect();
        let stress = |branch: &Branch| Self::free_stress(branch, &left);
        self.branches.iter().map(stress).collect()
    }

    /// Stress in a branch of a free surface with the amplitudes `left` = β e^(−ξ/L) in the modes.
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

    /// Load potential w at −1 ≤ t ≤ 1, in the unit of stress.
    pub(super) fn potential(&self, t: f64) -> f64 {
        let layers = self.layers.iter();
        let decaying = layers.map(|layer| layer.amplitude * (-layer.ratio * (1.0 + t)).exp());
        value(&self.smooth[..self.n_terms], t) + decaying.sum::<f64>()
    }
}

impl FreeSurface {
    /// A surface that was never in contact.
    pub(super) fn untouched() -> Self {
        Self {
            displacement: 0.0,
            amplitudes: Vec::new(),
            distance: f64::INFINITY,
        }
    }
}
