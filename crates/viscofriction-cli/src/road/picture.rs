//! Picture of friction and area over the cut-off wavelength with error bars, compared with the theories of Persson (2006) for the
//! friction and of Xu and others (2024) for the area.

use viscofriction::Quantity;
use viscofriction_plot::{Axis, Chart, Colour, Dash, Figure, Line, Marker, Series, Shape};

use super::Row;
use crate::run::range_with_zero;

/// Friction and area over the shortest wavelength of the surface, each beside a theory.
pub(super) fn figure(rows: &[Row]) -> Figure {
    let friction = ("persson_friction_coefficient_2006", "Persson (2006)");
    let area = ("persson_area_fraction_xu", "Xu (2024)");
    let friction = chart("friction_coefficient", friction, rows);
    Figure::new([friction, chart("area_fraction", area, rows)], 2)
}

/// A chart of one quantity, with the column and the name of its theory.
fn chart(key: &str, (theory, name): (&str, &str), rows: &[Row]) -> Chart {
    let label = Quantity::named(key)
        .map(Quantity::label)
        .unwrap_or_default();
    let known = rows.iter();
    let known = known.filter_map(|row| Some((row.shortest_wavelength, row.quantity(key)?)));
    let (points, errors): (Vec<[f64; 2]>, Vec<f64>) = known
        .map(|(length, known)| ([length, known.value], known.error))
        .unzip();
    let theory = rows
        .iter()
        .filter_map(|row| Some([row.shortest_wavelength, row.number(theory)?]));
    let theory: Vec<[f64; 2]> = theory.collect();
    let ends = points.iter().zip(&errors);
    let ends = ends.flat_map(|([_, value], error)| [value - error, value + error]);
    let all: Vec<f64> = ends.chain(theory.iter().map(|[_, value]| *value)).collect();
    let computed = Series {
        marker: Some(Marker::filled(Shape::Circle)),
        errors,
        ..Series::line(points, Line::thin(Dash::Solid), Colour::Blue)
    };
    let theory = Series::line(theory, Line::thin(Dash::Dashed), Colour::Red);
    let mut series = vec![computed.labelled("computed"), theory.labelled(name)];
    series.retain(|one| one.points.len() > usize::from(one.marker.is_none()));
    let lengths = rows.iter().map(|row| row.shortest_wavelength);
    let x = Axis::decades("shortest wavelength λ [m]", lengths);
    Chart::new(
        x,
        Axis::linear(label, range_with_zero(all.into_iter())),
        series,
    )
}
