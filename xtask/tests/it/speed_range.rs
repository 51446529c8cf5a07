//! What the three-element solid does over the range of speeds, on the quick cases.

use friction_analytic::scaling_factor;

use crate::support::{Evidence, Row, number};

/// One quick run for all claims.
#[test]
fn quick_evidence_over_the_speeds_is_as_it_should_be() {
    let evidence = Evidence::quick("speed-range", "speed-range");
    the_ratio_goes_from_one_half_over_the_viscous_plateau_to_one(&evidence);
    the_viscous_law_holds_between_its_borders(&evidence);
}

/// The rows of one profile, by rising speed.
fn curve(evidence: &Evidence, exponent: f64) -> Vec<Row> {
    let rows = evidence.rows("friction_over_speed").into_iter();
    let rows: Vec<Row> = rows
        .filter(|row| number(row, "exponent").total_cmp(&exponent).is_eq())
        .collect();
    assert_eq!(rows.len(), 3, "one stiffness ratio, ten decades of speed");
    let rising = |one: &Row, other: &Row| number(one, "speed") < number(other, "speed");
    assert!(rows.is_sorted_by(rising), "speeds rise");
    rows
}

/// Exact ends (FRI-05) and the plateau. A decade and a half beyond each end of the plateau, its neighbours still move
/// the ratio by some per cent of its change; three decades beyond, by some thousandths.
fn the_ratio_goes_from_one_half_over_the_viscous_plateau_to_one(evidence: &Evidence) {
    for exponent in [1.0, 2.0] {
        let rows = curve(evidence, exponent);
        let plateau = scaling_factor(exponent).expect("a factor").value;
        for (row, expected, allowed) in [
            (&rows[0], 0.5, 2e-3),
            (&rows[1], plateau, 3e-2),
            (&rows[2], 1.0, 2e-3),
        ] {
            let bar = number(row, "ratio_error");
            let what = format!("p = {exponent}, vτ/a = {}", row["speed"]);
            let ratio = number(row, "ratio");
            assert!(bar <= 2.01e-2 * ratio, "{what}: error bar {bar}");
            let off = (ratio - expected).abs();
            assert!(off <= bar + allowed, "{what}: {ratio} and not {expected}");
        }
    }
}

/// The law predicts too much friction on the line, at every speed, and is right within ten per cent between the borders.
fn the_viscous_law_holds_between_its_borders(evidence: &Evidence) {
    let map = evidence.rows("validity");
    let borders = evidence.rows("validity_border");
    assert_eq!([map.len(), borders.len()], [16, 8], "sizes of the tables");
    for row in &map {
        let [friction, predicted] = ["line", "predicted_line"].map(|column| number(row, column));
        assert!(predicted >= friction * (1.0 - 1e-6), "{row:?}");
        let key = |row: &Row| ["exponent", "stiffness_ratio"].map(|column| row[column].clone());
        let mut borders = borders.iter().filter(|border| border["model"] == "line");
        let border = borders.find(|border| key(border) == key(row));
        let border = border.expect("a border for each stiffness ratio");
        let right = predicted <= 1.1 * friction;
        let between = !border["lowest_speed"].is_empty()
            && (number(border, "lowest_speed")..=number(border, "highest_speed"))
                .contains(&number(row, "speed"));
        assert_eq!(right, between, "{row:?} and {border:?}");
    }
    evidence.assert_pictures(&["friction_over_speed", "ratio_over_speed", "validity"]);
    let printed = &evidence.printed;
    assert!(printed.contains("lowest speed"), "{printed}");
}
