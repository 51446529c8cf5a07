//! The contact circle along a path, and the force in it.
//!
//! ```text
//! F = 8/(2 (1 − ν)) [η₀ ḋ a + Σ Φ_k]      Φ_k = ∫₀^a σ_k dx
//! Φ_k(t) = e^(−(t − s)/τ_k) Φ_k(s) + G_k ∫ e^(−(t − s')/τ_k) ḋ a ds'      while the contact grows over new elements
//! ```
//! d is the depth, a the contact radius, and ν the Poisson ratio. σ_k is the branch load (`element.rs`) of branch k with the modulus G_k and
//! the relaxation time τ_k in one element, and η₀ the viscosity of the parallel dashpot.
//!
//! The contact is a stack of rings in the order in which their elements came into contact. Each ring has the Φ_k of
//! everything inside it at the moment it began. All elements inside stay in contact from then on, so that the Φ_k follow
//! from these values at any later time. A contact that shrinks removes rings from the top (Ting 1966, J. Appl. Mech. 33,
//! 845).
//!
//! Elements that come into contact again are followed one by one, from event to event in closed form, and summed over a
//! ring by quadrature.
//!
//! Within one segment of the path the edge moves in intervals of one direction each. [`Contact::follow`] computes one
//! interval of time after the other: growth over new elements, growth over free elements, rest, or shrinkage.

mod edge;
mod sums;

use indenters::EquivalentProfile;
use numerics::{LobattoRule, bracketed_root, lobatto_rule};

use super::element::{EdgeDirection, EdgeMove, ElementState, LineElements};
use super::path::{EXTENT_ROUNDING, Path, SegmentTime, change_of_edge};
use super::radius::Radii;
use super::{ContactSums, SUM_ROUNDING};
use crate::MdrError;
use edge::Edge;

/// A body that follows a path, from one point to the next.
#[derive(Clone)]
pub(super) struct Contact<'a> {
    /// Equivalent line of the body.
    pub(super) body: &'a dyn EquivalentProfile,
    /// Depth over time, and the response of the material to it.
    pub(super) path: Path,
    /// Contact radius as a function of the depth, while the contact grows over new elements.
    pub(super) radii: Radii,
    /// Rings in contact, from the centre outwards.
    pub(super) rings: Vec<EdgeMove>,
    /// Integrals Φ_k over the contact inside each ring when it began, ring by ring, \[N].
    pub(super) inner_sums: Vec<f64>,
    /// All moves of the edge so far.
    pub(super) edge_moves: Vec<EdgeMove>,
    /// Integrals Φ_k over the present contact, \[N].
    pub(super) sums: Vec<f64>,
    /// Branch loads σ_k of the element at the edge, \[N/m].
    edge_branch_loads: Vec<f64>,
    /// Largest depth and radius so far.
    largest: LargestContact,
    /// Quadrature rule of a panel of a ring.
    pub(super) rule: LobattoRule,
    /// Change of a panel of the quadrature by its division, relative to the sums, below which it is not divided.
    pub(super) tolerance: f64,
    /// Error of Σ Φ_k by quadrature, \[N].
    pub(super) quadrature_error: f64,
    /// Modulus G(t − s) of the element at the edge, \[Pa]; `None` while it comes into contact.
    pub(super) edge_modulus: Option<f64>,
    /// Direction of the edge after it has turned within a segment; `None` if it has not just turned.
    direction_after_turn: Option<EdgeDirection>,
}

/// Largest depth and radius so far.
#[derive(Debug, Clone, Copy, Default)]
struct LargestContact {
    /// Contact radius, \[m].
    radius: f64,
    /// Indentation depth, \[m].
    depth: f64,
}

/// Relative tolerance of the quadrature over rings along a path of the depth, where everything else is exact: 45 units in the
/// last place. Chosen: a smaller one would halve panels whose sums differ by rounding only.
const EXACT_QUADRATURE_TOLERANCE: f64 = 1e-14;
/// Number of Gauss–Lobatto nodes of a panel of the quadrature over a ring. Chosen: a panel is exact up to degree 13 and is halved
/// where that is not enough, so that the number decides the time and not the error.
const N_PANEL_NODES: usize = 8;
/// Relative size up to which a gap or a load of the wrong sign counts as rounding. Gaps are compared with the largest depth,
/// loads with the terms that they are the sum of.
///
/// Chosen as a thousand times the rounding 1e-13 of depths that are roots of an equation. With a smaller one, rounding would end
/// histories with [`MdrError::NotADisc`]; with a larger one, a contact that is a ring by so little would count as a disc.
pub(super) const SIGN_TOLERANCE: f64 = 1e-10;
/// Height by which a body without force is lifted off the surface, as a fraction of the largest depth. Chosen as ten times the
/// rounding 1e-13 of depths that are roots of an equation, so that no element stays in contact by rounding.
const LIFT_OFF_DEPTH: f64 = 1e-12;

impl<'a> Contact<'a> {
    /// The contact at the first point of a path, before the body moves; `radii` must reach to the largest depth of the path.
    pub(super) fn new(body: &'a dyn EquivalentProfile, path: Path, radii: Radii) -> Self {
        let zeros = vec![0.0; path.n_branches()];
        Self {
            body,
            path,
            radii,
            rings: Vec::new(),
            inner_sums: Vec::new(),
            edge_moves: Vec::new(),
            sums: zeros.clone(),
            edge_branch_loads: zeros,
            largest: LargestContact::default(),
            rule: lobatto_rule(N_PANEL_NODES),
            tolerance: EXACT_QUADRATURE_TOLERANCE,
            quadrature_error: 0.0,
            edge_modulus: None,
            direction_after_turn: None,
        }
    }

    /// Contact radius, \[m].
    pub(super) fn radius(&self) -> f64 {
        self.rings.last().map_or(0.0, |ring| ring.outer)
    }

    /// The load η₀ ḋ a + Σ Φ_k and the sum of the sizes of its terms, in this order, \[N].
    pub(super) fn load(&self) -> [f64; 2] {
        let end = self.path.end();
        let viscous = match self.path.step(end.segment) {
            0.0 => 0.0,
            _ => self.path.viscosity * self.path.speed(end.segment) * self.radius(),
        };
        let sum = viscous + self.sums.iter().sum::<f64>();
        let inner = self.sums.iter().map(|sum| sum.abs()).sum::<f64>();
        let shared = self.radius() * self.path.scale(end);
        [sum, viscous.abs() + inner + shared]
    }

    /// Sums over the present contact.
    pub(super) fn contact_sums(&self) -> ContactSums {
        let [load, terms] = self.load();
        // Find by how much an error of the load moves the edge.
        let at_edge = self.rings.last().zip(self.edge_modulus);
        let edge_change = at_edge.map(|(ring, modulus)| {
            let depths = [ring.from, ring.to].map(|at| self.path.depth(at).max(0.0));
            let slope = self.radii.radius_and_slope(depths)[1];
            change_of_edge(slope, modulus, self.path.scale(self.path.end()))
        });
        // The error of the load comes from the quadrature over rings and from the polynomials of the radii.
        let [time, depth] = self.path.last();
        ContactSums {
            time,
            depth,
            load,
            terms,
            load_error: self.quadrature_error
                + self.path.instantaneous_modulus() * self.radii.area_error,
            radius: self.radius(),
            edge_change: edge_change.unwrap_or(0.0),
        }
    }

    /// The elements of the line under the path up to its last point, from which the state of each of them follows.
    pub(super) fn elements(&self) -> LineElements<'_> {
        LineElements {
            body: self.body,
            path: &self.path,
        }
    }

    /// Follows the body to the next point, a depth \[m] at a later time \[s] or by a jump at the same time.
    pub(super) fn follow(&mut self, time: f64, depth: f64) -> Result<(), MdrError> {
        self.path.push(time, depth);
        let end = self.path.end();
        let mut at = SegmentTime { part: 0.0, ..end };
        while at.part < 1.0 {
            at = if self.rings.is_empty() {
                self.begin_contact(at, end)?
            } else {
                // Just after a turn the direction of the edge is known, and rounding must not decide it again. Otherwise the
                // branch loads of the element at the edge give it.
                let turned = self.direction_after_turn.take();
                let direction = match turned {
                    Some(EdgeDirection::Separation) => -1.0,
                    Some(_) => 1.0,
                    None => self.path.edge_direction(&self.edge_branch_loads, at),
                };
                let stays = |edge: Edge| {
                    self.path.load(&edge.branch_loads, end) >= -SUM_ROUNDING * self.path.scale(end)
                };
                // At a flat end all elements come into contact together, and none is free but by rounding.
                let has_free = self.radius() < (1.0 - EXTENT_ROUNDING) * self.largest.radius;
                if direction > 0.0 && has_free {
                    self.grow_over_free(at, end, turned.is_some())?
                } else if direction > 0.0 && self.path.depth(end) > self.largest.depth {
                    self.grow_over_new(at, end)
                } else if direction >= 0.0 && self.outermost(end).is_some_and(stays) {
                    self.hold(end);
                    end
                } else {
                    self.shrink(at, end, turned.is_some())?
                }
            };
        }
        Ok(())
    }

    /// The first interval of time for a body that is not in contact; returns its end.
    fn begin_contact(
        &mut self,
        at: SegmentTime,
        end: SegmentTime,
    ) -> Result<SegmentTime, MdrError> {
        if let ElementState::Free(centre) =
            self.elements().follow(f64::MIN_POSITIVE, &self.edge_moves)
        {
            // A contact that begins and ends within one segment is overlooked.
            if self.elements().gap(&centre, end) > 0.0 {
                return Ok(end);
            }
            return self.grow_over_free(at, end, true);
        }
        if self.path.depth(end) <= 0.0 || self.path.rise(at.segment) <= 0.0 {
            return Ok(end);
        }
        let contact = self.path.time_of_depth(at.segment, 0.0);
        Ok(self.grow_over_new(if contact.part > at.part { contact } else { at }, end))
    }

    /// Follows a body without force to a time \[s]; it stays on the centre of the freely recovering surface.
    pub(super) fn rise_freely(&mut self, time: f64) -> Result<(), MdrError> {
        let [now, depth] = self.path.last();
        if !self.rings.is_empty() {
            self.follow(now, depth - LIFT_OFF_DEPTH * self.largest.depth)?;
        }
        self.path.push(time, depth);
        let centre = depth + self.gap(f64::MIN_POSITIVE, self.path.end());
        self.path.set_last_depth(centre);
        Ok(())
    }

    /// Grows over elements that were never in contact; returns the end of the interval of time.
    fn grow_over_new(&mut self, at: SegmentTime, end: SegmentTime) -> SegmentTime {
        let deepest = self.largest.depth;
        let path = &self.path;
        let at_deepest = path.time_of_depth(at.segment, deepest);
        if path.depth(at) < deepest && at_deepest.part > at.part {
            self.hold(at_deepest);
            return at_deepest;
        }

        // One polynomial holds for the radius up to the end of its piece.
        let mut depths = [path.depth(at).max(deepest), path.depth(end)];
        let mut to = end;
        let limit = self.radii.end_of_piece(depths[0]);
        if limit < depths[1] {
            depths[1] = limit;
            to = path.time_of_depth(at.segment, limit);
        }
        let [outer, _] = self.radii.radius_and_slope(depths);
        self.largest = LargestContact {
            radius: outer,
            depth: depths[1],
        };
        self.edge_branch_loads.fill(0.0);
        self.add_ring(EdgeDirection::FirstContact, at, to, outer);
        to
    }

    /// Grows over free elements, up to the largest radius so far; returns the end of the interval of time.
    ///
    /// `has_turned` is true if the edge has just turned at `at`, where its direction is only rounding.
    fn grow_over_free(
        &mut self,
        at: SegmentTime,
        end: SegmentTime,
        has_turned: bool,
    ) -> Result<SegmentTime, MdrError> {
        let LargestContact {
            radius: widest,
            depth: deepest,
        } = self.largest;

        // The interval ends where new elements follow, or where the edge turns.
        let mut to = end;
        let reaches_new = self.path.rise(at.segment) > 0.0 && self.path.depth(end) > deepest;
        if reaches_new {
            to = self.path.time_of_depth(at.segment, deepest);
        } else {
            let direction = |part: f64| {
                let at = SegmentTime { part, ..at };
                let branch_loads = self.branch_loads_on_contact(self.edge_outwards(at), at);
                self.path.edge_direction(&branch_loads, at)
            };
            if direction(1.0) < 0.0
                && let Some(turn) = turning_time(direction, at, has_turned)
            {
                to = turn;
                self.direction_after_turn = Some(EdgeDirection::Separation);
            }
        }

        // At the beginning of new elements the edge is known; the gap there would be rounding.
        let outer = if reaches_new {
            widest
        } else {
            self.edge_outwards(to)
        };
        if outer <= self.radius() {
            self.hold(to);
            return Ok(to);
        }
        self.check_contact_order(outer, to)?;
        self.edge_branch_loads = self.branch_loads_on_contact(outer, to);
        self.add_ring(EdgeDirection::Recontact, at, to, outer);
        Ok(to)
    }

    /// Height of the body over an element that is not in contact, \[m].
    pub(super) fn gap(&self, radius: f64, at: SegmentTime) -> f64 {
        let outside = radius.max(self.radius().next_up());
        match self.elements().follow(outside, &self.edge_moves) {
            ElementState::Free(free) => self.elements().gap(&free, at),
            _ => self.body.height_at(outside) - self.path.depth(at),
        }
    }

    /// Branch loads σ_k of an element that comes into contact at a time, \[N/m].
    fn branch_loads_on_contact(&self, radius: f64, at: SegmentTime) -> Vec<f64> {
        let outside = radius.max(self.radius().next_up());
        match self.elements().follow(outside, &self.edge_moves) {
            ElementState::Free(free) => self.elements().free_branch_loads(&free, at),
            _ => vec![0.0; self.path.n_branches()],
        }
    }

    /// Contact radius at a time if the edge has only moved outwards, over free elements, \[m]: the root of the gap between the
    /// present edge and the widest contact so far.
    fn edge_outwards(&self, at: SegmentTime) -> f64 {
        let (inner, widest) = (self.radius(), self.largest.radius);
        match bracketed_root(|radius| self.gap(radius, at), [inner, widest]) {
            Some(edge) => edge,
            None if self.gap(inner, at) <= 0.0 => widest,
            None => inner,
        }
    }

    /// Refuses free elements that come into contact in another order than from inside outwards: gaps inside the new `edge` \[m], or
    /// penetration outside.
    fn check_contact_order(&self, edge: f64, at: SegmentTime) -> Result<(), MdrError> {
        let (inner, widest) = (self.radius(), self.largest.radius);
        let allowed = SIGN_TOLERANCE * self.largest.depth;
        for node in &self.rule.nodes[1..N_PANEL_NODES - 1] {
            let between = |[from, to]: [f64; 2]| from + 0.5 * (to - from) * (1.0 + node);
            let inside_touches = self.gap(between([inner, edge]), at) <= allowed;
            let none_outside = edge >= (1.0 - EXTENT_ROUNDING) * widest;
            let outside_is_free = none_outside || self.gap(between([edge, widest]), at) >= -allowed;
            if !(inside_touches && outside_is_free) {
                let time = self.path.time(at);
                return Err(MdrError::NotADisc { time });
            }
        }
        Ok(())
    }

    /// Advances the branch loads at the edge and the integrals over the contact to a time up to which the edge does not move.
    fn hold(&mut self, to: SegmentTime) {
        if let Some(edge) = self.outermost(to) {
            self.edge_branch_loads = edge.branch_loads;
        }
        self.sums = self.sums_at(to);
    }

    /// Adds a ring around the contact, up to the radius `outer` \[m], over which the edge moves from one time to another.
    fn add_ring(
        &mut self,
        direction: EdgeDirection,
        from: SegmentTime,
        to: SegmentTime,
        outer: f64,
    ) {
        let ring = EdgeMove {
            direction,
            from,
            to,
            inner: self.radius(),
            outer,
            n_earlier: self.edge_moves.len(),
        };
        self.edge_moves.push(ring);
        self.rings.push(ring);
        self.inner_sums.extend_from_slice(&self.sums);
        self.sums = self.sums_at(to);
    }

    /// Shrinks the contact, or separates all of it; returns the end of the interval of time.
    ///
    /// `has_turned` is true if the edge has just turned at `at`, where its direction is only rounding.
    fn shrink(
        &mut self,
        at: SegmentTime,
        end: SegmentTime,
        has_turned: bool,
    ) -> Result<SegmentTime, MdrError> {
        // The interval ends where the edge turns, because an edge that moves outwards brings elements into contact.
        let instant = |part: f64| SegmentTime { part, ..at };
        let direction = |edge: &Option<Edge>, part: f64| match edge {
            Some(edge) => self.path.edge_direction(&edge.branch_loads, instant(part)),
            None => -1.0,
        };
        let mut to = end;
        let mut edge = self.edge_inwards(to);
        let later = |part: f64| direction(&self.edge_inwards(instant(part)), part);
        if self.path.step(at.segment) > 0.0
            && direction(&edge, 1.0) > 0.0
            && let Some(turn) = turning_time(later, at, has_turned)
        {
            to = turn;
            self.direction_after_turn = Some(EdgeDirection::Recontact);
            edge = self.edge_inwards(to);
        }

        // The elements between the new and the old edge separate; their move of the edge is recorded.
        let [inner, outer] = [edge.as_ref().map_or(0.0, |edge| edge.radius), self.radius()];
        if inner < outer {
            self.edge_moves.push(EdgeMove {
                direction: EdgeDirection::Separation,
                from: at,
                to,
                inner,
                outer,
                n_earlier: self.edge_moves.len(),
            });
        }

        // Remove the rings that separate, and cut the one in which the edge is now.
        let Some(edge) = edge else {
            self.rings.clear();
            self.inner_sums.clear();
            self.sums.fill(0.0);
            return Ok(to);
        };
        self.rings.truncate(edge.n_rings);
        self.inner_sums
            .truncate(edge.n_rings * self.path.n_branches());
        let ring = &mut self.rings[edge.n_rings - 1];
        ring.to = edge.since.unwrap_or(ring.to);
        ring.outer = edge.radius;
        self.edge_branch_loads = edge.branch_loads;
        self.sums = self.sums_at(to);
        self.check_compressive(to)?;
        Ok(to)
    }
}

/// The time after `at` in its segment at which the edge turns; `None` if it does not, or if it has just turned at `at`.
///
/// `direction` is that of the edge at a part of the segment, positive outwards.
fn turning_time(
    direction: impl Fn(f64) -> f64,
    at: SegmentTime,
    has_turned: bool,
) -> Option<SegmentTime> {
    let part = bracketed_root(direction, [at.part, 1.0])?;
    (part > at.part || !has_turned).then_some(SegmentTime { part, ..at })
}
