//! The report page of a sweep.

use anyhow::Result;
use viscofriction::sweep::each_once;
use viscofriction::{Estimate, QUANTITIES};
use viscofriction_plot::Figure;

use super::file::RowTable;
use super::picture::{is_cylinder, labelled_in};
use super::samples::Samples;
use crate::output::markdown;
use crate::page::Page;

/// Name of the column of failures.
const FAILURE: &str = "failure";

/// The page, with the text of the scene if it is known.
pub(super) fn page(
    table: &RowTable,
    figure: Option<&Figure>,
    scene: Option<&str>,
) -> Result<String> {
    let keys = table.keys().unwrap_or(0..0);
    let names: Vec<&str> = keys.clone().map(|key| &*table.header[key]).collect();
    let mut page = Page::new(&format!("A sweep over {}", names.join(" and ")));
    page.paragraph(&format!("{} points.", table.rows.len()));
    if let Some(scene) = scene {
        page.hidden("the scene file", scene);
    }
    if let Some(figure) = figure {
        page.picture(figure, "")?;
    }
    if let Some(samples) = Samples::of(table) {
        page.heading("How the answers are distributed");
        page.table(&samples.table());
    }
    page.heading("The answers");
    let is_per_length = is_cylinder(table, scene);
    page.table(&rows(table, keys, is_per_length));
    if !known_uncertainties(table).is_empty() {
        page.paragraph(
            "Behind ± stands the error of the computation. The standard uncertainty is that of the moduli and of the uncertain \
             numbers of the scene.",
        );
    }
    page.heading("How far to trust them");
    let warnings = each_once(table.rows.iter().map(|row| row.warnings()));
    if warnings.is_empty() {
        page.paragraph("No point has a warning.");
    } else {
        page.list(&warnings);
    }
    Ok(page.finish())
}

/// Columns with results of theories, each with its label in the report.
const THEORIES: [(&str, &str); 2] = [
    (
        "persson_friction_coefficient_2006",
        "friction, Persson (2006)",
    ),
    (
        "persson_area_fraction_xu",
        "area fraction, Xu and others (2024)",
    ),
];

/// Columns of standard uncertainties that are known and differ from 0, without errors, and their labels.
fn known_uncertainties(table: &RowTable) -> Vec<(usize, Option<usize>, String)> {
    let is_known = |column: usize| {
        let mut cells = table
            .rows
            .iter()
            .map(|row| row.fields[column].parse::<f64>());
        cells.any(|cell| cell.is_ok_and(|value| value > 0.0))
    };
    let columns = QUANTITIES.iter().filter_map(|quantity| {
        let column = table.place(&format!("{}_uncertainty", quantity.key));
        let label = format!("standard uncertainty of {}", quantity.name());
        Some((column.filter(|&column| is_known(column))?, None, label))
    });
    columns.collect()
}

/// Table of the varied keys and results of each point, and of the failures if there are any.
fn rows(table: &RowTable, keys: std::ops::Range<usize>, is_per_length: bool) -> comfy_table::Table {
    let place = |name: &str| table.place(name);
    let is_known = |column: usize| table.rows.iter().any(|row| !row.fields[column].is_empty());
    let quantities = QUANTITIES.iter().filter_map(|quantity| {
        let column = place(quantity.key).filter(|&column| is_known(column))?;
        Some((
            column,
            place(&format!("{}_error", quantity.key)),
            labelled_in(quantity.key, is_per_length),
        ))
    });
    let theories = THEORIES.iter().filter_map(|(name, label)| {
        let column = place(name).filter(|&column| is_known(column))?;
        Some((column, None, (*label).to_owned()))
    });
    let columns: Vec<(usize, Option<usize>, String)> = quantities
        .chain(known_uncertainties(table))
        .chain(theories)
        .collect();
    let failure = place(FAILURE).filter(|&column| is_known(column));
    let heads: Vec<String> = keys
        .clone()
        .map(|key| labelled_in(&table.header[key], is_per_length))
        .chain(columns.iter().map(|(_, _, label)| label.clone()))
        .chain(failure.map(|_| "no answer, because".to_owned()))
        .collect();
    let mut shown = markdown(&heads.join(" | "));
    for row in &table.rows {
        let number = |column: usize| row.fields[column].parse::<f64>().ok();
        let known = columns.iter().map(|(column, error, _)| {
            let bar = error.and_then(number).unwrap_or(0.0);
            let known = number(*column).map(|value| Estimate::new(value, bar));
            known.map_or_else(String::new, |known| known.to_string())
        });
        let cells = keys.clone().map(|key| row.fields[key].clone()).chain(known);
        shown.add_row(cells.chain(failure.map(|column| row.fields[column].clone())));
    }
    shown
}
