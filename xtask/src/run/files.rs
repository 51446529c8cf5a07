//! The files of one answer: result.json, fields as NPY and CSV, pictures as SVG and PNG.

use std::path::Path;

use anyhow::Result;
use serde::Serialize;

use super::answer::Answer;
use super::pictures;
use crate::npy::to_npy;
use crate::output::{WrongInput, to_csv, write_atomically, write_figure};
use viscofriction_plot::Figure;

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
pub(super) fn write(answer: &Answer, out: &Path) -> Result<()> {
    std::fs::create_dir_all(out)
        .map_err(|error| WrongInput(format!("--out {} cannot be made: {error}", out.display())))?;
    write_pressure(answer, out)?;
    write_line(answer, out)?;
    write_history(answer, out)?;
    let result = format!("{}\n", serde_json::to_string_pretty(answer)?);
    write_atomically(&out.join("result.json"), result.as_bytes())
}

fn write_pressure(answer: &Answer, out: &Path) -> Result<()> {
    let Some(field) = &answer.fields.pressure else {
        return Ok(());
    };
    let shape = field.grid.shape();
    let place =
        |axis: usize, index: usize| field.origin[axis] + index as f64 * field.grid.spacing()[axis];
    let row = |(index, pressure): (usize, &f64)| PressureRow {
        x_m: place(0, index / shape[1]),
        y_m: place(1, index % shape[1]),
        pressure_pa: *pressure,
    };
    let rows: Vec<PressureRow> = field.pressure.iter().enumerate().map(row).collect();
    write_atomically(&out.join("pressure.csv"), to_csv(&rows)?.as_bytes())?;
    write_atomically(&out.join("pressure.npy"), &to_npy(&field.pressure, &shape))?;
    for (axis, name) in ["pressure_x.npy", "pressure_y.npy"].into_iter().enumerate() {
        let places: Vec<f64> = (0..shape[axis]).map(|index| place(axis, index)).collect();
        write_atomically(&out.join(name), &to_npy(&places, &[places.len()]))?;
    }
    write_figure(out, "pressure", &pictures::pressure(field)?)
}

fn write_line(answer: &Answer, out: &Path) -> Result<()> {
    let row = |[x_m, load_n_per_m]: &[f64; 2]| LineRow {
        x_m: *x_m,
        load_n_per_m: *load_n_per_m,
    };
    let points = &answer.fields.line_load;
    write_along(points, row, (out, "line_load"), pictures::line_load)?;
    let row = |[x_m, pressure_pa]: &[f64; 2]| LinePressureRow {
        x_m: *x_m,
        pressure_pa: *pressure_pa,
    };
    let points = &answer.fields.line_pressure;
    write_along(points, row, (out, "line_pressure"), pictures::line_pressure)
}

/// What is known along a line, if there is anything.
fn write_along<R: Serialize>(
    points: &[[f64; 2]],
    row: impl Fn(&[f64; 2]) -> R,
    (out, name): (&Path, &str),
    figure: impl Fn(&[[f64; 2]]) -> Figure,
) -> Result<()> {
    if points.is_empty() {
        return Ok(());
    }
    let rows: Vec<R> = points.iter().map(row).collect();
    let path = |extension: &str| out.join(format!("{name}.{extension}"));
    write_atomically(&path("csv"), to_csv(&rows)?.as_bytes())?;
    write_atomically(&path("npy"), &to_npy(&points.concat(), &[points.len(), 2]))?;
    write_figure(out, name, &figure(points))
}

fn write_history(answer: &Answer, out: &Path) -> Result<()> {
    let rows = &answer.fields.history;
    if rows.is_empty() {
        return Ok(());
    }
    write_atomically(&out.join("history.csv"), to_csv(rows)?.as_bytes())?;
    write_figure(out, "history", &pictures::history(rows))
}
