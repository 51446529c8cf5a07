//! Picture of friction and area over the cut-off wavelength with error bars, compared with the theories of Persson (2006) for the
//! friction and of Xu and others (2024) for the area.

use viscofriction::Quantity;
use viscofriction_plot::{Axis, Chart, Colour, Dash, Figure, Line, Marker, Series, Shape};

use super::Row;
use crate::run::range_with_zero;

/// Root mean square slope above which linear theory is only a rough approximation, see docs/road.md.
const STEEPEST: f64 = 0.5;
/// Ratio of the shortest wavelength that an instrument resolves to the spacing of the points of its map. Chosen, see
/// docs/road.md.
const POINTS_PER_WAVE: f64 = 4.0;
/// Factor by which the axis extends beyond the shortest and the longest wavelength. Chosen.
const AXIS_MARGIN_FACTOR: f64 = 1.25;

/// The figure of a cut-off series; `spacing` is that of the points of a measured map, \[m].
pub(super) fn figure(rows: &[Row], spacing: Option<f64>) -> Figure {
    let limits = [
        (
            spacing.map(|spacing| POINTS_PER_WAVE * spacing),
            Dash::Dotted,
            "4 points of the map",
        ),
        (steep_below(rows), Dash::DashDot, "rms slope 0.5"),
    ]
    .map(|(length, dash, label)| Limit {
        length,
        dash,
        label,
    });
    let friction = (
        "persson_friction_coefficient_2006",
        "theory, Persson (2006)",
    );
    let area = ("persson_area_fraction_xu", "theory, Xu and others (2024)");
    let friction = chart("friction_coefficient", friction, rows, &limits);
    Figure::new([friction, chart("area_fraction", area, rows, &limits)], 2)
}

/// A wavelength below which results are not valid.
struct Limit {
    /// The wavelength, \[m]; `None` if it is not known or not within the series.
    length: Option<f64>,
    dash: Dash,
    label: &'static str,
}

/// Wavelength at which the rms slope reaches [`STEEPEST`], \[m], interpolated over its logarithm; `None` if no cut-off is steeper.
fn steep_below(rows: &[Row]) -> Option<f64> {
    rows.windows(2).find_map(|pair| {
        let [steep, flat] = [0, 1].map(|place| pair[place].rms_slope - STEEPEST);
        let ends = [0, 1].map(|place| pair[place].shortest_wavelength.ln());
        let part = steep / (steep - flat);
        (steep > 0.0 && flat <= 0.0).then(|| (ends[0] + part * (ends[1] - ends[0])).exp())
    })
}

/// A chart of one quantity, with the column and the name of its theory.
fn chart(key: &str, (theory, name): (&str, &str), rows: &[Row], limits: &[Limit]) -> Chart {
    let label = Quantity::named(key)
        .map(Quantity::label)
        .unwrap_or_default();
    let (points, errors): (Vec<[f64; 2]>, Vec<f64>) = rows
        .iter()
        .filter_map(|row| Some((row.shortest_wavelength, row.quantity(key)?)))
        .map(|(length, known)| ([length, known.value], known.error))
        .unzip();
    let theory = rows
        .iter()
        .filter_map(|row| Some([row.shortest_wavelength, row.number(theory)?]));
    let bars = points.iter().zip(&errors);
    let ends = bars.flat_map(|([_, value], error)| [value - error, value + error]);
    let range = range_with_zero(ends);
    let lengths = rows.iter().map(|row| row.shortest_wavelength);
    let [shortest, longest] = lengths.fold([f64::INFINITY, 0.0_f64], |[low, high], length| {
        [low.min(length), high.max(length)]
    });
    let x = Axis::log10(
        "shortest wavelength λ [m]",
        [
            shortest / AXIS_MARGIN_FACTOR,
            longest * AXIS_MARGIN_FACTOR.max(2.0 * shortest / longest),
        ],
    );
    // Draw the computed values as dots, which leave bars visible that are smaller than other markers.
    let computed = Series {
        marker: Some(Marker::filled(Shape::Dot)),
        errors,
        ..Series::line(points, Line::thin(Dash::Solid), Colour::Blue)
    };
    let theory = Series::reference(theory.collect(), Dash::Dashed, Colour::Red);
    let mut series = vec![computed.labelled("computed"), theory.labelled(name)];
    series.retain(|one| one.points.len() > usize::from(one.marker.is_none()));
    series.extend(limits.iter().filter_map(|limit| {
        let length = limit.length?;
        let line = range.map(|value| [length, value]).to_vec();
        let line = Series::line(line, Line::thin(limit.dash), Colour::Grey);
        (x.range[0] < length && length < x.range[1]).then(|| line.labelled(limit.label))
    }));
    Chart::new(x, Axis::linear(label, range), series)
}
