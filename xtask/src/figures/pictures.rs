//! The figures as charts, in the roles of lines and markers that they have in the paper.

use crate::figures::approach::{self, Approach, LENGTHS};
use crate::figures::friction_over_speed::Row;
use crate::figures::{Data, contact_maps, loss_tangent, resolution, scaling_function};
use crate::output::points;
use crate::picture::{chart, guide};
use viscofriction_plot::{Axis, Chart, Colour, Dash, Field, Figure, Line, Marker, Series, Shape};

/// Names and pictures.
pub(super) fn all(data: &Data) -> [(&'static str, Figure); 9] {
    let [cone, paraboloid] = [0, 1].map(|body: usize| data.factors[body].paper);
    let linear = |highest| Axis::linear(FRICTION, [0.0, highest]);
    let logarithmic = Axis::log10(FRICTION, [0.01, 1.0]);
    let moduli = loss_tangent_chart(&data.loss_tangent);
    let fig7 = friction_chart(&data.cone, cone, linear(0.2));
    let fig8 = friction_chart(&data.paraboloid, paraboloid, linear(0.35));
    let fig8_log = friction_chart(&data.paraboloid, paraboloid, logarithmic);
    let resolution = resolution::chart(&data.resolution, &data.factors);
    let approach = approach_chart(&data.approach);
    let function = scaling_function::figure(&data.scaling_function);
    [
        ("fig1_loss_tangent", Figure::single(moduli)),
        ("fig7_cone", Figure::single(fig7)),
        ("fig8_paraboloid", Figure::single(fig8)),
        ("fig8_paraboloid_log", Figure::single(fig8_log)),
        ("plain_resolution", Figure::single(resolution)),
        ("approach", Figure::single(approach)),
        ("scaling_function", function),
        ("pressure", pressure_maps(&data.approach)),
        ("stationary_contact", contact_maps::figure(&data.contacts)),
    ]
}

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

const FRICTION: &str = "coefficient of friction μ";

/// Friction over the speed, with the paper's factor of the body.
fn friction_chart(rows: &[Row], paper: f64, y: Axis) -> Chart {
    let points = |value: fn(&Row) -> f64| points(rows, |row| row.velocity_m_per_s, value);
    let [squares, circles] = [Shape::Square, Shape::Circle].map(Marker::open);
    let crosses = Marker::filled(Shape::Plus);
    let line = Line::thick(Dash::Solid);
    let theory = Series::line(points(|row| row.theory), line, Colour::Blue);
    let chain = Series::markers(points(|row| row.chain), squares, Colour::Blue);
    let scaled = Series::markers(points(|row| row.scaled_theory), circles, Colour::Black);
    let of_paper = points(|row| row.theory).into_iter();
    let of_paper = of_paper.map(|[speed, theory]| [speed, paper * theory]);
    let dashed = Line::thin(Dash::Dashed);
    let of_paper = Series::line(of_paper.collect(), dashed, Colour::Black);
    let errors = rows.iter().map(|row| row.half_space_distance_error);
    let half_space = Series {
        errors: errors.collect(),
        ..Series::markers(points(|row| row.half_space), crosses, Colour::Red)
    };
    let series = vec![
        theory.labelled("theory (MDR)"),
        chain.labelled("chain of dashpots (MDR)"),
        scaled.labelled("theory × converged factor"),
        of_paper.labelled(format!("theory × {paper} (paper)")),
        // Last, because it would vanish behind the open circles.
        half_space.labelled("half space (BEM)"),
    ];
    let x = Axis::log10("sliding speed v [m/s]", [8e-4, 1.25e-1]);
    Chart::new(x, y, series)
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
        let limit = guide(limit, Dash::Dotted);
        series.extend([
            chain.labelled(format!("{name}, chain")),
            half_space.labelled(format!("{name}, half space")),
            limit,
        ]);
    }
    let x = Axis::linear(along, [0.0, LENGTHS]);
    let y = Axis::linear("μ / stationary μ of the line model", [0.0, 1.1]);
    chart(x, y, series)
}

fn pressure_maps(approaches: &[Approach; 2]) -> Figure {
    let maps = approaches.iter().zip(INDENTERS);
    let maps = maps.map(|(approach, (name, _))| pressure_map(approach, name));
    Figure::new(maps, 2)
}

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
    // Pressures below a tenth of the mean share a colour.
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
