//! Persson's theory beside random rough surfaces that slide: friction and area over speeds, loads, spectra and solids.

use std::collections::BTreeMap;
use std::path::Path;

use anyhow::{Context, Result};
use viscofriction::scene::Source;
use viscofriction::sweep::{Plan, header};
use viscofriction_plot::{Axis, Chart, Colour, Figure, LegendPlace, Marker, Series, Shape};

use super::{Report, Table};
use crate::meter::median;
use crate::output::{markdown_table, write_atomically};
use crate::tasks;

/// Rows that were computed; an interrupted run goes on where it was.
const ROWS: &str = "rough.csv";
/// Points that are computed before they are written.
const AT_ONCE: usize = 64;
/// The periods are 1 m, and so is the shear modulus at rest 1 Pa; at most 512 × 512 elements.
const SCENE: &str = "
indenter.self-affine = { period = [1.0, 1.0], hurst_exponent = 0.8, rms_slope = 0.1, longest_wavelength = 0.5, \
                         shortest_wavelength = 0.125, seed = 1 }
load = { mean_pressure = 1.0, velocity = 1.0 }
solve = { relative_error = 0.05, max_memory = \"60 MiB\" }
material.prony = { equilibrium_modulus = 1.0, branches = ";
/// Name, geometric mean of the moduli of rest and glass, and speeds around the transition.
const SOLIDS: [(&str, f64, &str); 3] = [
    ("standard-10", 3.0, "1e-5:1e1"),
    ("standard-1000", 30.0, "1e-6:1e1"),
    ("rubber", 40.0, "1e-4:1e8"),
];
const STYLES: [(Shape, Colour); 3] = [
    (Shape::Circle, Colour::Blue),
    (Shape::Square, Colour::Red),
    (Shape::Diamond, Colour::Green),
];
/// A theory is right where it is not farther from the surfaces than this.
const WITHIN: f64 = 0.1;
/// Ends of the classes of the area fraction; what is below the first is not drawn.
const AREAS: [f64; 7] = [1e-3, 0.01, 0.03, 0.1, 0.3, 0.6, 0.9];

/// Moduli and relaxation times; the rubber has twenty over ten decades.
fn branches(solid: &str) -> Vec<[f64; 2]> {
    let of_rubber = |k: i32| {
        let time = 10_f64.powf(0.5 * f64::from(k) - 8.0);
        [0.4 * 1.45_f64.powi(19 - k), time]
    };
    match solid {
        "standard-10" => vec![[9.0, 1.0]],
        "standard-1000" => vec![[999.0, 1.0]],
        _ => (0..20).map(of_rubber).collect(),
    }
}

/// Compares the theory with all scenes, of which `out` may hold some; a quick run takes a few cheap ones.
pub(super) fn report(out: &Path, quick: bool) -> Result<Report> {
    let plans = SOLIDS.map(|solid| plan(solid, quick));
    let plans = plans.into_iter().collect::<Result<Vec<_>>>()?;
    let file = out.join(ROWS);
    let mut rows = Rows::read(&file, &plans[0])?;
    // One surface after the other, so that what is there of a run that was interrupted is of all solids.
    let surfaces = if quick { 2 } else { 4 };
    let mut missing = Vec::new();
    for surface in 0..surfaces {
        for (plan, (solid, ..)) in plans.iter().zip(SOLIDS) {
            let each = plan.n_points() / surfaces;
            let points = surface * each..(surface + 1) * each;
            let points = points.map(|point| (solid, plan, point));
            missing.extend(points.filter(|(_, plan, point)| !rows.has(plan, *point)));
        }
    }
    for (done, some) in missing.chunks(AT_ONCE).enumerate() {
        let task = format!("rough surfaces, {} of {}", done * AT_ONCE, missing.len());
        let solved = tasks::in_parallel(task, some, |(solid, plan, point)| {
            let fields = plan.solve(*point)?.fields;
            Ok(std::iter::once((*solid).to_owned()).chain(fields).collect())
        })?;
        rows.rows.extend(solved);
        write_atomically(&file, rows.csv()?.as_bytes())?;
    }
    let ratios = rows.ratios();
    let [all, known] = [rows.rows.len(), ratios.len()];
    Ok(Report {
        name: "rough",
        tables: vec![Table::written("rough", rows.csv()?)],
        pictures: vec![("rough", figure(&ratios))],
        summary: format!(
            "{}\n\n{known} of {all} scenes have an answer.",
            table(&ratios)
        ),
        failure: None,
    })
}

fn plan((solid, stiffness, speeds): (&str, f64, &str), quick: bool) -> Result<Plan> {
    let branch = |[modulus, time]: [f64; 2]| {
        format!("{{ modulus = {modulus:?}, relaxation_time = {time:?} }}")
    };
    let branches: Vec<String> = branches(solid).into_iter().map(branch).collect();
    let scene = format!("{SCENE}[{}] }}\n", branches.join(", "));
    let source = Source::new(Path::new("rough.toml"), scene.into_bytes())?;
    let loads = [0.02, 0.1, 0.5].map(|load| (load * stiffness).to_string());
    let load = format!("load.mean_pressure={}", loads.join(","));
    let speed = |count| format!("load.velocity={speeds}:{count}:log");
    let surface = |key, values| format!("indenter.self-affine.{key}={values}");
    let vary = if quick {
        vec![surface("seed", "1,2"), load, speed(3)]
    } else {
        vec![
            surface("seed", "1,2,3,4"),
            surface("hurst_exponent", "0.3,0.6,0.9"),
            surface("shortest_wavelength", "0.125,0.0625,0.03125"),
            load,
            speed(13),
        ]
    };
    let vary = vary
        .iter()
        .map(|vary| vary.parse())
        .collect::<Result<Vec<_>, _>>();
    let nothing = |_: &Path| Ok(Vec::new());
    Ok(Plan::new(
        source,
        &vary.map_err(crate::output::WrongInput)?,
        nothing,
    )?)
}

/// Rows of sweeps behind the name of the solid.
struct Rows {
    header: Vec<String>,
    rows: Vec<Vec<String>>,
}

/// Name of the solid, area fraction, and friction and area over those of the theory.
type Ratios<'a> = (&'a str, [f64; 3]);

impl Rows {
    /// Those of a file, if it is there.
    fn read(file: &Path, plan: &Plan) -> Result<Self> {
        let header = std::iter::once("solid".to_owned())
            .chain(header(plan))
            .collect();
        let mut rows = Vec::new();
        if file.exists() {
            let mut reader = csv::Reader::from_path(file)?;
            let records = reader.deserialize().collect::<Result<_, _>>();
            rows = records.with_context(|| format!("reading {}", file.display()))?;
        }
        Ok(Self { header, rows })
    }

    fn csv(&self) -> Result<String> {
        let mut writer = csv::Writer::from_writer(Vec::new());
        writer.write_record(&self.header)?;
        for row in &self.rows {
            writer.write_record(row)?;
        }
        Ok(String::from_utf8(writer.into_inner()?)?)
    }

    fn has(&self, plan: &Plan, point: usize) -> bool {
        let identity = viscofriction::sweep::identity(plan, point);
        self.rows.iter().any(|row| row[1..].starts_with(&identity))
    }

    fn ratios(&self) -> Vec<Ratios<'_>> {
        let number = |row: &[String], name: &str| -> Option<f64> {
            let place = self.header.iter().position(|column| column == name)?;
            row.get(place)?.parse().ok()
        };
        let ratios = |row: &'_ Vec<String>| {
            let of = |name: &str| number(row, name);
            let area = of("area_fraction")?;
            let friction = of("friction_coefficient")? / of("persson_friction_coefficient")?;
            Some([area, friction, area / of("persson_area_fraction")?])
        };
        let rows = self.rows.iter();
        rows.filter_map(|row| Some((&*row[0], ratios(row)?)))
            .collect()
    }
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
        .map(|((name, ..), (shape, colour))| {
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
