//! The steps of a motion: as long as an element where it moves, longer and longer after it has stopped or begun.

use crate::{IndenterError, MovingLoad, MovingPoint, Stage};

/// Steps of a stage for each element along the contact, at least, where it moves by less than a contact or stops.
const STEPS_PER_ELEMENT: f64 = 1.0;
/// By how many elements along the contact a step grows to e times that of the one before.
const ELEMENTS_PER_GROWTH: f64 = 0.125;
/// First step of a motion, and of one that goes on with another speed, relative to the longest.
const FIRST_STEP: f64 = 1e-4;
const STEP_AFTER_TURN: f64 = 0.02;
/// Of a body that stops before it has moved, relative to the time for which it stops.
const FIRST_STOP: f64 = 1e-6;

/// One step of a motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MovingStep {
    /// Number of its stage.
    pub stage: usize,
    /// How long it takes, \[s]; steps of one length have exactly the same.
    pub duration: f64,
    /// Where it ends.
    pub end: MovingPoint,
    /// Velocities at its beginning and its end, \[m/s].
    pub velocities: [f64; 2],
}

impl MovingLoad {
    /// Steps of the motion, or of one cycle, for a number of elements of this spacing \[m] along the contact: not longer than
    /// an element, and finer in time with the elements.
    ///
    /// # Errors
    /// [`IndenterError::TooManySteps`] for more than are `allowed`.
    pub fn steps(
        &self,
        elements: usize,
        spacing: f64,
        allowed: f64,
    ) -> Result<Vec<MovingStep>, IndenterError> {
        let elements = elements as f64;
        let mut steps = Vec::new();
        let mut before = None;
        for (index, stage) in self.stages().iter().enumerate() {
            let ways = stage.haste() * stage.distance().abs() / spacing;
            let fewest = ways.max(STEPS_PER_ELEMENT * elements).max(2.0);
            let needed = steps.len() as f64 + fewest;
            if needed > allowed {
                let steps = needed;
                return Err(IndenterError::TooManySteps { steps, allowed });
            }
            let parts = if self.is_cycle() {
                even(fewest)
            } else {
                let first = first_step(stage, before, fewest.recip());
                let growth = (ELEMENTS_PER_GROWTH * elements).recip().exp();
                graded(first, growth, fewest.recip())
            };
            let mut from = stage.velocity(0.0);
            steps.extend(parts.into_iter().map(|(part, length)| {
                let to = stage.velocity(part);
                MovingStep {
                    stage: index,
                    duration: length * stage.duration(),
                    end: end_of(stage, part),
                    velocities: [std::mem::replace(&mut from, to), to],
                }
            }));
            before = steps.last().map(|step| step.duration);
        }
        Ok(steps)
    }
}

/// Part of a stage that the first step of it is, where the one before took so long.
fn first_step(stage: &Stage, before: Option<f64>, longest: f64) -> f64 {
    let stops = stage.distance() == 0.0;
    let first = match before {
        None if stops => FIRST_STOP * longest,
        None => FIRST_STEP * longest,
        Some(step) if stops => step / stage.duration(),
        Some(_) => STEP_AFTER_TURN * longest,
    };
    first.min(longest)
}

fn end_of(stage: &Stage, part: f64) -> MovingPoint {
    if part >= 1.0 {
        stage.end
    } else {
        stage.at(part)
    }
}

/// Ends and lengths of equal steps.
fn even(fewest: f64) -> Vec<(f64, f64)> {
    let count = fewest.ceil();
    let length = count.recip();
    let ends = (1_u32..).map(f64::from).take_while(|k| *k <= count);
    ends.map(|k| (k / count, length)).collect()
}

/// Ends and lengths of steps that grow up to the longest, in parts of the whole.
fn graded(first: f64, growth: f64, longest: f64) -> Vec<(f64, f64)> {
    let mut lengths = Vec::new();
    let (mut length, mut sum) = (first, 0.0);
    while length < longest && sum + length < 1.0 {
        lengths.push(length);
        sum += length;
        length *= growth;
    }
    let rest = even((1.0 - sum) / longest);
    lengths.extend(rest.iter().map(|(_, length)| length * (1.0 - sum)));
    let mut end = 0.0;
    let last = lengths.len() - 1;
    let step = |(index, length): (usize, f64)| {
        end += length;
        (if index == last { 1.0 } else { end }, length)
    };
    lengths.into_iter().enumerate().map(step).collect()
}
