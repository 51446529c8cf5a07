//! What the measurements of the stationary solver write and say, on the quick cases.

use crate::support::{Evidence, number};

#[test]
fn error_bars_are_compared_with_finer_solutions() {
    let evidence = Evidence::quick("error-bars", "stationary --table error-bars");
    let rows = evidence.rows("error_bars");
    let printed = &evidence.printed;
    assert_eq!(rows.len(), 12, "four bodies, three shapes of elements");
    for row in &rows {
        let number = |column| number(row, column);
        let [friction, reference] = ["friction", "reference_friction"].map(number);
        let [bar, error, deviation] = ["error_bar", "reference_error", "deviation"].map(number);
        let is_deviation = ((friction - reference).abs() - deviation).abs() <= 1e-12;
        assert!(is_deviation && bar > 0.0, "{row:?}");
        let holds = deviation <= bar + error;
        assert_eq!(row["holds"], holds.to_string(), "{row:?}");
        let is_finer = error < number("relative_error_asked") * reference;
        assert!(is_finer, "the reference of {row:?}");
    }
    let held = rows.iter().filter(|row| row["holds"] == "true").count();
    assert_eq!(held, 12, "of twelve bars hold: {rows:?}");
    let said = format!("{held} of 12 error bars hold");
    assert!(printed.contains(&said), "expected '{said}' in {printed}");
    let other = evidence.folder.join("growth.csv");
    assert!(!other.exists(), "only the table asked for is made");
}

#[test]
fn growth_is_measured_with_its_error() {
    let evidence = Evidence::quick("growth", "stationary --table growth");
    let growth = evidence.rows("growth");
    let printed = &evidence.printed;
    let elements = growth.iter().map(|row| number(row, "elements_in_contact"));
    let elements: Vec<f64> = elements.collect();
    // The area of the contact is known to one or two per cent on the grid that the spacings follow from.
    let close = |got: f64, asked: f64| (got / asked - 1.0).abs() < 0.06;
    let are_right = elements.len() == 2 && close(elements[0], 1e3) && close(elements[1], 4e3);
    assert!(are_right, "about 1000 and 4000 elements, got {elements:?}");
    for row in &growth {
        // One grid of a thousand elements is within a few tenths of a per cent.
        assert!(number(row, "relative_deviation").abs() < 5e-3, "{row:?}");
        // The number in contact is that of the area, which the elements that touch exceed along its edge, and with the row in the mirror.
        let in_contact = number(row, "elements_in_contact");
        let half = in_contact / number(row, "unknowns");
        let allowed = 5.0 / in_contact.sqrt();
        assert!((half - 2.0).abs() < allowed, "mirror symmetry: {row:?}");
    }
    let said = "exponent of growth";
    assert!(printed.contains(said), "expected '{said}' in {printed}");
}
