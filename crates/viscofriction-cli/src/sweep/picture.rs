//! What came out of a sweep over what varies, beside its file.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};
use viscofriction::WrongInput;
use viscofriction_plot::{Axis, Chart, Colour, Field, Figure, Marker, Series, Shape};

use super::file::RowTable;
use crate::input::read_rows;
use crate::output::{OutputFile, folder_of, name_of, picture, remove_parts, say};
use crate::run::around;

/// What may be drawn, as its column and as the label of its axis: friction where something slides, the depth where a force
/// is given, and else the force.
const QUANTITIES: [(&str, &str); 3] = [
    ("friction_coefficient", "friction coefficient"),
    ("indentation_depth", "indentation depth [m]"),
    ("normal_force", "normal force [N]"),
];
/// The column before the keys that vary, and the one behind them.
const AROUND_KEYS: [&str; 2] = ["points", "check"];
/// Values that follow each other by an equal step or factor do so up to this part of it.
const EQUAL: f64 = 1e-6;
/// Values of a list that span a larger factor are drawn over their logarithm.
const WIDE: f64 = 100.0;

/// The picture of a sweep, as SVG and as PNG.
pub(super) struct PictureFiles {
    svg: OutputFile,
    png: OutputFile,
}

impl PictureFiles {
    /// The files beside that of the rows.
    pub(super) fn new(rows: &Path, overwrite: bool) -> Result<Self, WrongInput> {
        let [svg, png] = ["svg", "png"].map(|extension| beside(rows, extension));
        Ok(Self {
            svg: OutputFile::new(&svg, overwrite)?,
            png: OutputFile::new(&png, overwrite)?,
        })
    }

    /// The files of a sweep that is taken up again: its own picture is drawn anew, another one stays.
    pub(super) fn resumed(rows: &Path, fingerprint: &str) -> Result<Self, WrongInput> {
        let drawn = read_rows(&beside(rows, "svg")).unwrap_or_default();
        Self::new(rows, drawn.ends_with(signature(fingerprint).as_bytes()))
    }

    /// Makes the pictures that are to be replaced those of this sweep, so that it goes on with them when it is taken up again;
    /// the caller holds the lock of the rows.
    pub(super) fn claim(&self, fingerprint: &str) -> Result<()> {
        let is_there = [&self.svg, &self.png].map(|file| file.path().exists());
        if is_there == [false; 2] {
            return Ok(());
        }
        let empty = format!("{EMPTY}{}", signature(fingerprint));
        self.svg.write(empty.as_bytes())
    }

    /// Removes what a sweep that was killed has left of them; the caller holds the lock of the rows.
    pub(super) fn remove_parts(&self) {
        for file in [&self.svg, &self.png] {
            remove_parts(folder_of(file.path()), &[&name_of(file.path())]);
        }
    }

    /// Draws what can be drawn, and says why where nothing can.
    pub(super) fn draw(&self, table: &RowTable) -> Result<()> {
        let (svg, png) = match figure(table).and_then(|figure| picture(&figure)) {
            Ok(files) => files,
            Err(problem) => {
                say(&format!("no picture: {problem:#}"));
                return Ok(());
            }
        };
        let fingerprint = table.rows.first().map_or("", |row| &row.fields[0]);
        self.svg.write((svg + &signature(fingerprint)).as_bytes())?;
        self.png.write(&png)
    }
}

/// The name of a picture: that of the rows with another extension, or one more.
fn beside(rows: &Path, extension: &str) -> PathBuf {
    if rows.extension().is_some_and(|own| own == "csv") {
        return rows.with_extension(extension);
    }
    let mut name = rows.as_os_str().to_owned();
    name.push(format!(".{extension}"));
    PathBuf::from(name)
}

/// A picture without anything in it.
const EMPTY: &str = "<svg xmlns=\"http://www.w3.org/2000/svg\"/>\n";

/// By this the picture of a sweep is known.
fn signature(fingerprint: &str) -> String {
    format!("<!-- sweep {fingerprint} -->\n")
}

fn figure(table: &RowTable) -> Result<Figure> {
    let place = |name: &str| table.header.iter().position(|column| column == name);
    let [before, behind] = AROUND_KEYS.map(place);
    let keys = before.zip(behind);
    let (before, behind) = keys.context("the columns are not those of a sweep")?;
    let column = |place: usize| -> Vec<Option<f64>> {
        let cells = table.rows.iter().map(|row| row.fields[place].parse().ok());
        cells.collect()
    };
    let values = |name: &str| place(name).map(&column).unwrap_or_default();
    let is_known = |name: &str| values(name).iter().any(Option::is_some);
    let key = |place: usize| (&*table.header[place], column(place));
    let keys: Vec<(&str, Vec<Option<f64>>)> = (before + 1..behind).map(key).collect();
    let is_drawn = |name: &str| match name {
        "indentation_depth" => {
            let forces = sorted(values("normal_force").into_iter().flatten());
            forces.len() < 2 || keys.iter().any(|(key, _)| *key == "load.normal_force")
        }
        _ => true,
    };
    let mut quantities = QUANTITIES.into_iter();
    let drawn = quantities.find(|(name, _)| is_known(name) && is_drawn(name));
    let (name, label) = drawn.context("no point has a result")?;
    let errors = values(&format!("{name}_error"));
    let values = values(name);
    match &keys[..] {
        [(key, over)] => Ok(chart((key, over), (label, &values), &errors)),
        [(one, x), (other, y)] => map([(one, x), (other, y)], (label, &values)),
        _ => bail!("more than two keys vary"),
    }
}

/// A name, and what stands in its column.
type Column<'a> = (&'a str, &'a [Option<f64>]);

fn chart((key, over): Column<'_>, (label, values): Column<'_>, errors: &[Option<f64>]) -> Figure {
    let points = over.iter().zip(values).zip(errors);
    let points = points.filter_map(|((x, y), error)| Some(([(*x)?, (*y)?], error.unwrap_or(0.0))));
    let mut points: Vec<([f64; 2], f64)> = points.collect();
    // Points of shards and of several threads come in any order.
    points.sort_by(|(one, _), (other, _)| one[0].total_cmp(&other[0]));
    let (points, errors): (Vec<[f64; 2]>, Vec<f64>) = points.into_iter().unzip();
    let ends = points.iter().zip(&errors);
    let ends = ends.flat_map(|(point, error)| [point[1] - error, point[1] + error]);
    let y = Axis::linear(label, around(ends));
    let places = sorted(points.iter().map(|point| point[0]));
    let [first, last] = ends_of(&places);
    let is_wide = first > 0.0 && last / first >= WIDE;
    let x = if !is_arithmetic(&places) && (is_geometric(&places) || is_wide) {
        Axis::decades(labelled(key), places.iter().copied())
    } else {
        Axis::linear(labelled(key), [first, last])
    };
    let series = Series {
        errors,
        ..Series::markers(points, Marker::filled(Shape::Circle), Colour::Blue)
    };
    Figure::single(Chart::new(x, y, vec![series]))
}

/// A key with the unit of its quantity, where it has one.
fn labelled(key: &str) -> String {
    let name = key.rsplit('.').next().unwrap_or(key);
    let unit = match name {
        "velocity" => "m/s",
        "normal_force" => "N",
        "indentation_depth" | "radius" | "sliding_distance" => "m",
        "viscosity" => "Pa s",
        "relaxation_time" | "duration" => "s",
        "curvature" => "1/m",
        modulus if modulus.ends_with("modulus") => "Pa",
        _ => return key.to_owned(),
    };
    format!("{key} [{unit}]")
}

fn map([one, other]: [Column<'_>; 2], (label, values): Column<'_>) -> Result<Figure> {
    let places = [one, other].map(|(_, over)| sorted(over.iter().copied().flatten()));
    let place = |x: f64, y: f64| [x, y].map(f64::to_bits);
    let mut found = HashMap::new();
    for ((x, y), value) in one.1.iter().zip(other.1).zip(values) {
        if let (Some(x), Some(y), Some(value)) = (x, y, value) {
            found.insert(place(*x, *y), *value);
        }
    }
    let colours = Axis::linear(label, ends_of(&sorted(found.values().copied())));
    let shape = [places[0].len(), places[1].len()];
    let field = Field::new(shape, colours, |column, row| {
        let place = place(places[0][column], places[1][row]);
        found.get(&place).copied()
    });
    let [x, y] = [cells(one.0, &places[0])?, cells(other.0, &places[1])?];
    Ok(Figure::single(Chart::map(x, y, field.stretched())))
}

/// An axis of cells that are as wide as the values in their middle are apart.
fn cells(key: &str, places: &[f64]) -> Result<Axis> {
    let (Some(first), Some(last), true) = (places.first(), places.last(), places.len() > 1) else {
        bail!("{key} has only one value");
    };
    let steps = (places.len() - 1) as f64;
    if is_arithmetic(places) {
        let half = 0.5 * (last - first) / steps;
        Ok(Axis::linear(labelled(key), [first - half, last + half]))
    } else if is_geometric(places) {
        let half = (last / first).powf(0.5 / steps);
        Ok(Axis::log10(labelled(key), [first / half, last * half]))
    } else {
        bail!("the values of {key} are neither an equal step nor an equal factor apart")
    }
}

fn is_arithmetic(places: &[f64]) -> bool {
    is_equal(places.windows(2).map(|pair| pair[1] - pair[0]))
}

fn is_geometric(places: &[f64]) -> bool {
    let factors = places.windows(2).map(|pair| (pair[1] / pair[0]).ln());
    places.first().is_some_and(|first| *first > 0.0) && is_equal(factors)
}

fn is_equal(steps: impl Iterator<Item = f64>) -> bool {
    let steps = sorted(steps);
    let (Some(least), Some(most)) = (steps.first(), steps.last()) else {
        return true;
    };
    most - least <= EQUAL * most
}

/// Every value once.
fn sorted(values: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    values.dedup_by(|one, other| one.total_cmp(other).is_eq());
    values
}

/// From the least to the largest of sorted values; some room around a single one.
fn ends_of(values: &[f64]) -> [f64; 2] {
    let [low, high] = [values.first(), values.last()].map(|value| value.copied().unwrap_or(0.0));
    if high > low {
        return [low, high];
    }
    let room = if low == 0.0 { 1.0 } else { 0.5 * low.abs() };
    [low - room, high + room]
}
