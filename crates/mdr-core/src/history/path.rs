//! A piecewise linear path of the depth, and the integrals of the material over it.
//!
//! ```text
//! q_k(t) = ∫ e^(−(t − s)/τ_k) ḋ(s) ds        the equilibrium spring is a branch with 1/τ = 0
//! ```
//! An element that stays in contact from the time s on has the branch load σ_k(t) = G_k q_k(t) + r_k e^(−(t − s)/τ_k) in
//! branch k, with r_k = −G_k q_k(s) if it was never in contact before, and the load w = η₀ ḋ + Σ σ_k. The force per length of the
//! line is 2/(1 − ν) times w, with the Poisson ratio ν.

use std::borrow::Cow;
use std::sync::Arc;

use rheology::Material;

use super::SUM_ROUNDING;
use crate::branches::{decay, decay_and_mean};

/// A time in a segment of the path, `part` ∈ [0, 1] of its duration after its beginning.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct SegmentTime {
    /// Index of the segment.
    pub(super) segment: usize,
    /// Fraction of the duration of the segment that has passed, from 0 to 1.
    pub(super) part: f64,
}

/// A mode in which a free element recovers exponentially; free flow has the rate 0.
#[derive(Debug, Clone, Copy)]
pub(super) struct RecoveryMode {
    /// Rate 1/λ, \[1/s].
    pub(super) rate: f64,
    /// Fluidity J/λ, [1/(Pa s)].
    pub(super) fluidity: f64,
}

/// Depth over time, and the response of one material to it.
#[derive(Debug, Clone)]
pub(super) struct Path {
    /// Moduli G_k of the branches, \[Pa].
    pub(super) moduli: Vec<f64>,
    /// Rates 1/τ_k of the branches, \[1/s].
    pub(super) rates: Vec<f64>,
    /// Viscosity η₀ of the parallel dashpot, \[Pa s].
    pub(super) viscosity: f64,
    /// Modes of recovery.
    modes: Vec<RecoveryMode>,
    /// 1/(1/τ_k − 1/λ_j), mode by mode, \[s]; 0 of the equilibrium spring.
    couplings: Arc<[f64]>,
    /// Points [time \[s], depth \[m]].
    points: Vec<[f64; 2]>,
    /// Integrals q_k at the points, branch by branch within a point, \[m].
    point_integrals: Vec<f64>,
}

impl Path {
    /// A path without points over a foundation of the material.
    pub(super) fn new(material: &dyn Material) -> Self {
        let (relaxation, creep) = (material.relaxation(), material.creep());
        // Each branch has a modulus and a rate; the equilibrium spring is appended as one that does not relax.
        let spring = Some([relaxation.equilibrium_modulus(), 0.0]).filter(|[g, _]| *g > 0.0);
        let branches: Vec<[f64; 2]> = relaxation
            .branches()
            .iter()
            .map(|branch| [branch.modulus, branch.relaxation_time.recip()])
            .chain(spring)
            .collect();
        // Each element of the creep spectrum is a mode of recovery; the free flow of a fluid is appended as one of rate 0.
        let delayed = creep.elements().iter().map(|element| RecoveryMode {
            rate: element.retardation_time.recip(),
            fluidity: element.fluidity(),
        });
        let (rate, fluidity) = (0.0, creep.fluidity());
        let flow = (fluidity > 0.0).then_some(RecoveryMode { rate, fluidity });
        let modes: Vec<RecoveryMode> = delayed.chain(flow).collect();
        let coupling = |mode: &RecoveryMode, rate: f64| match rate {
            0.0 => 0.0,
            rate => (rate - mode.rate).recip(),
        };
        let row = |mode| branches.iter().map(move |[_, rate]| coupling(mode, *rate));
        Self {
            moduli: branches.iter().map(|[modulus, _]| *modulus).collect(),
            rates: branches.iter().map(|[_, rate]| *rate).collect(),
            viscosity: relaxation.viscosity(),
            couplings: modes.iter().flat_map(row).collect(),
            modes,
            points: Vec::new(),
            point_integrals: Vec::new(),
        }
    }

    /// Appends a point of a time \[s] and a depth \[m], at a later time than the last one or, for a jump, at the same.
    pub(super) fn push(&mut self, time: f64, depth: f64) {
        self.points.push([time, depth]);
        let [.., before, _] = self.points[..] else {
            self.point_integrals = vec![0.0; self.n_branches()];
            return;
        };
        // The integrals q_k advance from the point before; between the two points the depth is linear.
        let (step, rise) = (time - before[0], depth - before[1]);
        let start = self.point_integrals.len() - self.n_branches();
        for (k, rate) in self.rates.iter().enumerate() {
            let [decay, mean] = decay_and_mean(rate * step);
            self.point_integrals
                .push(decay * self.point_integrals[start + k] + rise * mean);
        }
    }

    /// Moves the last point to another depth, \[m].
    pub(super) fn set_last_depth(&mut self, depth: f64) {
        self.point_integrals
            .truncate(self.point_integrals.len() - self.n_branches());
        if let Some([time, _]) = self.points.pop() {
            self.push(time, depth);
        }
    }

    /// Time and depth of the last point, \[s], \[m].
    pub(super) fn last(&self) -> [f64; 2] {
        self.points[self.points.len() - 1]
    }

    /// The end of the last segment.
    pub(super) fn end(&self) -> SegmentTime {
        SegmentTime {
            segment: self.points.len() - 2,
            part: 1.0,
        }
    }

    /// Number of branches, the equilibrium spring included.
    pub(super) fn n_branches(&self) -> usize {
        self.moduli.len()
    }

    /// The modes, each with 1/(1/τ_k − 1/λ) \[s] of all branches, 0 of the equilibrium spring.
    pub(super) fn modes(&self) -> impl Iterator<Item = (&RecoveryMode, &[f64])> {
        let n = self.n_branches();
        let row = move |j: usize| &self.couplings[j * n..(j + 1) * n];
        self.modes
            .iter()
            .enumerate()
            .map(move |(j, mode)| (mode, row(j)))
    }

    /// Instantaneous modulus Σ G_k, \[Pa].
    pub(super) fn instantaneous_modulus(&self) -> f64 {
        self.moduli.iter().sum()
    }

    /// Duration of a segment, \[s].
    pub(super) fn step(&self, segment: usize) -> f64 {
        self.points[segment + 1][0] - self.points[segment][0]
    }

    /// Increase of the depth in a segment, \[m].
    pub(super) fn rise(&self, segment: usize) -> f64 {
        self.points[segment + 1][1] - self.points[segment][1]
    }

    /// Speed ḋ in a segment, \[m/s]; for a jump its height \[m], which has the same sign.
    pub(super) fn speed(&self, segment: usize) -> f64 {
        match self.step(segment) {
            0.0 => self.rise(segment),
            step => self.rise(segment) / step,
        }
    }

    /// Largest difference of the speeds in a segment and in the one before that may be rounding, \[m/s].
    fn speed_rounding(&self, segment: usize) -> f64 {
        let [time, depth] = self.points[segment + 1];
        speed_rounding(self.speed(segment), self.step(segment), time, depth)
    }

    /// Time of a point of the path, \[s].
    pub(super) fn time(&self, at: SegmentTime) -> f64 {
        self.points[at.segment][0] + at.part * self.step(at.segment)
    }

    /// Indentation depth at a time, \[m].
    pub(super) fn depth(&self, at: SegmentTime) -> f64 {
        self.points[at.segment][1] + at.part * self.rise(at.segment)
    }

    /// The time in a segment at which the body has a depth \[m]; the beginning or end of the segment if it does not.
    pub(super) fn time_of_depth(&self, segment: usize, depth: f64) -> SegmentTime {
        let part = (depth - self.points[segment][1]) / self.rise(segment);
        SegmentTime {
            segment,
            part: part.clamp(0.0, 1.0),
        }
    }

    /// Strain integrals q_k of all branches at a time, \[m].
    pub(super) fn strain_integrals(&self, at: SegmentTime) -> Cow<'_, [f64]> {
        let n = self.n_branches();
        let from_start = &self.point_integrals[at.segment * n..];
        if at.part == 0.0 {
            return Cow::Borrowed(&from_start[..n]);
        }
        // The end of a segment has its own values, without rounding of the interpolation.
        if at.part >= 1.0 {
            return Cow::Borrowed(&from_start[n..2 * n]);
        }
        let step = at.part * self.step(at.segment);
        let rise = at.part * self.rise(at.segment);
        let later = self.rates.iter().zip(from_start).map(|(rate, before)| {
            let [decay, mean] = decay_and_mean(rate * step);
            decay * before + rise * mean
        });
        Cow::Owned(later.collect())
    }

    /// Decay of the branches from one time to another, and the branch loads gained in between.
    pub(super) fn decayed_history(&self, since: SegmentTime, at: SegmentTime) -> DecayedHistory {
        let time = self.time(at) - self.time(since);
        let decays: Vec<f64> = self.rates.iter().map(|rate| decay(rate * time)).collect();
        let (then, now) = (self.strain_integrals(since), self.strain_integrals(at));
        let gained =
            (0..self.n_branches()).map(|k| self.moduli[k] * (now[k] - decays[k] * then[k]));
        DecayedHistory {
            gained_loads: gained.collect(),
            decays,
        }
    }

    /// Relaxation modulus G(t − s) over the time t − s of `past`, \[Pa]; without the parallel dashpot.
    pub(super) fn modulus(&self, past: &DecayedHistory) -> f64 {
        let branches = self.moduli.iter().zip(&past.decays);
        branches.map(|(modulus, decay)| modulus * decay).sum()
    }

    /// Size of the terms that cancel in the load of an element, \[N/m].
    pub(super) fn scale(&self, at: SegmentTime) -> f64 {
        let strain_integrals = self.strain_integrals(at);
        let branches = self.moduli.iter().zip(strain_integrals.iter());
        let branch_loads = branches.map(|(modulus, strain)| modulus * strain.abs());
        self.viscosity * self.speed(at.segment).abs() + branch_loads.sum::<f64>()
    }

    /// Load w of an element with the branch loads σ_k, \[N/m].
    pub(super) fn load(&self, branch_loads: &[f64], at: SegmentTime) -> f64 {
        self.viscosity * self.speed(at.segment) + branch_loads.iter().sum::<f64>()
    }

    /// Load w at the time `at` of an element in contact that has the branch `loads` at the time `from`, in one segment, \[N/m].
    pub(super) fn load_later(&self, loads: &[f64], from: SegmentTime, at: SegmentTime) -> f64 {
        let step = self.time(at) - self.time(from);
        let rise = self.depth(at) - self.depth(from);
        let branches = self.rates.iter().zip(&self.moduli).zip(loads);
        let later = branches.map(|((rate, modulus), load)| {
            let [decay, mean] = decay_and_mean(rate * step);
            decay * load + modulus * rise * mean
        });
        self.viscosity * self.speed(at.segment) + later.sum::<f64>()
    }

    /// Direction of the edge, given the branch loads of its element: positive outwards, negative inwards.
    ///
    /// The sign is that of the depth where it jumps, of the load at this speed with a parallel dashpot, and of the rate of the load
    /// otherwise; 0 if it is rounding.
    pub(super) fn edge_direction(&self, branch_loads: &[f64], at: SegmentTime) -> f64 {
        let speed = self.speed(at.segment);
        if self.step(at.segment) == 0.0 {
            return speed;
        }
        // `rate` is the rate of the load per length at the edge, and `rate_scale` the size of the terms that cancel in it.
        let (mut rate, mut rate_scale) = (self.instantaneous_modulus() * speed, 0.0);
        let strain_integrals = self.strain_integrals(at);
        for (k, branch_load) in branch_loads.iter().enumerate() {
            rate -= self.rates[k] * branch_load;
            rate_scale += self.rates[k] * self.moduli[k] * strain_integrals[k].abs();
        }
        // With a dashpot the load itself counts; otherwise its rate. Neither counts within rounding.
        let load = self.load(branch_loads, at);
        let load_rounding =
            SUM_ROUNDING * self.scale(at) + self.viscosity * self.speed_rounding(at.segment);
        if self.viscosity > 0.0 && load.abs() > load_rounding {
            load
        } else if rate.abs() > SUM_ROUNDING * rate_scale {
            rate
        } else {
            0.0
        }
    }
}

/// Relative change of a radius or a depth up to which it counts as rounding, and not as a move of the edge. Chosen as a thousand
/// times the rounding 1e-13 of depths and radii that are roots of an equation. A move that is really so short is left out.
pub(super) const EXTENT_ROUNDING: f64 = 1e-10;

/// Decay of the branches between two times s and t, and the branch loads gained in between.
pub(super) struct DecayedHistory {
    /// Decay e^(−(t − s)/τ_k) of each branch.
    pub(super) decays: Vec<f64>,
    /// Branch loads G_k ∫ e^(−(t − s')/τ_k) ḋ ds' from the displacement between both times, \[N/m]: those of an element that came into
    /// contact for the first time at s.
    pub(super) gained_loads: Vec<f64>,
}

/// Largest difference of two speeds that may be rounding, \[m/s], for steps of one length up to a time \[s] and depth \[m].
///
/// Each of the times and depths is rounded by half a unit in the last place, their differences by one, and two speeds are
/// compared: 2 ε (d + v t)/Δt.
pub(super) fn speed_rounding(speed: f64, step: f64, time: f64, depth: f64) -> f64 {
    2.0 * f64::EPSILON * (depth.abs() + (speed * time).abs()) / step
}

/// Change of the radius by a load at the edge as large as the terms that cancel in it, \[m]; 0 if all branches have relaxed since
/// contact. `slope` is da/dD, `modulus` the relaxation modulus of the element, and `scale` the size of the terms.
pub(super) fn change_of_edge(slope: f64, modulus: f64, scale: f64) -> f64 {
    if modulus > f64::MIN_POSITIVE {
        slope.abs() / modulus * scale
    } else {
        0.0
    }
}
