//! Error bars and intervals on a few random cases of fixed seeds; commands fail where too few hold.

use crate::support::{Evidence, Row, number};

/// Root mean square of a column, of deviations over their standard errors. The cases of a quick run are the same every time, and so
/// few that only this tells standard errors that are too small by a factor of three.
fn root_mean_square(rows: &[Row], column: &str) -> f64 {
    let squares = rows.iter().map(|row| number(row, column).powi(2));
    (squares.sum::<f64>() / rows.len() as f64).sqrt()
}

/// A derivative that is off by 1 % makes the command fail.
#[test]
fn derivatives_of_a_few_random_scenes_are_within_their_bars() {
    let rows = Evidence::quick("derivatives", "derivatives").rows("derivatives");
    assert!(rows.len() >= 20, "derivatives: {rows:?}");
}

#[test]
fn means_of_a_few_random_scenes_are_within_their_standard_errors() {
    let rows = Evidence::quick("ensembles", "ensembles").rows("ensembles");
    assert!(rows.len() >= 4, "means: {rows:?}");
    let deviation = root_mean_square(&rows, "relative_deviation");
    assert!(
        (0.05..0.6).contains(&deviation),
        "0.2 standard errors, got {deviation}"
    );
}

/// A share that is off by more than chance, or an answer beyond the window without a warning, makes the command fail.
#[test]
fn the_bands_of_a_few_fitted_materials_hold() {
    let rows = Evidence::quick("material", "material").rows("material");
    assert_eq!(rows.len(), 6, "fitted materials");
    let deviation = root_mean_square(&rows, "deviation");
    assert!(
        (0.1..0.9).contains(&deviation),
        "0.4 standard errors, got {deviation}"
    );
}

/// 200 experiments hold in 95 % ± 1.5 %; four of these errors are as likely as 6 in 100 000.
#[test]
fn intervals_from_friction_hold() {
    for row in Evidence::quick("friction-fit", "friction-fit").rows("friction_fit") {
        let held = number(&row, "holds_percent");
        assert!((89.0..=100.0).contains(&held), "{row:?}");
        assert!(number(&row, "open_percent") < 5.0, "{row:?}");
        assert_eq!(row["failed"], "0", "{row:?}");
    }
}
