//! The tables of the comparison.

use std::ops::Range;

use comfy_table::Table;

use super::{AREAS, Point, RIGHT_WITHIN, Ratio, SOLIDS, THEORIES};
use crate::meter::median;
use crate::table::{group_by, markdown_table};

/// Indices in [`THEORIES`] of the first table: Persson's theories and Wang & Müser's.
const FRICTIONS: Range<usize> = 0..3;
/// Indices in [`THEORIES`] of the second table: the line and the theories of the area.
const OTHERS: Range<usize> = 3..THEORIES.len();
/// Smallest number of the longest waves along the period with which a surface counts as large. Chosen: with fewer it has only a
/// few summits.
const MIN_WAVES: f64 = 4.0;
/// Smallest area fraction of the points in the fit of γ. Chosen: no value of γ brings the theory close to points below it.
const MIN_AREA: f64 = 0.03;

/// The page in Markdown: tables by class of area, by solid and class, and by spectrum and class, and the best weight γ of each
/// solid. `n_scenes` is the number of all rows computed.
pub(super) fn summary(points: &[Point], n_scenes: usize) -> String {
    let answered: usize = points.iter().map(|point| point.frictions.len()).sum();
    let is_large = |point: &&Point| point.longest_waves_in_period >= MIN_WAVES;
    let large: Vec<&Point> = points.iter().filter(is_large).collect();
    let spectrum = |point: &Point| {
        let [longest, shortest] = [
            point.longest_waves_in_period,
            point.shortest_waves_in_longest,
        ]
        .map(|count| format!("{count:2}"));
        vec![point.hurst_exponent.to_string(), longest, shortest]
    };
    let of_spectrum = ["Hurst exponent", "period/longest wave", "longest/shortest"];
    let both = |labels: &[&str], points: &[&Point], label: Label| {
        let tables = [FRICTIONS, OTHERS].map(|theories| table(labels, points, label, theories));
        tables.map(|table| format!("{table}\n\n")).concat()
    };
    let weights = SOLIDS.iter().filter_map(|solid| weight(solid.name, points));
    let weights: String = weights.collect();
    format!(
        "Surfaces with at least {MIN_WAVES} longest waves along the period:\n\n{}{}All solids:\n\n{}{weights}\n\
         {answered} of {n_scenes} scenes are of points at which all surfaces have an answer.",
        both(&[], &large, |_| Vec::new()),
        both(&["solid"], &large, |point| vec![point.solid.to_owned()]),
        both(&of_spectrum, &points.iter().collect::<Vec<_>>(), spectrum),
    )
}

/// Rows of `rough_points.csv`: each point with each of its ratios.
pub(super) fn rows<'a>(points: &'a [Point<'a>]) -> Vec<(&'a Point<'a>, &'a Ratio)> {
    let rows = |point: &'a Point<'a>| {
        let ratios = point.ratios.iter().flatten();
        ratios.map(move |ratio| (point, ratio))
    };
    points.iter().flat_map(rows).collect()
}

/// First cells of the line in which a point is counted.
type Label = fn(&Point) -> Vec<String>;

/// A table with one line per label and class of area: number of points, the medians of the relative standard error of the first
/// ratio and of the relative error bar of the area, and for each theory the [`spread`] of its ratios.
fn table(labels: &[&str], points: &[&Point], label: Label, theories: Range<usize>) -> Table {
    let class = |point: &&Point| {
        let class = AREAS.partition_point(|end| point.area_fraction >= *end);
        (label(point), class)
    };
    let classes = group_by(points.iter().copied(), class);
    let lines = classes.into_iter().map(|((label, class), points)| {
        let from = if class == 0 { 0.0 } else { AREAS[class - 1] };
        let errors = points
            .iter()
            .filter_map(|point| point.ratios[0])
            .map(|ratio| ratio.standard_error / ratio.ratio);
        let bars = points
            .iter()
            .map(|point| point.area_fraction_error / point.area_fraction);
        let percent = |parts: Vec<f64>| format!("{:.0} %", 100.0 * median(parts));
        let mut line = label;
        line.extend([from.to_string(), points.len().to_string()]);
        line.extend([percent(errors.collect()), percent(bars.collect())]);
        for theory in theories.clone() {
            let values = points.iter().filter_map(|point| point.ratios[theory]);
            line.push(spread(values.map(|ratio| ratio.ratio).collect()));
        }
        line
    });
    let header = labels.iter().copied().chain([
        "area fraction from",
        "points",
        "standard error",
        "area bar",
    ]);
    let names = THEORIES[theories.clone()].iter().map(|theory| theory.name);
    markdown_table(header.chain(names), lines)
}

/// Median, 5th and 95th percentile of ratios, and how many are within [`RIGHT_WITHIN`] of 1; empty of none.
fn spread(mut values: Vec<f64>) -> String {
    values.sort_by(f64::total_cmp);
    let Some(last) = values.len().checked_sub(1) else {
        return String::new();
    };
    let within = values
        .iter()
        .filter(|ratio| (*ratio - 1.0).abs() <= RIGHT_WITHIN);
    let within = 100 * within.count() / values.len();
    let [low, high] = [last / 20, last - last / 20].map(|place| values[place]);
    let median = median(values);
    format!("{median:.2} ({low:.2} to {high:.2}), {within} %")
}

/// The weight γ of the energy factor S = γ + (1 − γ) P² in Persson's theory that suits every second surface best (least squares
/// of the relative deviation), and how well it suits the others; `None` without points. P is the fraction of area in contact.
/// Persson's theory of 2001 has S = 1, that of 2006 γ = 1/2.
fn weight(solid: &str, points: &[Point]) -> Option<String> {
    let counted = points.iter().filter(|point| {
        point.solid == solid
            && point.area_fraction >= MIN_AREA
            && point.longest_waves_in_period >= MIN_WAVES
    });
    // For each half of the surfaces, add up the friction, the difference between Persson's theories with S = 1 and with S = P²,
    // and the theory with S = P².
    let halves = counted.map(|point| {
        [0, 1].map(|first| {
            let half = point.frictions.iter().skip(first).step_by(2);
            half.fold([0.0; 3], |sums, [friction, of_2001, of_2006]| {
                let least = 2.0 * of_2006 - of_2001;
                [
                    sums[0] + friction,
                    sums[1] + of_2001 - least,
                    sums[2] + least,
                ]
            })
        })
    });
    let halves: Vec<[[f64; 3]; 2]> = halves.collect();
    let [mut above, mut below] = [0.0; 2];
    for [[friction, more, least], _] in &halves {
        above += more / friction * (1.0 - least / friction);
        below += (more / friction).powi(2);
    }
    let weight = above / below;
    let others = halves
        .iter()
        .map(|[_, [friction, more, least]]| friction / (least + weight * more));
    (!halves.is_empty()).then(|| format!(
        "- {solid}: γ = {weight:.2} from every second surface; friction of the others over that with it {}\n",
        spread(others.collect())
    ))
}
