//! Heights from a file of NumPy are those of the CSV file with the same numbers, to the last bit.

use std::fs;

use serde_json::Value;
use viscofriction_cli::{InputKind, check_input};

use crate::support::{Folder, example, npy};

/// The committed map, row by row.
fn heights() -> Vec<Vec<f64>> {
    let text = fs::read_to_string(example("tread.csv")).expect("the map");
    let number = |cell: &str| cell.trim().parse().expect("a height");
    text.lines()
        .map(|line| line.split(',').map(number).collect())
        .collect()
}

/// The answers of the committed scene with the same map as text and as an array are the same, but for the time they took.
fn assert_same(heights: &[Vec<f64>], kind: &str, order: &str, numbers: &[u8]) {
    let elements = ("relative_error = 2e-2", "elements = 12");
    let answers = ["map.csv", "map.npy"].map(|map| {
        let folder = Folder::with("numpy", "tread.toml", &[("tread.csv", map), elements]);
        let line = |row: &Vec<f64>| row.iter().map(f64::to_string).collect::<Vec<_>>().join(",");
        folder.write(
            "map.csv",
            heights.iter().map(line).collect::<Vec<_>>().join("\n"),
        );
        let shape = (heights.len(), heights[0].len());
        let header =
            format!("{{'descr': '{kind}', 'fortran_order': {order}, 'shape': {shape:?}, }}");
        folder.write("map.npy", npy(&header, numbers));
        let mut answer = folder.json("scene.toml");
        answer["seconds"] = Value::Null;
        answer
    });
    assert_eq!(answers[0], answers[1], "{kind}, Fortran order: {order}");
}

#[test]
fn arrays_of_either_precision_and_order_have_the_answer_of_the_text() {
    let mut heights = heights();
    let by_row: Vec<u8> = heights
        .iter()
        .flatten()
        .flat_map(|height| height.to_le_bytes())
        .collect();
    assert_same(&heights, "<f8", "False", &by_row);
    let column = |column: usize| {
        heights
            .iter()
            .flat_map(move |row| row[column].to_le_bytes())
    };
    let by_column: Vec<u8> = (0..heights[0].len()).flat_map(column).collect();
    assert_same(&heights, "<f8", "True", &by_column);
    let mut singles = Vec::new();
    for height in heights.iter_mut().flatten() {
        #[expect(
            clippy::cast_possible_truncation,
            reason = "rounding to single precision is meant"
        )]
        let single = *height as f32;
        *height = f64::from(single);
        singles.extend(single.to_le_bytes());
    }
    assert_same(&heights, "<f4", "False", &singles);
}

/// The pressure of an answer as the heights of a body: whatever is written can be read.
#[test]
fn what_is_written_for_numpy_is_a_height_map() {
    let folder = Folder::new("numpy-written");
    folder.json("IN/tread.toml --out .");
    let file = folder.path("pressure.npy");
    let contents = fs::read(&file).expect("a pressure");
    let checked = check_input(InputKind::HeightMap, &file, &contents);
    assert_eq!(checked, Ok(()), "{}", file.display());
}
