//! The matrix of stiff and extreme cases, on the quick ones.

use crate::support::{Evidence, argument, folder, number, run, text};

#[test]
fn no_stiff_or_extreme_case_is_wrong() {
    let evidence = Evidence::quick("stability", "stability");
    let rows = evidence.rows("stability");
    let count = |verdict: &str| rows.iter().filter(|row| row["verdict"] == verdict).count();
    let counts = ["accurate", "refused", "wrong"].map(count);
    let are_right = counts[0] > 150 && counts[1] > 3 && counts[2] == 0;
    assert!(are_right, "accurate, refused, wrong: {counts:?}");
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
