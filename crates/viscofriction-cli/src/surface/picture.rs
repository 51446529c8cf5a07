//! The heights of a map, and its spectra.

use viscofriction::indenters::HeightMap;
use viscofriction::indenters::rough::PowerSpectrum;
use viscofriction_plot::{Axis, Chart, Colour, Dash, Field, Figure, Line, Marker, Series, Shape};

use crate::material::decades;

pub(super) fn figure(map: &HeightMap, spectrum: &PowerSpectrum) -> Figure {
    let isotropic = spectrum.radial.iter();
    let isotropic = isotropic.map(|ring| [ring.wave_number, ring.density]);
    let radial = curve(isotropic.collect(), Colour::Blue);
    let [along_x, along_y] = &spectrum.profiles;
    let profiles = [
        curve(along_x.clone(), Colour::Blue).labelled("along x"),
        curve(along_y.clone(), Colour::Red).labelled("along y"),
    ];
    let charts = [
        heights(map),
        chart("mean of C over directions [m⁴]", vec![radial]),
        chart("C of profiles [m³]", profiles.into()),
    ];
    Figure::new(charts, 3)
}

/// Heights above the lowest point of the surface.
fn heights(map: &HeightMap) -> Chart {
    let ([rows, columns], [dx, dy]) = (map.shape(), map.spacing());
    let highest = map.heights().iter().copied().fold(0.0, f64::max);
    let colours = Axis::linear("height [m]", [0.0, highest]);
    let field = Field::new([rows, columns], colours, |x, y| {
        Some(highest - map.heights()[x * columns + y])
    });
    let axis = |label, count: usize, step: f64| Axis::linear(label, [0.0, count as f64 * step]);
    Chart::map(axis("x [m]", rows, dx), axis("y [m]", columns, dy), field)
}

fn curve(points: Vec<[f64; 2]>, colour: Colour) -> Series {
    let shown = points
        .into_iter()
        .filter(|point| point.iter().all(|value| *value > 0.0));
    let shown: Vec<_> = shown.collect();
    if shown.len() == 1 {
        return Series::markers(shown, Marker::filled(Shape::Circle), colour);
    }
    Series::line(shown, Line::thick(Dash::Solid), colour)
}

fn chart(label: &str, mut series: Vec<Series>) -> Chart {
    // Waves along one axis alone have no spectrum along the other.
    series.retain(|one| !one.points.is_empty());
    decades("wave number [1/m]", label, series)
}
