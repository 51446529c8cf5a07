//! Contacts that are their own mirror images.
//!
//! Where the separation is the same on both sides of a plane between two rows or columns of elements, so are load and
//! displacement, and the part of the grid in front of the plane tells them all.

use crate::bands::Bands;
use crate::contact::{Accuracy, ContactState, Control, Outcome, Question, solve_normalised};
use crate::convolution::Surroundings;
use crate::{BemError, Convolution};

/// The part of a grid in front of mirrors, and its contact.
#[derive(Debug, Clone)]
pub(super) struct Folded {
    convolution: Convolution,
    separation: Vec<f64>,
    state: ContactState,
}

/// Solves the contact on the part of the grid that the mirrors of separation and first guess leave.
pub(super) fn solve_in_front_of_mirrors(
    question: Question,
    state: &mut ContactState,
    accuracy: &Accuracy,
) -> Result<Outcome, BemError> {
    let (convolution, separation, control) = question;
    let mirrors = find_mirrors(convolution, [separation, &state.load]);
    if mirrors == [false; 2] {
        return solve_normalised(question, state, accuracy);
    }
    let mut folded = match state.folded.take() {
        Some(folded) if folded.convolution.mirrors() == mirrors => folded,
        _ => Box::new(Folded::new(convolution.folded(mirrors))),
    };
    folded.take_from([separation, &state.load]);
    let outcome = folded.solve(control, accuracy);
    folded.give_to([&mut state.load, &mut state.displacement]);
    state.folded = Some(folded);
    outcome
}

/// Along which axes fields are their own mirror images, to the last bit, and their parts have a coarser grid.
fn find_mirrors(convolution: &Convolution, fields: [&[f64]; 2]) -> [bool; 2] {
    let [rows, columns] = convolution.grid().shape();
    let unit = match convolution.surroundings() {
        Surroundings::Free => 2,
        // The blocks of the coarser grid fill the period.
        Surroundings::Periodic => 4,
    };
    let lines = |row: usize| fields.map(|field| &field[row * columns..][..columns]);
    let bands = Bands::new([rows, columns]);
    let in_band = |band| {
        let mut rows_of_band = bands.rows(band);
        let behind = rows_of_band.start..rows_of_band.end.min(rows / 2);
        let along_x = behind
            .into_iter()
            .all(|row| lines(row) == lines(rows - 1 - row));
        let along_y = rows_of_band.all(|row| lines(row).into_iter().all(is_palindrome));
        [along_x, along_y]
    };
    let both = |left: [bool; 2], right: [bool; 2]| [0, 1].map(|axis| left[axis] && right[axis]);
    let equal = bands.gather(in_band, both);
    [0, 1].map(|axis| [rows, columns][axis].is_multiple_of(unit) && equal[axis])
}

fn is_palindrome(line: &[f64]) -> bool {
    let half = line.len() / 2;
    line[..half].iter().eq(line.iter().rev().take(half))
}

impl Folded {
    fn new(convolution: Convolution) -> Self {
        Self {
            separation: vec![0.0; convolution.grid().n_elements()],
            state: ContactState::new(&convolution),
            convolution,
        }
    }

    fn solve(&mut self, control: Control, accuracy: &Accuracy) -> Result<Outcome, BemError> {
        let images = self
            .convolution
            .mirrors()
            .map(|mirror| if mirror { 2.0 } else { 1.0 });
        let images = images[0] * images[1];
        let control = match control {
            Control::NormalForce(total) => Control::NormalForce(total / images),
            depth @ Control::IndentationDepth(_) => depth,
        };
        let question = (&self.convolution, &self.separation[..], control);
        let outcome = solve_normalised(question, &mut self.state, accuracy)?;
        Ok(Outcome {
            total_load: images * outcome.total_load,
            ..outcome
        })
    }

    /// Copies what lies in front of the mirrors from separation and load of the whole grid.
    fn take_from(&mut self, fields: [&[f64]; 2]) {
        let (shape, mirrors) = (self.convolution.grid().shape(), self.convolution.mirrors());
        let whole = self.convolution.grid().unfolded(mirrors).shape();
        let first = [0, 1].map(|axis| whole[axis] - shape[axis]);
        let bands = Bands::new(shape);
        let parts = [&mut self.separation[..], &mut self.state.load];
        bands.for_each(parts, |band, parts| {
            for (part, field) in parts.into_iter().zip(fields) {
                for (row, part) in bands.rows(band).zip(part.chunks_exact_mut(shape[1])) {
                    let start = (first[0] + row) * whole[1] + first[1];
                    part.copy_from_slice(&field[start..start + shape[1]]);
                }
            }
        });
    }

    /// Writes load and displacement of the whole grid.
    fn give_to(&self, fields: [&mut [f64]; 2]) {
        let (shape, mirrors) = (self.convolution.grid().shape(), self.convolution.mirrors());
        let whole = self.convolution.grid().unfolded(mirrors).shape();
        let parts = [&self.state.load, &self.state.displacement];
        let bands = Bands::new(whole);
        bands.for_each(fields, |band, fields| {
            for (field, part) in fields.into_iter().zip(parts) {
                for (row, values) in bands.rows(band).zip(field.chunks_exact_mut(whole[1])) {
                    let row = in_front(row, whole[0], mirrors[0]);
                    unfold(&part[row * shape[1]..][..shape[1]], values);
                }
            }
        });
    }
}

/// The row of the part that shows a row of the whole.
const fn in_front(row: usize, rows: usize, mirror: bool) -> usize {
    let half = rows / 2;
    match mirror {
        true if row < half => half - 1 - row,
        true => row - half,
        false => row,
    }
}

/// Writes a line from itself, or from the half of it in front of the mirror.
fn unfold(part: &[f64], line: &mut [f64]) {
    let (behind, front) = line.split_at_mut(line.len() - part.len());
    front.copy_from_slice(part);
    for (value, image) in behind.iter_mut().rev().zip(part) {
        *value = *image;
    }
}
