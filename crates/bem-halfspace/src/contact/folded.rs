//! Contacts that are their own mirror images.
//!
//! Where the separation is the same on both sides of a plane, so are load and displacement, and the part of the grid in
//! front of the plane tells them all. Of an element through whose centre the plane passes, half the load is in front.

use crate::bands::Bands;
use crate::bounds::Bounds;
use crate::contact::halves::Halves;
use crate::contact::{Accuracy, ContactState, Control, Outcome, Question, solve_normalised};
use crate::convolution::Surroundings;
use crate::mirror::{Mirror, NO_MIRRORS, images};
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
    let mirrors = match state.load.touched() {
        Some(load) => find_mirrors(convolution, [separation, load]),
        None => find_mirrors(convolution, [separation]),
    };
    if mirrors == NO_MIRRORS {
        return solve_normalised(question, state, accuracy);
    }
    let mut folded = match state.folded.take() {
        Some(folded) if folded.convolution.mirrors() == mirrors => folded,
        _ => Box::new(Folded::new(convolution.folded(mirrors))),
    };
    folded.take_from(separation, state.load.touched());
    let outcome = folded.solve(control, accuracy);
    folded.give_to([state.load.values_mut(), &mut state.displacement]);
    state.folded = Some(folded);
    outcome
}

/// The mirrors in the middle of the grid about which fields are their own images, to the last bit.
fn find_mirrors<const N: usize>(convolution: &Convolution, fields: [&[f64]; N]) -> [Mirror; 2] {
    let shape = convolution.grid().shape();
    let [rows, columns] = shape;
    let lines = |row: usize| fields.map(|field| &field[row * columns..][..columns]);
    let bands = Bands::new(shape);
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
    [0, 1].map(|axis| match convolution.surroundings() {
        _ if !equal[axis] || shape[axis] == 1 => Mirror::None,
        Surroundings::Free if shape[axis].is_multiple_of(2) => Mirror::Edge,
        Surroundings::Free => Mirror::Centre,
        // The blocks of the coarser grid fill the period.
        Surroundings::Periodic if shape[axis].is_multiple_of(4) => Mirror::Edge,
        Surroundings::Periodic => Mirror::None,
    })
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
        let images = images(self.convolution.mirrors());
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

    /// Copies what lies in front of the mirrors from the separation of the whole grid, and from its load if that was ever
    /// touched; otherwise that of the part was not either.
    fn take_from(&mut self, separation: &[f64], load: Option<&[f64]>) {
        let (shape, mirrors) = (self.convolution.grid().shape(), self.convolution.mirrors());
        let whole = self.convolution.grid().unfolded(mirrors).shape();
        let front = Bounds {
            lower: [0, 1].map(|axis| whole[axis] - shape[axis]),
            upper: whole,
        };
        front.cut((separation, whole[1]), &mut self.separation);
        if let Some(load) = load {
            let loads = self.state.load.values_mut();
            front.cut((load, whole[1]), loads);
            Halves::of(&self.convolution).keep_front(loads);
        }
    }

    /// Writes load and displacement of the whole grid.
    fn give_to(&self, fields: [&mut [f64]; 2]) {
        let (shape, mirrors) = (self.convolution.grid().shape(), self.convolution.mirrors());
        let whole = self.convolution.grid().unfolded(mirrors).shape();
        let halves = Halves::of(&self.convolution);
        let bands = Bands::new(whole);
        bands.for_each(fields, |band, [loads, displacements]| {
            let loads = loads.chunks_exact_mut(whole[1]);
            let displacements = displacements.chunks_exact_mut(whole[1]);
            for (row, (loads, displacements)) in bands.rows(band).zip(loads.zip(displacements)) {
                let row = in_front(row, whole[0], mirrors[0]);
                let part = row * shape[1]..(row + 1) * shape[1];
                unfold(&self.state.displacement[part.clone()], displacements);
                let front = whole[1] - shape[1];
                loads[front..].copy_from_slice(&self.state.load.values()[part.clone()]);
                for (column, part) in halves.in_line(part) {
                    loads[front + column] /= part;
                }
                mirror_behind(loads, shape[1]);
            }
        });
    }
}

/// The row of the part that shows a row of the whole.
const fn in_front(row: usize, rows: usize, mirror: Mirror) -> usize {
    let half = rows / 2;
    match mirror {
        Mirror::None => row,
        Mirror::Centre => row.abs_diff(half),
        Mirror::Edge if row < half => half - 1 - row,
        Mirror::Edge => row - half,
    }
}

/// Writes a line from its part in front of a mirror, or from itself.
fn unfold(part: &[f64], line: &mut [f64]) {
    let behind = line.len() - part.len();
    line[behind..].copy_from_slice(part);
    mirror_behind(line, part.len());
}

/// Completes a line of which so many values are in front of a mirror.
fn mirror_behind(line: &mut [f64], in_front: usize) {
    let (behind, front) = line.split_at_mut(line.len() - in_front);
    // An element about whose centre the mirror is has no image.
    let own = front.len() - behind.len();
    for (value, image) in behind.iter_mut().rev().zip(&front[own..]) {
        *value = *image;
    }
}
