//! The contact circle along a path, and the force in it.
//!
//! ```text
//! F = 8/(2 (1 − ν)) [η₀ ḋ a + Σ Φ_k]      Φ_k = ∫₀^a σ_k dx
//! Φ_k(t) = e^(−(t − s)/τ_k) Φ_k(s) + G_k ∫ e^(−(t − s')/τ_k) ḋ a ds'      while the contact grows over new elements
//! ```
//! The contact is a stack of rings in the order in which they were touched, each with the Φ_k of everything inside it at
//! the moment it began. All elements inside stay in contact from then on, so that the sums follow from these at any later
//! time; a contact that shrinks takes rings from the top (Ting 1966, J. Appl. Mech. 33, 845). Elements that are touched
//! again are followed one by one, each from event to event in closed form, and summed over a ring by quadrature.

mod edge;
mod sums;

use indenters::EquivalentProfile;
use numerics::{LobattoRule, bracketed_root, lobatto_rule};

use super::ContactSums;
use super::element::{EdgeDirection, EdgeMove, ElementState, LineElements};
use super::path::{EXTENT_ROUNDING, LOAD_ROUNDING, Path, SegmentTime, change_of_edge};
use super::radius::Radii;
use crate::MdrError;
use edge::Edge;

/// A body that follows a path, from one point to the next.
#[derive(Clone)]
pub(super) struct Contact<'a> {
    pub(super) body: &'a dyn EquivalentProfile,
    pub(super) path: Path,
    pub(super) radii: Radii,
    /// Rings in contact, from the centre outwards.
    pub(super) rings: Vec<EdgeMove>,
    /// Φ_k inside each ring when it began, ring by ring.
    pub(super) inside: Vec<f64>,
    /// All that happened.
    pub(super) edge_moves: Vec<EdgeMove>,
    /// Φ_k of the whole contact now, and σ_k at its edge.
    pub(super) sums: Vec<f64>,
    edge: Vec<f64>,
    /// Largest radius and depth that were ever in contact.
    widest: [f64; 2],
    pub(super) rule: LobattoRule,
    /// Change by dividing a panel of the quadrature, relative to the sums, below which it is not divided.
    pub(super) tolerance: f64,
    /// Error of Σ Φ_k by quadrature.
    pub(super) quadrature_error: f64,
    /// Modulus G(t − s) of the element at the edge; none while it is being touched.
    pub(super) edge_modulus: Option<f64>,
    /// What comes after the edge has turned within a segment.
    direction_after_turn: Option<EdgeDirection>,
}

/// Relative tolerance of the quadrature over rings along a path of the depth, where everything else is exact.
const EXACT_QUADRATURE_TOLERANCE: f64 = 1e-14;
/// Gauss–Lobatto nodes of a panel of the quadrature over a ring.
const N_PANEL_NODES: usize = 8;
/// Gaps and loads of the wrong sign that count as rounding: gaps relative to the largest depth, loads to the terms of
/// a load. Chosen.
pub(super) const SIGN_TOLERANCE: f64 = 1e-10;
/// Part of the largest depth by which a body without force is lifted off the surface. Chosen.
const LIFT_OFF_DEPTH: f64 = 1e-12;

impl<'a> Contact<'a> {
    /// A body at the first point of a path, which will not be deeper than its radii are known.
    pub(super) fn new(body: &'a dyn EquivalentProfile, path: Path, radii: Radii) -> Self {
        let nothing = vec![0.0; path.n_branches()];
        Self {
            body,
            path,
            radii,
            rings: Vec::new(),
            inside: Vec::new(),
            edge_moves: Vec::new(),
            sums: nothing.clone(),
            edge: nothing,
            widest: [0.0; 2],
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

    /// η₀ ḋ a + Σ Φ_k, and the size of its terms.
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

    pub(super) fn measured(&self) -> ContactSums {
        let [load, terms] = self.load();
        let at_edge = self.rings.last().zip(self.edge_modulus);
        let edge = at_edge.map(|(ring, modulus)| {
            let depths = [ring.from, ring.to].map(|at| self.path.depth(at).max(0.0));
            let slope = self.radii.at(depths)[1];
            change_of_edge(slope, modulus, self.path.scale(self.path.end()))
        });
        ContactSums {
            point: self.path.last(),
            load,
            terms,
            load_error: self.quadrature_error + self.path.glass_modulus() * self.radii.area_error,
            radius: self.radius(),
            edge: edge.unwrap_or(0.0),
        }
    }

    pub(super) fn elements(&self) -> LineElements<'_> {
        LineElements {
            body: self.body,
            path: &self.path,
        }
    }

    /// Follows the body to a point, at a later time or at once.
    pub(super) fn follow(&mut self, time: f64, depth: f64) -> Result<(), MdrError> {
        self.path.push(time, depth);
        let mut at = self.path.end();
        at.part = 0.0;
        while at.part < 1.0 {
            at = self.advance_edge(at)?;
        }
        Ok(())
    }

    /// The body is not pressed and rises with the centre of the surface, which recovers freely.
    pub(super) fn rise(&mut self, time: f64) -> Result<(), MdrError> {
        let [now, depth] = self.path.last();
        if !self.rings.is_empty() {
            self.follow(now, depth - LIFT_OFF_DEPTH * self.widest[1])?;
        }
        self.path.push(time, depth);
        let centre = depth + self.gap(f64::MIN_POSITIVE, self.path.end());
        self.path.set_last_depth(centre);
        Ok(())
    }

    /// One leg; returns its end.
    fn advance_edge(&mut self, at: SegmentTime) -> Result<SegmentTime, MdrError> {
        let end = SegmentTime { part: 1.0, ..at };
        if self.rings.is_empty() {
            if let ElementState::Free(centre) =
                self.elements().follow(f64::MIN_POSITIVE, &self.edge_moves)
            {
                // A contact that begins and ends within one segment is not seen.
                if self.elements().gap(&centre, end) > 0.0 {
                    return Ok(end);
                }
                return self.grow_over_free([at, end], true);
            }
            if self.path.depth(end) <= 0.0 || self.path.rise(at.segment) <= 0.0 {
                return Ok(end);
            }
            let touch = self.path.time_of_depth(at.segment, 0.0);
            return Ok(self.grow(if touch.part > at.part { touch } else { at }, end));
        }
        let direction_after_turn = self.direction_after_turn.take();
        let tendency = match direction_after_turn {
            Some(EdgeDirection::Separation) => -1.0,
            Some(_) => 1.0,
            None => self.path.tendency(&self.edge, at),
        };
        // At a flat end all elements were touched at once, and rounding leaves none of them.
        if tendency > 0.0 && self.radius() < (1.0 - EXTENT_ROUNDING) * self.widest[0] {
            return self.grow_over_free([at, end], direction_after_turn.is_some());
        }
        if tendency > 0.0 && self.path.depth(end) > self.widest[1] {
            return Ok(self.grow(at, end));
        }
        let stays = |edge: Edge| {
            self.path.load(&edge.stresses, end) >= -LOAD_ROUNDING * self.path.scale(end)
        };
        if tendency >= 0.0 && self.outermost(end).is_some_and(stays) {
            self.hold(end);
            return Ok(end);
        }
        self.shrink([at, end], direction_after_turn.is_some())
    }

    /// Over elements that were never touched.
    fn grow(&mut self, at: SegmentTime, end: SegmentTime) -> SegmentTime {
        let deepest = self.widest[1];
        let path = &self.path;
        let time_of_depth = path.time_of_depth(at.segment, deepest);
        if path.depth(at) < deepest && time_of_depth.part > at.part {
            self.hold(time_of_depth);
            return time_of_depth;
        }
        let mut depths = [path.depth(at).max(deepest), path.depth(end)];
        let mut to = end;
        let limit = self.radii.end_of_piece(depths[0]);
        if limit < depths[1] {
            depths[1] = limit;
            to = path.time_of_depth(at.segment, limit);
        }
        let [outer, _] = self.radii.at(depths);
        self.widest = [outer, depths[1]];
        self.edge.fill(0.0);
        self.add(EdgeDirection::FirstContact, [at, to], outer);
        to
    }

    /// Over elements that recover, up to the last one that was ever touched.
    fn grow_over_free(
        &mut self,
        [at, end]: [SegmentTime; 2],
        has_turned: bool,
    ) -> Result<SegmentTime, MdrError> {
        let [widest, deepest] = self.widest;
        let instant = |part: f64| SegmentTime { part, ..at };
        let mut to = end;
        let time_of_depth = self.path.rise(at.segment) > 0.0 && self.path.depth(end) > deepest;
        if time_of_depth {
            to = self.path.time_of_depth(at.segment, deepest);
        } else {
            let tendency = |part: f64| {
                let at = instant(part);
                self.path
                    .tendency(&self.stresses_on_contact(self.edge_outwards(at), at), at)
            };
            if tendency(1.0) < 0.0
                && let Some(turn) = turn(tendency, at, has_turned)
            {
                to = turn;
                self.direction_after_turn = Some(EdgeDirection::Separation);
            }
        }
        // Where it passes, whatever rounding makes of a gap there.
        let outer = if time_of_depth {
            widest
        } else {
            self.edge_outwards(to)
        };
        if outer <= self.radius() {
            self.hold(to);
            return Ok(to);
        }
        self.check_contact_order([outer, widest], to)?;
        self.edge = self.stresses_on_contact(outer, to);
        self.add(EdgeDirection::Recontact, [at, to], outer);
        Ok(to)
    }

    /// Height of the body over an element that is not in contact.
    pub(super) fn gap(&self, radius: f64, at: SegmentTime) -> f64 {
        let radius = radius.max(self.radius().next_up());
        match self.elements().follow(radius, &self.edge_moves) {
            ElementState::Free(free) => self.elements().gap(&free, at),
            _ => self.body.height_at(radius) - self.path.depth(at),
        }
    }

    /// σ_k of an element that is touched at that moment.
    fn stresses_on_contact(&self, radius: f64, at: SegmentTime) -> Vec<f64> {
        let radius = radius.max(self.radius().next_up());
        match self.elements().follow(radius, &self.edge_moves) {
            ElementState::Free(free) => self.elements().free_stresses(&free, at),
            _ => vec![0.0; self.path.n_branches()],
        }
    }

    /// The radius up to which free elements are touched.
    fn edge_outwards(&self, at: SegmentTime) -> f64 {
        let (inner, widest) = (self.radius(), self.widest[0]);
        match bracketed_root(|radius| self.gap(radius, at), [inner, widest]) {
            Some(edge) => edge,
            None if self.gap(inner, at) <= 0.0 => widest,
            None => inner,
        }
    }

    /// Refuses a body that touches free elements in another order than from inside outwards.
    fn check_contact_order(
        &self,
        [edge, widest]: [f64; 2],
        at: SegmentTime,
    ) -> Result<(), MdrError> {
        let inner = self.radius();
        let allowed = SIGN_TOLERANCE * self.widest[1];
        for node in &self.rule.nodes[1..N_PANEL_NODES - 1] {
            let between = |[from, to]: [f64; 2]| from + 0.5 * (to - from) * (1.0 + node);
            let touched = self.gap(between([inner, edge]), at) <= allowed;
            let none = edge >= (1.0 - EXTENT_ROUNDING) * widest;
            let free = none || self.gap(between([edge, widest]), at) >= -allowed;
            if !(touched && free) {
                let time = self.path.time(at);
                return Err(MdrError::NotADisc { time });
            }
        }
        Ok(())
    }

    /// The contact stays as it is up to an instant.
    fn hold(&mut self, to: SegmentTime) {
        if let Some(edge) = self.outermost(to) {
            self.edge = edge.stresses;
        }
        self.sums = self.sums_at(to);
    }

    /// A ring around the contact, which ends with the σ_k at the edge.
    fn add(&mut self, motion: EdgeDirection, span: [SegmentTime; 2], outer: f64) {
        let edge_move = self.record(motion, span, [self.radius(), outer]);
        self.rings.push(edge_move);
        self.inside.extend_from_slice(&self.sums);
        self.sums = self.sums_at(edge_move.to);
    }

    fn record(
        &mut self,
        motion: EdgeDirection,
        [from, to]: [SegmentTime; 2],
        [inner, outer]: [f64; 2],
    ) -> EdgeMove {
        let edge_move = EdgeMove {
            motion,
            from,
            to,
            inner,
            outer,
            before: self.edge_moves.len(),
        };
        self.edge_moves.push(edge_move);
        edge_move
    }

    fn shrink(
        &mut self,
        [at, end]: [SegmentTime; 2],
        has_turned: bool,
    ) -> Result<SegmentTime, MdrError> {
        let instant = |part: f64| SegmentTime { part, ..at };
        let tendency = |edge: &Option<Edge>, part: f64| match edge {
            Some(edge) => self.path.tendency(&edge.stresses, instant(part)),
            None => -1.0,
        };
        let mut to = end;
        let mut edge = self.edge_inwards(to);
        let later = |part: f64| tendency(&self.edge_inwards(instant(part)), part);
        if self.path.step(at.segment) > 0.0
            && tendency(&edge, 1.0) > 0.0
            && let Some(turn) = turn(later, at, has_turned)
        {
            to = turn;
            self.direction_after_turn = Some(EdgeDirection::Recontact);
            edge = self.edge_inwards(to);
        }
        let [inner, outer] = [edge.as_ref().map_or(0.0, |edge| edge.radius), self.radius()];
        if inner < outer {
            self.record(EdgeDirection::Separation, [at, to], [inner, outer]);
        }
        let Some(edge) = edge else {
            self.rings.clear();
            self.inside.clear();
            self.sums.fill(0.0);
            return Ok(to);
        };
        self.rings.truncate(edge.n_rings);
        self.inside.truncate(edge.n_rings * self.path.n_branches());
        let ring = &mut self.rings[edge.n_rings - 1];
        ring.to = edge.since.unwrap_or(ring.to);
        ring.outer = edge.radius;
        self.edge = edge.stresses;
        self.sums = self.sums_at(to);
        self.check_compressive(to)?;
        Ok(to)
    }
}

/// The instant after another one in its segment at which the edge turns; right after a turn none, lest the edge stands still.
fn turn(tendency: impl Fn(f64) -> f64, at: SegmentTime, has_turned: bool) -> Option<SegmentTime> {
    let part = bracketed_root(tendency, [at.part, 1.0])?;
    (part > at.part || !has_turned).then_some(SegmentTime { part, ..at })
}
