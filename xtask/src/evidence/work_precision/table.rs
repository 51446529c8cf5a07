//! What was measured, for a person: order, exponent of cost, and the time to an error of each series.

use comfy_table::Table;

use super::fit::Fit;
use super::measured::Row;
use crate::output::markdown_table;

/// Relative errors that are asked for, and their names.
const ASKED: [(f64, &str); 5] = [
    (1e-2, "1 %"),
    (1e-3, "0.1 %"),
    (1e-4, "0.01 %"),
    (1e-6, "10⁻⁶"),
    (1e-9, "10⁻⁹"),
];

/// One row per series, one column per error.
pub(super) fn table(series: &[(Vec<Row>, Fit)]) -> Table {
    let [one, two, three, four, five] = ASKED.map(|(_, name)| name);
    let header = [
        "scene",
        "model",
        "method",
        "over",
        "order",
        "cost exponent",
        one,
        two,
        three,
        four,
        five,
    ];
    let rows = series.iter().map(|(rows, fit)| {
        let [one, two, three, four, five] = ASKED.map(|(error, _)| time_to(rows, error));
        [
            fit.scene.to_owned(),
            fit.model.to_owned(),
            fit.method.clone(),
            fit.resolution_kind.to_owned(),
            exponent(fit.order, fit.order_error),
            exponent(fit.cost_exponent, fit.cost_exponent_error),
            one,
            two,
            three,
            four,
            five,
        ]
    });
    markdown_table(header, rows)
}

fn exponent(value: Option<f64>, error: Option<f64>) -> String {
    value.zip(error).map_or_else(String::new, |(value, error)| {
        format!("{value:.2} ± {error:.2}")
    })
}

/// The time of the coarsest run from which on all finer ones are as exact, because one alone may be so by chance.
fn time_to(rows: &[Row], error: f64) -> String {
    let bad = rows.iter().rposition(|row| row.visible_error() > error);
    rows.get(bad.map_or(0, |bad| bad + 1))
        .map_or_else(String::new, |row| duration(row.processor_seconds))
}

fn duration(seconds: f64) -> String {
    match seconds {
        seconds if seconds < 1e-5 => format!("{:.1} µs", 1e6 * seconds),
        seconds if seconds < 1e-3 => format!("{:.0} µs", 1e6 * seconds),
        seconds if seconds < 1e-2 => format!("{:.1} ms", 1e3 * seconds),
        seconds if seconds < 1.0 => format!("{:.0} ms", 1e3 * seconds),
        seconds => format!("{seconds:.1} s"),
    }
}
