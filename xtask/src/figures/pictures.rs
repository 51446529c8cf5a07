//! The figures as charts, in the roles of lines and markers that they have in the paper.

use anyhow::Result;

use crate::figures::approach::{self, Approach, LENGTHS};
use crate::figures::friction_over_speed::Row;
use crate::figures::{Data, contact_maps, loss_tangent, scaling_function};
use crate::output::points;
use viscofriction_plot::{
    Axis, Chart, Colour, ColourScale, Dash, Drawing, Figure, LegendPlace, Line, Map, Marker,
    Proportions, Series, Shape, draw,
};

/// One picture of the report.
#[derive(Debug)]
pub(super) struct Picture {
    pub(super) name: &'static str,
    pub(super) caption: String,
    pub(super) drawing: Drawing,
}

pub(super) fn all(data: &Data) -> Result<Vec<Picture>> {
    let (contacts, function) = (&data.contacts, &data.scaling_function);
    let of_function = scaling_function::caption(function);
    let of_contacts = contact_maps::caption(contacts);
    let [cone, paraboloid] = [(&data.cone, 0.2), (&data.paraboloid, 0.35)]
        .map(|(rows, highest)| Figure::single(friction_chart(rows, highest)));
    let loss_tangent = Figure::single(loss_tangent_chart(&data.loss_tangent));
    let approach = Figure::single(approach_chart(&data.approach));
    let function = scaling_function::figure(function);
    let contacts = contact_maps::figure(contacts);
    let figures = [
        ("fig1_loss_tangent", FIG1, loss_tangent),
        ("fig7_cone", FIG7, cone),
        ("fig8_paraboloid", FIG8, paraboloid),
        ("approach", APPROACH, approach),
        ("scaling_function", &of_function, function),
        ("pressure", PRESSURE, pressure_maps(&data.approach)),
        ("stationary_contact", &of_contacts, contacts),
    ];
    let picture = |(name, caption, figure): (_, &str, Figure)| {
        let (caption, drawing) = (caption.to_owned(), draw(&figure)?);
        Ok(Picture {
            name,
            caption,
            drawing,
        })
    };
    figures.into_iter().map(picture).collect()
}

const FIG1: &str = "Loss tangent of the three-element solid for three stiffness ratios γ, and storage and loss modulus \
                    for γ = 1/100.";
const FIG7: &str = "Coefficient of friction of a cone over the sliding speed. Line: theory, Eq. (21). Squares: chain of \
                    dashpots. Crosses: half space. Circles: theory times the converged s₁.";
const FIG8: &str = "Coefficient of friction of a paraboloid over the sliding speed. Line: theory, Eq. (22). Squares: \
                    chain of dashpots. Crosses: half space. Circles: theory times the converged s₂.";
const APPROACH: &str = "The transition zone: friction from first touch on, relative to the stationary friction of the \
                        one-dimensional model. The chain arrives exponentially; the half space like the reciprocal of \
                        the distance, towards the scaling factors (dotted).";
const PRESSURE: &str = "Pressure at the end of that distance, seen from above; the indenter moves to the right and its lowest \
                        point is at the origin. Only the front half is in contact. Along the front edge the pressure \
                        is singular, so that its largest value depends on the elements.";

fn loss_tangent_chart(rows: &[loss_tangent::Row]) -> Chart {
    let curve = |value: fn(&loss_tangent::Row) -> f64, line, colour| {
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
    Chart {
        title: None,
        x: Axis::log10("dimensionless frequency Ω = ωη/G₂", [1e-4, 1e2]),
        y: Axis::linear("tan δ,  10 G′/G₂,  10 G″/G₂", [0.0, 16.0]),
        series: vec![
            soft.labelled("tan δ, γ = 1/1000"),
            middle.labelled("tan δ, γ = 1/100"),
            stiff.labelled("tan δ, γ = 1/10"),
            storage.labelled("10 G′/G₂, γ = 1/100"),
            loss.labelled("10 G″/G₂, γ = 1/100"),
        ],
        legend: LegendPlace::Free,
    }
}

fn friction_chart(rows: &[Row], highest: f64) -> Chart {
    let points = |value: fn(&Row) -> f64| points(rows, |row| row.velocity_m_per_s, value);
    let [squares, circles] = [Shape::Square, Shape::Circle].map(Marker::open);
    let crosses = Marker::filled(Shape::Plus);
    let line = Line::thick(Dash::Solid);
    let theory = Series::line(points(|row| row.theory), line, Colour::Blue);
    let chain = Series::markers(points(|row| row.chain), squares, Colour::Blue);
    let scaled = Series::markers(points(|row| row.scaled_theory), circles, Colour::Black);
    let errors = rows.iter().map(|row| row.half_space_distance_error);
    let half_space = Series {
        errors: Some(errors.collect()),
        ..Series::markers(points(|row| row.half_space), crosses, Colour::Red)
    };
    Chart {
        title: None,
        x: Axis::log10("sliding speed v [m/s]", [8e-4, 1.25e-1]),
        y: Axis::linear("coefficient of friction μ", [0.0, highest]),
        series: vec![
            theory.labelled("theory (MDR)"),
            chain.labelled("chain of dashpots (MDR)"),
            scaled.labelled("theory, scaled"),
            // Last, because it would vanish behind the open circles.
            half_space.labelled("half space (BEM)"),
        ],
        legend: LegendPlace::Free,
    }
}

const INDENTERS: [(&str, Dash); 2] = [("cone", Dash::Solid), ("paraboloid", Dash::Dashed)];

fn approach_chart(approaches: &[Approach; 2]) -> Chart {
    let along = "sliding distance / contact length (line model)";
    let mut series = Vec::new();
    for (approach, (name, dash)) in approaches.iter().zip(INDENTERS) {
        let curve = |value: fn(&approach::Row) -> f64, colour| {
            let along = |row: &approach::Row| row.sliding_distance_over_contact_length;
            let points = points(&approach.rows, along, value);
            Series::line(points, Line::thick(dash), colour)
        };
        let chain = curve(|row| row.chain, Colour::Blue);
        let half_space = curve(|row| row.half_space, Colour::Red);
        let limit = [0.0, LENGTHS].map(|length| [length, approach.scaling_factor]);
        let limit = Series::line(limit.to_vec(), Line::thin(Dash::Dotted), Colour::Black);
        series.extend([
            chain.labelled(format!("{name}, chain")),
            half_space.labelled(format!("{name}, half space")),
            limit,
        ]);
    }
    Chart {
        title: None,
        x: Axis::linear(along, [0.0, LENGTHS]),
        y: Axis::linear("μ / stationary μ of the line model", [0.0, 1.1]),
        series,
        legend: LegendPlace::Below,
    }
}

fn pressure_maps(approaches: &[Approach; 2]) -> Figure {
    let maps = approaches.iter().zip(INDENTERS);
    let maps = maps.map(|(approach, (name, _))| pressure_map(approach, name));
    Figure::new(maps, 2)
}

fn pressure_map(approach: &Approach, name: &str) -> Map {
    let field = &approach.pressure;
    let [rows, columns] = field.grid.shape();
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
    // The field is stored with y fastest, a map with x fastest; pressures below a tenth of the mean share a colour.
    let value = |index: usize| {
        let pressure = field.pressure[(index % rows) * columns + index / rows];
        (pressure > 0.0).then(|| level(pressure).max(lowest))
    };
    Map {
        title: Some(name.to_owned()),
        x: axis(0, "x / contact length"),
        y: axis(1, "y / contact length"),
        columns: rows,
        values: (0..rows * columns).map(value).collect(),
        colours: ColourScale::new("log₁₀ (P / mean P)", [lowest, highest]),
        overlays: Vec::new(),
        proportions: Proportions::True,
    }
}
