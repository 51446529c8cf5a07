//! The patches of a stationary contact, and the check that each is resolved by enough elements.
//!
//! Theory: docs/theory/stationary-half-space.md, "Scatter, order, error bar", "Elements in a patch".

use crate::BemError;
use crate::contact::patches::connected_sets;
use crate::elements::bounds::Bounds;
use crate::error::check_contact_elements;
use crate::estimate::plan::NEGLIGIBLE_FRACTION;

/// Smallest number of elements across the sliding direction in the widest row of a patch. Chosen: on one to three of them,
/// several grids may agree by chance. It has a case of `evidence tuning`.
pub(super) const MIN_ELEMENTS_ACROSS: usize = 4;

/// A loaded element as ([row, column], load).
type Loaded = ([usize; 2], f64);

/// Refuses a contact with a patch that carries load on too few elements along x or across it.
///
/// # Errors
/// [`BemError::GridTooCoarse`].
pub(super) fn check_patches(loaded: &[Loaded], bounds: &Bounds) -> Result<(), BemError> {
    let total: f64 = loaded.iter().map(|(_, load)| load).sum();
    let mut loads = vec![0.0; bounds.n_elements()];
    for (element, load) in loaded {
        loads[bounds.index_of(*element)] = *load;
    }
    // Patches are connected by edges or corners.
    let [rows, columns] = bounds.shape();
    let neighbours = |element: usize| {
        let around = |index: usize, n: usize| index.saturating_sub(1)..(index + 2).min(n);
        let across = around(element % columns, columns);
        around(element / columns, rows)
            .flat_map(move |row| across.clone().map(move |column| row * columns + column))
    };
    let in_box = loaded.iter().map(|(element, _)| bounds.index_of(*element));
    let elements = in_box.filter(|element| loads[*element] > 0.0);
    for patch in connected_sets(elements, loads.len(), neighbours) {
        // Skip patches with a negligible load.
        let load: f64 = patch.iter().map(|element| loads[*element]).sum();
        if load < NEGLIGIBLE_FRACTION * total {
            continue;
        }
        // Count the elements of the patch in each row. It needs enough rows, and enough elements in its widest row.
        let mut per_row = vec![0_usize; rows];
        for element in patch {
            per_row[element / columns] += 1;
        }
        check_contact_elements(per_row.iter().filter(|count| **count > 0).count())?;
        let elements = per_row.into_iter().max().unwrap_or(0);
        if elements < MIN_ELEMENTS_ACROSS {
            let needed = MIN_ELEMENTS_ACROSS;
            return Err(BemError::GridTooCoarse { elements, needed });
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The error of a contact that is drawn with a load in each `#`, rows along x.
    fn refused(drawn: &[&str]) -> Option<usize> {
        let rows = drawn.iter().enumerate();
        let loaded: Vec<Loaded> = rows
            .flat_map(|(row, line)| {
                let columns = line.bytes().enumerate().filter(|(_, mark)| *mark != b'.');
                columns.map(move |(column, mark)| {
                    ([row, column], if mark == b'#' { 1.0 } else { 1e-4 })
                })
            })
            .collect();
        let bounds =
            Bounds::enclosing(loaded.iter().map(|(element, _)| *element)).expect("a contact");
        match check_patches(&loaded, &bounds) {
            Ok(()) => None,
            Err(BemError::GridTooCoarse { elements, needed }) => {
                assert!(elements < needed, "{elements} of {needed}");
                Some(elements)
            }
            Err(error) => panic!("{error}"),
        }
    }

    #[test]
    fn every_patch_that_carries_load_needs_elements_along_and_across() {
        let wide = ["####", "####", "####"];
        assert_eq!(refused(&wide), None);
        assert_eq!(refused(&wide[..2]), Some(2));
        assert_eq!(refused(&["###", "###", "###", "###"]), Some(3));
        assert_eq!(
            refused(&["##...", ".##..", "..##.", "...##"]),
            Some(2),
            "diagonal"
        );
        let beside = ["####..", "####..", "####.#"];
        assert_eq!(refused(&beside), Some(1), "a second patch");
        let hardly_loaded = ["####..", "####..", "####.+"];
        assert_eq!(refused(&hardly_loaded), None);
        // A crescent is as wide as its horns are apart.
        let crescent = ["#....#", "##..##", ".####."];
        assert_eq!(refused(&crescent), None);
    }
}
