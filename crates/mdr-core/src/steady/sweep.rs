//! One pass along the line at a given depth: contact, load, release, recovery, contact again.
//!
//! Theory: docs/theory/line-viscoelastic.md, "One law" and "Friction as energy".
//!
//! All displacements are in units of the depth, all stresses in that of the foundation.

use numerics::bracketed_root;

use crate::MdrError;
use crate::branches::{Foundation, FreeSurface, SegmentSolution};
use crate::line::{Piece, Profile, Segment};

/// Relative tolerance of what no number of an answer depends on: the polynomials, in depths, in the first search for a depth and in
/// the check of kinks, and the deviation from its chord of the load between two positions of the returned list. Chosen; from 1e-5
/// to 0.1 no digit of an answer changes (case of `evidence tuning`).
pub(super) const COARSE_TOLERANCE: f64 = 1e-3;
/// Number of positions in a segment at which the signs of load and gap are checked. Chosen: a contact or gap between two of them
/// may be overlooked. The positions are Chebyshev points, so that twice as many find contacts half as long in the middle of a
/// segment.
const N_SEGMENT_SAMPLES: usize = 12;
/// Penetration, in depths, up to which a gap still counts as open: 16 units in the last place of the depth. Chosen: the
/// displacements of line and free surface are sums of some ten terms, each rounded by up to half a unit.
const GAP_ROUNDING: f64 = 16.0 * f64::EPSILON;
/// Displacement at the rear end of the line, in depths, below which what an elastic foundation releases there counts as rounding.
/// Derived: its energy, the square, is below 1e-12 of the whole.
const ELASTIC_END_DISPLACEMENT: f64 = 1e-6;
/// Smallest width of a boundary layer, and of a part of the list of loads, in units of t, that is sampled. Chosen: a change of
/// sign inside a thinner layer is only found at the next sample.
const MIN_LAYER_WIDTH: f64 = 1e-9;
/// Largest compression, in depths, that counts as rounding of positions where a contact begins; a larger one is a jump of the
/// displacement. Chosen; a compression below it is not applied, and its effect on load and work counts as error.
const MAX_MISSED_COMPRESSION: f64 = 1e-12;
/// Shortest part of a contact in a segment, in units of −1 ≤ t ≤ 1. A shorter part at the front of the segment is left out, and a
/// contact that would begin as close to the rear begins at the end. Chosen as 450 units in the last place: in so short a part the
/// dissipation of a dashpot would be the square of rounding divided by the length.
const MIN_CONTACT_PART: f64 = 1e-13;
/// Largest number of contact intervals of one line. Chosen, to limit the computing time: more are refused as
/// [`MdrError::TooMuchDetail`].
const MAX_CONTACTS: usize = 1 << 12;

/// Sums over one pass.
#[derive(Debug, Clone, Default)]
pub(super) struct SweepSums {
    /// Load ∫ w dx, a quarter of the normal force divided by depth and unit of stress, \[m].
    pub(super) load: f64,
    /// Work ∫ w h̃' dx, a quarter of the friction force divided by the square of the depth and the unit of stress, summed as
    /// dissipated energy.
    pub(super) work: f64,
    /// Error of `load` by the polynomials of the line, \[m].
    pub(super) load_error: f64,
    /// Error of `work` by the polynomials of the line.
    pub(super) work_error: f64,
    /// Contact intervals [rear, front], from front to rear, \[m].
    pub(super) contacts: Vec<[f64; 2]>,
    /// Position at which the work of the parallel dashpot diverges, \[m]; `None` if it converges.
    pub(super) too_steep: Option<f64>,
    /// Number of polynomials of the line.
    pub(super) n_pieces: usize,
    /// Positions \[m] from front to rear and w there, linear in between; `None` if not asked for.
    pub(super) loads: Option<Vec<[f64; 2]>>,
}

impl SweepSums {
    /// Rear and front of the whole contact, \[m].
    pub(super) fn ends(&self) -> [f64; 2] {
        let front = self.contacts.first().map_or(0.0, |[_, front]| *front);
        let rear = self.contacts.last().map_or(front, |[rear, _]| *rear);
        [rear, front]
    }
}

/// State of the surface at the present position.
enum Surface {
    /// Surface that is not in contact with the line and recovers.
    Free(FreeSurface),
    /// Surface in contact with the line.
    Loaded {
        /// Stress e_i of each branch at the present position, in depths times the unit of stress.
        stresses: Vec<f64>,
        /// True if contact has begun at the present position.
        is_new: bool,
    },
}

/// Passes the line over a free surface, and appends its loads to `loads` if that is given; returns also the surface behind.
pub(super) fn sweep(
    foundation: &Foundation,
    profile: &Profile,
    ahead: FreeSurface,
    loads: Option<Vec<[f64; 2]>>,
) -> Result<(SweepSums, FreeSurface), MdrError> {
    let mut march = SurfaceMarch {
        foundation,
        profile,
        sums: SweepSums {
            n_pieces: profile.pieces.len(),
            loads,
            ..SweepSums::default()
        },
        surface: Surface::Free(ahead),
    };
    // March over each piece from event to event.
    for piece in &profile.pieces {
        let whole = &piece.segment;
        let mut start = -1.0;
        while start < 1.0 {
            // Go on from the last event in this piece.
            let segment = whole.between(&profile.interpolation, [start, 1.0]);
            let reached = march.advance(&segment, piece)?;
            start = if reached >= 1.0 {
                1.0
            } else {
                start + 0.5 * (1.0 - start) * (1.0 + reached)
            };
        }
    }
    Ok(march.release_at_end())
}

/// A pass along the line, from event to event.
struct SurfaceMarch<'a> {
    /// Viscoelastic law of an element.
    foundation: &'a Foundation,
    /// The line as polynomials, from the front to the rear.
    profile: &'a Profile,
    /// Sums over the part of the line that has passed.
    sums: SweepSums,
    /// State of the surface at the present position.
    surface: Surface,
}

impl SurfaceMarch<'_> {
    /// Moves on to the next event, or the end of the segment; returns its position −1 ≤ t ≤ 1 in the segment.
    fn advance(&mut self, segment: &Segment, piece: &Piece) -> Result<f64, MdrError> {
        match std::mem::replace(&mut self.surface, Surface::Free(FreeSurface::untouched())) {
            Surface::Free(surface) => self.recover(surface, segment),
            Surface::Loaded { stresses, is_new } => {
                if piece.singular && self.foundation.has_dashpot() {
                    self.sums.too_steep.get_or_insert(piece.segment.ends[1]);
                }
                // Under load the whole segment is solved. If the load becomes tensile inside it, only the part up to there
                // counts.
                let solution = self.foundation.solve_segment(segment, &stresses);
                match first_tension(&solution, self.foundation.has_dashpot() && !is_new) {
                    None => {
                        self.add_solution(&solution, segment, piece.tail);
                        self.surface = Surface::Loaded {
                            stresses: solution.stresses,
                            is_new: false,
                        };
                        Ok(1.0)
                    }
                    Some(t) => {
                        self.release_at(&stresses, segment, t, piece.tail);
                        Ok(t)
                    }
                }
            }
        }
    }

    /// Recovers up to the next contact, or the end of the segment; returns its position −1 ≤ t ≤ 1 in the segment.
    fn recover(&mut self, mut surface: FreeSurface, segment: &Segment) -> Result<f64, MdrError> {
        let Some(contact) = self.next_contact(&surface, segment) else {
            surface.distance += segment.length;
            self.surface = Surface::Free(surface);
            return Ok(1.0);
        };
        if self.sums.contacts.len() == MAX_CONTACTS {
            return Err(MdrError::TooMuchDetail {
                parts: "contact intervals",
                allowed: MAX_CONTACTS,
                position: segment.position(contact),
            });
        }

        // The energy that is still stored is recovered, and the branches keep their present stresses.
        let t = if 1.0 - contact > MIN_CONTACT_PART {
            contact
        } else {
            1.0
        };
        let distance = 0.5 * (1.0 + t) * segment.length;
        let free = self.foundation.free_displacement(&surface, distance);
        let mut stresses = self.foundation.free_stresses(&surface, distance);
        let position = segment.position(t);
        let displacement = self.storing_displacement(free);
        self.sums.work -= self.foundation.stored_energy(displacement, &stresses);

        // A contact that begins late through rounding of positions begins with a jump of the displacement.
        let compression = segment.displacement(t) - free;
        if compression > MAX_MISSED_COMPRESSION {
            self.foundation
                .apply_strain_jump(&mut stresses, compression);
        }
        self.add_late_contact(compression, segment, t);
        self.sums.contacts.push([position; 2]);
        self.append_zero_load(position);
        self.surface = Surface::Loaded {
            stresses,
            is_new: true,
        };
        Ok(t)
    }

    /// Position t at which the line comes into contact with a free surface; `None` if it does not in this segment.
    fn next_contact(&self, surface: &FreeSurface, segment: &Segment) -> Option<f64> {
        let gap = |t: f64| {
            let distance = 0.5 * (1.0 + t) * segment.length;
            self.foundation.free_displacement(surface, distance) - segment.displacement(t)
        };
        let mut before = -1.0;
        for t in samples() {
            if gap(t) < -GAP_ROUNDING {
                // At the very start rounding may close the gap; but no element separates and comes into contact at one place.
                let nearest = if surface.distance <= 0.0 { t } else { before };
                return Some(bracketed_root(gap, [before, t]).unwrap_or(nearest));
            }
            before = t;
        }
        None
    }

    /// The displacement that stores energy at contact or release, in depths; 0 if the foundation is elastic, where it is rounding.
    fn storing_displacement(&self, displacement: f64) -> f64 {
        let is_elastic = self.foundation.is_elastic();
        if is_elastic { 0.0 } else { displacement }
    }

    /// Adds the error of a contact that begins at t, late by a compression in depths, because positions are rounded.
    fn add_late_contact(&mut self, compression: f64, segment: &Segment, t: f64) {
        let rate = segment.rate(t);
        let sensitivity = if compression > MAX_MISSED_COMPRESSION {
            self.foundation.dashpot_sensitivity(rate)
        } else {
            self.foundation.sensitivity(rate, self.profile.length)
        };
        self.sums.load_error += compression.abs() * sensitivity.load;
        self.sums.work_error += compression.abs() * sensitivity.work;
    }

    /// Releases the surface at t in the segment; `start` are the stresses at the beginning of the segment, `tail` is the error of
    /// its polynomial in depths.
    fn release_at(&mut self, start: &[f64], segment: &Segment, t: f64, tail: f64) {
        let mut stresses = start.to_vec();
        if 1.0 + t > MIN_CONTACT_PART {
            let loaded = segment.between(&self.profile.interpolation, [-1.0, t]);
            let solution = self.foundation.solve_segment(&loaded, &stresses);
            self.add_solution(&solution, &loaded, tail);
            stresses = solution.stresses;
        }
        let displacement = self.storing_displacement(segment.displacement(t));
        self.end_contact(displacement, &stresses, segment.position(t));
        self.surface = Surface::Free(self.foundation.release(displacement, &stresses));
    }

    /// Adds the solution under a segment to the sums; `tail` is the error of the polynomial of the segment, in depths.
    fn add_solution(&mut self, solution: &SegmentSolution, segment: &Segment, tail: f64) {
        self.sums.load += solution.load;
        self.sums.work += solution.dissipation;
        self.sums.load_error += tail * self.foundation.stiffness(segment.length);
        self.sums.work_error += tail * solution.dissipation_change + solution.dissipation_rounding;
        if let Some(loads) = &mut self.sums.loads {
            let points = straight_parts(|t| solution.potential(t));
            loads.extend(points.map(|[t, load]| [segment.position(t), load]));
        }
        if let Some(contact) = self.sums.contacts.last_mut() {
            contact[0] = segment.ends[1];
        }
    }

    /// Ends a contact interval at a position \[m], and adds the energy that is stored at this displacement, in depths, to the work.
    fn end_contact(&mut self, displacement: f64, stresses: &[f64], position: f64) {
        self.sums.work += self.foundation.stored_energy(displacement, stresses);
        self.append_zero_load(position);
        if let Some(contact) = self.sums.contacts.last_mut() {
            contact[0] = position;
        }
    }

    /// Adds a zero to the list of loads, at an end of a contact \[m].
    fn append_zero_load(&mut self, position: f64) {
        self.sums
            .loads
            .iter_mut()
            .for_each(|loads| loads.push([position, 0.0]));
    }

    /// Ends the pass at the rear end of the line, where a surface that is still loaded is released; returns the sums and the
    /// surface behind.
    fn release_at_end(mut self) -> (SweepSums, FreeSurface) {
        let surface = std::mem::replace(&mut self.surface, Surface::Free(FreeSurface::untouched()));
        let behind = match (surface, self.profile.pieces.last()) {
            (Surface::Loaded { stresses, .. }, Some(piece)) => {
                let mut end = piece.segment.end();
                if end.abs() < ELASTIC_END_DISPLACEMENT {
                    end = self.storing_displacement(end);
                }
                self.end_contact(end, &stresses, piece.segment.ends[1]);
                self.foundation.release(end, &stresses)
            }
            (Surface::Free(surface), _) => surface,
            (Surface::Loaded { .. }, None) => FreeSurface::untouched(),
        };
        (self.sums, behind)
    }
}

/// Positions t of samples from the front to the rear end, denser at both.
fn samples() -> impl Iterator<Item = f64> {
    let angle = std::f64::consts::PI / N_SEGMENT_SAMPLES as f64;
    (1..=N_SEGMENT_SAMPLES).map(move |k| -(angle * k as f64).cos())
}

/// Positions in [−1, 1] with the values of a function, between which it is linear to [`COARSE_TOLERANCE`].
fn straight_parts(value: impl Fn(f64) -> f64) -> impl Iterator<Item = [f64; 2]> {
    let at = |t: f64| [t, value(t)];
    let mut points = vec![at(-1.0)];
    // The list is reversed, so that the next position is its last entry.
    let mut ahead: Vec<[f64; 2]> = samples().map(at).collect();
    ahead.reverse();
    while let (Some(&from), Some(&to)) = (points.last(), ahead.last()) {
        let middle = at(0.5 * (from[0] + to[0]));
        let mean = 0.5 * (from[1] + to[1]);
        let scale = middle[1].abs().max(mean.abs());
        if to[0] - from[0] > MIN_LAYER_WIDTH && (middle[1] - mean).abs() > COARSE_TOLERANCE * scale
        {
            ahead.push(middle);
        } else {
            points.push(to);
            ahead.pop();
        }
    }
    points.into_iter()
}

/// Position t from which on the load would be tensile; `None` if it stays compressive. `may_jump` is true if a parallel dashpot can
/// make the load jump at the beginning of the segment.
fn first_tension(solution: &SegmentSolution, may_jump: bool) -> Option<f64> {
    // With a parallel dashpot the load jumps where the slope does.
    if may_jump && solution.potential(-1.0) < 0.0 {
        return Some(-1.0);
    }
    // Bracket the first change of sign, on samples inside the boundary layers first.
    let mut before = -1.0;
    for t in layer_samples(solution).into_iter().chain(samples()) {
        if solution.potential(t) < 0.0 {
            let inside = |t: f64| solution.potential(t);
            return Some(bracketed_root(inside, [before, t]).unwrap_or(before));
        }
        before = t;
    }
    None
}

/// Samples t inside the boundary layers that are thinner than the distance of the other samples.
fn layer_samples(solution: &SegmentSolution) -> Vec<f64> {
    let first = samples().next().unwrap_or(1.0);
    let widths = solution
        .layers
        .iter()
        .rev()
        .map(|layer| layer.ratio.recip());
    let mut samples: Vec<f64> = widths
        .filter(|width| *width > MIN_LAYER_WIDTH && width - 1.0 < first)
        .map(|width| width - 1.0)
        .collect();
    samples.sort_by(f64::total_cmp);
    samples
}
