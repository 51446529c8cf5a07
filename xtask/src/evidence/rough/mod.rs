//! Theories beside random rough surfaces that slide: friction and area over speeds, loads, spectra and solids.

mod line;
mod pages;
mod theories;

use std::ops::RangeInclusive;
use std::path::Path;

use anyhow::{Context, Result, ensure};
use serde::{Serialize, Serializer};
use viscofriction::scene::Source;
use viscofriction::sweep::{Plan, Vary, header};
use viscofriction_plot::{Axis, Colour, Figure, Marker, Series, Shape};

use super::Report;
use crate::output::WrongInput;
use crate::picture::chart;
use crate::table::{GrowingTable, ROWS_AT_ONCE, Table, group_by};

/// File of the rows that were computed, from which an interrupted run goes on.
const ROWS: &str = "rough.csv";

/// A theory of a quantity that is also solved for.
struct Theory {
    /// Quantity over theory, for people.
    name: &'static str,
    /// Column of the solution.
    solved: &'static str,
    /// Column of what the theory says.
    predicted: &'static str,
}

/// A theory of the friction coefficient.
const fn friction(name: &'static str, predicted: &'static str) -> Theory {
    let solved = "friction_coefficient";
    Theory {
        name,
        solved,
        predicted,
    }
}

/// A theory of the area fraction.
const fn area(name: &'static str, predicted: &'static str) -> Theory {
    let solved = "area_fraction";
    Theory {
        name,
        solved,
        predicted,
    }
}

/// All theories, those of friction first. The indices of [`DRAWN_THEORIES`] and of the tables refer to this order.
const THEORIES: [Theory; 7] = [
    friction("friction / Persson (2001)", "persson_friction_coefficient"),
    friction(
        "friction / Persson (2006)",
        "persson_friction_coefficient_2006",
    ),
    friction("friction / Wang and Müser (2017)", theories::COLUMNS[0]),
    friction("friction / line, longest wave", theories::COLUMNS[1]),
    friction("friction / line, period", theories::COLUMNS[2]),
    area("area / Persson (2001)", "persson_area_fraction"),
    area("area / Xu (2024)", theories::COLUMNS[3]),
];
/// Indices in [`THEORIES`] of those that have a panel in the picture.
const DRAWN_THEORIES: [usize; 6] = [0, 1, 3, 4, 5, 6];

/// A solid under the rough surfaces.
struct Solid {
    /// For tables and the picture.
    name: &'static str,
    /// Contents of its scene file.
    scene: &'static str,
    /// About the geometric mean of its moduli at rest and in the glass, in the unit of its scene; it scales the pressures.
    stiffness: f64,
    /// `slowest:fastest` speed around its transition, in the unit of its scene.
    speeds: &'static str,
    /// How its points are drawn.
    marker: (Shape, Colour),
}

/// Two three-element solids of the ratio of moduli in their name, and a rubber of many branches.
const SOLIDS: [Solid; 3] = [
    Solid {
        name: "standard-10",
        scene: include_str!("standard-10.toml"),
        stiffness: 3.0,
        speeds: "1e-5:1e1",
        marker: (Shape::Circle, Colour::Blue),
    },
    Solid {
        name: "standard-1000",
        scene: include_str!("standard-1000.toml"),
        stiffness: 30.0,
        speeds: "1e-6:1e1",
        marker: (Shape::Square, Colour::Red),
    },
    Solid {
        name: "rubber",
        scene: include_str!("rubber.toml"),
        stiffness: 40.0,
        speeds: "1e-4:1e8",
        marker: (Shape::Diamond, Colour::Green),
    },
];
/// Hurst exponent of each spectrum, and how often its longest and its shortest wave fit into the period.
const SPECTRA: [[f64; 3]; 10] = [
    [0.6, 2.0, 8.0],
    [0.6, 4.0, 16.0],
    [0.6, 8.0, 32.0],
    [0.6, 16.0, 64.0],
    [0.6, 4.0, 32.0],
    [0.6, 4.0, 64.0],
    [0.3, 4.0, 64.0],
    [0.9, 4.0, 64.0],
    [0.6, 32.0, 128.0],
    [0.6, 4.0, 256.0],
];
/// Number of surfaces of each spectrum in a full run and in a quick one. Chosen.
const SURFACES: [usize; 2] = [10, 2];
/// Number of speeds under each pressure in a full run and in a quick one. Chosen.
const SPEEDS: [usize; 2] = [5, 2];
/// Largest deviation from 1 of the ratio of solution to theory with which the theory counts as right. Chosen.
const RIGHT_WITHIN: f64 = 0.1;
/// Range of the ratios of solution to theory that are drawn. Chosen; those beyond are left out of the picture, not of the tables.
const DRAWN_RATIOS: RangeInclusive<f64> = 0.01..=10.0;
/// Lower ends of the classes of the area fraction in the tables. Chosen; points below the first are not drawn.
const AREAS: [f64; 7] = [1e-3, 0.01, 0.03, 0.1, 0.3, 0.6, 0.9];

/// Compares the theories with the solutions of all scenes; those in a file in `out` are not computed again. A quick run takes
/// a few cheap ones.
pub(super) fn report(out: &Path, quick: bool) -> Result<Report> {
    let surfaces = SURFACES[usize::from(quick)];
    let spectra = if quick { &SPECTRA[..1] } else { &SPECTRA };
    let mut plans = Vec::new();
    for solid in &SOLIDS {
        for spectrum in spectra {
            plans.push((solid.name, plan(solid, *spectrum, surfaces, quick)?));
        }
    }
    let file = out.join(ROWS);
    let rows = read(&file, &plans[0].1)?;
    let mut table = GrowingTable { file, rows };
    // Compute one surface after the other, so that the rows of an interrupted run are of all solids and spectra.
    let mut missing = Vec::new();
    for surface in 0..surfaces {
        for (solid, plan) in &plans {
            let each = plan.n_points() / surfaces;
            let points = surface * each..(surface + 1) * each;
            let absent = points.filter(|point| {
                let identity = plan.identity(*point);
                !table.rows.iter().any(|row| row[1..].starts_with(&identity))
            });
            missing.extend(absent.map(|point| (*solid, plan, point)));
        }
    }
    table.extend(&missing, ROWS_AT_ONCE, |(solid, plan, point)| {
        let mut row = vec![(*solid).to_owned()];
        row.extend(plan.solve(*point)?.fields);
        let theories = theories::solve(&plan.problem(*point)?)?;
        row.extend(theories.map(|value| value.map_or_else(String::new, |value| value.to_string())));
        Ok(vec![row])
    })?;
    let rows = &table.rows;
    let points = points(rows, surfaces);
    Ok(Report {
        name: "rough",
        tables: vec![Table::new("rough_points", &pages::rows(&points))?],
        pictures: vec![("rough", figure(&points))],
        summary: pages::summary(&points, rows.len() - 1),
        ..Report::default()
    })
}

/// The sweep of one solid and one spectrum over seeds (outermost), mean pressures and speeds (innermost).
fn plan(
    solid: &Solid,
    [hurst_exponent, longest, shortest]: [f64; 3],
    surfaces: usize,
    quick: bool,
) -> Result<Plan> {
    let source = Source::new(Path::new("rough.toml"), solid.scene.into())?;
    let loads = [0.02, 0.1, 0.5].map(|load| (load * solid.stiffness).to_string());
    let count = SPEEDS[usize::from(quick)];
    let seeds: Vec<String> = (1..=surfaces).map(|seed| seed.to_string()).collect();
    let one = |key, value| format!("indenter.self-affine.{key}={value}:{value}:1");
    let vary = [
        format!("indenter.self-affine.seed={}", seeds.join(",")),
        one("hurst_exponent", hurst_exponent),
        one("longest_wavelength", longest.recip()),
        one("shortest_wavelength", shortest.recip()),
        format!("load.mean_pressure={}", loads.join(",")),
        format!("load.velocity={}:{count}:log", solid.speeds),
    ];
    let vary: Vec<Vary> = vary
        .iter()
        .map(|vary| vary.parse())
        .collect::<Result<_, _>>()
        .map_err(WrongInput)?;
    Ok(Plan::new(source, &vary, |_, _| Ok(Vec::new()))?)
}

/// The header, then rows; each is the name of the solid, a row of a sweep, and the numbers of [`theories::COLUMNS`].
type Rows = Vec<Vec<String>>;

/// The rows of a file, or only the header if it is not there; fails where the file has another header.
fn read(file: &Path, plan: &Plan) -> Result<Rows> {
    let header = std::iter::once("solid".to_owned()).chain(header(plan));
    let header: Vec<String> = header.chain(theories::COLUMNS.map(str::to_owned)).collect();
    if !file.exists() {
        return Ok(vec![header]);
    }
    let reader = csv::ReaderBuilder::new().has_headers(false).from_path(file);
    let rows = reader?
        .deserialize()
        .collect::<Result<Rows, _>>()
        .with_context(|| format!("reading {}", file.display()))?;
    let other = format!("{} is of another run; take another --out", file.display());
    ensure!(rows.first() == Some(&header), WrongInput(other));
    Ok(rows)
}

/// All surfaces of a spectrum under one pressure at one speed.
#[derive(Serialize)]
struct Point<'a> {
    solid: &'a str,
    hurst_exponent: f64,
    longest_waves_in_period: f64,
    shortest_waves_in_longest: f64,
    mean_pressure: f64,
    velocity: f64,
    /// Mean over the surfaces, and the mean of their error bars.
    #[serde(serialize_with = "five_digits")]
    area_fraction: f64,
    #[serde(serialize_with = "five_digits")]
    area_fraction_error: f64,
    /// One for each of [`THEORIES`]; `None` where the theory has no number for some surface.
    #[serde(skip)]
    ratios: [Option<Ratio>; THEORIES.len()],
    /// For each surface: friction coefficient, and that by Persson's theory of 2001 and of 2006.
    #[serde(skip)]
    frictions: Vec<[f64; 3]>,
}

/// Ratio of the mean of the solutions to the mean that one theory predicts.
#[derive(Clone, Copy, Serialize)]
struct Ratio {
    /// Name of the theory.
    quantity: &'static str,
    #[serde(serialize_with = "five_digits")]
    ratio: f64,
    #[serde(serialize_with = "five_digits")]
    standard_error: f64,
}

/// Writes a number with five significant digits, as far as such ratios are reproducible.
fn five_digits<S: Serializer>(value: &f64, serializer: S) -> Result<S::Ok, S::Error> {
    serializer.collect_str(&format_args!("{value:.4e}"))
}

/// The points at which all `surfaces` have an answer. A mean over fewer would be biased, because whether a surface is answered
/// depends on its contact.
fn points(rows: &Rows, surfaces: usize) -> Vec<Point<'_>> {
    let place = |name: &str| rows[0].iter().position(|column| column == name);
    let number =
        |row: &[String], name: &str| -> Option<f64> { row.get(place(name)?)?.parse().ok() };
    let given = [
        "indenter.self-affine.hurst_exponent",
        "indenter.self-affine.longest_wavelength",
        "indenter.self-affine.shortest_wavelength",
        "load.mean_pressure",
        "load.velocity",
    ];
    // Group the rows by the point that they belong to; rows of one point differ in the seed only.
    let groups = group_by(&rows[1..], |row| -> Vec<&str> {
        let of_point = given.iter().filter_map(|name| Some(&*row[place(name)?]));
        std::iter::once(&*row[0]).chain(of_point).collect()
    });
    let known = groups.into_iter().filter_map(|(key, rows)| {
        let answered = |row: &&&Vec<String>| place("failure").is_some_and(|at| row[at].is_empty());
        let all = |name: &str| -> Option<Vec<f64>> {
            let numbers = rows.iter().filter(answered).map(|row| number(row, name));
            let numbers: Option<Vec<f64>> = numbers.collect();
            numbers.filter(|numbers| numbers.len() == surfaces)
        };
        let mean = |name: &str| Some(all(name)?.iter().sum::<f64>() / surfaces as f64);
        let over = |theory: Theory| {
            let [solved, predicted] = [theory.solved, theory.predicted].map(all);
            Some(ratio(theory.name, &solved?, &predicted?))
        };
        let given = |index: usize| key[index].parse::<f64>().ok();
        let (longest, shortest) = (given(2)?, given(3)?);
        let columns = [
            THEORIES[0].solved,
            THEORIES[0].predicted,
            THEORIES[1].predicted,
        ];
        let [friction, of_2001, of_2006] = columns.map(all);
        let pairs = friction?.into_iter().zip(of_2001?).zip(of_2006?);
        Some(Point {
            solid: key[0],
            hurst_exponent: given(1)?,
            longest_waves_in_period: longest.recip(),
            shortest_waves_in_longest: longest / shortest,
            mean_pressure: given(4)?,
            velocity: given(5)?,
            area_fraction: mean("area_fraction")?,
            area_fraction_error: mean("area_fraction_error")?,
            ratios: THEORIES.map(over),
            frictions: pairs.map(|((one, two), three)| [one, two, three]).collect(),
        })
    });
    known.collect()
}

/// The ratio of the means of paired numbers, solution and theory of each surface, with its standard error to first order
/// (ratio estimator of survey sampling).
fn ratio(quantity: &'static str, solved: &[f64], theory: &[f64]) -> Ratio {
    let count = solved.len() as f64;
    let [sum, of_theory] = [solved, theory].map(|numbers| numbers.iter().sum::<f64>());
    let ratio = sum / of_theory;
    let pairs = solved.iter().zip(theory);
    let squares: f64 = pairs
        .map(|(one, other)| (one - ratio * other).powi(2))
        .sum();
    Ratio {
        quantity,
        ratio,
        standard_error: (squares * count / (count - 1.0)).sqrt() / of_theory,
    }
}

/// A panel for each drawn theory: ratio of solution to theory over the area fraction, both logarithmic.
fn figure(points: &[Point]) -> Figure {
    let charts = DRAWN_THEORIES.map(|theory| {
        let series = SOLIDS.iter().map(|solid| {
            let of_solid = points.iter().filter(|point| point.solid == solid.name);
            let points = of_solid
                .filter_map(|point| Some([point.area_fraction, point.ratios[theory]?.ratio]));
            let points =
                points.filter(|[area, ratio]| *area > AREAS[0] && DRAWN_RATIOS.contains(ratio));
            let (shape, colour) = solid.marker;
            Series::markers(points.collect(), Marker::open(shape), colour).labelled(solid.name)
        });
        chart(
            Axis::log10("area fraction", [AREAS[0], 1.0]),
            Axis::log10(
                THEORIES[theory].name,
                [*DRAWN_RATIOS.start(), *DRAWN_RATIOS.end()],
            ),
            series.collect(),
        )
    });
    Figure::new(charts, 2)
}
