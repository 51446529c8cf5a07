//! Printed tables of an answer.

use std::iter;

use comfy_table::Table;
use viscofriction::scene::Model;
use viscofriction::solve::{Answer, Problem, Scatter, Uncertainties};
use viscofriction::{ErrorParts, Estimate};

use crate::output::markdown;

/// A printed quantity of the answer.
struct Line {
    name: &'static str,
    /// Value, error and unit.
    value: String,
    /// Standard error due to the covariance of the material; `None` if it is not known.
    material_error: Option<f64>,
}

/// All known quantities of the answer.
fn lines(answer: &Answer) -> Vec<Line> {
    let [force, area] = if answer.is_per_length {
        ["N/m", "m²/m"]
    } else {
        ["N", "m²"]
    };
    let rows = [
        ("friction coefficient", answer.friction_coefficient, ""),
        ("peak friction", answer.peak_friction, ""),
        ("dissipated energy", answer.dissipated_energy, "J"),
        ("normal force", Some(answer.normal_force), force),
        ("tangential force", answer.tangential_force(), force),
        ("indentation depth", answer.indentation_depth, "m"),
        ("contact area", answer.contact_area, area),
        ("peak pressure", answer.peak_pressure, "Pa"),
    ];
    let of_rough = answer.rough.map(|rough| {
        let theory = rough.persson;
        let friction = theory.map(|theory| Estimate::exact(theory.friction_coefficient_2006));
        let area = theory.map(|theory| Estimate::exact(theory.area_fraction_xu));
        let dissipation = rough.friction_from_dissipation;
        [
            ("friction by dissipation", dissipation, ""),
            ("mean pressure", Some(rough.mean_pressure), "Pa"),
            ("area fraction", Some(rough.area_fraction), ""),
            ("friction, Persson (2006)", friction, ""),
            ("area fraction, Xu (2024)", area, ""),
        ]
    });
    let rows = rows.into_iter().chain(of_rough.into_iter().flatten());
    let material_errors = answer.budget.material();
    rows.filter_map(|(name, known, unit)| {
        Some(Line {
            name,
            value: format!("{} {unit}", known?).trim_end().to_owned(),
            material_error: material_errors.of(&name.replace(' ', "_")),
        })
    })
    .collect()
}

/// Quantities as aligned lines.
pub(super) fn listed(answer: &Answer) -> String {
    let lines = lines(answer);
    let width = |text: fn(&Line) -> &str| {
        let widths = lines.iter().map(|line| text(line).chars().count());
        widths.max().unwrap_or(0)
    };
    let [names, values] = [width(|line| line.name), width(|line| &line.value)];
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
        table.add_row([line.name.to_owned(), line.value, error.unwrap_or_default()]);
    }
    table
}

/// One row per number of the scene with the known derivatives; the contact area has a column if it is known itself.
pub(super) fn sensitivity(answer: &Answer) -> Table {
    let all = &answer.sensitivity;
    let names = all
        .first()
        .map_or([""; 4], |first| first.named().map(|(name, _)| name));
    let is_shown = |column: &usize| {
        let is_known = all.iter().any(|one| one.named()[*column].1.is_some());
        is_known || names[*column] == "contact_area" && answer.contact_area.is_some()
    };
    let columns: Vec<usize> = (0..names.len()).filter(is_shown).collect();
    let heads = columns
        .iter()
        .map(|&column| format!("d ln {}", names[column].replace('_', " ")));
    let heads: Vec<String> = iter::once("by d ln".to_owned()).chain(heads).collect();
    let mut table = markdown(&heads.join(" | "));
    for one in all {
        let known = columns.iter().map(|&column| one.named()[column].1);
        let cells = known
            .map(|known| known.map_or_else(|| "not known".to_owned(), |known| known.to_string()));
        table.add_row(iter::once(one.parameter.clone()).chain(cells));
    }
    table
}

/// One row per source of uncertainty, relative to each quantity.
pub(super) fn budget(answer: &Answer) -> Table {
    let total = ("total", answer.budget.total());
    let entries = answer.budget.entries.iter();
    let entries = entries.map(|(source, known)| (source.name(), *known));
    let rows: Vec<(&str, Uncertainties)> = entries.chain([total]).collect();
    let quantities = [
        ("friction coefficient", answer.friction_coefficient),
        ("normal force", Some(answer.normal_force)),
        ("indentation depth", answer.indentation_depth),
        ("contact area", answer.contact_area),
    ];
    let known = |name: &str| {
        rows.iter()
            .any(|(_, known)| known.of(&name.replace(' ', "_")).is_some())
    };
    let columns = quantities.into_iter().filter(|(name, _)| known(name));
    let columns: Vec<(&str, f64)> = columns
        .filter_map(|(name, value)| Some((name, value?.value)))
        .collect();
    let heads = columns.iter().map(|(name, _)| format!(" | u of {name}"));
    let mut table = markdown(&format!("source{}", heads.collect::<String>()));
    for (source, known) in &rows {
        let cells = columns.iter().map(|(name, value)| {
            let part = known
                .of(&name.replace(' ', "_"))
                .map(|known| 100.0 * known / value.abs());
            part.map_or_else(String::new, |part| format!("{part:.3} %"))
        });
        table.add_row(iter::once((*source).to_owned()).chain(cells));
    }
    table
}

/// Parts of the error estimate; `None` if the method has none.
pub(super) fn parts(parts: &ErrorParts) -> Option<String> {
    let known = parts.named().into_iter();
    let known = known.filter_map(|(name, part)| Some((name.replace('_', " "), part?)));
    let known = known.filter(|(_, part)| *part > 0.0);
    let parts = known.map(|(name, part)| format!("{name} {part:.1e}"));
    let parts: Vec<String> = parts.collect();
    (!parts.is_empty()).then(|| parts.join(", "))
}

/// Sentence about the ensemble; `None` for a single surface.
pub(super) fn scatter(answer: &Answer) -> Option<String> {
    let known = answer.scatters().into_iter();
    let known = known.filter_map(|(name, scatter)| Some((name.replace('_', " "), scatter?)));
    let words = known.map(|(name, one): (String, Scatter)| {
        let [error, scatter] = [one.standard_error, one.standard_deviation];
        format!("of the {name} {error:.1e}, with a scatter of {scatter:.1e}")
    });
    let words: Vec<String> = words.collect();
    let ensemble = answer.ensemble.as_ref()?;
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

/// The model in words.
pub(super) fn model(problem: &Problem, answer: &Answer) -> String {
    match answer.model {
        Model::HalfSpace if problem.thickness().is_finite() => {
            format!("layer of {:?} m", problem.thickness())
        }
        Model::HalfSpace => "half space".to_owned(),
        Model::Line => "one-dimensional model".to_owned(),
    }
}
