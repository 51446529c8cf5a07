//! The equations of a given contact, solved by minimal residuals.
//!
//! ```text
//! h + K p − d = 0  in the contact,   p = 0 outside,   mean of p given
//! ```
//!
//! Directions are those of generalised conjugate residuals (Eisenstat, Elman & Schultz 1983), so that pressure and gap are
//! known after every step. The preconditioner is the inverse of K restricted to the contact, less what other patches make
//! unnecessary. Contacts of few elements, or that leave few open, are solved by elimination, once the steps have taken as long for
//! one of them, or some times as long for all. Lists hold the elements in contact and their neighbours, of which the
//! gap shows whether they penetrate.
//!
//! In one contact all numbers have seven digits, in units of its gaps; the search renews the gaps with all digits between contacts.

mod elimination;

use std::sync::Arc;

use numerics::transforms::Real as _;
use rustfft::num_complex::Complex;

use crate::contact::active_set::ActiveSet;
use crate::parallel::reductions::{add_scaled, larger, sum};
use crate::parallel::row_blocks::copies;
use crate::stationary::conjugate_residuals::{GcrLimits, gcr};
use crate::stationary::periodic::block_correction::BlockCorrection;
use crate::stationary::periodic::kernel::{PeriodicKernel, Sliding};
use crate::{BemError, Grid};

/// Steps tried with one contact whose directions do not all fit into memory, and with one whose do. A dense contact of moduli that
/// differ by some thousand does not end with 80: its residual falls after a hundred steps of which none is forgotten.
const STEPS: usize = 80;
const MOST_STEPS: usize = 400;
/// Numbers of half the usual length that directions may occupy, per element of a large grid and of a small one, and at most on the
/// small one; beyond them the oldest are forgotten. With 57 per cent of 2048² elements in contact and moduli that differ by 1000
/// there are 146 products, with 12 numbers 274 and with 24 of them 136.
const NUMBERS_PER_ELEMENT: usize = 16;
pub(super) const NUMBERS_PER_ELEMENT_OF_FEW: usize = 256;
pub(super) const NUMBERS_OF_FEW: usize = 1 << 24;
/// A step that leaves more than this part of the residual took little off.
const LITTLE: f64 = 0.9;
/// Elements in contact, or open ones, up to which elimination is tried, for the sake of memory, and the time that it takes for n of
/// them on a grid of N elements, in steps: about n³/N times this on one thread, from 16² to 64² elements.
const FEW: f64 = 1000.0;
const ELIMINATION: f64 = 0.005;
/// Eliminations whose time all contacts of one grid may take by minimal residuals before the others are eliminated. Of 5000 contacts
/// and more, each of moduli that differ by up to a million on some 700 elements, one in 800 is not found in 2000 products without it.
const ELIMINATIONS: f64 = 4.0;

/// Lists of one contact and its neighbours.
pub(super) struct Equations {
    pub(super) kernel: PeriodicKernel,
    correction: Option<BlockCorrection>,
    pub(super) neighbourhood: ActiveSet,
    /// 1 in contact, 0 beside it.
    inside: Arc<[f32]>,
    n_contact: f64,
    /// \[Pa].
    pressure: Vec<f64>,
    /// Unit of gaps, \[m]; that of pressures displaces an element by one.
    unit: f64,
    /// Less its mean in the contact.
    gap: Vec<f32>,
    /// What S, and what the preconditioner, makes of the gap one.
    weights: Vec<f32>,
    unit_depth_response: Vec<f32>,
    total_unit_depth_response: f64,
    /// K and its inverse on the whole grid.
    symbols: [Vec<Complex<f32>>; 2],
    /// Fields that carry lists through transforms; the first vanishes outside them.
    scattered: Vec<f32>,
    image: Vec<f32>,
    /// Displacement of an element under its own unit pressure, [m/Pa].
    pub(super) self_influence: f64,
    /// The longest elimination so far, in steps: contacts that take no longer are eliminated at once.
    longest_elimination: f64,
    /// Products with the kernel on this grid.
    pub(super) products: usize,
}

impl Equations {
    pub(super) fn new(sliding: &Sliding, grid: &Grid) -> Result<Self, BemError> {
        let mut kernel = PeriodicKernel::new(sliding, grid)?;
        let self_influence = of_first(&mut kernel, PeriodicKernel::displace, grid.n_elements())[0];
        let field = || copies(0.0, grid.n_elements());
        Ok(Self {
            symbols: kernel.symbols(self_influence),
            correction: BlockCorrection::new(sliding, grid, self_influence)?,
            kernel,
            neighbourhood: ActiveSet::new(grid.shape()),
            inside: Arc::new([]),
            n_contact: 0.0,
            pressure: Vec::new(),
            unit: 1.0,
            gap: Vec::new(),
            weights: Vec::new(),
            unit_depth_response: Vec::new(),
            total_unit_depth_response: 0.0,
            scattered: field(),
            image: field(),
            self_influence,
            longest_elimination: 0.0,
            products: 0,
        })
    }

    /// K p of a whole field.
    pub(super) fn displace(&mut self, pressure: &[f64], result: &mut [f64]) {
        self.products += 1;
        self.kernel.displace(pressure, result);
    }

    /// Takes another contact, with the fields of pressure and gap.
    pub(super) fn set_active_set(&mut self, contact: &[bool], pressure: &[f64], gap: &[f64]) {
        let columns = self.neighbourhood.columns;
        self.neighbourhood
            .assign(|element| has_neighbour(contact, columns, element));
        self.neighbourhood.find_runs();
        self.scattered.fill(0.0);
        let runs =
            (0..self.neighbourhood.bands.n_bands()).flat_map(|band| self.neighbourhood.runs(band));
        let inside = runs.flat_map(|run| &contact[run.elements()]);
        self.inside = inside.map(|inside| f32::from(*inside)).collect();
        self.n_contact = self.total(&self.inside);
        self.pressure = self.gather(pressure);
        self.set_gap(self.gather(gap));
        let mut weights = self.inside.to_vec();
        self.invert(&mut weights);
        self.weights = weights;
        self.unit_depth_response = self.weights.clone();
        if let Some(correction) = &mut self.correction {
            correction.weigh(
                &self.neighbourhood,
                &self.weights,
                &mut self.unit_depth_response,
            );
        }
        self.total_unit_depth_response = self.total(&self.unit_depth_response);
    }

    /// Lists a gap less its mean in the contact, which takes the more digits the smaller the residual is.
    fn set_gap(&mut self, mut gap: Vec<f64>) {
        let inside = gap.iter().zip(&*self.inside);
        let sum: f64 = inside.map(|(gap, inside)| gap * f64::from(*inside)).sum();
        gap.iter_mut().for_each(|gap| *gap -= sum / self.n_contact);
        let unit = gap.iter().fold(0.0, |top, gap| larger(top, gap.abs()));
        self.unit = if unit > 0.0 { unit } else { 1.0 };
        self.gap = gap
            .iter()
            .map(|gap| f32::rounded(gap / self.unit))
            .collect();
    }

    /// Writes the pressure into a field, as far as the list reaches.
    pub(super) fn copy_pressure_to(&self, pressure: &mut [f64]) {
        self.neighbourhood.scatter(&self.pressure, pressure);
    }

    /// Root mean square of the gap in the contact, \[m].
    pub(super) fn residual_rms(&self) -> f64 {
        self.residual(&self.gap) * self.unit
    }

    /// Solves until the largest residual, or the root mean square, is small enough.
    pub(super) fn solve(&mut self, mean: f64, largest: f64) {
        let [mean, largest] = [mean, largest].map(|length| length / self.unit);
        let is_small = |equations: &Self, size: f64, gap: &[f32]| {
            size <= mean || size <= largest && equations.largest(gap) <= largest
        };
        let are_few = self.n_unknowns() <= FEW;
        let elimination = ELIMINATION * self.n_unknowns().powi(3) / self.scattered.len() as f64;
        let worthwhile = (self.products as f64 / ELIMINATIONS).max(self.longest_elimination);
        if !(are_few && elimination < worthwhile) {
            self.minimise(if are_few { elimination } else { f64::INFINITY }, is_small);
        }
        if are_few && !is_small(self, self.residual(&self.gap), &self.gap) {
            self.longest_elimination = self.longest_elimination.max(elimination);
            self.eliminate();
        }
    }

    fn minimise(&mut self, most: f64, is_small: impl Fn(&Self, f64, &[f32]) -> bool) {
        let mut gap = std::mem::take(&mut self.gap);
        let mut added = copies(0.0, gap.len());
        let inside = Arc::clone(&self.inside);
        let n = self.scattered.len();
        let of_few = NUMBERS_OF_FEW.min(NUMBERS_PER_ELEMENT_OF_FEW * n);
        let numbers = of_few.max(NUMBERS_PER_ELEMENT * n);
        let fitting = (numbers / (2 * inside.len())).clamp(1, MOST_STEPS);
        #[expect(clippy::cast_possible_truncation, reason = "at most all steps")]
        #[expect(clippy::cast_sign_loss, reason = "positive")]
        let most = most.min(fitting.max(STEPS) as f64) as usize;
        let limits = GcrLimits {
            max_steps: most,
            truncation_depth: fitting - 1,
        };
        let mut before = f64::INFINITY;
        gcr(
            &mut added,
            &mut gap,
            Some(&inside),
            limits,
            |state, direction, image| {
                let now = (state.residual_square / self.n_contact).sqrt();
                let goes_on = !is_small(self, now, state.residual);
                if goes_on {
                    if let Some(correction) = &mut self.correction
                        && now > LITTLE * before
                    {
                        correction.refine();
                    }
                    before = now;
                    self.find_direction(state.source, [direction, image]);
                }
                goes_on
            },
        );
        self.gap = gap;
        let unit = self.unit / self.self_influence;
        for (pressure, added) in self.pressure.iter_mut().zip(added) {
            *pressure += unit * f64::from(added);
        }
    }

    /// The gaps that a list of pressures causes.
    fn displaced(&mut self, pressures: &[f32], gaps: &mut [f32]) {
        self.neighbourhood.scatter(pressures, &mut self.scattered);
        self.products += 1;
        self.kernel
            .apply_single_precision(&self.symbols[0], &self.scattered, &mut self.image);
        self.neighbourhood.gather(&self.image, gaps);
        self.subtract_mean(gaps);
    }

    /// Root mean square of a gap in the contact, in its unit.
    fn residual(&self, gap: &[f32]) -> f64 {
        let square = self.neighbourhood.sum(|range| {
            let lists = [&self.inside[range.clone()], &gap[range]];
            sum(lists, |[inside, gap]| inside * gap * gap).into()
        });
        (square / self.n_contact).sqrt()
    }

    /// Largest |gap| in the contact.
    fn largest(&self, gap: &[f32]) -> f64 {
        let largest = |band: usize| {
            let range = self.neighbourhood.packed_range(band);
            let pairs = self.inside[range.clone()].iter().zip(&gap[range]);
            pairs.fold(0.0, |top, (inside, gap)| {
                larger(top, f64::from(inside * gap.abs()))
            })
        };
        self.neighbourhood.bands.gather(largest, larger)
    }

    /// Pressures without mean that about close the gaps, and the gaps that they cause.
    fn find_direction(&mut self, gap: &[f32], [direction, image]: [&mut [f32]; 2]) {
        let closing = |band, [direction]: [&mut [f32]; 1]| {
            let range = self.neighbourhood.packed_range(band);
            let pairs = gap[range.clone()].iter().zip(&self.inside[range]);
            for (place, (gap, inside)) in direction.iter_mut().zip(pairs) {
                *place = -inside * gap;
            }
        };
        let bands = self.neighbourhood.bands;
        bands.for_each_part([self.neighbourhood.packed(direction)], closing);
        self.invert(direction);
        if let Some(correction) = &mut self.correction {
            correction.correct(&self.neighbourhood, &self.weights, direction);
        }
        let total = self.total(direction);
        add_scaled(
            direction,
            f32::rounded(-total / self.total_unit_depth_response),
            &self.unit_depth_response,
        );
        self.displaced(direction, image);
    }

    /// S of a list, on the contact.
    fn invert(&mut self, list: &mut [f32]) {
        self.neighbourhood.scatter(list, &mut self.scattered);
        self.kernel
            .apply_single_precision(&self.symbols[1], &self.scattered, &mut self.image);
        let (neighbourhood, image, inside) = (&self.neighbourhood, &self.image, &self.inside);
        neighbourhood
            .bands
            .for_each_part([neighbourhood.packed(list)], |band, [list]| {
                neighbourhood.gather_in(band, image, list);
                for (value, inside) in list
                    .iter_mut()
                    .zip(&inside[neighbourhood.packed_range(band)])
                {
                    *value *= inside;
                }
            });
    }

    fn gather(&self, field: &[f64]) -> Vec<f64> {
        let mut list = copies(0.0, self.neighbourhood.len());
        self.neighbourhood.gather(field, &mut list);
        list
    }

    /// Subtracts the mean over the contact.
    fn subtract_mean(&self, list: &mut [f32]) {
        let sum = self.neighbourhood.sum(|range| {
            let lists = [&list[range.clone()], &self.inside[range]];
            sum(lists, |[value, inside]| inside * value).into()
        });
        let mean = f32::rounded(sum / self.n_contact);
        list.iter_mut().for_each(|value| *value -= mean);
    }

    fn total(&self, list: &[f32]) -> f64 {
        self.neighbourhood
            .sum(|range| sum([&list[range]], |[value]| value).into())
    }
}

/// What a map makes of 1 on the first element of so many.
fn of_first(
    kernel: &mut PeriodicKernel,
    map: fn(&mut PeriodicKernel, &[f64], &mut [f64]),
    n_elements: usize,
) -> Vec<f64> {
    let [mut first, mut image] = [(); 2].map(|()| copies(0.0, n_elements));
    first[0] = 1.0;
    map(kernel, &first, &mut image);
    image
}

fn has_neighbour(contact: &[bool], columns: usize, element: usize) -> bool {
    let rows = contact.len() / columns;
    let (row, column) = (element / columns, element % columns);
    [row + rows - 1, row, row + 1].iter().any(|row| {
        let row = &contact[row % rows * columns..][..columns];
        row[column] || row[(column + 1) % columns] || row[(column + columns - 1) % columns]
    })
}
