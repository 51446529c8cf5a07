//! Error bars on random scenes of a fixed seed.

use std::collections::BTreeMap;

use crate::support::{Evidence, number};

/// Whether a fraction `part` of all bars may hold if `held` of a sample of `all` do: that share is at most two
/// standard deviations lower.
fn may_be(part: f64, [held, all]: [usize; 2]) -> bool {
    let scatter = (part * (1.0 - part) * all as f64).sqrt();
    held as f64 >= part * all as f64 - 2.0 * scatter
}

/// Without the errors of the references, of the answers whose references are sharp: 95 % of each method, by elements or to
/// an error, with nine of them or more, and 99 % of all together.
#[test]
fn error_bars_hold_on_random_scenes() {
    let evidence = Evidence::quick("calibration", "calibration --scenes 54 --seed 23");
    let rows = evidence.rows("calibration");
    let mut methods: BTreeMap<[&str; 2], [usize; 2]> = BTreeMap::new();
    for row in &rows {
        let [deviation, bar, reference] =
            ["deviation", "error_bar", "reference_error"].map(|column| number(row, column));
        let is_sharp = usize::from(reference <= bar / 3.0);
        let method = row["method"].split(", ").next().unwrap_or_default();
        let counts = methods.entry([method, &*row["asked_kind"]]);
        let [held, all] = counts.or_default();
        *held += is_sharp * usize::from(deviation <= bar);
        *all += is_sharp;
    }
    let total: [usize; 2] = [0, 1].map(|part| methods.values().map(|counts| counts[part]).sum());
    let large: Vec<_> = methods.iter().filter(|(_, [_, all])| *all >= 9).collect();
    for (method, [held, all]) in &large {
        assert!(
            may_be(0.95, [*held, *all]),
            "{method:?}: {held} of {all} hold"
        );
    }
    let [held, all] = total;
    assert!(may_be(0.99, total), "{held} of {all} hold: {methods:?}");
    assert!(all >= 85 && large.len() >= 4, "too few: {methods:?}");
}
