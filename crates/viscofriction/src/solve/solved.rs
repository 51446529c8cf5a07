//! An answer with the reason why it misses the request.

use super::answer::Answer;
use super::error::{Result, SolveError};

/// The answer to a problem, whether or not it meets the request.
pub(super) struct Solved {
    /// The answer.
    pub(super) answer: Answer,
    /// Reason why the answer misses the request; `None` if it does not.
    pub(super) missed: Option<Box<SolveError>>,
}

impl Solved {
    /// The answer of a result, also of one that misses the request.
    ///
    /// # Errors
    /// All errors that hold no answer.
    pub(super) fn of(result: Result<Answer>) -> Result<Self> {
        let (answer, missed) = match result {
            Ok(answer) => (answer, None),
            Err(SolveError::NotReached { answer, why }) => (*answer, Some(why)),
            Err(other) => return Err(other),
        };
        Ok(Self { answer, missed })
    }

    /// The answer, as an error if it misses the request.
    pub(super) fn into_result(self) -> Result<Answer> {
        let Some(why) = self.missed else {
            return Ok(self.answer);
        };
        let answer = Box::new(Answer {
            not_reached: Some(why.to_string()),
            ..self.answer
        });
        Err(SolveError::NotReached { answer, why })
    }
}
