//! The page that shows every figure beside the paper's statement about it.

use anyhow::{Result, ensure};

use crate::figures::friction_over_speed::{
    CONE_SLOPE, CURVATURE, NORMAL_FORCE, Row, SLIDING_LENGTHS, VISCOSITY,
};
use crate::figures::{Data, contact_maps, factors, scaling_function};

/// The page, with the names of what is filled in.
const TEMPLATE: &str = include_str!("report.html");
/// Pictures of the evidence, which the figures do not recompute; times depend on the machine.
const STABILITY: &str = include_str!("../../../docs/figures/stability.svg");
const WORK_PRECISION: &str = include_str!("../../../docs/figures/work_precision_sliding.svg");

pub(super) fn html(
    data: &Data,
    tables: &[(&str, String)],
    pictures: &[(&str, String)],
) -> Result<String> {
    let [cone, paraboloid] = &data.factors[..] else {
        anyhow::bail!("two scaling factors");
    };
    let factors = data.factors.iter().map(factor).collect();
    let [lengths, breadths] = contact_maps::extents(&data.contacts);
    let mut page = TEMPLATE.to_owned();
    let mut fill = |name: &str, value: &str| page = page.replace(&format!("{{{{{name}}}}}"), value);
    for (name, value) in [
        ("version", env!("CARGO_PKG_VERSION").to_owned()),
        ("factors", factors),
        ("plain elements", cone.plain_elements.to_string()),
        ("plain lengths", cone.plain_lengths.to_string()),
        ("drift of the cone", format!("{:.1e}", cone.plain_drift)),
        (
            "drift of the paraboloid",
            format!("{:.1e}", paraboloid.plain_drift),
        ),
        ("relative error", format!("{:e}", factors::RELATIVE_ERROR)),
        ("slope", CONE_SLOPE.to_string()),
        ("curvature", CURVATURE.to_string()),
        ("runs of the cone", runs(&data.cone)),
        ("runs of the paraboloid", runs(&data.paraboloid)),
        (
            "course of s(p)",
            scaling_function::course(&data.scaling_function),
        ),
        ("brightest", contact_maps::BRIGHTEST.to_string()),
        ("lengths of the contacts", lengths),
        ("breadths of the contacts", breadths),
        ("stability", closely(STABILITY)),
        ("work_precision", closely(WORK_PRECISION)),
    ] {
        fill(name, &value);
    }
    for (file, table) in tables {
        fill(&format!("data of {file}"), &folded(table));
    }
    for (name, svg) in pictures {
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

/// A row of the table of factors.
fn factor(row: &factors::Row) -> String {
    let name = if row.exponent < 1.5 {
        "cone, p = 1"
    } else {
        "paraboloid, p = 2"
    };
    let biases = [row.time_level_bias, row.distance_bias, row.grid_bias];
    let biases = biases.map(|bias| format!("<td>{bias:+.4}</td>")).concat();
    format!(
        "<tr><td>{name}</td><td>{}</td><td>{:.4}</td>{biases}<td><b>{:.4}</b></td><td>± {:.4}</td></tr>\n",
        row.paper, row.plain, row.converged, row.error
    )
}

/// How a figure over the speed was computed.
fn runs(rows: &[Row]) -> String {
    let elements = rows.iter().map(|row| row.elements_along_contact);
    let fewest = elements.clone().fold(f64::INFINITY, f64::min);
    let most = elements.fold(0.0, f64::max);
    let largest = |value: fn(&Row) -> f64| rows.iter().map(value).fold(0.0, f64::max);
    let chain = largest(|row| (row.chain / row.theory - 1.0).abs());
    let half_space = largest(|row| (row.half_space / row.scaled_theory - 1.0).abs());
    let distance = largest(|row| row.half_space_distance_error / row.half_space);
    format!(
        "normal force {NORMAL_FORCE} N, viscosity {VISCOSITY:e} Pa s (not stated in the paper); {} speeds, each computed \
         anew. Spacings of 2<sup>−k</sup> mm put {fewest:.1} to {most:.1} elements along the contact length of the \
         one-dimensional model; the half space slides over {SLIDING_LENGTHS} contact lengths and is extrapolated from \
         there. The chain deviates from the theory by at most {chain:.1e}, the half space from the scaled theory by at \
         most {half_space:.1e} (scatter of the grids), the extrapolation in the distance errs by at most {distance:.1e}.",
        rows.len()
    )
}

/// The numbers behind a figure, folded away.
fn folded(csv: &str) -> String {
    let mut table = String::new();
    for (line, record) in csv.lines().enumerate() {
        let tag = if line == 0 { "th" } else { "td" };
        let cells = record.split(',').map(|cell| {
            let number = cell.parse().map(|number: f64| format!("{number:.6e}"));
            let short = number.unwrap_or_else(|_| cell.replace('_', " "));
            format!("<{tag}>{short}</{tag}>")
        });
        table += &format!("<tr>{}</tr>", cells.collect::<String>());
    }
    format!(
        "<details><summary>data</summary><div class=\"wide\"><table>{table}</table></div></details>"
    )
}
