//! Answers against closed forms and from method to method.

use std::fs;

use viscofriction::Estimate;

use crate::support::{Folder, assert_agree, estimate, example, scene, table};

/// Bilinear heights lie at most c p²/2 above the paraboloid c r²: relative to the height at the contact radius a, and with
/// it friction, force and depth, by less than (p/a)², which is 1e-2 for a = 4 mm.
const BILINEAR: f64 = 1e-2;

#[test]
fn answers_are_those_of_closed_forms_and_of_other_methods() {
    let folder = Folder::new("same-answers");
    folder.write("map.csv", map());
    fs::copy(example("profile.csv"), folder.path("profile.csv")).expect("a profile");
    for [parts, other, required] in table("answers") {
        let result = folder.answer(scene(&parts));
        let method = result["method"].as_str().expect("a method");
        let named = format!("method = \"{method}\"");
        let is_asked = parts.contains(&named) || !parts.contains("method");
        assert!(is_asked, "{parts}: {result}");
        let is_line = parts.contains("\"mdr-") || parts.contains("\"line\"");
        let model = ["half-space", "line"][usize::from(is_line)];
        assert_eq!(result["model"], model, "{parts}: {result}");
        let has_no_depth = parts.contains("cylinder") || parts.contains("springpot");
        let lacks = |field: &str| result[field].is_null();
        let is_area_known = !is_line || lacks("contact_area");
        let is_depth_known = !has_no_depth || lacks("indentation_depth");
        assert!(is_area_known && is_depth_known, "{parts}: {result}");
        let other = (!other.is_empty()).then(|| folder.answer(scene(&other)));
        for required in required.split(", ") {
            let (field, numbers) = required.split_once(' ').expect("a quantity");
            let number = |word: &str| word.parse().expect("a number");
            let mut numbers = numbers.split(' ').map(number);
            let expected = other.as_ref().map(|other| estimate(other, field));
            let exact = || Estimate::exact(numbers.next().expect("a value"));
            let mut expected = expected.unwrap_or_else(exact);
            if parts.starts_with("map") {
                expected = expected.widened(BILINEAR * expected.value);
            }
            let part = numbers.next().expect("a part");
            let what = format!("{field} of {parts}");
            assert_agree(what, estimate(&result, field), expected, part);
        }
    }
}

/// Heights of a paraboloid on a grid of 0.4 mm, up to 11 mm from the tip, which lies off the middle.
fn map() -> String {
    let line = |row: i32| {
        let height = |column: i32| {
            let [x, y] = [column - 30, row - 28].map(|index| 4e-4 * f64::from(index));
            format!("{:?}", 0.3 - 50.0 * (x * x + y * y))
        };
        (0..59).map(height).collect::<Vec<_>>().join(",")
    };
    (0..57).map(line).collect::<Vec<_>>().join("\n")
}
