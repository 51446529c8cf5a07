//! Measured and fitted moduli, and the error between them.

use super::output_files::{Comparison, ModulusRow, RelaxationRow};
use viscofriction_plot::{
    Axis, Chart, Colour, Dash, Figure, LegendPlace, Line, Marker, Panel, Series, Shape,
};

pub(super) fn figure(comparison: &Comparison) -> Figure {
    let charts = match comparison {
        Comparison::Oscillation(rows) => oscillation(rows),
        Comparison::Relaxation(rows) => relaxation(rows),
    };
    Figure {
        panels: charts.map(Panel::from).into(),
        columns: 2,
    }
}

fn oscillation(rows: &[ModulusRow]) -> [Chart; 2] {
    let points = |value: fn(&ModulusRow) -> f64| {
        positive(
            rows.iter()
                .map(|row| [row.angular_frequency_rad_per_s, value(row)]),
        )
    };
    let [storage, loss] = [Colour::Blue, Colour::Red];
    let moduli = vec![
        measured("G′ measured", points(|row| row.storage_pa), storage),
        measured("G″ measured", points(|row| row.loss_pa), loss),
        fitted(
            "G′ of the series",
            points(|row| row.storage_fit_pa),
            storage,
        ),
        fitted("G″ of the series", points(|row| row.loss_fit_pa), loss),
    ];
    let errors = vec![error(points(|row| row.relative_error))];
    let x = "angular frequency ω [rad/s]";
    [
        chart(x, "modulus [Pa]", moduli),
        chart(x, "relative error of G*", errors),
    ]
}

fn relaxation(rows: &[RelaxationRow]) -> [Chart; 2] {
    let points = |value: fn(&RelaxationRow) -> f64| {
        positive(rows.iter().map(|row| [row.time_s, value(row)]))
    };
    let moduli = vec![
        measured("G measured", points(|row| row.modulus_pa), Colour::Blue),
        fitted(
            "G of the series",
            points(|row| row.modulus_fit_pa),
            Colour::Red,
        ),
    ];
    let errors = vec![error(points(|row| row.relative_error))];
    let x = "time t [s]";
    [
        chart(x, "modulus [Pa]", moduli),
        chart(x, "relative error of G", errors),
    ]
}

/// A logarithm has no zero; the CSV file has all points.
fn positive(points: impl Iterator<Item = [f64; 2]>) -> Vec<[f64; 2]> {
    points.filter(|point| point[1] > 0.0).collect()
}

fn measured(label: &str, points: Vec<[f64; 2]>, colour: Colour) -> Series {
    Series {
        label: Some(label.to_owned()),
        ..Series::markers(points, Marker::open(Shape::Circle), colour)
    }
}

fn fitted(label: &str, points: Vec<[f64; 2]>, colour: Colour) -> Series {
    Series {
        label: Some(label.to_owned()),
        ..Series::line(points, Line::thick(Dash::Solid), colour)
    }
}

fn error(points: Vec<[f64; 2]>) -> Series {
    Series::markers(points, Marker::filled(Shape::Diamond), Colour::Black)
}

fn chart(x: &str, y: &str, series: Vec<Series>) -> Chart {
    let values = |axis: usize| series.iter().flat_map(|s| &s.points).map(move |p| p[axis]);
    Chart {
        title: None,
        x: Axis::decades(x, values(0)),
        y: Axis::decades(y, values(1)),
        legend: LegendPlace::Free,
        series,
    }
}
