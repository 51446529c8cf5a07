//! Active-set search for the contact of a moving body: block principal pivoting (Júdice & Pires 1994) with inexact inner solves.
//!
//! ```text
//! p ≥ 0,   g ≥ 0,   p g = 0   with   g = h + K p − d        (KKT conditions of the unilateral contact)
//! ```
//!
//! Each update of the active set
//!
//! 1. solves g = 0 on the active set, to a tolerance that follows the residual left by the last exchange (inexact Newton);
//! 2. collects the KKT violations, p < 0 on the set and g < 0 outside it;
//! 3. exchanges all violating elements, or fewer while the search does not improve (`contact/exchange_rule.rs`);
//! 4. projects the pressure onto p ≥ 0, and tests for convergence: gaps and tension below the tolerance, and few violations left.
//!
//! The gaps of step 2 are those of the solution with its tension. The projection onto p ≥ 0 changes the most compliant
//! waves, if only slightly, and with them the gaps far from the contact.
//!
//! The operator K of a moving contact is not symmetric, so that there is no energy to descend; that the search ends rests on the
//! exchange rule.
//!
//! Theory: docs/theory/stationary-half-space.md, "The equations of one contact" for bodies and "Periodic surfaces" for rough ones.

use crate::BemError;
use crate::contact::exchange_rule::{ExchangeRule, Violation};
use crate::parallel::reductions::larger;

/// Ratio of a penetration to the largest residual on the active set, below which the penetration counts as solver error. Chosen;
/// from 0 to 1 no answer changes by more than 5 % of its bar (case of `evidence tuning`). With 1 rough contacts take a quarter more
/// operator applications, with 0 a cusp takes a sixth more time.
const PENETRATION_THRESHOLD: f64 = 0.3;
/// Ratio of the total tension to the force above which an update only removes elements, because the gaps outside then say little.
/// Chosen (case of `evidence tuning`).
///
/// Measured on dashpots of 128² elements whose moduli grow up to a million times with the frequency. Without this rule one light
/// contact in seven is not found in 3000 operator applications, and others take three times as many. With 0.25 there are as many
/// applications as with this value.
const MAX_TENSILE_FRACTION: f64 = 0.2;
/// Largest residual that always counts as closed, in units of the last place of the depth d. Chosen as the rounding of a few
/// operations; a smaller one would ask for what rounding hides. The depth of a long cylinder (plane strain) on a material of long
/// memory may exceed the heights in contact a million times.
const DEPTH_ROUNDING_ULPS: f64 = 16.0;
/// Number of times that the residual of an unchanged active set may grow, which only rounding error causes. Chosen to limit the
/// time: beyond it the search ends. A contact that is found before does not depend on it.
const MAX_STAGNATIONS: usize = 5;
/// Largest ratio of the residual to the tolerance with which a contact counts as found where only rounding error is left. Chosen: the bars
/// contain the residual. Measured: tolerances of 1e-12 leave up to 2.4e-12 under a quarter of 30 random height maps.
const LARGEST_ROUNDING_RATIO: f64 = 10.0;

/// Smallest number of elements in contact for each that violates the KKT conditions by more than the error of the solver. Chosen: areas have
/// larger errors than a thousandth.
const MIN_ACTIVE_OVER_VIOLATIONS: usize = 1000;
/// Largest number of updates by which a contact with closed gaps is brought to that. Chosen: elements at the boundary may change back and
/// forth.
const MAX_SETTLING_UPDATES: usize = 8;

/// Forcing terms of the inexact Newton method: inner residual over the residual that the last exchange left.
pub(crate) struct ForcingTerms {
    /// Value after an exchange that left a smaller residual than the one before.
    pub(crate) usual: f64,
    /// Value after an exchange that left a larger residual than the one before: inexact solutions then move elements back and forth
    /// together.
    pub(crate) after_growth: f64,
}

/// A contact problem on one grid whose linear equations can be solved on a given active set.
///
/// ```text
/// h + K p − d = 0  on the active set,   p = 0 outside
/// ```
pub(crate) trait FixedSetSolver {
    /// True if the first row of elements follows the last one, as in a period; false for a single body.
    const PERIODIC_ALONG_X: bool;
    /// Forcing terms of the inner solutions, which decide the number of operator applications and not the contact that is found.
    const FORCING: ForcingTerms;
    /// Rows and columns of the grid.
    fn shape(&self) -> [usize; 2];
    /// Row and column of an element; row-major over the grid unless given otherwise.
    fn row_and_column(&self, element: usize) -> [usize; 2] {
        let columns = self.shape()[1];
        [element / columns, element % columns]
    }
    /// Diagonal of K, greater than 0. Where displacements are known up to a constant only, the part of the diagonal that does not
    /// depend on it.
    fn self_influence(&self) -> f64;
    /// Replaces `displacement` by K p on all elements, up to a constant, and returns the scale of relative residuals.
    fn displace(&mut self, pressure: &[f64], displacement: &mut [f64]) -> f64;
    /// The depth d that the control prescribes for this pressure. `None` if d is the mean of h + K p on the active set.
    fn depth(&self, pressure: &[f64]) -> Option<f64>;
    /// Sets the active set and the initial pressure; `gap` is h + K p − d on all elements.
    fn set_active_set(&mut self, active: &[bool], pressure: &[f64], gap: &[f64]);
    /// RMS gap on the active set.
    fn residual_rms(&self) -> f64;
    /// Iterates until the RMS gap on the active set is at most `rms`, or the largest |gap| at most `max`.
    ///
    /// # Errors
    /// [`BemError::SingularContact`].
    fn solve(&mut self, rms: f64, max: f64) -> Result<(), BemError>;
    /// Writes the pressure on the active set, which may be tensile, into a field of all elements.
    fn copy_pressure_to(&self, pressure: &mut [f64]);
    /// Scales the pressure to the given force, if a force is given.
    fn scale_to_force(&self, pressure: &mut [f64]);
    /// Number of iterations so far, in the unit in which the budget of the search is given.
    fn iterations(&self) -> usize;
    /// True if the budget of iterations allows no further update of the active set.
    fn budget_is_exhausted(&self) -> bool;
}

/// An active-set search, with its current active set, pressure, gaps and depth.
pub(crate) struct Search<'a, P> {
    /// Contact problem, with the equations on its present active set.
    problem: &'a mut P,
    /// Heights h at the points where the gaps are evaluated.
    heights: Vec<f64>,
    /// Loosest inner tolerance: RMS residual of the solution on any active set, in the unit of the heights.
    inner_tolerance: f64,
    /// Largest residual and penetration, relative to [`scale`](Self::scale).
    tolerance: f64,
    /// True for each element of the active set.
    pub(crate) active: Vec<bool>,
    /// Pressure of all elements, \[Pa] or the unit of the problem.
    pub(crate) pressure: Vec<f64>,
    /// Gap h + K p − d of all elements, in the unit of the heights.
    pub(crate) gap: Vec<f64>,
    /// Depth d, in the unit of the heights.
    pub(crate) depth: f64,
    /// Scale of relative residuals, as returned by [`FixedSetSolver::displace`].
    scale: f64,
    /// Largest |gap| on the active set, relative to the scale.
    pub(crate) residual: f64,
}

impl<'a, P: FixedSetSolver> Search<'a, P> {
    /// A search that starts from a `pressure` with positive values; these are the initial active set, and others are set to zero.
    pub(crate) fn new(
        problem: &'a mut P,
        heights: Vec<f64>,
        inner_tolerance: f64,
        tolerance: f64,
        mut pressure: Vec<f64>,
    ) -> Self {
        pressure.iter_mut().for_each(|p| *p = p.max(0.0));
        Self {
            active: pressure.iter().map(|pressure| *pressure > 0.0).collect(),
            gap: vec![0.0; pressure.len()],
            problem,
            heights,
            inner_tolerance,
            tolerance,
            pressure,
            depth: 0.0,
            scale: 0.0,
            residual: f64::INFINITY,
        }
    }

    /// Finds the active set, the pressure and the depth, and leaves them in the fields.
    ///
    /// # Errors
    /// [`BemError::ContactNotConverged`]; [`BemError::SingularContact`].
    pub(crate) fn run(&mut self) -> Result<(), BemError> {
        self.problem.scale_to_force(&mut self.pressure);
        self.update_gaps();
        let mut rule = ExchangeRule::new(self.problem.shape());
        let mut previous_residual = f64::INFINITY;
        let (mut set_is_unchanged, mut stagnations, mut n_converged) = (false, 0, 0);
        loop {
            // Solve the equations g = 0 on the active set, to a fraction of the residual that the last exchange of elements left.
            self.problem
                .set_active_set(&self.active, &self.pressure, &self.gap);
            let residual = self.problem.residual_rms();
            let residual_grows = residual > previous_residual;
            stagnations += usize::from(residual_grows && set_is_unchanged);
            previous_residual = residual;
            let forcing = match residual_grows {
                // Inexact solutions may lead through the same active sets in a cycle, which accurate ones can end.
                _ if rule.exchanges_single_elements() => 0.0,
                true => P::FORCING.after_growth,
                false => P::FORCING.usual,
            };
            // Half of the allowed gap is left for the projection onto p ≥ 0.
            self.problem.solve(
                self.inner_tolerance.min(forcing * residual),
                0.5 * self.allowed_gap(),
            )?;
            self.problem.copy_pressure_to(&mut self.pressure);

            // Collect the elements that violate the KKT conditions (head of this file), under the pressure before its tension is
            // removed.
            let [mut tension, mut total] = [0.0; 2];
            for pressure in &self.pressure {
                tension -= pressure.min(0.0);
                total += pressure;
            }
            if !f64::is_finite(total) {
                let elements = self.active.iter().filter(|active| **active).count();
                return Err(BemError::SingularContact { elements });
            }
            self.problem.scale_to_force(&mut self.pressure);
            self.update_gaps();
            let mut converged = self.satisfies_kkt(1.0);
            let solver_error = if rule.exchanges_single_elements() {
                0.0
            } else {
                PENETRATION_THRESHOLD * self.residual * self.scale
            };
            let mut violations = self.violations(solver_error);
            if tension > MAX_TENSILE_FRACTION * total {
                violations.retain(|violation| self.active[violation.element]);
            }

            // Exchange elements between the active set and its complement.
            let selected = rule.select(&violations, residual_grows);
            set_is_unchanged = selected.is_empty();
            for element in selected {
                self.active[element] ^= true;
            }

            // Remove the tension by the projection onto p ≥ 0. If its share of the force exceeds the tolerance, another solution
            // is needed.
            if tension > 0.0 {
                self.project_nonnegative();
                self.update_gaps();
                converged = tension <= self.tolerance * total && self.satisfies_kkt(1.0);
            }
            if converged {
                // Penetrations that count as closed may still be those of many elements, each of which is missing in the contact area.
                let n_active = self.active.iter().filter(|active| **active).count();
                n_converged += 1;
                if MIN_ACTIVE_OVER_VIOLATIONS * violations.len() <= n_active
                    || n_converged > MAX_SETTLING_UPDATES
                    || self.problem.budget_is_exhausted()
                {
                    return Ok(());
                }
            }

            // End when rounding error prevails, with an error if it leaves too much, and when the budget is used.
            let is_stalled = stagnations > MAX_STAGNATIONS;
            let tension_is_small = tension <= self.tolerance * total;
            if is_stalled && tension_is_small && self.satisfies_kkt(LARGEST_ROUNDING_RATIO) {
                return Ok(());
            }
            if self.problem.budget_is_exhausted() || is_stalled {
                return Err(BemError::ContactNotConverged {
                    iterations: self.problem.iterations(),
                    residual: self.residual,
                    tolerance: self.tolerance,
                });
            }
        }
    }

    /// Largest residual and penetration that count as closed, in the unit of the heights.
    fn allowed_gap(&self) -> f64 {
        (self.tolerance * self.scale).max(self.rounding())
    }

    /// Rounding error of gaps by that of the depth, in the unit of the heights.
    fn rounding(&self) -> f64 {
        DEPTH_ROUNDING_ULPS * f64::EPSILON * self.depth.abs()
    }

    /// Projects onto p ≥ 0, and p = 0 outside the active set, with little effect on the most compliant waves: the longest ones along the motion
    /// and those with crests along it, which may be a thousand times more compliant than all others. Setting tension to zero would excite them
    /// and drive the surfaces apart. Removed tension is therefore subtracted from the next loaded elements behind it, which keeps the force of
    /// each line along the motion: the long waves hardly change, and those with crests along the motion not at all.
    fn project_nonnegative(&mut self) {
        let mut tension_by_line = vec![0.0; self.problem.shape()[1]];
        // A periodic line needs a second pass for the tension that is left at its rear end.
        for _ in 0..=usize::from(P::PERIODIC_ALONG_X) {
            for element in (0..self.active.len()).rev() {
                let tension = &mut tension_by_line[self.problem.row_and_column(element)[1]];
                let sum = self.pressure[element] + *tension;
                let kept = if self.active[element] {
                    sum.max(0.0)
                } else {
                    0.0
                };
                (self.pressure[element], *tension) = (kept, sum - kept);
            }
        }
        self.problem.scale_to_force(&mut self.pressure);
    }

    /// True if no residual on the active set and no penetration outside it exceeds a multiple of the allowed gap.
    fn satisfies_kkt(&self, multiple: f64) -> bool {
        let allowed = multiple * self.allowed_gap();
        let penetrates = |(gap, active): (&f64, &bool)| !active && *gap < -allowed;
        self.residual * self.scale <= allowed && !self.gap.iter().zip(&self.active).any(penetrates)
    }

    /// KKT violations: elements of the active set under tension, and elements outside it whose penetration reaches `solver_error` and
    /// the rounding error, though it may be below the allowed gap. Sizes are in the unit of the heights.
    fn violations(&self, solver_error: f64) -> Vec<Violation> {
        let self_influence = self.problem.self_influence();
        let smallest_penetration = solver_error.max(self.rounding());
        // The violation of an active element is its tension times the self-influence, and that of any other element its
        // penetration.
        let violation = |element: usize| {
            let [pressure, gap] = [self.pressure[element], self.gap[element]];
            let (size, threshold) = if self.active[element] {
                (-pressure * self_influence, 0.0)
            } else {
                (-gap, smallest_penetration)
            };
            (size >= threshold).then(|| Violation {
                element,
                place: self.problem.row_and_column(element),
                size,
            })
        };
        (0..self.active.len()).filter_map(violation).collect()
    }

    /// Recomputes gaps, depth, scale and residual from the pressure, with one operator application.
    fn update_gaps(&mut self) {
        self.scale = self.problem.displace(&self.pressure, &mut self.gap);
        for (gap, height) in self.gap.iter_mut().zip(&self.heights) {
            *gap += height;
        }
        let on_set = |(gap, active): (&f64, &bool)| active.then_some(*gap);
        self.depth = self.problem.depth(&self.pressure).unwrap_or_else(|| {
            let gaps = self.gap.iter().zip(&self.active).filter_map(on_set);
            gaps.clone().sum::<f64>() / gaps.count() as f64
        });
        self.gap.iter_mut().for_each(|gap| *gap -= self.depth);
        let gaps = self.gap.iter().zip(&self.active).filter_map(on_set);
        self.residual = gaps.fold(0.0, |max, gap| larger(max, gap.abs())) / self.scale;
    }
}
