//! Gap between body and elastomer around a contact, from the pressure of an answer.

use bem_halfspace::{GapField, periodic, steady};

use super::answer::Answer;
use super::body::Body;
use super::elements::Rough;
use super::error::Result;
use super::heat::pressure_field;
use super::problem::{Motion, Problem};
use super::work::rough;

impl Problem {
    /// Adds the gap to the answer of a problem that [asks](Self::with_gap) for it. Marches in time have it already, because displacements
    /// there depend on the history; without a request it is removed.
    pub(super) fn add_gap(&self, mut answer: Answer) -> Result<Answer> {
        if self.wants_gap() {
            let known = answer.fields.gap.take();
            answer.fields.gap = match known {
                None => self.gap(&answer)?,
                known => known,
            };
        } else {
            answer.fields.gap = None;
        }
        Ok(answer)
    }

    /// Gap of a stationary state or of a pressed periodic surface; `None` for other answers.
    fn gap(&self, answer: &Answer) -> Result<Option<GapField>> {
        let Some(pressure) = pressure_field(answer)? else {
            return Ok(None);
        };
        let elastomer = self.elastomer()?;
        Ok(match (self.motion(), self.body(), answer.stationary) {
            (Motion::Sliding(load), body, Some(options)) => match body.steady_body() {
                Some(body) => steady::gap(body, &elastomer, load, &options, &pressure)?,
                None => None,
            },
            (Motion::Sliding(_) | Motion::Pressing(_), Body::Periodic(surface), None) => {
                match rough(self, surface) {
                    Ok(Rough { load, .. }) => {
                        Some(periodic::gap(surface, &elastomer, &load, &pressure)?)
                    }
                    Err(_) => None,
                }
            }
            _ => None,
        })
    }
}
