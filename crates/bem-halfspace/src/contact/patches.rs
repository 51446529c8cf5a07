//! Quantities derived from a solved contact: gaps, connected patches, and whether it reaches the edge of the grid.
//!
//! Theory: docs/theory/contact.md, "Patches, gaps and the edge of the grid".

use crate::BemError;
use crate::contact::{Contact, ContactProblem, ContactState, check_length};
use crate::transform::convolution::Surroundings;

/// A connected patch: elements in contact that are linked by common edges, on a periodic grid also across its boundary.
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[must_use]
pub struct Patch {
    /// Row-major indices of its elements, increasing.
    pub elements: Vec<usize>,
    /// Area of its elements, without perimeter correction, \[m²].
    pub area: f64,
    /// Normal force on its elements, \[N].
    pub normal_force: f64,
}

impl ContactProblem<'_> {
    /// Gap between the surfaces after a solve, \[m]; one value per element, row-major. It is zero in the contact within the tolerance,
    /// negative or zero where the largest pressure acts, and `+∞` where no contact is possible.
    ///
    /// # Errors
    /// [`BemError::LengthMismatch`] for the state of another grid.
    pub fn gaps(&self, contact: &Contact, state: &ContactState) -> Result<Vec<f64>, BemError> {
        self.check_state(state)?;
        let heights = self.separation.iter().zip(state.displacement());
        Ok(heights
            .map(|(height, displacement)| height + displacement - contact.indentation_depth)
            .collect())
    }

    /// The patches of the contact in a state, in the order of their first elements.
    ///
    /// # Errors
    /// [`BemError::LengthMismatch`] for the state of another grid.
    pub fn patches(&self, state: &ContactState) -> Result<Vec<Patch>, BemError> {
        self.check_state(state)?;
        // Mark all elements in contact, because none is assigned to a patch yet.
        let mut is_unassigned = vec![false; state.pressure().len()];
        for &element in state.contact() {
            is_unassigned[element] = true;
        }
        // Collect one patch after the other, each from its first element that is not assigned yet.
        let mut patches = Vec::new();
        for &element in state.contact() {
            if is_unassigned[element] {
                let elements = self.flood_patch(element, &mut is_unassigned);
                let area = self.convolution.grid().element_area();
                let pressures = elements.iter().map(|&element| state.pressure()[element]);
                patches.push(Patch {
                    area: elements.len() as f64 * area,
                    normal_force: pressures.sum::<f64>() * area,
                    elements,
                });
            }
        }
        Ok(patches)
    }

    /// Flood fill: indices of all unassigned elements in contact that are connected to one, increasing; marks them as assigned.
    fn flood_patch(&self, element: usize, is_unassigned: &mut [bool]) -> Vec<usize> {
        // Search breadth-first: the list is also the queue of elements whose neighbours are still to be visited.
        is_unassigned[element] = false;
        let mut elements = vec![element];
        let mut n_visited = 0;
        while let Some(&element) = elements.get(n_visited) {
            n_visited += 1;
            for neighbour in self.neighbours(element) {
                if is_unassigned[neighbour] {
                    is_unassigned[neighbour] = false;
                    elements.push(neighbour);
                }
            }
        }
        elements.sort_unstable();
        elements
    }

    /// Indices of the elements that share an edge with one, on a periodic grid also across its boundary.
    fn neighbours(&self, element: usize) -> impl Iterator<Item = usize> {
        let shape = self.convolution.grid().shape();
        let indices = [element / shape[1], element % shape[1]];
        let is_periodic = self.convolution.surroundings == Surroundings::Periodic;
        let neighbours_along = move |axis: usize| {
            let (index, n) = (indices[axis], shape[axis]);
            let before = index.checked_sub(1).or(is_periodic.then_some(n - 1));
            let ahead = Some(index + 1).filter(|next| *next < n);
            [before, ahead.or(is_periodic.then_some(0))]
        };
        let along_x = neighbours_along(0).map(|row| row.map(|row| row * shape[1] + indices[1]));
        let along_y =
            neighbours_along(1).map(|column| column.map(|column| indices[0] * shape[1] + column));
        along_x.into_iter().chain(along_y).flatten()
    }

    /// True if an element at the edge of a free grid is in contact.
    pub(super) fn reaches_edge(&self, state: &ContactState) -> bool {
        let [rows, columns] = self.convolution.grid().shape();
        let is_at_edge = |element: &usize| {
            let (row, column) = (element / columns, element % columns);
            row == 0 || row + 1 == rows || column == 0 || column + 1 == columns
        };
        self.convolution.surroundings == Surroundings::Free
            && state.contact().iter().any(is_at_edge)
    }

    /// Checks that state and separation have one value per element of the grid.
    fn check_state(&self, state: &ContactState) -> Result<(), BemError> {
        let n_elements = self.convolution.grid().n_elements();
        check_length("pressure", state.pressure().len(), n_elements)?;
        check_length("separation", self.separation.len(), n_elements)
    }
}
