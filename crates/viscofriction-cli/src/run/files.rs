//! The files of one answer: result.json, fields as NPY and CSV, pictures as SVG and PNG.

use anyhow::Result;
use serde::Serialize;
use viscofriction::npy::to_npy;
use viscofriction::solve::Answer;
use viscofriction_plot::Figure;

use super::{Timed, pictures};
use crate::output::{OutputFolder, to_csv};

/// All files that an answer may have.
pub(super) const NAMES: [&str; 15] = [
    "result.json",
    "pressure.csv",
    "pressure.npy",
    "pressure_x.npy",
    "pressure_y.npy",
    "pressure.svg",
    "pressure.png",
    "line_load.csv",
    "line_load.npy",
    "line_load.svg",
    "line_load.png",
    "line_pressure.csv",
    "line_pressure.npy",
    "history.csv",
    "history.svg",
];

#[derive(Debug, Serialize)]
struct PressureRow {
    x_m: f64,
    y_m: f64,
    pressure_pa: f64,
}

#[derive(Debug, Serialize)]
struct LineRow {
    x_m: f64,
    load_n_per_m: f64,
}

#[derive(Debug, Serialize)]
struct LinePressureRow {
    x_m: f64,
    pressure_pa: f64,
}

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
    let row = |(index, pressure): (usize, &f64)| PressureRow {
        x_m: place(0, index / columns),
        y_m: place(1, index % columns),
        pressure_pa: *pressure,
    };
    let table: Vec<PressureRow> = field.pressure.iter().enumerate().map(row).collect();
    out.write("pressure.csv", to_csv(&table)?.as_bytes())?;
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

fn write_line(answer: &Answer, out: &OutputFolder) -> Result<()> {
    let row = |[x_m, load_n_per_m]: &[f64; 2]| LineRow {
        x_m: *x_m,
        load_n_per_m: *load_n_per_m,
    };
    let points = &answer.fields.line_load;
    write_along(out, "line_load", points, row, &pictures::line_load)?;
    let row = |[x_m, pressure_pa]: &[f64; 2]| LinePressureRow {
        x_m: *x_m,
        pressure_pa: *pressure_pa,
    };
    let points = &answer.fields.line_pressure;
    write_along(out, "line_pressure", points, row, &pictures::line_pressure)
}

/// What is known along a line, if there is anything.
fn write_along<R: Serialize>(
    out: &OutputFolder,
    name: &str,
    points: &[[f64; 2]],
    row: impl Fn(&[f64; 2]) -> R,
    figure: &dyn Fn(&[[f64; 2]]) -> Figure,
) -> Result<()> {
    if points.is_empty() {
        return Ok(());
    }
    let rows: Vec<R> = points.iter().map(row).collect();
    out.write(&format!("{name}.csv"), to_csv(&rows)?.as_bytes())?;
    let array = to_npy(&points.concat(), &[points.len(), 2]);
    out.write(&format!("{name}.npy"), &array)?;
    out.draw(name, &figure(points))
}

fn write_history(answer: &Answer, out: &OutputFolder) -> Result<()> {
    let rows = &answer.fields.history;
    if rows.is_empty() {
        return Ok(());
    }
    out.write("history.csv", to_csv(rows)?.as_bytes())?;
    out.draw("history", &pictures::history(rows))
}
