//! The steps of a motion: as long as an element where it moves, longer and longer after it has stopped or begun.

use indenters::{MovingLoad, MovingPoint, Stage};

use crate::MdrError;

/// Steps of a motion, or of one cycle, after which it is not begun.
const MOST_STEPS: f64 = 4e6;
/// Steps of a stage for each element along the contact, at least, where it moves by less than a contact or stops.
const STEPS_PER_ELEMENT: f64 = 1.0;
/// By how many elements along the contact a step grows to e times that of the one before.
const ELEMENTS_PER_GROWTH: f64 = 0.125;
/// First step of a motion, and of one that goes on with another speed, relative to the longest.
const FIRST_STEP: f64 = 1e-4;
const STEP_AFTER_TURN: f64 = 0.02;
/// Of a body that stops before it has moved, relative to the time for which it stops.
const FIRST_STOP: f64 = 1e-6;

/// One step.
#[derive(Debug, Clone, Copy)]
pub(super) struct Leg {
    pub(super) stage: usize,
    pub(super) duration: f64,
    pub(super) end: MovingPoint,
}

/// The steps of a motion with a number of elements, of this spacing, along the contact.
pub(super) fn legs(load: &MovingLoad, elements: f64, spacing: f64) -> Result<Vec<Leg>, MdrError> {
    let mut legs = Vec::new();
    let mut before = None;
    for (index, stage) in load.stages().iter().enumerate() {
        let ways = stage.haste() * stage.distance().abs() / spacing;
        let fewest = ways.max(STEPS_PER_ELEMENT * elements).max(2.0);
        if legs.len() as f64 + fewest > MOST_STEPS {
            return Err(MdrError::TooManySteps {
                steps: legs.len() as f64 + fewest,
                allowed: MOST_STEPS,
            });
        }
        let longest = fewest.recip();
        let parts = if load.is_cycle() {
            even(fewest)
        } else {
            let first = match before {
                None if stage.distance() == 0.0 => FIRST_STOP * longest,
                None => FIRST_STEP * longest,
                Some(step) if stage.distance() == 0.0 => step / stage.duration(),
                Some(_) => STEP_AFTER_TURN * longest,
            };
            let growth = (ELEMENTS_PER_GROWTH * elements).recip().exp();
            graded(first.min(longest), growth, longest)
        };
        let leg = |(part, length): (f64, f64)| Leg {
            stage: index,
            duration: length * stage.duration(),
            end: end_of(stage, part),
        };
        legs.extend(parts.into_iter().map(leg));
        before = legs.last().map(|leg| leg.duration);
    }
    Ok(legs)
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
