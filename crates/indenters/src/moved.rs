//! Results of a motion: its steps on one resolution, and its points with error estimates from several.
//!
//! ```text
//! μ = ∫ F_t dx / ∫ F_N |dx|
//! ```

use numerics::{ErrorParts, Estimate, Quantity, Refined};

use crate::motion_shear::mean_areas;
use crate::{Control, MovingLoad, Stage};

/// Factor on the relative remaining change per cycle of quantities of a single step and of the history variables, in the test for
/// a limit cycle. Chosen: they may still change by ten times the tolerance, because only the mean friction over a cycle is required
/// to that (case of `evidence tuning`).
const STEP_WEIGHT: f64 = 0.1;
/// Factors on the relative remaining changes of friction coefficient, tangential force, normal force, depth and contact area. The
/// area, which follows from forces and depth, decides nothing.
const LIMIT_CYCLE_WEIGHTS: [f64; 5] = [1.0, STEP_WEIGHT, STEP_WEIGHT, STEP_WEIGHT, 0.0];
/// Number of elements along the contact on which nothing is known of the friction. On N elements its relative error is at least
/// the cube of the ratio of this number to N: 3 % on 6.5 elements and 0.2 % on 16 (docs/theory/transient-half-space.md, "Linear
/// loads").
const UNRESOLVED_CONTACT_ELEMENTS: f64 = 2.0;
/// Approximate number of points at which a motion is reported. Chosen: a curve through them looks smooth. Each has error
/// bars of its own, and the tangential forces of a single motion control its refinement.
const POINTS_PER_MOTION: usize = 64;
/// Ratio of the rounding error of the friction coefficient to the mean slope. Chosen: some thousand roundings of f64, as in
/// a sum over all elements.
const FRICTION_ROUNDING: f64 = 1e-12;
/// Number of quantities of the whole motion, which precede those of its points: friction coefficient, peak friction, work.
const MOTION_QUANTITIES: usize = 3;
/// Number of quantities of each point: tangential force, normal force, depth, contact area.
const POINT_QUANTITIES: usize = 4;

/// One step of a motion; values are means over the step unless they belong to its end.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct MotionStep {
    /// Index of the stage of the motion.
    pub stage: usize,
    /// Time in the middle of the step, \[s].
    pub time: f64,
    /// Position in the middle of the step, \[m].
    pub position: f64,
    /// Force on the body along −x, \[N].
    pub tangential_force: f64,
    /// Normal force F_N, \[N].
    pub normal_force: f64,
    /// Indentation depth d of the lowest point, \[m].
    pub indentation_depth: f64,
    /// Contact area with the error that is known on one resolution, \[m²]; `None` in the one-dimensional model.
    pub contact_area: Option<Estimate>,
    /// Rearmost and foremost loaded element at the end of the step, relative to the lowest point, \[m]; `None` without contact.
    pub contact: Option<[f64; 2]>,
    /// Number of loaded elements at the end of the step.
    pub n_contact: usize,
}

/// A point of a motion with error estimates; the error of a prescribed quantity is 0.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct MovedPoint {
    /// Time, \[s].
    pub time: f64,
    /// Position of the lowest point along x, \[m].
    pub position: f64,
    /// Force on the body along −x as it arrives at this point, \[N].
    pub tangential_force: Estimate,
    /// Normal force F_N, \[N].
    pub normal_force: Estimate,
    /// Indentation depth d of the lowest point, \[m].
    pub indentation_depth: Estimate,
    /// Contact area, \[m²]; `None` in the one-dimensional model.
    pub contact_area: Option<Estimate>,
}

/// A motion with error estimates, or the limit cycle of a reciprocating one.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[must_use]
#[non_exhaustive]
pub struct Moved {
    /// Mean friction coefficient ∫ F_t dx / ∫ F_N |dx|.
    pub friction_coefficient: Estimate,
    /// Parts of the error of the friction coefficient.
    pub error_parts: ErrorParts,
    /// Largest |F_t|/F_N of the motion.
    pub peak_friction: Estimate,
    /// Energy ∫ F_t dx dissipated in a cycle, \[J]; `None` for a single motion.
    pub dissipated_energy: Option<Estimate>,
    /// Points from the beginning to the end; they include those of the load.
    pub points: Vec<MovedPoint>,
    /// Mean contact area ∫ A |dx| / ∫ |dx| over the path of each stage, \[m²]; 0 for a stage at rest. `None` in the one-dimensional
    /// model. Its error is smaller than those at the points, because elements that come and go cancel in the mean.
    pub mean_contact_areas: Option<Vec<Estimate>>,
    /// Time steps on the finest resolution.
    pub steps: Vec<MotionStep>,
    /// Number of cycles up to the limit cycle.
    pub n_cycles: usize,
    /// Rear and front end of the contact at the end of the motion, relative to the lowest point, \[m]; `None` without contact.
    pub ends: Option<[Estimate; 2]>,
}

/// Record of a motion, or of its last cycle, on one resolution.
#[derive(Debug, Clone, Default)]
pub struct MotionRecord {
    /// Time steps.
    pub steps: Vec<MotionStep>,
    /// Work ∫ F_t dx of the tangential force, \[J].
    pub work: f64,
    /// Integral ∫ F_N |dx| of the normal force over the path, \[J].
    pub normal_work: f64,
    /// Number of cycles so far.
    pub n_cycles: usize,
    /// Estimated remaining changes up to the limit cycle: friction coefficient, tangential force, normal force, depth, contact area.
    pub remaining_changes: [f64; 5],
    /// Largest change of a history variable by the last cycle, relative to the largest of them; 0 if they were not compared.
    pub history_change: f64,
    /// Work less the energy dissipated by the elements, \[J].
    pub imbalance: f64,
    /// Length of an element, \[m].
    pub spacing: f64,
    /// Root mean square slope of a periodic surface; 0 for a body, whose slope follows from depth and contact.
    pub rms_slope: f64,
}

impl MotionStep {
    /// Contact area, \[m²]; 0 if it is not known.
    pub(crate) fn known_area(&self) -> f64 {
        self.contact_area.map_or(0.0, |area| area.value)
    }
}

impl MotionRecord {
    /// Adds a step over which the body moves by `distance`, \[m].
    pub fn push(&mut self, step: MotionStep, distance: f64) {
        self.work += step.tangential_force * distance;
        self.normal_work += step.normal_force * distance.abs();
        self.steps.push(step);
    }

    /// Estimated remaining changes up to the limit cycle, in the order of [`remaining_changes`](Self::remaining_changes).
    ///
    /// Changes from the previous cycle to this one consist of a slow drift, which is uniform over the cycle, and of elements
    /// that come and go in single steps. The drift, estimated by the mean change, is extrapolated by the factor `slowness`.
    /// The largest change of a single step is added to it.
    fn remaining_change(&self, before: &Self, slowness: f64) -> [f64; 5] {
        let drift_and_scatter = |quantity: fn(&MotionStep) -> f64| {
            let pairs = self.steps.iter().zip(&before.steps);
            let changes = pairs.map(|(now, before)| quantity(now) - quantity(before));
            let (sum, largest) = changes.fold((0.0, 0.0_f64), |(sum, largest), change| {
                (sum + change, largest.max(change.abs()))
            });
            slowness * (sum / self.steps.len() as f64).abs() + largest
        };
        [
            slowness * (self.friction() - before.friction()).abs(),
            drift_and_scatter(|step| step.tangential_force),
            drift_and_scatter(|step| step.normal_force),
            drift_and_scatter(|step| step.indentation_depth),
            drift_and_scatter(MotionStep::known_area),
        ]
    }

    /// Scales of the quantities in [`remaining_changes`](Self::remaining_changes): the friction coefficient, and largest forces, depth and
    /// area.
    fn scales(&self) -> [f64; 5] {
        let largest = |quantity: fn(&MotionStep) -> f64| {
            self.steps
                .iter()
                .map(|step| quantity(step).abs())
                .fold(f64::MIN_POSITIVE, f64::max)
        };
        [
            self.friction().abs(),
            largest(|step| step.tangential_force),
            largest(|step| step.normal_force),
            largest(|step| step.indentation_depth),
            largest(MotionStep::known_area),
        ]
    }

    /// Mean friction coefficient ∫ F_t dx / ∫ F_N |dx|; 0 without a normal force.
    pub fn friction(&self) -> f64 {
        let friction = self.work / self.normal_work;
        if self.normal_work > 0.0 {
            friction
        } else {
            0.0
        }
    }

    /// Updates [`remaining_changes`](Self::remaining_changes) from the previous cycle and returns the largest weighted relative remaining change.
    ///
    /// The history variables count too, because a surface that rises towards the body changes no force until they touch. For the same
    /// reason a cycle without contact is never the limit cycle, and its remaining change is infinite.
    pub fn update_remaining_changes(&mut self, before: &Self, slowness: f64) -> f64 {
        self.remaining_changes = self.remaining_change(before, slowness);
        if self.steps.iter().all(|step| step.normal_force <= 0.0) {
            return f64::INFINITY;
        }
        let history = STEP_WEIGHT * slowness * self.history_change;
        let changes = self.remaining_changes.iter();
        let weighted = changes.zip(self.scales()).zip(LIMIT_CYCLE_WEIGHTS);
        weighted
            .map(|((change, scale), weight)| weight * change / scale)
            .fold(history, f64::max)
    }

    /// Smallest relative error of friction and work that is stated: the cube of [`UNRESOLVED_CONTACT_ELEMENTS`] over the number of elements
    /// along the contact, in the mean over the steps weighted with their normal force. 0 if the ends of the contact are not known.
    fn resolution_error(&self) -> f64 {
        let (mut force, mut force_times_elements) = (0.0, 0.0);
        for step in &self.steps {
            if let Some([rear, front]) = step.contact {
                force += step.normal_force;
                force_times_elements += step.normal_force * ((front - rear) / self.spacing + 1.0);
            }
        }
        let ratio = UNRESOLVED_CONTACT_ELEMENTS * force / force_times_elements;
        if ratio.is_finite() {
            ratio.powi(3)
        } else {
            0.0
        }
    }
}

/// Largest |F_t|/F_N of some steps; 0 without a normal force.
pub(crate) fn peak(steps: &[MotionStep]) -> f64 {
    let pressed = steps.iter().filter(|step| step.normal_force > 0.0);
    let frictions = pressed.map(|step| (step.tangential_force / step.normal_force).abs());
    frictions.fold(0.0, f64::max)
}

/// Quantities at a point: tangential force, normal force, depth, contact area.
type PointValues = [f64; POINT_QUANTITIES];

/// A position of a motion: a stage and the fraction of it that has passed.
#[derive(Clone, Copy)]
pub(crate) struct Station {
    /// Index of the stage.
    pub(crate) stage: usize,
    /// Fraction of its duration, from 0 to 1.
    pub(crate) part: f64,
}

/// Stations of the reported points: the beginning of the motion, then equal parts of each stage.
pub(crate) fn stations(load: &MovingLoad) -> Vec<Station> {
    let n_stages = load.stages().len();
    let per_stage = POINTS_PER_MOTION.div_ceil(n_stages);
    let in_stage = move |stage| {
        (1..=per_stage).map(move |k| Station {
            stage,
            part: k as f64 / per_stage as f64,
        })
    };
    let start = Station {
        stage: 0,
        part: 0.0,
    };
    let all = (0..n_stages).flat_map(in_stage);
    std::iter::once(start).chain(all).collect()
}

/// A motion as the source of quantities with error estimates.
#[derive(Debug, Clone, Copy)]
pub struct MotionView<'a> {
    /// Motion of the body.
    pub load: &'a MovingLoad,
    /// Whether the material is elastic; the mean slope is then the scale of the friction coefficient, which is 0.
    pub is_elastic: bool,
    /// Order q with which the friction and the work of a cycle are extrapolated from n/2 and n elements; `None` if they are not.
    pub extrapolation_order: Option<f64>,
}

impl MotionView<'_> {
    /// Quantities of the whole motion (friction, peak friction, work), then of each point (tangential force, normal force,
    /// depth, contact area), and the mean contact area over the path of each stage.
    ///
    /// The friction coefficient controls a refinement; so do the tangential forces of a single motion.
    pub fn quantities(&self, record: &MotionRecord) -> Vec<Quantity> {
        let mut quantities = self.motion_quantities(record).to_vec();
        let slope_scale = self.slope_scale(record);
        let points: Vec<Interpolated> = stations(self.load)
            .iter()
            .map(|station| interpolate(self.load, &record.steps, *station))
            .collect();
        // Find the largest value of each quantity as its scale; the elastic tangential force scales with slope times normal
        // force.
        let mut scales = [f64::MIN_POSITIVE; POINT_QUANTITIES];
        for point in &points {
            for (scale, value) in scales.iter_mut().zip(point.values) {
                *scale = value.abs().max(*scale);
            }
        }
        scales[0] = scales[0].max(if self.is_elastic {
            slope_scale * scales[1]
        } else {
            0.0
        });
        for point in points {
            quantities.extend((0..POINT_QUANTITIES).map(|k| Quantity {
                scale: scales[k],
                error_floor: point.scatter[k],
                controls_refinement: k == 0 && !self.load.is_cycle(),
                ..Quantity::from(point.values[k])
            }));
        }
        let mean_areas = mean_areas(self.load, &record.steps).into_iter();
        quantities.extend(mean_areas.map(|area| Quantity {
            controls_refinement: false,
            ..Quantity::from(area)
        }));
        quantities
    }

    /// Friction coefficient, peak friction and work of the whole motion, with the errors that are known on one resolution.
    fn motion_quantities(&self, record: &MotionRecord) -> [Quantity; MOTION_QUANTITIES] {
        // Read friction, its peak and its scale, to which the errors below refer, from the record.
        let friction = record.friction();
        let peak = peak(&record.steps);
        let slope_scale = self.slope_scale(record);
        let is_cycle = self.load.is_cycle();
        // Add errors that differences between grids may not show: the imbalance of the energy of a cycle, and the effect of few
        // elements in contact.
        let imbalance = if is_cycle {
            record.imbalance.abs()
        } else {
            0.0
        };
        let resolution_error = record.resolution_error();
        [
            Quantity {
                scale: if self.is_elastic {
                    slope_scale
                } else if is_cycle {
                    friction.abs()
                } else {
                    peak
                },
                error_floor: (resolution_error * friction.abs())
                    .max(imbalance / record.normal_work),
                rounding_error: FRICTION_ROUNDING * slope_scale,
                extrapolation_order: self.extrapolation_order,
                ..Quantity::from(friction)
            },
            Quantity {
                error_floor: resolution_error * peak,
                controls_refinement: false,
                ..Quantity::from(peak)
            },
            Quantity {
                error_floor: (resolution_error * record.work.abs()).max(imbalance),
                rounding_error: FRICTION_ROUNDING * slope_scale * record.normal_work,
                extrapolation_order: self.extrapolation_order,
                controls_refinement: false,
                ..Quantity::from(record.work)
            },
        ]
    }

    /// Estimate of the mean slope in the contact: the largest ratio of depth to length of contact.
    fn slope_scale(&self, record: &MotionRecord) -> f64 {
        let steps = record.steps.iter();
        let slopes = steps.filter_map(|step| {
            let [rear, front] = step.contact?;
            Some(step.indentation_depth.abs() / (front - rear))
        });
        slopes
            .filter(|slope| slope.is_finite())
            .fold(record.rms_slope, f64::max)
    }

    /// Name of the quantity with this index.
    pub const fn quantity_name(quantity: usize) -> &'static str {
        match quantity {
            0 => "friction coefficient",
            1 => "largest friction coefficient",
            2 => "dissipated energy",
            _ => match (quantity - MOTION_QUANTITIES) % POINT_QUANTITIES {
                0 => "force along x",
                1 => "normal force",
                2 => "indentation depth",
                _ => "contact area",
            },
        }
    }

    /// Truncation errors of the [`quantities`](Self::quantities) up to the limit cycle; empty for a single motion.
    pub fn truncation_errors(&self, record: &MotionRecord) -> Vec<ErrorParts> {
        if !self.load.is_cycle() {
            return Vec::new();
        }
        let truncated = |change: f64| ErrorParts {
            truncation: Some(change),
            ..ErrorParts::NONE
        };
        // Take the remaining change of the peak from that of the tangential force, and the change of the work from those of
        // friction and normal force.
        let [friction, point_errors @ ..] = record.remaining_changes;
        let [tangential_force, normal_force, ..] = point_errors;
        let force_scale = record.scales()[2];
        let work = friction * record.normal_work + normal_force / force_scale * record.work.abs();
        let motion_errors = [friction, tangential_force / force_scale, work];
        let all_point_errors = stations(self.load).into_iter().flat_map(|_| point_errors);
        let [.., area] = point_errors;
        motion_errors
            .into_iter()
            .chain(all_point_errors)
            .chain(self.load.stages().iter().map(|_| area))
            .map(truncated)
            .collect()
    }

    /// The motion with the values and errors of its [`quantities`](Self::quantities).
    pub fn moved(&self, refined: Refined<MotionRecord>) -> Moved {
        let Refined {
            value: record,
            quantities: stated,
            error,
            parts,
            ..
        } = refined;
        let is_cycle = self.load.is_cycle();
        // A negative dissipation within its error is 0, because no passive material gives energy back.
        let not_negative = |value: f64, error: f64| match value {
            value if is_cycle && value < 0.0 && -value <= error => Estimate::new(0.0, error),
            value => Estimate::new(value, error),
        };
        let friction = not_negative(stated[0], error[0]);
        let is_force = matches!(self.load.largest_control(), Control::NormalForce(_));
        let is_prescribed = |k: usize| (k == 1 && is_force) || (k == 2 && !is_force);
        let has_area = record.steps.iter().all(|step| step.contact_area.is_some());
        // The mean areas of the stages are the last quantities.
        let of_stages = stated.len() - self.load.stages().len();
        let mean_areas = stated[of_stages..].iter().zip(&error[of_stages..]);
        let mean_areas = mean_areas.map(|(area, error)| Estimate::new(*area, *error));
        // Collect the values at the points of the output: prescribed quantities are exact, the others have the errors of the
        // refinement.
        let stations = stations(self.load).into_iter().enumerate();
        let points = stations.map(|(index, station)| {
            let prescribed = self.load.stages()[station.stage].point_at(station.part);
            let values = interpolate(self.load, &record.steps, station).values;
            let [tangential_force, normal_force, indentation_depth, area] =
                std::array::from_fn(|k| {
                    if is_prescribed(k) {
                        return Estimate::exact(prescribed.control.value());
                    }
                    Estimate::new(
                        values[k],
                        error[MOTION_QUANTITIES + POINT_QUANTITIES * index + k],
                    )
                });
            MovedPoint {
                time: self.load.start_time() + prescribed.time,
                position: prescribed.position,
                tangential_force,
                normal_force,
                indentation_depth,
                contact_area: has_area.then_some(area),
            }
        });
        // Each end of the contact gets the error of two elements, because it is known only to the grid.
        let last = record.steps.last().and_then(|step| step.contact);
        let end = |end: f64| Estimate::new(end, 2.0 * record.spacing);
        Moved {
            friction_coefficient: friction,
            error_parts: parts[0],
            peak_friction: Estimate::new(stated[1], error[1]),
            dissipated_energy: is_cycle.then(|| not_negative(stated[2], error[2])),
            points: points.collect(),
            mean_contact_areas: has_area.then(|| mean_areas.collect()),
            ends: last.map(|ends| ends.map(end)),
            n_cycles: record.n_cycles,
            steps: self.with_absolute_times(record.steps),
        }
    }

    /// The steps with times that include the start time of the load.
    fn with_absolute_times(&self, mut steps: Vec<MotionStep>) -> Vec<MotionStep> {
        for step in &mut steps {
            step.time += self.load.start_time();
        }
        steps
    }
}

/// Quantities at a station, and the scatter of the steps around it.
pub(crate) struct Interpolated {
    /// Interpolated quantities.
    pub(crate) values: PointValues,
    /// Scatter of each quantity, that of the area at least the error known on one resolution.
    scatter: PointValues,
}

/// Linear interpolation between the middles of the two steps of the stage that are nearest to a station.
///
/// The scatter is the deviation of the middle one of three neighbouring steps from the line through the other two.
pub(crate) fn interpolate(
    load: &MovingLoad,
    steps: &[MotionStep],
    station: Station,
) -> Interpolated {
    let Station { stage, part } = station;
    let values = |step: &MotionStep| {
        [
            step.tangential_force,
            step.normal_force,
            step.indentation_depth,
            step.known_area(),
        ]
    };
    // Find the two steps of the stage around the station.
    let first = steps.partition_point(|step| step.stage < stage);
    let count = steps[first..].partition_point(|step| step.stage == stage);
    let steps = &steps[first..first + count];
    let time = Stage::point_at(&load.stages()[stage], part).time;
    let after = steps
        .partition_point(|step| step.time < time)
        .clamp(1, count - 1);
    let (before, next) = (&steps[after - 1], &steps[after]);
    // Interpolate the values linearly in time between the two steps.
    let along = (time - before.time) / (next.time - before.time);
    let (from, to) = (values(before), values(next));
    let interpolated = std::array::from_fn(|k| from[k] + along * (to[k] - from[k]));
    // Estimate the interpolation error: the distance of a middle step from the line through its neighbours, if the stage has
    // three steps.
    let mut scatter: PointValues =
        match steps.get((after + 1).saturating_sub(2).min(count.saturating_sub(3))..) {
            Some([a, b, c, ..]) => {
                let middle = (b.time - a.time) / (c.time - a.time);
                let [a, b, c] = [a, b, c].map(values);
                std::array::from_fn(|k| (a[k] + middle * (c[k] - a[k]) - b[k]).abs())
            }
            _ => [0.0; POINT_QUANTITIES],
        };
    for area in [before, next]
        .into_iter()
        .filter_map(|step| step.contact_area)
    {
        scatter[3] = scatter[3].max(area.error);
    }
    Interpolated {
        values: interpolated,
        scatter,
    }
}
