//! Normal indentation under a constant force, without sliding.
//!
//! While the contact grows, the impulse ∫ P dt solves the elastic contact problem at the depth of the moment (Radok
//! 1957), on any grid and with any steps in time: only the elements cause an error.

use std::collections::BTreeSet;

use indenters::Surface;
use rheology::Viscous;

use crate::error::positive;
use crate::slide::MIN_CONTACT_ELEMENTS;
use crate::{
    BemError, ContactOptions, ContactProblem, ContactState, Control, Convolution, Footprint, Grid,
    solve_contact,
};

/// Resolution of an indentation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct IndentOptions {
    /// Edges of an element [Δx, Δy], \[m].
    pub spacing: [f64; 2],
    /// Where contact may occur.
    pub footprint: Footprint,
    /// How exactly each step is solved.
    pub contact: ContactOptions,
}

/// The state at one time.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct IndentRow {
    /// Time since first touch, \[s].
    pub time: f64,
    /// Depth of the lowest point, \[m].
    pub indentation_depth: f64,
    /// Area of the elements in contact, \[m²].
    pub contact_area: f64,
    /// Number of elements in contact.
    pub n_contact: usize,
}

/// Presses `surface` into an undeformed viscous half space with the constant `normal_force` \[N]; returns the state at
/// each of the `times` \[s], which must increase and be greater than zero.
///
/// # Errors
/// [`BemError::InvalidParameter`] for a force or a time out of range; [`BemError::GridTooLarge`];
/// [`BemError::GridTooCoarse`] when the contact at the end covers fewer than three elements along x or y;
/// [`BemError::ContactReachesBoundary`]; [`BemError::ContactNotConverged`]; [`BemError::InvalidHeight`].
pub fn indent(
    surface: &impl Surface,
    material: &Viscous,
    (normal_force, times): (f64, &[f64]),
    options: &IndentOptions,
) -> Result<Vec<IndentRow>, BemError> {
    positive("normal_force", normal_force)?;
    positive("number of times", times.len() as f64)?;
    positive("spacing along x", options.spacing[0])?;
    positive("spacing along y", options.spacing[1])?;
    let counts = options.footprint.elements(options.spacing)?;
    let grid = Grid::new(
        counts.map(|[before, after]| before + after + 1),
        options.spacing,
    )?;
    let convolution = Convolution::new(&grid);
    let mut state = ContactState::new(&convolution);
    let mut separation = sample(surface, &grid, counts);
    let mut previous = 0.0;
    let mut step = |&time: &f64| -> Result<IndentRow, BemError> {
        let problem = ContactProblem {
            convolution: &convolution,
            separation: &separation,
            compliance: material.step_compliance(positive("time step", time - previous)?),
            control: Control::NormalForce(normal_force),
        };
        let contact = solve_contact(&problem, &mut state, &options.contact)?;
        check_boundary(&state, &grid, &options.footprint)?;
        previous = time;
        for (separation, displacement) in separation.iter_mut().zip(state.displacement()) {
            *separation += displacement;
        }
        Ok(IndentRow {
            time,
            indentation_depth: contact.indentation_depth,
            contact_area: contact.n_contact as f64 * grid.element_area(),
            n_contact: contact.n_contact,
        })
    };
    let rows = times.iter().map(&mut step).collect::<Result<Vec<_>, _>>()?;
    check_resolution(&state, grid.shape()[1])?;
    Ok(rows)
}

/// A contact of fewer rows or columns has no meaningful size.
fn check_resolution(state: &ContactState, columns: usize) -> Result<(), BemError> {
    let distinct = |index: fn(usize, usize) -> usize| {
        state
            .contact()
            .iter()
            .map(|&element| index(element, columns))
            .collect::<BTreeSet<_>>()
            .len()
    };
    let elements = distinct(|element, columns| element / columns)
        .min(distinct(|element, columns| element % columns));
    if elements < MIN_CONTACT_ELEMENTS {
        return Err(BemError::GridTooCoarse {
            elements,
            needed: MIN_CONTACT_ELEMENTS,
        });
    }
    Ok(())
}

fn sample(surface: &impl Surface, grid: &Grid, counts: [[usize; 2]; 2]) -> Vec<f64> {
    let columns = grid.shape()[1];
    let position =
        |index: usize, axis: usize| (index as f64 - counts[axis][0] as f64) * grid.spacing()[axis];
    let height =
        |index: usize| surface.height([position(index / columns, 0), position(index % columns, 1)]);
    (0..grid.n_elements()).map(height).collect()
}

fn check_boundary(
    state: &ContactState,
    grid: &Grid,
    footprint: &Footprint,
) -> Result<(), BemError> {
    let [rows, columns] = grid.shape();
    let at_boundary = |&index: &usize| {
        let (row, column) = (index / columns, index % columns);
        row == 0 || column == 0 || row + 1 == rows || column + 1 == columns
    };
    if state.contact().iter().any(at_boundary) {
        return Err(footprint.boundary_reached(0.0));
    }
    Ok(())
}
