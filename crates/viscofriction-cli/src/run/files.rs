//! The files of one answer: result.json, fields as NPY and CSV, pictures as SVG and PNG.

use anyhow::Result;
use viscofriction::npy::to_npy;
use viscofriction::solve::Answer;

use super::{Timed, pictures};
use crate::output::{OutputFolder, to_csv};

/// All files that an answer may have.
pub(super) const NAMES: [&str; 18] = [
    "result.json",
    "pressure.csv",
    "pressure.npy",
    "pressure.svg",
    "pressure.png",
    "line_load.csv",
    "line_load.npy",
    "line_load.svg",
    "line_load.png",
    "line_pressure.csv",
    "line_pressure.npy",
    "line_pressure.svg",
    "line_pressure.png",
    "pressure_x.npy",
    "pressure_y.npy",
    "history.csv",
    "history.svg",
    "history.png",
];

/// Writes what the answer has; result.json comes last: with it the others are there.
pub(super) fn write(timed: &Timed<'_>, out: &OutputFolder) -> Result<()> {
    let answer = timed.answer;
    write_pressure(answer, out)?;
    write_line(answer, out)?;
    write_history(answer, out)?;
    let result = format!("{}\n", serde_json::to_string_pretty(timed)?);
    out.write("result.json", result.as_bytes())
}

fn write_pressure(answer: &Answer, out: &OutputFolder) -> Result<()> {
    let Some(field) = &answer.fields.pressure else {
        return Ok(());
    };
    let [rows, columns] = field.grid.shape();
    let place =
        |axis: usize, index: usize| field.origin[axis] + index as f64 * field.grid.spacing()[axis];
    let row = |(index, pressure): (usize, &f64)| {
        [
            place(0, index / columns),
            place(1, index % columns),
            *pressure,
        ]
    };
    let table = field.pressure.iter().enumerate().map(row);
    let names = ["x_m", "y_m", "pressure_pa"];
    out.write("pressure.csv", &to_csv(&names, table)?)?;
    let pressure = to_npy(&field.pressure, &[rows, columns]);
    out.write("pressure.npy", &pressure)?;
    for (axis, (name, length)) in [("pressure_x.npy", rows), ("pressure_y.npy", columns)]
        .into_iter()
        .enumerate()
    {
        let places: Vec<f64> = (0..length).map(|index| place(axis, index)).collect();
        out.write(name, &to_npy(&places, &[length]))?;
    }
    out.draw("pressure", &pictures::pressure(field)?)
}

/// What is known along a line: the name of its files, and its quantity in tables and on axes.
fn write_line(answer: &Answer, out: &OutputFolder) -> Result<()> {
    let fields = &answer.fields;
    for (name, column, label, points) in [
        (
            "line_load",
            "load_n_per_m",
            "load per length [N/m]",
            &fields.line_load,
        ),
        (
            "line_pressure",
            "pressure_pa",
            "pressure [Pa]",
            &fields.line_pressure,
        ),
    ] {
        if points.is_empty() {
            continue;
        }
        out.write(&format!("{name}.csv"), &to_csv(&["x_m", column], points)?)?;
        let array = to_npy(&points.concat(), &[points.len(), 2]);
        out.write(&format!("{name}.npy"), &array)?;
        out.draw(
            name,
            &pictures::curve("position x [m]", label, points.clone()),
        )?;
    }
    Ok(())
}

fn write_history(answer: &Answer, out: &OutputFolder) -> Result<()> {
    let rows = &answer.fields.history;
    if rows.is_empty() {
        return Ok(());
    }
    out.write("history.csv", &to_csv(&[], rows)?)?;
    out.draw("history", &pictures::history(rows))
}
