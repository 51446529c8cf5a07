//! Search of the active set: solve the equations of a contact, take elements in tension out of it and those that penetrate
//! into it.
//!
//! The equations are solved to a fifth of the residual that the change of the contact has left, to less where it has left more
//! than the change before, and to a part of the heights, which is smaller after each contact in vain; penetrations are told from
//! what is left of the residual, on average, before tension is taken away: that moves soft waves, and with them all that is far
//! from the contact.

use crate::parallel::reductions::larger;
use crate::stationary::periodic::equations::Equations;
use crate::stationary::periodic::kernel::Sliding;
use crate::stationary::pivots::{Pivots, Violation};
use crate::{BemError, Grid};

/// Part of the residual to which the equations are solved; with 0.1 there are up to a quarter more products in light contact.
const PART_OF_RESIDUAL: f64 = 0.2;
/// Likewise where the residual grows from contact to contact: rough solutions then move patches to and fro together. With a tenth of
/// the area of 4096² elements in contact and moduli that differ by 1000 there are 156 products without it and 115 with it; where it
/// holds for residuals that fall by less than a half too, contacts of dashpots take a fifth more.
const PART_OF_GROWING_RESIDUAL: f64 = 0.06;
/// Root mean square of the residual, as a part of that of the heights, and by which factor it is less after a contact in
/// vain. Without it the contact of a solid whose moduli differ by 1000 takes up to twice as many products on 1024² elements.
const ROUGH: f64 = 0.01;
const FINER: f64 = 0.3;
const FINEST: i32 = 4;
/// Penetrations beside the contact below so many root mean squares of the residual in it are not told from it; with 2 or 5 there
/// are as many products.
const NOISE: f64 = 3.0;
/// Likewise far from it, as a part of the largest residual.
const HIDING_RESIDUAL: f64 = 0.3;
/// Part of the tolerance to which the equations are solved.
const PART_OF_TOLERANCE: f64 = 0.5;

/// A contact problem on one grid.
#[derive(Debug, Clone, Copy)]
pub(super) struct PeriodicContact<'a> {
    pub(super) sliding: &'a Sliding,
    pub(super) grid: &'a Grid,
    /// At the centres of the elements, \[m].
    pub(super) heights: &'a [f64],
    /// \[Pa].
    pub(super) mean_pressure: f64,
    /// Largest residual, relative to the largest displacement.
    pub(super) tolerance: f64,
    /// Products with the kernel.
    pub(super) max_products: usize,
}

/// A solved contact; the pressure is a field of its own.
pub(super) struct Solved {
    /// Mean of h + u over the contact, \[m].
    pub(super) depth: f64,
    pub(super) products: usize,
    pub(super) residual: f64,
}

/// The fields of a search.
struct Search<'a> {
    problem: PeriodicContact<'a>,
    equations: &'a mut Equations,
    /// Where the gaps are evaluated, \[m].
    heights: Vec<f64>,
    contact: Vec<bool>,
    pressure: Vec<f64>,
    gap: Vec<f64>,
    /// Depth that has been taken from the gap, and the largest displacement, \[m].
    depth: f64,
    scale: f64,
    /// Root mean square of the heights, \[m].
    roughness: f64,
    /// Largest residual, relative to the largest displacement.
    residual: f64,
}

/// Solves the problem from a first guess of the pressure, which is the solution afterwards: outside the contact it is the
/// gap, as a negative multiple of the displacement of an element under its own pressure. Without a positive pressure half
/// of the elements are taken for the contact.
pub(super) fn solve(
    problem: PeriodicContact,
    equations: &mut Equations,
    pressure: &mut Vec<f64>,
) -> Result<Solved, BemError> {
    let mut search = Search::new(problem, equations, std::mem::take(pressure));
    let solved = search.run();
    *pressure = search.pressure;
    let own = search.equations.own_displacement;
    for ((pressure, gap), inside) in pressure.iter_mut().zip(&search.gap).zip(&search.contact) {
        *pressure = if *inside {
            pressure.max(0.0)
        } else {
            -gap.max(0.0) / own
        };
    }
    solved
}

impl<'a> Search<'a> {
    fn new(
        problem: PeriodicContact<'a>,
        equations: &'a mut Equations,
        mut pressure: Vec<f64>,
    ) -> Self {
        let n = problem.grid.n_elements();
        let mut heights = vec![0.0; n];
        equations.kernel.shifted(problem.heights, &mut heights);
        let mean = heights.iter().sum::<f64>() / n as f64;
        let variance = heights.iter().map(|h| (h - mean).powi(2)).sum::<f64>() / n as f64;
        if pressure.iter().all(|pressure| *pressure <= 0.0) {
            pressure = heights.iter().map(|h| f64::from(*h <= mean)).collect();
        }
        pressure.iter_mut().for_each(|p| *p = p.max(0.0));
        Self {
            contact: pressure.iter().map(|pressure| *pressure > 0.0).collect(),
            gap: vec![0.0; n],
            problem,
            equations,
            heights,
            pressure,
            depth: 0.0,
            scale: 0.0,
            roughness: variance.sqrt(),
            residual: f64::INFINITY,
        }
    }

    fn run(&mut self) -> Result<Solved, BemError> {
        let (tolerance, max_products) = (self.problem.tolerance, self.problem.max_products);
        self.balance();
        self.renew_gaps();
        let mut pivots = Pivots::new(self.problem.grid.shape());
        let mut before = f64::INFINITY;
        loop {
            self.equations
                .take(&self.contact, &self.pressure, &self.gap);
            let size = self.equations.size();
            let grows = size > before;
            before = size;
            // What cycles with rough solutions may end with better ones.
            let part = if pivots.are_single() {
                0.0
            } else if grows {
                PART_OF_GROWING_RESIDUAL
            } else {
                PART_OF_RESIDUAL
            };
            let rough = ROUGH * FINER.powi(pivots.in_vain().min(FINEST)) * self.roughness;
            let largest = PART_OF_TOLERANCE * tolerance * self.scale;
            self.equations.iterate(rough.min(part * size), largest);
            let is_solved = self.change(grows, &mut pivots);
            if is_solved {
                return Ok(Solved {
                    depth: self.depth,
                    products: self.equations.products,
                    residual: self.residual,
                });
            }
            if self.equations.products >= max_products {
                return Err(BemError::ContactNotConverged {
                    iterations: self.equations.products,
                    residual: self.residual,
                    tolerance,
                });
            }
        }
    }

    /// Moves elements that violate the conditions to the other side, and says whether the problem is solved; `grows` says that
    /// the change before left a larger residual than the one before it.
    fn change(&mut self, grows: bool, pivots: &mut Pivots) -> bool {
        let noise = self.equations.size();
        let tolerance = self.problem.tolerance;
        self.equations.give(&mut self.pressure);
        let tension = -self.pressure.iter().map(|p| p.min(0.0)).sum::<f64>();
        let is_slight = tension <= tolerance * self.total();
        self.balance();
        // With the tension.
        self.renew_gaps();
        let far = HIDING_RESIDUAL * self.residual * self.scale;
        let allowed = if pivots.are_single() {
            [0.0; 2]
        } else {
            [NOISE * noise, far]
        };
        let mut is_solved = self.is_within(tolerance);
        for element in pivots.choose(&self.violations(allowed), grows) {
            self.contact[element] ^= true;
        }
        if tension > 0.0 {
            self.release();
            self.renew_gaps();
            is_solved = is_slight && self.is_within(tolerance);
        }
        is_solved
    }

    /// Whether no gap in the contact and no penetration beside it is larger.
    fn is_within(&self, tolerance: f64) -> bool {
        let penetrates = |(gap, inside): (&f64, &bool)| !inside && *gap < -tolerance * self.scale;
        self.residual <= tolerance && !self.gap.iter().zip(&self.contact).any(penetrates)
    }

    /// The elements on the wrong side; smaller penetrations than allowed of those that are listed by the equations, and of others,
    /// and than the tolerance, are none.
    fn violations(&self, allowed: [f64; 2]) -> Vec<Violation> {
        let own = self.equations.own_displacement;
        let columns = self.problem.grid.shape()[1];
        let [near, far] = allowed.map(|allowed| allowed.max(self.problem.tolerance * self.scale));
        let violation = |element: usize| {
            let [pressure, gap] = [self.pressure[element], self.gap[element]];
            let (size, least) = if self.contact[element] {
                (-pressure * own, 0.0)
            } else if self.equations.near.contains(element) {
                (-gap, near)
            } else {
                (-gap, far)
            };
            (size >= least).then_some(Violation {
                element,
                place: [element / columns, element % columns],
                size,
            })
        };
        (0..self.contact.len()).filter_map(violation).collect()
    }

    /// Sum of the pressures, \[Pa].
    fn total(&self) -> f64 {
        self.problem.mean_pressure * self.pressure.len() as f64
    }

    /// Takes tension away, and as much from the next pressures behind it along the motion. The longest waves along the motion
    /// may be a thousand times softer than all others: they hardly change so, and those with crests along it not at all,
    /// where tension that is just set to zero would throw the surfaces apart.
    fn release(&mut self) {
        let columns = self.problem.grid.shape()[1];
        let mut tensions = vec![0.0; columns];
        for _ in 0..2 {
            let rows = self.pressure.chunks_mut(columns);
            for (pressures, contact) in rows.zip(self.contact.chunks(columns)).rev() {
                let elements = pressures.iter_mut().zip(contact);
                for ((pressure, inside), tension) in elements.zip(&mut tensions) {
                    let sum = *pressure + *tension;
                    *pressure = if *inside { sum.max(0.0) } else { 0.0 };
                    *tension = sum - *pressure;
                }
            }
        }
        self.balance();
    }

    /// Gives the pressure its mean.
    fn balance(&mut self) {
        let factor = self.total() / self.pressure.iter().sum::<f64>();
        self.pressure.iter_mut().for_each(|p| *p *= factor);
    }

    /// The gaps under the pressure, less their mean in the contact, and the largest residual there.
    fn renew_gaps(&mut self) {
        self.equations.displace(&self.pressure, &mut self.gap);
        let n = self.gap.len() as f64;
        let mean = self.gap.iter().sum::<f64>() / n;
        let above = |top: f64, moved: &f64| larger(top, (moved - mean).abs());
        self.scale = self.gap.iter().fold(0.0, above);
        for (gap, height) in self.gap.iter_mut().zip(&self.heights) {
            *gap += height - mean;
        }
        let contact = &self.contact;
        let in_contact = |(gap, inside): (&f64, &bool)| inside.then_some(*gap);
        let inside = self.gap.iter().zip(contact).filter_map(in_contact);
        self.depth = inside.clone().sum::<f64>() / inside.count() as f64;
        self.gap.iter_mut().for_each(|gap| *gap -= self.depth);
        let inside = self.gap.iter().zip(contact).filter_map(in_contact);
        self.residual = inside.fold(0.0, |top, gap| larger(top, gap.abs())) / self.scale;
    }
}
