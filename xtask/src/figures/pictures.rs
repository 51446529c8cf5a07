//! The figures as charts, in the roles of lines and markers that they have in the paper.

use anyhow::Result;

use crate::figures::approach::{self, Approach};
use crate::figures::friction_over_speed::Row;
use crate::figures::{Data, contact_maps, loss_tangent, scaling_function};
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
    let picture = |name, caption: &str, figure: &Figure| {
        Ok::<_, anyhow::Error>(Picture {
            name,
            caption: caption.to_owned(),
            drawing: draw(figure)?,
        })
    };
    let [cone, paraboloid] = &data.approach;
    Ok(vec![
        picture(
            "fig1_loss_tangent",
            FIG1,
            &Figure::single(loss_tangent_chart(&data.loss_tangent)),
        )?,
        picture(
            "fig7_cone",
            FIG7,
            &Figure::single(friction_chart(&data.cone, 0.2)),
        )?,
        picture(
            "fig8_paraboloid",
            FIG8,
            &Figure::single(friction_chart(&data.paraboloid, 0.35)),
        )?,
        picture(
            "approach",
            APPROACH,
            &Figure::single(approach_chart([cone, paraboloid])),
        )?,
        picture(
            "scaling_function",
            &scaling_function::caption(&data.scaling_function),
            &scaling_function::figure(&data.scaling_function),
        )?,
        picture("pressure", PRESSURE, &pressure_maps([cone, paraboloid]))?,
        picture(
            "stationary_contact",
            &contact_maps::caption(&data.contacts),
            &contact_maps::figure(&data.contacts),
        )?,
    ])
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
const PRESSURE: &str = "Pressure at the end of that way, seen from above; the indenter moves to the right and its lowest \
                        point is at the origin. Only the front half is in contact. Along the front edge the pressure \
                        is singular, so that its largest value depends on the elements.";

fn curve(
    label: &str,
    points: Vec<[f64; 2]>,
    colour: Colour,
    line: Option<Line>,
    marker: Option<Marker>,
) -> Series {
    Series {
        label: Some(label.to_owned()),
        points,
        errors: None,
        line,
        marker,
        colour,
    }
}

fn loss_tangent_chart(rows: &[loss_tangent::Row]) -> Chart {
    let series =
        |label: &str, look: (Colour, Line, Option<Shape>), value: fn(&loss_tangent::Row) -> f64| {
            let points = rows
                .iter()
                .map(|row| [row.dimensionless_frequency, value(row)])
                .collect();
            let (colour, line, shape) = look;
            let marker = shape.map(|shape| Marker {
                every: 20,
                ..Marker::open(shape)
            });
            curve(label, points, colour, Some(line), marker)
        };
    let [dash_dot, dashed, solid] = [Dash::DashDot, Dash::Dashed, Dash::Solid].map(Line::thick);
    let thin = Line::thin(Dash::Solid);
    Chart {
        title: None,
        x: Axis::log10("dimensionless frequency Ω = ωη/G₂", [1e-4, 1e2]),
        y: Axis::linear("tan δ,  10 G′/G₂,  10 G″/G₂", [0.0, 16.0]),
        series: vec![
            series(
                "tan δ, γ = 1/1000",
                (Colour::Blue, dash_dot, None),
                |row| row.loss_tangent_gamma_0_001,
            ),
            series("tan δ, γ = 1/100", (Colour::Green, dashed, None), |row| {
                row.loss_tangent_gamma_0_01
            }),
            series("tan δ, γ = 1/10", (Colour::Red, solid, None), |row| {
                row.loss_tangent_gamma_0_1
            }),
            series(
                "10 G′/G₂, γ = 1/100",
                (Colour::Magenta, thin, Some(Shape::Diamond)),
                |row| row.scaled_storage_modulus,
            ),
            series(
                "10 G″/G₂, γ = 1/100",
                (Colour::Black, thin, Some(Shape::Circle)),
                |row| row.scaled_loss_modulus,
            ),
        ],
        legend: LegendPlace::Free,
    }
}

fn friction_chart(rows: &[Row], highest: f64) -> Chart {
    let points = |value: fn(&Row) -> f64| {
        rows.iter()
            .map(|row| [row.velocity_m_per_s, value(row)])
            .collect::<Vec<_>>()
    };
    let crosses = Marker::filled(Shape::Plus);
    let half_space = Series {
        label: Some("half space (BEM)".into()),
        errors: Some(
            rows.iter()
                .map(|row| row.half_space_distance_error)
                .collect(),
        ),
        ..Series::markers(points(|row| row.half_space), crosses, Colour::Red)
    };
    let line = Some(Line::thick(Dash::Solid));
    Chart {
        title: None,
        x: Axis::log10("sliding speed v [m/s]", [8e-4, 1.25e-1]),
        y: Axis::linear("coefficient of friction μ", [0.0, highest]),
        series: vec![
            curve(
                "theory (MDR)",
                points(|row| row.theory),
                Colour::Blue,
                line,
                None,
            ),
            curve(
                "chain of dashpots (MDR)",
                points(|row| row.chain),
                Colour::Blue,
                None,
                Some(Marker::open(Shape::Square)),
            ),
            curve(
                "theory, scaled",
                points(|row| row.scaled_theory),
                Colour::Black,
                None,
                Some(Marker::open(Shape::Circle)),
            ),
            // Last, because it would vanish behind the open circles.
            half_space,
        ],
        legend: LegendPlace::Free,
    }
}

fn approach_chart(approaches: [&Approach; 2]) -> Chart {
    let mut series = Vec::new();
    for (approach, name, dash) in [
        (approaches[0], "cone", Dash::Solid),
        (approaches[1], "paraboloid", Dash::Dashed),
    ] {
        let points = |value: fn(&approach::Row) -> f64| {
            approach
                .rows
                .iter()
                .map(|row| [row.sliding_distance_over_contact_length, value(row)])
                .collect::<Vec<_>>()
        };
        let line = Some(Line::thick(dash));
        series.push(curve(
            &format!("{name}, chain"),
            points(|row| row.chain),
            Colour::Blue,
            line,
            None,
        ));
        series.push(curve(
            &format!("{name}, half space"),
            points(|row| row.half_space),
            Colour::Red,
            line,
            None,
        ));
        let limit = vec![
            [0.0, approach.scaling_factor],
            [approach::LENGTHS, approach.scaling_factor],
        ];
        series.push(Series::line(limit, Line::thin(Dash::Dotted), Colour::Black));
    }
    Chart {
        title: None,
        x: Axis::linear(
            "sliding distance / contact length (line model)",
            [0.0, approach::LENGTHS],
        ),
        y: Axis::linear("μ / stationary μ of the line model", [0.0, 1.1]),
        series,
        legend: LegendPlace::Below,
    }
}

fn pressure_maps(approaches: [&Approach; 2]) -> Figure {
    let maps = approaches
        .iter()
        .zip(["cone", "paraboloid"])
        .map(|(approach, name)| pressure_map(approach, name).into());
    Figure {
        panels: maps.collect(),
        columns: 2,
    }
}

fn pressure_map(approach: &Approach, name: &str) -> Map {
    let field = &approach.pressure;
    let [rows, columns] = field.grid.shape();
    let axis = |axis: usize, label: &str| {
        let [origin, spacing] = [field.origin[axis], field.grid.spacing()[axis]];
        let length = approach.contact_length;
        let range = [
            origin - 0.5 * spacing,
            origin + (field.grid.shape()[axis] as f64 - 0.5) * spacing,
        ];
        Axis::linear(label, range.map(|end| end / length))
    };
    let loaded = field.pressure.iter().filter(|pressure| **pressure > 0.0);
    let mean = loaded.clone().sum::<f64>() / loaded.clone().count() as f64;
    let level = |pressure: f64| (pressure / mean).log10();
    let [lowest, highest] = [
        -1.0,
        loaded.map(|pressure| level(*pressure)).fold(0.0, f64::max),
    ];
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
        colours: ColourScale {
            label: "log₁₀ (P / mean P)".into(),
            range: [lowest, highest],
        },
        overlays: Vec::new(),
        proportions: Proportions::True,
    }
}
