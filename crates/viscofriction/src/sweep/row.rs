//! One row of a sweep: which point it is, and what came out.

use super::plan::Plan;
use crate::solve::{Answer, Result};

/// The columns before and after the keys that vary.
const BEFORE: [&str; 3] = ["sweep", "point", "points"];

/// The fields of a row; times are not among them, because they differ from run to run.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Row {
    /// Counted from 0.
    pub point: usize,
    /// Texts in the order of the [`header`].
    pub fields: Vec<String>,
}

impl Row {
    /// The row of a point and its answer, or why there is none.
    #[must_use]
    pub fn new(plan: &Plan, point: usize, answer: Result<Answer>) -> Self {
        let mut fields = identity(plan, point);
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

/// The names of the columns.
#[must_use]
pub fn header(plan: &Plan) -> Vec<String> {
    let before = BEFORE.into_iter().chain(plan.keys()).map(str::to_owned);
    let names = ["method", "model"].map(str::to_owned);
    let after = ["unknowns", "failure"].map(str::to_owned);
    let columns = Answer::columns();
    before.chain(names).chain(columns).chain(after).collect()
}

/// What tells a row from every other: sweep, point counted from 1, number of points, values.
#[must_use]
pub fn identity(plan: &Plan, point: usize) -> Vec<String> {
    let values = plan.values(point);
    [
        plan.fingerprint.clone(),
        (point + 1).to_string(),
        plan.n_points().to_string(),
    ]
    .into_iter()
    .chain(values.iter().map(|value| format!("{value:?}")))
    .collect()
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
