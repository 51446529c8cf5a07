//! The matrix of stiff and extreme cases, on the quick ones.

use crate::support::{Evidence, argument, folder, number, text, xtask};

#[test]
fn no_stiff_or_extreme_case_is_wrong() {
    let evidence = Evidence::quick("stability", &["stability"]);
    let rows = evidence.rows("stability");
    let count = |verdict: &str| rows.iter().filter(|row| row["verdict"] == verdict).count();
    let counts = ["accurate", "refused", "wrong"].map(count);
    assert!(
        counts[0] > 200 && counts[1] > 20 && counts[2] == 0,
        "accurate, refused, wrong: {counts:?}"
    );
    for row in rows.iter().filter(|row| row["verdict"] == "accurate") {
        let [deviation, tolerance] = ["deviation", "tolerance"].map(|column| number(row, column));
        assert!(deviation <= tolerance, "{row:?}");
    }
    evidence.assert_pictures(&["stability"]);
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
