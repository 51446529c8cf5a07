//! A contact that grows over new elements and then shrinks, in closed form.
//!
//! ```text
//! F = 8/(2 (1 − ν)) [a w + Σ G_k e^(−(t − t₁)/τ_k) P_k(t₁)]        w = η₀ ḋ + Σ G_k [q_k(t) − e^(−(t − t₁)/τ_k) q_k(t₁)]
//! q_k(t) = ∫ e^(−(t − s)/τ_k) ḋ ds        P_k(t) = ∫ e^(−(t − s)/τ_k) a(D) ḋ ds        D(s) = max d(s') up to s
//! ```
//! The element at the edge was touched at t₁ and carries w: nothing where the contact shrinks, so that ∂F/∂t₁ ∝ w = 0 there
//! (Ting 1966, J. Appl. Mech. 33, 845).

use rheology::RelaxationSpectrum;

use super::ContactSums;
use super::integrals::{HistoryIntegrals, Ring, StepIntegrals, TimeWeightedIntegrals};
use super::path::{EXTENT_ROUNDING, LOAD_ROUNDING, change_of_edge, decay_and_mean};
use super::radius::{N_COEFFICIENTS, Radii};

/// The element at the edge, and what became of the branches since it was touched.
#[derive(Debug, Clone, Default)]
pub(super) struct Edge {
    ring: usize,
    theta: f64,
    /// a, a' and D there; none without contact.
    pub(super) place: Option<[f64; 3]>,
    /// By how much deeper it lies than where all this is computed, what that adds to the sum of the loads, and the radius
    /// there.
    shift: f64,
    correction: f64,
    radius: f64,
    /// t − t₁.
    pub(super) lag: f64,
    /// w, and G(t − t₁).
    pub(super) load: f64,
    pub(super) modulus: f64,
    /// e^(−(t − t₁)/τ_k).
    pub(super) decays: Vec<f64>,
    /// q_k(t) − e^(−(t − t₁)/τ_k) q_k(t₁).
    pub(super) strains: Vec<f64>,
    /// ∫ of the same over the contact, without G_k, [m²].
    pub(super) sums: Vec<f64>,
}

/// The body on its way.
pub(super) struct Approach {
    radii: Radii,
    /// Error of the sum of the loads that the polynomials of the radii make, [Pa m²].
    load_error: f64,
    /// Of the branches, the lone spring last.
    pub(super) moduli: Vec<f64>,
    pub(super) rates: Vec<f64>,
    pub(super) viscosity: f64,
    pub(super) now: HistoryIntegrals,
    /// Time and depth, and the speed up to there.
    pub(super) point: [f64; 2],
    pub(super) speed: f64,
    rings: Vec<Ring>,
    coefficients: Vec<f64>,
    /// At the beginning of every ring, q of all branches, then P.
    integrals_at_rings: Vec<f64>,
    time_weighted_at_rings: Vec<TimeWeightedIntegrals>,
    /// At the end of the last one, and when the element at the edge was touched.
    at_front: HistoryIntegrals,
    pub(super) at_contact: HistoryIntegrals,
    pub(super) edge: Edge,
    /// Whether the depth has been less than it was.
    front_is_behind: bool,
    /// Whether elements were left, and touched again.
    has_receded: bool,
    pub(super) has_recontact: bool,
    /// Change of the depth of the edge in the last step.
    last_edge_shift: f64,
    step: StepIntegrals,
    partial: StepIntegrals,
}

/// Steps of the search for the edge that are not guarded by bisection; afterwards every other step halves the
/// bracket.
const UNGUARDED_EDGE_STEPS: usize = 16;
/// Steps after which the search for the edge ends: the bracket is then as narrow as rounding.
const MAX_EDGE_STEPS: usize = 200;
/// Relative change of the depth of the edge at which its search ends. Derivatives are known to that, the force to its
/// square and better.
const EDGE_TOLERANCE: f64 = 1e-8;

impl Approach {
    pub(super) fn new(
        radii: Radii,
        spectrum: &RelaxationSpectrum,
        n_points: usize,
        differentiates: bool,
    ) -> Self {
        let branches = spectrum.branches().iter();
        let moduli = branches.clone().map(|branch| branch.modulus);
        let rates = branches.map(|branch| branch.relaxation_time.recip());
        let rates: Vec<f64> = rates.chain([0.0]).collect();
        let n = rates.len();
        let now = HistoryIntegrals {
            depth: vec![0.0; n],
            load: vec![0.0; n],
            time_weighted: vec![
                TimeWeightedIntegrals::default();
                if differentiates { n } else { 0 }
            ],
        };
        let moduli: Vec<f64> = moduli.chain([spectrum.equilibrium_modulus()]).collect();
        Self {
            load_error: moduli.iter().sum::<f64>() * radii.area_error,
            radii,
            moduli,
            viscosity: spectrum.viscosity(),
            at_front: now.clone(),
            at_contact: now.clone(),
            now,
            point: [0.0; 2],
            speed: 0.0,
            rings: Vec::with_capacity(n_points),
            coefficients: Vec::with_capacity(8 * n_points),
            integrals_at_rings: Vec::with_capacity(2 * n * n_points),
            time_weighted_at_rings: Vec::new(),
            edge: Edge {
                decays: vec![1.0; n],
                strains: vec![0.0; n],
                sums: vec![0.0; n],
                ..Edge::default()
            },
            front_is_behind: false,
            has_receded: false,
            has_recontact: false,
            last_edge_shift: 0.0,
            step: StepIntegrals::default(),
            partial: StepIntegrals::default(),
            rates,
        }
    }

    /// Begins at a point, or above it at the undeformed surface.
    pub(super) fn start(&mut self, [time, depth]: [f64; 2]) {
        self.point = [time, depth.min(0.0)];
    }

    pub(super) fn measured(&self) -> ContactSums {
        let Some([radius, slope, _]) = self.edge.place else {
            return ContactSums {
                point: self.point,
                ..ContactSums::default()
            };
        };
        let viscous = self.viscosity * self.speed * radius;
        let [mut load, mut terms] = [viscous + self.edge.correction, viscous.abs()];
        for (modulus, sum) in self.moduli.iter().zip(&self.edge.sums) {
            load += modulus * sum;
            terms += modulus * sum.abs();
        }
        let [scale, _] = self.scales();
        ContactSums {
            point: self.point,
            load,
            terms: terms + radius * scale,
            load_error: self.load_error,
            radius: self.radius(),
            edge_change: change_of_edge(slope, self.edge.modulus, scale),
        }
    }

    /// Contact radius, \[m].
    pub(super) fn radius(&self) -> f64 {
        self.edge.place.map_or(0.0, |_| self.edge.radius)
    }

    /// D.
    fn deepest(&self) -> f64 {
        let last = self.rings.last();
        last.map_or(0.0, |ring| ring.start[1] + ring.rise)
    }

    /// Σ G_k q_k and so on: sizes of the terms that cancel in w, and in its rate.
    pub(super) fn scales(&self) -> [f64; 2] {
        let mut scales = [self.viscosity * self.speed.abs(), 0.0];
        for (k, depth) in self.now.depth.iter().enumerate() {
            let stress = self.moduli[k] * depth.abs();
            scales[0] += stress;
            scales[1] += self.rates[k] * stress;
        }
        scales
    }

    /// Goes on to the next point; a surface counts as recovered once the body is above its undeformed position.
    pub(super) fn follow(&mut self, [end, next]: [f64; 2]) {
        let [start, depth] = self.point;
        self.point = [end, next];
        self.speed = match end - start {
            0.0 => 0.0,
            step => (next - depth) / step,
        };
        if next <= 0.0 {
            self.recover();
            return;
        }
        let at = |there: f64| {
            let part = (there - depth) / (next - depth);
            [start + part * (end - start), there]
        };
        let mut here = if depth < 0.0 { at(0.0) } else { [start, depth] };
        self.has_recontact |= end > start && self.reverses();
        let deepest = self.deepest();
        if next <= deepest {
            self.hold(here, [end, next]);
            let before = self.radius();
            self.find_edge();
            let wider = self.has_receded && self.radius() > before * (1.0 + EXTENT_ROUNDING);
            self.has_recontact |= wider || (end > start && self.reverses());
            let edge = self.edge.place.map(|[.., depth]| depth);
            self.has_receded |= edge.is_none_or(|depth| depth < (1.0 - EXTENT_ROUNDING) * deepest);
            return;
        }
        self.has_recontact |= self.has_receded;
        self.has_receded = false;
        if here[1] < deepest {
            let there = at(deepest);
            self.hold(here, there);
            here = there;
        }
        if self.front_is_behind {
            self.catch_up_from_front(here[0]);
        }
        while self.deepest() < next {
            let limit = self.radii.end_of_piece(self.deepest()).min(next);
            let there = if limit < next { at(limit) } else { [end, next] };
            self.grow(here, there);
            here = there;
        }
        self.put_edge_at_front();
    }

    /// The body is above the surface, which is taken as undeformed.
    fn recover(&mut self) {
        self.has_receded |= !self.rings.is_empty();
        self.rings.clear();
        self.coefficients.clear();
        self.integrals_at_rings.clear();
        self.time_weighted_at_rings.clear();
        self.now.depth.fill(0.0);
        self.now.load.fill(0.0);
        self.now
            .time_weighted
            .fill(TimeWeightedIntegrals::default());
        self.edge.place = None;
    }

    /// Whether an edge that has moved inwards turns, at the speed of now.
    fn reverses(&self) -> bool {
        self.has_receded && self.edge.place.is_some() && self.edge_direction() > 0.0
    }

    /// Whether the element at the edge is pressed on (> 0) or left (< 0), were it to stay in contact.
    fn edge_direction(&self) -> f64 {
        let [mut load, mut rate] = [self.viscosity * self.speed, 0.0];
        for (k, strain) in self.edge.strains.iter().enumerate() {
            load += self.moduli[k] * strain;
            rate += self.moduli[k] * (self.speed - self.rates[k] * strain);
        }
        let scales = self.scales();
        // Of a dashpot the speed counts at once.
        if self.viscosity > 0.0 && load.abs() > EXTENT_ROUNDING * scales[0] {
            return load;
        }
        let has_rate = rate.abs() > LOAD_ROUNDING * scales[1];
        if has_rate { rate } else { 0.0 }
    }

    /// Over elements that were touched before: only q goes on, the rest follows from the front.
    fn hold(&mut self, from: [f64; 2], to: [f64; 2]) {
        if self.rings.is_empty() {
            return;
        }
        self.front_is_behind = true;
        let step = to[0] - from[0];
        self.step.set(&self.rates, step, 2, rounding(to[0], step));
        self.step.hold(&mut self.now, to[1] - from[1]);
    }

    /// What is remembered at the front, later.
    fn catch_up_from_front(&mut self, time: f64) {
        self.front_is_behind = false;
        let Some(ring) = self.rings.last().copied() else {
            return;
        };
        let lag = time - (ring.start[0] + ring.step);
        let [radius, slope, depth] = self.place(self.rings.len() - 1, 1.0);
        for (k, rate) in self.rates.iter().enumerate() {
            let decay = (-rate * lag).exp();
            let [at_contact, load] = [self.at_front.depth[k], self.at_front.load[k]];
            let strain = self.now.depth[k] - decay * at_contact;
            self.now.load[k] = radius * strain + decay * load;
            if let Some(time_weighted) = self.now.time_weighted.get_mut(k) {
                let before = self.at_front.time_weighted[k];
                time_weighted.load = radius
                    * (time_weighted.depth - decay * (before.depth + lag * at_contact))
                    + decay * (before.load + lag * load);
                time_weighted.edge = decay * before.edge + slope * strain;
                time_weighted.stretch = decay * before.stretch - depth * slope * strain;
            }
        }
    }

    /// Over new elements, within a piece of the radii.
    fn grow(&mut self, from: [f64; 2], to: [f64; 2]) {
        let deepest = self.deepest();
        let radius = self.radii.along([deepest, to[1]]);
        let terms = radius.terms();
        let ring = Ring {
            start: [from[0], deepest],
            step: to[0] - from[0],
            rise: to[1] - deepest,
            first: self.coefficients.len(),
            n_terms: terms.len(),
        };
        self.coefficients.extend_from_slice(terms);
        if self.rings.is_empty() {
            // A flat end is touched at once.
            for time_weighted in &mut self.now.time_weighted {
                time_weighted.edge = terms[0];
            }
        }
        self.rings.push(ring);
        self.integrals_at_rings.extend_from_slice(&self.now.depth);
        self.integrals_at_rings.extend_from_slice(&self.now.load);
        self.time_weighted_at_rings
            .extend_from_slice(&self.now.time_weighted);
        let n_moments = terms.len() + usize::from(!self.now.time_weighted.is_empty());
        let rounding = rounding(to[0], ring.step);
        self.step.set(&self.rates, ring.step, n_moments, rounding);
        self.step.grow(&mut self.now, &ring, terms);
        self.at_front.copy_from(&self.now);
    }

    /// a, a' and D at θ of a ring.
    fn place(&self, ring: usize, theta: f64) -> [f64; 3] {
        let ring = &self.rings[ring];
        let terms = &self.coefficients[ring.first..ring.first + ring.n_terms];
        let [radius, slope] = terms.iter().rev().fold([0.0; 2], |[value, slope], term| {
            [term + theta * value, value + theta * slope]
        });
        [radius, slope / ring.rise, ring.start[1] + theta * ring.rise]
    }

    fn put_edge_at_front(&mut self) {
        let ring = self.rings.len() - 1;
        let place = self.place(ring, 1.0);
        (self.edge.place, self.edge.radius) = (Some(place), place[0]);
        (self.edge.ring, self.edge.theta, self.edge.lag) = (ring, 1.0, 0.0);
        self.edge.load = self.viscosity * self.speed;
        self.edge.modulus = f64::INFINITY;
        self.edge.decays.fill(1.0);
        self.edge.strains.fill(0.0);
        self.edge.sums.copy_from_slice(&self.now.load);
        self.at_contact.copy_from(&self.now);
        self.last_edge_shift = 0.0;
        (self.edge.shift, self.edge.correction) = (0.0, 0.0);
    }

    /// The element of a ring that was touched at a depth: how much deeper the edge is by Halley's method, and by how much the
    /// modulus changes on the way there; where that is much, by Newton's.
    fn step_to_edge(&mut self, index: usize, depth: f64) -> [f64; 2] {
        let n = self.rates.len();
        let integrals_at_rings = &self.integrals_at_rings[2 * index * n..(2 * index + 1) * n];
        let ring = &self.rings[index];
        let theta = ((depth - ring.start[1]) / ring.rise).clamp(0.0, 1.0);
        let (step, rise) = (theta * ring.step, theta * ring.rise);
        let edge = &mut self.edge;
        (edge.ring, edge.theta, edge.lag) = (index, theta, self.point[0] - (ring.start[0] + step));
        edge.load = self.viscosity * self.speed;
        let [mut modulus, mut slope] = [0.0; 2];
        for (k, at_contact) in integrals_at_rings.iter().enumerate() {
            let (rate, glass) = (self.rates[k], self.moduli[k]);
            let [decay, mean] = decay_and_mean(rate * step);
            let at_contact = decay * at_contact + rise * mean;
            let decay = (-rate * edge.lag).exp();
            let strain = self.now.depth[k] - decay * at_contact;
            (edge.decays[k], edge.strains[k]) = (decay, strain);
            edge.load += glass * strain;
            modulus += glass * decay;
            slope += rate * glass * decay;
        }
        edge.modulus = modulus;
        if edge.load == 0.0 || modulus <= f64::MIN_POSITIVE {
            // What has forgotten when it was touched is loaded or not whenever that was.
            return [edge.load * f64::INFINITY, 0.0].map(|x| if x.is_nan() { 0.0 } else { x });
        }
        let shift = edge.load / modulus;
        let curvature = 0.5 * shift * slope / modulus * (ring.step / ring.rise);
        match curvature.abs() < 0.25 {
            true => [shift / (1.0 + curvature), curvature],
            false => [shift, curvature],
        }
    }

    /// For the depth at which the element at the edge was touched: its load falls outwards, ever more steeply, so that the
    /// steps come from outside; those that are too short are replaced by halving a bracket.
    fn find_edge(&mut self) {
        let Some(last) = self.rings.len().checked_sub(1) else {
            return;
        };
        let deepest = self.deepest();
        let (mut ring, before) = match self.edge.place {
            Some([.., depth]) => (self.edge.ring, depth + self.edge.shift),
            None => (0, 0.0),
        };
        let mut depth = (before + self.last_edge_shift).clamp(0.0, deepest);
        self.edge.place = None;
        let mut bracket = [0.0, deepest];
        for step in 0..MAX_EDGE_STEPS {
            while ring > 0 && depth < self.rings[ring].start[1] {
                ring -= 1;
            }
            while ring < last && depth > self.rings[ring + 1].start[1] {
                ring += 1;
            }
            let [shift, curvature] = self.step_to_edge(ring, depth);
            let is_left = self.edge.load < 0.0;
            if depth <= 0.0 && is_left {
                return;
            }
            bracket[usize::from(is_left)] = depth;
            let next = (depth + shift).clamp(0.0, deepest);
            let change = (next - depth).abs() / next;
            let of_force =
                change * change * (change + curvature.abs()) <= EDGE_TOLERANCE * EDGE_TOLERANCE;
            let is_still = next.total_cmp(&depth).is_eq();
            if is_still
                || change <= EDGE_TOLERANCE
                || (of_force && self.now.time_weighted.is_empty())
            {
                self.last_edge_shift = next - before;
                self.integrate_to_edge(next - depth);
                return;
            }
            depth = match step {
                _ if step < UNGUARDED_EDGE_STEPS => next,
                UNGUARDED_EDGE_STEPS => 0.0,
                _ if step % 2 == 0 => 0.5 * (bracket[0] + bracket[1]),
                _ => next,
            };
        }
        self.integrate_to_edge(0.0);
    }

    /// Φ_k/G_k from the edge as it was found but for a last shift of its depth.
    fn integrate_to_edge(&mut self, shift: f64) {
        let Edge { ring, theta, .. } = self.edge;
        let [radius, slope, depth] = self.place(ring, theta);
        if ring + 1 == self.rings.len() && theta >= 1.0 {
            self.at_contact.copy_from(&self.at_front);
        } else {
            self.find_integrals_at_edge();
        }
        let edge = &mut self.edge;
        for (k, sum) in edge.sums.iter_mut().enumerate() {
            *sum = radius * edge.strains[k] + edge.decays[k] * self.at_contact.load[k];
        }
        // ∂F/∂D = a' w at constant t, and w falls to 0 within the shift.
        (edge.shift, edge.correction) = (shift, 0.5 * slope * edge.load * shift);
        edge.place = Some([radius, slope, depth]);
        let from = self.rings[ring].start[1];
        edge.radius = self.radii.at([from, depth + shift])[0];
    }

    /// A ring up to θ.
    fn part(&self, ring: usize, theta: f64) -> (Ring, [f64; N_COEFFICIENTS]) {
        let mut ring = self.rings[ring];
        let mut terms = [0.0; N_COEFFICIENTS];
        let mut power = 1.0;
        let whole = &self.coefficients[ring.first..ring.first + ring.n_terms];
        for (part, term) in terms.iter_mut().zip(whole) {
            *part = power * term;
            power *= theta;
        }
        ring.step *= theta;
        ring.rise *= theta;
        (ring, terms)
    }

    /// What the branches remembered when the element at the edge was touched.
    fn find_integrals_at_edge(&mut self) {
        let (n, index) = (self.rates.len(), self.edge.ring);
        let (ring, terms) = self.part(index, self.edge.theta);
        let integrals_at_rings = &self.integrals_at_rings[2 * index * n..2 * (index + 1) * n];
        let n_time_weighted = self.now.time_weighted.len();
        self.at_contact
            .depth
            .copy_from_slice(&integrals_at_rings[..n]);
        self.at_contact
            .load
            .copy_from_slice(&integrals_at_rings[n..]);
        let time_weighted =
            &self.time_weighted_at_rings[index * n_time_weighted..(index + 1) * n_time_weighted];
        self.at_contact.time_weighted.copy_from_slice(time_weighted);
        let n_moments = ring.n_terms + usize::from(n_time_weighted > 0);
        self.partial.set(&self.rates, ring.step, n_moments, 0.0);
        self.partial
            .grow(&mut self.at_contact, &ring, &terms[..ring.n_terms]);
    }
}

/// By how much steps that end at a time may differ, as times are rounded.
fn rounding(time: f64, step: f64) -> f64 {
    4.0 * f64::EPSILON * time.abs().min(1e3 * step)
}
