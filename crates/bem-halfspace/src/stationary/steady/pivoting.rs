//! Block principal pivoting: guess the active set, solve its equations, move the elements in tension out of it and those
//! that penetrate into it.
//!
//! Where the violations are few, their neighbourhood is solved by itself. Early active sets are solved roughly, the last one to the
//! tolerance.

use crate::BemError;
use crate::stationary::pivots::{Pivots, Violation};
use crate::stationary::steady::contact_equations::solve_equations;
use crate::stationary::steady::filter::Product;
use crate::stationary::steady::mesh::Mesh;
use crate::stationary::steady::neighbourhood::solve_neighbourhood;
use crate::stationary::steady::plans::Plans;
use crate::stationary::steady::region::Region;

/// Contacts in vain up to which neighbourhoods are solved by themselves: that may repeat itself.
const NEIGHBOURHOODS: i32 = 3;
/// Largest tolerance of the first contact, and its ratio from contact to contact.
const FIRST_TOLERANCE: f64 = 1e-4;
const TOLERANCE_RATIO: f64 = 0.1;
/// Largest residual, as a part of the violation by an element at the front on the wrong side, that does not hide it.
const HIDING_RESIDUAL: f64 = 1e-2;
/// Part of the tolerance asked for to which the last equations are solved: the largest residual is far above the root
/// mean square.
const PART_OF_TOLERANCE: f64 = 0.2;
/// Smaller contacts are solved as fast as a neighbourhood.
const NEIGHBOURHOOD_FROM: usize = 500;
/// A tolerance that fails this far below the target fails because of rounding.
const ROUNDING_OF_TOLERANCE: f64 = 1e-3;
/// Units in the last place of the depth that a residual may have, whatever tolerance is asked for: after a long memory a line has
/// sunk a million times as deep as it touches.
const UNITS_OF_DEPTH: f64 = 16.0;
/// The largest residual of a contact is that many times its root mean square, at most, as a rule.
const PEAK: f64 = 10.0;

/// Loads of the elements in contact, all greater than zero, in the units of the mesh.
pub(super) struct Solution {
    pub(super) loads: Vec<(usize, f64)>,
    pub(super) depth: f64,
    pub(super) iterations: usize,
    /// Whether the equations of the last contact were factorised.
    pub(super) factorised: bool,
    /// Largest residual |h + u − d| in the contact, in units of the depth scale.
    pub(super) residual: f64,
    /// Mean under the load of what the gaps beside the contact add to the slope, in elements and units of the depth scale.
    pub(super) opening: f64,
}

/// Solves the complementarity problem from a first guess of the elements in contact and their loads.
pub(super) fn solve(
    mesh: &Mesh,
    plans: &mut Plans,
    guess: Vec<(usize, f64)>,
) -> Result<Solution, BemError> {
    let target = mesh.options.tolerance;
    let mut search = Search::new(mesh, plans, guess);
    let mut pivots = Pivots::new(mesh.shape());
    let (mut residual, mut made) = (f64::MAX, 0);
    for iterations in 1..=mesh.options.max_iterations {
        let state = search.solve();
        let sizes = state.violations.iter().map(|violation| violation.size);
        // That of the whole problem: elements on the wrong side count too.
        (residual, made) = (sizes.fold(state.residual, f64::max), iterations);
        if state.violations.is_empty() {
            let rounding = UNITS_OF_DEPTH * f64::EPSILON * search.depth.abs();
            if residual <= target.max(rounding) {
                let opening = mesh.opening(&search.loads, &state.gaps);
                return Ok(search.finish(residual, iterations, opening));
            }
            // Only the residual is left to improve; far below the target that is hopeless.
            if search.tolerance < ROUNDING_OF_TOLERANCE * target {
                break;
            }
            search.tolerance *= TOLERANCE_RATIO.max(0.5 * target / residual);
        } else {
            search.tolerance = (search.tolerance * TOLERANCE_RATIO).max(PART_OF_TOLERANCE * target);
            let chosen = pivots.choose(&state.violations, false);
            if pivots.in_vain() > NEIGHBOURHOODS || !search.solve_neighbourhood(&state) {
                search.pivot(chosen);
            }
        }
    }
    Err(BemError::ContactNotConverged {
        iterations: made,
        residual,
        tolerance: target,
    })
}

/// The contact as it is guessed now.
struct Search<'mesh> {
    mesh: &'mesh Mesh,
    plans: &'mesh mut Plans,
    /// Whether each element is in contact, and its load.
    inside: Vec<bool>,
    loads: Vec<f64>,
    depth: f64,
    factorised: bool,
    tolerance: f64,
    all: Region,
    product: Product,
}

/// How the solution on an active set stands to the contact conditions.
struct State {
    gaps: Vec<f64>,
    /// Smaller penetrations are not told from the residual.
    allowed: f64,
    /// Elements of the contact in tension and others that penetrate, in the order of their numbers.
    violations: Vec<Violation>,
    residual: f64,
}

impl<'mesh> Search<'mesh> {
    fn new(mesh: &'mesh Mesh, plans: &'mesh mut Plans, guess: Vec<(usize, f64)>) -> Self {
        let all = mesh.region(0..mesh.n_elements());
        let mut search = Self {
            mesh,
            inside: vec![false; mesh.n_elements()],
            loads: vec![0.0; mesh.n_elements()],
            depth: 0.0,
            factorised: false,
            tolerance: first_tolerance(guess.len()).max(PART_OF_TOLERANCE * mesh.options.tolerance),
            product: Product::new(plans.kernel(all.shape), &all),
            plans,
            all,
        };
        for (element, load) in guess {
            search.inside[element] = true;
            search.loads[element] = load;
        }
        search
    }

    /// Solves the equations of the active set up to the tolerance.
    fn solve(&mut self) -> State {
        let contact = (0..self.inside.len()).filter(|element| self.inside[*element]);
        let contact: Vec<usize> = contact.collect();
        let start = contact.iter().map(|&element| self.loads[element]).collect();
        let tolerance = self.tolerance / PEAK;
        let solved = solve_equations(self.mesh, self.plans, &contact, start, tolerance);
        self.loads.fill(0.0);
        for (&element, load) in contact.iter().zip(solved.loads) {
            self.loads[element] = load;
        }
        (self.depth, self.factorised) = (solved.depth, solved.factorised);
        self.drop_slight_tension();
        self.state()
    }

    /// Takes elements out of the contact whose tension is so slight that all of them together change the force, and with
    /// it the displacements, less than the tolerance.
    fn drop_slight_tension(&mut self) {
        let [mut tension, mut total] = [0.0; 2];
        for load in &self.loads {
            total += load;
            tension -= load.min(0.0);
        }
        if tension >= self.mesh.options.tolerance * total {
            return;
        }
        for (inside, load) in self.inside.iter_mut().zip(&mut self.loads) {
            if *load < 0.0 {
                (*inside, *load) = (false, 0.0);
            }
        }
        self.mesh.balance(&mut self.loads);
    }

    fn state(&mut self) -> State {
        let moved = self.product.apply(0, &self.loads, &self.all);
        let gap = |(element, moved)| self.mesh.height(element) + moved - self.depth;
        let gaps: Vec<f64> = moved.into_iter().enumerate().map(gap).collect();
        let in_contact = gaps.iter().zip(&self.inside).filter(|(_, inside)| **inside);
        let residual = in_contact.fold(0.0, |largest: f64, (gap, _)| largest.max(gap.abs()));
        let allowed = residual.max(self.mesh.options.tolerance);
        let violation = |(element, gap): (usize, f64)| {
            let (size, allowed) = if self.inside[element] {
                (-self.loads[element], 0.0)
            } else {
                (-gap, allowed)
            };
            (size > allowed).then_some(Violation {
                element,
                place: self.mesh.places(element)[0],
                size,
            })
        };
        let violations = gaps.iter().copied().enumerate().filter_map(violation);
        State {
            violations: violations.collect(),
            gaps,
            allowed,
            residual,
        }
    }

    /// Solves the neighbourhood of the violations by itself, if it is small and the contact is not.
    fn solve_neighbourhood(&mut self, state: &State) -> bool {
        if self.inside.iter().filter(|inside| **inside).count() < NEIGHBOURHOOD_FROM {
            return false;
        }
        let violations = state.violations.iter().map(|violation| violation.element);
        let violations: Vec<usize> = violations.collect();
        let (gaps, allowed) = (&state.gaps, state.allowed);
        let solved = solve_neighbourhood(self.mesh, gaps, &self.loads, &violations, allowed);
        for &(element, load) in solved.iter().flatten() {
            (self.inside[element], self.loads[element]) = (load > 0.0, load);
        }
        solved.is_some()
    }

    fn pivot(&mut self, elements: Vec<usize>) {
        for element in elements {
            self.inside[element] = !self.inside[element];
            self.loads[element] = 0.0;
        }
    }

    fn finish(self, residual: f64, iterations: usize, opening: f64) -> Solution {
        let loads = self.loads.into_iter().enumerate();
        Solution {
            loads: loads.filter(|(_, load)| *load > 0.0).collect(),
            depth: self.depth,
            iterations,
            factorised: self.factorised,
            residual,
            opening,
        }
    }
}

/// Tolerance of the first contact, of about so many elements: the gap opens with the power 3/2 of the distance from the
/// front.
fn first_tolerance(n_elements: usize) -> f64 {
    let along = (n_elements as f64).sqrt().max(1.0);
    FIRST_TOLERANCE.min(HIDING_RESIDUAL * along.powf(-1.5))
}
