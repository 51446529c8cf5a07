//! The tables of the comparison.

use std::collections::BTreeMap;

use comfy_table::Table;
use serde::Serialize;

use super::{AREAS, Point, SOLIDS, THEORIES, WITHIN};
use crate::meter::median;
use crate::output::markdown_table;

/// Longest waves in the period from which a surface is more than a few summits.
const FEWEST_WAVES: f64 = 4.0;
/// Area fraction from which γ is sought: below it no γ helps.
const FROM_AREA: f64 = 0.03;

/// Tables by solid and area, and by spectrum and area, and what weight the theory would take.
pub(super) fn summary(points: &[Point], n_scenes: usize) -> String {
    let answered: usize = points.iter().map(|point| point.frictions.len()).sum();
    let large = points.iter().filter(|point| point.waves[0] >= FEWEST_WAVES);
    let by_solid = large.map(|point| (vec![point.solid.to_owned()], point));
    let by_spectrum = points.iter().map(|point| {
        let waves = point.waves.map(|count| format!("{count:2}"));
        (waves.to_vec(), point)
    });
    let tables = [
        table(&["solid"], by_solid.collect()),
        table(
            &["period/longest wave", "longest/shortest"],
            by_spectrum.collect(),
        ),
    ];
    let weights = SOLIDS.iter().filter_map(|(solid, _)| weight(solid, points));
    let weights: String = weights.collect();
    format!(
        "Surfaces with at least {FEWEST_WAVES} longest waves along the period:\n\n{}\n\nAll solids:\n\n{}\n\n{weights}\n\
         {answered} of {n_scenes} scenes are of points at which all surfaces have an answer.",
        tables[0], tables[1]
    )
}

/// A point in the file.
#[derive(Serialize)]
pub(super) struct Row<'a> {
    solid: &'a str,
    longest_waves_in_period: f64,
    shortest_waves_in_longest: f64,
    mean_pressure: f64,
    velocity: f64,
    area_fraction: f64,
    friction_over_persson_2001: Option<f64>,
    friction_over_persson_2001_standard_error: Option<f64>,
    friction_over_persson_2006: Option<f64>,
    friction_over_persson_2006_standard_error: Option<f64>,
    friction_over_line: Option<f64>,
    friction_over_line_standard_error: Option<f64>,
    area_over_persson: Option<f64>,
    area_over_persson_standard_error: Option<f64>,
}

pub(super) fn rows<'a>(points: &[Point<'a>]) -> Vec<Row<'a>> {
    let row = |point: &Point<'a>| {
        let values = point.ratios.map(|ratio| ratio.map(|ratio| ratio.value));
        let errors = point
            .ratios
            .map(|ratio| ratio.map(|ratio| ratio.standard_error));
        Row {
            solid: point.solid,
            longest_waves_in_period: point.waves[0],
            shortest_waves_in_longest: point.waves[1],
            mean_pressure: point.load[0],
            velocity: point.load[1],
            area_fraction: point.area,
            friction_over_persson_2001: values[0],
            friction_over_persson_2001_standard_error: errors[0],
            friction_over_persson_2006: values[1],
            friction_over_persson_2006_standard_error: errors[1],
            friction_over_line: values[2],
            friction_over_line_standard_error: errors[2],
            area_over_persson: values[3],
            area_over_persson_standard_error: errors[3],
        }
    };
    points.iter().map(row).collect()
}

/// By label and class of area: points, their typical standard error, and for each theory the median ratio, between what nine of
/// ten are, and how many are within a tenth.
fn table(labels: &[&str], points: Vec<(Vec<String>, &Point)>) -> Table {
    let mut classes: BTreeMap<(Vec<String>, usize), Vec<&Point>> = BTreeMap::new();
    for (label, point) in points {
        let class = AREAS.partition_point(|end| point.area >= *end);
        classes.entry((label, class)).or_default().push(point);
    }
    let lines = classes.into_iter().map(|((label, class), points)| {
        let from = if class == 0 { 0.0 } else { AREAS[class - 1] };
        let errors = points.iter().filter_map(|point| point.ratios[0]);
        let errors: Vec<f64> = errors
            .map(|ratio| ratio.standard_error / ratio.value)
            .collect();
        let mut line = label;
        line.extend([from.to_string(), points.len().to_string()]);
        line.push(format!("{:.0} %", 100.0 * median(errors)));
        for theory in 0..THEORIES.len() {
            let values = points.iter().filter_map(|point| point.ratios[theory]);
            line.push(spread(values.map(|ratio| ratio.value).collect()));
        }
        line
    });
    let header = labels
        .iter()
        .copied()
        .chain(["area fraction from", "points", "standard error"]);
    markdown_table(header.chain(THEORIES.map(|(name, _)| name)), lines)
}

fn spread(mut values: Vec<f64>) -> String {
    values.sort_by(f64::total_cmp);
    let Some(last) = values.len().checked_sub(1) else {
        return String::new();
    };
    let within = values.iter().filter(|ratio| (*ratio - 1.0).abs() <= WITHIN);
    let within = 100 * within.count() / values.len();
    let [low, high] = [last / 20, last - last / 20].map(|place| values[place]);
    let median = median(values);
    format!("{median:.2} ({low:.2} to {high:.2}), {within} %")
}

/// The γ of S = γ + (1 − γ) P² that suits every second surface best, and how well it suits the others.
fn weight(solid: &str, points: &[Point]) -> Option<String> {
    let points = points.iter().filter(|point| {
        point.solid == solid && point.area >= FROM_AREA && point.waves[0] >= FEWEST_WAVES
    });
    // Means of the friction, of what S = 1 adds to S = P², and of the friction with that.
    let halves = points.map(|point| {
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
