//! Error bars on random scenes of a fixed seed.

use std::collections::{BTreeMap, HashMap};

use crate::support::{argument, folder, text, xtask};

type Row = HashMap<String, String>;

fn number(row: &Row, column: &str) -> f64 {
    let cell = &row[column];
    let value = cell.parse::<f64>().ok().filter(|value| value.is_finite());
    value.unwrap_or_else(|| panic!("{column} of {row:?}"))
}

/// The part of 90 % is asked of each method with ten answers or more, and of all together.
#[test]
fn nine_of_ten_error_bars_hold_on_random_scenes() {
    let folder = folder("calibration");
    let output = xtask(&[
        "evidence",
        "calibration",
        "--quick",
        "--out",
        argument(&folder),
    ]);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    let mut reader = csv::Reader::from_path(folder.join("calibration.csv")).expect("a table");
    let rows: Vec<Row> = reader
        .deserialize()
        .collect::<Result<_, _>>()
        .expect("rows of the table");
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
    let run = |seed: &str, scenes: &str, name: &str| {
        let folder = folder(name);
        let output = xtask(&[
            "evidence",
            "calibration",
            "--quick",
            "--scenes",
            scenes,
            "--seed",
            seed,
            "--out",
            argument(&folder),
        ]);
        (output, folder.join("calibration.csv"))
    };
    let tables = [("7", "few"), ("7", "few-again"), ("8", "few-others")].map(|(seed, name)| {
        let (output, table) = run(seed, "4", name);
        assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
        std::fs::read_to_string(table).expect("a table")
    });
    assert_eq!(tables[0], tables[1], "the same seed");
    assert_ne!(tables[0], tables[2], "another seed");
    let (refused, _) = run("7", "0", "none");
    let message = text(&refused.stderr);
    assert_eq!(refused.status.code(), Some(2), "{message}");
    assert!(message.contains("from 1 to 100000"), "{message}");
}
