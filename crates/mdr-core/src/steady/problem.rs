//! A line on a foundation at one speed: the depth at which it carries a force, and the error of the state.
//!
//! Theory: docs/theory/line-viscoelastic.md, "Error".

use indenters::{Control, RigidLine};
use numerics::{Estimate, ValueWithError, positive};
use rheology::Material;

use super::SteadySliding;
use super::depth::{depth_of_load, refined_depth};
use super::sweep::{COARSE_TOLERANCE, SweepSums, sweep};
use super::track::{check_length, sweep_until_periodic};
use crate::MdrError;
use crate::branches::{Foundation, FreeSurface};
use crate::error::finite;
use crate::line::{Profile, Range, Resolution, SteepKink, VerticalEdge, vertical_edge};

/// Relative error of friction and force by rounding, 6e-14. Chosen larger than any that was seen. It is part of every error bar,
/// and decides it only where an error near rounding is asked for.
const STATE_ROUNDING: f64 = 256.0 * f64::EPSILON;
/// Factor on the estimated tails of the polynomials. Measured: around the sharp tips of hyperboloids the tails were up to 5.5
/// times as large as estimated (test `bars_hold_for_other_pieces_of_the_same_line`). Error bars grow in proportion to it (case of
/// `evidence tuning`).
const TAIL_SAFETY_FACTOR: f64 = 6.0;
/// Smallest tolerance of the polynomials, in depths. Chosen: 45 units in the last place, below which polynomials would follow
/// rounding. An error that is too large even with it is [`MdrError::NotConverged`].
const MIN_TOLERANCE: f64 = 1e-14;
/// Tolerance of the polynomials, in depths, where the contact length only decides on the size of elements. Chosen: a change of
/// that size by 1e-9 changes no digit of an error bar.
const LENGTH_TOLERANCE: f64 = 1e-9;
/// Factor on the tolerance of a second solution, whose distance from the first is the error of the ends of the contact. Chosen:
/// even at a level end, where the error of the end is the root of that of the height, the second solution has a hundredth of it.
const END_TOLERANCE_FACTOR: f64 = 1e-4;
/// Error of the ends by rounding, relative to the contact length. Derived: the square root of [`STATE_ROUNDING`], because a line
/// that is level at its end moves it by the root of an error of the height.
const END_ROUNDING: f64 = 2.4e-7;

/// A line that moves over a foundation at one speed.
pub(crate) struct LineProblem<'a> {
    /// Rigid line that slides.
    line: &'a dyn RigidLine,
    /// Viscoelastic law of an element over which the line moves with the velocity.
    pub(super) foundation: Foundation,
    /// Length of the track after which the line returns to the same place, \[m]; `None` on fresh ground.
    pub(super) track: Option<f64>,
}

/// Size of the stationary contact.
pub(crate) struct SteadyContact {
    /// Indentation depth d, \[m].
    pub(crate) depth: f64,
    /// Distance between the rear and the front of the contact, \[m].
    pub(crate) length: f64,
}

impl<'a> LineProblem<'a> {
    /// The problem of a line that moves with a `velocity` \[m/s] over a foundation that was never touched.
    pub(crate) fn new(
        line: &'a dyn RigidLine,
        material: &dyn Material,
        velocity: f64,
    ) -> Result<Self, MdrError> {
        let foundation = Foundation::new(material, positive("velocity", velocity)?)?;
        Ok(Self {
            line,
            foundation,
            track: None,
        })
    }

    /// Solves with ever smaller tolerances of the polynomials until the quantity `sought` has the relative error asked for.
    pub(crate) fn refine(
        &self,
        control: Control,
        relative_error: f64,
        quantity: &'static str,
        sought: fn(&SteadySliding) -> Estimate,
    ) -> Result<SteadySliding, MdrError> {
        // Begin with the tolerance whose error bar is about the error asked for.
        let mut tolerance = relative_error / TAIL_SAFETY_FACTOR;
        loop {
            // Solve, and return a state with the requested error.
            let state = self.state(control, tolerance)?;
            let ValueWithError { value, error } = *sought(&state);
            let wanted = relative_error * value.abs();
            if error <= wanted {
                return self.with_ends(state, tolerance);
            }
            if tolerance <= MIN_TOLERANCE {
                return Err(MdrError::NotConverged {
                    quantity,
                    value,
                    error,
                    relative_error,
                    reached: Box::new(self.with_ends(state, tolerance)?),
                });
            }
            // Reduce the tolerance in proportion to the missing accuracy.
            tolerance = MIN_TOLERANCE.max(tolerance * (0.1 * wanted / error));
        }
    }

    /// Refuses a contact with a kink at which friction diverges; a rough solution is enough.
    pub(crate) fn check_kinks(&self, control: Control) -> Result<(), MdrError> {
        if !self.foundation.has_dashpot() {
            return Ok(());
        }
        let kinks = SteepKink::all_of(self.line);
        if kinks.is_empty() {
            return Ok(());
        }
        let depth = self.depth(control, COARSE_TOLERANCE);
        let in_contact = match depth.and_then(|depth| self.solve(depth, COARSE_TOLERANCE)) {
            Ok(sweep) => kinks.iter().find(|kink| kink.is_in(&sweep.contacts)),
            // No depth is large enough: behind the kink the line rises by any depth within the rounding of positions.
            Err(MdrError::NonFinite {
                value: f64::INFINITY,
                ..
            }) => kinks.first(),
            Err(error) => return Err(error),
        };
        in_contact.map_or(Ok(()), |&SteepKink { position, .. }| {
            Err(MdrError::FrictionDiverges { position })
        })
    }

    /// Depth and length of the contact, also where friction diverges.
    pub(crate) fn contact(&self, control: Control) -> Result<SteadyContact, MdrError> {
        let depth = self.depth(control, LENGTH_TOLERANCE)?;
        let [rear, front] = self.solve(depth, LENGTH_TOLERANCE)?.ends();
        let length = positive("contact length", front - rear)?;
        Ok(SteadyContact { depth, length })
    }

    /// The depth \[m] that is prescribed, or that carries the force, with polynomials of a `tolerance` in depths.
    fn depth(&self, control: Control, tolerance: f64) -> Result<f64, MdrError> {
        let depth = match control {
            Control::IndentationDepth(depth) => positive("indentation_depth", depth)?,
            Control::NormalForce(force) => self.depth_of_force(force, tolerance)?,
        };
        match vertical_edge(self.line)? {
            Some(edge) if edge.height < depth => Err(self.edge_error(edge, control)?),
            _ => Ok(depth),
        }
    }

    /// The depth \[m] that carries a force \[N], with polynomials of a `tolerance` in depths.
    fn depth_of_force(&self, force: f64, tolerance: f64) -> Result<f64, MdrError> {
        let target = 0.25 * positive("normal_force", force)?;
        // Most of the search needs only a rough line with few polynomials; the last steps use the tolerance asked for.
        let search_tolerance = tolerance.max(COARSE_TOLERANCE);
        let start = depth_of_load(|depth| self.quarter_force(depth, search_tolerance), target)?;
        refined_depth(|depth| self.quarter_force(depth, tolerance), target, start)
    }

    /// A quarter of the normal force at a depth \[m], with polynomials of a `tolerance` in depths, \[N].
    fn quarter_force(&self, depth: f64, tolerance: f64) -> Result<f64, MdrError> {
        Ok(self.foundation.unit * (depth * self.solve(depth, tolerance)?.load))
    }

    /// The error for a contact that would reach a vertical edge: [`MdrError::ForceBeyondEdge`] under a force, with the force that
    /// is carried at the edge, or [`MdrError::DepthBeyondEdge`] at a depth.
    fn edge_error(&self, edge: VerticalEdge, control: Control) -> Result<MdrError, MdrError> {
        let VerticalEdge { position, height } = edge;
        Ok(match control {
            Control::NormalForce(normal_force) => MdrError::ForceBeyondEdge {
                position,
                available: height,
                carried_force: 4.0 * self.quarter_force(height, COARSE_TOLERANCE)?,
                normal_force,
            },
            Control::IndentationDepth(indentation_depth) => MdrError::DepthBeyondEdge {
                position,
                available: height,
                indentation_depth,
            },
        })
    }

    /// Sums over one pass of the line at a depth \[m], with polynomials of a `tolerance` in depths.
    fn solve(&self, depth: f64, tolerance: f64) -> Result<SweepSums, MdrError> {
        self.solve_with(depth, tolerance, None)
    }

    /// Sums over one pass of the line at a depth \[m], with polynomials of a `tolerance` in depths; its loads are appended to `loads` if
    /// that is given.
    fn solve_with(
        &self,
        depth: f64,
        tolerance: f64,
        loads: Option<Vec<[f64; 2]>>,
    ) -> Result<SweepSums, MdrError> {
        let range = Range::below(self.line, depth)?;
        let resolution = Resolution {
            depth,
            shortest_length: self.foundation.shortest_length(),
            tolerance,
        };
        let profile = Profile::new(self.line, &range, resolution)?;
        range.check_front(depth * profile.lowest, depth, tolerance)?;
        match self.track {
            None => Ok(sweep(&self.foundation, &profile, FreeSurface::untouched(), loads)?.0),
            Some(track) => sweep_until_periodic(&self.foundation, &profile, track, loads),
        }
    }

    /// The state in SI units; the errors of its ends are not known yet.
    fn state(&self, control: Control, tolerance: f64) -> Result<SteadySliding, MdrError> {
        let depth = self.depth(control, tolerance)?;
        if let Some(track) = self.track {
            check_length(track, &Range::below(self.line, depth)?)?;
        }
        let mut sums = self.solve(depth, tolerance)?;
        if let Some(position) = sums.too_steep {
            return Err(MdrError::FrictionDiverges { position });
        }

        // Normal force and friction coefficient follow from the load and the work of the pass.
        let ends = sums.ends();
        sums.contacts.reverse();
        let SweepSums { load, work, .. } = sums;
        let unit = 4.0 * self.foundation.unit;
        let force = finite("normal force", unit * (depth * load), 0.0)?;
        let friction = finite("friction coefficient", depth * (work / load), 0.0)?;

        // The errors of force and friction come from the tails of the polynomials and from rounding.
        let errors = [sums.load_error, sums.work_error];
        let [load_error, work_error] = errors.map(|error| TAIL_SAFETY_FACTOR * error);
        // A larger force at the same depth is a smaller depth at the same force, which changes the friction again.
        let discretisation = depth * (work_error / load) + 2.0 * friction * (load_error / load);
        let friction_error = discretisation.abs() + STATE_ROUNDING * friction.abs();
        // The force grows with the depth at least in proportion, so that the relative error of the depth is at most that of the
        // force.
        let relative_error = load_error / load + STATE_ROUNDING;
        let [depth_error, force_error] = match control {
            Control::NormalForce(_) => [relative_error * depth, 0.0],
            Control::IndentationDepth(_) => [0.0, relative_error * force],
        };
        Ok(SteadySliding {
            friction_coefficient: Estimate::new(friction, friction_error),
            indentation_depth: Estimate::new(depth, depth_error),
            normal_force: match control {
                // On a track the depth is searched down to its rounding: the force is the given one, and the error of the depth holds
                // what remains.
                Control::NormalForce(given) if self.track.is_some() => Estimate::exact(given),
                _ => Estimate::new(force, force_error),
            },
            ends: ends.map(Estimate::exact),
            contacts: sums.contacts,
            n_pieces: sums.n_pieces,
            load: Vec::new(),
        })
    }

    /// Adds the load and the errors of both ends, from their change with a smaller tolerance and another depth.
    fn with_ends(
        &self,
        mut state: SteadySliding,
        tolerance: f64,
    ) -> Result<SteadySliding, MdrError> {
        let depth = state.indentation_depth;
        let finer = MIN_TOLERANCE.max(END_TOLERANCE_FACTOR * tolerance);
        let sums = self.solve_with(depth.value - depth.error, finer, Some(Vec::new()))?;
        let ends = sums.ends();
        let rounding = END_ROUNDING * (ends[1] - ends[0]);
        for (end, finer) in state.ends.iter_mut().zip(ends) {
            *end = Estimate::new(end.value, 2.0 * (end.value - finer).abs() + rounding);
        }
        let unit = 4.0 * self.foundation.unit * depth.value;
        let loads = sums.loads.into_iter().flatten().rev();
        state.load = loads.map(|[x, load]| [x, unit * load]).collect();
        Ok(state)
    }
}
