//! Motions of a pressed body along x: once through a list of points, or reciprocating.
//!
//! ```text
//! x(t) = x₀ + (x₁ − x₀) ξ,   or   x₀ + (x₁ − x₀) (1 − cos π ξ)/2,     ξ = (t − t₀)/(t₁ − t₀)
//! ```

use crate::{Control, IndenterError};
use numerics::{InvalidParameter, finite, in_range, not_negative, positive};

/// Position of a body and its force or depth at one time.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct MovingPoint {
    /// Time, \[s].
    pub time: f64,
    /// Position of the lowest point along x, \[m].
    pub position: f64,
    /// Force ≥ 0, or depth of the lowest point below the undeformed surface, of either sign.
    pub control: Control,
}

/// Time dependence of the position between the ends of a stroke.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum Shape {
    /// Sinusoidal motion x = −(s/2) cos(2π f t).
    #[default]
    Sinusoidal,
    /// Constant speed that changes its sign at the ends.
    Triangular,
}

/// A reciprocating motion.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Stroke {
    /// Distance s between the ends, \[m].
    pub length: f64,
    /// Frequency f of the cycles, \[1/s].
    pub frequency: f64,
    /// Time dependence of the position between the ends.
    pub shape: Shape,
}

/// A body that is pressed and moved along x.
///
/// It moves once through a list of points, linearly in time between them, or reciprocates until the limit cycle.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct MovingLoad {
    /// Time at which the motion begins, \[s]; times of the stages count from it, so that they keep their digits.
    start_time: f64,
    /// Stages in the order of time.
    stages: Vec<Stage>,
    /// True for one cycle of a reciprocating motion.
    is_cycle: bool,
}

/// A part of a motion without a jump of the velocity in its interior.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Stage {
    /// First point of the stage.
    pub start: MovingPoint,
    /// Last point of the stage.
    pub end: MovingPoint,
    /// Position as a function of time.
    shape: Shape,
}

impl MovingLoad {
    /// A single motion through at least two points, linear in time from each to the next.
    ///
    /// # Errors
    /// - [`IndenterError::TooFew`] for fewer than two points;
    /// - [`IndenterError::NotIncreasing`] for times that do not increase;
    /// - [`IndenterError::InvalidParameter`] for numbers out of range, for positions that are all the same, and for points of
    ///   which some have a force and some a depth.
    pub fn through_points(points: &[MovingPoint]) -> Result<Self, IndenterError> {
        let [first, .., last] = points else {
            return Err(IndenterError::TooFew {
                list: "points of the motion",
                needed: 2,
                length: points.len(),
            });
        };
        // Check each point: time, position and control must be finite, and all points must prescribe a force, or all a depth.
        let is_force = |point: &MovingPoint| matches!(point.control, Control::NormalForce(_));
        for (index, point) in points.iter().enumerate() {
            finite("time", point.time)?;
            finite("position", point.position)?;
            let value = checked_value(point.control)?;
            let allowed = "a force at all points of a motion, or a depth at all";
            in_range(
                "control",
                value,
                is_force(point) == is_force(first),
                allowed,
            )?;
            if index > 0 && point.time <= points[index - 1].time {
                return Err(IndenterError::NotIncreasing {
                    list: "times of the motion",
                    index,
                    value: point.time,
                    previous: points[index - 1].time,
                });
            }
        }
        positive("duration of the motion", last.time - first.time)?;
        // Turn each interval between two points into a stage, with times relative to the start of the motion.
        let relative_to_start = |point: MovingPoint| MovingPoint {
            time: point.time - first.time,
            ..point
        };
        let stage = |pair: &[MovingPoint]| Stage {
            start: relative_to_start(pair[0]),
            end: relative_to_start(pair[1]),
            shape: Shape::Triangular,
        };
        let load = Self {
            start_time: first.time,
            stages: points.windows(2).map(stage).collect(),
            is_cycle: false,
        };
        // Check that the motion as a whole has a length, and a load above 0 at one point at least.
        positive("length of the motion", load.length())?;
        let allowed = "above 0 at one point of the motion at least";
        let largest = load.largest_control().value();
        in_range("control", largest, largest > 0.0, allowed)?;
        Ok(load)
    }

    /// A reciprocating motion under a constant force or depth; a cycle begins and ends at the rear end of the stroke.
    ///
    /// # Errors
    /// [`IndenterError::InvalidParameter`] when force or depth, stroke, frequency, or the speed that follows from them is not
    /// finite and greater than zero.
    pub fn reciprocating(control: Control, stroke: Stroke) -> Result<Self, IndenterError> {
        positive("control", checked_value(control)?)?;
        let half = 0.5 * positive("stroke", stroke.length)?;
        let duration = 0.5 / positive("frequency", stroke.frequency)?;
        positive("half a period", duration)?;
        positive("stroke times frequency", stroke.length / duration)?;
        let stage = |number: f64, from: f64| {
            let point = |time: f64, position| MovingPoint {
                time: time * duration,
                position,
                control,
            };
            Stage {
                start: point(number, from),
                end: point(number + 1.0, -from),
                shape: stroke.shape,
            }
        };
        Ok(Self {
            start_time: 0.0,
            stages: vec![stage(0.0, -half), stage(1.0, half)],
            is_cycle: true,
        })
    }

    /// Whether the motion reciprocates.
    pub const fn is_cycle(&self) -> bool {
        self.is_cycle
    }

    /// Time at which the motion begins, \[s].
    pub const fn start_time(&self) -> f64 {
        self.start_time
    }

    /// Stages of the motion, or of one cycle, with times that count from its beginning; at least one.
    pub fn stages(&self) -> &[Stage] {
        &self.stages
    }

    /// Duration of the motion, or of one cycle, \[s].
    pub fn duration(&self) -> f64 {
        self.stages[self.stages.len() - 1].end.time
    }

    /// Length of the path, or of the path of one cycle, \[m].
    pub fn length(&self) -> f64 {
        self.stages.iter().map(|stage| stage.distance().abs()).sum()
    }

    /// Rearmost and foremost position, \[m].
    pub fn range(&self) -> [f64; 2] {
        let first = self.stages[0].start.position;
        let ends = self.stages.iter().map(|stage| stage.end.position);
        ends.fold([first; 2], |[low, high], end| [low.min(end), high.max(end)])
    }

    /// Largest speed of the motion, \[m/s].
    pub fn fastest(&self) -> f64 {
        self.stages.iter().map(Stage::fastest).fold(0.0, f64::max)
    }

    /// Largest force or depth of the motion.
    pub fn largest_control(&self) -> Control {
        let first = self.stages[0].start.control;
        let ends = self.stages.iter().map(|stage| stage.end.control.value());
        first.with(ends.fold(first.value(), f64::max))
    }
}

impl Stage {
    /// Point after a fraction of the duration, from 0 to 1.
    pub fn point_at(&self, part: f64) -> MovingPoint {
        let (start, end) = (&self.start, &self.end);
        let path_fraction = match self.shape {
            Shape::Sinusoidal => (std::f64::consts::FRAC_PI_2 * part).sin().powi(2),
            Shape::Triangular => part,
        };
        // Interpolate between the ends of the stage; if both ends are equal, the result has no rounding error.
        let interpolate = |from: f64, to: f64, part: f64| from + (to - from) * part;
        let control = interpolate(start.control.value(), end.control.value(), part);
        MovingPoint {
            time: interpolate(start.time, end.time, part),
            position: interpolate(start.position, end.position, path_fraction),
            control: start.control.with(control),
        }
    }

    /// Velocity after a fraction of the duration, from 0 to 1, \[m/s].
    pub fn velocity(&self, part: f64) -> f64 {
        let mean = self.distance() / self.duration();
        match self.shape {
            Shape::Sinusoidal => {
                self.peak_to_mean_speed() * (std::f64::consts::PI * part).sin() * mean
            }
            Shape::Triangular => mean,
        }
    }

    /// Time dependence of the position between the ends.
    pub const fn shape(&self) -> Shape {
        self.shape
    }

    /// Duration of the stage, \[s].
    pub fn duration(&self) -> f64 {
        self.end.time - self.start.time
    }

    /// Displacement from the start to the end, negative backwards, \[m].
    pub fn distance(&self) -> f64 {
        self.end.position - self.start.position
    }

    /// Ratio of the largest to the mean speed: π/2 for a sinusoidal stage, else 1.
    pub(crate) const fn peak_to_mean_speed(&self) -> f64 {
        match self.shape {
            Shape::Sinusoidal => std::f64::consts::FRAC_PI_2,
            Shape::Triangular => 1.0,
        }
    }

    /// Largest speed of the stage, \[m/s].
    pub fn fastest(&self) -> f64 {
        self.peak_to_mean_speed() * self.distance().abs() / self.duration()
    }
}

/// Value of a force ≥ 0 \[N], or of a depth of either sign \[m]; refuses others and numbers that are not finite.
fn checked_value(control: Control) -> Result<f64, InvalidParameter> {
    match control {
        Control::NormalForce(force) => not_negative("normal_force", force),
        Control::IndentationDepth(depth) => finite("indentation_depth", depth),
    }
}
