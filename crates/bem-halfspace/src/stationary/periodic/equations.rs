//! The linear equations on a given active set, solved by generalised conjugate residuals or directly.
//!
//! ```text
//! h + K p − d = 0  on the active set,   p = 0 outside,   mean of p or depth d given
//! ```
//!
//! for the heights h, the pressures p, the kernel K (`kernel.rs`) and the depth d, the value of h + u in the contact. If the depth is
//! free, it is eliminated: the mean over the active set is subtracted from gaps, and search directions have no mean.
//!
//! GCR (Eisenstat, Elman & Schultz 1983) keeps pressure and gap known after every step. The preconditioner is the inverse S of K
//! on the whole grid, restricted to the active set, less a coarse-space correction (`block_correction.rs`). Problems with few
//! unknowns are solved directly (`elimination.rs`), once the steps have cost as much as that, or some times as much on all
//! active sets together.
//!
//! All packed vectors of one active set are in single precision. Gaps are in units of the largest one, pressures in units that displace
//! their own element by that gap. The search computes the gaps anew in double
//! precision between active sets, so that no digit of the result is lost.
//!
//! Theory: docs/theory/stationary-half-space.md, "Periodic surfaces".

mod complement;
mod elimination;

use numerics::transforms::Real as _;
use rustfft::num_complex::Complex;

use crate::contact::active_set::ActiveSet;
use crate::dense;
use crate::parallel::reductions::{add_scaled, larger, mean, sum};
use crate::parallel::row_blocks::copies;
use crate::stationary::conjugate_residuals::{GcrLimits, gcr, norm};
use crate::stationary::periodic::PeriodicControl;
use crate::stationary::periodic::block_correction::BlockCorrection;
use crate::stationary::periodic::kernel::{MaterialAtSpeed, PeriodicKernel};
use crate::stationary::search::{FixedSetSolver, ForcingTerms};
use crate::{BemError, Grid};

/// Largest number of GCR steps on one active set if the basis has to be truncated to fit into memory. Chosen to limit the time.
/// Beyond it the equations are solved directly if they are few enough, or for the gaps of fewer open elements; otherwise the search
/// continues with the pressure so far.
const MAX_STEPS_IF_TRUNCATED: usize = 80;
/// Largest number of GCR steps if the whole basis fits into memory. Chosen.
///
/// A dense contact on a solid whose moduli differ by a factor of some thousand does not converge in 80 steps. Its residual falls
/// only after a hundred steps with an untruncated basis.
const MAX_STEPS: usize = 400;
/// Memory budget of the GCR basis on a large grid, in single-precision numbers per element of the grid: two per active element
/// and direction. Beyond it the oldest directions are dropped. Chosen to limit the memory.
///
/// With 57 per cent of 2048² elements in contact and moduli that differ by a factor of 1000, there are 146 operator applications.
/// With 12 numbers per element there are 274, and with 24 there are 136.
const BASIS_FLOATS_PER_ELEMENT: usize = 16;
/// Memory budget of the GCR basis on a small grid, in single-precision numbers per element of the grid. Beyond it, or beyond
/// [`MAX_BASIS_FLOATS_ON_SMALL_GRID`] in total, the oldest directions are dropped. Chosen: it holds 128 directions if all
/// elements are in contact, and all [`MAX_STEPS`] if less than a third are.
pub(super) const BASIS_FLOATS_PER_ELEMENT_ON_SMALL_GRID: usize = 256;
/// Largest size of the GCR basis on a small grid, in single-precision numbers: 64 MiB. Chosen to limit the memory. A larger basis
/// has only [`BASIS_FLOATS_PER_ELEMENT`] numbers per element of the grid.
pub(super) const MAX_BASIS_FLOATS_ON_SMALL_GRID: usize = 1 << 24;
/// Factor on n³/N in the cost of a direct solve with n unknowns on a grid of N elements, in GCR steps. Measured on one thread:
/// with the library faer (feature `dense`) it is 2e-4 to 7e-4 from 300 to 4000 unknowns. It decides the time, not the solution.
/// It has a case of `evidence tuning`.
const DIRECT_SOLVE_COST: f64 = if cfg!(feature = "dense") { 5e-4 } else { 5e-3 };

/// The equations on one active set, with packed vectors over it.
pub(super) struct Equations {
    /// Kernel K on the grid.
    pub(super) kernel: PeriodicKernel,
    /// Coarse-space correction of the preconditioner; `None` if the grid cannot be divided into blocks.
    correction: Option<BlockCorrection>,
    /// The elements in contact.
    active: ActiveSet,
    /// Prescribed mean pressure or depth.
    control: PeriodicControl,
    /// Prescribed value of h + u in the contact, \[m]; `None` under a mean pressure.
    pub(super) depth: Option<f64>,
    /// Pressure on the active set, packed, \[Pa].
    pressure: Vec<f64>,
    /// Unit of the packed gaps, \[m]: the largest gap when the active set was set. The unit of packed pressures displaces its own
    /// element by this unit.
    unit: f64,
    /// Packed gap, less its mean if the depth is free, in `unit`.
    gap: Vec<f32>,
    /// Packed conductances w = S 1: pressures under the unit gap on the active set, by the preconditioner without coarse-space correction.
    conductances: Vec<f32>,
    /// Packed pressures C 1 under the unit gap on the active set, by the preconditioner C with coarse-space correction: the response to a
    /// unit change of the depth. A multiple of it makes the mean of a search direction zero.
    unit_depth_response: Vec<f32>,
    /// Sum of that response over the active set.
    total_unit_depth_response: f64,
    /// Symbols of K over the self-influence on the whole grid.
    influence_symbols: Vec<Complex<f32>>,
    /// Symbols of S, the inverse of K over the self-influence, on the whole grid.
    inverse_symbols: Vec<Complex<f32>>,
    /// Field of the grid that carries packed vectors into transforms; zero outside the active set.
    scattered: Vec<f32>,
    /// Field of the grid with the result of a transform.
    image: Vec<f32>,
    /// Diagonal coefficient of K: displacement of an element under its own unit pressure, \[m/Pa].
    pub(super) self_influence: f64,
    /// Largest cost of a direct solve so far, in GCR steps; active sets that cost less are solved directly.
    largest_direct_cost: f64,
    /// True if the iteration over the gaps of the open elements was the last one to converge.
    converged_by_open_gaps: bool,
    /// Operator applications on this grid so far.
    pub(super) applications: usize,
    /// Number of operator applications from which on the search ends.
    pub(super) max_applications: usize,
}

/// Gaps on the active set that count as closed, in the unit of the packed gaps.
struct AllowedGaps {
    /// Largest root mean square.
    rms: f64,
    /// Largest gap, which is allowed whatever the root mean square is.
    max: f64,
}

impl AllowedGaps {
    /// Whether gaps with the root mean square `rms` are allowed.
    fn contain<T: Copy + Into<f64>>(&self, rms: f64, gaps: &[T]) -> bool {
        let largest = || {
            let sizes = gaps.iter().map(|gap| (*gap).into().abs());
            sizes.fold(0.0, larger)
        };
        rms <= self.rms || rms <= self.max && largest() <= self.max
    }
}

impl Equations {
    /// The equations on a grid, with the kernel and its preconditioners, before any element is in contact.
    pub(super) fn new(
        sliding: &MaterialAtSpeed,
        grid: &Grid,
        control: PeriodicControl,
    ) -> Result<Self, BemError> {
        // Build the kernel. Its diagonal coefficient is the displacement of an element under its own unit pressure.
        let mut kernel = PeriodicKernel::new(sliding, grid)?;
        let self_influence =
            unit_response(&mut kernel, PeriodicKernel::displace, grid.n_elements())[0];
        let [influence_symbols, inverse_symbols] = kernel.symbols(self_influence);
        let field = || copies(0.0, grid.n_elements());
        Ok(Self {
            influence_symbols,
            inverse_symbols,
            correction: BlockCorrection::new(sliding, grid, self_influence)?,
            kernel,
            active: ActiveSet::new(grid.shape()),
            control,
            depth: None,
            pressure: Vec::new(),
            unit: 1.0,
            gap: Vec::new(),
            conductances: Vec::new(),
            unit_depth_response: Vec::new(),
            total_unit_depth_response: 0.0,
            scattered: field(),
            image: field(),
            self_influence,
            largest_direct_cost: 0.0,
            converged_by_open_gaps: false,
            applications: 0,
            max_applications: usize::MAX,
        })
    }

    /// True if the mean pressure is given, false if the depth is.
    const fn depth_is_free(&self) -> bool {
        matches!(self.control, PeriodicControl::MeanPressure(_))
    }

    /// Sets the packed gap from values in \[m], and its unit. In its own unit single precision suffices, however small the gap is.
    fn set_gap(&mut self, mut gap: Vec<f64>) {
        if self.depth_is_free() {
            let mean = mean(&gap);
            gap.iter_mut().for_each(|gap| *gap -= mean);
        }
        let unit = gap.iter().fold(0.0, |top, gap| larger(top, gap.abs()));
        self.unit = if unit > 0.0 { unit } else { 1.0 };
        self.gap = gap
            .iter()
            .map(|gap| f32::rounded(gap / self.unit))
            .collect();
    }

    /// Whether the gaps on the active set are allowed.
    fn are_allowed(&self, allowed: &AllowedGaps) -> bool {
        allowed.contain(self.rms(norm(&self.gap)), &self.gap)
    }

    /// Iterates by GCR until the gaps are allowed, or to the limits. The unknowns are the pressures on the active set.
    fn iterate_pressures(&mut self, allowed: &AllowedGaps, limits: GcrLimits) {
        // Solve for changes of the pressures in single precision; the gap is the residual.
        let mut gap = std::mem::take(&mut self.gap);
        let mut added = copies(0.0, gap.len());
        gcr(&mut added, &mut gap, limits, |state, direction, image| {
            let residual = self.rms(state.residual_square.sqrt());
            let goes_on = !allowed.contain(residual, state.residual);
            if goes_on {
                self.find_direction(state.source, direction, image);
            }
            goes_on
        });
        self.gap = gap;
        // Accumulate the changes in double precision.
        let unit = self.unit / self.self_influence;
        for (pressure, added) in self.pressure.iter_mut().zip(added) {
            *pressure += unit * f64::from(added);
        }
    }

    /// Computes the packed `gaps` under packed `pressures`, less their mean if the depth is free: the operator of GCR.
    fn apply_influence(&mut self, pressures: &[f32], gaps: &mut [f32]) {
        self.active.scatter(pressures, &mut self.scattered);
        self.applications += 1;
        self.kernel.apply_single_precision(
            &self.influence_symbols,
            &self.scattered,
            &mut self.image,
        );
        self.active.gather(&self.image, gaps);
        if self.depth_is_free() {
            let mean = f32::rounded(self.total(gaps) / self.active.len() as f64);
            gaps.iter_mut().for_each(|gap| *gap -= mean);
        }
    }

    /// Root mean square of a packed vector from its Euclidean norm; 0 for the empty set.
    fn rms(&self, norm: f64) -> f64 {
        norm / (self.active.len().max(1) as f64).sqrt()
    }

    /// Writes the preconditioned `direction`, pressures that close the packed `gap` approximately and keep the prescribed quantity, and
    /// the gaps `image` that they cause.
    fn find_direction(&mut self, gap: &[f32], direction: &mut [f32], image: &mut [f32]) {
        // Apply the preconditioner to minus the gap: the inverse S on the whole grid, and its coarse-space correction.
        for (value, gap) in direction.iter_mut().zip(gap) {
            *value = -gap;
        }
        self.apply_inverse(direction);
        if let Some(correction) = &mut self.correction {
            correction.correct(&self.active, &self.conductances, direction);
        }
        // If the mean pressure is given, change the depth so that the mean of the direction is zero.
        if self.depth_is_free() {
            let depth = -self.total(direction) / self.total_unit_depth_response;
            add_scaled(direction, f32::rounded(depth), &self.unit_depth_response);
        }
        // Apply the influence to the direction, to find the gaps that it causes.
        self.apply_influence(direction, image);
    }

    /// Applies S, the inverse on the whole grid restricted to the active set, to a packed vector in place.
    fn apply_inverse(&mut self, vector: &mut [f32]) {
        self.active.scatter(vector, &mut self.scattered);
        self.kernel
            .apply_single_precision(&self.inverse_symbols, &self.scattered, &mut self.image);
        self.active.gather(&self.image, vector);
    }

    /// Gathers a field of the grid into a packed vector.
    fn gather(&self, field: &[f64]) -> Vec<f64> {
        let mut vector = copies(0.0, self.active.len());
        self.active.gather(field, &mut vector);
        vector
    }

    /// Sum of a packed vector.
    fn total(&self, vector: &[f32]) -> f64 {
        self.active
            .sum(|range| sum([&vector[range]], |[value]| value).into())
    }
}

impl FixedSetSolver for Equations {
    /// True: the first row of a period follows the last one.
    const PERIODIC_ALONG_X: bool = true;
    /// Forcing terms of rough contacts. Chosen on the number of operator applications; the contact that is found is the same.
    ///
    /// Measured: one contact below two crossed waves on a Kelvin–Voigt solid takes 80 applications on 1024² elements, and 614 with 0.2 and 0.06,
    /// because inexact solutions empty the contact first. A rough contact of the same solid takes 86 and 82, with 0.02 and 0.006 it takes 245.
    /// Light contacts take up to a quarter more than with 0.2.
    const FORCING: ForcingTerms = ForcingTerms {
        usual: 0.06,
        after_growth: 0.02,
    };

    /// Rows and columns of the grid of one period.
    fn shape(&self) -> [usize; 2] {
        let columns = self.active.columns;
        [self.scattered.len() / columns, columns]
    }

    /// Displacement of an element under its own unit pressure, \[m/Pa].
    fn self_influence(&self) -> f64 {
        self.self_influence
    }

    /// Writes the displacement K p \[m], in double precision; returns the largest displacement from the mean \[m], the scale of the
    /// tolerance.
    fn displace(&mut self, pressure: &[f64], displacement: &mut [f64]) -> f64 {
        self.applications += 1;
        self.kernel.displace(pressure, displacement);
        let mean = mean(displacement);
        displacement
            .iter()
            .fold(0.0, |top, moved| larger(top, (moved - mean).abs()))
    }

    /// Prescribed value of h + u in the contact, \[m]; `None` under a mean pressure.
    fn depth(&self, _: &[f64]) -> Option<f64> {
        self.depth
    }

    /// Sets the active set, with the fields of pressure \[Pa] and gap \[m], and updates the preconditioner.
    fn set_active_set(&mut self, active: &[bool], pressure: &[f64], gap: &[f64]) {
        self.active.assign(|element| active[element]);
        self.active.find_runs();
        self.scattered.fill(0.0);
        // Pack the pressures and gaps of the active elements into vectors.
        self.pressure = self.gather(pressure);
        self.set_gap(self.gather(gap));
        // Apply the preconditioner to the unit gap, without and with the coarse-space correction. A multiple of the result makes the
        // mean of search directions zero.
        let mut conductances = copies(1.0, self.active.len());
        self.apply_inverse(&mut conductances);
        let mut response = conductances.clone();
        if let Some(correction) = &mut self.correction {
            correction.set_conductances(&self.active, &conductances, &mut response);
        }
        self.total_unit_depth_response = self.total(&response);
        (self.conductances, self.unit_depth_response) = (conductances, response);
    }

    /// Root mean square of the gap on the active set, \[m].
    fn residual_rms(&self) -> f64 {
        self.rms(norm(&self.gap)) * self.unit
    }

    /// Solves the equations until the root mean square of the gap is below `rms`, or its maximum below `max`, \[m]; may end earlier at
    /// the limits of GCR.
    ///
    /// At a depth on a half space no pressure closes the gaps of all elements. If all are active, all get a tension, so that they leave
    /// the set.
    fn solve(&mut self, rms: f64, max: f64) -> Result<(), BemError> {
        let is_full = self.active.len() == self.scattered.len();
        if is_full && !self.depth_is_free() && self.kernel.mean_compliance == 0.0 {
            self.pressure.fill(-self.unit / self.self_influence);
            return Ok(());
        }
        let allowed = AllowedGaps {
            rms: rms / self.unit,
            max: max / self.unit,
        };

        // Iterate by GCR, unless a direct solve costs less than all iterations so far. If a direct solve is possible, the iteration
        // may cost at most as much. Without direct solves one contact in 800 is not found in 2000 operator applications, of 5000 on
        // some 700 elements each, with moduli that differ by up to a million.
        let n_elements = self.scattered.len();
        let can_be_direct = self.n_unknowns() <= dense::MAX_UNKNOWNS as f64;
        let direct_cost = DIRECT_SOLVE_COST * self.n_unknowns().powi(3) / n_elements as f64;
        let affordable = (self.applications as f64).max(self.largest_direct_cost);
        if !(can_be_direct && direct_cost < affordable) {
            let cost_limit = if can_be_direct {
                direct_cost
            } else {
                f64::INFINITY
            };

            // The basis holds as many directions, with their images, as fit into memory.
            let small_grid_floats = MAX_BASIS_FLOATS_ON_SMALL_GRID
                .min(BASIS_FLOATS_PER_ELEMENT_ON_SMALL_GRID * n_elements);
            let basis_floats = small_grid_floats.max(BASIS_FLOATS_PER_ELEMENT * n_elements);
            let max_directions =
                (basis_floats / (2 * self.active.len().max(1))).clamp(1, MAX_STEPS);
            let step_limit = max_directions.max(MAX_STEPS_IF_TRUNCATED) as f64;
            #[expect(clippy::cast_possible_truncation, reason = "at most all steps")]
            #[expect(clippy::cast_sign_loss, reason = "positive")]
            let limits = GcrLimits {
                max_steps: cost_limit.min(step_limit) as usize,
                truncation_depth: max_directions - 1,
            };

            // If the pressures do not converge with a truncated basis, the gaps of a few open elements may. What converged last comes
            // first.
            let has_alternative =
                !can_be_direct && max_directions < MAX_STEPS && self.has_few_open_elements();
            let gaps_come_first = has_alternative && self.converged_by_open_gaps;
            if gaps_come_first {
                self.iterate_open_gaps(&allowed, basis_floats);
            }
            if !self.are_allowed(&allowed) {
                self.iterate_pressures(&allowed, limits);
                self.converged_by_open_gaps = false;
            }
            if has_alternative && !gaps_come_first && !self.are_allowed(&allowed) {
                self.iterate_open_gaps(&allowed, basis_floats);
                self.converged_by_open_gaps = self.are_allowed(&allowed);
            }
        }

        // If the iteration has not converged, close the remaining gaps by a direct solve.
        if can_be_direct && !self.are_allowed(&allowed) {
            self.largest_direct_cost = self.largest_direct_cost.max(direct_cost);
            self.solve_directly();
        }
        Ok(())
    }

    /// Copies the pressure on the active set into a field of the grid.
    fn copy_pressure_to(&self, pressure: &mut [f64]) {
        self.active.scatter(&self.pressure, pressure);
    }

    /// Scales a pressure field to the prescribed mean; at a prescribed depth nothing changes.
    fn scale_to_force(&self, pressure: &mut [f64]) {
        if let PeriodicControl::MeanPressure(prescribed) = self.control {
            let factor = prescribed / mean(pressure);
            pressure.iter_mut().for_each(|p| *p *= factor);
        }
    }

    /// Number of operator applications so far.
    fn iterations(&self) -> usize {
        self.applications
    }

    /// True from the largest number of operator applications on.
    fn budget_is_exhausted(&self) -> bool {
        self.applications >= self.max_applications
    }
}

/// Result of a linear `map` of the fields of a grid for 1 on the first element and 0 on all others; it determines a
/// translation-invariant map.
fn unit_response(
    kernel: &mut PeriodicKernel,
    map: fn(&mut PeriodicKernel, &[f64], &mut [f64]),
    n_elements: usize,
) -> Vec<f64> {
    let [mut first, mut image] = [(); 2].map(|()| copies(0.0, n_elements));
    first[0] = 1.0;
    map(kernel, &first, &mut image);
    image
}
