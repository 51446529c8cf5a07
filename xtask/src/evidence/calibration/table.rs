//! How many bars hold, and how wide they are.

use std::collections::BTreeMap;

use comfy_table::Table;

use super::judged::{Judged, Row};
use crate::meter::median;
use crate::output::markdown_table;

/// One line per method.
pub(super) fn table(judged: &Judged) -> Table {
    let mut methods: BTreeMap<&str, Vec<&Row>> = BTreeMap::new();
    for row in &judged.rows {
        methods.entry(&row.method).or_default().push(row);
    }
    let header = [
        "method",
        "answers",
        "bars that hold",
        "with a sharp reference",
        "of these within the bar alone",
        "median of bar/deviation",
        "worst deviation/bar",
        "refused",
    ];
    let lines = methods.into_iter().map(|(method, rows)| {
        let refused = judged.refusals.iter();
        let refused = refused.filter(|refusal| refusal.method == method).count();
        line(method, &rows, refused)
    });
    let all = line(
        "all",
        &judged.rows.iter().collect::<Vec<_>>(),
        judged.refusals.len(),
    );
    markdown_table(header, lines.chain([all]))
}

/// What was not asked, and how often.
pub(super) fn left_out(reasons: &[&'static str]) -> String {
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    for reason in reasons {
        *counts.entry(reason).or_default() += 1;
    }
    let lines = counts
        .iter()
        .map(|(reason, count)| format!("- {count} × {reason}\n"));
    format!("\nnot asked:\n{}", lines.collect::<String>())
}

fn line(method: &str, rows: &[&Row], refused: usize) -> [String; 8] {
    let held = rows.iter().filter(|row| row.holds).count();
    let sharp: Vec<_> = rows.iter().filter(|row| row.is_sharply_judged()).collect();
    let held_alone = sharp.iter().filter(|row| row.holds_alone).count();
    let [middle, worst] = deviations(rows);
    [
        method.to_owned(),
        rows.len().to_string(),
        part(held, rows.len()),
        sharp.len().to_string(),
        part(held_alone, sharp.len()),
        middle,
        worst,
        refused.to_string(),
    ]
}

/// The median of bar/deviation and the worst of deviation/bar; empty without rows.
fn deviations(rows: &[&Row]) -> [String; 2] {
    if rows.is_empty() {
        return [String::new(), String::new()];
    }
    let parts: Vec<f64> = rows.iter().map(|row| row.part_of_bar()).collect();
    let worst = parts.iter().copied().fold(0.0, f64::max);
    [short(1.0 / median(parts)), short(worst)]
}

fn part(held: usize, all: usize) -> String {
    if all == 0 {
        return String::new();
    }
    format!("{:.1} %", 100.0 * held as f64 / all as f64)
}

/// Two digits, or a power of ten.
fn short(value: f64) -> String {
    if value.is_finite() && !(1e-2..1e4).contains(&value) && value > 0.0 {
        return format!("{value:.0e}");
    }
    if value.is_finite() {
        return format!("{value:.2}");
    }
    "∞".to_owned()
}

#[cfg(test)]
mod tests {
    use super::super::judged::Refusal;
    use super::*;

    #[test]
    fn where_every_answer_is_refused_the_cells_are_empty() {
        let refusal = Refusal {
            scene: 1,
            indenter: String::new(),
            material: String::new(),
            load: String::new(),
            method: "bem-steady".to_owned(),
            reason: "not reached".to_owned(),
        };
        let refused = Judged {
            refusals: vec![refusal],
            ..Judged::default()
        };
        let printed = table(&refused).to_string();
        let cells = printed.lines().last().map(|line| line.split('|'));
        let cells: Vec<&str> = cells.into_iter().flatten().map(str::trim).collect();
        let expected = ["", "all", "0", "", "0", "", "", "", "1", ""];
        assert_eq!(cells, expected, "the line of all in\n{printed}");
    }
}
