//! What the comparison of rough surfaces with Persson's theory writes, on its quick scenes.

use std::fs;

use crate::support::{Evidence, number};

#[test]
fn theory_is_exact_where_the_contact_is_full_and_rows_that_are_there_are_kept() {
    let evidence = Evidence::quick("rough", "rough");
    let rows = evidence.rows("rough");
    assert_eq!(
        rows.len(),
        36,
        "three solids, two surfaces, three loads and two speeds"
    );
    let mut full = 0;
    for row in &rows {
        let [area, theory] =
            ["area_fraction", "persson_area_fraction"].map(|name| number(row, name));
        let [friction, of_theory] =
            ["friction_coefficient", "persson_friction_coefficient"].map(|name| number(row, name));
        let bar = number(row, "friction_coefficient_error");
        assert!(bar <= 0.05 * friction, "{row:?}");
        if area > 0.99 {
            full += 1;
            let is_theory =
                (friction / of_theory - 1.0).abs() < 0.02 && (area - theory).abs() < 0.02;
            assert!(is_theory, "{row:?}");
        }
    }
    assert!(full > 5, "{full} in full contact");
    evidence.assert_pictures(&["rough"]);
    let table = evidence.folder.join("rough.csv");
    let whole = fs::read_to_string(&table).expect("a table");
    let most: Vec<&str> = whole.lines().take(31).collect();
    // A row that is there is not computed again, not even one that is wrong.
    let changed = most.join("\n").replace("half-space", "row-before");
    fs::write(&table, changed + "\n").expect("most of the table");
    evidence.again("rough");
    let resumed = fs::read_to_string(&table).expect("a table");
    assert_eq!(
        resumed.replace("row-before", "half-space"),
        whole,
        "the table in two runs"
    );
    assert!(resumed.contains("row-before"), "rows that were there");
}
