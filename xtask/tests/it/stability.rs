//! The matrix of stiff and extreme cases, on the quick ones.

use std::collections::HashMap;

use crate::support::{argument, folder, text, xtask};

#[test]
fn no_stiff_or_extreme_case_is_wrong() {
    let folder = folder("stability");
    let output = xtask(&[
        "evidence",
        "stability",
        "--quick",
        "--out",
        argument(&folder),
    ]);
    let message = text(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{message}");
    let mut reader = csv::Reader::from_path(folder.join("stability.csv")).expect("a table");
    let rows: Vec<HashMap<String, String>> = reader
        .deserialize()
        .collect::<Result<_, _>>()
        .expect("rows of the table");
    let count = |verdict: &str| rows.iter().filter(|row| row["verdict"] == verdict).count();
    let counts = ["accurate", "refused", "wrong"].map(count);
    assert!(
        counts[0] > 200 && counts[1] > 20 && counts[2] == 0,
        "accurate, refused, wrong: {counts:?}"
    );
    for row in rows.iter().filter(|row| row["verdict"] == "accurate") {
        let [deviation, tolerance] = ["deviation", "tolerance"].map(|column| {
            let cell = &row[column];
            cell.parse::<f64>()
                .unwrap_or_else(|error| panic!("{column} = {cell:?}: {error}"))
        });
        assert!(deviation <= tolerance, "{row:?}");
    }
    for ending in ["svg", "png"] {
        let size = std::fs::metadata(folder.join("stability").with_extension(ending));
        assert!(
            size.is_ok_and(|size| size.len() > 1000),
            "stability.{ending}"
        );
    }
}

#[test]
fn cases_can_be_chosen_and_unknown_ones_are_wrong_input() {
    let folder = folder("stability-chosen");
    let run = |only: &str| {
        xtask(&[
            "evidence",
            "stability",
            "--only",
            only,
            "--out",
            argument(&folder),
        ])
    };
    let chosen = run("creep of Kelvin–Voigt in steps, Δt/λ = 1e-12");
    let printed = text(&chosen.stdout);
    assert_eq!(chosen.status.code(), Some(0), "{printed}");
    assert!(
        printed.contains("| creep of Kelvin–Voigt in steps | Δt/λ      | 1     |"),
        "{printed}"
    );
    assert_eq!(run("no such case").status.code(), Some(2), "exit status");
}
