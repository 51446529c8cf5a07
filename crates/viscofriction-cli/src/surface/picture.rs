//! Picture of a height map and its spectra.

use viscofriction::indenters::HeightMap;
use viscofriction::indenters::rough::PowerSpectrum;
use viscofriction_plot::{Axis, Chart, Colour, Dash, Field, Figure, Line, Marker, Series, Shape};

use crate::material::decades;
use crate::run::arrow;

/// Ratio of the longer to the shorter side of a map up to which it is drawn to scale (chosen); longer maps are stretched.
const MAX_ASPECT_RATIO: f64 = 2.0;

/// The figure of a map.
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
        section(map),
        chart("mean of C over directions [m⁴]", vec![radial]),
        chart("C of profiles [m³]", profiles.into()),
    ];
    Figure::new(charts, 2)
}

/// Map of the heights above the deepest point, out of the body, with the direction of motion.
fn heights(map: &HeightMap) -> Chart {
    let ([along_x, along_y], [dx, dy]) = (map.shape(), map.spacing());
    let highest = map.heights().iter().copied().fold(0.0, f64::max);
    let colours = Axis::linear("height [m]", [0.0, highest]);
    let field = Field::new([along_x, along_y], colours, |x, y| {
        Some(highest - map.heights()[x * along_y + y])
    });
    let [x, y] = [[0.0, along_x as f64 * dx], [0.0, along_y as f64 * dy]];
    // A long map drawn to scale is too narrow for its labels.
    let sides = [x[1], y[1]];
    let is_long = sides[0].max(sides[1]) > MAX_ASPECT_RATIO * sides[0].min(sides[1]);
    let field = if is_long { field.stretched() } else { field };
    Chart {
        title: Some("yellow touches first".into()),
        series: vec![motion_arrow(x, y, !is_long)],
        ..Chart::map(Axis::linear("x [m]", x), Axis::linear("y [m]", y), field)
    }
}

/// A red arrow along the motion; `is_true` if both axes have the same scale.
fn motion_arrow(x: [f64; 2], y: [f64; 2], is_true: bool) -> Series {
    Series {
        colour: Colour::Red,
        ..arrow(x, y, is_true)
    }
}

/// Section along the motion through the point of first touch.
fn section(map: &HeightMap) -> Chart {
    let ([along_x, along_y], [dx, _]) = (map.shape(), map.spacing());
    let touching = map.heights().iter().position(|height| *height == 0.0);
    let row = touching.unwrap_or(0) % along_y;
    let point = |x: usize| [x as f64 * dx, map.heights()[x * along_y + row]];
    let points: Vec<[f64; 2]> = (0..along_x).map(point).collect();
    let highest = |heights: &mut dyn Iterator<Item = f64>| heights.fold(0.0, f64::max);
    // A ridge along x touches along its whole length.
    let highest = match highest(&mut points.iter().map(|[_, height]| *height)) {
        0.0 => highest(&mut map.heights().iter().copied()),
        highest => highest,
    };
    let (x, y) = ([0.0, along_x as f64 * dx], [-0.2 * highest, 1.4 * highest]);
    let flat = x.map(|x| [x, 0.0]).into();
    let dashed = Line::thick(Dash::Dashed);
    let series = vec![
        Series::line(points, Line::thick(Dash::Solid), Colour::Blue).labelled("rigid body, above"),
        Series::line(flat, dashed, Colour::Green).labelled("elastomer, below"),
        motion_arrow(x, [1.1 * highest, 1.1 * highest + y[1] - y[0]], false)
            .labelled("motion of the body"),
    ];
    Chart {
        title: Some("cut along x through the point that touches first".into()),
        ..Chart::new(
            Axis::linear("x [m]", x),
            Axis::linear("height above the elastomer [m]", y),
            series,
        )
    }
}

/// A spectrum, without the points that a logarithmic axis cannot show.
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

/// A chart of spectral densities over the wave number, both logarithmic; empty spectra are left out.
fn chart(label: &str, mut series: Vec<Series>) -> Chart {
    // With waves along one axis only, the other spectrum is empty.
    series.retain(|one| !one.points.is_empty());
    decades("wave number [1/m]", label, series)
}
