//! What the Maxwell branches of an element do while it is compressed evenly for a time Δt, exactly.
//!
//! ```text
//! τ de/dt + e = τ G du/dt,   du/dt = Δu/Δt,   a = Δt/τ,   φ(a) = (1 − e^(−a))/a
//! e(Δt) = e₀ e^(−a) + G φ(a) Δu
//! ∫ e dt/Δt = e₀ φ(a) + G Δu (1 − φ(a))/a
//! ∫ e² dt/(G τ) = (a/G) e₀² φ(2a) + 2 e₀ Δu (φ(a) − φ(2a)) + G Δu² (1 − 2 φ(a) + φ(2a))/a
//! ```

use crate::steady::{Branch, Foundation, Mode};

/// Ratio a = Δt/τ up to which differences of φ are summed as series, because their terms cancel.
const SERIES_MAX_RATIO: f64 = 0.5;
/// Terms of these series that matter up to a = [`SERIES_MAX_RATIO`].
const N_PHI_TERMS: usize = 18;
/// Coefficients of a^k, k ≥ 1, in φ(a) − 1, φ(a) − φ(2a), and 1 − 2 φ(a) + φ(2a).
const PHI_SERIES: [[f64; N_PHI_TERMS]; 3] = [
    coefficients([1.0, 0.0]),
    coefficients([1.0, -1.0]),
    coefficients([-2.0, 1.0]),
];
/// Branches that are computed together, so that the compiler can use vector instructions; a history variable without
/// a branch is 0.
pub(super) const LANES: usize = 4;

/// Numbers of so many branches.
type Lanes = [f64; LANES];

/// A step of one length over all branches and modes.
#[derive(Debug, Clone, Default)]
pub(super) struct TimeStep {
    pub(super) duration: f64,
    /// What an element carries at the end, per its compression in the step: G_∞ + η₀/Δt + Σ G φ.
    pub(super) stiffness: f64,
    spring: f64,
    /// η₀/Δt.
    dashpot: f64,
    branches: Vec<BranchGroup>,
    /// Of all branches the parts of mean and loss that have no stress in them.
    mean: f64,
    lost: f64,
    /// e^(−Δt/λ) of the modes of recovery.
    decays: Vec<Lanes>,
}

/// What [`LANES`] branches make of their stresses e and the compression u: a e + b u, and of the energy that they lose e (c e + d u).
#[derive(Debug, Clone, Copy, Default)]
struct BranchGroup {
    decay: Lanes,
    gain: Lanes,
    mean: Lanes,
    lost: [Lanes; 2],
}

/// What an element does in a step, in the units of the foundation.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct StepWork {
    /// ∫ w dt.
    pub(super) impulse: f64,
    /// Energy that its dashpots take.
    pub(super) lost: f64,
}

/// Numbers that an element remembers, stresses of branches or amplitudes of modes: whole [`LANES`].
pub(super) fn n_history_variables(foundation: &Foundation) -> usize {
    let used = foundation.branches.len().max(foundation.modes.len());
    used.max(1).next_multiple_of(LANES)
}

impl TimeStep {
    /// Over branches and modes.
    pub(super) fn new(foundation: &Foundation, duration: f64) -> Self {
        let decay = |mode: &Mode| (-duration / mode.length).exp();
        let modes = foundation.modes.chunks(LANES);
        Self {
            decays: modes.map(|modes| lanes(modes, 0.0, decay)).collect(),
            ..Self::of_branches(foundation, duration)
        }
    }

    /// Over branches alone.
    pub(super) fn of_branches(foundation: &Foundation, duration: f64) -> Self {
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
            step.add(branches);
        }
        step
    }

    /// Up to [`LANES`] more branches.
    fn add(&mut self, branches: &[Branch]) {
        let modulus = lanes(branches, 0.0, |branch| branch.modulus);
        let compliance = lanes(branches, 0.0, |branch| branch.modulus.recip());
        let a = lanes(branches, 1.0, |branch| self.duration / branch.length);
        // e^(−a) − 1, φ(a), and φ(2a).
        let change = a.map(|a| (-a).exp_m1());
        let once: Lanes = std::array::from_fn(|k| -change[k] / a[k]);
        let twice: Lanes = std::array::from_fn(|k| once[k] * (1.0 + 0.5 * change[k]));
        let mut differences = PHI_SERIES.map(|series| sum(&series, a));
        for k in (0..LANES).filter(|k| a[*k] > SERIES_MAX_RATIO) {
            differences[0][k] = once[k] - 1.0;
            differences[1][k] = once[k] - twice[k];
            differences[2][k] = 1.0 - 2.0 * once[k] + twice[k];
        }
        let [lag, lost, lost_alone] = differences;
        let decay = change.map(|change| 1.0 + change);
        let gain = product(modulus, once);
        self.stiffness += total(gain);
        for k in 0..LANES {
            self.mean -= modulus[k] * lag[k] / a[k];
            self.lost += modulus[k] * lost_alone[k] / a[k];
        }
        self.branches.push(BranchGroup {
            decay,
            gain,
            mean: once,
            lost: [
                std::array::from_fn(|k| compliance[k] * a[k] * twice[k]),
                lost.map(|lost| 2.0 * lost),
            ],
        });
    }

    /// The sum of what recovers, at the end.
    pub(super) fn remaining_recovery(&self, history: &[f64]) -> f64 {
        let decays = self.decays.iter().zip(history.as_chunks().0);
        total(decays.fold([0.0; LANES], |sum, (decays, history)| {
            add(sum, *decays, *history)
        }))
    }

    /// What recovers does so for the step.
    pub(super) fn recover(&self, history: &mut [f64]) {
        for (decays, history) in self.decays.iter().zip(history.as_chunks_mut().0) {
            *history = product(*decays, *history);
        }
    }

    /// What is carried at the end without compression.
    pub(super) fn relaxed_load(&self, displacement: f64, stresses: &[f64]) -> f64 {
        let branches = self.branches.iter().zip(stresses.as_chunks().0);
        let left = branches.fold([0.0; LANES], |sum, (branches, stresses)| {
            add(sum, branches.decay, *stresses)
        });
        self.spring * displacement + total(left)
    }

    /// Compresses an element by so much during the step; there are whole [`LANES`] of stresses.
    pub(super) fn compress(
        &self,
        displacement: f64,
        compression: f64,
        stresses: &mut [f64],
    ) -> StepWork {
        let u = [compression; LANES];
        let [mut mean, mut lost] = [[0.0; LANES]; 2];
        for (branches, stresses) in self.branches.iter().zip(stresses.as_chunks_mut().0) {
            let e = *stresses;
            let [by_stress, by_compression] = branches.lost;
            mean = add(mean, branches.mean, e);
            let per_stress = add(product(by_stress, e), by_compression, u);
            lost = add(lost, per_stress, e);
            *stresses = add(product(branches.decay, e), branches.gain, u);
        }
        let spring = self.spring * (displacement + 0.5 * compression);
        let mean = total(mean) + spring + (self.dashpot + self.mean) * compression;
        StepWork {
            impulse: mean * self.duration,
            lost: total(lost) + (self.dashpot + self.lost) * compression * compression,
        }
    }
}

/// Numbers of up to [`LANES`] things, and of those that are missing.
fn lanes<T>(of: &[T], step_residual: f64, number: impl Fn(&T) -> f64) -> Lanes {
    std::array::from_fn(|lane| of.get(lane).map_or(step_residual, &number))
}

/// sum + a b.
fn add(sum: Lanes, a: Lanes, b: Lanes) -> Lanes {
    std::array::from_fn(|lane| sum[lane] + a[lane] * b[lane])
}

fn product(a: Lanes, b: Lanes) -> Lanes {
    std::array::from_fn(|lane| a[lane] * b[lane])
}

fn total(lanes: Lanes) -> f64 {
    lanes.iter().sum()
}

/// Of a combination of φ(a) = Σ (−a)^k/(k + 1)! and φ(2a) what the powers from k = 1 on are multiplied by.
const fn coefficients([once, twice]: [f64; 2]) -> [f64; N_PHI_TERMS] {
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

/// Σ c_k a^k from k = 1 on.
fn sum(coefficients: &[f64; N_PHI_TERMS], a: Lanes) -> Lanes {
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
            let error = work - (after - before) - done.lost;
            assert!(
                error.abs() < 1e-13,
                "time {time}: {work}, {done:?}, {error:e}"
            );
            assert!(done.lost > 0.0, "time {time}: {done:?}");
        }
    }
}
