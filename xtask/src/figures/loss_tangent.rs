//! Fig. 1: loss tangent of the three-element solid, and its moduli for γ = 1/100.

use anyhow::Result;
use casebook::standard_solid;
use rheology::{Material, StandardSolid};
use serde::Serialize;
use viscofriction_plot::{Axis, Chart, Colour, Dash, Figure, Line, Marker, Series, Shape};

use crate::figures::Part;
use crate::output::points;

/// Name of table and picture.
pub(super) const NAME: &str = "fig1_loss_tangent";

/// Stiffness ratios γ = G₁/G₂ of the spring G₁ to the Maxwell element G₂ in Kürschner (2014).
const RATIOS: [f64; 3] = [1e-3, 1e-2, 1e-1];

/// Modulus G₂ of the drawn solid. The scale of the moduli in the caption is 10/G₂, so that a solid with G₂ = 10 shows them as
/// they are drawn.
const MAXWELL_MODULUS: f64 = 10.0;

/// One frequency.
#[derive(Debug, Serialize)]
pub(super) struct Row {
    /// Ω = ω η / G₂; the paper prints ω G₂ / η, which has a dimension.
    dimensionless_frequency: f64,
    loss_tangent_gamma_0_001: f64,
    loss_tangent_gamma_0_01: f64,
    loss_tangent_gamma_0_1: f64,
    /// 10 G' / G₂ for γ = 1/100.
    scaled_storage_modulus: f64,
    /// 10 G'' / G₂ for γ = 1/100.
    scaled_loss_modulus: f64,
}

/// The three-element solid of a stiffness ratio γ.
fn solid(ratio: f64) -> Result<StandardSolid> {
    let modulus = MAXWELL_MODULUS;
    // A relaxation time of 1 s makes Ω equal to ω.
    Ok(standard_solid([ratio * modulus, modulus, modulus])?)
}

/// Table and picture of loss tangent and moduli.
pub(super) fn part() -> Result<Part> {
    let rows = compute()?;
    Part::new(NAME, &rows, [(NAME, Figure::single(chart(&rows)))])
}

/// Rows of the table, at forty frequencies per decade from 10⁻⁴ to 10².
pub(super) fn compute() -> Result<Vec<Row>> {
    let [soft, middle, stiff] = [solid(RATIOS[0])?, solid(RATIOS[1])?, solid(RATIOS[2])?];
    let row = |k: u32| {
        let frequency = 10.0_f64.powf(f64::from(k) / 40.0 - 4.0);
        Ok(Row {
            dimensionless_frequency: frequency,
            loss_tangent_gamma_0_001: soft.loss_tangent(frequency)?,
            loss_tangent_gamma_0_01: middle.loss_tangent(frequency)?,
            loss_tangent_gamma_0_1: stiff.loss_tangent(frequency)?,
            scaled_storage_modulus: middle.complex_modulus(frequency)?.storage,
            scaled_loss_modulus: middle.complex_modulus(frequency)?.loss,
        })
    };
    (0..=240).map(row).collect()
}

/// Loss tangents and moduli over the frequency.
fn chart(rows: &[Row]) -> Chart {
    let curve = |value: fn(&Row) -> f64, line, colour| {
        let points = points(rows, |row| row.dimensionless_frequency, value);
        Series::line(points, line, colour)
    };
    let [dash_dot, dashed, solid] = [Dash::DashDot, Dash::Dashed, Dash::Solid].map(Line::thick);
    let modulus = |value, shape, colour| Series {
        marker: Some(Marker {
            every: 20,
            ..Marker::open(shape)
        }),
        ..curve(value, Line::thin(Dash::Solid), colour)
    };
    let soft = curve(|row| row.loss_tangent_gamma_0_001, dash_dot, Colour::Blue);
    let middle = curve(|row| row.loss_tangent_gamma_0_01, dashed, Colour::Green);
    let stiff = curve(|row| row.loss_tangent_gamma_0_1, solid, Colour::Red);
    let [diamonds, circles] = [Shape::Diamond, Shape::Circle];
    let storage = modulus(|row| row.scaled_storage_modulus, diamonds, Colour::Magenta);
    let loss = modulus(|row| row.scaled_loss_modulus, circles, Colour::Black);
    let series = vec![
        soft.labelled("tan δ, γ = 1/1000"),
        middle.labelled("tan δ, γ = 1/100"),
        stiff.labelled("tan δ, γ = 1/10"),
        storage.labelled("10 G′/G₂, γ = 1/100"),
        loss.labelled("10 G″/G₂, γ = 1/100"),
    ];
    let x = Axis::log10("dimensionless frequency Ω = ωη/G₂", [1e-4, 1e2]);
    let y = Axis::linear("tan δ,  10 G′/G₂,  10 G″/G₂", [0.0, 16.0]);
    Chart::new(x, y, series)
}
