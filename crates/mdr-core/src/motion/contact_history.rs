//! Which elements were in contact in a cycle, and with it what elements remember when a cycle comes back, about.
//!
//! An element x of the retardation time λ ends a cycle of the time T with the part that it keeps and what the load adds:
//!
//! ```text
//! F(x) = β ∫ w e^(−(T − t)/λ) dt / (λ (1 − e^(−T/λ))) − x = 0      where a cycle comes back
//! δ = F − θ β M v,   v = Σ θ δ,   θ = (λ/T)(1 − e^(−T/λ))           the step of Newton's method, about
//! M v = ⟨k (v − d)⟩ over the cycle in contact,   Σ k (v − d) = 0 under a force,   d = 0 at a depth
//! ```
//! k is the modulus in the mean over the time for which an element is touched without a break. M is symmetric and not negative: where
//! more is remembered, less is carried.

use crate::steady::{Foundation, Mode};

/// Norm of the residual with which conjugate gradients end, relative to that of the right-hand side, both in the
/// preconditioned norm.
const CG_TOLERANCE: f64 = 1e-8;
/// Iterations of conjugate gradients at most.
const MAX_CG_ITERATIONS: usize = 200;

/// What happened to the elements of a chain; by default it has no elements, and notes nothing.
#[derive(Debug, Clone, Default)]
pub(super) struct ContactHistory {
    /// Duration of each step, \[s], and the number of runs up to its end.
    steps: Vec<(f64, usize)>,
    /// First loaded element, and the one after the last.
    runs: Vec<[usize; 2]>,
    elements: Vec<Element>,
    /// Of all steps, \[s].
    period: f64,
}

#[derive(Debug, Clone, Copy, Default)]
struct Element {
    /// How many times it was touched.
    n_touches: f64,
    /// ∫ w dt and ∫ w t dt.
    impulse: f64,
    moment: f64,
}

impl ContactHistory {
    /// Ratio T/λ below which F is computed from the impulse of the load: the difference of two states would lose its
    /// digits.
    pub(super) const MAX_PERIODS_FROM_IMPULSE: f64 = 1e-4;

    /// To be noted for so many elements.
    pub(super) fn of(n_elements: usize) -> Self {
        Self {
            elements: vec![Element::default(); n_elements],
            ..Self::default()
        }
    }

    /// An element gets an impulse in a step of this duration; it was loaded, and is so at the end. In the order of elements.
    pub(super) fn note(
        &mut self,
        index: usize,
        (impulse, duration): (f64, f64),
        [was, is]: [bool; 2],
    ) {
        let Some(element) = self.elements.get_mut(index) else {
            return;
        };
        element.impulse += impulse;
        element.moment += impulse * (self.period + 0.5 * duration);
        if !is {
            return;
        }
        if !was {
            element.n_touches += 1.0;
        }
        let before = self.steps.last().map_or(0, |(_, end)| *end);
        match self.runs[before..].last_mut() {
            Some([_, end]) if *end == index => *end += 1,
            _ => self.runs.push([index, index + 1]),
        }
    }

    pub(super) fn end_step(&mut self, duration: f64) {
        if !self.elements.is_empty() {
            self.steps.push((duration, self.runs.len()));
            self.period += duration;
        }
    }

    /// F of all elements, of a cycle from a state to an end.
    pub(super) fn residual(&self, modes: &[Mode], state: &[f64], end: &[f64]) -> Vec<f64> {
        let n_history_variables = state.len() / self.elements.len();
        let mut residual = vec![0.0; state.len()];
        let rows = residual.chunks_mut(n_history_variables).zip(&self.elements);
        let states = state
            .chunks(n_history_variables)
            .zip(end.chunks(n_history_variables));
        for ((row, element), (state, end)) in rows.zip(states) {
            for (k, mode) in modes.iter().enumerate() {
                let periods = self.period / mode.length;
                let lost = mode.recovered(self.period);
                row[k] = if periods < Self::MAX_PERIODS_FROM_IMPULSE {
                    let since = self.period * element.impulse - element.moment;
                    let prescribed = element.impulse - since / mode.length;
                    // What recovers is counted upwards.
                    -mode.compliance * prescribed / mode.length / lost - state[k]
                } else {
                    (end[k] - state[k]) / lost
                };
            }
        }
        residual
    }

    /// Durations of the steps, and the runs of elements that were loaded at their ends.
    fn steps_with_runs(&self) -> impl Iterator<Item = (f64, &[[usize; 2]])> {
        let starts = std::iter::once(0).chain(self.steps.iter().map(|(_, end)| *end));
        let steps = self.steps.iter().zip(starts);
        steps.map(|((duration, end), start)| (*duration, &self.runs[start..*end]))
    }
}

/// How the elements answer to what they remember.
pub(super) struct CycleJacobian<'a> {
    contact_history: &'a ContactHistory,
    is_force: bool,
    /// k of each element; 0 if it is never touched.
    moduli: Vec<f64>,
    /// Part of the cycle for which it is touched.
    contact_fractions: Vec<f64>,
}

impl<'a> CycleJacobian<'a> {
    pub(super) fn new(
        contact_history: &'a ContactHistory,
        foundation: &Foundation,
        is_force: bool,
    ) -> Self {
        let mut times = vec![0.0; contact_history.elements.len() + 1];
        for (duration, runs) in contact_history.steps_with_runs() {
            add_to_runs(&mut times, runs, duration);
        }
        accumulate(&mut times);
        let moduli = contact_history
            .elements
            .iter()
            .zip(&times)
            .map(|(element, time)| {
                let time = time / element.n_touches.max(1.0);
                foundation.mean_modulus(time)
            });
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

    /// δ over n cycles at once instead of all: with κ = e^(−T/λ), F and β count for (1 − κ)/(1 − κ + κ/n).
    pub(super) fn step(&self, modes: &[Mode], cycles: f64, residual: &[f64]) -> Vec<f64> {
        let n_history_variables = residual.len() / self.contact_history.elements.len();
        let weights = modes.iter().map(|mode| {
            let period = self.contact_history.period;
            let lost = mode.recovered(period);
            let now = lost / (lost + (1.0 - lost) / cycles);
            let part = lost * mode.length / period;
            [now, part, part * mode.compliance * now]
        });
        let weights: Vec<[f64; 3]> = weights.collect();
        let mut step = residual.to_vec();
        let rows = step.chunks_mut(n_history_variables).map(|row| {
            let history = row.iter_mut().zip(&weights);
            history.fold(0.0, |sum, (slot, [now, part, _])| {
                *slot *= now;
                sum + part * *slot
            })
        });
        let free: Vec<f64> = rows.collect();
        let compliance = weights
            .iter()
            .map(|[_, part, prescribed]| part * prescribed)
            .sum();
        let load_response = self.load_response(&free, compliance);
        for (row, load_response) in step.chunks_mut(n_history_variables).zip(&load_response) {
            for (slot, [_, _, prescribed]) in row.iter_mut().zip(&weights) {
                *slot -= prescribed * load_response;
            }
        }
        step
    }

    /// M v.
    fn multiply(&self, v: &[f64]) -> Vec<f64> {
        let weights = self.moduli.iter().zip(&self.contact_fractions);
        let mut product: Vec<f64> = weights.zip(v).map(|((k, part), v)| k * part * v).collect();
        if !self.is_force {
            return product;
        }
        let [mut loads, mut moduli, mut means] = [(); 3].map(|()| vec![0.0; v.len() + 1]);
        for (index, (k, v)) in self.moduli.iter().zip(v).enumerate() {
            loads[index + 1] = k * v;
            moduli[index + 1] = *k;
        }
        accumulate(&mut loads);
        accumulate(&mut moduli);
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

    /// M v of the v = free − compliance · M v, by conjugate gradients, which take the M of a depth first.
    fn load_response(&self, free: &[f64], compliance: f64) -> Vec<f64> {
        let over = |r: &[f64]| -> Vec<f64> {
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
        let mut v = over(free);
        let mut r: Vec<f64> = free.iter().zip(applied(&v)).map(|(f, a)| f - a).collect();
        let mut z = over(&r);
        let mut p = z.clone();
        let mut size = dot(&r, &z);
        let enough = CG_TOLERANCE * CG_TOLERANCE * dot(free, &v);
        for _ in 0..MAX_CG_ITERATIONS {
            if size <= enough {
                break;
            }
            let a = applied(&p);
            let step = size / dot(&p, &a);
            add_scaled(&mut v, step, &p);
            add_scaled(&mut r, -step, &a);
            z = over(&r);
            let before = std::mem::replace(&mut size, dot(&r, &z));
            let ratio = size / before;
            p.iter_mut().zip(&z).for_each(|(p, z)| *p = z + ratio * *p);
        }
        self.multiply(&v)
    }
}

/// Adds a number to the differences of a list whose elements in the runs become that much larger.
fn add_to_runs(differences: &mut [f64], runs: &[[usize; 2]], number: f64) {
    for [start, end] in runs {
        differences[*start] += number;
        differences[*end] -= number;
    }
}

/// Over the elements of the runs, from the sums of all up to each.
fn sum_over_runs(sums: &[f64], runs: &[[usize; 2]]) -> f64 {
    runs.iter()
        .map(|[start, end]| sums[*end] - sums[*start])
        .sum()
}

fn accumulate(values: &mut [f64]) {
    values.iter_mut().fold(0.0, |sum, value| {
        *value += sum;
        *value
    });
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn add_scaled(a: &mut [f64], factor: f64, b: &[f64]) {
    a.iter_mut().zip(b).for_each(|(a, b)| *a += factor * b);
}
