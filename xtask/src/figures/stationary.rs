//! Outline and pressure of the stationary contact for four power profiles.

use anyhow::Result;
use bem_halfspace::steady::SteadySliding;
use serde::Serialize;

use crate::figures::{Part, contact_maps};
use crate::scene::Scene;
use crate::tasks::in_parallel;

/// Name of table and picture.
pub(super) const NAME: &str = "stationary_contact";

/// A power profile c r^p.
struct Profile {
    /// Exponent p.
    exponent: f64,
    /// Elements along the contact length of the one-dimensional model.
    elements: usize,
}

/// The profile of an exponent, with a number of elements.
const fn profile(exponent: f64, elements: usize) -> Profile {
    Profile { exponent, elements }
}

/// The profiles with their exponents and numbers of elements: the larger the exponent, the narrower the contact and the more
/// elements it takes.
const PROFILES: [Profile; 4] = [
    profile(1.0, 100),
    profile(2.0, 100),
    profile(4.0, 150),
    profile(16.0, 300),
];
/// Shift of the grid, in elements along each axis. Chosen: the lowest point lies at a corner of four elements, so that their
/// edges are at round multiples of the contact length.
const PHASE: [f64; 2] = [0.5, 0.5];
/// Largest ratio of the residual in contact to F_N/(4ηv), the depth in the one-dimensional model under the normal force F_N, with
/// the viscosity η and the speed v. Chosen far below the discretisation error.
const TOLERANCE: f64 = 1e-9;

/// Where a column of elements along the sliding direction touches, in contact lengths of the one-dimensional model.
#[derive(Debug, Serialize)]
pub(super) struct Row {
    pub(super) exponent: f64,
    /// Δx = Δy, which is how exactly the outline is known.
    pub(super) element: f64,
    /// Centre of the column, across the sliding direction.
    pub(super) y: f64,
    /// x of the rear edge of the last loaded element of the column.
    pub(super) rear: f64,
    /// x of the front edge of the first one.
    pub(super) front: f64,
}

/// The stationary contact of one profile; lengths in contact lengths of the one-dimensional model.
pub(super) struct Contact {
    pub(super) exponent: f64,
    /// Number of elements along the contact length of the one-dimensional model.
    pub(super) elements: usize,
    /// Ends of the contact in each column of elements, from one side to the other.
    pub(super) outline: Vec<Row>,
    contact_length: f64,
    mean_pressure: f64,
    solution: SteadySliding,
}

impl Contact {
    /// Ratio of the pressure of the element at a position to the mean of the contact.
    pub(super) fn pressure(&self, position: [f64; 2]) -> f64 {
        let in_metres = position.map(|coordinate| coordinate * self.contact_length);
        self.solution.pressure.pressure_at(in_metres) / self.mean_pressure
    }
}

/// Table and picture of the stationary contacts.
pub(super) fn part() -> Result<Part> {
    let contacts = compute()?;
    Part::new(
        NAME,
        &outlines(&contacts),
        [(NAME, contact_maps::figure(&contacts))],
    )
}

/// Solves the contacts of all [`PROFILES`], in their order.
pub(super) fn compute() -> Result<Vec<Contact>> {
    in_parallel("stationary contacts", &PROFILES, contact)
}

/// The rows of the table: the outlines of all contacts, one after the other.
pub(super) fn outlines(contacts: &[Contact]) -> Vec<&Row> {
    contacts
        .iter()
        .flat_map(|contact| &contact.outline)
        .collect()
}

/// Solves the stationary contact of a profile on one grid.
fn contact(&Profile { exponent, elements }: &Profile) -> Result<Contact> {
    let scene = Scene::unit(exponent)?;
    let contact_length = scene.theory()?.contact_length();
    let spacing = contact_length / elements as f64;
    let solution = scene.on_one_grid([spacing; 2], PHASE, TOLERANCE)?;
    Ok(Contact {
        exponent,
        elements,
        outline: outline(&solution, exponent, elements),
        contact_length,
        mean_pressure: solution.normal_force / solution.contact_area,
        solution,
    })
}

/// Rear and front of each column of elements that has a loaded one. Pressures are row-major, the first index along the motion.
fn outline(solution: &SteadySliding, exponent: f64, elements: usize) -> Vec<Row> {
    let field = &solution.pressure;
    let [rows, columns] = field.grid.shape();
    let length = field.grid.spacing()[0] * elements as f64;
    let element = 1.0 / elements as f64;
    let centre = |axis: usize, index: usize| field.origin[axis] / length + index as f64 * element;
    let touched = |column: usize| {
        let mut loaded = (0..rows).filter(|row| field.pressure[row * columns + column] > 0.0);
        let rear = loaded.next()?;
        let front = loaded.next_back().unwrap_or(rear);
        Some(Row {
            exponent,
            element,
            y: centre(1, column),
            rear: centre(0, rear) - 0.5 * element,
            front: centre(0, front) + 0.5 * element,
        })
    };
    (0..columns).filter_map(touched).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What the caption says of all contacts.
    #[test]
    fn contact_is_on_the_front_half_with_a_loaded_front_and_an_unloaded_rear() {
        let mut lengths = Vec::new();
        for (exponent, elements) in [(1.0, 30), (2.0, 40), (4.0, 60), (16.0, 150)] {
            let contact = contact(&profile(exponent, elements)).expect("a contact");
            let rows = &contact.outline;
            let last = rows.len() - 1;
            for (column, row) in rows.iter().enumerate() {
                assert!(row.rear >= 0.0 && row.front > row.rear, "{row:?}");
                let other = &rows[last - column];
                let same = row.rear.to_bits() == other.rear.to_bits();
                let is_mirrored = same && (row.y + other.y).abs() < 1e-9;
                assert!(is_mirrored, "{row:?} and {other:?}");
            }
            let middle = &rows[rows.len() / 2];
            lengths.push(middle.front - middle.rear);
            let half = 0.5 * middle.element;
            let [rear, next_to_front] = [middle.rear + half, middle.front - 3.0 * half]
                .map(|x| contact.pressure([x, middle.y]));
            // Only the pressure of the cone may be large at the rear, where its tip is and the pressure is singular too.
            let is_right = next_to_front > 1.5 && (exponent < 1.5 || rear < 0.5);
            assert!(is_right, "p = {exponent}: {next_to_front}, {rear}");
        }
        let fall = lengths.is_sorted_by(|longer, shorter| longer > shorter);
        assert!(fall, "{lengths:?}");
    }
}
