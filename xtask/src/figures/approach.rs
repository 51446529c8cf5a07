//! The transition zone: friction over the sliding distance, by chain and half space.

use anyhow::Result;
use bem_halfspace::slide::PressureField;
use serde::Serialize;
use viscofriction_plot::{Axis, Chart, Colour, Dash, Field, Figure, Line, Series};

use crate::figures::{Part, chain, factors};
use crate::output::points;
use crate::picture::{chart, guide};
use crate::scene::Scene;

/// Sliding distance that the figure shows, in contact lengths of the one-dimensional model. Chosen.
const SHOWN_CONTACT_LENGTHS: f64 = 16.0;
/// Number of elements along the contact length of the one-dimensional model. Chosen.
const ELEMENTS: f64 = 24.0;

/// One step; friction is relative to the stationary friction of the one-dimensional model.
#[derive(Debug, Serialize)]
struct Row {
    exponent: f64,
    sliding_distance_over_contact_length: f64,
    chain: f64,
    half_space: f64,
    /// Depth of the one-dimensional model in units of F_N/(4ηv).
    chain_depth: f64,
    half_space_depth: f64,
}

/// The approach to stationarity of one profile, and the pressure at its end.
struct Approach {
    rows: Vec<Row>,
    pressure: PressureField,
    contact_length: f64,
    scaling_factor: f64,
}

/// The table and pictures of cone and paraboloid, in the order of `factors`.
pub(super) fn part(factors: &[factors::Row]) -> Result<Part> {
    let approaches = factors.iter().map(approach).collect::<Result<Vec<_>>>()?;
    let rows: Vec<&Row> = approaches.iter().flat_map(|one| &one.rows).collect();
    let pictures = [
        ("approach", Figure::single(approach_chart(&approaches))),
        ("pressure", pressure_maps(&approaches)),
    ];
    Part::new("approach", &rows, pictures)
}

/// Slides the profile of a factor from first touch, by the chain and on the half space, with the same steps.
fn approach(factor: &factors::Row) -> Result<Approach> {
    let scene = Scene::unit(factor.exponent)?;
    let theory = scene.theory()?;
    let contact_length = theory.contact_length();
    let spacing = contact_length / ELEMENTS;
    let chain = chain::slide(&scene, spacing)?;
    let transient = scene.half_space(spacing, SHOWN_CONTACT_LENGTHS)?;
    let steps = chain.iter().zip(&transient.rows);
    let rows = steps.map(|(chain, row)| Row {
        exponent: factor.exponent,
        sliding_distance_over_contact_length: row.sliding_distance / contact_length,
        chain: chain.friction_coefficient / theory.friction_coefficient,
        half_space: row.friction_coefficient / theory.friction_coefficient,
        chain_depth: chain.indentation_depth / theory.indentation_depth,
        half_space_depth: row.indentation_depth / theory.indentation_depth,
    });
    Ok(Approach {
        rows: rows.collect(),
        pressure: transient.pressure,
        contact_length,
        scaling_factor: factor.converged,
    })
}

/// Names of the bodies, and how their curves are drawn.
const INDENTERS: [(&str, Dash); 2] = [("cone", Dash::Solid), ("paraboloid", Dash::Dashed)];

/// Friction over the sliding distance, with the limits of the half space.
fn approach_chart(approaches: &[Approach]) -> Chart {
    let along = "sliding distance / contact length (line model)";
    let mut series = Vec::new();
    for (approach, (name, dash)) in approaches.iter().zip(INDENTERS) {
        let curve = |value: fn(&Row) -> f64, colour| {
            let along = |row: &Row| row.sliding_distance_over_contact_length;
            let points = points(&approach.rows, along, value);
            Series::line(points, Line::thick(dash), colour)
        };
        let chain = curve(|row| row.chain, Colour::Blue);
        let half_space = curve(|row| row.half_space, Colour::Red);
        let limit = [0.0, SHOWN_CONTACT_LENGTHS].map(|length| [length, approach.scaling_factor]);
        let limit = guide(limit, Dash::Dotted);
        series.extend([
            chain.labelled(format!("{name}, chain")),
            half_space.labelled(format!("{name}, half space")),
            limit,
        ]);
    }
    let x = Axis::linear(along, [0.0, SHOWN_CONTACT_LENGTHS]);
    let y = Axis::linear("μ / stationary μ of the line model", [0.0, 1.1]);
    chart(x, y, series)
}

/// A map of the last pressure of each profile.
fn pressure_maps(approaches: &[Approach]) -> Figure {
    let named = approaches.iter().zip(INDENTERS);
    Figure::new(
        named.map(|(approach, (name, _))| pressure_map(approach, name)),
        2,
    )
}

/// Logarithm of the ratio of the pressure to its mean in contact; lengths in contact lengths of the one-dimensional model.
fn pressure_map(approach: &Approach, name: &str) -> Chart {
    let field = &approach.pressure;
    let axis = |axis: usize, label: &str| {
        let (origin, spacing) = (field.origin[axis], field.grid.spacing()[axis]);
        let ends = [-0.5, field.grid.shape()[axis] as f64 - 0.5];
        let range = ends.map(|end| (origin + end * spacing) / approach.contact_length);
        Axis::linear(label, range)
    };
    let loaded = field.pressure.iter().filter(|pressure| **pressure > 0.0);
    let mean = loaded.clone().sum::<f64>() / loaded.clone().count() as f64;
    let level = |pressure: f64| (pressure / mean).log10();
    let lowest = -1.0;
    let highest = loaded.map(|pressure| level(*pressure)).fold(0.0, f64::max);
    let colours = Axis::linear("log₁₀ (P / mean P)", [lowest, highest]);
    // Give pressures below a tenth of the mean the same colour, so that the colours show the larger ones.
    let field = Field::new(field.grid.shape(), colours, |x, y| {
        let pressure = field.pressure[x * field.grid.shape()[1] + y];
        (pressure > 0.0).then(|| level(pressure).max(lowest))
    });
    let [x, y] = [axis(0, "x / contact length"), axis(1, "y / contact length")];
    Chart {
        title: Some(name.to_owned()),
        ..Chart::map(x, y, field)
    }
}
