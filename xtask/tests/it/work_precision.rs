//! What the quick measurement of error against run time writes and says.

use crate::support::{Evidence, Row, number};

/// One quick run for all claims.
#[test]
fn quick_evidence_of_error_against_time_is_as_it_should_be() {
    let evidence = Evidence::quick("work-precision", "work-precision");
    every_method_answers_its_scenes_with_an_error_and_a_time(&evidence);
    fitted_orders_are_positive_and_those_of_smooth_errors_are_known(&evidence);
    pictures_are_drawn_and_the_table_is_printed(&evidence);
}

fn key(row: &Row) -> [&str; 3] {
    ["scene", "model", "method"].map(|column| row[column].as_str())
}

/// Line, half space, both without sliding, and contacts of one instant.
const SERIES: [[&str; 3]; 11] = [
    ["paraboloid", "line", "analytic"],
    ["paraboloid", "line", "mdr-steady"],
    ["paraboloid", "line", "mdr-transient"],
    ["paraboloid", "half-space", "analytic"],
    ["paraboloid", "half-space", "bem-steady"],
    ["paraboloid", "half-space", "bem-steady, elements"],
    ["paraboloid", "half-space", "bem-transient"],
    ["indentation", "half-space", "analytic"],
    ["indentation", "half-space", "bem-transient"],
    ["Hertz", "half-space", "bem contact"],
    ["rough surface", "half-space", "bem contact"],
];

fn every_method_answers_its_scenes_with_an_error_and_a_time(evidence: &Evidence) {
    let rows = evidence.rows("work_precision");
    let series = rows.chunk_by(|one, other| key(one) == key(other));
    let found: Vec<[&str; 3]> = series.map(|rows| key(&rows[0])).collect();
    assert_eq!(found, SERIES, "series of the quick measurement");
    for row in &rows {
        for column in ["error", "reference_error", "processor_seconds"] {
            assert!(number(row, column) >= 0.0, "{column} of {row:?}");
        }
        assert!(number(row, "seconds") > 0.0, "no time passed: {row:?}");
        assert!(number(row, "error") < 0.05, "a coarse answer: {row:?}");
    }
    let printed = &evidence.printed;
    assert!(!printed.contains("refused"), "refused: {printed}");
}

/// The chain of elements and the depth of a smooth contact are of second order; on the grids of the half space the
/// outline of the contact makes orders scatter, by about their standard errors.
fn fitted_orders_are_positive_and_those_of_smooth_errors_are_known(evidence: &Evidence) {
    let fits = evidence.rows("work_precision_orders");
    let fitted: Vec<&Row> = fits.iter().filter(|fit| !fit["order"].is_empty()).collect();
    assert!(fitted.len() >= 5, "orders of {fits:?}");
    for fit in fitted {
        let (order, error) = (number(fit, "order"), number(fit, "order_error"));
        let [low, high] = match key(fit) {
            [_, _, "mdr-transient"] => [1.9, 2.1],
            ["Hertz" | "indentation", ..] => [1.7, 2.4],
            ["rough surface", ..] => [0.8, 1.2],
            _ => [0.8, 3.2],
        };
        let is_known = order + 2.0 * error >= low && order - 2.0 * error <= high;
        assert!(is_known, "order between {low} and {high}: {fit:?}");
    }
}

fn pictures_are_drawn_and_the_table_is_printed(evidence: &Evidence) {
    let Evidence { printed, .. } = evidence;
    evidence.assert_pictures(&["work_precision_sliding", "work_precision_at_rest"]);
    for [scene, _, method] in SERIES {
        let mut lines = printed.lines();
        let is_there = lines.any(|line| line.contains(scene) && line.contains(method));
        assert!(is_there, "{scene}, {method} is missing in {printed}");
    }
}
