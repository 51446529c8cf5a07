//! The matrix of stiff and extreme cases.

use crate::support::{Evidence, argument, folder, number, page, run, text};

#[test]
fn no_stiff_or_extreme_case_is_wrong() {
    let evidence = Evidence::quick("stability", "stability");
    let rows = evidence.rows("stability");
    let count = |verdict: &str| rows.iter().filter(|row| row["verdict"] == verdict).count();
    let counts = ["accurate", "refused", "wrong"].map(count);
    assert_eq!(counts[2], 0, "accurate, refused, wrong: {counts:?}");
    let (all, [accurate, refused, _]) = (rows.len(), counts);
    let found = format!("{all} cases: {accurate} accurate, {refused} refused, none wrong");
    let stated = page("stability");
    assert!(
        stated.contains(&found),
        "{found}, but docs/stability.md: {stated}"
    );
    for row in rows.iter().filter(|row| row["verdict"] == "accurate") {
        let [deviation, tolerance] = ["deviation", "tolerance"].map(|column| number(row, column));
        assert!(deviation <= tolerance, "{row:?}");
    }
    evidence.assert_pictures(&["stability"]);
}

#[test]
fn cases_can_be_chosen() {
    let folder = folder("stability-chosen");
    let case = "line, cone on Maxwell, vτ/x_r = 1e-12";
    let line = ["evidence", "stability", "--only", case, "--out"];
    let chosen = run(line.into_iter().chain([argument(&folder)]));
    let printed = text(&chosen.stdout);
    assert_eq!(chosen.status.code(), Some(0), "{printed}");
    let row = "| line, cone on Maxwell | vτ/x_r    | 1     |";
    assert!(printed.contains(row), "{printed}");
}
