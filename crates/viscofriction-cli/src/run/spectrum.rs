//! Derivatives by the modulus at each frequency: a table, and a picture below the master curve.

use std::iter;

use comfy_table::Table;
use viscofriction::Estimate;
use viscofriction::solve::{ByFrequency, Problem, SpectralSensitivity};
use viscofriction_plot::{Axis, Chart, Colour, Dash, Figure, Line, Marker, Series, Shape};

use super::pictures::range_with_zero;
use crate::output::markdown;

/// Smallest fraction of the sum of the absolute derivatives of friction by all bands with which a band has a row in the
/// table. Chosen: the sentence below the table has the sum of all smaller ones.
const MIN_FRACTION_IN_TABLE: f64 = 0.01;
/// Smallest fraction of the sum of the absolute derivatives of friction by all bands with which a band has a point in the
/// picture. Chosen: lower points cannot be distinguished from zero on the linear axis, and would lengthen the other one.
const MIN_FRACTION_IN_PICTURE: f64 = 1e-4;
/// Number of points per decade of a master curve. Chosen; it changes the picture only.
const POINTS_PER_DECADE: f64 = 20.0;

/// Colours of the storage and the loss modulus, in this order.
const COLOURS: [Colour; 2] = [Colour::Blue, Colour::Red];

/// Derivatives d ln q/d ln G' and d ln q/d ln G'' of the quantity `key` in a band; `None` if they are not known.
fn derivatives(band: &ByFrequency, key: &str) -> [Option<Estimate>; 2] {
    [&band.storage_modulus, &band.loss_modulus].map(|one| one.derivatives.of(key))
}

/// Derivatives d ln μ/d ln G' and d ln μ/d ln G'' of the friction coefficient in a frequency band; 0 if the answer has none.
fn friction_derivatives(band: &ByFrequency) -> [Estimate; 2] {
    derivatives(band, "friction_coefficient").map(|known| known.unwrap_or(Estimate::exact(0.0)))
}

/// Sum of the absolute derivatives of friction by G' and by G'' in a band.
fn derivative_size(band: &ByFrequency) -> f64 {
    friction_derivatives(band)
        .iter()
        .map(|known| known.value.abs())
        .sum()
}

/// Bands with at least the fraction `part` of the sum over all bands.
fn significant_bands(
    spectral: &SpectralSensitivity,
    part: f64,
) -> impl Iterator<Item = &ByFrequency> {
    let least = part * spectral.bands.iter().map(derivative_size).sum::<f64>();
    spectral
        .bands
        .iter()
        .filter(move |band| derivative_size(band) >= least)
}

/// Table of the frequency bands whose derivatives are significant, and a sentence about the part of all others.
pub(super) fn table(spectral: &SpectralSensitivity) -> (Table, String) {
    let first = spectral.bands.first().into_iter();
    let known = first.flat_map(|band| band.storage_modulus.derivatives.iter());
    let keys: Vec<&str> = known.map(|(key, _)| key).collect();
    let heads = keys.iter().flat_map(|key| {
        ["G′", "G″"].map(|modulus| format!(" | d ln {} by {modulus}", key.replace('_', " ")))
    });
    let mut table = markdown(&format!("ω [rad/s]{}", heads.collect::<String>()));
    for band in significant_bands(spectral, MIN_FRACTION_IN_TABLE) {
        let [from, to] = band.frequencies;
        let cells = keys
            .iter()
            .flat_map(|key| derivatives(band, key))
            .map(|known| known.map_or_else(String::new, |known| known.to_string()));
        table.add_row(iter::once(format!("{from:.3e} to {to:.3e}")).chain(cells));
    }
    let all: f64 = spectral.bands.iter().map(derivative_size).sum();
    let shown: f64 = significant_bands(spectral, MIN_FRACTION_IN_TABLE)
        .map(derivative_size)
        .sum();
    let percent = |part: f64| format!("{:.1} %", 100.0 * part);
    let rest = percent((all - shown) / all);
    let mut words =
        format!("Of the absolute values of the friction, bands without a row have {rest}");
    if let Some(outside) = spectral.outside_valid_frequencies {
        let outside = percent(outside);
        words += &format!(", and frequencies at which the material was not measured {outside}");
    }
    (table, words + ".")
}

/// The master curve, and below it the derivatives of friction by both moduli per decade of frequency.
pub(super) fn figure(problem: &Problem, spectral: &SpectralSensitivity) -> Figure {
    let bands: Vec<&ByFrequency> = significant_bands(spectral, MIN_FRACTION_IN_PICTURE)
        .filter(|band| band.frequencies[0] > 0.0)
        .collect();
    let ends = bands.iter().flat_map(|band| band.frequencies);
    let x = Axis::decades("angular frequency ω [rad/s]", ends);
    let above = master_curve(problem, x.clone());
    let by = [0, 1].map(|part| per_decade(&bands, part));
    let ends = by.iter().flat_map(|series| {
        let pairs = series.points.iter().zip(&series.errors);
        pairs.flat_map(|(point, error)| [point[1] - error, point[1] + error])
    });
    let range = range_with_zero(ends);
    let y = Axis::linear("d ln μ per decade of ω", range);
    let window = problem.window().into_iter().flatten();
    let within = window.filter(|end| x.range[0] < *end && *end < x.range[1]);
    let window = within.map(|end| {
        let points = range.map(|value| [end, value]).to_vec();
        Series::line(points, Line::thin(Dash::Dashed), Colour::Black)
    });
    let series = window.chain(by).collect();
    Figure::new([above, Chart::new(x, y, series)], 1)
}

/// Derivatives of friction by one modulus per decade, at the geometric mean of each band.
fn per_decade(bands: &[&ByFrequency], part: usize) -> Series {
    let at = bands.iter().map(|band| {
        let [from, to] = band.frequencies;
        let known = friction_derivatives(band)[part];
        let decades = (to / from).log10();
        (
            [(from * to).sqrt(), known.value / decades],
            known.error / decades,
        )
    });
    let (points, errors): (Vec<[f64; 2]>, Vec<f64>) = at.unzip();
    let marker = Marker::filled(Shape::Circle);
    Series {
        errors,
        line: Some(Line::thick(Dash::Solid)),
        ..Series::markers(points, marker, COLOURS[part])
    }
    .labelled(["by ln G′", "by ln G″"][part])
}

/// Storage and loss modulus over the range of an axis.
pub(super) fn master_curve(problem: &Problem, x: Axis) -> Chart {
    let [first, last] = x.range.map(|end| (POINTS_PER_DECADE * end.log10()).round());
    #[expect(clippy::cast_possible_truncation, reason = "logarithms of numbers")]
    let points = first as i32..=last as i32;
    let at = |index: i32| {
        let frequency = 10.0_f64.powf(f64::from(index) / POINTS_PER_DECADE);
        let modulus = problem.material().complex_modulus(frequency).ok()?;
        Some([frequency, modulus.storage, modulus.loss])
    };
    let moduli: Vec<[f64; 3]> = points.filter_map(at).collect();
    let curves = [0, 1].map(|part| {
        let points = moduli
            .iter()
            .map(|row| [row[0], row[1 + part]])
            .filter(|point| point[1] > 0.0)
            .collect();
        let line = Line::thick(Dash::Solid);
        Series::line(points, line, COLOURS[part]).labelled(["G′", "G″"][part])
    });
    let values = curves.iter().flat_map(|curve| &curve.points);
    let y = Axis::decades("modulus [Pa]", values.map(|point| point[1]));
    let drawn = curves.into_iter().filter(|curve| curve.points.len() > 1);
    Chart::new(x, y, drawn.collect())
}
