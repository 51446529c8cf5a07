//! What the crate draws and what it refuses, from the outside.

mod pictures;
mod refusals;

use viscofriction_plot::{Axis, Chart, Colour, Dash, Field, Line, Marker, Series, Shape};

/// A line, and markers with error bars.
fn chart() -> Chart {
    let theory = vec![[1e-3, 0.157], [1e1, 0.157]];
    let theory = Series::line(theory, Line::thick(Dash::DashDot), Colour::Blue);
    let simulation = vec![[1e-2, 0.08], [1.0, 0.09]];
    let diamond = Marker::open(Shape::Diamond);
    let simulation = Series {
        errors: vec![0.01, 0.02],
        ..Series::markers(simulation, diamond, Colour::Red)
    };
    let series = vec![
        theory.labelled("theory, s < 1 & more"),
        simulation.labelled("simulation"),
    ];
    Chart {
        title: Some("Cone, c₁ = 0.1".into()),
        ..Chart::new(
            Axis::log10("velocity v [m/s]", [1e-3, 1e1]),
            Axis::linear("coefficient of friction μ [1]", [0.0, 0.2]),
            series,
        )
    }
}

/// A field of two rows with blank corners.
fn map() -> Chart {
    let values = [[0.5, 0.5, 1.5, -1.0], [-1.0, 1.0, 2.0, -1.0]];
    let value = |column: usize, row: usize| Some(values[row][column]).filter(|value| *value > 0.0);
    let pressure = Axis::linear("pressure p [MPa]", [0.0, 2.0]);
    Chart::map(
        Axis::linear("x [mm]", [-2.0, 2.0]),
        Axis::linear("y [mm]", [-1.0, 1.0]),
        Field::new([4, 2], pressure, value),
    )
}
