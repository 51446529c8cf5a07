//! Pictures of a sweep, written next to its CSV file: results over the varied keys.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};
use viscofriction::numerics::MessageNumber;
use viscofriction::scene::units;
use viscofriction::{Quantity, WrongInput};
use viscofriction_plot::{Axis, Chart, Colour, Dash, Field, Figure, Line, Marker, Series, Shape};

use super::file::RowTable;
use super::measured::{Measured, Residuals};
use super::report::page;
use super::samples::Samples;
use crate::input::read_rows;
use crate::output::{OutputFile, eprint_line, folder_of, name_of, picture, remove_parts};
use crate::run::range_with_zero;

/// Keys of the quantities that may be drawn, in order of preference.
const DRAWN: [&str; 4] = [
    FRICTION,
    "indentation_depth",
    "normal_force",
    "contact_area",
];
/// Name of the column of the friction coefficient.
pub(super) const FRICTION: &str = "friction_coefficient";
/// Ratio of the spread of the steps between values to the largest step up to which they count as equal; for factors, of the
/// logarithms. Chosen, above rounding.
const EQUAL_STEP_TOLERANCE: f64 = 1e-6;
/// Ratio of the last to the first of irregularly spaced values above which the axis is logarithmic. Chosen.
const MIN_LOGARITHMIC_RATIO: f64 = 100.0;

/// The output files other than the rows: picture as SVG and PNG, and report.
pub(super) struct PictureFiles {
    svg: OutputFile,
    png: OutputFile,
    html: OutputFile,
    /// Residuals of measured points; `None` without `--measured`.
    residuals: Option<OutputFile>,
}

impl PictureFiles {
    /// Validates the paths beside that of the rows.
    pub(super) fn new(
        rows: &Path,
        measured: Option<&Measured>,
        overwrite: bool,
    ) -> Result<Self, WrongInput> {
        let file = |extension| OutputFile::new(&beside(rows, extension), overwrite);
        Ok(Self {
            svg: file("svg")?,
            png: file("png")?,
            html: file("html")?,
            residuals: measured.map(|_| file(RESIDUALS)).transpose()?,
        })
    }

    /// Files of a resumed sweep: its own picture may be replaced, another one may not.
    pub(super) fn resumed(
        rows: &Path,
        measured: Option<&Measured>,
        fingerprint: &str,
    ) -> Result<Self, WrongInput> {
        let drawn = read_rows(&beside(rows, "svg")).unwrap_or_default();
        let is_own = drawn.ends_with(signature(fingerprint).as_bytes());
        Self::new(rows, measured, is_own)
    }

    /// Marks existing pictures as those of this sweep, so that a resumed run may replace them. The caller holds the lock of the
    /// rows.
    pub(super) fn claim(&self, fingerprint: &str) -> Result<()> {
        if !self.all().any(|file| file.path().exists()) {
            return Ok(());
        }
        let empty = format!("{EMPTY_SVG}{}", signature(fingerprint));
        self.svg.write(empty.as_bytes())?;
        self.png.remove()?;
        self.html.remove()
    }

    /// All files of pictures and, with measured points, of residuals.
    fn all(&self) -> impl Iterator<Item = &OutputFile> {
        let pictures = [&self.svg, &self.png, &self.html];
        pictures.into_iter().chain(&self.residuals)
    }

    /// Removes temporary files of interrupted runs. The caller holds the lock of the rows.
    pub(super) fn remove_parts(&self) {
        for file in self.all() {
            remove_parts(folder_of(file.path()), &[&name_of(file.path())]);
        }
    }

    /// Writes the picture, or reports why there is none, the residuals of measured points, and the report page, with the scene if it
    /// is known.
    pub(super) fn draw(
        &self,
        table: &RowTable,
        measured: Option<&Measured>,
        scene: Option<&str>,
    ) -> Result<()> {
        let is_per_length = is_cylinder(table, scene);
        let drawn = figure(table, measured, is_per_length)
            .and_then(|figure| Ok((picture(&figure)?, figure)));
        let figure = match drawn {
            Ok(((svg, png), figure)) => {
                let fingerprint = table.rows.first().map_or("", |row| &row.fields[0]);
                self.svg.write((svg + &signature(fingerprint)).as_bytes())?;
                self.png.write(&png)?;
                Some(figure)
            }
            Err(problem) => {
                eprint_line(&format!("no picture: {problem:#}"));
                None
            }
        };
        if let (Some(measured), Some(file)) = (measured, &self.residuals) {
            let Residuals { csv, summary } = measured.residuals(table)?;
            file.write(csv.as_bytes())?;
            eprint_line(&format!("{summary}, in {}", file.path().display()));
        }
        let page = page(table, figure.as_ref(), scene)?;
        self.html.write(page.as_bytes())
    }
}

/// Path of a picture: that of the rows with its extension replaced, or appended.
pub(crate) fn beside(rows: &Path, extension: &str) -> PathBuf {
    if rows.extension().is_some_and(|own| own == "csv") {
        return rows.with_extension(extension);
    }
    let mut name = rows.as_os_str().to_owned();
    name.push(format!(".{extension}"));
    PathBuf::from(name)
}

/// Replaces the extension of the CSV file of a sweep in the name of the file of residuals.
const RESIDUALS: &str = "measured.csv";
/// An SVG picture without content. With the signature of a sweep behind it, existing pictures count as those of this sweep.
const EMPTY_SVG: &str = "<svg xmlns=\"http://www.w3.org/2000/svg\"/>\n";

/// Comment at the end of an SVG file that identifies its sweep.
fn signature(fingerprint: &str) -> String {
    format!("<!-- sweep {fingerprint} -->\n")
}

/// The figure of the rows, or the reason why there is none.
fn figure(table: &RowTable, measured: Option<&Measured>, is_per_length: bool) -> Result<Figure> {
    if let Some(samples) = Samples::of(table) {
        return Ok(samples.figure());
    }
    let values = |name: &str| table.numbers(name);
    let is_known = |name: &str| values(name).iter().any(Option::is_some);
    let mut keys = keys(table)?;
    // A quantity whose key is varied is given, hence is not drawn as a result.
    let varies = |name: &str| {
        let mut names = keys.iter().map(|key| key.name.rsplit('.').next());
        names.any(|last| last == Some(name))
    };
    let is_drawn = |name: &str| match name {
        _ if varies(name) => false,
        "indentation_depth" => {
            let forces = sorted(values("normal_force").into_iter().flatten());
            forces.len() < 2 || keys.iter().any(|key| key.name == "load.normal_force")
        }
        _ => true,
    };
    let mut quantities = drawable();
    let drawn = quantities.find(|quantity| is_known(quantity.key) && is_drawn(quantity.key));
    let quantity = drawn.context("no point has a result")?;
    let name = quantity.key;
    if measured.is_some() && name != FRICTION {
        bail!("no point has a friction coefficient, which was measured");
    }
    let drawn = Drawn {
        label: labelled_in(name, is_per_length),
        is_per_length,
        values: values(name),
        errors: values(&format!("{name}_error")),
        of_material: values(&format!("{name}_material_error")),
        // Read the theory of the quantity, whose column only friction has.
        theory: values(&format!("persson_{name}_2006")),
        hysteresis: match name {
            FRICTION => values("friction_from_hysteresis"),
            _ => Vec::new(),
        },
    };
    let over = keys.remove(abscissa(&keys).context("no key that varies has numbers")?);
    let curves = Curves::new(&keys, table.rows.len(), is_per_length);
    match &keys[..] {
        _ if curves.labels.len() <= MAX_CURVES => {
            let points = measured.map_or(Vec::new(), |measured| {
                measured_series(measured, &keys, &curves)
            });
            Ok(chart(&over, &curves, &drawn, points))
        }
        _ if measured.is_some() => {
            bail!("measured points are drawn over at most {MAX_CURVES} curves")
        }
        [other] if other.n_numbers() > 0 => colour_map([&over, other], &drawn),
        _ => bail!(
            "the keys beside {} have more than {MAX_CURVES} combinations",
            over.name
        ),
    }
}

/// The varied keys of the CSV file of a sweep with their cells, in the order of the columns. An error if it is no such file.
pub(super) fn keys(table: &RowTable) -> Result<Vec<Key<'_>>> {
    let columns = table
        .keys()
        .context("the columns are not those of a sweep")?;
    let key = |place: usize| Key {
        name: &table.header[place],
        cells: table.rows.iter().map(|row| &*row.fields[place]).collect(),
    };
    Ok(columns.map(key).collect())
}

/// Index of the key over which a sweep is drawn, the first of those with the most numbers; `None` if no key has numbers only.
pub(super) fn abscissa(keys: &[Key<'_>]) -> Option<usize> {
    let n_numbers = |key: &usize| keys[*key].n_numbers();
    let most = (0..keys.len()).rev().max_by_key(n_numbers);
    most.filter(|key| n_numbers(key) > 0)
}

/// Quantities that may be drawn, in order of preference.
pub(super) fn drawable() -> impl Iterator<Item = &'static Quantity> {
    DRAWN.into_iter().filter_map(Quantity::named)
}

/// Smallest number of decimals of a number in a legend in scientific notation. Chosen.
const MIN_DECIMALS: usize = 2;
/// Largest number of decimals of a number in a legend: 17 digits are exact for f64.
const MAX_DECIMALS: usize = 16;

/// Largest number of curves that are drawn in one chart. Chosen.
const MAX_CURVES: usize = 6;

/// A varied key with its cell in each row.
pub(super) struct Key<'a> {
    pub(super) name: &'a str,
    pub(super) cells: Vec<&'a str>,
}

impl Key<'_> {
    /// The cells as numbers; `None` for texts.
    pub(super) fn numbers(&self) -> Vec<Option<f64>> {
        self.cells.iter().map(|cell| cell.parse().ok()).collect()
    }

    /// Number of distinct numbers; 0 if a cell is a text.
    fn n_numbers(&self) -> usize {
        let numbers: Option<Vec<f64>> = self.numbers().into_iter().collect();
        numbers.map_or(0, |numbers| sorted(numbers.into_iter()).len())
    }

    /// The cells as in a legend, numbers with as many digits as distinguish them.
    fn shown(&self) -> Vec<String> {
        let numbers: Option<Vec<f64>> = self.numbers().into_iter().collect();
        let Some(numbers) = numbers else {
            return self.cells.iter().map(ToString::to_string).collect();
        };
        let rounded = |decimals: usize| -> Vec<f64> {
            let texts = numbers.iter().map(|number| format!("{number:.decimals$e}"));
            texts.filter_map(|text| text.parse().ok()).collect()
        };
        let n_values = self.n_numbers();
        let are_apart = |decimals: &usize| sorted(rounded(*decimals).into_iter()).len() == n_values;
        let decimals = (MIN_DECIMALS..MAX_DECIMALS).find(are_apart);
        let shown = rounded(decimals.unwrap_or(MAX_DECIMALS));
        shown
            .into_iter()
            .map(|number| MessageNumber(number).to_string())
            .collect()
    }
}

/// Grouping of the rows by the keys that are not on the axis.
struct Curves {
    /// Labels of the curves, in order of first appearance.
    labels: Vec<String>,
    /// Index of the curve of each row.
    of: Vec<usize>,
}

impl Curves {
    /// Groups the rows; labels beyond one more than [`MAX_CURVES`] are not stored.
    fn new(keys: &[Key<'_>], rows: usize, is_per_length: bool) -> Self {
        let (mut labels, mut of) = (Vec::new(), Vec::new());
        let keys: Vec<(&str, Vec<String>)> =
            keys.iter().map(|key| (key.name, key.shown())).collect();
        for row in 0..rows {
            let value = |(path, shown): &(&str, Vec<String>)| {
                let name = path.rsplit('.').next().unwrap_or(path);
                entry(&labelled_in(name, is_per_length), name, &shown[row])
            };
            let label = keys.iter().map(value).collect::<Vec<_>>().join(", ");
            let known = labels.iter().position(|known| *known == label);
            of.push(known.unwrap_or(labels.len()));
            if known.is_none() && labels.len() <= MAX_CURVES {
                labels.push(label);
            }
        }
        Self { labels, of }
    }
}

/// Entry of the legend for a value of a key with a label: a word that needs no key, else the symbol, or the whole label without
/// one, with the value and its unit.
fn entry(label: &str, name: &str, value: &str) -> String {
    match (name, value) {
        ("model", "line") => return "one-dimensional".to_owned(),
        ("model", "half-space") => return "half space".to_owned(),
        ("model" | "method", _) => return value.to_owned(),
        _ => (),
    }
    let parts = label.strip_suffix(']');
    let (quantity, unit) = parts
        .and_then(|label| label.split_once(" ["))
        .unwrap_or((label, ""));
    let last = quantity.rsplit(' ').next().unwrap_or(quantity);
    let is_symbol = last.chars().nth(1).is_none() || last.chars().nth(1) == Some('_');
    let shown = if is_symbol { last } else { quantity };
    format!("{shown} = {value} {unit}").trim_end().to_owned()
}

/// The drawn quantity, by row.
struct Drawn {
    /// Axis label.
    label: String,
    /// Whether forces are per length, as for a cylinder.
    is_per_length: bool,
    /// Values by row; `None` for a row without the quantity.
    values: Vec<Option<f64>>,
    /// Absolute errors by row.
    errors: Vec<Option<f64>>,
    /// Standard error due to the covariance of the material.
    of_material: Vec<Option<f64>>,
    /// Friction by Persson's theory (2006), if known.
    theory: Vec<Option<f64>>,
    /// Part of the friction from hysteresis; unknown without an interface.
    hysteresis: Vec<Option<f64>>,
}

impl Drawn {
    /// Computed values, theory and hysteresis of the given rows, over their abscissae.
    fn series(&self, rows: &[(f64, usize)]) -> [Series; 3] {
        let at = |values: &[Option<f64>], row: usize| values.get(row).copied().flatten();
        let known = |values: &[Option<f64>]| -> Vec<(usize, [f64; 2])> {
            rows.iter()
                .filter_map(|&(x, row)| Some((row, [x, at(values, row)?])))
                .collect()
        };
        let line = |dash| Line::thin(dash);
        let (rows_of_points, points): (Vec<usize>, Vec<[f64; 2]>) =
            known(&self.values).into_iter().unzip();
        let lengths = |values: &[Option<f64>], factor: f64| {
            let length = |row: &usize| factor * at(values, *row).unwrap_or(0.0);
            rows_of_points.iter().map(length).collect()
        };
        let has_band = self.of_material.iter().any(Option::is_some);
        let computed = Series {
            marker: Some(Marker::filled(Shape::Circle)),
            errors: lengths(&self.errors, 1.0),
            band: if has_band {
                lengths(&self.of_material, HALF_WIDTH_95_PERCENT)
            } else {
                Vec::new()
            },
            ..Series::line(points, line(Dash::Solid), Colour::Blue)
        };
        let curve = |values| -> Vec<[f64; 2]> {
            known(values).into_iter().map(|(_, point)| point).collect()
        };
        let theory = Series::reference(curve(&self.theory), Dash::Dashed, Colour::Blue);
        let hysteresis = Series::line(curve(&self.hysteresis), line(Dash::Dotted), Colour::Blue);
        [computed, theory, hysteresis]
    }
}

/// Markers of the measured points of each curve that has some; of all curves together if they have the same points.
fn measured_series(measured: &Measured, keys: &[Key<'_>], curves: &Curves) -> Vec<Series> {
    let of_curve = |curve: usize| {
        let row = curves.of.iter().position(|of| *of == curve);
        let points = row
            .into_iter()
            .flat_map(|row| measured.points_at(keys, row));
        points.copied().collect::<Vec<_>>()
    };
    let mut points: Vec<_> = (0..curves.labels.len()).map(of_curve).collect();
    let is_shared = points.iter().all(|of_curve| *of_curve == points[0]);
    if is_shared {
        points.truncate(1);
    }
    let mut series: Vec<Series> = Vec::new();
    let with_points = points.into_iter().enumerate();
    for (curve, points) in with_points.filter(|(_, points)| !points.is_empty()) {
        let places = points
            .iter()
            .map(|point| [point.velocity, point.friction_coefficient]);
        let colour = if is_shared {
            Colour::Black
        } else {
            COLOURS[curve % COLOURS.len()]
        };
        let marker = Marker::open(SHAPES[curve % SHAPES.len()]);
        series.push(Series {
            errors: points
                .iter()
                .filter_map(|point| point.standard_error)
                .collect(),
            label: series.is_empty().then(|| "measured".to_owned()),
            ..Series::markers(places.collect(), marker, colour)
        });
    }
    series
}

/// A chart of all curves over a key, and of measured points.
fn chart(over: &Key, curves: &Curves, drawn: &Drawn, measured: Vec<Series>) -> Figure {
    let numbers = over.numbers();
    let mut others = drawn.theory.iter().chain(&drawn.hysteresis);
    let is_labelled = !measured.is_empty() || others.any(Option::is_some);
    let mut series = Vec::new();
    for (curve, name) in curves.labels.iter().enumerate() {
        let mut rows: Vec<(f64, usize)> = (0..numbers.len())
            .filter(|row| curves.of[*row] == curve)
            .filter_map(|row| Some((numbers[row]?, row)))
            .collect();
        // Rows of shards and of several threads may be in any order.
        rows.sort_by(|(one, _), (other, _)| one.total_cmp(other));
        let [mut computed, mut theory, mut hysteresis] = drawn.series(&rows);
        computed.colour = COLOURS[curve % COLOURS.len()];
        theory.colour = computed.colour;
        hysteresis.colour = computed.colour;
        computed.marker = Some(Marker::filled(SHAPES[curve % SHAPES.len()]));
        computed.label = match &name[..] {
            "" => is_labelled.then(|| "computed".to_owned()),
            name => Some(name.to_owned()),
        };
        let is_last = curve + 1 == curves.labels.len();
        theory.label = is_last.then(|| "theory, Persson (2006)".to_owned());
        hysteresis.label = is_last.then(|| "hysteresis".to_owned());
        let is_seen = |one: &Series| one.points.len() > usize::from(one.marker.is_none());
        series.extend([computed, theory, hysteresis].into_iter().filter(is_seen));
    }
    let of_axis: Vec<f64> = series.iter().flat_map(abscissae).collect();
    let all = of_axis
        .iter()
        .copied()
        .chain(measured.iter().flat_map(abscissae));
    let x = axis(
        &labelled_in(over.name, drawn.is_per_length),
        &sorted(of_axis.iter().copied()),
        range_of(&sorted(all)),
    );
    series.extend(measured);
    let data = series.iter().filter(|one| !one.is_reference);
    let bars = data.flat_map(|one| {
        let or_none = |lengths: &[f64], place: usize| lengths.get(place).copied().unwrap_or(0.0);
        let length = move |place| or_none(&one.errors, place).max(or_none(&one.band, place));
        let points = one.points.iter().enumerate();
        points.map(move |(place, point)| (point, length(place)))
    });
    let ends = bars.flat_map(|(point, error)| [point[1] - error, point[1] + error]);
    let y = Axis::linear(&*drawn.label, range_with_zero(ends));
    let has_band = series.iter().any(|one| !one.band.is_empty());
    Figure::single(Chart {
        title: has_band.then(|| "bars: computation; band: 95 % by the moduli".to_owned()),
        ..Chart::new(x, y, series)
    })
}

/// Half width of the central 95 % interval of a normal distribution, in standard deviations.
pub(super) const HALF_WIDTH_95_PERCENT: f64 = 1.96;

/// Abscissae of a series.
fn abscissae(series: &Series) -> impl Iterator<Item = f64> {
    series.points.iter().map(|point| point[0])
}

/// An axis between two ends with a margin, so that no marker is cut; logarithmic for computed places with equal factors or in a
/// wide range.
fn axis(label: &str, places: &[f64], [low, high]: [f64; 2]) -> Axis {
    let [first, last] = range_of(places);
    let is_wide = first > 0.0 && last / first >= MIN_LOGARITHMIC_RATIO;
    if last >= 2.0 * first && !is_arithmetic(places) && (is_geometric(places) || is_wide) {
        let room = (high / low).powf(AXIS_MARGIN);
        return Axis::log10(label, [low / room, high * room]);
    }
    let room = AXIS_MARGIN * (high - low);
    Axis::linear(label, [low - room, high + room])
}

/// Ratio of the margin at each end of an axis to its length. Chosen.
const AXIS_MARGIN: f64 = 0.03;

/// Colours of successive curves.
const COLOURS: [Colour; 5] = [
    Colour::Blue,
    Colour::Red,
    Colour::Green,
    Colour::Magenta,
    Colour::Black,
];
/// Markers of successive curves.
const SHAPES: [Shape; 3] = [Shape::Circle, Shape::Square, Shape::Diamond];

/// Last part of a key, with name, symbol and unit of a number of the scene that has a symbol and is no quantity of an answer.
const NAMES: [(&str, &str); 15] = [
    ("velocity", "speed v [m/s]"),
    ("radius", "radius R [m]"),
    ("hurst_exponent", "Hurst exponent H"),
    ("direction", "direction [°]"),
    ("sliding_distance", "sliding distance s [m]"),
    ("duration", "duration t [s]"),
    ("viscosity", "viscosity η [Pa s]"),
    ("relaxation_time", "relaxation time τ [s]"),
    ("equilibrium_modulus", "equilibrium modulus G∞ [Pa]"),
    ("poisson_ratio", "Poisson ratio ν"),
    ("track", "track L [m]"),
    ("stroke", "stroke s [m]"),
    ("frequency", "frequency f [1/s]"),
    ("thickness", "thickness h [m]"),
    ("temperature", "temperature T [°C]"),
];

/// Axis label of a key: its quantity and unit, or the key itself if it is unknown, or one of a list.
pub(crate) fn labelled(key: &str) -> String {
    let name = key.rsplit('.').next().unwrap_or(key);
    if let Some(quantity) = Quantity::named(name) {
        return quantity.label();
    }
    if let Some((_, label)) = NAMES.iter().find(|(known, _)| *known == name) {
        return (*label).to_owned();
    }
    let quantity = name.replace('_', " ");
    let quantity = if key.contains('[') { key } else { &quantity };
    match units().get(name) {
        Some(Some("")) => quantity.to_owned(),
        Some(Some(unit)) => format!("{quantity} [{unit}]"),
        _ => key.to_owned(),
    }
}

/// Axis label of a key as [`labelled`], with units per length if the body is a cylinder.
pub(crate) fn labelled_in(key: &str, is_per_length: bool) -> String {
    let name = key.rsplit('.').next().unwrap_or(key);
    match Quantity::named(name).filter(|_| is_per_length) {
        Some(quantity) => quantity.label_of_cylinder(),
        None => labelled(key),
    }
}

/// True if the body of a sweep is a cylinder, by the scene if it is known, else by a key that varies.
pub(super) fn is_cylinder(table: &RowTable, scene: Option<&str>) -> bool {
    let parsed = scene.and_then(|text| text.parse::<toml::Table>().ok());
    let in_scene = parsed
        .as_ref()
        .and_then(|scene| scene.get("indenter")?.get("cylinder"));
    let mut keys = table.keys().unwrap_or(0..0);
    in_scene.is_some() || keys.any(|key| table.header[key].starts_with("indenter.cylinder"))
}

/// A colour map of a quantity over two keys. An error if the values of a key are not equally spaced.
fn colour_map([one, other]: [&Key<'_>; 2], drawn: &Drawn) -> Result<Figure> {
    let over = [one, other].map(Key::numbers);
    let places = [0, 1].map(|axis: usize| sorted(over[axis].iter().copied().flatten()));
    let place = |x: f64, y: f64| [x, y].map(f64::to_bits);
    let mut found = HashMap::new();
    for ((x, y), value) in over[0].iter().zip(&over[1]).zip(&drawn.values) {
        if let (Some(x), Some(y), Some(value)) = (x, y, value) {
            found.insert(place(*x, *y), *value);
        }
    }
    let colours = Axis::linear(&*drawn.label, range_of(&sorted(found.values().copied())));
    let shape = [places[0].len(), places[1].len()];
    let field = Field::new(shape, colours, |column, row| {
        let place = place(places[0][column], places[1][row]);
        found.get(&place).copied()
    });
    let cells = |key: &Key<'_>, places: &[f64]| {
        cells(
            key.name,
            &labelled_in(key.name, drawn.is_per_length),
            places,
        )
    };
    let [x, y] = [cells(one, &places[0])?, cells(other, &places[1])?];
    Ok(Figure::single(Chart::map(x, y, field.stretched())))
}

/// An axis whose cells are centred at the values `places` of a key with a label, linear or logarithmic. An error for a single value, and for
/// values neither at equal steps nor at equal factors.
fn cells(key: &str, label: &str, places: &[f64]) -> Result<Axis> {
    let (Some(first), Some(last), true) = (places.first(), places.last(), places.len() > 1) else {
        bail!("{key} has only one value");
    };
    let steps = (places.len() - 1) as f64;
    if is_arithmetic(places) {
        let half = 0.5 * (last - first) / steps;
        Ok(Axis::linear(label, [first - half, last + half]))
    } else if is_geometric(places) {
        let half = (last / first).powf(0.5 / steps);
        Ok(Axis::log10(label, [first / half, last * half]))
    } else {
        bail!("the values of {key} are neither an equal step nor an equal factor apart")
    }
}

/// True if the values have equal steps.
fn is_arithmetic(places: &[f64]) -> bool {
    are_equal(places.windows(2).map(|pair| pair[1] - pair[0]))
}

/// True if the values are positive and have equal factors.
fn is_geometric(places: &[f64]) -> bool {
    let factors = places.windows(2).map(|pair| (pair[1] / pair[0]).ln());
    places.first().is_some_and(|first| *first > 0.0) && are_equal(factors)
}

/// True if all steps agree within [`EQUAL_STEP_TOLERANCE`].
fn are_equal(steps: impl Iterator<Item = f64>) -> bool {
    let steps = sorted(steps);
    let (Some(least), Some(most)) = (steps.first(), steps.last()) else {
        return true;
    };
    most - least <= EQUAL_STEP_TOLERANCE * most
}

/// Distinct values in increasing order.
fn sorted(values: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    values.dedup_by(|one, other| one.total_cmp(other).is_eq());
    values
}

/// Smallest and largest of sorted values; around a single value c the range from c/2 to 3c/2, around 0 [−1, 1].
fn range_of(values: &[f64]) -> [f64; 2] {
    let [low, high] = [values.first(), values.last()].map(|value| value.copied().unwrap_or(0.0));
    if high > low {
        return [low, high];
    }
    let room = if low == 0.0 { 1.0 } else { 0.5 * low.abs() };
    [low - room, high + room]
}
