//! Picture of friction and area over the cut-off wavelength with error bars, compared with the theories of Persson (2006) for the
//! friction and of Xu and others (2024) for the area.

use viscofriction_plot::{Axis, Chart, Colour, Dash, Figure, Line, Marker, Series, Shape};

use super::Row;
use crate::run::around;

/// The figure of a cut-off series.
pub(super) fn figure(rows: &[Row]) -> Figure {
    let friction = chart(["friction coefficient μ", "Persson (2006)"], rows, |row| {
        let theory = row.persson_friction_coefficient_2006;
        [
            row.friction_coefficient,
            row.friction_coefficient_error,
            theory,
        ]
    });
    let area = chart(["area fraction", "Xu (2024)"], rows, |row| {
        let theory = row.persson_area_fraction_xu;
        [row.area_fraction, row.area_fraction_error, theory]
    });
    Figure::new([friction, area], 2)
}

/// A chart of one quantity; `of` gives value, error and theory of a row.
fn chart([label, name]: [&str; 2], rows: &[Row], of: impl Fn(&Row) -> [Option<f64>; 3]) -> Chart {
    let known = |index: usize| {
        let points = rows.iter();
        points
            .filter_map(|row| Some([row.shortest_wavelength, of(row)[index]?]))
            .collect()
    };
    let points: Vec<[f64; 2]> = known(0);
    let errors: Vec<f64> = known(1)
        .iter()
        .map(|[_, error]: &[f64; 2]| *error)
        .collect();
    let ends = points.iter().zip(&errors);
    let ends = ends.flat_map(|([_, value], error)| [value - error, value + error]);
    let theory: Vec<[f64; 2]> = known(2);
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
    Chart::new(x, Axis::linear(label, around(all.into_iter())), series)
}
