//! Balance of the forces of all elements in one step: the depth that carries a normal force.
//!
//! ```text
//! f = 4 η Δx du/dt                                   (10)
//! f_i = (4 Δx / α) max(0, d − h_i − u_i)              over one implicit step of compliance α
//! Σ (d − h_i − u_i)⁺ = α F_N / (4 Δx)
//! ```
//! The load potential of an element under the force f is w = f/(4 Δx), and a step moves the element by α w. The sum is a
//! convex, increasing, piecewise linear function of the depth, so that Newton's method ends at the exact solution.

use super::compensated::CompensatedSum;

/// A rigid line over the elements of a foundation at the end of a step, before the depth is known.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ForceBalance<'a> {
    /// Heights h_i of the line over each element, above its lowest point, \[m]; `+∞` where there is no body.
    pub(crate) heights: &'a [f64],
    /// Displacements u_i that the elements would have at the end of the step without load, \[m].
    pub(crate) displacements: &'a [f64],
}

/// A depth, and the elements that are compressed there.
#[derive(Debug, Clone, Copy)]
pub(crate) struct TrialDepth {
    /// Indentation depth d, \[m].
    pub(crate) depth: f64,
    /// Number of compressed elements.
    pub(crate) n_below: usize,
    /// Sum of their compressions, \[m].
    pub(crate) compression: f64,
}

impl ForceBalance<'_> {
    /// The depth at which the compressions add up to `needed` ≥ 0 \[m], by Newton's method from the elements below `guess`.
    ///
    /// If `needed` is 0 the line just touches the first element. After the first step the iterates decrease to the solution,
    /// and their sets of elements are nested. When a step loses no element, the equation is linear between its two depths
    /// and solved. Let f be the excess of force and g the number of elements, and f', g' their values after the next step.
    /// Convexity gives f'/f + g'/g ≤ 1, so that f g falls by a factor of four or more. The number of steps is therefore
    /// logarithmic; with a good guess it is two or three.
    pub(crate) fn solve(&self, needed: f64, guess: f64) -> TrialDepth {
        let first_trial = self.at_depth(guess);
        let mut trial = self.at_depth(match first_trial.n_below {
            0 => self.first_contact_depth() + needed,
            _ => first_trial.newton_depth(needed),
        });
        while trial.n_below > 0 {
            let before = trial;
            trial = self.at_depth(before.newton_depth(needed));
            // A step from far above carries the rounding of the larger depth; it is then repeated.
            if trial.n_below >= before.n_below && before.depth.abs() <= 2.0 * trial.depth.abs() {
                break;
            }
        }
        trial
    }

    /// The number of compressed elements at a depth \[m], and the sum of their compressions.
    pub(crate) fn at_depth(&self, depth: f64) -> TrialDepth {
        let mut n_below = 0;
        let mut compression = CompensatedSum::default();
        for contact_depth in self.contact_depths() {
            if contact_depth < depth {
                n_below += 1;
                compression.add(depth - contact_depth);
            }
        }
        TrialDepth {
            depth,
            n_below,
            compression: compression.value(),
        }
    }

    /// Depth at which the line touches the first element, \[m].
    pub(crate) fn first_contact_depth(&self) -> f64 {
        self.contact_depths().fold(f64::INFINITY, f64::min)
    }

    /// Depth at which the line touches each element, \[m].
    fn contact_depths(&self) -> impl Iterator<Item = f64> {
        let elements = self.heights.iter().zip(self.displacements);
        elements.map(|(height, displacement)| height + displacement)
    }
}

impl TrialDepth {
    /// The depth \[m] at which the compressions of the same elements add up to `needed`, \[m].
    fn newton_depth(self, needed: f64) -> f64 {
        self.depth + (needed - self.compression) / self.n_below as f64
    }
}

#[cfg(test)]
mod tests;
