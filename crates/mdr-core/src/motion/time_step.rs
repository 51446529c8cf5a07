//! What the Maxwell branches of an element do while it is compressed evenly for a time Δt, exactly.
//!
//! ```text
//! τ de/dt + e = τ G du/dt,   du/dt = Δu/Δt,   a = Δt/τ,   φ(a) = (1 − e^(−a))/a
//! e(Δt) = e₀ e^(−a) + G φ(a) Δu
//! ∫ e dt/Δt = e₀ φ(a) + G Δu (1 − φ(a))/a
//! ∫ e² dt/(G τ) = (a/G) e₀² φ(2a) + 2 e₀ Δu (φ(a) − φ(2a)) + G Δu² (1 − 2 φ(a) + φ(2a))/a
//! ```

use crate::steady::Foundation;

/// Below, differences of φ are summed as series.
const SHORT: f64 = 0.5;
/// Terms of the series that matter there.
const TERMS: i32 = 20;

/// A step of one length over all branches and modes.
#[derive(Debug, Clone, Default)]
pub(super) struct TimeStep {
    pub(super) duration: f64,
    /// What an element carries at the end, per its compression in the step: G_∞ + η₀/Δt + Σ G φ.
    pub(super) stiffness: f64,
    spring: f64,
    /// η₀/Δt.
    dashpot: f64,
    branches: Vec<Branch>,
    /// e^(−Δt/λ) of the modes of recovery.
    pub(super) decays: Vec<f64>,
}

#[derive(Debug, Clone, Copy)]
struct Branch {
    decay: f64,
    gain: f64,
    mean: [f64; 2],
    lost: [f64; 3],
}

/// What an element does in a step, in the units of the foundation.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Driven {
    /// ∫ w dt.
    pub(super) impulse: f64,
    /// Energy that its dashpots take.
    pub(super) lost: f64,
}

impl TimeStep {
    pub(super) fn new(foundation: &Foundation, duration: f64) -> Self {
        let mut stiffness = foundation.spring;
        let mut dashpot = 0.0;
        if foundation.has_dashpot() {
            dashpot = foundation.dashpot / duration;
            stiffness += dashpot;
        }
        let branches: Vec<Branch> = foundation
            .branches
            .iter()
            .map(|branch| Branch::new(branch.modulus, duration / branch.length))
            .collect();
        stiffness += branches.iter().map(|branch| branch.gain).sum::<f64>();
        let modes = foundation.modes.iter();
        Self {
            duration,
            stiffness,
            spring: foundation.spring,
            dashpot,
            branches,
            decays: modes.map(|mode| (-duration / mode.length).exp()).collect(),
        }
    }

    /// What is carried at the end without compression.
    pub(super) fn left(&self, displacement: f64, stresses: &[f64]) -> f64 {
        let branches = self.branches.iter().zip(stresses);
        let left: f64 = branches.map(|(branch, stress)| branch.decay * stress).sum();
        self.spring * displacement + left
    }

    /// Compresses an element by so much during the step.
    pub(super) fn drive(
        &self,
        displacement: f64,
        compression: f64,
        stresses: &mut [f64],
    ) -> Driven {
        let (mut mean, mut lost) = (
            self.spring * (displacement + 0.5 * compression) + self.dashpot * compression,
            self.dashpot * compression * compression,
        );
        for (branch, stress) in self.branches.iter().zip(stresses) {
            let (e, u) = (*stress, compression);
            mean += branch.mean[0] * e + branch.mean[1] * u;
            lost += branch.lost[0] * e * e + (branch.lost[1] * e + branch.lost[2] * u) * u;
            *stress = branch.decay * e + branch.gain * u;
        }
        Driven {
            impulse: mean * self.duration,
            lost,
        }
    }
}

impl Branch {
    fn new(modulus: f64, a: f64) -> Self {
        let mean = phi(a);
        Self {
            decay: (-a).exp(),
            gain: modulus * mean,
            mean: [mean, modulus * lag(a)],
            lost: [
                a * phi(2.0 * a) / modulus,
                2.0 * series(a, |power| 1.0 - power, || mean - phi(2.0 * a)),
                modulus * series(a, |power| power - 2.0, || 1.0 - 2.0 * mean + phi(2.0 * a)) / a,
            ],
        }
    }
}

/// φ(a) = (1 − e^(−a))/a.
fn phi(a: f64) -> f64 {
    -(-a).exp_m1() / a
}

/// (1 − φ(a))/a.
fn lag(a: f64) -> f64 {
    -series(a, |_| 1.0, || phi(a) - 1.0) / a
}

/// Σ c(2^k) (−a)^k/(k + 1)! from k = 1 on, for combinations of φ(a) = Σ (−a)^k/(k + 1)! and φ(2a); in closed form for long
/// steps.
fn series(a: f64, factor: fn(f64) -> f64, long: impl Fn() -> f64) -> f64 {
    if a > SHORT {
        return long();
    }
    let (mut term, mut sum) = (1.0, 0.0);
    for k in 1..=TERMS {
        term *= -a / f64::from(k + 1);
        sum += factor(f64::from(k).exp2()) * term;
    }
    sum
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
            let mut stresses = vec![0.2];
            let before = foundation.stored_energy(displacement, &stresses);
            let driven = step.drive(displacement, compression, &mut stresses);
            let after = foundation.stored_energy(displacement + compression, &stresses);
            let work = driven.impulse * compression;
            let error = work - (after - before) - driven.lost;
            assert!(
                error.abs() < 1e-13,
                "time {time}: {work}, {driven:?}, {error:e}"
            );
            assert!(driven.lost > 0.0, "time {time}: {driven:?}");
        }
    }
}
