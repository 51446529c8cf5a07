//! One row of a sweep: which point it is, and what came out.

use crate::solve::{Answer, Result};

/// The fields of a row; times are not among them, because they differ from run to run.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Row {
    /// Counted from 0.
    pub point: usize,
    /// Texts in the order of the [`header`].
    pub fields: Vec<String>,
}

impl Row {
    /// The row of a point and its answer, or why there is none; `fields` say which point of which sweep it is.
    pub(super) fn new(point: usize, mut fields: Vec<String>, answer: Result<Answer>) -> Self {
        match answer {
            Ok(answer) => fields.extend(results(&answer)),
            Err(error) => {
                fields.extend(vec![String::new(); Answer::columns().len() + 3]);
                // A row is a line.
                fields.push(error.to_string().replace(['\n', '\r'], " "));
            }
        }
        Self { point, fields }
    }

    /// Whether the point has no answer.
    #[must_use]
    pub fn failed(&self) -> bool {
        self.fields
            .last()
            .is_some_and(|failure| !failure.is_empty())
    }
}

fn results(answer: &Answer) -> Vec<String> {
    let number = |value: Option<f64>| value.map_or(String::new(), |value| format!("{value:?}"));
    let mut fields = vec![
        answer.method.name().to_owned(),
        answer.model.name().to_owned(),
    ];
    fields.extend(answer.numbers().into_iter().map(|(_, value)| number(value)));
    fields.push(answer.unknowns.to_string());
    fields.push(String::new());
    fields
}
