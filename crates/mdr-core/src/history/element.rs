//! One element of the line: its contacts and separations, and the loads of its Maxwell branches in between.
//!
//! ```text
//! contact since s:  u = d − h̃       σ_k(t) = G_k (q_k(t) − e^(−(t − s)/τ_k) q_k(s)) + e^(−(t − s)/τ_k) σ_k(s)
//! free since s:     u = Σ y_j e^(−(t − s)/λ_j)       w = 0
//! y_j = (J_j/λ_j) [η₀ u + Σ G_k τ_k z_k/(1 − τ_k/λ_j)]      z_k = u − σ_k/G_k
//! ```
//! h̃ is the height of the line over the element, q_k the strain integrals of `path.rs`, and J_j, λ_j a mode of recovery. The *branch
//! load* σ_k is the modulus G_k times the displacement of the spring of branch k, and z_k the displacement of its dashpot. The last
//! line expands u in the poles of 1/(s Ĝ(s)), with Ĝ the Laplace transform of the relaxation modulus and the branch loads at
//! separation as initial values.

use indenters::EquivalentProfile;
use numerics::bracketed_root;

use super::path::{Path, RecoveryMode, SegmentTime};
use crate::branches::decay;

/// Direction in which the edge moves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum EdgeDirection {
    /// Outwards, over elements that were never in contact.
    FirstContact,
    /// Outwards, over elements that have been in contact.
    Recontact,
    /// The edge moves inwards: elements separate.
    Separation,
}

/// A ring over which the edge moves in one direction, within one segment of the path.
#[derive(Debug, Clone, Copy)]
pub(super) struct EdgeMove {
    /// Direction in which the edge moves.
    pub(super) direction: EdgeDirection,
    /// Time at the beginning of the move.
    pub(super) from: SegmentTime,
    /// Time at the end of the move.
    pub(super) to: SegmentTime,
    /// Inner radius of the ring, \[m].
    pub(super) inner: f64,
    /// Outer radius of the ring, \[m].
    pub(super) outer: f64,
    /// Number of earlier moves of the edge.
    pub(super) n_earlier: usize,
}

/// An element in contact.
pub(super) struct Loaded {
    /// Time of contact s.
    since: SegmentTime,
    /// Branch loads σ_k at the time of contact, \[N/m].
    loads: Vec<f64>,
}

/// A free element, which has separated from the body.
pub(super) struct Free {
    /// Time of separation s.
    since: SegmentTime,
    /// Height h̃ of the body over the element, \[m].
    height: f64,
    /// Amplitudes y_j at the time of separation, \[m].
    amplitudes: Vec<f64>,
}

/// State of an element after the last event of its history.
pub(super) enum ElementState {
    /// The element was never in contact.
    Untouched,
    /// The element is in contact with the body.
    Loaded(Loaded),
    /// The element is separated from the body and recovers.
    Free(Free),
}

/// Elements of one line under one path.
pub(super) struct LineElements<'a> {
    /// Equivalent line of the body.
    pub(super) body: &'a dyn EquivalentProfile,
    /// Depth over time, and the response of the material to it.
    pub(super) path: &'a Path,
}

impl LineElements<'_> {
    /// State of the element at a radius \[m] after all moves of the edge, which are in the order of time.
    pub(super) fn follow(&self, radius: f64, edge_moves: &[EdgeMove]) -> ElementState {
        let inside = |edge_move: &&EdgeMove| edge_move.inner < radius && radius <= edge_move.outer;
        // Only rounding of its radius puts an element beyond the end of the body.
        let height = self.body.height_at(radius.min(self.body.end()));
        // Replay the history of the element: each move of the edge over it is one event.
        let mut state = ElementState::Untouched;
        for edge_move in edge_moves.iter().filter(inside) {
            state = match (edge_move.direction, state) {
                (EdgeDirection::FirstContact, ElementState::Untouched) => {
                    let at = self.path.time_of_depth(edge_move.from.segment, height);
                    let part = at.part.clamp(edge_move.from.part, edge_move.to.part);
                    ElementState::Loaded(Loaded {
                        since: SegmentTime { part, ..at },
                        loads: vec![0.0; self.path.n_branches()],
                    })
                }
                (EdgeDirection::Recontact, ElementState::Free(free)) => {
                    let at = zero_in(edge_move, |at| self.gap(&free, at));
                    ElementState::Loaded(Loaded {
                        since: at,
                        loads: self.free_branch_loads(&free, at),
                    })
                }
                (EdgeDirection::Separation, ElementState::Loaded(loaded)) => {
                    let before = self.branch_loads(&loaded, edge_move.from);
                    let at = zero_in(edge_move, |at| {
                        self.path.load_later(&before, edge_move.from, at)
                    });
                    ElementState::Free(self.release(height, &self.branch_loads(&loaded, at), at))
                }
                (_, state) => state,
            };
        }
        state
    }

    /// Branch loads σ_k of an element in contact, \[N/m].
    pub(super) fn branch_loads(&self, loaded: &Loaded, at: SegmentTime) -> Vec<f64> {
        let past = self.path.decayed_history(loaded.since, at);
        let terms = loaded.loads.iter().zip(&past.decays).zip(past.gained_loads);
        terms
            .map(|((load, decay), gained)| load * decay + gained)
            .collect()
    }

    /// Separates an element with the branch loads σ_k \[N/m] from the body, whose height over it is `height` \[m].
    fn release(&self, height: f64, branch_loads: &[f64], since: SegmentTime) -> Free {
        let path = self.path;
        let displacement = path.depth(since) - height;
        // `viscous` holds the strain z_k of the dashpot in each branch, times the modulus G_k: it is G_k u less the branch load σ_k.
        let branches = path.moduli.iter().zip(branch_loads);
        let viscous: Vec<f64> = branches
            .map(|(modulus, branch_load)| modulus * displacement - branch_load)
            .collect();
        let amplitude = |(mode, row): (&RecoveryMode, &[f64])| {
            let excess: f64 = row.iter().zip(&viscous).map(|(c, excess)| c * excess).sum();
            mode.fluidity * (path.viscosity * displacement + excess)
        };
        Free {
            since,
            height,
            amplitudes: path.modes().map(amplitude).collect(),
        }
    }

    /// Height of the body over a free element, \[m].
    pub(super) fn gap(&self, free: &Free, at: SegmentTime) -> f64 {
        free.height + self.mode_displacements(free, at).sum::<f64>() - self.path.depth(at)
    }

    /// Displacements y_j e^(−(t − s)/λ_j) of a free element, mode by mode, \[m].
    fn mode_displacements(&self, free: &Free, at: SegmentTime) -> impl Iterator<Item = f64> {
        let lag = self.path.time(at) - self.path.time(free.since);
        let modes = self.path.modes().zip(&free.amplitudes);
        modes.map(move |((mode, _), amplitude)| amplitude * decay(mode.rate * lag))
    }

    /// Branch loads σ_k = G_k (u − z_k) of a free element, \[N/m]; in one mode z is y/(1 − τ_k/λ_j).
    pub(super) fn free_branch_loads(&self, free: &Free, at: SegmentTime) -> Vec<f64> {
        let path = self.path;
        let (mut strains, mut height) = (vec![0.0; path.n_branches()], 0.0);
        for (y, (mode, row)) in self.mode_displacements(free, at).zip(path.modes()) {
            height += y;
            let rate = y * mode.rate;
            for (strain, coupling) in strains.iter_mut().zip(row) {
                *strain -= rate * coupling;
            }
        }
        // The equilibrium spring is stretched by the whole displacement.
        for (strain, rate) in strains.iter_mut().zip(&path.rates) {
            if *rate == 0.0 {
                *strain = height;
            }
        }
        let loads = path.moduli.iter().zip(strains);
        loads.map(|(modulus, strain)| modulus * strain).collect()
    }
}

/// The time during a move at which a falling quantity vanishes; its beginning or end if it does not.
fn zero_in(edge_move: &EdgeMove, falling: impl Fn(SegmentTime) -> f64) -> SegmentTime {
    let at = |part| SegmentTime {
        part,
        ..edge_move.from
    };
    let ends = [edge_move.from.part, edge_move.to.part];
    let end = || {
        let is_past = falling(edge_move.from) <= 0.0;
        if is_past { ends[0] } else { ends[1] }
    };
    at(bracketed_root(|part| falling(at(part)), ends).unwrap_or_else(end))
}
