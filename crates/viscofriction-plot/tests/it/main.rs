//! What the crate draws and what it refuses, from the outside.

mod pictures;
mod refusals;

use viscofriction_plot::{
    Axis, Cell, Chart, Colour, ColourScale, Dash, LegendPlace, Line, Map, Marker, Matrix,
    MatrixRow, Proportions, Series, Shape,
};

fn chart() -> Chart {
    let theory = vec![[1e-3, 0.157], [1e1, 0.157]];
    let simulation = vec![[1e-2, 0.08], [1.0, 0.09]];
    let diamond = Marker::open(Shape::Diamond);
    Chart {
        title: Some("Cone, c₁ = 0.1".into()),
        x: Axis::log10("velocity v [m/s]", [1e-3, 1e1]),
        y: Axis::linear("coefficient of friction μ [1]", [0.0, 0.2]),
        series: vec![
            Series::line(theory, Line::thick(Dash::DashDot), Colour::Blue)
                .labelled("theory, s < 1 & more"),
            Series {
                errors: Some(vec![0.01, 0.02]),
                ..Series::markers(simulation, diamond, Colour::Red).labelled("simulation")
            },
        ],
        legend: LegendPlace::Free,
    }
}

/// A chart without title of points as filled markers.
fn points(points: &[[f64; 2]]) -> Chart {
    let plus = Marker::filled(Shape::Circle);
    Chart {
        title: None,
        series: vec![Series::markers(points.to_vec(), plus, Colour::Black)],
        ..chart()
    }
}

fn map() -> Map {
    Map {
        title: None,
        x: Axis::linear("x [mm]", [-2.0, 2.0]),
        y: Axis::linear("y [mm]", [-1.0, 1.0]),
        columns: 4,
        values: [0.5, 0.5, 1.5, -1.0, -1.0, 1.0, 2.0, -1.0]
            .map(|value| (value > 0.0).then_some(value))
            .to_vec(),
        colours: ColourScale {
            label: "pressure p [MPa]".into(),
            range: [0.0, 2.0],
        },
        overlays: vec![],
        proportions: Proportions::True,
    }
}

fn matrix(cells: &[Cell]) -> Matrix {
    Matrix {
        title: None,
        rows: vec![MatrixRow {
            name: "march".into(),
            cells: cells.to_vec(),
            note: "Δt/τ from 1e-12 to 1e12".into(),
        }],
        colours: ColourScale {
            label: "log₁₀".into(),
            range: [-6.0, 0.0],
        },
        legend: vec![(Colour::Grey, "refused".into())],
    }
}
