//! The foundation under one polynomial segment of the line: loads, dissipation, and their changes with the displacement.

use super::foundation::{Branch, Foundation};
use super::polynomial_step::{BranchStress, MAX_TERMS, branch_stress};
use crate::line::{Segment, derivative, square_integral, start_value, value};

/// Factor s in a bound of how much a dissipation c ∫ r² dt over −1 ≤ t ≤ 1 changes if the displacement changes by δ: at most by
/// s c ‖r‖ δ. Here r is the rate of the displacement, or the stress of a branch.
///
/// Cauchy and Schwarz give 2 c ‖r‖ ‖δr‖. The rate is assumed to change by 2 √2 δ in the root mean square, so that
/// ‖δr‖ = 4 δ.
const DISSIPATION_SENSITIVITY: f64 = 8.0;

/// Bounds of the changes of a contact by a jump δ of the displacement, divided by δ; displacements are in depths.
pub(crate) struct JumpSensitivity {
    /// Change of the load ∫ w dξ divided by δ, \[m].
    pub(crate) load: f64,
    /// Change of the work ∫ w h̃' dξ divided by δ.
    pub(crate) work: f64,
}

/// A boundary layer `amplitude · e^(−ratio (1 + t))`.
pub(crate) struct Layer {
    /// Amplitude at t = −1, in the unit of stress.
    pub(crate) amplitude: f64,
    /// Rate a of the decay e^(−a (1 + t)) with t, without unit.
    pub(crate) ratio: f64,
}

/// Solution of the foundation under one segment of the line.
pub(crate) struct SegmentSolution {
    /// Legendre coefficients of the part of w that is a polynomial of t.
    smooth: [f64; MAX_TERMS],
    /// Number of these coefficients that may differ from 0.
    n_terms: usize,
    /// Boundary layers of the load w, which decay from the front end of the segment.
    pub(crate) layers: Vec<Layer>,
    /// Load ∫ w dξ on the segment, divided by depth and unit of stress, \[m].
    pub(crate) load: f64,
    /// Energy ∫ (η₀ v u'² + Σ e_i²/(G_i l_i)) dξ that the dashpots dissipate, divided by the squared depth and the unit of
    /// stress.
    pub(crate) dissipation: f64,
    /// Bound of the change of the dissipation per change of the displacement by δ, see [`DISSIPATION_SENSITIVITY`].
    pub(crate) dissipation_change: f64,
    /// Rounding error of `dissipation`, in the same unit.
    pub(crate) dissipation_rounding: f64,
    /// Stress e_i of each branch at the rear end of the segment, in depths times the unit of stress.
    pub(crate) stresses: Vec<f64>,
}

impl Foundation {
    /// The shortest distance of relaxation, \[m]; 0 with a parallel dashpot, infinite for an elastic foundation.
    pub(crate) fn shortest_length(&self) -> f64 {
        if self.dashpot > 0.0 {
            return 0.0;
        }
        let lengths = self.branches.iter().map(|branch| branch.length);
        lengths.fold(f64::INFINITY, f64::min)
    }

    /// Bound of the change of ∫ w dξ on a segment of a length \[m] by a change δ of the displacement, divided by δ, \[m]. A branch
    /// keeps its stress over its distance of relaxation at most.
    pub(crate) fn stiffness(&self, length: f64) -> f64 {
        let branches = self.branches.iter();
        let relaxing: f64 = branches.map(|b| b.modulus * length.min(b.length)).sum();
        self.spring * length + self.dashpot + relaxing
    }

    /// Bounds of the changes by a jump δ of the displacement that is neglected in the parallel dashpot only.
    ///
    /// The displacement changes by `rate` at the jump, in depths per metre.
    pub(crate) fn dashpot_sensitivity(&self, rate: f64) -> JumpSensitivity {
        JumpSensitivity {
            load: self.dashpot,
            work: self.dashpot * rate.abs(),
        }
    }

    /// Bounds of the changes by a jump δ that is neglected in dashpot, spring and branches, under a contact of a length \[m].
    ///
    /// A fast branch works over its own distance of relaxation, and a slow one returns most of the energy that it takes up.
    pub(crate) fn sensitivity(&self, rate: f64, length: f64) -> JumpSensitivity {
        let fraction = |b: &Branch| {
            let over_relaxation = b.length * rate.abs();
            over_relaxation.min(4.0 * length / b.length).min(1.0)
        };
        let moduli: f64 = self.branches.iter().map(|b| b.modulus * fraction(b)).sum();
        JumpSensitivity {
            load: self.stiffness(length),
            work: self.dashpot_sensitivity(rate).work + moduli,
        }
    }

    /// Solves the foundation under a segment of the line, from the `stresses` e_i of the branches at its front end.
    pub(crate) fn solve_segment(&self, segment: &Segment, stresses: &[f64]) -> SegmentSolution {
        let rates = derivative(&segment.displacements);
        let per_length = 2.0 / segment.length;
        let square_rate = square_integral(&rates);
        let dashpot = self.dashpot * per_length;
        let rise = segment.end() - start_value(&segment.displacements);

        // The solution begins with the spring and the parallel dashpot, whose load follows the displacement and its rate without delay.
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

        // Each branch is solved from its stress at the front end of the segment, and adds its stress, load and dissipation.
        let n_rates = segment.degree.max(1);
        for (branch, start) in self.branches.iter().zip(stresses) {
            let ratio = 0.5 * segment.length / branch.length;
            let driven = rates.map(|rate| branch.modulus * rate);
            let stress = branch_stress(ratio, *start, &driven[..n_rates]);
            solution.add_branch(&stress, ratio);
            solution.load += 0.5 * segment.length * stress.integral;
            solution.dissipation += ratio * (stress.square_integral / branch.modulus);
            solution.dissipation_change +=
                DISSIPATION_SENSITIVITY * ratio.min(1.0) * stress.square_integral.sqrt();
        }
        solution
    }
}

impl SegmentSolution {
    /// Adds the stress of one branch, whose boundary layer has the `ratio` of the segment to its distance of relaxation.
    fn add_branch(&mut self, stress: &BranchStress, ratio: f64) {
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

    /// Load potential w at −1 ≤ t ≤ 1, in depths times the unit of stress.
    pub(crate) fn potential(&self, t: f64) -> f64 {
        let layers = self.layers.iter();
        let decaying = layers.map(|layer| layer.amplitude * (-layer.ratio * (1.0 + t)).exp());
        value(&self.smooth[..self.n_terms], t) + decaying.sum::<f64>()
    }
}
