//! A contact that grows over new elements and then shrinks, in closed form.
//!
//! ```text
//! F = 8/(2 (1 − ν)) [a w + Σ G_k e^(−(t − t₁)/τ_k) P_k(t₁)]        w = η₀ ḋ + Σ G_k [q_k(t) − e^(−(t − t₁)/τ_k) q_k(t₁)]
//! q_k(t) = ∫ e^(−(t − s)/τ_k) ḋ ds        P_k(t) = ∫ e^(−(t − s)/τ_k) a(D) ḋ ds        D(s) = max d(s') up to s
//! ```
//! d is the depth, D its largest value so far, and a(D) the radius at which the line reaches the depth D. The branches G_k, τ_k
//! include the equilibrium spring, with 1/τ = 0. The element at the edge came into contact at t₁ and carries w. Where the contact
//! shrinks w = 0, so that ∂F/∂t₁ ∝ w vanishes (Ting 1966, J. Appl. Mech. 33, 845).
//!
//! For each point of the path [`Approach::follow`] integrates q_k, and P_k while the contact grows, and finds t₁ by Halley's
//! method inside a bracket. The derivatives need the integrals weighted by the time that has passed, too.

use rheology::RelaxationSpectrum;

use super::integrals::{HistoryIntegrals, Ring, StepIntegrals, TimeWeightedIntegrals};
use super::path::{EXTENT_ROUNDING, change_of_edge, speed_rounding};
use super::radius::Radii;
use super::{ContactSums, SUM_ROUNDING};
use crate::branches::decay_and_mean;

/// A point of the path.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct DepthAt {
    /// Time, \[s].
    pub(super) time: f64,
    /// Indentation depth, \[m].
    pub(super) depth: f64,
}

/// The element that came into contact at a depth D.
#[derive(Debug, Clone, Copy)]
pub(super) struct EdgePlace {
    /// Radius a(D) of the element, \[m].
    pub(super) radius: f64,
    /// Derivative da/dD of the radius.
    pub(super) slope: f64,
    /// Depth D at which it came into contact, \[m].
    pub(super) depth: f64,
}

/// A step of the search for the edge.
struct EdgeStep {
    /// Depth of the edge less that of the present estimate, \[m].
    shift: f64,
    /// Half the relative change of the modulus over the shift.
    curvature: f64,
}

/// The element at the edge, and the decay of the branches since it came into contact.
#[derive(Debug, Clone, Default)]
pub(super) struct EdgeElement {
    /// Index of the ring in which the edge is.
    ring: usize,
    /// Position θ ∈ [0, 1] of the edge in this ring.
    theta: f64,
    /// Element at which the sums are computed, short of `shift`; `None` without contact.
    pub(super) place: Option<EdgePlace>,
    /// Speed ḋ at which the edge was found, \[m/s].
    speed: f64,
    /// Depth of the edge less that of `place`, by the last step of the search, \[m].
    shift: f64,
    /// Change of the sum of the loads by the shift, \[N].
    correction: f64,
    /// Contact radius after the shift, \[m].
    radius: f64,
    /// Time t − t₁ since the element came into contact, \[s].
    pub(super) lag: f64,
    /// Load w of the element, \[N/m].
    pub(super) load: f64,
    /// Relaxation modulus G(t − t₁), \[Pa].
    pub(super) modulus: f64,
    /// Decay e^(−(t − t₁)/τ_k) of each branch.
    pub(super) decays: Vec<f64>,
    /// Strain q_k(t) − e^(−(t − t₁)/τ_k) q_k(t₁) of each branch, \[m].
    pub(super) strains: Vec<f64>,
    /// Integral of the strain of branch k over the contact, \[m²]: Φ_k/G_k.
    pub(super) sums: Vec<f64>,
}

/// A body that follows a path of the depth, and the integrals over its history.
pub(super) struct Approach {
    /// Contact radius as a function of the depth.
    radii: Radii,
    /// Error of the sum of the loads by the polynomials of the radii, \[N].
    load_error: f64,
    /// Moduli G_k of the branches, the equilibrium spring last, \[Pa].
    pub(super) moduli: Vec<f64>,
    /// Rates 1/τ_k of the branches, 0 of the equilibrium spring, \[1/s].
    pub(super) rates: Vec<f64>,
    /// Viscosity η₀ of the parallel dashpot, \[Pa s].
    pub(super) viscosity: f64,
    /// The integrals now; those of the load only as long as the contact grows.
    pub(super) now: HistoryIntegrals,
    /// The present point of the path.
    pub(super) point: DepthAt,
    /// Speed ḋ up to the point, \[m/s].
    pub(super) speed: f64,
    /// Time since the point before, \[s].
    step: f64,
    /// Rings of elements in the order in which they came into contact.
    rings: Vec<Ring>,
    /// The integrals at the beginning of every ring.
    at_rings: Vec<HistoryIntegrals>,
    /// The integrals at the end of the last ring.
    at_front: HistoryIntegrals,
    /// The integrals at t₁, when the element at the edge came into contact.
    pub(super) at_contact: HistoryIntegrals,
    /// Element at the edge of the contact.
    pub(super) edge: EdgeElement,
    /// True if the depth has been less than its maximum since the last growth, so that the present P_k are outdated.
    front_is_behind: bool,
    /// True if the edge lies inside the largest contact.
    has_receded: bool,
    /// True if elements have come into contact again, for which the closed form does not hold.
    pub(super) has_recontact: bool,
    /// Change of the depth of the edge between the last two points, \[m].
    last_edge_shift: f64,
    /// Moments of the last step; steps of one length share them.
    step_integrals: StepIntegrals,
    /// Moments over the part of a ring up to the edge.
    partial_integrals: StepIntegrals,
}

/// Number of steps of the search for the edge that are not guarded by bisection; afterwards every other step halves the
/// bracket. Chosen: a larger number only delays searches in which Halley's method does not converge.
const UNGUARDED_EDGE_STEPS: usize = 16;
/// Largest number of steps in the search for the edge. Derived: 91 of them have then halved the bracket, which is narrower than
/// rounding.
const MAX_EDGE_STEPS: usize = 200;
/// Relative change of the depth of the edge at which the search for the edge ends. Chosen: the derivatives of the force have
/// this relative error, and the force itself has its square or less.
const EDGE_TOLERANCE: f64 = 1e-8;

impl Approach {
    /// A body before its first point. `n_points` is the number of points of the path; with `differentiates` the integrals for
    /// derivatives are kept too.
    pub(super) fn new(
        radii: Radii,
        spectrum: &RelaxationSpectrum,
        n_points: usize,
        differentiates: bool,
    ) -> Self {
        // The equilibrium spring is appended to the branches as one that does not relax: its rate is 0.
        let branches = spectrum.branches().iter();
        let branch_moduli = branches.clone().map(|branch| branch.modulus);
        let moduli: Vec<f64> = branch_moduli
            .chain([spectrum.equilibrium_modulus()])
            .collect();
        let branch_rates = branches.map(|branch| branch.relaxation_time.recip());
        let rates: Vec<f64> = branch_rates.chain([0.0]).collect();
        let n = rates.len();
        // Each branch has integrals of depth and load; those for derivatives on request.
        let now = HistoryIntegrals {
            depth: vec![0.0; n],
            load: vec![0.0; n],
            time_weighted: vec![
                TimeWeightedIntegrals::default();
                if differentiates { n } else { 0 }
            ],
        };
        Self {
            load_error: moduli.iter().sum::<f64>() * radii.area_error,
            radii,
            moduli,
            viscosity: spectrum.viscosity(),
            at_front: now.clone(),
            at_contact: now.clone(),
            now,
            point: DepthAt::default(),
            speed: 0.0,
            step: 0.0,
            rings: Vec::with_capacity(n_points),
            at_rings: Vec::with_capacity(n_points),
            edge: EdgeElement {
                decays: vec![1.0; n],
                strains: vec![0.0; n],
                sums: vec![0.0; n],
                ..EdgeElement::default()
            },
            front_is_behind: false,
            has_receded: false,
            has_recontact: false,
            last_edge_shift: 0.0,
            step_integrals: StepIntegrals::default(),
            partial_integrals: StepIntegrals::default(),
            rates,
        }
    }

    /// Starts at a time \[s] and depth \[m]; a body below the undeformed surface starts at the surface, and jumps to its first point.
    pub(super) fn start(&mut self, time: f64, depth: f64) {
        self.point = DepthAt {
            time,
            depth: depth.min(0.0),
        };
    }

    /// Sums over the present contact.
    pub(super) fn contact_sums(&self) -> ContactSums {
        let DepthAt { time, depth } = self.point;
        let Some(EdgePlace { radius, slope, .. }) = self.edge.place else {
            return ContactSums {
                time,
                depth,
                ..ContactSums::default()
            };
        };
        // Sum the loads of the dashpot, the branches and the spring.
        let viscous = self.viscosity * self.speed * radius;
        let [mut load, mut terms] = [viscous + self.edge.correction, viscous.abs()];
        for (modulus, sum) in self.moduli.iter().zip(&self.edge.sums) {
            load += modulus * sum;
            terms += modulus * sum.abs();
        }
        // The sizes of all terms bound the rounding of the load; the polynomials of the radii add their own error.
        let scale = self.load_scale();
        ContactSums {
            time,
            depth,
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

    /// Largest depth D so far, \[m].
    fn deepest(&self) -> f64 {
        let last = self.rings.last();
        last.map_or(0.0, |ring| ring.start_depth + ring.rise)
    }

    /// Size of the terms that cancel in the load w of an element, \[N/m].
    fn load_scale(&self) -> f64 {
        let viscous = self.viscosity * self.speed.abs();
        let branches = self.moduli.iter().zip(&self.now.depth);
        branches.fold(viscous, |scale, (modulus, depth)| {
            scale + modulus * depth.abs()
        })
    }

    /// Size of the terms that cancel in the rate of the load of an element, \[Pa m/s].
    fn rate_scale(&self) -> f64 {
        let branches = self.moduli.iter().zip(&self.rates).zip(&self.now.depth);
        branches
            .map(|((modulus, rate), depth)| rate * (modulus * depth.abs()))
            .sum()
    }

    /// Follows the body to the next point, at a time \[s] and a depth \[m]. Once the body is above the undeformed surface, the surface
    /// counts as recovered.
    pub(super) fn follow(&mut self, time: f64, depth: f64) {
        let start = std::mem::replace(&mut self.point, DepthAt { time, depth });
        let end = self.point;
        self.step = end.time - start.time;
        self.speed = match self.step {
            0.0 => 0.0,
            step => (end.depth - start.depth) / step,
        };
        if end.depth <= 0.0 {
            self.clear_history();
            return;
        }
        let at = |depth: f64| {
            let part = (depth - start.depth) / (end.depth - start.depth);
            DepthAt {
                time: start.time + part * (end.time - start.time),
                depth,
            }
        };
        // A body above the surface begins its step where it touches the surface.
        let mut from = if start.depth < 0.0 { at(0.0) } else { start };
        self.has_recontact |= end.time > start.time && self.edge_turns_outwards();
        let deepest = self.deepest();

        // Below the largest depth the contact shrinks or rests: only the edge is sought.
        if end.depth <= deepest {
            self.hold(from, end);
            let before = self.radius();
            self.find_edge();
            let has_widened = self.has_receded && self.radius() > before * (1.0 + EXTENT_ROUNDING);
            self.has_recontact |=
                has_widened || (end.time > start.time && self.edge_turns_outwards());
            let edge = self.edge.place.map(|place| place.depth);
            self.has_receded |= edge.is_none_or(|depth| depth < (1.0 - EXTENT_ROUNDING) * deepest);
            return;
        }

        // Beyond the largest depth so far the contact grows over new elements, from piece to piece of the polynomials for the
        // radius.
        self.has_recontact |= self.has_receded;
        self.has_receded = false;
        if from.depth < deepest {
            let to = at(deepest);
            self.hold(from, to);
            from = to;
        }
        if self.front_is_behind {
            self.catch_up_from_front(from.time);
        }
        while self.deepest() < end.depth {
            let limit = self.radii.end_of_piece(self.deepest()).min(end.depth);
            let to = if limit < end.depth { at(limit) } else { end };
            self.grow(from, to);
            from = to;
        }
        self.put_edge_at_front();
    }

    /// Clears contact and history, because the surface under a body above it counts as recovered.
    fn clear_history(&mut self) {
        self.has_receded |= !self.rings.is_empty();
        self.rings.clear();
        self.at_rings.clear();
        self.now.depth.fill(0.0);
        self.now.load.fill(0.0);
        self.now
            .time_weighted
            .fill(TimeWeightedIntegrals::default());
        self.edge.place = None;
    }

    /// True if an edge that has moved inwards moves outwards at the present speed.
    fn edge_turns_outwards(&self) -> bool {
        self.has_receded && self.edge.place.is_some() && self.edge_direction() > 0.0
    }

    /// Direction of the edge: positive if the load of its element grows while it stays in contact, negative if it falls.
    fn edge_direction(&self) -> f64 {
        // The edge was found where the load vanishes; a parallel dashpot has since changed the load by the change of the speed.
        let jump = self.speed - self.edge.speed;
        let DepthAt { time, depth } = self.point;
        if self.viscosity > 0.0 && jump.abs() > speed_rounding(self.speed, self.step, time, depth) {
            return jump;
        }
        let strains = self.edge.strains.iter().enumerate();
        let rate: f64 = strains
            .map(|(k, strain)| self.moduli[k] * (self.speed - self.rates[k] * strain))
            .sum();
        let has_rate = rate.abs() > SUM_ROUNDING * self.rate_scale();
        if has_rate { rate } else { 0.0 }
    }

    /// Advances the integrals q_k over a step in which the contact does not grow; the integrals P_k follow later from those at the end
    /// of the last ring, by [`catch_up_from_front`](Self::catch_up_from_front).
    fn hold(&mut self, from: DepthAt, to: DepthAt) {
        if self.rings.is_empty() {
            return;
        }
        self.front_is_behind = true;
        let step = to.time - from.time;
        let rounding = duration_rounding(to.time, step);
        self.step_integrals.set(&self.rates, step, 2, rounding);
        self.step_integrals
            .hold(&mut self.now, to.depth - from.depth);
    }

    /// Updates the present integrals P_k from those at the end of the last ring, for a contact that is about to grow again at a
    /// `time` \[s].
    fn catch_up_from_front(&mut self, time: f64) {
        self.front_is_behind = false;
        let Some(ring) = self.rings.last().copied() else {
            return;
        };
        // Advance the integrals at the front over the time without growth, with the strain of the edge.
        let lag = time - (ring.start_time + ring.duration);
        let edge = self.element_at(self.rings.len() - 1, 1.0);
        for (k, rate) in self.rates.iter().enumerate() {
            let decay = (-rate * lag).exp();
            let [at_contact, load] = [self.at_front.depth[k], self.at_front.load[k]];
            let strain = self.now.depth[k] - decay * at_contact;
            self.now.load[k] = edge.radius * strain + decay * load;
            if let Some(time_weighted) = self.now.time_weighted.get_mut(k) {
                let before = self.at_front.time_weighted[k];
                time_weighted.load = edge.radius
                    * (time_weighted.depth - decay * (before.depth + lag * at_contact))
                    + decay * (before.load + lag * load);
                time_weighted.edge = decay * before.edge + edge.slope * strain;
                time_weighted.stretch = decay * before.stretch - edge.depth * edge.slope * strain;
            }
        }
    }

    /// Grows over new elements, within a piece of the radii: appends their ring with the integrals at its beginning, and advances
    /// the integrals to its end.
    fn grow(&mut self, from: DepthAt, to: DepthAt) {
        let deepest = self.deepest();
        let radius = self.radii.polynomial_between([deepest, to.depth]);
        let ring = Ring {
            start_time: from.time,
            start_depth: deepest,
            duration: to.time - from.time,
            rise: to.depth - deepest,
            radius,
        };
        if self.rings.is_empty() {
            // All elements of a flat end come into contact together, so that its whole radius is gained at first contact.
            for time_weighted in &mut self.now.time_weighted {
                time_weighted.edge = radius.terms()[0];
            }
        }
        self.rings.push(ring);
        self.at_rings.push(self.now.clone());
        let rounding = duration_rounding(to.time, ring.duration);
        self.step_integrals
            .grow(&self.rates, &mut self.now, &ring, rounding);
        self.at_front.copy_from(&self.now);
    }

    /// The element at a position θ ∈ [0, 1] of the ring with this index.
    fn element_at(&self, ring: usize, theta: f64) -> EdgePlace {
        let ring = &self.rings[ring];
        let terms = ring.radius.terms().iter().rev();
        let [radius, slope] = terms.fold([0.0; 2], |[value, slope], term| {
            [term + theta * value, value + theta * slope]
        });
        EdgePlace {
            radius,
            slope: slope / ring.rise,
            depth: ring.start_depth + theta * ring.rise,
        }
    }

    /// Moves the edge to the end of the last ring, as in a growing contact.
    fn put_edge_at_front(&mut self) {
        let ring = self.rings.len() - 1;
        let place = self.element_at(ring, 1.0);
        (self.edge.place, self.edge.radius) = (Some(place), place.radius);
        (self.edge.ring, self.edge.theta, self.edge.lag) = (ring, 1.0, 0.0);
        (self.edge.speed, self.edge.load) = (self.speed, self.viscosity * self.speed);
        self.edge.modulus = f64::INFINITY;
        self.edge.decays.fill(1.0);
        self.edge.strains.fill(0.0);
        self.edge.sums.copy_from_slice(&self.now.load);
        self.at_contact.copy_from(&self.now);
        self.last_edge_shift = 0.0;
        (self.edge.shift, self.edge.correction) = (0.0, 0.0);
    }

    /// Computes the load of the element that came into contact at a depth \[m] in the ring of this index, and the step from that depth
    /// to the edge.
    ///
    /// The step is that of Halley's method for w = 0; where the modulus changes much on the way, of Newton's.
    fn step_to_edge(&mut self, index: usize, depth: f64) -> EdgeStep {
        let ring = &self.rings[index];
        let theta = ((depth - ring.start_depth) / ring.rise).clamp(0.0, 1.0);
        let (step, rise) = (theta * ring.duration, theta * ring.rise);
        let edge = &mut self.edge;
        (edge.ring, edge.theta, edge.lag) =
            (index, theta, self.point.time - (ring.start_time + step));

        // The loop sums the load w of the element, the modulus −∂w/∂D by which w falls with the depth D of contact, and the
        // rate at which this modulus changes.
        (edge.speed, edge.load) = (self.speed, self.viscosity * self.speed);
        let [mut modulus, mut slope] = [0.0; 2];
        for (k, at_contact) in self.at_rings[index].depth.iter().enumerate() {
            let (rate, stiffness) = (self.rates[k], self.moduli[k]);
            let [decay, mean] = decay_and_mean(rate * step);
            let at_contact = decay * at_contact + rise * mean;
            let decay = (-rate * edge.lag).exp();
            let strain = self.now.depth[k] - decay * at_contact;
            (edge.decays[k], edge.strains[k]) = (decay, strain);
            edge.load += stiffness * strain;
            modulus += stiffness * decay;
            slope += rate * stiffness * decay;
        }
        edge.modulus = modulus;
        if edge.load == 0.0 || modulus <= f64::MIN_POSITIVE {
            // Where all branches have relaxed since, the load does not depend on the time of contact.
            let shift = edge.load * f64::INFINITY;
            return EdgeStep {
                shift: if shift.is_nan() { 0.0 } else { shift },
                curvature: 0.0,
            };
        }

        // Step along the line to the position at which the load potential w vanishes.
        let shift = edge.load / modulus;
        let curvature = 0.5 * shift * slope / modulus * (ring.duration / ring.rise);
        // Halley's step only while its denominator 1 + curvature is far from 0.
        let is_moderate = curvature.abs() < 0.25;
        EdgeStep {
            shift: if is_moderate {
                shift / (1.0 + curvature)
            } else {
                shift
            },
            curvature,
        }
    }

    /// Finds the depth at which the element at the edge came into contact.
    ///
    /// The load of the elements falls outwards, ever more steeply, so that the steps come from outside. Steps that are too
    /// short are replaced by halving a bracket.
    fn find_edge(&mut self) {
        let Some(last) = self.rings.len().checked_sub(1) else {
            return;
        };
        let deepest = self.deepest();
        // Start from the previous edge, shifted as in the step before.
        let (mut ring, before) = match self.edge.place {
            Some(place) => (self.edge.ring, place.depth + self.edge.shift),
            None => (0, 0.0),
        };
        let mut depth = (before + self.last_edge_shift).clamp(0.0, deepest);
        self.edge.place = None;
        let mut bracket = [0.0, deepest];
        for step in 0..MAX_EDGE_STEPS {
            // The search moves to the ring whose elements came into contact at the trial depth.
            while ring > 0 && depth < self.rings[ring].start_depth {
                ring -= 1;
            }
            while ring < last && depth > self.rings[ring + 1].start_depth {
                ring += 1;
            }
            let EdgeStep { shift, curvature } = self.step_to_edge(ring, depth);
            let is_tensile = self.edge.load < 0.0;
            if depth <= 0.0 && is_tensile {
                return;
            }

            // The load falls outwards: a tensile element bounds the edge from outside.
            bracket[usize::from(is_tensile)] = depth;
            let next = (depth + shift).clamp(0.0, deepest);

            // Stop by the change of the depth, or by its effect on the force if no derivatives are wanted.
            let change = (next - depth).abs() / next;
            let force_is_known =
                change * change * (change + curvature.abs()) <= EDGE_TOLERANCE * EDGE_TOLERANCE;
            let is_unchanged = next.total_cmp(&depth).is_eq();
            if is_unchanged
                || change <= EDGE_TOLERANCE
                || (force_is_known && self.now.time_weighted.is_empty())
            {
                self.last_edge_shift = next - before;
                self.integrate_to_edge(next - depth);
                return;
            }
            // The first steps are Halley's. If they do not converge, the search starts again at the depth 0, and every other
            // step halves the bracket.
            depth = match step {
                _ if step < UNGUARDED_EDGE_STEPS => next,
                UNGUARDED_EDGE_STEPS => 0.0,
                _ if step % 2 == 0 => 0.5 * (bracket[0] + bracket[1]),
                _ => next,
            };
        }
        self.integrate_to_edge(0.0);
    }

    /// Computes the integral of the strain of each branch over the contact, up to the edge that the search has found. Stores also
    /// the changes of load and radius by a last `shift` of the depth of the edge, \[m].
    fn integrate_to_edge(&mut self, shift: f64) {
        let EdgeElement { ring, theta, .. } = self.edge;
        let place = self.element_at(ring, theta);
        if ring + 1 == self.rings.len() && theta >= 1.0 {
            self.at_contact.copy_from(&self.at_front);
        } else {
            self.find_integrals_at_edge();
        }
        let edge = &mut self.edge;
        for (k, sum) in edge.sums.iter_mut().enumerate() {
            *sum = place.radius * edge.strains[k] + edge.decays[k] * self.at_contact.load[k];
        }
        // At constant time the sum of the loads changes by a' w per depth D of the edge, with a' = da/dD. The load w falls to 0
        // within the shift, so that half of it counts.
        (edge.shift, edge.correction) = (shift, 0.5 * place.slope * edge.load * shift);
        edge.place = Some(place);
        let from = self.rings[ring].start_depth;
        edge.radius = self.radii.radius_and_slope([from, place.depth + shift])[0];
    }

    /// Computes the integrals at t₁, when the element at the edge came into contact.
    fn find_integrals_at_edge(&mut self) {
        // The integrals are known at the inner boundary of the ring, and are advanced over the part of the ring inside the
        // edge.
        let EdgeElement { ring, theta, .. } = self.edge;
        self.at_contact.copy_from(&self.at_rings[ring]);
        let inside = self.rings[ring].up_to(theta);
        self.partial_integrals
            .grow(&self.rates, &mut self.at_contact, &inside, 0.0);
    }
}

/// Largest difference of two durations of about `step`, up to a `time`, that may be rounding, \[s]: four units in the last place of
/// the time. It is at most 1e-12 of the step, so that no real difference counts as rounding.
fn duration_rounding(time: f64, step: f64) -> f64 {
    4.0 * f64::EPSILON * time.abs().min(1e3 * step)
}
