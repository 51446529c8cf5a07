//! Search of the active set of a moving contact: solve the equations of a contact, take elements in tension out of it and those
//! that penetrate into it.
//!
//! The equations are solved to a part of the residual that the change of the contact has left, to less where it has left more
//! than the change before, and to a part of the heights, which is smaller after each contact in vain; penetrations are told from
//! what is left of the residual, on average, before tension is taken away: that moves soft waves, and with them all that is far
//! from the contact.

use crate::BemError;
use crate::parallel::reductions::larger;
use crate::stationary::pivots::{Pivots, Violation};

/// Factor by which the residual that any contact may have is smaller after one in vain, up to so many of them.
const FINER: f64 = 0.3;
const FINEST: i32 = 4;
/// Penetrations beside the contact below so many root mean squares of the residual in it are not told from it; with 2 or 5 there
/// are as many products.
const NOISE: f64 = 3.0;
/// Likewise far from it, as a part of the largest residual.
const HIDING_RESIDUAL: f64 = 0.3;
/// Part of the force above which tension is taken away before anything comes into the contact: the gaps beside it say little then. Of
/// light contacts of dashpots on 128² elements, whose moduli grow up to a million times with the frequency, one in seven is not
/// found in 3000 products without it, and others take three times as many; with a quarter of it there are as many products.
const TENSE: f64 = 0.2;
/// Part of the tolerance to which the equations are solved.
const PART_OF_TOLERANCE: f64 = 0.5;
/// Units in the last place of the depth that a residual may have, whatever tolerance is asked for: after a long memory a line has
/// sunk a million times as deep as it touches.
const UNITS_OF_DEPTH: f64 = 16.0;
/// How often the residual of a contact that stays the same may grow: then that is its rounding.
const HOPELESS: usize = 5;

/// A contact problem on one grid, and the equations of the elements that are in contact.
///
/// ```text
/// h + K p − d = 0  in the contact,   p = 0 outside
/// ```
pub(crate) trait MovingContact {
    /// Whether behind the last row comes the first one.
    const REPEATS: bool;
    /// Part of the residual to which the equations are solved, and where the residual grows from contact to contact: rough solutions
    /// then move elements to and fro together.
    const PARTS_OF_RESIDUAL: [f64; 2];
    /// Rows and columns of the grid, and the place of an element.
    fn shape(&self) -> [usize; 2];
    fn place(&self, element: usize) -> [usize; 2];
    /// Displacement of an element under its own unit pressure, greater than zero: where the displacements are known up to a
    /// constant only, relative to what does not depend on it.
    fn own_displacement(&self) -> f64;
    /// Replaces a field by the displacements K p of all elements, up to a constant, and returns what residuals are relative to.
    fn displace(&mut self, pressure: &[f64], moved: &mut [f64]) -> f64;
    /// The depth d where that is controlled; else it is the mean of h + K p in the contact.
    fn depth(&self, pressure: &[f64]) -> Option<f64>;
    /// Takes another contact, with the pressure and the gap h + K p − d of all elements.
    fn take(&mut self, contact: &[bool], pressure: &[f64], gap: &[f64]);
    /// Root mean square of the gap in the contact.
    fn residual(&self) -> f64;
    /// Solves until the root mean square, or the largest gap in the contact, is small enough.
    ///
    /// # Errors
    /// [`BemError::SingularContact`].
    fn solve(&mut self, mean: f64, largest: f64) -> Result<(), BemError>;
    /// Writes the pressure in contact into the field.
    fn give(&self, pressure: &mut [f64]);
    /// Whether the gap of an element is told from the residual as well as in the contact.
    fn is_near(&self, element: usize) -> bool;
    /// Gives the pressure its control.
    fn balance(&self, pressure: &mut [f64]);
    /// How often it was tried to solve, and whether that was too often.
    fn tried(&self) -> (usize, bool);
}

/// A contact that is searched, and how it stands to the conditions.
pub(crate) struct Search<'a, P> {
    problem: &'a mut P,
    /// Where the gaps are evaluated.
    heights: Vec<f64>,
    /// Root mean square of the residual that the solution of any contact may have; less after contacts in vain.
    rough_residual: f64,
    /// Largest residual, relative to [`scale`](Self::scale).
    tolerance: f64,
    pub(crate) contact: Vec<bool>,
    /// Whether no element of it has changed sides.
    is_same: bool,
    pub(crate) pressure: Vec<f64>,
    /// h + K p − d.
    pub(crate) gap: Vec<f64>,
    pub(crate) depth: f64,
    scale: f64,
    /// The largest one, relative to the scale.
    pub(crate) residual: f64,
}

impl<'a, P: MovingContact> Search<'a, P> {
    /// From a guess of the pressure, of which some is positive.
    pub(crate) fn new(
        problem: &'a mut P,
        (heights, rough_residual): (Vec<f64>, f64),
        tolerance: f64,
        mut pressure: Vec<f64>,
    ) -> Self {
        pressure.iter_mut().for_each(|p| *p = p.max(0.0));
        Self {
            contact: pressure.iter().map(|pressure| *pressure > 0.0).collect(),
            is_same: false,
            gap: vec![0.0; pressure.len()],
            problem,
            heights,
            rough_residual,
            tolerance,
            pressure,
            depth: 0.0,
            scale: 0.0,
            residual: f64::INFINITY,
        }
    }

    /// Finds the contact.
    ///
    /// # Errors
    /// [`BemError::ContactNotConverged`]; [`BemError::SingularContact`].
    pub(crate) fn run(&mut self) -> Result<(), BemError> {
        self.problem.balance(&mut self.pressure);
        self.renew_gaps();
        let mut pivots = Pivots::new(self.problem.shape());
        let (mut before, mut hopeless) = (f64::INFINITY, 0);
        loop {
            self.problem.take(&self.contact, &self.pressure, &self.gap);
            let size = self.problem.residual();
            let grows = size > before;
            hopeless += usize::from(grows && self.is_same);
            before = size;
            // What cycles with rough solutions may end with better ones.
            let part = if pivots.are_single() {
                0.0
            } else {
                P::PARTS_OF_RESIDUAL[usize::from(grows)]
            };
            let rough = FINER.powi(pivots.in_vain().min(FINEST)) * self.rough_residual;
            self.problem
                .solve(rough.min(part * size), PART_OF_TOLERANCE * self.allowed())?;
            if self.change(grows, &mut pivots)? {
                return Ok(());
            }
            let (iterations, is_too_often) = self.problem.tried();
            if is_too_often || hopeless > HOPELESS {
                return Err(BemError::ContactNotConverged {
                    iterations,
                    residual: self.residual,
                    tolerance: self.tolerance,
                });
            }
        }
    }

    /// Residual and penetration that count as none.
    fn allowed(&self) -> f64 {
        let rounding = UNITS_OF_DEPTH * f64::EPSILON * self.depth.abs();
        (self.tolerance * self.scale).max(rounding)
    }

    /// Moves elements that violate the conditions to the other side, and says whether the problem is solved; `grows` says that
    /// the change before left a larger residual than the one before it.
    fn change(&mut self, grows: bool, pivots: &mut Pivots) -> Result<bool, BemError> {
        let noise = self.problem.residual();
        self.problem.give(&mut self.pressure);
        let [mut tension, mut total] = [0.0; 2];
        for pressure in &self.pressure {
            tension -= pressure.min(0.0);
            total += pressure;
        }
        if !f64::is_finite(total) {
            let elements = self.contact.iter().filter(|inside| **inside).count();
            return Err(BemError::SingularContact { elements });
        }
        let is_slight = tension <= self.tolerance * total;
        self.problem.balance(&mut self.pressure);
        // With the tension.
        self.renew_gaps();
        let far = HIDING_RESIDUAL * self.residual * self.scale;
        let hidden = if pivots.are_single() {
            [0.0; 2]
        } else {
            [NOISE * noise, far]
        };
        let mut is_solved = self.is_solved();
        let mut violations = self.violations(hidden);
        if tension > TENSE * total {
            violations.retain(|violation| self.contact[violation.element]);
        }
        let chosen = pivots.choose(&violations, grows);
        self.is_same = chosen.is_empty();
        for element in chosen {
            self.contact[element] ^= true;
        }
        if tension > 0.0 {
            self.release();
            self.renew_gaps();
            is_solved = is_slight && self.is_solved();
        }
        Ok(is_solved)
    }

    /// Takes tension away, and as much from the next pressures behind it along the motion. The longest waves along the motion
    /// may be a thousand times softer than all others: they hardly change so, and those with crests along it not at all,
    /// where tension that is just set to zero would throw the surfaces apart.
    fn release(&mut self) {
        let mut tensions = vec![0.0; self.problem.shape()[1]];
        for _ in 0..=usize::from(P::REPEATS) {
            for element in (0..self.contact.len()).rev() {
                let tension = &mut tensions[self.problem.place(element)[1]];
                let sum = self.pressure[element] + *tension;
                let kept = if self.contact[element] {
                    sum.max(0.0)
                } else {
                    0.0
                };
                (self.pressure[element], *tension) = (kept, sum - kept);
            }
        }
        self.problem.balance(&mut self.pressure);
    }

    /// Whether no gap in the contact and no penetration beside it is too large.
    fn is_solved(&self) -> bool {
        let allowed = self.allowed();
        let penetrates = |(gap, inside): (&f64, &bool)| !inside && *gap < -allowed;
        self.residual * self.scale <= allowed && !self.gap.iter().zip(&self.contact).any(penetrates)
    }

    /// The elements on the wrong side; smaller penetrations than those hidden near the contact and far from it, and than what is
    /// allowed, are none.
    fn violations(&self, hidden: [f64; 2]) -> Vec<Violation> {
        let own = self.problem.own_displacement();
        let [near, far] = hidden.map(|hidden| hidden.max(self.allowed()));
        let violation = |element: usize| {
            let [pressure, gap] = [self.pressure[element], self.gap[element]];
            let (size, least) = if self.contact[element] {
                (-pressure * own, 0.0)
            } else if self.problem.is_near(element) {
                (-gap, near)
            } else {
                (-gap, far)
            };
            (size >= least).then(|| Violation {
                element,
                place: self.problem.place(element),
                size,
            })
        };
        (0..self.contact.len()).filter_map(violation).collect()
    }

    /// The gaps under the pressure, and the largest residual.
    fn renew_gaps(&mut self) {
        self.scale = self.problem.displace(&self.pressure, &mut self.gap);
        for (gap, height) in self.gap.iter_mut().zip(&self.heights) {
            *gap += height;
        }
        let contact = &self.contact;
        let in_contact = |(gap, inside): (&f64, &bool)| inside.then_some(*gap);
        self.depth = self.problem.depth(&self.pressure).unwrap_or_else(|| {
            let inside = self.gap.iter().zip(contact).filter_map(in_contact);
            inside.clone().sum::<f64>() / inside.count() as f64
        });
        self.gap.iter_mut().for_each(|gap| *gap -= self.depth);
        let inside = self.gap.iter().zip(contact).filter_map(in_contact);
        self.residual = inside.fold(0.0, |top, gap| larger(top, gap.abs())) / self.scale;
    }
}
