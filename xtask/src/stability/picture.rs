//! The cases as a heat map: one row per family, one cell per case.

use crate::stability::judge::{Row, Verdict};
use viscofriction_plot::{Cell, Colour, ColourScale, Figure, Matrix, MatrixRow};

/// Deviations below 10^this of their tolerance have the darkest colour.
const DARKEST: f64 = -6.0;

/// All families, in the order of the table.
pub(super) fn picture(families: &[&[Row]]) -> Figure {
    let count = |verdict| {
        let rows = families.iter().flat_map(|rows| rows.iter());
        rows.filter(|row| row.verdict == verdict).count()
    };
    let legend = [
        (Colour::Grey, Verdict::Refused, "refused by the right error"),
        (Colour::Red, Verdict::Wrong, "wrong"),
    ];
    Figure::single(Matrix {
        title: Some(format!("{} cases are accurate", count(Verdict::Accurate))),
        rows: families.iter().map(|rows| matrix_row(rows)).collect(),
        colours: ColourScale {
            label: "log₁₀ of deviation / tolerance".into(),
            range: [DARKEST, 0.0],
        },
        legend: legend
            .map(|(colour, verdict, text)| (colour, format!("{text}: {}", count(verdict))))
            .to_vec(),
    })
}

fn matrix_row(rows: &[Row]) -> MatrixRow {
    let [first, last] = [&rows[0], &rows[rows.len() - 1]];
    let is_number = |row: &Row| row.value.parse::<f64>().is_ok();
    let note = if is_number(first) && is_number(last) {
        format!("{}: {} … {}", first.parameter, first.value, last.value)
    } else {
        first.parameter.to_owned()
    };
    MatrixRow {
        name: first.family.to_owned(),
        cells: rows.iter().map(cell).collect(),
        note,
    }
}

fn cell(row: &Row) -> Cell {
    match row.verdict {
        Verdict::Refused => Cell::Plain(Colour::Grey),
        Verdict::Wrong => Cell::Plain(Colour::Red),
        Verdict::Accurate => {
            let part = row.part_of_tolerance().unwrap_or(0.0);
            Cell::Value(part.log10().clamp(DARKEST, 0.0))
        }
    }
}
