//! The equations of a given contact, solved by minimal residuals.
//!
//! ```text
//! h + K p − d = 0  in the contact,   p = 0 outside,   mean of p given
//! ```
//!
//! Directions are those of generalised conjugate residuals (Eisenstat, Elman & Schultz 1983), so that pressure and gap are
//! known after every step. The preconditioner is the inverse of K restricted to the contact, less what other patches make
//! unnecessary. Lists hold the elements in contact and their neighbours, of which the gap shows whether they penetrate.

use std::ops::Range;

use crate::bands::{copies, resize};
use crate::contact::active_set::ActiveSet;
use crate::periodic::far_loads::FarLoads;
use crate::periodic::kernel::{Kernel, Sliding};
use crate::periodic::waves::Waves;
use crate::reductions::{add, larger, sum};
use crate::{BemError, Grid};

/// Steps tried with one contact.
const MOST_STEPS: usize = 40;
/// Numbers per element of the grid that directions may occupy; the oldest are forgotten.
const NUMBERS_PER_ELEMENT: usize = 12;
const MOST_KEPT: usize = 30;

/// Lists of one contact and its neighbours.
#[derive(Debug)]
pub(super) struct Equations {
    pub(super) kernel: Kernel,
    pub(super) waves: Waves,
    far: Option<FarLoads>,
    pub(super) near: ActiveSet,
    /// 1 in contact, 0 beside it.
    inside: Vec<f64>,
    pub(super) n_contact: f64,
    pressure: Vec<f64>,
    /// Less its mean in the contact.
    gap: Vec<f64>,
    /// What S, and what the preconditioner, makes of the gap one.
    weights: Vec<f64>,
    lowered: Vec<f64>,
    total_lowered: f64,
    /// Directions and the gaps that they cause, of which the latter are orthonormal in the contact.
    kept: Vec<[Vec<f64>; 2]>,
    /// Fields that carry lists through transforms; the first vanishes outside them.
    spread: Vec<f64>,
    image: Vec<f64>,
    /// Displacement of an element under its own unit pressure, [m/Pa].
    pub(super) own_displacement: f64,
    /// Products with the kernel on this grid.
    pub(super) products: usize,
}

/// |gap| in the contact, \[m].
#[derive(Debug, Clone, Copy)]
struct Residual {
    largest: f64,
    root_mean_square: f64,
}

impl Equations {
    pub(super) fn new(sliding: &Sliding, grid: &Grid) -> Result<Self, BemError> {
        let field = || copies(0.0, grid.n_elements());
        let mut equations = Self {
            kernel: Kernel::new(sliding, grid)?,
            waves: Waves::new(grid),
            far: FarLoads::new(sliding, grid)?,
            near: ActiveSet::new(grid.shape()),
            inside: Vec::new(),
            n_contact: 0.0,
            pressure: Vec::new(),
            gap: Vec::new(),
            weights: Vec::new(),
            lowered: Vec::new(),
            total_lowered: 0.0,
            kept: Vec::new(),
            spread: field(),
            image: field(),
            own_displacement: 0.0,
            products: 0,
        };
        equations.find_own_displacement();
        Ok(equations)
    }

    fn find_own_displacement(&mut self) {
        self.spread[0] = 1.0;
        self.kernel
            .displace(&mut self.waves, &self.spread, &mut self.image);
        self.own_displacement = self.image[0];
    }

    /// K p of a whole field.
    pub(super) fn displace(&mut self, pressure: &[f64], result: &mut [f64]) {
        self.products += 1;
        self.kernel.displace(&mut self.waves, pressure, result);
    }

    /// Takes another contact, with the fields of pressure and gap.
    pub(super) fn take(&mut self, contact: &[bool], pressure: &[f64], gap: &[f64]) {
        let columns = self.near.columns;
        self.near
            .assign(|element| has_neighbour(contact, columns, element));
        self.near.find_runs();
        self.spread.fill(0.0);
        let length = self.near.len();
        for list in [
            &mut self.inside,
            &mut self.pressure,
            &mut self.gap,
            &mut self.weights,
            &mut self.lowered,
        ] {
            resize(list, 0.0, length);
        }
        let kept = (NUMBERS_PER_ELEMENT * contact.len() / (2 * length)).clamp(1, MOST_KEPT);
        self.kept.resize_with(kept, Default::default);
        for list in self.kept.iter_mut().flatten() {
            resize(list, 0.0, length);
        }
        for (place, element) in places_and_elements(&self.near) {
            self.inside[place] = if contact[element] { 1.0 } else { 0.0 };
        }
        self.near.gather(pressure, &mut self.pressure);
        self.near.gather(gap, &mut self.gap);
        self.n_contact = self.total([&self.inside; 2], |[inside, _]| inside);
        let mut gap = std::mem::take(&mut self.gap);
        self.subtract_mean(&mut gap);
        self.gap = gap;
        self.find_lowered();
    }

    /// Writes pressure and gap into fields, as far as the lists reach.
    pub(super) fn give(&self, pressure: &mut [f64], gap: &mut [f64]) {
        self.near.scatter(&self.pressure, pressure);
        self.near.scatter(&self.gap, gap);
    }

    fn find_lowered(&mut self) {
        let one = std::mem::take(&mut self.inside);
        let mut weights = std::mem::take(&mut self.weights);
        self.invert(&one, &mut weights);
        self.inside = one;
        self.keep_inside(&mut weights);
        self.lowered.copy_from_slice(&weights);
        if let Some(far) = &mut self.far {
            far.weigh(&self.near, &weights);
            far.correct(&self.near, &weights, &mut self.lowered);
        }
        self.weights = weights;
        self.total_lowered = self.total([&self.lowered; 2], |[lowered, _]| lowered);
    }

    /// Solves until the largest residual is small enough, or the root mean square a part of what it was; that is returned.
    pub(super) fn iterate(&mut self, part: f64, largest: f64) -> f64 {
        let mut residual = self.residual();
        let target = part * residual.root_mean_square;
        for step in 0..MOST_STEPS {
            if residual.root_mean_square <= target || residual.largest <= largest {
                break;
            }
            self.step(step);
            residual = self.residual();
        }
        residual.root_mean_square
    }

    fn residual(&self) -> Residual {
        let square = self.total([&self.inside, &self.gap], |[inside, gap]| {
            inside * gap * gap
        });
        let largest = |places: Range<usize>| {
            let pairs = self.inside[places.clone()].iter().zip(&self.gap[places]);
            pairs.fold(0.0, |top, (inside, gap)| larger(top, inside * gap.abs()))
        };
        Residual {
            root_mean_square: (square / self.n_contact).sqrt(),
            largest: self
                .near
                .bands
                .gather(|band| largest(self.near.places(band)), larger),
        }
    }

    fn step(&mut self, number: usize) {
        let length = self.kept.len();
        let mut pair = std::mem::take(&mut self.kept[number % length]);
        let [direction, image] = &mut pair;
        self.precondition(direction);
        self.near.scatter(direction, &mut self.spread);
        self.products += 1;
        self.kernel
            .displace(&mut self.waves, &self.spread, &mut self.image);
        self.near.gather(&self.image, image);
        self.subtract_mean(image);
        for earlier in number.saturating_sub(length - 1)..number {
            let earlier = &self.kept[earlier % length];
            let component = self.product(&earlier[1], image);
            self.add(direction, -component, &earlier[0]);
            self.add(image, -component, &earlier[1]);
        }
        let norm = self.product(image, image).sqrt();
        if norm > 0.0 {
            for list in [&mut *direction, &mut *image] {
                list.iter_mut().for_each(|value| *value /= norm);
            }
            let step = -self.product(image, &self.gap);
            let [mut pressure, mut gap] = [&mut self.pressure, &mut self.gap].map(std::mem::take);
            self.add(&mut pressure, step, direction);
            self.add(&mut gap, step, image);
            (self.pressure, self.gap) = (pressure, gap);
        }
        self.kept[number % length] = pair;
    }

    /// Pressures without mean that about close the gaps.
    fn precondition(&mut self, direction: &mut [f64]) {
        for ((value, gap), inside) in direction.iter_mut().zip(&self.gap).zip(&self.inside) {
            *value = -inside * gap;
        }
        self.near.scatter(direction, &mut self.spread);
        self.kernel
            .invert(&mut self.waves, &self.spread, &mut self.image);
        self.near.gather(&self.image, direction);
        self.keep_inside(direction);
        if let Some(far) = &mut self.far {
            far.correct(&self.near, &self.weights, direction);
        }
        let total = self.total([direction, direction], |[value, _]| value);
        self.add(direction, -total / self.total_lowered, &self.lowered);
    }

    /// S of a list, on all elements of the lists.
    fn invert(&mut self, list: &[f64], result: &mut [f64]) {
        self.near.scatter(list, &mut self.spread);
        self.kernel
            .invert(&mut self.waves, &self.spread, &mut self.image);
        self.near.gather(&self.image, result);
    }

    fn keep_inside(&self, list: &mut [f64]) {
        for (value, inside) in list.iter_mut().zip(&self.inside) {
            *value *= inside;
        }
    }

    /// Subtracts the mean over the contact.
    fn subtract_mean(&self, list: &mut [f64]) {
        let mean = self.product(list, &self.inside) / self.n_contact;
        list.iter_mut().for_each(|value| *value -= mean);
    }

    /// Sum of products over the contact.
    fn product(&self, left: &[f64], right: &[f64]) -> f64 {
        self.near.sum(|places| {
            let lists = [&self.inside, left, right].map(|list| &list[places.clone()]);
            sum(lists, |[inside, left, right]| inside * left * right)
        })
    }

    fn total(&self, lists: [&[f64]; 2], term: impl Fn([f64; 2]) -> f64 + Sync) -> f64 {
        self.near
            .sum(|places| sum(lists.map(|list| &list[places.clone()]), &term))
    }

    fn add(&self, target: &mut [f64], factor: f64, other: &[f64]) {
        let list = [self.near.list(target)];
        self.near.bands.for_each_part(list, |band, [target]| {
            add(target, factor, &other[self.near.places(band)]);
        });
    }
}

/// Whether an element or one of its eight neighbours is in contact.
fn has_neighbour(contact: &[bool], columns: usize, element: usize) -> bool {
    let rows = contact.len() / columns;
    let (row, column) = (element / columns, element % columns);
    [row + rows - 1, row, row + 1].iter().any(|row| {
        let row = &contact[row % rows * columns..][..columns];
        row[column] || row[(column + 1) % columns] || row[(column + columns - 1) % columns]
    })
}

/// Places in lists, and their elements.
fn places_and_elements(near: &ActiveSet) -> impl Iterator<Item = (usize, usize)> {
    (0..near.bands.n_bands()).flat_map(|band| {
        let first = near.places(band).start;
        let runs = near.runs(band).iter();
        runs.flat_map(move |run| {
            run.places()
                .map(move |place| first + place)
                .zip(run.elements())
        })
    })
}
