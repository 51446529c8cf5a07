//! Time steps of a motion: at most one element long, graded geometrically after the start, a stop or a turn.

use crate::{IndenterError, MovingLoad, MovingPoint, Stage};

/// Smallest number of steps of a stage per element along the contact, for stages shorter than a contact. Chosen: time is then
/// resolved as finely as the contact.
const STEPS_PER_ELEMENT: f64 = 1.0;
/// Number of steps in which the step length grows e-fold, per element along the contact. Chosen: refinement of the elements
/// refines the growth too.
const E_FOLDING_STEPS_PER_ELEMENT: f64 = 0.125;
/// Ratio of the first step of a motion to the longest step of its first stage. Chosen: it resolves the response to first contact,
/// also in a hold, which may be long and begins with a load that is applied instantaneously.
const FIRST_STEP_FRACTION: f64 = 1e-6;
/// Ratio of the first step of a moving stage that follows another one to its longest step. Chosen: the velocity may jump between
/// them.
const STEP_AFTER_TURN_FRACTION: f64 = 0.02;

/// One step of a motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MovingStep {
    /// Index of the stage.
    pub stage: usize,
    /// Duration, \[s]; equal steps have equal durations to the last bit.
    pub duration: f64,
    /// Point at the end of the step.
    pub end: MovingPoint,
    /// Velocities at the beginning and at the end of the step, \[m/s].
    pub velocities: [f64; 2],
}

impl MovingLoad {
    /// Time steps of the motion, or of one cycle, for a contact of `elements` along x with the given `spacing` \[m].
    ///
    /// No step is longer than an element; the number of steps of a stage is at least that of the elements.
    ///
    /// # Errors
    /// [`IndenterError::TooManySteps`] for more than `allowed` steps.
    pub fn steps(
        &self,
        elements: usize,
        spacing: f64,
        allowed: f64,
    ) -> Result<Vec<MovingStep>, IndenterError> {
        self.n_steps(elements, spacing, allowed)?;
        let mut steps: Vec<MovingStep> = Vec::new();
        for (index, stage) in self.stages().iter().enumerate() {
            let min_steps = min_steps(stage, elements, spacing);
            // Divide a stage of a cycle into equal steps; for a single motion the steps grow from a short first one.
            let parts = if self.is_cycle() {
                equal_parts(min_steps.ceil()).collect()
            } else {
                let previous_duration = steps.last().map(|step| step.duration);
                Graded::new(stage, previous_duration, min_steps, elements).parts()
            };
            let mut from = stage.velocity(0.0);
            steps.extend(parts.into_iter().map(|part| {
                let to = stage.velocity(part.end);
                MovingStep {
                    stage: index,
                    duration: part.length * stage.duration(),
                    end: point_at(stage, part.end),
                    velocities: [std::mem::replace(&mut from, to), to],
                }
            }));
        }
        Ok(steps)
    }

    /// Number of [`steps`](Self::steps), without storing them.
    ///
    /// # Errors
    /// [`IndenterError::TooManySteps`] for more than `allowed` steps.
    pub fn n_steps(
        &self,
        elements: usize,
        spacing: f64,
        allowed: f64,
    ) -> Result<f64, IndenterError> {
        let min_steps = |stage: &Stage| min_steps(stage, elements, spacing);
        let mut steps: f64 = self
            .stages()
            .iter()
            .map(|stage| min_steps(stage).ceil())
            .sum();
        // Steps of a single motion are graded, hence more; they are counted only if the smallest number is allowed.
        if !self.is_cycle() && steps <= allowed {
            let mut previous_duration = None;
            let graded = self.stages().iter().map(|stage| {
                let graded = Graded::new(stage, previous_duration, min_steps(stage), elements);
                previous_duration = Some(graded.equal_length() * stage.duration());
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

/// Smallest number of steps of a stage, not rounded: its duration divided by that of its longest step, on `elements` along the
/// contact of a `spacing` \[m].
fn min_steps(stage: &Stage, elements: usize, spacing: f64) -> f64 {
    let path_in_elements = stage.peak_to_mean_speed() * stage.distance().abs() / spacing;
    path_in_elements
        .max(STEPS_PER_ELEMENT * elements as f64)
        .max(2.0)
}

/// Length of the first step of a stage, relative to the stage, like that of the `longest` one; `previous_duration` \[s] is that of the
/// step before it, `None` at the beginning of a motion.
fn first_step_length(stage: &Stage, previous_duration: Option<f64>, longest: f64) -> f64 {
    let is_hold = stage.distance() == 0.0;
    let first = match previous_duration {
        None => FIRST_STEP_FRACTION * longest,
        Some(step) if is_hold => step / stage.duration(),
        Some(_) => STEP_AFTER_TURN_FRACTION * longest,
    };
    first.min(longest)
}

/// Point after a fraction of a stage; exactly its end for 1.
fn point_at(stage: &Stage, part: f64) -> MovingPoint {
    if part >= 1.0 {
        stage.end
    } else {
        stage.point_at(part)
    }
}

/// A step of a stage, relative to the duration of the stage.
#[derive(Clone, Copy)]
struct StagePart {
    /// End of the step.
    end: f64,
    /// Length of the step.
    length: f64,
}

/// Equal steps of a stage whose number is `count`, a whole number.
fn equal_parts(count: f64) -> impl Iterator<Item = StagePart> {
    let length = count.recip();
    let ends = (1_u32..).map(f64::from).take_while(move |k| *k <= count);
    ends.map(move |k| StagePart {
        end: k / count,
        length,
    })
}

/// Geometrically growing steps up to the longest, then equal ones; lengths are relative to the stage.
struct Graded {
    /// Lengths of the growing steps.
    growing: Vec<f64>,
    /// Number of equal steps, a whole number.
    n_equal: f64,
    /// Total length of the equal steps.
    equal_total: f64,
}

impl Graded {
    /// Steps of a stage after a step of `previous_duration` \[s].
    fn new(stage: &Stage, previous_duration: Option<f64>, min_steps: f64, elements: usize) -> Self {
        let longest = min_steps.recip();
        let growth = (E_FOLDING_STEPS_PER_ELEMENT * elements as f64)
            .recip()
            .exp();
        let mut growing = Vec::new();
        // A length that underflows to 0 would not grow.
        let mut length =
            first_step_length(stage, previous_duration, longest).max(f64::MIN_POSITIVE);
        let mut sum = 0.0;
        while length < longest && sum + length < 1.0 {
            growing.push(length);
            sum += length;
            length *= growth;
        }
        let equal_total = 1.0 - sum;
        Self {
            growing,
            n_equal: (equal_total / longest).ceil(),
            equal_total,
        }
    }

    /// Length of one of the equal steps, relative to the stage.
    fn equal_length(&self) -> f64 {
        self.n_equal.recip() * self.equal_total
    }

    /// Steps of the stage in the order of time, growing ones before equal ones.
    fn parts(&self) -> Vec<StagePart> {
        let equal = equal_parts(self.n_equal).map(|_| self.equal_length());
        let mut end = 0.0;
        let lengths = self.growing.iter().copied().chain(equal);
        let mut parts: Vec<StagePart> = lengths
            .map(|length| {
                end += length;
                StagePart { end, length }
            })
            .collect();
        // End the last step exactly at the end of the stage, because the sum of the lengths is 1 only up to rounding.
        if let Some(last) = parts.last_mut() {
            last.end = 1.0;
        }
        parts
    }
}
