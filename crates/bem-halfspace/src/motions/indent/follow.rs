//! A history with error bars, from several grids.

use indenters::{Control, HistoryPoint, PressingLoad, Surface};
use numerics::{Accuracy, ErrorParts, Estimate, Quantity, Request};
use numerics::{in_range, not_negative, positive, refine};
use rheology::Material as _;

use super::history::refine_time_steps;
use super::press::{
    PRESS_BYTES_PER_ELEMENT, PRESSED_AREA_ORDER, PRESSED_ORDER, Spring, n_followed, pressed_grid,
};
use super::{HistoryOptions, IndentHistory, MotionRow, indent_history};
use crate::contact::check_control;
use crate::estimate::bars::{has_instantaneous_compliance, reached_or_error};
use crate::estimate::quantities::{Name, Quantities};
use crate::estimate::refinement_limits::HISTORY;
use crate::march::n_history_variables;
use crate::{BemError, Elastomer, GridOptions};

/// Largest number of time steps of a history on one grid. Chosen: steps are not halved beyond it, even if they miss the error
/// asked for, so that the time is limited. [`MIN_STEP_LIMIT`] takes precedence for histories of many points.
const MAX_HISTORY_STEPS: usize = 4096;
/// Number of steps between two points of a history up to which their halving is never refused. Derived: solutions on 1, 2, 4 and
/// 8 steps give three extrapolated values, and the ratio of their two changes, from which the error follows.
const MIN_STEP_LIMIT: usize = 8;
/// Duration of a jump of force or depth, as a fraction of the duration of the history. Chosen: short compared with any interval,
/// so that hardly anything creeps meanwhile, and far above the rounding 1e-16 of times.
const JUMP_DURATION_FRACTION: f64 = 1e-9;

/// The contact at one point of a history; an error of 0 says that a quantity is given.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct IndentPoint {
    /// Time, \[s].
    pub time: f64,
    /// Normal force F_N, \[N].
    pub normal_force: Estimate,
    /// Depth of the lowest point below the undeformed surface, \[m]; where no force presses, that of the first touch.
    pub indentation_depth: Estimate,
    /// Contact area, \[m²].
    pub contact_area: Estimate,
}

/// A history with its error bars.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[must_use]
#[non_exhaustive]
pub struct IndentCurve {
    /// The points of the history; the error of a quantity is the largest one at any of them.
    pub points: Vec<IndentPoint>,
    /// Parts of the error of the force, or of the depth under a force.
    pub error_parts: ErrorParts,
    /// Number of elements in contact at the last point, on the finest grid.
    pub n_contact: usize,
    /// Number of steps in time on the finest grid.
    pub n_steps: usize,
    /// Spacing, footprint and tolerance of the finest grid.
    pub options: GridOptions,
}

/// Follows a history of forces or depths that is linear between its points, and returns the contact at each point. The accuracy
/// is an error relative to the largest depth if forces are given, or to the largest force if depths are given. It may also be an
/// approximate number of elements along the largest contact.
///
/// The half space is undeformed before the first point. Two points of the same time are a jump, and so is a first one at
/// which the body is pressed already; a jump takes one part in 10⁹ of the history.
///
/// ```
/// use bem_halfspace::indenters::PowerProfile;
/// use bem_halfspace::rheology::{StandardSolid, StandardSolidParameters};
/// use bem_halfspace::{Control, HistoryPoint, indent_along};
///
/// let ball = PowerProfile::paraboloid(50.0)?;
/// let rubber = StandardSolid::new(StandardSolidParameters {
///     equilibrium_modulus: 1e6,
///     maxwell_modulus: 1e6,
///     viscosity: 1e6,
/// })?;
/// let depth = |time, depth| HistoryPoint { time, control: Control::IndentationDepth(depth) };
/// let history = [depth(0.0, 0.0), depth(1.0, 1e-4), depth(5.0, 1e-4)];
/// let curve = indent_along(&ball, &rubber, &history, 0.1)?;
/// // The force relaxes while the depth is held.
/// assert!(curve.points[2].normal_force.value < curve.points[1].normal_force.value);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`BemError::InvalidParameter`] for fewer than two points, times that decrease, force and depth in one history, a history
/// that never presses, and a jump of the depth on a material without instantaneous compliance; [`BemError::NotReached`] with what
/// was reached on the finest grid allowed; otherwise like [`indent_history`].
pub fn indent_along<'w>(
    surface: &dyn Surface,
    elastomer: &dyn Elastomer,
    history: &[HistoryPoint],
    request: impl Into<Request<'w>>,
) -> Result<IndentCurve, BemError> {
    let accuracy_request = request.into();
    let path = Path::new(history, has_instantaneous_compliance(elastomer))?;
    let plan = path
        .bounding_spring(elastomer)?
        .plan(surface, path.largest())?;
    let times: Vec<f64> = path.points[1..].iter().map(|[time, _]| *time).collect();
    // Follow the history on one grid. If an error is asked for, the steps may cause half of it.
    let solve = |elements: usize, _: &dyn Fn(f64)| {
        let mut options = HistoryOptions::new(pressed_grid(&plan, elements));
        let max_steps = MAX_HISTORY_STEPS / times.len();
        options.max_steps = max_steps.clamp(MIN_STEP_LIMIT, options.max_steps);
        let control = |time| path.control_at(time);
        let found = match accuracy_request.accuracy {
            Accuracy::RelativeError(error) => {
                options.relative_error = 0.5 * error;
                indent_history(surface, elastomer, control, &times, &options)
            }
            Accuracy::Elements(_) => {
                refine_time_steps(surface, elastomer, control, &times, &options)
            }
        };
        Ok::<_, BemError>((found?, options.grid))
    };
    // Find the errors by the steps in time, which finer elements do not reduce, for each quantity of the history.
    let step_errors = |(found, _): &(IndentHistory, GridOptions), _: &dyn Fn(f64)| {
        let of_steps = |quantity: Quantity| ErrorParts {
            time_stepping: Some(found.time_error * quantity.scale),
            ..ErrorParts::NONE
        };
        let quantities = path.quantities(found).into_iter();
        Ok(quantities.map(of_steps).collect())
    };
    let fine = refine(
        &HISTORY.goal(accuracy_request, PRESSED_ORDER),
        solve,
        |(found, _)| path.quantities(found),
        step_errors,
    )?;
    // Take the largest error of a quantity at any point of the history as its error at all points.
    let worst = |name: Name| {
        let parts = fine.parts.iter().skip(name.index());
        let parts_of_rows = parts.step_by(Name::IN_ORDER.len());
        let worst = parts_of_rows.max_by(|a, b| a.sum().total_cmp(&b.sum()));
        worst.copied().unwrap_or(ErrorParts::NONE)
    };
    let (found, options) = fine.value;
    let found = IndentCurve {
        points: path.with_errors(history, &found.rows, |name| worst(name).sum()),
        error_parts: worst(path.sought_and_given()[0]),
        n_contact: found.rows.last().map_or(0, |row| row.n_contact),
        n_steps: found.rows.len() * found.steps_per_row,
        options,
    };
    reached_or_error(fine.missed, Name::of_quantity, found)
}

/// Upper bound of the memory of [`indent_along`] for a number of elements along the largest contact, \[bytes].
///
/// # Errors
/// As for [`indent_along`], before anything is solved.
pub fn indent_along_memory(
    surface: &dyn Surface,
    elastomer: &dyn Elastomer,
    history: &[HistoryPoint],
    elements: usize,
) -> Result<f64, BemError> {
    let path = Path::new(history, has_instantaneous_compliance(elastomer))?;
    let plan = path
        .bounding_spring(elastomer)?
        .plan(surface, path.largest())?;
    let creep = elastomer.material().creep();
    let n_fields = n_history_variables(&creep);
    let per_element = PRESS_BYTES_PER_ELEMENT + (n_fields * size_of::<f64>()) as f64;
    Ok(per_element * n_followed(surface, &pressed_grid(&plan, elements)))
}

/// The quantities of one row of a history. Friction is 0 without sliding; the peak pressure is not estimated and 0.
const fn row_quantities(row: &MotionRow) -> Quantities<f64> {
    Quantities {
        friction_coefficient: 0.0,
        normal_force: row.normal_force,
        indentation_depth: row.indentation_depth,
        contact_area: row.contact_area,
        peak_pressure: 0.0,
    }
}

/// A checked history, whose points have increasing times.
struct Path {
    /// True if forces are given, false for depths.
    is_force: bool,
    /// Points [time since the first one \[s], force \[N] or depth \[m]]; at the first point nothing is pressed.
    points: Vec<[f64; 2]>,
}

impl Path {
    /// Checks the points of a history, and turns jumps, which are two points of the same time, into short ramps.
    fn new(history: &[HistoryPoint], has_instantaneous_compliance: bool) -> Result<Self, BemError> {
        let allowed = "at least 2";
        let n_points = history.len() as f64;
        in_range("number of points", n_points, n_points >= 2.0, allowed)?;
        let is_force = |step: &HistoryPoint| matches!(step.control, Control::NormalForce(_));
        let (first, last) = (history[0], history[history.len() - 1]);
        let shortest = JUMP_DURATION_FRACTION * positive("duration", last.time - first.time)?;
        let is_forced = is_force(&first);
        let mut before = first.time;
        let mut points = vec![[0.0, check_control(first.control)?.min(0.0)]];
        for (index, step) in history.iter().enumerate() {
            not_negative("time between two points", step.time - before)?;
            before = step.time;
            let value = check_control(step.control)?;
            let allowed = "a force at all points of a history, or a depth at all";
            in_range("control", value, is_force(step) == is_forced, allowed)?;
            if index == 0 && value <= 0.0 {
                continue;
            }
            // Times must increase: a point at the time of the previous one, which is a jump, is moved a little later.
            let [last, _] = points[points.len() - 1];
            let time = step.time - first.time;
            if time < last + shortest && !is_forced && !has_instantaneous_compliance {
                // A material without instantaneous compliance resists a jump of the depth with an infinite force, so that a jump
                // is refused.
                positive("time between two depths", time - last)?;
            }
            points.push([time.max(last + shortest), value]);
        }
        Ok(Self {
            is_force: is_forced,
            points,
        })
    }

    /// The control with a value, \[N] or \[m]: a force if forces are given, else a depth.
    fn control(&self, value: f64) -> Control {
        if self.is_force {
            Control::NormalForce(value)
        } else {
            Control::IndentationDepth(value)
        }
    }

    /// The largest force or depth of the history.
    fn largest(&self) -> Control {
        let values = self.points.iter().map(|[_, value]| *value);
        self.control(values.fold(0.0, f64::max))
    }

    /// The elastic material whose contact under [`largest`](Self::largest) encloses the contacts of all points, for the footprint. With
    /// given forces its compliance is J at the end of the history, because ∫ J dF ≤ J(t) max F.
    fn bounding_spring(&self, elastomer: &dyn Elastomer) -> Result<Spring, BemError> {
        let [duration, _] = self.points[self.points.len() - 1];
        let load = PressingLoad::new(self.largest(), duration)?;
        if self.is_force {
            Spring::after(elastomer, &load)
        } else {
            Spring::new(elastomer, 1.0, false)
        }
    }

    /// Control at a `time` \[s] since the first point, linear between two points.
    fn control_at(&self, time: f64) -> Control {
        // Find the two points between which the time lies, and interpolate between them.
        let next = self.points.partition_point(|[before, _]| *before < time);
        let index = next.clamp(1, self.points.len() - 1);
        let [[start, from], [end, to]] = [self.points[index - 1], self.points[index]];
        let part = ((time - start) / (end - start)).min(1.0);
        self.control(from + part * (to - from))
    }

    /// Names [sought, given] of force and depth: the sought quantity follows from the given one.
    const fn sought_and_given(&self) -> [Name; 2] {
        if self.is_force {
            [Name::Depth, Name::Force]
        } else {
            [Name::Force, Name::Depth]
        }
    }

    /// Quantities of all rows as input of the grid refinement, one row after the other. Force or depth, whichever is sought, controls
    /// the refinement. Errors are relative to the largest value of a quantity in the history.
    fn quantities(&self, found: &IndentHistory) -> Vec<Quantity> {
        // Find the scale of each quantity.
        let largest = |name| {
            let values = found
                .rows
                .iter()
                .map(|row| row_quantities(row).get(name).abs());
            values.fold(0.0, f64::max)
        };
        let (sizes, [sought, _]) = (Name::IN_ORDER.map(largest), self.sought_and_given());
        // Collect the quantities of one row.
        let of_one_row = |row: &MotionRow| {
            let area_uncertainty = row.contact_area_uncertainty;
            let quantity = move |(name, value): (Name, f64)| {
                let is_area = name == Name::Area;
                Quantity {
                    scale: sizes[name.index()],
                    error_floor: if is_area { area_uncertainty } else { 0.0 },
                    order: is_area.then_some(PRESSED_AREA_ORDER),
                    controls_refinement: name == sought,
                    ..Quantity::from(value)
                }
            };
            row_quantities(row).iter().map(quantity).collect::<Vec<_>>()
        };
        found.rows.iter().flat_map(of_one_row).collect()
    }

    /// The points of a history with their values from `rows`; `error(name)` is the absolute error of a quantity at all points. The
    /// given quantity has no error.
    fn with_errors(
        &self,
        history: &[HistoryPoint],
        rows: &[MotionRow],
        error: impl Fn(Name) -> f64,
    ) -> Vec<IndentPoint> {
        let [_, given] = self.sought_and_given();
        let error = |name: Name| if name == given { 0.0 } else { error(name) };
        let errors = Name::IN_ORDER.map(error);
        let point = |(step, values): (&HistoryPoint, Quantities<f64>)| {
            let known = values.map(|name, value| Estimate::new(value, errors[name.index()]));
            IndentPoint {
                time: step.time,
                normal_force: known.normal_force,
                indentation_depth: known.indentation_depth,
                contact_area: known.contact_area,
            }
        };
        // The march has no row for a first point at which nothing is pressed.
        let free = (rows.len() < history.len()).then_some(Quantities {
            friction_coefficient: 0.0,
            normal_force: 0.0,
            indentation_depth: self.points[0][1],
            contact_area: 0.0,
            peak_pressure: 0.0,
        });
        let contacts = free.into_iter().chain(rows.iter().map(row_quantities));
        history.iter().zip(contacts).map(point).collect()
    }
}
