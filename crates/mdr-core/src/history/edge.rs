//! Where the contact ends while it shrinks: at the element that carries nothing.

use numerics::bracketed_root;

use super::contact::{Contact, Leg, Motion, WRONG_SIGN};
use super::element::State;
use super::path::{Instant, Lag, mean_exponential};
use crate::MdrError;

/// The edge of a contact that shrinks.
pub(super) struct Edge {
    /// Rings that are left.
    pub(super) n_rings: usize,
    pub(super) radius: f64,
    /// σ_k there.
    pub(super) stresses: Vec<f64>,
    /// In a ring over new elements: when the one at the edge was touched, and what became of the branches since.
    pub(super) first: Option<(Instant, Lag)>,
}

/// Steps of Halley's method before a bracketed root is searched instead; the one after a step so short, relative to the
/// ring, would be below rounding.
const STEPS: usize = 8;
const CLOSE: f64 = 1e-5;
impl Contact<'_> {
    /// Refuses a tension half way between the beginning of a ring of elements touched again and the edge in it.
    pub(super) fn check_load(&self, at: Instant) -> Result<(), MdrError> {
        let ring = self
            .rings
            .last()
            .filter(|ring| ring.motion == Motion::Again);
        let middle = ring.map(|ring| self.stresses_in(ring, 0.5 * (ring.inner + ring.outer), at));
        let pulls =
            |stresses: Vec<f64>| self.path.load(&stresses, at) < -WRONG_SIGN * self.path.scale(at);
        if middle.is_some_and(pulls) {
            return Err(MdrError::NotADisc {
                time: self.path.time(at),
            });
        }
        Ok(())
    }

    /// The edge as it is, later.
    pub(super) fn outermost(&self, at: Instant) -> Option<Edge> {
        let ring = self.rings.last()?;
        let lag = (ring.motion == Motion::First).then(|| self.path.lag(ring.to, at));
        Some(Edge {
            n_rings: self.rings.len(),
            radius: ring.outer,
            stresses: match &lag {
                Some(lag) => lag.stresses.clone(),
                None => self.stresses_in(ring, ring.outer, at),
            },
            first: lag.map(|lag| (ring.to, lag)),
        })
    }

    /// The edge of a contact that can only shrink; none where nothing is loaded.
    pub(super) fn edge_inwards(&self, at: Instant) -> Option<Edge> {
        let mut rings = self.rings.iter().enumerate().rev();
        rings.find_map(|(below, ring)| {
            let edge = if ring.motion == Motion::First {
                self.edge_in_first(ring, at)
            } else {
                self.edge_in_again(ring, at)
            };
            edge.map(|edge| Edge {
                n_rings: below + 1,
                ..edge
            })
        })
    }

    /// The edge in a ring over new elements, by Halley's method from its inner side: the load falls outwards.
    fn edge_in_first(&self, ring: &Leg, at: Instant) -> Option<Edge> {
        let path = &self.path;
        let inner = path.lag(ring.from, at);
        if path.load(&inner.stresses, at) < 0.0 {
            return None;
        }
        let parts = [ring.from.part, ring.to.part];
        let mut lag = inner.clone();
        let mut part = parts[0];
        let mut converged = false;
        for _ in 0..STEPS {
            let load = path.load(&lag.stresses, at);
            let [modulus, rate] = path.modulus(&lag);
            let shift = load / (modulus * path.rise(ring.from.segment));
            // Halley's step: the modulus grows towards the edge.
            let bent = 1.0 + 0.5 * shift * rate / modulus * path.step(ring.from.segment);
            let next = (part + shift / bent.max(0.5)).clamp(parts[0], parts[1]);
            converged = (next - part).abs() <= CLOSE * (parts[1] - parts[0]);
            part = next;
            let times = [Instant { part, ..ring.from }, at];
            self.lag_inside(ring, times, &inner, &mut lag);
            if converged {
                break;
            }
        }
        if !converged {
            let load =
                |part: f64| path.load(&path.lag(Instant { part, ..ring.from }, at).stresses, at);
            part = bracketed_root(load, parts).unwrap_or(parts[1]);
            self.lag_inside(ring, [Instant { part, ..ring.from }, at], &inner, &mut lag);
        }
        let since = Instant { part, ..ring.from };
        Some(Edge {
            n_rings: 0,
            radius: self.radii.at([ring.from, since].map(|at| path.depth(at)))[0],
            stresses: lag.stresses.clone(),
            first: Some((since, lag)),
        })
    }

    /// From the beginning of a ring to a later instant in it: e^(−(t − s)/τ) grows, the stresses fall.
    fn lag_inside(&self, ring: &Leg, times: [Instant; 2], inner: &Lag, lag: &mut Lag) {
        let path = &self.path;
        let [since, at] = times;
        let (at, later) = (path.time(at), since.part - ring.from.part);
        let (step, sunk) = (path.step(since.segment), later * path.rise(since.segment));
        for (k, rate) in path.rates.iter().enumerate() {
            let x = rate * (later * step);
            let mean = mean_exponential(-x);
            lag.decays[k] = if x < 1.0 {
                inner.decays[k] / (1.0 - x * mean)
            } else {
                (-rate * (at - path.time(since))).exp()
            };
            lag.stresses[k] = inner.stresses[k] - path.moduli[k] * sunk * mean * lag.decays[k];
        }
    }

    /// The edge in a ring of elements that were touched again.
    fn edge_in_again(&self, ring: &Leg, at: Instant) -> Option<Edge> {
        let load = |radius| self.path.load(&self.stresses_in(ring, radius, at), at);
        let radius = if load(ring.outer) >= 0.0 {
            ring.outer
        } else {
            bracketed_root(load, [ring.inner, ring.outer])?
        };
        Some(Edge {
            n_rings: 0,
            radius,
            stresses: self.stresses_in(ring, radius, at),
            first: None,
        })
    }

    /// σ_k of an element in a ring of elements that were touched again.
    pub(super) fn stresses_in(&self, ring: &Leg, radius: f64, at: Instant) -> Vec<f64> {
        let radius = radius.max(ring.inner.next_up());
        match self.elements().follow(radius, &self.legs[..=ring.before]) {
            State::Touched(touched) => self.elements().stresses(&touched, at),
            // Rounding puts an element of no extent beside the ring.
            _ => self.path.lag(ring.to, at).stresses,
        }
    }
}
