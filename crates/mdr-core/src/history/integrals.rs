//! Integrals over the history of a contact that grows over new elements, branch by branch.
//!
//! ```text
//! ∫ e^(−(t − s)/τ) f(s) ds        f = ḋ, a ḋ, and what the derivatives of the force need
//! ```
//! Over a step the radius a is a polynomial of θ ∈ [0, 1], so that the moments ∫₀¹ e^(−(1 − θ) Δt/τ) θ^j dθ are enough.

use super::radius::{N_COEFFICIENTS, Polynomial};
use crate::branches::{RECIPROCALS, decay_from_mean, moments};

/// A ring of new elements, over which the edge moves in one step; its radius is a polynomial of θ ∈ [0, 1].
#[derive(Debug, Clone, Copy)]
pub(super) struct Ring {
    /// Time at its beginning, \[s].
    pub(super) start_time: f64,
    /// Depth at its beginning, \[m].
    pub(super) start_depth: f64,
    /// Time up to its end, \[s].
    pub(super) duration: f64,
    /// Increase of the depth up to its end, \[m].
    pub(super) rise: f64,
    /// Radius of the edge over θ, \[m].
    pub(super) radius: Polynomial,
}

impl Ring {
    /// The part of the ring that the edge has passed up to θ ∈ [0, 1] of the step.
    pub(super) fn up_to(self, theta: f64) -> Self {
        Self {
            duration: theta * self.duration,
            rise: theta * self.rise,
            radius: self.radius.up_to(theta),
            ..self
        }
    }
}

/// History integrals ∫ e^(−(t − s)/τ) f(s) ds up to now, branch by branch.
#[derive(Debug, Clone, Default)]
pub(super) struct HistoryIntegrals {
    /// Integrals q_k with f = ḋ, \[m].
    pub(super) depth: Vec<f64>,
    /// Integrals P_k with f = a ḋ, \[m²].
    pub(super) load: Vec<f64>,
    /// The integrals for derivatives; empty where none are wanted.
    pub(super) time_weighted: Vec<TimeWeightedIntegrals>,
}

impl HistoryIntegrals {
    /// Copies the values of others with as many branches.
    pub(super) fn copy_from(&mut self, other: &Self) {
        self.depth.copy_from_slice(&other.depth);
        self.load.copy_from_slice(&other.load);
        self.time_weighted.copy_from_slice(&other.time_weighted);
    }
}

/// History integrals ∫ e^(−(t − s)/τ) f(s) ds for the derivatives of the force, of one branch.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct TimeWeightedIntegrals {
    /// Integral with f = (t − s) ḋ, for the derivative by the relaxation time, \[m s].
    pub(super) depth: f64,
    /// Integral with f = (t − s) a ḋ, for the derivative by the relaxation time, \[m² s].
    pub(super) load: f64,
    /// Integral with f = a' ḋ, for the derivative by a shift of all depths, \[m].
    pub(super) edge: f64,
    /// Integral with f = −D a' ḋ, for the derivative by the heights of the body, \[m²].
    pub(super) stretch: f64,
}

/// Moments of the exponentials over a step of one length, branch by branch.
#[derive(Debug, Default)]
pub(super) struct StepIntegrals {
    /// Length Δt of the step, \[s].
    length: f64,
    /// Decay e^(−Δt/τ) of each branch.
    pub(super) decays: Vec<f64>,
    /// Moments ∫₀¹ e^(−(1 − θ) Δt/τ) θ^j dθ, order by order, branch by branch within an order.
    moments: Vec<f64>,
    /// Work space of one number per branch.
    sums: Vec<f64>,
}

/// Orders above the last moment at which the downward recurrence starts from 0. Derived for steps up to τ: the first value left
/// out is at most 1/18, and the recurrence divides its error by each order on the way, for the moment 0 by 17!. This leaves
/// 1.6e-16.
const EXTRA_MOMENT_ORDERS: usize = 16;

impl StepIntegrals {
    /// Computes the moments of the orders below `n_moments` over a step of a length \[s], unless it equals the last length within
    /// `rounding`.
    pub(super) fn set(&mut self, rates: &[f64], length: f64, n_moments: usize, rounding: f64) {
        let n = rates.len();
        if self.moments.len() >= n_moments * n && (length - self.length).abs() <= rounding {
            return;
        }
        self.length = length;
        self.moments.resize(n_moments * n, 0.0);
        self.decays.clear();
        self.decays.extend(rates.iter().map(|rate| rate * length));
        // The downward recurrence M_j = (1 − z M_(j+1))/(j + 1) with z = Δt/τ computes the moments of all branches together. It starts from 0
        // at an order so high that for z ≤ 1 the error of this start is damped to rounding.
        self.sums.clear();
        self.sums.resize(n, 0.0);
        for order in (1..=n_moments + EXTRA_MOMENT_ORDERS).rev() {
            for (moment, z) in self.sums.iter_mut().zip(&self.decays) {
                *moment = (1.0 - z * *moment) * RECIPROCALS[order];
            }
            if order <= n_moments {
                self.moments[(order - 1) * n..order * n].copy_from_slice(&self.sums);
            }
        }
        // For steps longer than τ, z = Δt/τ > 1, the recurrence does not damp the error of its start enough: the moments of these branches are
        // computed one by one.
        for (k, decay) in self.decays.iter_mut().enumerate() {
            if *decay > 1.0 {
                let mut row = [0.0; N_COEFFICIENTS + 1];
                moments(*decay, &mut row[..n_moments]);
                for (moments, moment) in self.moments.chunks_exact_mut(n).zip(row) {
                    moments[k] = moment;
                }
            }
            *decay = decay_from_mean(*decay, self.moments[k]);
        }
    }

    /// Moment ∫₀¹ e^(−(1 − θ) Δt/τ) θ^j dθ of the order j of the branch with this index.
    fn moment(&self, order: usize, branch: usize) -> f64 {
        self.moments[order * self.decays.len() + branch]
    }

    /// Advances the integrals of ḋ over a step in which the contact does not grow and the depth increases by `rise`, \[m].
    pub(super) fn hold(&self, state: &mut HistoryIntegrals, rise: f64) {
        // The weight t − s = (1 − θ) Δt turns the integral over the step into a difference of two moments.
        for (k, time_weighted) in state.time_weighted.iter_mut().enumerate() {
            let gained = rise * self.length * (self.moment(0, k) - self.moment(1, k));
            time_weighted.depth =
                self.decays[k] * (time_weighted.depth + self.length * state.depth[k]) + gained;
        }
        for ((depth, decay), mean) in state.depth.iter_mut().zip(&self.decays).zip(&self.moments) {
            *depth = decay * *depth + rise * mean;
        }
    }

    /// Advances all integrals over a ring of new elements.
    ///
    /// Moments are computed anew unless the duration of the ring equals the last length within `rounding`.
    pub(super) fn grow(
        &mut self,
        rates: &[f64],
        state: &mut HistoryIntegrals,
        ring: &Ring,
        rounding: f64,
    ) {
        // The derivatives need one more moment than the radius has terms.
        let n_moments = ring.radius.terms().len() + usize::from(!state.time_weighted.is_empty());
        self.set(rates, ring.duration, n_moments, rounding);
        // Advance the time-weighted integrals first, which use the others at the start of the step.
        for (k, time_weighted) in state.time_weighted.iter_mut().enumerate() {
            let gained = self.time_weighted(k, ring);
            let (decay, step) = (self.decays[k], self.length);
            time_weighted.depth =
                decay * (time_weighted.depth + step * state.depth[k]) + gained.depth;
            time_weighted.load = decay * (time_weighted.load + step * state.load[k]) + gained.load;
            time_weighted.edge = decay * time_weighted.edge + gained.edge;
            time_weighted.stretch = decay * time_weighted.stretch + gained.stretch;
        }
        // Compute ∫₀¹ e^(−(1 − θ) Δt/τ) a(θ) dθ for each branch, from the coefficients of the radius a and the moments.
        let n = self.decays.len();
        self.sums.clear();
        self.sums.resize(n, 0.0);
        let terms = ring.radius.terms().iter();
        for (term, moments) in terms.zip(self.moments.chunks_exact(n)) {
            for (sum, moment) in self.sums.iter_mut().zip(moments) {
                *sum += term * moment;
            }
        }
        // The integrals P_k of the load and q_k of the depth decay over the step, and gain the contribution of the ring.
        for ((load, decay), sum) in state.load.iter_mut().zip(&self.decays).zip(&self.sums) {
            *load = decay * *load + ring.rise * sum;
        }
        for ((depth, decay), mean) in state.depth.iter_mut().zip(&self.decays).zip(&self.moments) {
            *depth = decay * *depth + ring.rise * mean;
        }
    }

    /// Contribution of a ring to the time-weighted integrals of the branch k.
    fn time_weighted(&self, k: usize, ring: &Ring) -> TimeWeightedIntegrals {
        let [mut load, mut edge, mut stretch] = [0.0; 3];
        let mut previous_moment = 0.0;
        for (j, term) in ring.radius.terms().iter().enumerate() {
            let (moment, slope) = (self.moment(j, k), j as f64 * term);
            load += term * (moment - self.moment(j + 1, k));
            edge += slope * previous_moment;
            stretch += slope * (ring.start_depth * previous_moment + ring.rise * moment);
            previous_moment = moment;
        }
        let scale = ring.rise * self.length;
        TimeWeightedIntegrals {
            depth: scale * (self.moment(0, k) - self.moment(1, k)),
            load: scale * load,
            edge,
            stretch: -stretch,
        }
    }
}
