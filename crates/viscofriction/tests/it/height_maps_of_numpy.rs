//! Heights from a file of NumPy are those of the CSV file with the same numbers, to the last bit.

use std::fs;

use crate::support::{Folder, example, npy};

/// The answers of the committed scene with the same map as text and as an array are the same.
fn assert_same(heights: &[Vec<f64>], kind: &str, order: &str, numbers: &[u8]) {
    let elements = ("relative_error = 2e-2", "elements = 12");
    let line = |row: &Vec<f64>| row.iter().map(f64::to_string).collect::<Vec<_>>().join(",");
    let lines: Vec<String> = heights.iter().map(line).collect();
    let shape = (heights.len(), heights[0].len());
    let header = format!("{{'descr': '{kind}', 'fortran_order': {order}, 'shape': {shape:?}, }}");
    let answers = ["map.csv", "map.npy"].map(|map| {
        let folder = Folder::with("numpy", "tread.toml", &[("tread.csv", map), elements]);
        folder.write("map.csv", lines.join("\n"));
        folder.write("map.npy", npy(&header, numbers));
        folder.json("scene.toml")
    });
    assert_eq!(answers[0], answers[1], "{kind}, Fortran order: {order}");
}

#[test]
#[expect(
    clippy::cast_possible_truncation,
    reason = "rounding to single precision is meant"
)]
fn arrays_of_either_precision_and_order_have_the_answer_of_the_text() {
    let text = fs::read_to_string(example("tread.csv")).expect("the map");
    let number = |cell: &str| cell.trim().parse().expect("a height");
    let row = |line: &str| line.split(',').map(number).collect();
    let mut heights: Vec<Vec<f64>> = text.lines().map(row).collect();
    let by_row: Vec<f64> = heights.concat();
    let column = |column: usize| heights.iter().map(move |row| row[column]);
    let by_column: Vec<f64> = (0..heights[0].len()).flat_map(column).collect();
    for (order, numbers) in [("False", &by_row), ("True", &by_column)] {
        let bytes: Vec<[u8; 8]> = numbers.iter().map(|height| height.to_le_bytes()).collect();
        assert_same(&heights, "<f8", order, bytes.as_flattened());
    }
    for height in heights.iter_mut().flatten() {
        *height = f64::from(*height as f32);
    }
    let single = |height: &f64| (*height as f32).to_le_bytes();
    let singles: Vec<[u8; 4]> = by_column.iter().map(single).collect();
    assert_same(&heights, "<f4", "True", singles.as_flattened());
}
