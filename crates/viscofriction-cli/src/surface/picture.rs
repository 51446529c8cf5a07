//! Picture of a height map and its spectra.

use std::f64::consts::TAU;

use viscofriction::indenters::HeightMap;
use viscofriction::indenters::rough::{PowerSpectrum, Ring};
use viscofriction_plot::{Axis, Chart, Colour, Dash, Field, Figure, Line, Marker, Series, Shape};

use crate::material::decades;
use crate::run::arrow;

/// Largest ratio of the longer to the shorter side of a map that is drawn to scale. Chosen.
const MAX_ASPECT_RATIO: f64 = 1.6;
/// Ratio of the shortest wavelength that an instrument resolves to the spacing of the points of its map. Chosen, see
/// docs/road.md.
const POINTS_PER_WAVE: f64 = 4.0;
/// Smallest number of rings of a spectrum, means over equal wave numbers, to which a line is fitted. Chosen.
const FEWEST_RINGS: usize = 4;
/// Exponent of the spectrum of the shortest waves above which they count as noise, whose spectrum is constant. Chosen.
const FLAT: f64 = -1.0;

/// The figure of a map.
pub(super) fn figure(map: &HeightMap, spectrum: &PowerSpectrum) -> Figure {
    let rings = spectrum.radial.iter();
    let isotropic = rings.map(|ring| [ring.wave_number, ring.density]);
    let radial = curve(isotropic.collect(), Colour::Blue).labelled("map");
    let references = references(map, spectrum);
    let [along_x, along_y] = &spectrum.profiles;
    let profiles = [
        curve(along_x.clone(), Colour::Blue).labelled("along x"),
        curve(along_y.clone(), Colour::Red).labelled("along y"),
    ];
    let charts = [
        heights(map),
        section(map),
        chart(
            "all directions",
            "power spectrum C [m⁴]",
            vec![radial],
            references,
        ),
        chart(
            "profiles",
            "power spectrum C [m³]",
            profiles.into(),
            Vec::new(),
        ),
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
        title: Some("yellow touches first; motion →".into()),
        ..Chart::map(Axis::linear("x [m]", x), Axis::linear("y [m]", y), field)
    }
}

/// The power law of a self-affine surface that fits the spectrum, its level of noise, and the limit of the instrument.
fn references(map: &HeightMap, spectrum: &PowerSpectrum) -> Vec<Series> {
    let [dx, dy] = map.spacing();
    let limit = TAU / (POINTS_PER_WAVE * dx.max(dy));
    let is_seen = |ring: &&Ring| ring.wave_number > 0.0 && ring.density > 0.0;
    let rings: Vec<&Ring> = spectrum.radial.iter().filter(is_seen).collect();
    let (Some(first), Some(last)) = (rings.first(), rings.last()) else {
        return Vec::new();
    };
    let ends = [first.wave_number, last.wave_number];
    let (resolved, others): (Vec<&Ring>, Vec<&Ring>) = rings
        .iter()
        .copied()
        .partition(|ring| ring.wave_number <= limit);
    let mut found = Vec::new();
    if let Some([exponent, factor]) = power_law(&resolved) {
        let hurst = -0.5 * exponent - 1.0;
        let points = ends.map(|wave_number| [wave_number, factor * wave_number.powf(exponent)]);
        let line = Series::reference(points.to_vec(), Dash::Dashed, Colour::Red);
        let name = if (0.0..=1.0).contains(&hurst) {
            format!("self-affine, Hurst exponent {hurst:.2}")
        } else {
            format!("power law of exponent {exponent:.1}").replace('-', "−")
        };
        found.push(line.labelled(name));
    }
    if let Some([exponent, factor]) = power_law(&others).filter(|[exponent, _]| *exponent > FLAT) {
        let middle = (limit * last.wave_number).sqrt();
        let level = factor * middle.powf(exponent);
        let points = ends.map(|wave_number| [wave_number, level]).to_vec();
        found.push(Series::reference(points, Dash::DashDot, Colour::Grey).labelled("noise floor"));
    }
    if ends[0] < limit && limit < ends[1] {
        let densities = rings.iter().map(|ring| ring.density);
        let [low, high] = densities.fold([f64::INFINITY, 0.0_f64], |[low, high], density| {
            [low.min(density), high.max(density)]
        });
        let points = vec![[limit, low], [limit, high]];
        let line = Series::line(points, Line::thin(Dash::Dotted), Colour::Grey);
        found.push(line.labelled("4 points of the map"));
    }
    found
}

/// Exponent and factor of C = factor · q^exponent by least squares of the logarithms; `None` for too few rings.
///
/// The weight of a ring is its number of waves, the reciprocal variance of the logarithm of its density for a Gaussian random
/// surface.
fn power_law(rings: &[&Ring]) -> Option<[f64; 2]> {
    if rings.len() < FEWEST_RINGS {
        return None;
    }
    let sums = rings.iter().fold([0.0; 5], |[w, x, y, xx, xy], ring| {
        let (weight, q, c) = (ring.waves as f64, ring.wave_number.ln(), ring.density.ln());
        [
            w + weight,
            x + weight * q,
            y + weight * c,
            xx + weight * q * q,
            xy + weight * q * c,
        ]
    });
    let [w, x, y, xx, xy] = sums;
    let exponent = (w * xy - x * y) / (w * xx - x * x);
    let factor = ((y - exponent * x) / w).exp();
    (exponent.is_finite() && factor.is_finite() && factor > 0.0).then_some([exponent, factor])
}

/// A red arrow along the motion, for axes of different scales.
fn motion_arrow(x: [f64; 2], y: [f64; 2]) -> Series {
    Series {
        colour: Colour::Red,
        ..arrow(x, y, false)
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
        motion_arrow(x, [1.1 * highest, 1.1 * highest + y[1] - y[0]])
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

/// A chart of spectra, whose ranges hold them but not their references.
fn chart(title: &str, label: &str, mut series: Vec<Series>, references: Vec<Series>) -> Chart {
    // With waves along one axis only, the other spectrum is empty.
    series.retain(|one| !one.points.is_empty());
    let mut chart = decades("wave number q = 2π/λ [1/m]", label, series);
    chart.title = Some(title.to_owned());
    chart.series.extend(references);
    chart
}
