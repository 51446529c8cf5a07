//! Law of an element of the Winkler foundation under a line that moves at constant speed.
//!
//! ```text
//! w = G_∞ u + η₀ v du/dξ + Σ e_i,   l_i de_i/dξ + e_i = l_i G_i du/dξ,   l_i = v τ_i        under the line
//! w = 0,   u = u₀ + Σ β_k (1 − e^(−ξ/L_k)),   L_k = v λ_k                                   behind it
//! ```
//! w is a quarter of the force per length of the line, ξ the distance by which the line has moved on. Moduli and w are over
//! `Foundation::unit`; a Poisson ratio ν divides the moduli of the material by 2 (1 − ν). The stationary state (`steady`) counts
//! displacements in depths. The march (`march`) counts them in metres and sets v = 1 m/s, so that l_i and L_k are the times τ_i
//! and λ_k, \[s].
//!
//! The stresses e_i decompose into the modes of free recovery as into eigenvectors: both directions are sums over 1/(L_k − l_i).
//!
//! Theory: docs/theory/line-viscoelastic.md, "One law".

use numerics::positive;
use rheology::{Material, check_spectra};

use crate::MdrError;

/// The foundation at one speed, with distances v τ and v λ in the place of times.
pub(crate) struct Foundation {
    /// Unit of all stresses, \[Pa], so that their squares stay in range: the instantaneous modulus, or η₀ v over 1 m if
    /// the material is a dashpot alone.
    pub(crate) unit: f64,
    /// Equilibrium modulus G_∞ divided by the unit.
    pub(crate) spring: f64,
    /// Parallel dashpot η₀ v divided by the unit, \[m].
    pub(crate) dashpot: f64,
    /// Maxwell branches, which carry the load in contact.
    pub(crate) branches: Vec<Branch>,
    /// Modes in which a free element recovers.
    pub(crate) modes: Vec<Mode>,
}

/// Maxwell branch of the foundation, in its units.
pub(crate) struct Branch {
    /// Modulus G_i divided by the unit.
    pub(crate) modulus: f64,
    /// Distance of relaxation l_i = v τ_i, \[m].
    pub(crate) length: f64,
    /// Coefficients l_i/(L_k − l_i), one for each mode k.
    ratios: Vec<f64>,
}

/// A mode of free recovery.
#[derive(Debug)]
pub(crate) struct Mode {
    /// Compliance J_k times the unit.
    pub(crate) compliance: f64,
    /// Distance of retardation L_k = v λ_k, \[m].
    pub(crate) length: f64,
    /// Coefficients l_i/(L_k − l_i), one for each branch i.
    ratios: Vec<f64>,
}

impl Mode {
    /// Fraction 1 − e^(−t/L) of the mode that recovers within a time t, or over a distance, in the unit of `length`.
    pub(crate) fn recovered(&self, time: f64) -> f64 {
        -(-time / self.length).exp_m1()
    }
}

impl Foundation {
    /// The Winkler foundation of a material under a line that moves with `velocity` \[m/s].
    pub(crate) fn new(material: &dyn Material, velocity: f64) -> Result<Self, MdrError> {
        check_spectra(material)?;
        let (relaxation, creep) = (material.relaxation(), material.creep());
        let half_space_factor = material.half_space_factor();

        // The unit of stress is the instantaneous modulus. Without spring and branches it is η₀ v
        // divided by one metre.
        let dashpot = relaxation.viscosity() * velocity / half_space_factor;
        let moduli = relaxation.branches().iter().map(|branch| branch.modulus);
        let spring = relaxation.equilibrium_modulus() / half_space_factor;
        let instantaneous = spring + moduli.sum::<f64>() / half_space_factor;
        let stiffness = if instantaneous > 0.0 {
            instantaneous
        } else {
            dashpot
        };
        let unit = positive("stiffness of the foundation", stiffness)?;

        // Relaxation and retardation times become distances: they are multiplied by the velocity, and refused unless the
        // product is positive.
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

        // Each branch gets its coefficients l_i/(L_k − l_i) for all modes k, and each mode the same coefficients for all
        // branches i. They convert stresses into amplitudes of recovery and back.
        let ratio = |branch: f64, mode: f64| branch / (mode - branch);
        let branch_lengths = relaxation.branches().iter().zip(&relaxation_lengths);
        let branches = branch_lengths.map(|(branch, &length)| Branch {
            modulus: branch.modulus / half_space_factor / unit,
            length,
            ratios: recovery_lengths
                .iter()
                .map(|&mode| ratio(length, mode))
                .collect(),
        });
        let mode_lengths = creep.elements().iter().zip(&recovery_lengths);
        let modes = mode_lengths.map(|(element, &length)| Mode {
            compliance: element.compliance * half_space_factor * unit,
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

    /// True if the material has a parallel dashpot.
    pub(crate) fn has_dashpot(&self) -> bool {
        self.dashpot > 0.0
    }

    /// True if the material neither relaxes nor flows.
    pub(crate) fn is_elastic(&self) -> bool {
        self.branches.is_empty() && !self.has_dashpot()
    }

    /// Mean ∫₀^t G dt'/t of the relaxation modulus over a time t after an instantaneous compression, divided by the unit; 0 for t
    /// ≤ 0.
    ///
    /// `time` is in the unit of the lengths of branches and modes.
    pub(crate) fn mean_modulus(&self, time: f64) -> f64 {
        if time <= 0.0 {
            return 0.0;
        }
        let branches = self.branches.iter();
        let mean_decay = |b: &Branch| -(-time / b.length).exp_m1() * b.length / time;
        let relaxing: f64 = branches.map(|b| b.modulus * mean_decay(b)).sum();
        self.spring + self.dashpot / time + relaxing
    }

    /// Adds G_i Δu to the stress e_i of each branch, for an instantaneous `compression` Δu.
    pub(crate) fn apply_strain_jump(&self, stresses: &mut [f64], compression: f64) {
        for (stress, branch) in stresses.iter_mut().zip(&self.branches) {
            *stress += branch.modulus * compression;
        }
    }

    /// Elastic energy (G_∞ u² + Σ e_i²/G_i)/2 of the springs of an element, divided by the unit of stress.
    pub(crate) fn stored_energy(&self, displacement: f64, stresses: &[f64]) -> f64 {
        let branches = self.branches.iter().zip(stresses);
        let stored: f64 = branches.map(|(b, e)| e * (e / b.modulus)).sum();
        0.5 * (self.spring * displacement * displacement + stored)
    }

    /// Amplitude β_k = J_k (Σ_i e_i l_i/(L_k − l_i) − G_∞ u) of a mode of recovery after a separation at the displacement u, with
    /// the `stresses` e_i of the branches.
    pub(crate) fn amplitude(&self, mode: &Mode, displacement: f64, stresses: &[f64]) -> f64 {
        let terms = mode.ratios.iter().zip(stresses).map(|(r, e)| r * e);
        mode.compliance * (terms.sum::<f64>() - self.spring * displacement)
    }

    /// Stress e_i = G_i Σ_k a_k l_i/(L_k − l_i) in branch i of a free surface, for the present `amplitudes` a_k = β_k e^(−ξ/L_k) of
    /// the modes of recovery.
    pub(crate) fn free_stress(branch: &Branch, amplitudes: &[f64]) -> f64 {
        let modes = branch.ratios.iter().zip(amplitudes);
        branch.modulus * modes.map(|(r, beta)| r * beta).sum::<f64>()
    }
}
