//! The page that shows every figure beside the paper's statement about it.

use anyhow::{Result, ensure};

use crate::table::{Table, known_digits};

/// The page, with the names of the tables and pictures that are filled in.
const TEMPLATE: &str = include_str!("report.html");
/// Pictures of the evidence, which the figures do not recompute; times depend on the machine.
const EVIDENCE: [(&str, &str); 2] = [
    (
        "stability",
        include_str!("../../../docs/figures/stability.svg"),
    ),
    (
        "work_precision",
        include_str!("../../../docs/figures/work_precision_sliding.svg"),
    ),
];

/// Fills in tables and pictures, which are given as SVG.
pub(super) fn html(tables: &[Table], pictures: &[(&str, String)]) -> Result<String> {
    let mut page = TEMPLATE.to_owned();
    let mut fill = |name: &str, value: &str| page = page.replace(&format!("{{{{{name}}}}}"), value);
    fill("version", env!("CARGO_PKG_VERSION"));
    for Table { name, contents } in tables {
        fill(&format!("table of {name}.csv"), &cells(contents));
    }
    for (name, svg) in pictures {
        fill(name, &closely(svg));
    }
    for (name, svg) in EVIDENCE {
        fill(name, &closely(svg));
    }
    let is_filled = !page.contains("{{");
    ensure!(is_filled, "a part of report.html is not filled in");
    Ok(page)
}

/// A picture that grows when it is clicked, without a script.
fn closely(svg: &str) -> String {
    format!("<label><input type=\"checkbox\">{svg}</label>")
}

/// The numbers behind a figure.
fn cells(csv: &str) -> String {
    let mut table = String::new();
    for (line, record) in csv.lines().enumerate() {
        let tag = if line == 0 { "th" } else { "td" };
        let cells = record.split(',').map(|cell| {
            let number = cell.parse().map(|number| known_digits(number, None));
            let short = number.unwrap_or_else(|_| cell.replace('_', " "));
            format!("<{tag}>{short}</{tag}>")
        });
        table += &format!("<tr>{}</tr>", cells.collect::<String>());
    }
    format!("<div class=\"wide\"><table>{table}</table></div>")
}
