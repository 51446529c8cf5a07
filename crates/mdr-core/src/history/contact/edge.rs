//! The edge of a shrinking contact: the element that carries nothing.

use numerics::bracketed_root;

use super::{Contact, SIGN_TOLERANCE};
use crate::MdrError;
use crate::history::element::{EdgeDirection, EdgeMove, ElementState};
use crate::history::path::SegmentTime;

/// The element at the edge of a contact.
pub(super) struct Edge {
    /// Number of rings in contact, the last one in part.
    pub(super) n_rings: usize,
    /// Contact radius, \[m].
    pub(super) radius: f64,
    /// Branch loads σ_k at the edge, \[N/m].
    pub(super) branch_loads: Vec<f64>,
    /// Time at which the element at the edge came into contact, in a ring of new elements; `None` in other rings.
    pub(super) since: Option<SegmentTime>,
}

impl Contact<'_> {
    /// Refuses tension half way between the inner radius of the last ring and the edge, if its elements were in contact before.
    pub(super) fn check_compressive(&self, at: SegmentTime) -> Result<(), MdrError> {
        let last = self.rings.last();
        let is_tensile = |ring: &EdgeMove| {
            let branch_loads = self.loads_in(ring, 0.5 * (ring.inner + ring.outer), at);
            self.path.load(&branch_loads, at) < -SIGN_TOLERANCE * self.path.scale(at)
        };
        if last.is_some_and(|ring| ring.direction == EdgeDirection::Recontact && is_tensile(ring)) {
            let time = self.path.time(at);
            return Err(MdrError::NotADisc { time });
        }
        Ok(())
    }

    /// The edge at a later time if it has not moved; `None` without contact.
    pub(super) fn outermost(&self, at: SegmentTime) -> Option<Edge> {
        let ring = self.rings.last()?;
        let is_first = ring.direction == EdgeDirection::FirstContact;
        Some(Edge {
            n_rings: self.rings.len(),
            radius: ring.outer,
            branch_loads: if is_first {
                self.path.decayed_history(ring.to, at).gained_loads
            } else {
                self.loads_in(ring, ring.outer, at)
            },
            since: is_first.then_some(ring.to),
        })
    }

    /// The edge at a later time if it has only moved inwards; `None` if nothing is loaded any more.
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

    /// The edge in a ring of new elements, in which the load falls outwards; `None` if all of the ring has separated.
    fn edge_in_first_contact(&self, ring: &EdgeMove, at: SegmentTime) -> Option<Edge> {
        // The load falls from the elements that came into contact first to the last ones: its root is the edge.
        let path = &self.path;
        let since = |part: f64| SegmentTime { part, ..ring.from };
        let load = |part: f64| path.load(&path.decayed_history(since(part), at).gained_loads, at);
        let ends = [ring.from.part, ring.to.part];
        if load(ends[0]) < 0.0 {
            return None;
        }
        let since = since(bracketed_root(load, ends).unwrap_or(ends[1]));
        Some(Edge {
            n_rings: 0,
            radius: self
                .radii
                .radius_and_slope([ring.from, since].map(|at| path.depth(at)))[0],
            branch_loads: path.decayed_history(since, at).gained_loads,
            since: Some(since),
        })
    }

    /// The edge in a ring of elements that came into contact again; `None` if all of the ring has separated.
    fn edge_in_recontact(&self, ring: &EdgeMove, at: SegmentTime) -> Option<Edge> {
        let load = |radius| self.path.load(&self.loads_in(ring, radius, at), at);
        let radius = if load(ring.outer) >= 0.0 {
            ring.outer
        } else {
            bracketed_root(load, [ring.inner, ring.outer])?
        };
        Some(Edge {
            n_rings: 0,
            radius,
            branch_loads: self.loads_in(ring, radius, at),
            since: None,
        })
    }

    /// Branch loads σ_k of an element in a ring of elements that came into contact again, \[N/m].
    pub(super) fn loads_in(&self, ring: &EdgeMove, radius: f64, at: SegmentTime) -> Vec<f64> {
        let inside = radius.max(ring.inner.next_up());
        match self
            .elements()
            .follow(inside, &self.edge_moves[..=ring.n_earlier])
        {
            ElementState::Loaded(loaded) => self.elements().branch_loads(&loaded, at),
            // By rounding an element at the end of the ring may lie outside it.
            _ => self.path.decayed_history(ring.to, at).gained_loads,
        }
    }
}
