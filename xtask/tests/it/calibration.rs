//! Error bars on random scenes of a fixed seed.

use std::collections::BTreeMap;

use crate::support::{Evidence, number};

/// The part of 90 % is asked of each method with ten answers or more, and of all together.
#[test]
fn nine_of_ten_error_bars_hold_on_random_scenes() {
    let rows = Evidence::quick("calibration", "calibration").rows("calibration");
    let mut methods: BTreeMap<&str, [usize; 2]> = BTreeMap::new();
    for row in &rows {
        let [deviation, bar, reference] =
            ["deviation", "error_bar", "reference_error"].map(|column| number(row, column));
        let [held, all] = methods.entry(&row["method"]).or_default();
        *held += usize::from(deviation <= bar + reference);
        *all += 1;
    }
    let total: [usize; 2] = [0, 1].map(|part| methods.values().map(|counts| counts[part]).sum());
    let large = methods.iter().filter(|(_, [_, all])| *all >= 10);
    for (method, [held, all]) in large.chain([(&"all", &total)]) {
        assert!(10 * held >= 9 * all, "{method}: {held} of {all} hold");
    }
    let are_enough = total[1] >= 100 && methods.len() >= 10;
    assert!(are_enough, "too few answers: {methods:?}");
}

#[test]
fn scenes_follow_from_the_seed() {
    let tables = [("7", "few"), ("7", "few-again"), ("8", "few-others")].map(|(seed, name)| {
        let line = format!("calibration --scenes 4 --seed {seed}");
        let folder = Evidence::quick(name, &line).folder;
        std::fs::read_to_string(folder.join("calibration.csv")).expect("a table")
    });
    assert_eq!(tables[0], tables[1], "the same seed");
    assert_ne!(tables[0], tables[2], "another seed");
}
