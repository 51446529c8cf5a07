//! Heights from a file of NumPy are those of the CSV file with the same numbers, to the last bit.

use std::fs;
use std::path::Path;

use serde_json::Value;

use crate::support::{argument, example, folder, npy, run_json};

/// The committed map, row by row, and its number of rows.
fn heights() -> (Vec<f64>, usize) {
    let text = fs::read_to_string(example("tread.csv")).expect("the map");
    let number = |cell: &str| cell.trim().parse::<f64>().expect("a height");
    let row = |line: &str| line.split(',').map(number).collect();
    let rows: Vec<Vec<f64>> = text.lines().map(row).collect();
    (rows.concat(), rows.len())
}

/// The answer of the committed scene with another map, but for the time it took.
fn answer(folder: &Path, map: &str) -> Value {
    let scene = fs::read_to_string(example("tread.toml")).expect("the scene");
    let scene = scene
        .replace("tread.csv", map)
        .replace("relative_error = 2e-2", "elements = 12");
    let path = folder.join("scene.toml");
    fs::write(&path, scene).expect("a scene");
    let mut answer = run_json(&[argument(&path)]);
    answer["seconds"] = Value::Null;
    answer
}

#[test]
fn double_precision_has_the_answer_of_the_text() {
    let folder = folder("numpy-doubles");
    let (heights, rows) = heights();
    let columns = heights.len() / rows;
    fs::copy(example("tread.csv"), folder.join("map.csv")).expect("a map");
    let header = |order: &str| {
        format!("{{'descr': '<f8', 'fortran_order': {order}, 'shape': ({rows}, {columns}), }}")
    };
    let bytes = |heights: &[f64]| {
        heights
            .iter()
            .flat_map(|height| height.to_le_bytes())
            .collect()
    };
    let by_row: Vec<u8> = bytes(&heights);
    let column = |column: usize| heights.iter().skip(column).step_by(columns).copied();
    let by_column: Vec<u8> = bytes(&(0..columns).flat_map(column).collect::<Vec<f64>>());
    let expected = answer(&folder, "map.csv");
    for (order, numbers) in [("False", by_row), ("True", by_column)] {
        fs::write(folder.join("map.npy"), npy(&header(order), &numbers)).expect("a map");
        assert_eq!(
            answer(&folder, "map.npy"),
            expected,
            "Fortran order: {order}"
        );
    }
}

#[test]
fn single_precision_has_the_answer_of_its_numbers_as_text() {
    let folder = folder("numpy-singles");
    let (heights, rows) = heights();
    let columns = heights.len() / rows;
    #[expect(
        clippy::cast_possible_truncation,
        reason = "rounding to single precision is meant"
    )]
    let singles: Vec<f32> = heights.iter().map(|height| *height as f32).collect();
    let lines = singles.chunks(columns).map(|row| {
        let cells: Vec<String> = row
            .iter()
            .map(|height| f64::from(*height).to_string())
            .collect();
        cells.join(",")
    });
    let text = lines.collect::<Vec<_>>().join("\n");
    fs::write(folder.join("map.csv"), text).expect("a map");
    let header =
        format!("{{'descr': '<f4', 'fortran_order': False, 'shape': ({rows}, {columns}), }}");
    let numbers: Vec<u8> = singles
        .iter()
        .flat_map(|height| height.to_le_bytes())
        .collect();
    fs::write(folder.join("map.npy"), npy(&header, &numbers)).expect("a map");
    assert_eq!(
        answer(&folder, "map.npy"),
        answer(&folder, "map.csv"),
        "single precision"
    );
}

/// The pressure of an answer as the heights of a body: whatever is written can be read.
#[test]
fn what_is_written_for_numpy_is_a_height_map() {
    let folder = folder("numpy-written");
    let out = folder.join("out");
    run_json(&[argument(&example("tread.toml")), "--out", argument(&out)]);
    let file = out.join("pressure.npy");
    let contents = fs::read(&file).expect("a pressure");
    let checked =
        viscofriction_cli::check_input(viscofriction_cli::InputKind::HeightMap, &file, &contents);
    assert_eq!(checked, Ok(()), "{}", file.display());
}
