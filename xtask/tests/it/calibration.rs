//! Error bars on random scenes of a fixed seed.

use std::collections::BTreeMap;

use crate::support::{Evidence, number, text, xtask};

/// The part of 90 % is asked of each method with ten answers or more, and of all together.
#[test]
fn nine_of_ten_error_bars_hold_on_random_scenes() {
    let rows = Evidence::quick("calibration", &["calibration"]).rows("calibration");
    let mut methods: BTreeMap<&str, [usize; 2]> = BTreeMap::new();
    for row in &rows {
        let [deviation, bar, reference] =
            ["deviation", "error_bar", "reference_error"].map(|column| number(row, column));
        let [held, all] = methods.entry(&row["method"]).or_default();
        *held += usize::from(deviation <= bar + reference);
        *all += 1;
    }
    let total = methods
        .values()
        .fold([0, 0], |sum, part| [sum[0] + part[0], sum[1] + part[1]]);
    let large = methods.iter().filter(|(_, [_, all])| *all >= 10);
    for (method, [held, all]) in large.chain([(&"all", &total)]) {
        assert!(10 * held >= 9 * all, "{method}: {held} of {all} hold");
    }
    assert!(
        total[1] >= 100 && methods.len() >= 10,
        "too few answers: {methods:?}"
    );
}

#[test]
fn scenes_follow_from_the_seed_and_unknown_numbers_of_them_are_wrong_input() {
    let table = |seed: &str, name: &str| {
        let arguments = ["calibration", "--scenes", "4", "--seed", seed];
        let folder = Evidence::quick(name, &arguments).folder;
        std::fs::read_to_string(folder.join("calibration.csv")).expect("a table")
    };
    let tables = [("7", "few"), ("7", "few-again"), ("8", "few-others")];
    let tables = tables.map(|(seed, name)| table(seed, name));
    assert_eq!(tables[0], tables[1], "the same seed");
    assert_ne!(tables[0], tables[2], "another seed");
    let refused = xtask(&["evidence", "calibration", "--scenes", "0"]);
    let message = text(&refused.stderr);
    assert_eq!(refused.status.code(), Some(2), "{message}");
    assert!(message.contains("from 1 to 100000"), "{message}");
}
