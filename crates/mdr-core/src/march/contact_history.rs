//! Contacts of the elements in a cycle, and an approximate Newton step to the limit cycle from them.
//!
//! In a limit cycle of period T each mode of an element, of the compliance J and the retardation time λ, ends with the amplitude
//! x with which it began. Its decay and the contribution of the load w balance:
//!
//! ```text
//! F(x) = −J ∫ w e^(−(T − t)/λ) dt / (λ (1 − e^(−T/λ))) − x = 0
//! δ = F − θ J M v,   v = Σ θ δ,   θ = (λ/T)(1 − e^(−T/λ))           the approximate Newton step
//! M v = ⟨k (v − d)⟩ over the cycle in contact,   Σ k (v − d) = 0 under a force,   d = 0 at a depth
//! ```
//! Amplitudes and free displacements are positive upwards, loads downwards. M v is the change of the mean load by the change v of
//! the mean free displacement, and k the mean modulus over the time for which an element is in contact without interruption. M is
//! symmetric and positive semidefinite: an element that has recovered less carries less load.

use numerics::vectors::{add_scaled, dot};

use super::elements::ElementStep;
use crate::branches::{Foundation, Mode};

/// Largest number of iterations of conjugate gradients. Chosen to limit the time: if they do not suffice, the last iterate is
/// used, which only makes the step of the search less accurate.
const MAX_CG_ITERATIONS: usize = 200;

/// Contacts of all elements over a cycle; the default has no elements and records nothing.
#[derive(Debug, Clone, Default)]
pub(super) struct ContactHistory {
    /// Duration of each step, \[s], and the number of runs up to its end.
    steps: Vec<(f64, usize)>,
    /// First loaded element of each run of neighbours, and the one after the last.
    runs: Vec<[usize; 2]>,
    /// Impulse and contacts of each element.
    elements: Vec<Element>,
    /// Duration of all steps, \[s].
    period: f64,
}

/// Contacts of one element over a cycle.
#[derive(Debug, Clone, Copy, Default)]
struct Element {
    /// Number of contacts of the element in the cycle.
    n_contacts: f64,
    /// Impulse ∫ w dt of the load over the cycle.
    impulse: f64,
    /// First moment ∫ w t dt of the load, with the time from the beginning of the cycle.
    moment: f64,
}

impl ContactHistory {
    /// Ratio T/λ below which F is computed from the impulse and the first moment of the load. Derived: the difference of two
    /// states would lose the factor λ/T, four digits or more. What the moments leave out is (T/λ)²/2, or 5e-9, of the impulse.
    pub(super) const MAX_PERIODS_FROM_IMPULSE: f64 = 1e-4;

    /// A record of `n_elements` elements, in which no step is recorded yet.
    pub(super) fn new(n_elements: usize) -> Self {
        Self {
            elements: vec![Element::default(); n_elements],
            ..Self::default()
        }
    }

    /// Records one element in the present step of this `duration` \[s]; the elements of a step come in increasing order.
    pub(super) fn record(&mut self, index: usize, step: &ElementStep, duration: f64) {
        let Some(element) = self.elements.get_mut(index) else {
            return;
        };
        element.impulse += step.work.impulse;
        element.moment += step.work.impulse * (self.period + 0.5 * duration);
        if !step.is_loaded {
            return;
        }
        if !step.was_loaded {
            element.n_contacts += 1.0;
        }
        let first_run = self.steps.last().map_or(0, |(_, end)| *end);
        match self.runs[first_run..].last_mut() {
            Some([_, end]) if *end == index => *end += 1,
            _ => self.runs.push([index, index + 1]),
        }
    }

    /// Ends the present step of this `duration` \[s], after which [`record`](Self::record) refers to the next one.
    pub(super) fn end_step(&mut self, duration: f64) {
        if !self.elements.is_empty() {
            self.steps.push((duration, self.runs.len()));
            self.period += duration;
        }
    }

    /// Residual F \[m] of all modes, element by element, for a cycle from the amplitudes `state` to `end` in the same order.
    pub(super) fn residual(&self, modes: &[Mode], state: &[f64], end: &[f64]) -> Vec<f64> {
        let n_history = state.len() / self.elements.len();
        let mut residual = vec![0.0; state.len()];
        let rows = residual.chunks_mut(n_history).zip(&self.elements);
        let states = state.chunks(n_history).zip(end.chunks(n_history));
        for ((row, element), (state, end)) in rows.zip(states) {
            for (k, mode) in modes.iter().enumerate() {
                let periods = self.period / mode.length;
                let lost = mode.recovered(self.period);
                row[k] = if periods < Self::MAX_PERIODS_FROM_IMPULSE {
                    let until_end = self.period * element.impulse - element.moment;
                    let weighted = element.impulse - until_end / mode.length;
                    // Amplitudes of recovery are positive upwards, loads downwards.
                    -mode.compliance * weighted / mode.length / lost - state[k]
                } else {
                    (end[k] - state[k]) / lost
                };
            }
        }
        residual
    }

    /// Duration of each step, and the runs of elements that are loaded at its end.
    fn steps_with_runs(&self) -> impl Iterator<Item = (f64, &[[usize; 2]])> {
        let starts = std::iter::once(0).chain(self.steps.iter().map(|(_, end)| *end));
        let steps = self.steps.iter().zip(starts);
        steps.map(|((duration, end), start)| (*duration, &self.runs[start..*end]))
    }
}

/// Approximate Jacobian of the residual: the response of the loads to the free displacements.
pub(super) struct CycleJacobian<'a> {
    /// Contacts of all elements in the cycle.
    contact_history: &'a ContactHistory,
    /// True if the force is prescribed, false if the depth.
    is_force: bool,
    /// Mean modulus k of each element; 0 if it is never in contact.
    moduli: Vec<f64>,
    /// Fraction of the cycle for which each element is in contact.
    contact_fractions: Vec<f64>,
}

/// Factors of one mode in a step.
struct ModeFactors {
    /// Factor on F and J, for a step that covers a finite number of cycles.
    step_factor: f64,
    /// Factor θ: mean over a cycle of the displacement per amplitude.
    mean_factor: f64,
    /// Product of θ, J and the factor of the step: amplitude per mean load.
    load_compliance: f64,
}

impl<'a> CycleJacobian<'a> {
    /// The Jacobian at the contacts of a cycle, from the mean modulus and the fraction of the cycle in contact of each element.
    /// `is_force` is true if the force is prescribed.
    pub(super) fn new(
        contact_history: &'a ContactHistory,
        foundation: &Foundation,
        is_force: bool,
    ) -> Self {
        // The durations of the steps in which an element is loaded add up to the time for which it is in contact.
        let mut times = vec![0.0; contact_history.elements.len() + 1];
        for (duration, runs) in contact_history.steps_with_runs() {
            add_to_runs(&mut times, runs, duration);
        }
        accumulate(&mut times);
        let moduli = contact_history
            .elements
            .iter()
            .zip(&times)
            .map(|(element, time)| foundation.mean_modulus(time / element.n_contacts.max(1.0)));
        Self {
            contact_history,
            is_force,
            moduli: moduli.collect(),
            contact_fractions: times
                .iter()
                .map(|time| time / contact_history.period)
                .collect(),
        }
    }

    /// Step δ \[m] of all amplitudes that covers n `cycles` instead of all: with κ = e^(−T/λ), F and J are multiplied by
    /// (1 − κ)/(1 − κ + κ/n).
    pub(super) fn step(&self, modes: &[Mode], cycles: f64, residual: &[f64]) -> Vec<f64> {
        let n_history = residual.len() / self.contact_history.elements.len();
        let factors = modes.iter().map(|mode| {
            let period = self.contact_history.period;
            let lost = mode.recovered(period);
            let step_factor = lost / (lost + (1.0 - lost) / cycles);
            let mean_factor = lost * mode.length / period;
            ModeFactors {
                step_factor,
                mean_factor,
                load_compliance: mean_factor * mode.compliance * step_factor,
            }
        });
        let factors: Vec<ModeFactors> = factors.collect();

        // `step` begins as the step that the amplitudes would take if the loads did not respond. `free` is its mean
        // displacement of each element over a cycle.
        let mut step = residual.to_vec();
        let rows = step.chunks_mut(n_history).map(|row| {
            let history = row.iter_mut().zip(&factors);
            history.fold(0.0, |sum, (amplitude, mode)| {
                *amplitude *= mode.step_factor;
                sum + mode.mean_factor * *amplitude
            })
        });
        let free: Vec<f64> = rows.collect();
        let compliance = factors
            .iter()
            .map(|mode| mode.mean_factor * mode.load_compliance)
            .sum();

        // The loads respond to these displacements and change the amplitudes in turn; that part is subtracted.
        let load_response = self.load_response(&free, compliance);
        for (row, load_response) in step.chunks_mut(n_history).zip(&load_response) {
            for (amplitude, mode) in row.iter_mut().zip(&factors) {
                *amplitude -= mode.load_compliance * load_response;
            }
        }
        step
    }

    /// The product M v: changes of the mean load of each element by changes `v` of its mean free displacement.
    fn multiply(&self, v: &[f64]) -> Vec<f64> {
        let weights = self.moduli.iter().zip(&self.contact_fractions);
        let mut product: Vec<f64> = weights.zip(v).map(|((k, part), v)| k * part * v).collect();
        if !self.is_force {
            return product;
        }
        // From cumulative sums over the elements the sum over a run of loaded ones is a difference of two entries.
        let [mut loads, mut moduli, mut means] = [(); 3].map(|()| vec![0.0; v.len() + 1]);
        for (index, (k, v)) in self.moduli.iter().zip(v).enumerate() {
            loads[index + 1] = k * v;
            moduli[index + 1] = *k;
        }
        accumulate(&mut loads);
        accumulate(&mut moduli);
        // Subtract the depth that keeps the force, averaged over the steps in which an element is loaded.
        for (duration, runs) in self.contact_history.steps_with_runs() {
            let mean = sum_over_runs(&loads, runs) / sum_over_runs(&moduli, runs);
            if mean.is_finite() {
                add_to_runs(
                    &mut means,
                    runs,
                    duration / self.contact_history.period * mean,
                );
            }
        }
        accumulate(&mut means);
        let rows = product.iter_mut().zip(&self.moduli);
        rows.zip(&means)
            .for_each(|((product, k), mean)| *product -= k * mean);
        product
    }

    /// Load response M v for the v that solves v = `free` − `compliance` · M v, by conjugate gradients. The preconditioner uses the M
    /// of a prescribed depth, which is diagonal.
    fn load_response(&self, free: &[f64], compliance: f64) -> Vec<f64> {
        let precondition = |r: &[f64]| -> Vec<f64> {
            let weights = self.moduli.iter().zip(&self.contact_fractions);
            let scaled = r.iter().zip(weights);
            scaled
                .map(|(r, (k, part))| r / (1.0 + compliance * k * part))
                .collect()
        };
        let applied = |v: &[f64]| -> Vec<f64> {
            let product = self.multiply(v);
            v.iter()
                .zip(&product)
                .map(|(v, m)| v + compliance * m)
                .collect()
        };

        // The iteration starts from the solution of the preconditioner, which is exact for a prescribed depth.
        let mut v = precondition(free);
        let mut r: Vec<f64> = free.iter().zip(applied(&v)).map(|(f, a)| f - a).collect();
        let mut z = precondition(&r);
        let mut p = z.clone();
        let mut size = dot(&r, &z);
        // It ends when the squared norm of the residual has fallen by the rounding error.
        let allowed = f64::EPSILON * dot(free, &v);
        for _ in 0..MAX_CG_ITERATIONS {
            if size <= allowed {
                break;
            }
            let a = applied(&p);
            let step = size / dot(&p, &a);
            add_scaled(&mut v, step, &p);
            add_scaled(&mut r, -step, &a);
            z = precondition(&r);
            let before = std::mem::replace(&mut size, dot(&r, &z));
            let ratio = size / before;
            p.iter_mut().zip(&z).for_each(|(p, z)| *p = z + ratio * *p);
        }
        self.multiply(&v)
    }
}

/// Adds a number to all elements in the runs `[start, end)`, in a list of differences from element to element.
fn add_to_runs(differences: &mut [f64], runs: &[[usize; 2]], number: f64) {
    for [start, end] in runs {
        differences[*start] += number;
        differences[*end] -= number;
    }
}

/// Sum over the elements of the runs `[start, end)`, from cumulative sums that begin with 0.
fn sum_over_runs(sums: &[f64], runs: &[[usize; 2]]) -> f64 {
    runs.iter()
        .map(|[start, end]| sums[*end] - sums[*start])
        .sum()
}

/// Replaces values by their cumulative sums, each with its own value.
fn accumulate(values: &mut [f64]) {
    values.iter_mut().fold(0.0, |sum, value| {
        *value += sum;
        *value
    });
}
