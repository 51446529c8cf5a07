//! What is said of a motion: its steps on one resolution, and its points with their errors from several.
//!
//! ```text
//! μ = ∫ F_t dx / ∫ F_N |dx|
//! ```

use numerics::{ErrorParts, Estimate, Quantity};

use crate::{Control, MovingLoad, Stage};

/// By how much less forces and depths of single steps need be known than the friction of a cycle.
const PARTS: [f64; 4] = [1.0, 0.1, 0.1, 0.1];
/// Rows of a motion, about.
const ROWS: usize = 64;
/// Rounding of forces times slopes, relative to the mean slope.
const ROUNDING: f64 = 1e-12;
/// Quantities of the whole motion, before those of its rows, and of each row.
const OF_WHOLE: usize = 3;
const OF_ROW: usize = 3;

/// One step of a motion; what is not said to belong to its end is a mean, and belongs to its middle.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct MotionStep {
    /// Number of the stage of the motion.
    pub stage: usize,
    /// Time in the middle, \[s].
    pub time: f64,
    /// Position in the middle, \[m].
    pub position: f64,
    /// Force on the body along −x, \[N].
    pub tangential_force: f64,
    /// Normal force F_N, \[N].
    pub normal_force: f64,
    /// Indentation depth d of the lowest point, \[m].
    pub indentation_depth: f64,
    /// Rearmost and foremost loaded element at the end, relative to the lowest point, \[m].
    pub contact: Option<[f64; 2]>,
    /// Number of loaded elements at the end.
    pub n_contact: usize,
}

/// A point of a motion with its errors; an error of 0 says that a quantity is given.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct MovedPoint {
    /// Time, \[s].
    pub time: f64,
    /// Position of the lowest point along x, \[m].
    pub position: f64,
    /// Force on the body along −x \[N], on the way to this point.
    pub tangential_force: Estimate,
    /// Normal force F_N, \[N].
    pub normal_force: Estimate,
    /// Indentation depth d of the lowest point, \[m].
    pub indentation_depth: Estimate,
}

/// A motion with its error bars, or the cycle in which one to and fro ends.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[must_use]
#[non_exhaustive]
pub struct Moved {
    /// Mean friction coefficient ∫ F_t dx / ∫ F_N |dx|.
    pub friction_coefficient: Estimate,
    /// What its error consists of.
    pub error_parts: ErrorParts,
    /// The largest |F_t|/F_N on the way.
    pub peak_friction: Estimate,
    /// Energy ∫ F_t dx that is dissipated in a cycle \[J]; none of a motion that does not come back.
    pub dissipated_energy: Option<Estimate>,
    /// From the beginning to the end, the points of the motion among them.
    pub points: Vec<MovedPoint>,
    /// The steps on the finest resolution.
    pub steps: Vec<MotionStep>,
    /// Cycles that were followed until they were alike.
    pub n_cycles: usize,
    /// Rear and front end of the contact at the end, relative to the lowest point, \[m]; none where nothing touches.
    pub ends: Option<[Estimate; 2]>,
}

/// A motion, or its last cycle, on one resolution.
#[derive(Debug, Clone, Default)]
pub struct MotionRecord {
    /// Its steps.
    pub steps: Vec<MotionStep>,
    /// ∫ F_t dx, \[J].
    pub work: f64,
    /// ∫ F_N |dx|, \[J].
    pub normal_work: f64,
    /// Cycles that were followed.
    pub n_cycles: usize,
    /// What is left of the way to the cycle: of the friction coefficient, and of forces and depths of all steps.
    pub rest: [f64; 4],
    /// Work less what the elements are known to have lost, \[J].
    pub imbalance: f64,
    /// Length of an element, \[m].
    pub spacing: f64,
    /// Root mean square slope of a surface without end; 0 of a body, whose contact tells it.
    pub steepness: f64,
}

impl MotionRecord {
    /// Adds a step over a distance \[m].
    pub fn push(&mut self, step: MotionStep, distance: f64) {
        self.work += step.tangential_force * distance;
        self.normal_work += step.normal_force * distance.abs();
        self.steps.push(step);
    }

    /// By how much a cycle may differ from the last one of all, when it differs so from the one before: the friction
    /// coefficient, and of all steps the tangential force, the normal force, and the depth.
    ///
    /// What changes slowly does so over the whole cycle, and its mean is that many times as far from its end; elements that
    /// come and go from cycle to cycle change single steps, and no more.
    fn left(&self, before: &Self, slowness: f64) -> [f64; 4] {
        let rest = |of: fn(&MotionStep) -> f64| {
            let pairs = self.steps.iter().zip(&before.steps);
            let changes = pairs.map(|(now, before)| of(now) - of(before));
            let (sum, largest) = changes.fold((0.0, 0.0_f64), |(sum, largest), change| {
                (sum + change, largest.max(change.abs()))
            });
            slowness * (sum / self.steps.len() as f64).abs() + largest
        };
        [
            slowness * (self.friction() - before.friction()).abs(),
            rest(|step| step.tangential_force),
            rest(|step| step.normal_force),
            rest(|step| step.indentation_depth),
        ]
    }

    /// What these are relative to; without friction the largest coefficient of a step.
    fn sizes(&self) -> [f64; 4] {
        let largest = |of: fn(&MotionStep) -> f64| {
            self.steps
                .iter()
                .map(|step| of(step).abs())
                .fold(f64::MIN_POSITIVE, f64::max)
        };
        [
            self.friction().abs(),
            largest(|step| step.tangential_force),
            largest(|step| step.normal_force),
            largest(|step| step.indentation_depth),
        ]
    }

    /// Mean friction coefficient ∫ F_t dx / ∫ F_N |dx|; 0 where nothing was pressed on the way.
    pub fn friction(&self) -> f64 {
        let friction = self.work / self.normal_work;
        if self.normal_work > 0.0 {
            friction
        } else {
            0.0
        }
    }

    /// Keeps what is left after the cycle before, and gives the largest part of it, relative to the values.
    pub fn rest_after(&mut self, before: &Self, slowness: f64) -> f64 {
        self.rest = self.left(before, slowness);
        let relative = self.rest.iter().zip(self.sizes()).zip(PARTS);
        let relative = relative.map(|((rest, size), part)| part * rest / size);
        relative.fold(0.0, f64::max)
    }

    fn peak(&self) -> f64 {
        let pressed = self.steps.iter().filter(|step| step.normal_force > 0.0);
        let frictions = pressed.map(|step| (step.tangential_force / step.normal_force).abs());
        frictions.fold(0.0, f64::max)
    }
}

/// What is known at a point: tangential force, normal force, depth.
type Row = [f64; OF_ROW];

/// How a march is looked at.
#[derive(Debug, Clone, Copy)]
pub struct MotionView<'a> {
    /// The motion.
    pub load: &'a MovingLoad,
    /// Whether nothing is dissipated, so that slopes stand for the friction.
    pub is_elastic: bool,
}

impl MotionView<'_> {
    /// The points at which a motion is asked for: its stage, and the part of it; the first one is its beginning.
    fn stations(&self) -> Vec<(usize, f64)> {
        let n_stages = self.load.stages().len();
        let each = ROWS.div_ceil(n_stages);
        let parts = move |stage| (1..=each).map(move |k| (stage, k as f64 / each as f64));
        let all = (0..n_stages).flat_map(parts);
        std::iter::once((0, 0.0)).chain(all).collect()
    }

    /// Friction, its peak and the work, and force along x, normal force and depth of all points; the first drives a refinement, and so do
    /// the forces along x of a motion that does not come back.
    pub fn quantities(&self, record: &MotionRecord) -> Vec<Quantity> {
        let mut quantities = self.of_whole(record).to_vec();
        let steepness = self.steepness(record);
        let rows: Vec<(Row, Row)> = self
            .stations()
            .iter()
            .map(|at| row(self.load, &record.steps, *at))
            .collect();
        let mut sizes = [f64::MIN_POSITIVE; OF_ROW];
        for (values, _) in &rows {
            for (size, value) in sizes.iter_mut().zip(values) {
                *size = value.abs().max(*size);
            }
        }
        sizes[0] = sizes[0].max(if self.is_elastic {
            steepness * sizes[1]
        } else {
            0.0
        });
        for (values, scatter) in rows {
            quantities.extend((0..OF_ROW).map(|k| Quantity {
                scale: sizes[k],
                error_floor: scatter[k],
                controls_refinement: k == 0 && !self.load.is_cycle(),
                ..Quantity::from(values[k])
            }));
        }
        quantities
    }

    fn of_whole(&self, record: &MotionRecord) -> [Quantity; OF_WHOLE] {
        let friction = record.friction();
        let peak = record.peak();
        let steepness = self.steepness(record);
        let is_cycle = self.load.is_cycle();
        let imbalance = record.imbalance / record.normal_work;
        [
            Quantity {
                scale: if self.is_elastic {
                    steepness
                } else if is_cycle {
                    friction.abs()
                } else {
                    peak
                },
                error_floor: if is_cycle { imbalance.abs() } else { 0.0 },
                rounding_error: ROUNDING * steepness,
                ..Quantity::from(friction)
            },
            Quantity {
                controls_refinement: false,
                ..Quantity::from(peak)
            },
            Quantity {
                error_floor: if is_cycle {
                    record.imbalance.abs()
                } else {
                    0.0
                },
                rounding_error: ROUNDING * steepness * record.normal_work,
                controls_refinement: false,
                ..Quantity::from(record.work)
            },
        ]
    }

    /// About the mean slope in the contact.
    fn steepness(&self, record: &MotionRecord) -> f64 {
        let steps = record.steps.iter();
        let slopes = steps.filter_map(|step| {
            let [rear, front] = step.contact?;
            Some(step.indentation_depth.abs() / (front - rear))
        });
        slopes
            .filter(|slope| slope.is_finite())
            .fold(record.steepness, f64::max)
    }

    /// The name of a quantity of this number.
    pub const fn in_words(quantity: usize) -> &'static str {
        match quantity {
            0 => "friction coefficient",
            1 => "largest friction coefficient",
            2 => "dissipated energy",
            _ => match (quantity - OF_WHOLE) % OF_ROW {
                0 => "force along x",
                1 => "normal force",
                _ => "indentation depth",
            },
        }
    }

    /// What is left to the cycle, of the same quantities.
    pub fn rests(&self, record: &MotionRecord) -> Vec<ErrorParts> {
        if !self.load.is_cycle() {
            return Vec::new();
        }
        let truncated = |rest: f64| ErrorParts {
            truncation: Some(rest),
            ..ErrorParts::NONE
        };
        let [friction, rows @ ..] = record.rest;
        let force = record.sizes()[2];
        let work = friction * record.normal_work + rows[1] / force * record.work.abs();
        let whole = [friction, rows[0] / force, work];
        let rows = self.stations().into_iter().flat_map(|_| rows);
        whole.into_iter().chain(rows).map(truncated).collect()
    }

    /// The motion with the errors of these quantities.
    pub fn moved(&self, record: MotionRecord, error: &[f64], error_parts: ErrorParts) -> Moved {
        let is_cycle = self.load.is_cycle();
        // No material gives energy back.
        let lost = |value: f64, error: f64| match value {
            value if is_cycle && value < 0.0 && -value <= error => Estimate::new(0.0, error),
            value => Estimate::new(value, error),
        };
        let friction = lost(record.friction(), error[0]);
        let is_force = matches!(self.load.largest_control(), Control::NormalForce(_));
        let given = |k: usize| (k == 1 && is_force) || (k == 2 && !is_force);
        let points = self.stations().into_iter().enumerate().map(|(index, at)| {
            let place = self.load.stages()[at.0].at(at.1);
            let (values, _) = row(self.load, &record.steps, at);
            let [tangential_force, normal_force, indentation_depth] = std::array::from_fn(|k| {
                if given(k) {
                    return Estimate::exact(place.control.value());
                }
                Estimate::new(values[k], error[OF_WHOLE + OF_ROW * index + k])
            });
            MovedPoint {
                time: self.load.begins() + place.time,
                position: place.position,
                tangential_force,
                normal_force,
                indentation_depth,
            }
        });
        let last = record.steps.last().and_then(|step| step.contact);
        let end = |end: f64| Estimate::new(end, 2.0 * record.spacing);
        Moved {
            friction_coefficient: friction,
            error_parts,
            peak_friction: Estimate::new(record.peak(), error[1]),
            dissipated_energy: is_cycle.then(|| lost(record.work, error[2])),
            points: points.collect(),
            ends: last.map(|ends| ends.map(end)),
            n_cycles: record.n_cycles,
            steps: self.dated(record.steps),
        }
    }

    /// With the times of the motion.
    fn dated(&self, mut steps: Vec<MotionStep>) -> Vec<MotionStep> {
        for step in &mut steps {
            step.time += self.load.begins();
        }
        steps
    }
}

/// The values at a part of a stage, straight through the middles of the two nearest steps of it, and how steps scatter
/// there.
fn row(load: &MovingLoad, steps: &[MotionStep], (stage, part): (usize, f64)) -> (Row, Row) {
    let values = |step: &MotionStep| {
        [
            step.tangential_force,
            step.normal_force,
            step.indentation_depth,
        ]
    };
    let first = steps.partition_point(|step| step.stage < stage);
    let count = steps[first..].partition_point(|step| step.stage == stage);
    let steps = &steps[first..first + count];
    let time = Stage::at(&load.stages()[stage], part).time;
    let after = steps
        .partition_point(|step| step.time < time)
        .clamp(1, count - 1);
    let (before, next) = (&steps[after - 1], &steps[after]);
    let along = (time - before.time) / (next.time - before.time);
    let (from, to) = (values(before), values(next));
    let value = std::array::from_fn(|k| from[k] + along * (to[k] - from[k]));
    let scatter = match steps.get((after + 1).saturating_sub(2).min(count.saturating_sub(3))..) {
        Some([a, b, c, ..]) => {
            let middle = (b.time - a.time) / (c.time - a.time);
            let [a, b, c] = [a, b, c].map(values);
            std::array::from_fn(|k| (a[k] + middle * (c[k] - a[k]) - b[k]).abs())
        }
        _ => [0.0; OF_ROW],
    };
    (value, scatter)
}
