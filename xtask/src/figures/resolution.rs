//! The factors of the plain simulation over its resolution, which the paper does not state.

use anyhow::Result;
use serde::Serialize;

use crate::figures::Part;
use crate::figures::factors::{self, PAPER};
use crate::output::points;
use crate::tasks::in_parallel;
use viscofriction_plot::{Axis, Chart, Colour, Dash, Figure, Line, Marker, Series, Shape};

/// Name of table and picture.
pub(super) const NAME: &str = "plain_resolution";
/// Number of resolutions of each profile in the table.
pub(super) const COUNT: usize = 7;
/// Numbers of elements along the contact length of the one-dimensional model. Chosen: each is about √2 times the one before.
const ELEMENTS: [u32; COUNT] = [5, 7, 10, 14, 20, 28, 40];

/// The factor of one profile at one resolution.
#[derive(Debug, Serialize)]
pub(super) struct Row {
    exponent: f64,
    elements: u32,
    /// Friction ratio at the end, with the slope at the end of each step.
    plain: f64,
}

/// The table and the picture, with the converged factors for comparison.
pub(super) fn part(factors: &[factors::Row]) -> Result<Part> {
    let rows = compute(COUNT)?;
    let figure = Figure::single(chart(&rows, factors));
    Part::new(NAME, &rows, [(NAME, figure)])
}

/// Both profiles with the first `resolutions` of [`ELEMENTS`].
pub(super) fn compute(resolutions: usize) -> Result<Vec<Row>> {
    let pairs = PAPER.iter().flat_map(|(exponent, _)| {
        let elements = ELEMENTS[..resolutions].iter();
        elements.map(move |elements| (*exponent, *elements))
    });
    let pairs: Vec<(f64, u32)> = pairs.collect();
    in_parallel("resolutions", &pairs, |&(exponent, elements)| {
        Ok(Row {
            exponent,
            elements,
            plain: factors::Plain::new(exponent, f64::from(elements))?.ratio,
        })
    })
}

/// The factors over the resolution, between those of the paper and the converged ones.
fn chart(rows: &[Row], converged: &[factors::Row]) -> Chart {
    let range = [4.0, 50.0];
    let mut series = Vec::new();
    let styles = [
        ("cone", Shape::Square, Colour::Blue),
        ("paraboloid", Shape::Circle, Colour::Red),
    ];
    for (factor, (name, shape, colour)) in converged.iter().zip(styles) {
        let is_of_body = |row: &&Row| row.exponent.total_cmp(&factor.exponent).is_eq();
        let of_body: Vec<&Row> = rows.iter().filter(is_of_body).collect();
        let plain = points(&of_body, |row| f64::from(row.elements), |row| row.plain);
        let level = |value: f64, dash| {
            let ends = range.map(|elements| [elements, value]).to_vec();
            Series::line(ends, Line::thin(dash), colour)
        };
        series.extend([
            Series::markers(plain, Marker::open(shape), colour)
                .labelled(format!("{name}, plain simulation")),
            level(factor.paper, Dash::Dotted).labelled(format!("{name}, paper")),
            level(factor.converged, Dash::Solid).labelled(format!("{name}, converged")),
        ]);
    }
    let x = Axis::log10("elements along the contact length of the line model", range);
    let y = Axis::linear("scaling factor", [0.4, 0.8]);
    Chart::new(x, y, series)
}
