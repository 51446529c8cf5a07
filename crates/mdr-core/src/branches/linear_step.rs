//! Exact response of the Maxwell branches of an element to a compression at constant rate over a time Δt.
//!
//! ```text
//! τ de/dt + e = τ G du/dt,   du/dt = Δu/Δt,   a = Δt/τ,   φ(a) = (1 − e^(−a))/a
//! e(Δt) = e₀ e^(−a) + G φ(a) Δu
//! ∫ e dt/Δt = e₀ φ(a) + G Δu (1 − φ(a))/a
//! ∫ e² dt/(G τ) = (a/G) e₀² φ(2a) + 2 e₀ Δu (φ(a) − φ(2a)) + G Δu² (1 − 2 φ(a) + φ(2a))/a
//! ```

use super::foundation::{Branch, Foundation, Mode};

/// Ratio a = Δt/τ up to which differences of φ are summed as series, because their terms cancel; the closed forms lose less than
/// two digits above it.
const SERIES_MAX_RATIO: f64 = 0.5;
/// Number of terms in the series of φ(a) = (1 − e^(−a))/a up to a = [`SERIES_MAX_RATIO`]: the first one left out is at most
/// (2a)^19/20! = 4e-19.
const N_PHI_TERMS: usize = 18;
/// Coefficients of a^k, k ≥ 1, in φ(a) − 1, φ(a) − φ(2a), and 1 − 2 φ(a) + φ(2a).
const PHI_SERIES: [[f64; N_PHI_TERMS]; 3] = [
    phi_series(1.0, 0.0),
    phi_series(1.0, -1.0),
    phi_series(-2.0, 1.0),
];
/// Branches that are computed together, so that the compiler can use vector instructions (four numbers fill 256 bits); a
/// history variable without a branch is 0.
pub(crate) const LANES: usize = 4;

/// One number for each of [`LANES`] branches.
type Lanes = [f64; LANES];

/// Coefficients of a step of one duration, for all branches and modes of an element. Displacements are in metres, stresses over
/// the unit of the foundation.
#[derive(Debug, Clone, Default)]
pub(crate) struct TimeStep {
    /// Duration Δt, \[s].
    pub(crate) duration: f64,
    /// Load of an element at the end per compression in the step: G_∞ + η₀/Δt + Σ G φ.
    pub(crate) stiffness: f64,
    /// Equilibrium modulus G_∞ divided by the unit of stress.
    spring: f64,
    /// Stiffness η₀/Δt of the parallel dashpot over the step.
    dashpot: f64,
    /// Coefficients of the branches.
    branches: Vec<BranchGroup>,
    /// Mean load Σ G (1 − φ(a))/a of all branches per compression, if they are free of stress before.
    mean: f64,
    /// Dissipation Σ G (1 − 2 φ(a) + φ(2a))/a of all branches per squared compression, if they are free of stress before.
    dissipation: f64,
    /// Decay e^(−Δt/λ) of the modes of recovery.
    decays: Vec<Lanes>,
}

/// Coefficients of [`LANES`] branches with the stresses e before a compression u.
#[derive(Debug, Clone, Copy, Default)]
struct BranchGroup {
    /// Factor e^(−a): the stress after the step is `decay` e + `gain` u.
    decay: Lanes,
    /// Stress G φ(a) after the step per compression.
    gain: Lanes,
    /// Mean stress φ(a) in the step per e.
    mean: Lanes,
    /// Factors c = a φ(2a)/G and d = 2 (φ(a) − φ(2a)) of the dissipation e (c e + d u), besides that of u alone.
    dissipation: [Lanes; 2],
}

/// Impulse and dissipation of an element in a step, in the units of the foundation.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct StepWork {
    /// Impulse ∫ w dt divided by the unit of stress, \[m s].
    pub(crate) impulse: f64,
    /// Energy that the dashpots of the element dissipate, divided by the unit of stress, \[m²].
    pub(crate) dissipated: f64,
}

/// Number of history variables of an element, stresses of branches or amplitudes of modes: a multiple of [`LANES`].
pub(crate) fn n_history(foundation: &Foundation) -> usize {
    let used = foundation.branches.len().max(foundation.modes.len());
    used.max(1).next_multiple_of(LANES)
}

impl TimeStep {
    /// Coefficients of branches and modes for a step of a `duration` \[s].
    pub(crate) fn new(foundation: &Foundation, duration: f64) -> Self {
        let decay = |mode: &Mode| (-duration / mode.length).exp();
        let modes = foundation.modes.chunks(LANES);
        Self {
            decays: modes.map(|modes| lanes(modes, 0.0, decay)).collect(),
            ..Self::of_branches(foundation, duration)
        }
    }

    /// Coefficients of the branches alone for a step of a `duration` \[s]; it cannot advance the recovery of a free element.
    pub(crate) fn of_branches(foundation: &Foundation, duration: f64) -> Self {
        let mut step = Self {
            duration,
            stiffness: foundation.spring,
            spring: foundation.spring,
            branches: Vec::with_capacity(foundation.branches.len().div_ceil(LANES)),
            ..Self::default()
        };
        if foundation.has_dashpot() {
            step.dashpot = foundation.dashpot / duration;
            step.stiffness += step.dashpot;
        }
        for branches in foundation.branches.chunks(LANES) {
            step.add_branches(branches);
        }
        step
    }

    /// Appends the coefficients of up to [`LANES`] branches, and adds their terms to `stiffness`, `mean` and `dissipation`.
    fn add_branches(&mut self, branches: &[Branch]) {
        let modulus = lanes(branches, 0.0, |branch| branch.modulus);
        let compliance = lanes(branches, 0.0, |branch| branch.modulus.recip());
        let a = lanes(branches, 1.0, |branch| self.duration / branch.length);
        // The coefficients of a branch need `change` = e^(−a) − 1, `once` = φ(a), `twice` = φ(2a), and three differences of φ.
        // The differences are series up to a = `SERIES_MAX_RATIO`, and closed forms above it.
        let change = a.map(|a| (-a).exp_m1());
        let once: Lanes = std::array::from_fn(|k| -change[k] / a[k]);
        let twice: Lanes = std::array::from_fn(|k| once[k] * (1.0 + 0.5 * change[k]));
        let mut differences = PHI_SERIES.map(|series| power_series(&series, a));
        for k in (0..LANES).filter(|k| a[*k] > SERIES_MAX_RATIO) {
            differences[0][k] = once[k] - 1.0;
            differences[1][k] = once[k] - twice[k];
            differences[2][k] = 1.0 - 2.0 * once[k] + twice[k];
        }
        let [lag, cross_dissipation, dissipation_of_compression] = differences;
        // The branches add their stiffness, mean load and dissipation to the sums of the step; the coefficients of each branch
        // are kept to advance its stress.
        let decay = change.map(|change| 1.0 + change);
        let gain = product(modulus, once);
        self.stiffness += total(gain);
        for k in 0..LANES {
            self.mean -= modulus[k] * lag[k] / a[k];
            self.dissipation += modulus[k] * dissipation_of_compression[k] / a[k];
        }
        self.branches.push(BranchGroup {
            decay,
            gain,
            mean: once,
            dissipation: [
                std::array::from_fn(|k| compliance[k] * a[k] * twice[k]),
                cross_dissipation.map(|cross| 2.0 * cross),
            ],
        });
    }

    /// Displacement Σ β_k e^(−Δt/λ_k) that has not recovered at the end of the step, from the amplitudes β_k at its beginning,
    /// \[m].
    pub(crate) fn remaining_recovery(&self, history: &[f64]) -> f64 {
        let decays = self.decays.iter().zip(history.as_chunks().0);
        total(decays.fold([0.0; LANES], |sum, (decays, history)| {
            add_product(sum, *decays, *history)
        }))
    }

    /// Lets the amplitudes β_k of a free element decay by e^(−Δt/λ_k) over the step.
    pub(crate) fn recover(&self, history: &mut [f64]) {
        for (decays, history) in self.decays.iter().zip(history.as_chunks_mut().0) {
            *history = product(*decays, *history);
        }
    }

    /// Load G_∞ u + Σ e_i e^(−Δt/τ_i) of an element at the end of a step without compression, divided by the unit of stress,
    /// \[m].
    pub(crate) fn relaxed_load(&self, displacement: f64, stresses: &[f64]) -> f64 {
        let branches = self.branches.iter().zip(stresses.as_chunks().0);
        let relaxed = branches.fold([0.0; LANES], |sum, (branches, stresses)| {
            add_product(sum, branches.decay, *stresses)
        });
        self.spring * displacement + total(relaxed)
    }

    /// Compresses an element at constant rate during the step, from `displacement` by `compression` \[m], and advances the
    /// `stresses` of its branches, whose number is a multiple of [`LANES`].
    pub(crate) fn compress(
        &self,
        displacement: f64,
        compression: f64,
        stresses: &mut [f64],
    ) -> StepWork {
        // The loop sums the parts of mean load and dissipation that depend on the stresses before the step, and advances these
        // stresses to its end.
        let u = [compression; LANES];
        let [mut mean, mut dissipated] = [[0.0; LANES]; 2];
        for (branches, stresses) in self.branches.iter().zip(stresses.as_chunks_mut().0) {
            let e = *stresses;
            let [by_stress, by_compression] = branches.dissipation;
            mean = add_product(mean, branches.mean, e);
            let per_stress = add_product(product(by_stress, e), by_compression, u);
            dissipated = add_product(dissipated, per_stress, e);
            *stresses = add_product(product(branches.decay, e), branches.gain, u);
        }
        // Add the spring, the dashpot, and the response of the branches to the compression itself.
        let spring = self.spring * (displacement + 0.5 * compression);
        let mean_load = total(mean) + spring + (self.dashpot + self.mean) * compression;
        StepWork {
            impulse: mean_load * self.duration,
            dissipated: total(dissipated)
                + (self.dashpot + self.dissipation) * compression * compression,
        }
    }
}

/// One number for each of up to [`LANES`] items, and `missing` for the others.
fn lanes<T>(of: &[T], missing: f64, number: impl Fn(&T) -> f64) -> Lanes {
    std::array::from_fn(|lane| of.get(lane).map_or(missing, &number))
}

/// Lane-wise sum + a b.
fn add_product(sum: Lanes, a: Lanes, b: Lanes) -> Lanes {
    std::array::from_fn(|lane| sum[lane] + a[lane] * b[lane])
}

/// Lane-wise product.
fn product(a: Lanes, b: Lanes) -> Lanes {
    std::array::from_fn(|lane| a[lane] * b[lane])
}

/// Sum over the lanes.
fn total(lanes: Lanes) -> f64 {
    lanes.iter().sum()
}

/// Coefficients of a^k, k ≥ 1, in `once` φ(a) + `twice` φ(2a), with φ(a) = Σ (−a)^k/(k + 1)!.
const fn phi_series(once: f64, twice: f64) -> [f64; N_PHI_TERMS] {
    let mut coefficients = [0.0; N_PHI_TERMS];
    let (mut term, mut power, mut k) = (1.0, 1.0, 0);
    while k < N_PHI_TERMS {
        term /= -(k as f64 + 2.0);
        power *= 2.0;
        coefficients[k] = (once + twice * power) * term;
        k += 1;
    }
    coefficients
}

/// Power series Σ c_k a^k from k = 1 on, of each lane.
fn power_series(coefficients: &[f64; N_PHI_TERMS], a: Lanes) -> Lanes {
    let terms = coefficients.iter().rev();
    terms.fold([0.0; LANES], |sum, coefficient| {
        std::array::from_fn(|lane| a[lane] * (sum[lane] + coefficient))
    })
}

#[cfg(test)]
mod tests {
    use rheology::{Prony, RelaxationBranch, RelaxationSpectrum};

    use super::*;

    /// Times over ten decades on one step: series and closed forms must meet, and energy be kept.
    #[test]
    fn the_work_of_a_step_is_stored_or_lost() {
        for time in (-5..=5).map(|power| 10_f64.powi(power)).chain([1.9, 2.1]) {
            let branches = vec![RelaxationBranch::new(3.0, time)];
            let spectrum = RelaxationSpectrum::new(1.0, 0.5, branches).expect("a spectrum");
            let material = Prony::new(spectrum).expect("a material");
            let foundation = Foundation::new(&material, 1.0).expect("a foundation");
            let step = TimeStep::new(&foundation, 1.0);
            let (displacement, compression) = (0.7, -0.3);
            let mut stresses = vec![0.2, 0.0, 0.0, 0.0];
            let before = foundation.stored_energy(displacement, &stresses);
            let done = step.compress(displacement, compression, &mut stresses);
            let after = foundation.stored_energy(displacement + compression, &stresses);
            let work = done.impulse * compression;
            let error = work - (after - before) - done.dissipated;
            assert!(
                error.abs() < 1e-13,
                "time {time}: {work}, {done:?}, {error:e}"
            );
            assert!(done.dissipated > 0.0, "time {time}: {done:?}");
        }
    }
}
