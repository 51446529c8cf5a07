//! Theories beside random rough surfaces that slide: friction and area over speeds, loads, spectra and solids.

mod line;

use std::collections::BTreeMap;
use std::ops::RangeInclusive;
use std::path::Path;

use anyhow::{Context, Result, ensure};
use viscofriction::scene::Source;
use viscofriction::sweep::{Plan, Vary, header, identity};
use viscofriction_plot::{Axis, Colour, Figure, Marker, Series, Shape};

use super::Report;
use super::report::resume;
use crate::meter::median;
use crate::output::{WrongInput, markdown_table};
use crate::picture::chart;

/// Rows that were computed; an interrupted run goes on where it was.
const ROWS: &str = "rough.csv";
/// Column of the one-dimensional model.
const LINE: &str = "line_friction_coefficient";
/// What the quantities that are solved for are compared with: how it is called, and the columns of both.
const THEORIES: [(&str, [&str; 2]); 4] = [
    (
        "friction / Persson (2001)",
        ["friction_coefficient", "persson_friction_coefficient"],
    ),
    (
        "friction / Persson (2006)",
        ["friction_coefficient", "persson_friction_coefficient_2006"],
    ),
    ("friction / line", ["friction_coefficient", LINE]),
    ("area / Persson", ["area_fraction", "persson_area_fraction"]),
];
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
/// Ratios that are drawn.
const DRAWN: RangeInclusive<f64> = 0.01..=10.0;
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
    resume((&file, &mut rows), &missing, |(solid, plan, point)| {
        let mut row = vec![(*solid).to_owned()];
        row.extend(plan.solve(*point)?.fields);
        let of_line = line::friction(&plan.problem(*point)?)?;
        let of_line = of_line.map(|friction| friction.to_string());
        row.push(of_line.unwrap_or_default());
        Ok(vec![row])
    })?;
    let ratios = ratios(&rows);
    let [all, known] = [rows.len() - 1, ratios.len()];
    let table = table(&ratios);
    let summary = format!("{table}\n\n{known} of {all} scenes in [{ROWS}]({ROWS}) have an answer.");
    Ok(Report {
        name: "rough",
        pictures: vec![("rough", figure(&ratios))],
        summary,
        ..Report::default()
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
    Ok(Plan::new(source, &vary, |_, _| Ok(Vec::new()))?)
}

/// The header, and rows of sweeps behind the name of the solid.
type Rows = Vec<Vec<String>>;

/// What is in the file, if it is there.
fn read(file: &Path, plan: &Plan) -> Result<Rows> {
    let header = std::iter::once("solid".to_owned()).chain(header(plan));
    let header: Vec<String> = header.chain([LINE.to_owned()]).collect();
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

/// Name of the solid, area fraction, and what was solved over what each theory says.
type Ratios<'a> = (&'a str, f64, [Option<f64>; 4]);

fn ratios(rows: &Rows) -> Vec<Ratios<'_>> {
    let ratios = |row: &Vec<String>| {
        let of = |name: &str| -> Option<f64> {
            let place = rows[0].iter().position(|column| column == name)?;
            row.get(place)?.parse().ok()
        };
        let over = |(_, [solved, theory]): (_, [&str; 2])| Some(of(solved)? / of(theory)?);
        Some((of("area_fraction")?, THEORIES.map(over)))
    };
    let with_name = |row| ratios(row).map(|(area, ratios)| (&*row[0], area, ratios));
    rows.iter().filter_map(with_name).collect()
}

/// By solid and class of area: scenes, and for each theory the median ratio, between what nine of ten are, and how many are
/// within a tenth.
fn table(ratios: &[Ratios]) -> comfy_table::Table {
    let mut classes: BTreeMap<(&str, usize), Vec<&Ratios>> = BTreeMap::new();
    for one in ratios {
        let class = AREAS.partition_point(|end| one.1 >= *end);
        classes.entry((one.0, class)).or_default().push(one);
    }
    let header = ["solid", "area fraction from", "scenes"];
    let lines = classes.into_iter().map(|((solid, class), ratios)| {
        let from = if class == 0 { 0.0 } else { AREAS[class - 1] };
        let mut line = vec![solid.to_owned(), from.to_string(), ratios.len().to_string()];
        for theory in 0..THEORIES.len() {
            let values = ratios.iter().filter_map(|ratios| ratios.2[theory]);
            line.push(summary(values.collect()));
        }
        line
    });
    markdown_table(
        header.into_iter().chain(THEORIES.map(|(name, _)| name)),
        lines,
    )
}

fn summary(mut values: Vec<f64>) -> String {
    values.sort_by(f64::total_cmp);
    let Some(last) = values.len().checked_sub(1) else {
        return String::new();
    };
    let within = values.iter().filter(|ratio| (*ratio - 1.0).abs() <= WITHIN);
    let within = 100 * within.count() / values.len();
    let [low, high] = [last / 20, last - last / 20].map(|place| values[place]);
    let median = median(values);
    format!("{median:.2} ({low:.2} to {high:.2}), {within} %")
}

/// What was solved over what each theory says, over the area.
fn figure(ratios: &[Ratios]) -> Figure {
    let charts = THEORIES.into_iter().enumerate();
    let charts = charts.map(|(theory, (name, _))| {
        let series = SOLIDS.iter().zip(STYLES);
        let series = series.map(|((solid, _), (shape, colour))| {
            let of_solid = ratios.iter().filter(|ratios| ratios.0 == *solid);
            let points = of_solid.filter_map(|(_, area, ratios)| Some([*area, ratios[theory]?]));
            let points = points.filter(|[area, ratio]| *area > AREAS[0] && DRAWN.contains(ratio));
            Series::markers(points.collect(), Marker::open(shape), colour).labelled(*solid)
        });
        chart(
            Axis::log10("area fraction", [AREAS[0], 1.0]),
            Axis::log10(name, [*DRAWN.start(), *DRAWN.end()]),
            series.collect(),
        )
    });
    Figure::new(charts, 2)
}
