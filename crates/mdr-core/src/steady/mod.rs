//! Stationary sliding on any linear viscoelastic foundation, solved directly: no time, no mesh in the material.
//!
//! In the frame of the line time runs along it from the front to the rear: an element is touched in front, compressed by
//! u = d − h̃, let go where its load would turn to tension, and touched again where the line comes down on what has
//! not recovered.
//!
//! ```text
//! w = G_∞ u + η₀ du/dt + Σ e_i,   τ_i de_i/dt + e_i = τ_i G_i du/dt        in contact, d/dt = −v d/dx
//! F_N = 4 ∫ w dx,   F_h = 4 ∫ w h̃' dx
//! ```
//! The line is a row of polynomials, and between two events everything is integrated in closed form: boundary layers of
//! the width v τ_i need no mesh. F_h is summed as the energy that the dashpots take and that is lost at release; all
//! its terms are positive, so that it keeps its digits where friction vanishes.

mod branch;
mod depth;
mod foundation;
mod legendre;
mod profile;
mod range;
mod segment;
mod steep_kinks;
mod sweep;

use indenters::{RigidLine, SlidingLoad};
use rheology::Material;

use crate::MdrError;
use crate::error::{finite, fraction, positive};
use foundation::Foundation;
use profile::{Profile, Resolution};
use range::Range;
use steep_kinks::SteepKink;
use sweep::{Sweep, sweep};

/// Numerics of stationary sliding.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct SteadyOptions {
    /// Error of the friction coefficient relative to its value, above 0 and below 1.
    pub relative_error: f64,
}

impl Default for SteadyOptions {
    fn default() -> Self {
        Self {
            relative_error: 1e-8,
        }
    }
}

/// A line held at a depth while it slides.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct SlidingDepth {
    /// Indentation depth d > 0 of the lowest point, \[m].
    pub indentation_depth: f64,
    /// Sliding speed v > 0 towards positive x, \[m/s].
    pub velocity: f64,
}

/// Stationary sliding of a rigid line.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[must_use]
pub struct SteadySliding {
    /// Friction coefficient μ = F_h/F_N.
    pub friction_coefficient: f64,
    /// Estimated absolute error of the friction coefficient.
    pub friction_coefficient_error: f64,
    /// Indentation depth d of the lowest point, \[m].
    pub indentation_depth: f64,
    /// Normal force F_N, \[N].
    pub normal_force: f64,
    /// Estimated absolute error of the normal force that belongs to the depth, \[N].
    pub normal_force_error: f64,
    /// Contact intervals `[rear, front]` by increasing position on the line, \[m].
    pub contacts: Vec<[f64; 2]>,
    /// Number of polynomials that stand for the line.
    pub n_pieces: usize,
}

/// Slides a line over a foundation under constant force, in the stationary state.
///
/// The force comes out to the rounding of the depth; an elastic material has the friction coefficient 0.
///
/// # Errors
/// - [`MdrError::NoStationaryState`] when the line ends in front before it carries the force (Remark 4).
/// - [`MdrError::FrictionDiverges`] when a lone dashpot is under a line with p ≤ 1/2 or a kink that rises (16).
/// - [`MdrError::NotConverged`] when the estimated error stays above the one asked for.
/// - [`MdrError::NotRising`], [`MdrError::TooManyContacts`], [`MdrError::TooManyPieces`], [`MdrError::InvalidHeight`],
///   [`MdrError::InvalidParameter`], [`MdrError::NonFinite`].
pub fn steady(
    line: &(impl RigidLine + ?Sized),
    material: &(impl Material + ?Sized),
    load: &SlidingLoad,
    options: &SteadyOptions,
) -> Result<SteadySliding, MdrError> {
    let problem = Problem::new(line, material, load.velocity())?;
    problem.refine(options, |tolerance| problem.depth(load, tolerance))
}

/// Distance between the rear and the front of the contact of [`steady`], \[m], also where friction diverges.
pub(crate) fn contact_span(
    line: &(impl RigidLine + ?Sized),
    material: &(impl Material + ?Sized),
    load: &SlidingLoad,
) -> Result<f64, MdrError> {
    let tolerance = FIRST_TOLERANCE * SteadyOptions::default().relative_error;
    let problem = Problem::new(line, material, load.velocity())?;
    let depth = problem.depth(load, tolerance)?;
    let contacts = problem.solve(depth, tolerance)?.sums.contacts;
    let front = contacts.first().map_or(0.0, |[_, front]| *front);
    let rear = contacts.last().map_or(front, |[rear, _]| *rear);
    positive("contact length", front - rear)
}

/// Slides a line over a foundation at constant depth, in the stationary state.
///
/// # Errors
/// [`MdrError::LineTooLow`] when the line ends in front below the depth; otherwise like [`steady`].
pub fn steady_at_depth(
    line: &(impl RigidLine + ?Sized),
    material: &(impl Material + ?Sized),
    motion: &SlidingDepth,
    options: &SteadyOptions,
) -> Result<SteadySliding, MdrError> {
    let depth = positive("indentation_depth", motion.indentation_depth)?;
    Problem::new(line, material, motion.velocity)?.refine(options, |_| Ok(depth))
}

/// Relative error of friction and force by rounding; larger than any seen.
const ROUNDING: f64 = 256.0 * f64::EPSILON;
/// How much smaller than the error of the friction what the polynomials leave out is at first, and how far it may fall.
const FIRST_TOLERANCE: f64 = 0.1;
const ROUGH_TOLERANCE: f64 = 1e-3;
const LAST_TOLERANCE: f64 = 1e-14;

struct Problem<'a, L: ?Sized> {
    line: &'a L,
    foundation: Foundation,
}

impl<'a, L: RigidLine + ?Sized> Problem<'a, L> {
    fn new(
        line: &'a L,
        material: &(impl Material + ?Sized),
        velocity: f64,
    ) -> Result<Self, MdrError> {
        let velocity = positive("velocity", velocity)?;
        Ok(Self {
            line,
            foundation: Foundation::new(material, velocity)?,
        })
    }

    /// Solves at the depth that belongs to a tolerance, until the friction is known well enough.
    fn refine(
        &self,
        options: &SteadyOptions,
        depth: impl Fn(f64) -> Result<f64, MdrError>,
    ) -> Result<SteadySliding, MdrError> {
        let relative_error = fraction("relative_error", options.relative_error)?;
        self.check_kinks(|| depth(ROUGH_TOLERANCE))?;
        let mut tolerance = FIRST_TOLERANCE * relative_error;
        loop {
            let depth = depth(tolerance)?;
            let state = self
                .solve(depth, tolerance)?
                .result([depth, self.foundation.unit])?;
            let reached = state.friction_coefficient_error;
            let wanted = relative_error * state.friction_coefficient.abs();
            if reached <= wanted {
                return Ok(state);
            }
            if tolerance <= LAST_TOLERANCE {
                return Err(MdrError::NotConverged {
                    friction_coefficient: state.friction_coefficient,
                    error: reached,
                    relative_error,
                });
            }
            tolerance = LAST_TOLERANCE.max(tolerance * (0.1 * wanted / reached));
        }
    }

    /// Refuses a contact with a kink at which friction has no limit; few polynomials tell.
    fn check_kinks(&self, depth: impl Fn() -> Result<f64, MdrError>) -> Result<(), MdrError> {
        if !self.foundation.has_dashpot() {
            return Ok(());
        }
        let kinks = SteepKink::of(self.line);
        if kinks.is_empty() {
            return Ok(());
        }
        let contacts = self.solve(depth()?, ROUGH_TOLERANCE)?.sums.contacts;
        match kinks.iter().find(|kink| kink.is_in(&contacts)) {
            None => Ok(()),
            Some(kink) => Err(MdrError::FrictionDiverges {
                position: kink.position,
            }),
        }
    }

    /// The depth that carries the force.
    fn depth(&self, load: &SlidingLoad, tolerance: f64) -> Result<f64, MdrError> {
        let target = positive("normal_force", 0.25 * load.require_normal_force()?)?;
        let unit = self.foundation.unit;
        let carried =
            |depth, tolerance| Ok(unit * (depth * self.solve(depth, tolerance)?.sums.load));
        // Most of the search needs few polynomials.
        let rough = tolerance.max(ROUGH_TOLERANCE);
        let start = depth::depth_of_load(|depth| carried(depth, rough), target)?;
        depth::polished_depth(|depth| carried(depth, tolerance), target, start)
    }

    fn solve(&self, depth: f64, tolerance: f64) -> Result<Solution, MdrError> {
        let range = Range::below(self.line, depth)?;
        let resolution = Resolution {
            depth,
            shortest_length: self.foundation.shortest_length(),
            tolerance,
        };
        let profile = Profile::new(self.line, &range, resolution)?;
        range.check_front(depth * profile.lowest, depth)?;
        Ok(Solution {
            sums: sweep(&self.foundation, &profile, depth)?,
            n_pieces: profile.pieces.len(),
        })
    }
}

struct Solution {
    sums: Sweep,
    n_pieces: usize,
}

impl Solution {
    /// The state in SI, from the depth \[m] and the unit of stress \[Pa].
    fn result(self, [depth, unit]: [f64; 2]) -> Result<SteadySliding, MdrError> {
        let Sweep {
            load,
            work,
            load_error,
            work_error,
            mut contacts,
            too_steep,
        } = self.sums;
        if let Some(position) = too_steep {
            return Err(MdrError::FrictionDiverges { position });
        }
        contacts.reverse();
        let force = finite("normal force", 4.0 * unit * (depth * load), 0.0)?;
        let friction = finite("friction coefficient", depth * (work / load), 0.0)?;
        // A larger force at the same depth is a smaller depth at the same force, which moves the friction again.
        let error = depth * (work_error / load) + 2.0 * friction * (load_error / load);
        Ok(SteadySliding {
            friction_coefficient: friction,
            friction_coefficient_error: error.abs() + ROUNDING * friction.abs(),
            indentation_depth: depth,
            normal_force: force,
            normal_force_error: force * (load_error / load + ROUNDING),
            contacts,
            n_pieces: self.n_pieces,
        })
    }
}
