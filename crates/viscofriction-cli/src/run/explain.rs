//! What the scene did not need, why, and what leaving it out saves.

use anyhow::Result;
use comfy_table::Table;

use viscofriction::solve::Problem;

use super::Timed;
use super::savings::{Change, Cost, Saving, savings};

/// One row per part that was left out, with the work measured without it and with it.
pub(super) fn table(problem: &Problem, answer: &Timed<'_>) -> Result<Table> {
    let mut table = Table::new();
    table.load_style(comfy_table::presets::ASCII_MARKDOWN);
    table.set_header([
        "left out",
        "because",
        "time",
        "with it",
        "memory",
        "with it",
        "answer changes by",
    ]);
    for (omission, saving) in savings(problem, answer)? {
        let mut row = vec![omission.name().to_owned(), omission.because().to_owned()];
        row.extend(match saving {
            Ok(saving) => cells(&saving),
            Err(error) => {
                let nothing = String::new;
                let why = format!("not measured: {error:#}");
                [nothing(), nothing(), nothing(), nothing(), why]
            }
        });
        table.add_row(row);
    }
    Ok(table)
}

fn cells(saving: &Saving) -> [String; 5] {
    let Saving {
        left_out,
        done,
        change,
    } = saving;
    [
        time(left_out),
        time(done),
        memory(left_out),
        memory(done),
        changes(change),
    ]
}

fn time(cost: &Cost) -> String {
    format!("{:.2e} s", cost.seconds)
}

fn memory(cost: &Cost) -> String {
    format!("{:.2e} B", cost.bytes as f64)
}

fn changes(change: &Change) -> String {
    match change {
        Change::None => "nothing".to_owned(),
        Change::Rounding(change) => format!("{change:.1e}"),
        Change::OfMethod {
            method,
            change,
            bars: [own, other],
        } => {
            let name = method.name();
            format!("{change:.1e}; error bars {own:.1e} and, {name}, {other:.1e}")
        }
    }
}
