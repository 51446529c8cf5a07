//! An answer for a person.

use comfy_table::Table;
use viscofriction::scene::Model;
use viscofriction::solve::Answer;
use viscofriction::{ErrorParts, Estimate};

use crate::output::markdown;

/// One row per quantity, with its error and unit.
pub(super) fn table(answer: &Answer) -> Table {
    let mut table = markdown("quantity | value | error | unit");
    let [force, area] = if answer.is_per_length {
        ["N/m", "m²/m"]
    } else {
        ["N", "m²"]
    };
    let rows = [
        ("friction coefficient", answer.friction_coefficient, ""),
        ("normal force", Some(answer.normal_force), force),
        ("tangential force", answer.tangential_force(), force),
        ("indentation depth", answer.indentation_depth, "m"),
        ("contact area", answer.contact_area, area),
        ("peak pressure", answer.peak_pressure, "Pa"),
    ];
    let of_rough = answer.rough.map(|rough| {
        let (theory, exact) = (rough.persson, Estimate::exact);
        [
            (
                "friction by dissipation",
                rough.friction_from_dissipation,
                "",
            ),
            ("mean pressure", rough.mean_pressure, "Pa"),
            ("area fraction", rough.area_fraction, ""),
            (
                "friction, Persson's theory",
                exact(theory.friction_coefficient),
                "",
            ),
            (
                "area fraction, Persson's theory",
                exact(theory.area_fraction),
                "",
            ),
        ]
        .map(|(name, quantity, unit)| (name, Some(quantity), unit))
    });
    let rows = rows.into_iter().chain(of_rough.into_iter().flatten());
    for (name, known, unit) in rows {
        if let Some(Estimate { value, error }) = known {
            let error = if error == 0.0 {
                String::new()
            } else {
                format!("{error:.1e}")
            };
            table.add_row([name.to_owned(), short(value), error, unit.to_owned()]);
        }
    }
    table
}

/// Nine digits; the JSON has all of them.
fn short(value: f64) -> String {
    if value == 0.0 || (1e-3..1e5).contains(&value.abs()) {
        return format!("{value:.9}");
    }
    format!("{value:.8e}")
}

/// What the error bar consists of; nothing of a method without parts.
pub(super) fn parts(parts: &ErrorParts) -> Option<String> {
    let known = parts.named().into_iter();
    let known = known.filter_map(|(name, part)| Some((name.replace('_', " "), part?)));
    let parts: Vec<String> = known
        .map(|(name, part)| format!("{name} {part:.1e}"))
        .collect();
    (!parts.is_empty()).then(|| parts.join(", "))
}

/// The model in words.
pub(super) const fn model(model: Model) -> &'static str {
    match model {
        Model::Line => "one-dimensional model",
        Model::HalfSpace => "half space",
    }
}
