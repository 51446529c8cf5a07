//! One element of the line: when the body touches and leaves it, and what it remembers.
//!
//! ```text
//! touched at s:  u = d − h̃       σ_k(t) = G_k (q_k(t) − e^(−(t − s)/τ_k) q_k(s)) + e^(−(t − s)/τ_k) σ_k(s)
//! free from s:   u = Σ y_j e^(−(t − s)/λ_j)       w = 0
//! y_j = (J_j/λ_j) [η₀ u + Σ G_k τ_k z_k/(1 − τ_k/λ_j)]      z_k = u − σ_k/G_k
//! ```
//! The last line is the expansion of u in the poles of 1/(s Ĝ(s)), with what the branches hold at the moment s.

use indenters::EquivalentProfile;
use numerics::bracketed_root;

use super::path::{Instant, Mode, Path, fading};

/// How the edge moves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Motion {
    /// Outwards, over elements that were never touched.
    First,
    /// Outwards, over elements that were touched before.
    Again,
    /// Inwards.
    Leaving,
}

/// A ring over which the edge moves in one direction, within one segment of the path.
#[derive(Debug, Clone, Copy)]
pub(super) struct Leg {
    pub(super) motion: Motion,
    pub(super) from: Instant,
    pub(super) to: Instant,
    /// Radii of the ring, \[m].
    pub(super) inner: f64,
    pub(super) outer: f64,
    /// Number of legs before it.
    pub(super) before: usize,
}

/// An element in contact.
pub(super) struct Touched {
    since: Instant,
    /// σ_k at that moment.
    stresses: Vec<f64>,
}

/// An element that the body has left.
pub(super) struct Free {
    since: Instant,
    height: f64,
    /// y_j.
    amplitudes: Vec<f64>,
}

/// What became of an element in the last event of its history.
pub(super) enum State {
    Untouched,
    Touched(Touched),
    Free(Free),
}

/// Elements of one line under one path.
pub(super) struct Elements<'a> {
    pub(super) body: &'a dyn EquivalentProfile,
    pub(super) path: &'a Path,
}

impl Elements<'_> {
    /// The element at a radius after the legs of a contact.
    pub(super) fn follow(&self, radius: f64, legs: &[Leg]) -> State {
        let inside = |leg: &&Leg| leg.inner < radius && radius <= leg.outer;
        // Beyond the end of a body is only what rounding of its radius puts there.
        let height = self.body.height_at(radius.min(self.body.end()));
        let mut state = State::Untouched;
        for leg in legs.iter().filter(inside) {
            state = match (leg.motion, state) {
                (Motion::First, State::Untouched) => {
                    let at = self.path.passes(leg.from.segment, height);
                    let part = at.part.clamp(leg.from.part, leg.to.part);
                    State::Touched(Touched {
                        since: Instant { part, ..at },
                        stresses: vec![0.0; self.path.n_branches()],
                    })
                }
                (Motion::Again, State::Free(free)) => {
                    let at = within(leg, |at| self.gap(&free, at));
                    State::Touched(Touched {
                        since: at,
                        stresses: self.free_stresses(&free, at),
                    })
                }
                (Motion::Leaving, State::Touched(touched)) => {
                    let before = self.stresses(&touched, leg.from);
                    let at = within(leg, |at| self.path.load_later(&before, leg.from, at));
                    State::Free(self.release(height, &self.stresses(&touched, at), at))
                }
                (_, state) => state,
            };
        }
        state
    }

    /// σ_k of an element in contact.
    pub(super) fn stresses(&self, touched: &Touched, at: Instant) -> Vec<f64> {
        let lag = self.path.lag(touched.since, at);
        let held = touched.stresses.iter().zip(&lag.decays);
        let held = held.map(|(stress, decay)| stress * decay);
        let both = held.zip(lag.stresses);
        both.map(|(held, gained)| held + gained).collect()
    }

    fn release(&self, height: f64, stresses: &[f64], since: Instant) -> Free {
        let path = self.path;
        let displacement = path.depth(since) - height;
        let viscous = path.moduli.iter().zip(stresses);
        let viscous = viscous.map(|(modulus, stress)| modulus * displacement - stress);
        let viscous: Vec<f64> = viscous.collect();
        let amplitude = |(mode, row): (&Mode, &[f64])| {
            let held: f64 = row.iter().zip(&viscous).map(|(c, held)| c * held).sum();
            mode.fluidity * (path.viscosity * displacement + held)
        };
        Free {
            since,
            height,
            amplitudes: path.modes().map(amplitude).collect(),
        }
    }

    /// Height of the body over a free element, \[m].
    pub(super) fn gap(&self, free: &Free, at: Instant) -> f64 {
        free.height + self.recovering(free, at).sum::<f64>() - self.path.depth(at)
    }

    /// y_j e^(−(t − s)/λ_j).
    fn recovering(&self, free: &Free, at: Instant) -> impl Iterator<Item = f64> {
        let lag = self.path.time(at) - self.path.time(free.since);
        let modes = self.path.modes().zip(&free.amplitudes);
        modes.map(move |((mode, _), amplitude)| amplitude * fading(mode.rate * lag))
    }

    /// σ_k = G_k (u − z_k) of a free element; in one mode z is y/(1 − τ_k/λ_j).
    pub(super) fn free_stresses(&self, free: &Free, at: Instant) -> Vec<f64> {
        let path = self.path;
        let (mut strains, mut height) = (vec![0.0; path.n_branches()], 0.0);
        for (y, (mode, row)) in self.recovering(free, at).zip(path.modes()) {
            height += y;
            let rate = y * mode.rate;
            for (strain, coupling) in strains.iter_mut().zip(row) {
                *strain -= rate * coupling;
            }
        }
        // A lone spring is stretched by all of it.
        let springs = strains.iter_mut().zip(&path.rates);
        let springs = springs.filter(|(_, rate)| **rate == 0.0);
        springs.for_each(|(strain, _)| *strain = height);
        let stresses = path.moduli.iter().zip(strains);
        stresses.map(|(modulus, strain)| modulus * strain).collect()
    }
}

/// The instant of a leg at which a falling quantity vanishes; its beginning or end where it does not.
fn within(leg: &Leg, falling: impl Fn(Instant) -> f64) -> Instant {
    let at = |part| Instant { part, ..leg.from };
    let ends = [leg.from.part, leg.to.part];
    let end = || {
        let is_past = falling(leg.from) <= 0.0;
        if is_past { ends[0] } else { ends[1] }
    };
    at(bracketed_root(|part| falling(at(part)), ends).unwrap_or_else(end))
}
