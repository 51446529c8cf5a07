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
/// Branches that are followed at once; a slot without a branch holds 0.
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
    branches: Vec<Branches>,
    /// Of all branches the parts of mean and loss that have no stress in them.
    mean: f64,
    lost: f64,
    /// e^(−Δt/λ) of the modes of recovery.
    decays: Vec<Lanes>,
}

/// What [`LANES`] branches make of their stresses e and the compression u: a e + b u, and of the energy that they lose e (c e + d u).
#[derive(Debug, Clone, Copy, Default)]
struct Branches {
    decay: Lanes,
    gain: Lanes,
    mean: Lanes,
    lost: [Lanes; 2],
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
        let decays: Vec<f64> = modes.map(|mode| (-duration / mode.length).exp()).collect();
        Self {
            duration,
            stiffness,
            spring: foundation.spring,
            dashpot,
            mean: branches.iter().map(|branch| branch.mean[1]).sum(),
            lost: branches.iter().map(|branch| branch.lost[2]).sum(),
            branches: branches.chunks(LANES).map(Branches::of).collect(),
            decays: decays
                .chunks(LANES)
                .map(|decays| lanes(decays, |decay| *decay))
                .collect(),
        }
    }

    /// The sum of what recovers, at the end.
    pub(super) fn recovering(&self, slots: &[f64]) -> f64 {
        let decays = self.decays.iter().zip(slots.as_chunks().0);
        total(decays.fold([0.0; LANES], |sum, (decays, slots)| {
            add(sum, *decays, *slots)
        }))
    }

    /// What recovers does so for the step.
    pub(super) fn recover(&self, slots: &mut [f64]) {
        for (decays, slots) in self.decays.iter().zip(slots.as_chunks_mut().0) {
            *slots = product(*decays, *slots);
        }
    }

    /// What is carried at the end without compression.
    pub(super) fn left(&self, displacement: f64, stresses: &[f64]) -> f64 {
        let branches = self.branches.iter().zip(stresses.as_chunks().0);
        let left = branches.fold([0.0; LANES], |sum, (branches, stresses)| {
            add(sum, branches.decay, *stresses)
        });
        self.spring * displacement + total(left)
    }

    /// Compresses an element by so much during the step; there are whole [`LANES`] of stresses.
    pub(super) fn drive(
        &self,
        displacement: f64,
        compression: f64,
        stresses: &mut [f64],
    ) -> Driven {
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
        Driven {
            impulse: mean * self.duration,
            lost: total(lost) + (self.dashpot + self.lost) * compression * compression,
        }
    }
}

impl Branches {
    fn of(branches: &[Branch]) -> Self {
        Self {
            decay: lanes(branches, |branch| branch.decay),
            gain: lanes(branches, |branch| branch.gain),
            mean: lanes(branches, |branch| branch.mean[0]),
            lost: [0, 1].map(|part| lanes(branches, |branch| branch.lost[part])),
        }
    }
}

fn lanes<T>(of: &[T], number: impl Fn(&T) -> f64) -> Lanes {
    std::array::from_fn(|lane| of.get(lane).map_or(0.0, &number))
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
    let (mut term, mut power, mut sum) = (1.0, 1.0, 0.0);
    for k in 1..=TERMS {
        term *= -a / f64::from(k + 1);
        power *= 2.0;
        sum += factor(power) * term;
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
            let mut stresses = vec![0.2, 0.0, 0.0, 0.0];
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
