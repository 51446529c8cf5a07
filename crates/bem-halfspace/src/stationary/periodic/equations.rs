//! The equations of a given contact, solved by minimal residuals.
//!
//! ```text
//! h + K p − d = 0  in the contact,   p = 0 outside,   mean of p given
//! ```
//!
//! Directions are those of generalised conjugate residuals (Eisenstat, Elman & Schultz 1983), so that pressure and gap are
//! known after every step. The preconditioner is the inverse of K restricted to the contact, less what other patches make
//! unnecessary. Contacts of few elements are solved by elimination, which no ratio of moduli slows down, once the steps have taken
//! as long for one of them. Lists hold the elements in contact and their neighbours, of which the gap shows whether they penetrate.

use std::sync::Arc;

use nalgebra::DMatrix;

use crate::contact::active_set::{ActiveSet, Run};
use crate::parallel::bands::copies;
use crate::parallel::reductions::{add, larger, sum};
use crate::stationary::conjugate_residuals::minimise;
use crate::stationary::periodic::far_loads::FarLoads;
use crate::stationary::periodic::kernel::{Kernel, Sliding};
use crate::{BemError, Grid};

/// Steps tried with one contact, of which all directions are kept where they fit.
const MOST_STEPS: usize = 80;
/// Numbers of half the usual length that directions may occupy, per element of the grid or in all, whichever is more; the oldest
/// are forgotten. Without those of small grids one of a hundred contacts of moduli that differ by up to 10⁶ never ended.
const NUMBERS_PER_ELEMENT: usize = 12;
const NUMBERS: usize = 1 << 22;
/// A step that leaves more than this part of the residual took little off.
const LITTLE: f64 = 0.9;
/// Elements in contact up to which elimination is tried, for the sake of memory, and the time that it takes for n of them on a grid
/// of N elements, in steps: about n³/N times this on one thread, from 16² to 64² elements.
const FEW: f64 = 1000.0;
const ELIMINATION: f64 = 0.005;

/// Lists of one contact and its neighbours.
pub(super) struct Equations {
    pub(super) kernel: Kernel,
    far: Option<FarLoads>,
    pub(super) near: ActiveSet,
    /// 1 in contact, 0 beside it.
    inside: Arc<[f64]>,
    n_contact: f64,
    pressure: Vec<f64>,
    /// Less its mean in the contact.
    gap: Vec<f64>,
    /// What S, and what the preconditioner, makes of the gap one.
    weights: Vec<f64>,
    lowered: Vec<f64>,
    total_lowered: f64,
    /// Fields that carry lists through transforms; the first vanishes outside them.
    spread: Vec<f64>,
    image: Vec<f64>,
    /// Displacement of an element under its own unit pressure, [m/Pa].
    pub(super) own_displacement: f64,
    /// Whether minimal residuals took longer for some contact of few elements than elimination.
    is_slow: bool,
    /// Products with the kernel on this grid.
    pub(super) products: usize,
}

/// |gap| in the contact, \[m].
struct Residual {
    largest: f64,
    root_mean_square: f64,
}

impl Equations {
    pub(super) fn new(sliding: &Sliding, grid: &Grid) -> Result<Self, BemError> {
        let field = || copies(0.0, grid.n_elements());
        let mut equations = Self {
            kernel: Kernel::new(sliding, grid)?,
            far: FarLoads::new(sliding, grid)?,
            near: ActiveSet::new(grid.shape()),
            inside: Arc::new([]),
            n_contact: 0.0,
            pressure: Vec::new(),
            gap: Vec::new(),
            weights: Vec::new(),
            lowered: Vec::new(),
            total_lowered: 0.0,
            spread: field(),
            image: field(),
            own_displacement: 0.0,
            is_slow: false,
            products: 0,
        };
        equations.spread[0] = 1.0;
        let (spread, image) = (&equations.spread, &mut equations.image);
        equations.kernel.displace(spread, image);
        equations.own_displacement = equations.image[0];
        Ok(equations)
    }

    /// K p of a whole field.
    pub(super) fn displace(&mut self, pressure: &[f64], result: &mut [f64]) {
        self.products += 1;
        self.kernel.displace(pressure, result);
    }

    /// Takes another contact, with the fields of pressure and gap.
    pub(super) fn take(&mut self, contact: &[bool], pressure: &[f64], gap: &[f64]) {
        let columns = self.near.columns;
        self.near
            .assign(|element| has_neighbour(contact, columns, element));
        self.near.find_runs();
        self.spread.fill(0.0);
        let runs = (0..self.near.bands.n_bands()).flat_map(|band| self.near.runs(band));
        let inside = runs.flat_map(|run| &contact[run.elements()]);
        self.inside = inside.map(|inside| f64::from(*inside)).collect();
        self.n_contact = self.total(&self.inside);
        self.pressure = self.listed(pressure);
        let mut gap = self.listed(gap);
        self.subtract_mean(&mut gap);
        self.gap = gap;
        let mut weights = self.inside.to_vec();
        self.invert(&mut weights);
        self.weights = weights;
        self.lowered = self.weights.clone();
        if let Some(far) = &mut self.far {
            far.weigh(&self.near, &self.weights, &mut self.lowered);
        }
        self.total_lowered = self.total(&self.lowered);
    }

    /// Writes pressure and gap into fields, as far as the lists reach.
    pub(super) fn give(&self, pressure: &mut [f64], gap: &mut [f64]) {
        self.near.scatter(&self.pressure, pressure);
        self.near.scatter(&self.gap, gap);
    }

    /// Solves until the largest residual is small enough, or the root mean square a part of what it was and no more than a
    /// `mean`; it is returned.
    pub(super) fn iterate(&mut self, part: f64, mean: f64, largest: f64) -> f64 {
        let target = mean.min(part * self.residual(&self.gap).root_mean_square);
        let is_small =
            |residual: Residual| residual.root_mean_square <= target || residual.largest <= largest;
        let are_few = self.n_contact <= FEW;
        let elimination = ELIMINATION * self.n_contact.powi(3) / self.spread.len() as f64;
        if !(are_few && self.is_slow) {
            self.minimise(if are_few { elimination } else { f64::INFINITY }, is_small);
        }
        if are_few && !is_small(self.residual(&self.gap)) {
            self.is_slow = true;
            self.eliminate();
        }
        self.residual(&self.gap).root_mean_square
    }

    fn minimise(&mut self, most: f64, is_small: impl Fn(Residual) -> bool) {
        let [mut pressure, mut gap] = [&mut self.pressure, &mut self.gap].map(std::mem::take);
        let inside = Arc::clone(&self.inside);
        let numbers = NUMBERS.max(NUMBERS_PER_ELEMENT * self.spread.len());
        let fitting = numbers / (2 * inside.len());
        #[expect(clippy::cast_possible_truncation, reason = "at most all steps")]
        #[expect(clippy::cast_sign_loss, reason = "positive")]
        let most = most.min(MOST_STEPS as f64) as usize;
        let steps = [most, fitting.clamp(1, MOST_STEPS) - 1];
        let unknowns = [&mut pressure[..], &mut gap[..]];
        let mut before = f64::INFINITY;
        minimise::<f32>(unknowns, Some(&inside), steps, |gap, from, found| {
            let residual = self.residual(gap);
            let now = residual.root_mean_square;
            let goes_on = !is_small(residual);
            if goes_on {
                if let Some(far) = &mut self.far
                    && now > LITTLE * before
                {
                    far.refine();
                }
                before = now;
                self.find_direction(from, found);
            }
            goes_on
        });
        (self.pressure, self.gap) = (pressure, gap);
    }

    /// Adds the pressures without mean that close the gaps, by the dense influence of the elements in contact on each other.
    fn eliminate(&mut self) {
        let runs = (0..self.near.bands.n_bands()).flat_map(|band| self.near.runs(band));
        let listed = runs.flat_map(Run::elements).enumerate();
        let (places, elements): (Vec<usize>, Vec<usize>) = listed
            .filter(|(place, _)| self.inside[*place] > 0.0)
            .unzip();
        self.spread.fill(0.0);
        self.spread[0] = 1.0;
        self.kernel.displace(&self.spread, &mut self.image);
        self.spread[0] = 0.0;
        let columns = self.near.columns;
        let rows = self.spread.len() / columns;
        let influence = |to: usize, from: usize| {
            let row = (to / columns + rows - from / columns) % rows;
            let column = (to % columns + columns - from % columns) % columns;
            self.image[row * columns + column]
        };
        let n = elements.len();
        let matrix = DMatrix::from_fn(n, n, |to, from| influence(elements[to], elements[from]));
        let sides = [&self.gap, &*self.inside];
        let sides = DMatrix::from_fn(n, 2, |place, side| sides[side][places[place]]);
        let Some(solved) = matrix.lu().solve(&sides) else {
            return;
        };
        let depth = solved.column(0).sum() / solved.column(1).sum();
        let mut added = copies(0.0, self.inside.len());
        for (row, place) in places.into_iter().enumerate() {
            added[place] = depth * solved[(row, 1)] - solved[(row, 0)];
        }
        let mut image = copies(0.0, added.len());
        self.displaced(&added, &mut image);
        add(&mut self.pressure, 1.0, &added);
        add(&mut self.gap, 1.0, &image);
    }

    /// The gaps that a list of pressures causes.
    fn displaced(&mut self, pressures: &[f64], gaps: &mut [f64]) {
        self.near.scatter(pressures, &mut self.spread);
        self.products += 1;
        self.kernel.displace(&self.spread, &mut self.image);
        self.near.gather(&self.image, gaps);
        self.subtract_mean(gaps);
    }

    fn residual(&self, gap: &[f64]) -> Residual {
        let square = self.near.sum(|places| {
            let lists = [&self.inside[places.clone()], &gap[places]];
            sum(lists, |[inside, gap]| inside * gap * gap)
        });
        let largest = |band: usize| {
            let places = self.near.places(band);
            let pairs = self.inside[places.clone()].iter().zip(&gap[places]);
            pairs.fold(0.0, |top, (inside, gap)| larger(top, inside * gap.abs()))
        };
        Residual {
            root_mean_square: (square / self.n_contact).sqrt(),
            largest: self.near.bands.gather(largest, larger),
        }
    }

    /// Pressures without mean that about close the gaps, and the gaps that they cause.
    fn find_direction(&mut self, gap: &[f64], [direction, image]: [&mut [f64]; 2]) {
        let closing = |band, [direction]: [&mut [f64]; 1]| {
            let places = self.near.places(band);
            let pairs = gap[places.clone()].iter().zip(&self.inside[places]);
            for (place, (gap, inside)) in direction.iter_mut().zip(pairs) {
                *place = -inside * gap;
            }
        };
        let bands = self.near.bands;
        bands.for_each_part([self.near.list(direction)], closing);
        self.invert(direction);
        if let Some(far) = &mut self.far {
            far.correct(&self.near, &self.weights, direction);
        }
        let total = self.total(direction);
        add(direction, -total / self.total_lowered, &self.lowered);
        self.displaced(direction, image);
    }

    /// S of a list, on the contact.
    fn invert(&mut self, list: &mut [f64]) {
        self.near.scatter(list, &mut self.spread);
        self.kernel.invert(&self.spread, &mut self.image);
        let (near, image, inside) = (&self.near, &self.image, &self.inside);
        near.bands.for_each_part([near.list(list)], |band, [list]| {
            near.gather_in(band, image, list);
            for (value, inside) in list.iter_mut().zip(&inside[near.places(band)]) {
                *value *= inside;
            }
        });
    }

    fn listed(&self, field: &[f64]) -> Vec<f64> {
        let mut list = copies(0.0, self.near.len());
        self.near.gather(field, &mut list);
        list
    }

    /// Subtracts the mean over the contact.
    fn subtract_mean(&self, list: &mut [f64]) {
        let sum = self.near.sum(|places| {
            let lists = [&list[places.clone()], &self.inside[places]];
            sum(lists, |[value, inside]| inside * value * inside)
        });
        let mean = sum / self.n_contact;
        list.iter_mut().for_each(|value| *value -= mean);
    }

    fn total(&self, list: &[f64]) -> f64 {
        self.near
            .sum(|places| sum([&list[places]], |[value]| value))
    }
}

fn has_neighbour(contact: &[bool], columns: usize, element: usize) -> bool {
    let rows = contact.len() / columns;
    let (row, column) = (element / columns, element % columns);
    [row + rows - 1, row, row + 1].iter().any(|row| {
        let row = &contact[row % rows * columns..][..columns];
        row[column] || row[(column + 1) % columns] || row[(column + columns - 1) % columns]
    })
}
