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
        self.n_steps(elements, spacing, allowed)?;
        let mut steps: Vec<MovingStep> = Vec::new();
        for (index, stage) in self.stages().iter().enumerate() {
            let fewest = fewest(stage, elements, spacing);
            let parts = if self.is_cycle() {
                even(fewest.ceil()).collect()
            } else {
                let before = steps.last().map(|step| step.duration);
                Graded::new(stage, before, fewest, elements).ends_and_lengths()
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
        }
        Ok(steps)
    }

    /// Number of [`steps`](Self::steps), without the memory that they take.
    ///
    /// # Errors
    /// As for [`steps`](Self::steps).
    pub fn n_steps(
        &self,
        elements: usize,
        spacing: f64,
        allowed: f64,
    ) -> Result<f64, IndenterError> {
        let fewest = |stage: &Stage| fewest(stage, elements, spacing);
        let mut steps: f64 = self.stages().iter().map(|stage| fewest(stage).ceil()).sum();
        if !self.is_cycle() && steps <= allowed {
            let mut before = None;
            let graded = self.stages().iter().map(|stage| {
                let graded = Graded::new(stage, before, fewest(stage), elements);
                before = Some(graded.equal() * stage.duration());
                graded.growing.len() as f64 + graded.n_equal
            });
            steps = graded.sum();
        }
        if steps > allowed {
            return Err(IndenterError::TooManySteps { steps, allowed });
        }
        Ok(steps)
    }
}

/// Length of a stage over that of its longest step.
fn fewest(stage: &Stage, elements: usize, spacing: f64) -> f64 {
    let ways = stage.haste() * stage.distance().abs() / spacing;
    ways.max(STEPS_PER_ELEMENT * elements as f64).max(2.0)
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

/// Ends and lengths of equal steps, in parts of the whole.
fn even(count: f64) -> impl Iterator<Item = (f64, f64)> {
    let length = count.recip();
    let ends = (1_u32..).map(f64::from).take_while(move |k| *k <= count);
    ends.map(move |k| (k / count, length))
}

/// Steps that grow up to the longest, and equal ones that fill the rest, in parts of the whole.
struct Graded {
    growing: Vec<f64>,
    n_equal: f64,
    /// Length of the equal steps together.
    rest: f64,
}

impl Graded {
    /// Of a stage whose step before took so long, and which has at least the fewest steps.
    fn new(stage: &Stage, before: Option<f64>, fewest: f64, elements: usize) -> Self {
        let longest = fewest.recip();
        let growth = (ELEMENTS_PER_GROWTH * elements as f64).recip().exp();
        let mut growing = Vec::new();
        // From 0 nothing grows.
        let mut length = first_step(stage, before, longest).max(f64::MIN_POSITIVE);
        let mut sum = 0.0;
        while length < longest && sum + length < 1.0 {
            growing.push(length);
            sum += length;
            length *= growth;
        }
        let rest = 1.0 - sum;
        Self {
            growing,
            n_equal: (rest / longest).ceil(),
            rest,
        }
    }

    /// Length of an equal step.
    fn equal(&self) -> f64 {
        self.n_equal.recip() * self.rest
    }

    fn ends_and_lengths(&self) -> Vec<(f64, f64)> {
        let equal = even(self.n_equal).map(|_| self.equal());
        let mut end = 0.0;
        let lengths = self.growing.iter().copied().chain(equal);
        let mut steps: Vec<(f64, f64)> = lengths
            .map(|length| {
                end += length;
                (end, length)
            })
            .collect();
        if let Some((end, _)) = steps.last_mut() {
            *end = 1.0;
        }
        steps
    }
}
