//! What the scene did not need, why, and what leaving it out saves.

use comfy_table::Table;

use super::answer::Answer;

/// One row per part that was left out; savings are counted from this result where they can be.
pub(super) fn table(answer: &Answer) -> Table {
    let mut table = Table::new();
    table.load_style(comfy_table::presets::ASCII_MARKDOWN);
    table.set_header(["left out", "because", "saves"]);
    for part in &answer.left_out {
        let (because, saves) = reason(part, answer);
        table.add_row([(*part).to_owned(), because.to_owned(), saves]);
    }
    table
}

fn reason(part: &str, answer: &Answer) -> (&'static str, String) {
    let unknowns = answer.unknowns;
    match part {
        "elements" if unknowns == 0 => ("there is a closed form", "all unknowns".to_owned()),
        "elements" => (
            "the foundation is integrated exactly between two events",
            format!("all elements; {unknowns} polynomials stand for the line"),
        ),
        "time steps" => (
            "only the state at the end is asked for",
            "all steps from first touch on, about 20 contact lengths of them".to_owned(),
        ),
        "half space" => (
            "the one-dimensional model answers the scene",
            "the second dimension of the contact".to_owned(),
        ),
        "mirror half" => (
            "body and motion are mirror symmetric in y",
            format!("half of {} unknown pressures", 2 * unknowns),
        ),
        "free surface" => (
            "the displacement is needed in the contact only",
            "all elements outside the contact".to_owned(),
        ),
        "history outside the contact box" => (
            "what the contact has left does not come back",
            "the displacement behind the contact".to_owned(),
        ),
        "gradients" => (
            "nothing slides, so that no slope enters",
            "one field".to_owned(),
        ),
        "friction" => ("nothing slides", "one sum over the contact".to_owned()),
        _ => ("there is no --out", "fields and pictures".to_owned()),
    }
}
