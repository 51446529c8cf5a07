//! Where the contact ends while it shrinks: at the element that carries nothing.

use numerics::bracketed_root;

use super::{Contact, SIGN_TOLERANCE};
use crate::MdrError;
use crate::history::element::{EdgeDirection, EdgeMove, ElementState};
use crate::history::path::SegmentTime;

/// The edge of a contact that shrinks.
pub(super) struct Edge {
    /// Rings that are left.
    pub(super) n_rings: usize,
    pub(super) radius: f64,
    /// σ_k there.
    pub(super) stresses: Vec<f64>,
    /// In a ring over new elements: when the one at the edge was touched.
    pub(super) since: Option<SegmentTime>,
}

impl Contact<'_> {
    /// Refuses a tension half way between the beginning of a ring of elements touched again and the edge in it.
    pub(super) fn check_compressive(&self, at: SegmentTime) -> Result<(), MdrError> {
        let last = self.rings.last();
        let pulls = |ring: &EdgeMove| {
            let stresses = self.stresses_in(ring, 0.5 * (ring.inner + ring.outer), at);
            self.path.load(&stresses, at) < -SIGN_TOLERANCE * self.path.scale(at)
        };
        if last.is_some_and(|ring| ring.direction == EdgeDirection::Recontact && pulls(ring)) {
            let time = self.path.time(at);
            return Err(MdrError::NotADisc { time });
        }
        Ok(())
    }

    /// The edge as it is, later.
    pub(super) fn outermost(&self, at: SegmentTime) -> Option<Edge> {
        let ring = self.rings.last()?;
        let is_first = ring.direction == EdgeDirection::FirstContact;
        Some(Edge {
            n_rings: self.rings.len(),
            radius: ring.outer,
            stresses: if is_first {
                self.path.lag(ring.to, at).stresses
            } else {
                self.stresses_in(ring, ring.outer, at)
            },
            since: is_first.then_some(ring.to),
        })
    }

    /// The edge of a contact that can only shrink; none where nothing is loaded.
    pub(super) fn edge_inwards(&self, at: SegmentTime) -> Option<Edge> {
        let mut rings = self.rings.iter().enumerate().rev();
        rings.find_map(|(below, ring)| {
            let mut edge = match ring.direction {
                EdgeDirection::FirstContact => self.edge_in_first_contact(ring, at)?,
                _ => self.edge_in_recontact(ring, at)?,
            };
            edge.n_rings = below + 1;
            Some(edge)
        })
    }

    /// The edge in a ring over new elements: the load falls outwards.
    fn edge_in_first_contact(&self, ring: &EdgeMove, at: SegmentTime) -> Option<Edge> {
        let path = &self.path;
        let since = |part: f64| SegmentTime { part, ..ring.from };
        let load = |part: f64| path.load(&path.lag(since(part), at).stresses, at);
        let ends = [ring.from.part, ring.to.part];
        if load(ends[0]) < 0.0 {
            return None;
        }
        let since = since(bracketed_root(load, ends).unwrap_or(ends[1]));
        Some(Edge {
            n_rings: 0,
            radius: self.radii.at([ring.from, since].map(|at| path.depth(at)))[0],
            stresses: path.lag(since, at).stresses,
            since: Some(since),
        })
    }

    /// The edge in a ring of elements that were touched again.
    fn edge_in_recontact(&self, ring: &EdgeMove, at: SegmentTime) -> Option<Edge> {
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
            since: None,
        })
    }

    /// σ_k of an element in a ring of elements that were touched again.
    pub(super) fn stresses_in(&self, ring: &EdgeMove, radius: f64, at: SegmentTime) -> Vec<f64> {
        let radius = radius.max(ring.inner.next_up());
        match self
            .elements()
            .follow(radius, &self.edge_moves[..=ring.n_earlier])
        {
            ElementState::Loaded(touched) => self.elements().stresses(&touched, at),
            // Rounding puts an element of no extent beside the ring.
            _ => self.path.lag(ring.to, at).stresses,
        }
    }
}
