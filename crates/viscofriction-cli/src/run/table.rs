//! Printed tables of an answer.

use std::iter;

use comfy_table::Table;
use viscofriction::quantity::differentiated;
use viscofriction::scene::Model;
use viscofriction::solve::{Answer, Problem};
use viscofriction::{ErrorParts, Estimate, QUANTITIES, Quantity};

use crate::output::markdown;

/// A printed quantity of the answer.
struct Line {
    name: String,
    /// Value, error and unit.
    value: String,
    /// Standard error due to the covariance of the material; `None` if it is not known.
    material_error: Option<f64>,
}

/// All known quantities of the answer, and what theory gives for some.
fn lines(answer: &Answer) -> Vec<Line> {
    let material_errors = answer.budget.material();
    let line = |quantity: &Quantity| {
        let known = (quantity.of)(answer)?;
        let value = format!("{known} {}", quantity.unit_in(answer));
        Some(Line {
            name: quantity.name(),
            value: value.trim_end().to_owned(),
            material_error: material_errors.of(quantity.key),
        })
    };
    let theories = answer.persson.iter().flat_map(|theory| {
        [
            ("friction, Persson (2006)", theory.friction_coefficient_2006),
            ("area fraction, Xu (2024)", theory.area_fraction_xu),
        ]
        .map(|(name, number)| Line {
            name: name.to_owned(),
            value: Estimate::exact(number).to_string(),
            material_error: None,
        })
    });
    QUANTITIES.iter().filter_map(line).chain(theories).collect()
}

/// The quantities of an answer with errors and units as aligned lines for a terminal.
pub(super) fn listed(answer: &Answer) -> String {
    let lines = lines(answer);
    let width = |text: fn(&Line) -> &str| {
        let widths = lines.iter().map(|line| text(line).chars().count());
        widths.max().unwrap_or(0)
    };
    let [names, values] = [width(|line| &line.name), width(|line| &line.value)];
    let line = |line: &Line| {
        let Line { name, value, .. } = line;
        match line.material_error {
            Some(error) => {
                format!("{name:<names$}   {value:<values$}   ± {error:.1e} by the material")
            }
            None => format!("{name:<names$}   {value}"),
        }
    };
    lines.iter().map(line).collect::<Vec<_>>().join("\n")
}

/// Quantities as a table of the report.
pub(super) fn table(answer: &Answer) -> Table {
    let mut table = markdown("quantity | value | error by the material");
    for line in lines(answer) {
        let error = line.material_error.map(|error| format!("{error:.1e}"));
        table.add_row([line.name, line.value, error.unwrap_or_default()]);
    }
    table
}

/// One row per number of the scene with the known derivatives; a computed quantity has a column if it has none of them too.
pub(super) fn sensitivity(answer: &Answer) -> Table {
    let all = &answer.sensitivity;
    let is_shown = |quantity: &&Quantity| {
        let is_computed = (quantity.of)(answer).is_some_and(|known| known.error > 0.0);
        is_computed
            || all
                .iter()
                .any(|one| one.derivatives.of(quantity.key).is_some())
    };
    let columns: Vec<&Quantity> = differentiated().filter(is_shown).collect();
    let heads = columns
        .iter()
        .map(|column| format!(" | d ln {}", column.name()));
    let mut table = markdown(&format!("by d ln{}", heads.collect::<String>()));
    for one in all {
        let known = columns.iter().map(|column| one.derivatives.of(column.key));
        let cells = known
            .map(|known| known.map_or_else(|| "not known".to_owned(), |known| known.to_string()));
        table.add_row(iter::once(one.parameter.clone()).chain(cells));
    }
    table
}

/// One row per source of uncertainty, relative to each quantity.
pub(super) fn budget(answer: &Answer) -> Table {
    let rows = answer.budget.rows();
    let column = |quantity: &'static Quantity| {
        let value = (quantity.of)(answer)?.value.abs();
        let mut known = rows.iter().filter_map(|(_, known)| known.of(quantity.key));
        known.next().map(|_| (quantity, value))
    };
    let columns: Vec<(&Quantity, f64)> = differentiated().filter_map(column).collect();
    let heads = columns
        .iter()
        .map(|(column, _)| format!(" | u of {}", column.name()));
    let mut table = markdown(&format!("source{}", heads.collect::<String>()));
    for (source, known) in &rows {
        let cells = columns.iter().map(|(column, value)| {
            let part = known.of(column.key).map(|known| 100.0 * known / value);
            part.map_or_else(String::new, |part| format!("{part:.3} %"))
        });
        table.add_row(iter::once((*source).to_owned()).chain(cells));
    }
    table
}

/// Parts of the error estimate; `None` if the method has none.
pub(super) fn parts(parts: &ErrorParts) -> Option<String> {
    let shown: Vec<String> = parts
        .named()
        .into_iter()
        .filter_map(|(name, part)| Some((name.replace('_', " "), part?)))
        .filter(|(_, part)| *part > 0.0)
        .map(|(name, part)| format!("{name} {part:.1e}"))
        .collect();
    (!shown.is_empty()).then(|| shown.join(", "))
}

/// Sentence about the ensemble; `None` for a single surface.
pub(super) fn scatter(answer: &Answer) -> Option<String> {
    let ensemble = answer.ensemble.as_ref()?;
    let words = ensemble.scatter.iter().map(|(key, one)| {
        let [error, scatter] = [one.standard_error, one.standard_deviation];
        let name = key.replace('_', " ");
        format!("of the {name} {error:.1e}, with a scatter of {scatter:.1e}")
    });
    let words: Vec<String> = words.collect();
    let more = match ensemble.on_coarse_grid {
        0 => String::new(),
        more => format!(" and {more} more on a coarse grid"),
    };
    let count = ensemble.realisations.len();
    (!words.is_empty()).then(|| {
        format!(
            "mean of {count} surfaces{more}; standard error {}",
            words.join("; ")
        )
    })
}

/// Table of the omissions with reasons and savings.
pub(super) fn omissions(problem: &Problem, answer: &Answer) -> Table {
    let mut omissions = markdown("left out | because | what that saves");
    for &omission in &answer.left_out {
        let saved = omission.saves(problem, answer);
        omissions.add_row([omission.name(), omission.because().to_owned(), saved]);
    }
    omissions
}

/// A time to 0.01 s, below 0.1 s to 0.001 s.
pub(super) fn duration(seconds: f64) -> String {
    let digits = if seconds < 0.1 { 3 } else { 2 };
    format!("{seconds:.digits$} s")
}

/// The model of an answer in words: layer with its thickness, half space, or one-dimensional model.
pub(super) fn model(problem: &Problem, answer: &Answer) -> String {
    match answer.model {
        Model::HalfSpace if problem.thickness().is_finite() => {
            format!("layer of {:?} m", problem.thickness())
        }
        Model::HalfSpace => "half space".to_owned(),
        Model::Line => "one-dimensional model".to_owned(),
    }
}
