//! Gap between a body and the elastomer, on the elements around a contact.

use crate::Grid;
use crate::elements::bounds::Bounds;

/// Margin of the field on each side of the contact, as a fraction of the length of the contact. Chosen; it changes only the extent of the
/// output.
const MARGIN: f64 = 0.25;

/// Gap h + u − d between the height h of a rigid body and the surface of the elastomer, which is displaced by d − u.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct GapField {
    /// The grid of the field: the elements of the contact and a margin around it, or those of a period.
    pub grid: Grid,
    /// Centre of the first element relative to the lowest point of the body, \[m].
    pub origin: [f64; 2],
    /// Gap at the collocation point of each element, \[m], row-major with y fastest.
    ///
    /// In the contact it is 0 within the tolerance of the contact solver, which also limits negative gaps outside. The collocation
    /// points lie up to half an element behind the centres.
    pub gap: Vec<f64>,
}

/// The box of a contact with a margin on each side, within `limits`, up to the first row or column that `has_body` does not cover;
/// `None` if the body does not cover the contact.
pub(crate) fn surroundings(
    contact: &Bounds,
    limits: &Bounds,
    has_body: impl Fn([usize; 2]) -> bool,
) -> Option<Bounds> {
    let is_covered = |part: &Bounds| {
        let mut elements =
            (part.rows()).flat_map(|row| part.columns().map(move |column| [row, column]));
        elements.all(&has_body)
    };
    if !is_covered(contact) {
        return None;
    }
    // Enlarge the box row by row up to the margin, wherever the body covers all added elements.
    let mut grown = *contact;
    for axis in 0..2 {
        let margin = (MARGIN * contact.shape()[axis] as f64).ceil();
        for _ in (0..).take_while(|step| f64::from(*step) < margin) {
            // Add one row or column on each side that the body covers.
            if grown.lower[axis] > limits.lower[axis] {
                let mut added = grown;
                added.upper[axis] = grown.lower[axis];
                added.lower[axis] = grown.lower[axis] - 1;
                if is_covered(&added) {
                    grown.lower[axis] -= 1;
                }
            }
            if grown.upper[axis] < limits.upper[axis] {
                let mut added = grown;
                added.lower[axis] = grown.upper[axis];
                added.upper[axis] = grown.upper[axis] + 1;
                if is_covered(&added) {
                    grown.upper[axis] += 1;
                }
            }
        }
    }
    Some(grown)
}
