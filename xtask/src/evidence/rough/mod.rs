//! Persson's theory beside random rough surfaces that slide: friction and area over speeds, loads, spectra and solids.

use std::collections::BTreeMap;
use std::path::Path;

use anyhow::{Context, Result, ensure};
use viscofriction::scene::Source;
use viscofriction::sweep::{Plan, Vary, header, identity};
use viscofriction_plot::{Axis, Chart, Colour, Figure, LegendPlace, Marker, Series, Shape};

use super::Report;
use crate::meter::median;
use crate::output::{WrongInput, markdown_table, write_atomically};
use crate::tasks;

/// Rows that were computed; an interrupted run goes on where it was.
const ROWS: &str = "rough.csv";
/// Points that are computed before they are written.
const AT_ONCE: usize = 64;
/// Names and scenes of the solids; about the geometric means of their moduli of rest and glass, and speeds around the
/// transition; how they are drawn.
const SOLIDS: [(&str, &str); 3] = [
    ("standard-10", include_str!("standard-10.toml")),
    ("standard-1000", include_str!("standard-1000.toml")),
    ("rubber", include_str!("rubber.toml")),
];
const RANGES: [(f64, &str); 3] = [(3.0, "1e-5:1e1"), (30.0, "1e-6:1e1"), (40.0, "1e-4:1e8")];
const STYLES: [(Shape, Colour); 3] = [
    (Shape::Circle, Colour::Blue),
    (Shape::Square, Colour::Red),
    (Shape::Diamond, Colour::Green),
];
/// A theory is right where it is not farther from the surfaces than this.
const WITHIN: f64 = 0.1;
/// Ends of the classes of the area fraction; what is below the first is not drawn.
const AREAS: [f64; 7] = [1e-3, 0.01, 0.03, 0.1, 0.3, 0.6, 0.9];

/// Compares the theory with all scenes, of which `out` may hold some; a quick run takes a few cheap ones.
pub(super) fn report(out: &Path, quick: bool) -> Result<Report> {
    let plans = SOLIDS.iter().zip(RANGES);
    let plans = plans.map(|((_, scene), range)| plan(scene, range, quick));
    let plans: Vec<Plan> = plans.collect::<Result<_>>()?;
    let file = out.join(ROWS);
    let mut rows = read(&file, &plans[0])?;
    // One surface after the other, so that what is there of a run that was interrupted is of all solids.
    let surfaces = if quick { 2 } else { 4 };
    let mut missing = Vec::new();
    for surface in 0..surfaces {
        for (plan, (solid, ..)) in plans.iter().zip(SOLIDS) {
            let each = plan.n_points() / surfaces;
            let points = surface * each..(surface + 1) * each;
            let points = points.map(|point| (solid, plan, point));
            missing.extend(points.filter(|(_, plan, point)| {
                let identity = identity(plan, *point);
                !rows.iter().any(|row| row[1..].starts_with(&identity))
            }));
        }
    }
    for (done, some) in missing.chunks(AT_ONCE).enumerate() {
        let task = format!("rough surfaces, {} of {}", done * AT_ONCE, missing.len());
        let solved = tasks::in_parallel(task, some, |(solid, plan, point)| {
            let fields = plan.solve(*point)?.fields;
            Ok(std::iter::once((*solid).to_owned()).chain(fields).collect())
        })?;
        rows.extend(solved);
        write_atomically(&file, csv(&rows)?.as_bytes())?;
    }
    let ratios = ratios(&rows);
    let [all, known] = [rows.len() - 1, ratios.len()];
    let table = table(&ratios);
    let summary = format!("{table}\n\n{known} of {all} scenes in [{ROWS}]({ROWS}) have an answer.");
    Ok(Report {
        name: "rough",
        tables: Vec::new(),
        pictures: vec![("rough", figure(&ratios))],
        summary,
        failure: None,
    })
}

fn plan(scene: &str, (stiffness, speeds): (f64, &str), quick: bool) -> Result<Plan> {
    let source = Source::new(Path::new("rough.toml"), scene.into())?;
    let loads = [0.02, 0.1, 0.5].map(|load| (load * stiffness).to_string());
    let (surface, count) = if quick {
        ("seed=1,2", 3)
    } else {
        (
            "seed=1,2,3,4 hurst_exponent=0.3,0.6,0.9 shortest_wavelength=0.125,0.0625,0.03125",
            13,
        )
    };
    let surface = surface.split(' ');
    let surface = surface.map(|vary| format!("indenter.self-affine.{vary}"));
    let load = format!("load.mean_pressure={}", loads.join(","));
    let speed = format!("load.velocity={speeds}:{count}:log");
    let vary = surface.chain([load, speed]).map(|vary| vary.parse());
    let vary: Vec<Vary> = vary.collect::<Result<_, _>>().map_err(WrongInput)?;
    Ok(Plan::new(source, &vary, |_| Ok(Vec::new()))?)
}

/// The header, and rows of sweeps behind the name of the solid.
type Rows = Vec<Vec<String>>;

/// What is in the file, if it is there.
fn read(file: &Path, plan: &Plan) -> Result<Rows> {
    let header = std::iter::once("solid".to_owned()).chain(header(plan));
    let header: Vec<String> = header.collect();
    if !file.exists() {
        return Ok(vec![header]);
    }
    let reader = csv::ReaderBuilder::new().has_headers(false).from_path(file);
    let rows: Result<Rows, _> = reader?.deserialize().collect();
    let rows = rows.with_context(|| format!("reading {}", file.display()))?;
    let other = format!("{} is of another run; take another --out", file.display());
    ensure!(rows.first() == Some(&header), WrongInput(other));
    Ok(rows)
}

fn csv(rows: &Rows) -> Result<String> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for row in rows {
        writer.write_record(row)?;
    }
    Ok(String::from_utf8(writer.into_inner()?)?)
}

/// Name of the solid, area fraction, and friction and area over those of the theory.
type Ratios<'a> = (&'a str, [f64; 3]);

fn ratios(rows: &Rows) -> Vec<Ratios<'_>> {
    let ratios = |row: &Vec<String>| {
        let of = |name: &str| -> Option<f64> {
            let place = rows[0].iter().position(|column| column == name)?;
            row.get(place)?.parse().ok()
        };
        let area = of("area_fraction")?;
        let friction = of("friction_coefficient")? / of("persson_friction_coefficient")?;
        Some([area, friction, area / of("persson_area_fraction")?])
    };
    let rows = rows.iter();
    rows.filter_map(|row| Some((&*row[0], ratios(row)?)))
        .collect()
}

/// By solid and class of area: scenes, ratios with their scatter, and how many are within a tenth.
fn table(ratios: &[Ratios]) -> comfy_table::Table {
    let mut classes: BTreeMap<(&str, usize), Vec<[f64; 3]>> = BTreeMap::new();
    for (solid, ratios) in ratios {
        let class = AREAS.partition_point(|end| ratios[0] >= *end);
        classes.entry((solid, class)).or_default().push(*ratios);
    }
    let header = "solid|area fraction from|scenes|friction / theory|90 % between|within a tenth|area / theory|90 % between|within a tenth";
    let lines = classes.into_iter().map(|((solid, class), ratios)| {
        let from = if class == 0 { 0.0 } else { AREAS[class - 1] };
        let mut line = vec![solid.to_owned(), from.to_string(), ratios.len().to_string()];
        for quantity in [1, 2] {
            let mut values: Vec<f64> = ratios.iter().map(|ratios| ratios[quantity]).collect();
            values.sort_by(f64::total_cmp);
            let last = values.len() - 1;
            let within = values.iter().filter(|ratio| (*ratio - 1.0).abs() <= WITHIN);
            let within = 100 * within.count() / values.len();
            let [low, high] = [last / 20, last - last / 20].map(|place| values[place]);
            line.push(format!("{:.2}", median(values)));
            line.push(format!("{low:.2} to {high:.2}"));
            line.push(format!("{within} %"));
        }
        line
    });
    markdown_table(header.split('|'), lines)
}

/// Friction over that of the theory, over the area.
fn figure(ratios: &[Ratios]) -> Figure {
    let series = SOLIDS
        .iter()
        .zip(STYLES)
        .map(|((name, _), (shape, colour))| {
            let of_solid = ratios.iter().filter(|(solid, _)| solid == name);
            let points = of_solid.map(|(_, [area, friction, _])| [*area, *friction]);
            let points = points.filter(|[area, _]| *area > AREAS[0]).collect();
            Series::markers(points, Marker::open(shape), colour).labelled(*name)
        });
    Figure::single(Chart {
        title: Some("Friction of rough surfaces over Persson's theory".to_owned()),
        legend: LegendPlace::Below,
        ..Chart::new(
            Axis::log10("area fraction", [AREAS[0], 1.0]),
            Axis::linear("friction / theory", [0.0, 1.5]),
            series.collect(),
        )
    })
}
