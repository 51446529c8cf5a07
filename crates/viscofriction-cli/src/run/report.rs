//! report.html: a page about one answer.

use anyhow::Result;
use toml::{Table, Value};
use viscofriction::scene::{Key, Method, Model, Source, keys, schema};
use viscofriction::solve::{Answer, Motion, Problem};
use viscofriction_plot::{Axis, Figure};

use super::files::Pictures;
use super::{AUTOMATIC, Timed, spectrum, table};
use crate::output::markdown;
use crate::page::Page;
use crate::sweep::labelled;

/// The page with all results and the command that reproduces them.
pub(super) fn page(
    (source, problem): (&Source, &Problem),
    timed: &Timed<'_>,
    pictures: &Pictures,
) -> Result<String> {
    let answer = timed.answer;
    let scene = source.table()?;
    let mut page = Page::new(&title(&scene, problem));
    page.paragraph(&method_sentence(problem, timed));
    page.table(&numbers(&scene));
    page.hidden("the scene file", source.text());
    page.heading("The answer");
    if let Some(why) = &answer.not_reached {
        page.paragraph(&format!("What was asked is not reached: {why}."));
    }
    page.table(&table::table(answer));
    page.paragraph(BARS);
    if let Some(parts) = table::parts(&answer.error_parts) {
        page.paragraph(&format!("Parts of the error bar: {parts}."));
    }
    page.heading("How far to trust it");
    if let Some(scatter) = table::scatter(answer) {
        page.paragraph(&format!("{scatter}."));
    }
    if answer.warnings.is_empty() {
        page.paragraph("No warning: slopes and depths are within linear theory, as far as this program can tell.");
    } else {
        page.list(&answer.warnings);
    }
    page.paragraph(&model_sentence(problem, answer));
    if !answer.not_modelled.is_empty() {
        let words = answer.not_modelled.join(", ");
        page.paragraph(&format!(
            "Not modelled, though a measurement has it: {words}."
        ));
    }
    add_pictures(&mut page, (problem, answer), pictures)?;
    add_derivatives(&mut page, answer);
    page.heading("What was left out");
    page.table(&table::omissions(problem, answer));
    Ok(page.finish())
}

/// Explanation of the column of errors for readers of the report.
const BARS: &str = "The true value of what is modelled lies within the error of the value; without an error it is given, or exact.";

/// Title of the report: body, motion and material.
fn title(scene: &Table, problem: &Problem) -> String {
    let kind = |table: &str, otherwise: &str| {
        let table = scene.get(table).and_then(Value::as_table);
        let kind = table.and_then(|table| table.keys().next());
        kind.map_or(otherwise, String::as_str).replace('-', " ")
    };
    let does = match problem.motion() {
        Motion::Sliding(_) => "slides over",
        Motion::Pressing(_) => "is pressed into",
        Motion::History { .. } => "is pressed along a history into",
        Motion::Moving(_) => "moves over",
    };
    let body = kind("indenter", "body");
    let article = if body.starts_with(['a', 'e', 'i', 'o', 'u']) {
        "An"
    } else {
        "A"
    };
    let material = match &kind("material", "material")[..] {
        "file" => "a material from a file".to_owned(),
        "prony" => "a material with a Prony series".to_owned(),
        name if name.starts_with('e') => format!("an {name} material"),
        name => format!("a {name} material"),
    };
    format!("{article} {body} {does} {material}")
}

/// Sentence of the report about the method, whether it was chosen automatically, the model, and the run time.
fn method_sentence(problem: &Problem, timed: &Timed<'_>) -> String {
    let Timed { answer, seconds } = timed;
    let model = table::model(problem, answer);
    let is_chosen = problem.method().is_none();
    let automatic = if is_chosen { AUTOMATIC } else { "" };
    let by = match answer.method {
        Method::Analytic => "closed forms, quadrature and tables",
        Method::MdrSteady => "the stationary state of elements that do not know of each other",
        Method::MdrTransient => "elements that do not know of each other, from first touch on",
        Method::BemSteady => "boundary elements in the stationary state",
        Method::BemTransient => "boundary elements, from first touch on",
    };
    let name = answer.method.name();
    format!(
        "Solved by {name}{automatic}: {by}, on a {model}, in {}.",
        table::duration(*seconds)
    )
}

/// Table of the numbers of a scene: path, quantity with unit, and value.
fn numbers(scene: &Table) -> comfy_table::Table {
    let mut rows = markdown("key | quantity | value");
    for Key { name, .. } in keys(schema()) {
        if let Some(value) = scene.get(name) {
            add_numbers(name, value, &mut rows);
        }
    }
    rows
}

/// Appends a row for each number below the path `path` of the scene; a list of tables or lists is one row with its length.
fn add_numbers(path: &str, value: &Value, rows: &mut comfy_table::Table) {
    match value {
        Value::Table(table) => {
            for (key, value) in table {
                add_numbers(&format!("{path}.{key}"), value, rows);
            }
        }
        Value::Array(list) if list.iter().any(|one| one.is_table() || one.is_array()) => {
            rows.add_row([path, "", &format!("{} entries", list.len())]);
        }
        value => {
            let label = labelled(path);
            let label = if label == path { "" } else { &label };
            rows.add_row([path, label, &value.to_string()]);
        }
    }
}

/// Appends the derivatives and the uncertainty budget, if requested.
fn add_derivatives(page: &mut Page, answer: &Answer) {
    if !answer.budget.entries.is_empty() {
        page.heading("What makes it uncertain");
        page.table(&table::budget(answer));
        page.paragraph(
            "Standard uncertainties to first order; independent ones add up as squares.",
        );
    }
    if !answer.sensitivity.is_empty() {
        page.heading("What it rests on");
        page.paragraph("One per cent more of a number changes a quantity by so many per cent.");
        page.table(&table::sensitivity(answer));
    }
    if let Some(spectral) = &answer.spectral_sensitivity {
        let (table, words) = spectrum::table(spectral);
        page.heading("Which frequencies of the material it rests on");
        page.table(&table);
        page.paragraph(&words);
    }
}

/// Sentence of the report about the assumptions of the model: elastomer, body and linear theory.
fn model_sentence(problem: &Problem, answer: &Answer) -> String {
    let body = match answer.model {
        Model::Line => {
            "elements of a line, which stand for a half space by the method of dimensionality reduction"
        }
        Model::HalfSpace if problem.thickness().is_finite() => {
            "a layer that is bonded to a rigid base"
        }
        Model::HalfSpace => "a half space",
    };
    format!(
        "Modelled: a rigid body, without friction of its own, on {body} of a linear viscoelastic material, with small slopes."
    )
}

/// Appends the pictures, and the moduli of the material unless they are part of one.
fn add_pictures(
    page: &mut Page,
    (problem, answer): (&Problem, &Answer),
    pictures: &Pictures,
) -> Result<()> {
    page.heading("Pictures");
    for (name, figure) in pictures {
        page.picture(figure, caption(name))?;
    }
    let has_spectrum = pictures
        .iter()
        .any(|(name, _)| *name == "spectral_sensitivity");
    if let Some(figure) = moduli_figure(problem, answer).filter(|_| !has_spectrum) {
        page.picture(
            &figure,
            "Storage and loss modulus of the material, over angular frequencies around v/L with the length L of the contact.",
        )?;
    }
    Ok(())
}

/// The moduli around the frequency v/L with the contact length L; `None` if nothing slides or dissipates.
fn moduli_figure(problem: &Problem, answer: &Answer) -> Option<Figure> {
    let Motion::Sliding(load) = problem.motion() else {
        return None;
    };
    let contact = answer.contact_box.as_ref()?;
    let middle = load.velocity() / (contact.x[1] - contact.x[0]);
    let dissipates = answer.hysteresis()?.value > 0.0;
    let is_drawn = dissipates && middle > 0.0 && middle.is_finite();
    is_drawn.then(|| {
        let ends =
            [FREQUENCY_HALF_RANGE.recip(), FREQUENCY_HALF_RANGE].map(|factor| factor * middle);
        let x = Axis::decades("angular frequency ω [rad/s]", ends.into_iter());
        Figure::single(spectrum::master_curve(problem, x))
    })
}

/// Ratio of the highest drawn frequency to v/L, and of v/L to the lowest, with the speed v and the contact length L. Chosen:
/// v/L is the frequency of the contact itself; the range shows its neighbourhood of three decades either way.
const FREQUENCY_HALF_RANGE: f64 = 1e3;

/// Caption of a picture by the name of its file.
fn caption(name: &str) -> &'static str {
    match name {
        "pressure" => {
            "Pressure over the contact. For a finite body the cross is the lowest point, and the arrow points along the motion."
        }
        "gap" => {
            "Gap between the body and the elastomer around the contact, where it is 0. The body moves to the right."
        }
        "temperature" => {
            "Rise of the temperature of the surface above that of the surroundings. The body moves to the right."
        }
        "line_load" => "Load per length along the line of the one-dimensional model.",
        "line_pressure" => "Pressure along the middle of the contact.",
        "motion" => "Tangential force over the position; the arrowheads follow the motion.",
        "motion_over_time" => "Tangential force over time.",
        "history" => "Force over depth; the arrowheads follow the time.",
        "history_over_time" => "The quantity that was found, over time.",
        "spectral_sensitivity" => {
            "Above: storage and loss modulus of the material. Below: what one per cent more of either changes of the friction, \
             in per cent, per decade of frequency; the ends of what was measured are dashed."
        }
        _ => "The history.",
    }
}
