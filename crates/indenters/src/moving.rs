//! How a body is moved along the surface while it is pressed: once through points, or to and fro.
//!
//! ```text
//! x(t) = x₀ + (x₁ − x₀) ξ,   or   x₀ + (x₁ − x₀) (1 − cos π ξ)/2,     ξ = (t − t₀)/(t₁ − t₀)
//! ```

use crate::{Control, IndenterError};
use numerics::{InvalidParameter, finite, in_range, not_negative, positive};

/// Where a body is at one time, and how it is pressed there.
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

/// How a body moves from one end of its stroke to the other.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub enum Shape {
    /// Like a crank: x = −(s/2) cos(2π f t).
    #[default]
    Sinusoidal,
    /// With constant speed, which turns at the ends.
    Triangular,
}

/// To and fro without end.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Stroke {
    /// Distance s from one end to the other, \[m].
    pub length: f64,
    /// Cycles per second f, \[1/s].
    pub frequency: f64,
    /// How it moves between the ends.
    pub shape: Shape,
}

/// A body that is pressed and moved along x: once through points, straight between them, or to and fro until every cycle is
/// like the one before.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct MovingLoad {
    /// Times of the stages are those since then, \[s], whose digits a date would take away.
    begins: f64,
    stages: Vec<Stage>,
    is_cycle: bool,
}

/// A part of a motion without a jump of the velocity inside.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Stage {
    /// Where it begins.
    pub start: MovingPoint,
    /// Where it ends.
    pub end: MovingPoint,
    shape: Shape,
}

impl MovingLoad {
    /// Once through at least two points, straight from each to the next.
    ///
    /// # Errors
    /// [`IndenterError::TooFew`] points; [`IndenterError::NotIncreasing`] times; [`IndenterError::InvalidParameter`] for
    /// numbers out of range, for positions that are all the same, and for points of which some have a force and some a depth.
    pub fn through(points: &[MovingPoint]) -> Result<Self, IndenterError> {
        let [first, .., last] = points else {
            return Err(IndenterError::TooFew {
                list: "points of the motion",
                needed: 2,
                length: points.len(),
            });
        };
        let is_force = |point: &MovingPoint| matches!(point.control, Control::NormalForce(_));
        for (index, point) in points.iter().enumerate() {
            finite("time", point.time)?;
            finite("position", point.position)?;
            let value = checked(point.control)?;
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
        let since = |point: MovingPoint| MovingPoint {
            time: point.time - first.time,
            ..point
        };
        let stage = |pair: &[MovingPoint]| Stage {
            start: since(pair[0]),
            end: since(pair[1]),
            shape: Shape::Triangular,
        };
        let load = Self {
            begins: first.time,
            stages: points.windows(2).map(stage).collect(),
            is_cycle: false,
        };
        positive("length of the motion", load.length())?;
        let allowed = "above 0 at one point of the motion at least";
        let largest = load.largest_control().value();
        in_range("control", largest, largest > 0.0, allowed)?;
        Ok(load)
    }

    /// To and fro, pressed as `control` says; a cycle begins and ends at rest at the rear end of the stroke.
    ///
    /// # Errors
    /// [`IndenterError::InvalidParameter`] when force or depth, stroke, frequency, or the speed that follows from them is not
    /// finite and greater than zero.
    pub fn reciprocating(control: Control, stroke: Stroke) -> Result<Self, IndenterError> {
        positive("control", checked(control)?)?;
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
            begins: 0.0,
            stages: vec![stage(0.0, -half), stage(1.0, half)],
            is_cycle: true,
        })
    }

    /// Whether the motion repeats itself without end.
    pub const fn is_cycle(&self) -> bool {
        self.is_cycle
    }

    /// When the motion begins, \[s].
    pub const fn begins(&self) -> f64 {
        self.begins
    }

    /// The parts of the motion, or of one cycle, in times after its beginning; at least one.
    pub fn stages(&self) -> &[Stage] {
        &self.stages
    }

    /// How long the motion, or a cycle of it, takes, \[s].
    pub fn duration(&self) -> f64 {
        self.stages[self.stages.len() - 1].end.time
    }

    /// Length of the path, or of one cycle of it, \[m].
    pub fn length(&self) -> f64 {
        self.stages.iter().map(|stage| stage.distance().abs()).sum()
    }

    /// The rearmost and the foremost position, \[m].
    pub fn range(&self) -> [f64; 2] {
        let first = self.stages[0].start.position;
        let ends = self.stages.iter().map(|stage| stage.end.position);
        ends.fold([first; 2], |[low, high], end| [low.min(end), high.max(end)])
    }

    /// Largest speed, \[m/s].
    pub fn fastest(&self) -> f64 {
        self.stages.iter().map(Stage::fastest).fold(0.0, f64::max)
    }

    /// The largest force or depth.
    pub fn largest_control(&self) -> Control {
        let first = self.stages[0].start.control;
        let ends = self.stages.iter().map(|stage| stage.end.control.value());
        first.with(ends.fold(first.value(), f64::max))
    }

    /// Whether force or depth is the same all the time.
    pub fn is_held(&self) -> bool {
        let first = self.stages[0].start.control;
        self.stages.iter().all(|stage| stage.end.control == first)
    }
}

impl Stage {
    /// After a part of its time, from 0 to 1.
    pub fn at(&self, part: f64) -> MovingPoint {
        let (start, end) = (&self.start, &self.end);
        let way = match self.shape {
            Shape::Sinusoidal => (std::f64::consts::FRAC_PI_2 * part).sin().powi(2),
            Shape::Triangular => part,
        };
        // Exact where both are the same.
        let between = |from: f64, to: f64, part: f64| from + (to - from) * part;
        let control = between(start.control.value(), end.control.value(), part);
        MovingPoint {
            time: between(start.time, end.time, part),
            position: between(start.position, end.position, way),
            control: start.control.with(control),
        }
    }

    /// Velocity after a part of its time, from 0 to 1, \[m/s].
    pub fn velocity(&self, part: f64) -> f64 {
        let mean = self.distance() / self.duration();
        match self.shape {
            Shape::Sinusoidal => self.haste() * (std::f64::consts::PI * part).sin() * mean,
            Shape::Triangular => mean,
        }
    }

    /// How it moves between its ends.
    pub const fn shape(&self) -> Shape {
        self.shape
    }

    /// How long it takes, \[s].
    pub fn duration(&self) -> f64 {
        self.end.time - self.start.time
    }

    /// How far it goes, negative backwards, \[m].
    pub fn distance(&self) -> f64 {
        self.end.position - self.start.position
    }

    /// Largest speed over the mean one.
    pub const fn haste(&self) -> f64 {
        match self.shape {
            Shape::Sinusoidal => std::f64::consts::FRAC_PI_2,
            Shape::Triangular => 1.0,
        }
    }

    /// Largest speed, \[m/s].
    pub fn fastest(&self) -> f64 {
        self.haste() * self.distance().abs() / self.duration()
    }
}

fn checked(control: Control) -> Result<f64, InvalidParameter> {
    match control {
        Control::NormalForce(force) => not_negative("normal_force", force),
        Control::IndentationDepth(depth) => finite("indentation_depth", depth),
    }
}
