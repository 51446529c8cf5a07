//! Quantities derived from a solved contact: gaps, connected patches, and whether it reaches the edge of the grid.
//!
//! Theory: docs/theory/contact.md, "Patches, gaps and the edge of the grid".

use crate::BemError;
use crate::contact::{Contact, ContactProblem, ContactState};
use crate::error::check_length;
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
        let n_elements = state.pressure().len();
        let neighbours = |element| self.neighbours(element);
        let sets = connected_sets(state.contact().iter().copied(), n_elements, neighbours);
        let patch = |mut elements: Vec<usize>| {
            elements.sort_unstable();
            let area = self.convolution.grid().element_area();
            let pressures = elements.iter().map(|&element| state.pressure()[element]);
            Patch {
                area: elements.len() as f64 * area,
                normal_force: pressures.sum::<f64>() * area,
                elements,
            }
        };
        Ok(sets.into_iter().map(patch).collect())
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

/// The sets of some of `n_elements` elements that are connected by `neighbours`, in the order of their first elements (flood fill).
pub(crate) fn connected_sets<N: IntoIterator<Item = usize>>(
    elements: impl Iterator<Item = usize> + Clone,
    n_elements: usize,
    neighbours: impl Fn(usize) -> N,
) -> Vec<Vec<usize>> {
    let mut is_unassigned = vec![false; n_elements];
    elements
        .clone()
        .for_each(|element| is_unassigned[element] = true);
    let mut sets = Vec::new();
    for first in elements {
        if !std::mem::take(&mut is_unassigned[first]) {
            continue;
        }
        // Search breadth-first: the set is also the queue of elements whose neighbours are still to be visited.
        let mut set = vec![first];
        let mut n_visited = 0;
        while let Some(&element) = set.get(n_visited) {
            n_visited += 1;
            let linked = neighbours(element).into_iter();
            set.extend(linked.filter(|other| std::mem::take(&mut is_unassigned[*other])));
        }
        sets.push(set);
    }
    sets
}
