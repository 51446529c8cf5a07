//! Sub-grid errors: contributions of lengths below one element, which may be equal on all resolutions.
//!
//! ```text
//! F' = 4 [w Δx/2 + w' + Σ_k G_k l_k² |r/Δx − h̃'| + 2 Σ_k G_k l_k Σ_j |r_j − r_(j−1)|],   l_k = min(Δx, v τ_k)
//! H' = 4 [(w Δx/2 + w') |h̃'| + (η₀ v + Σ_k G_k l_k) (∫ h̃'² dx − r²/Δx)
//!         + w_f (h_(f+1) − d)⁺ + Σ_k ½ G_k min(1, Δx/(v τ_k)) Σ_j (r_j − r_(j−1))²]
//! δd = d F'/F_N,   δμ = H'/F_N + 2 μ F'/F_N
//! ```
//! F' and H' bound the missing normal and tangential force; r_j is the rise of the line over element j up to the depth.
//!
//! - The contact may continue behind its rearmost element, with the load w of this element at the end of the step. It ends
//!   at the slope h̃' there and not at the mean r/Δx over the last element.
//! - Where the slope jumps there, as at the tip of a cone, the stress of the branches decays over the lengths l_k behind it:
//!   w' = Σ_k G_k l_k² |δh̃'|, at most w Δx/2.
//! - A tip inside an element is steeper than the mean.
//! - At a steep kink the foremost element f has the slope up to its neighbour, although the contact ends at the depth d.
//! - Branches that relax within a step may store half of G_k r², and carry G_k r over v τ_k, while an element rises by r.
//!   The step does not resolve this. Of an even rise r_j = r_(j−1), so that only the difference counts.

use indenters::RigidLine;
use rheology::Material;

use crate::line::{ElementHeights, has_steep_kinks};

/// Chords by which the tip in an element at the lowest point is resolved.
const N_TIP_CHORDS: usize = 64;
/// Distance from the lowest point to the inner end of a chord, relative to that to its outer end.
const TIP_CHORD_RATIO: f64 = 0.75;
/// Factor on the sum over the chords of a tip; of a power x⁴ they leave out a tenth.
const TIP_EXCESS_FACTOR: f64 = 1.25;

/// Moduli of a material that act within a step, over 2 (1 − ν).
pub(super) struct StepScaleModuli {
    /// η₀ v, \[Pa m].
    viscous: f64,
    /// Σ G_k min(1, Δx/(v τ_k)), \[Pa].
    stored: f64,
    /// Σ G_k l_k, \[Pa m].
    carried: f64,
    /// Σ G_k l_k², [Pa m²].
    left: f64,
}

/// The last step of a march.
pub(super) struct LastStep<'a> {
    pub(super) elements: &'a ElementHeights,
    /// Load potentials, \[Pa].
    pub(super) loads: &'a [f64],
    /// Indentation depth, \[m].
    pub(super) depth: f64,
    /// Normal force F_N, \[N].
    pub(super) normal_force: f64,
    pub(super) moduli: &'a StepScaleModuli,
}

/// Contributions to tangential and normal force, or their ratios to the normal force.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct SubgridForces {
    pub(super) tangential: f64,
    pub(super) normal: f64,
}

impl StepScaleModuli {
    /// The moduli at a velocity \[m/s], for steps of one spacing \[m].
    pub(super) fn new(material: &dyn Material, velocity: f64, spacing: f64) -> Self {
        let relaxation = material.relaxation();
        let sum = |weight: fn(f64, f64) -> f64| -> f64 {
            let branches = relaxation.branches().iter();
            let terms = branches.map(|b| b.modulus * weight(spacing, velocity * b.relaxation_time));
            terms.sum::<f64>() / material.half_space_factor()
        };
        Self {
            viscous: relaxation.viscosity() * velocity / material.half_space_factor(),
            stored: sum(|spacing, length| (spacing / length).min(1.0)),
            carried: sum(f64::min),
            left: sum(|spacing, length| spacing.min(length).powi(2)),
        }
    }
}

impl LastStep<'_> {
    /// H'/F_N and F'/F_N.
    pub(super) fn relative_errors(&self, line: &dyn RigidLine) -> SubgridForces {
        let is_loaded = |load: &f64| *load > 0.0;
        let Some(rear) = self.loads.iter().position(is_loaded) else {
            return SubgridForces::default();
        };
        let mut parts = self.behind_rearmost(line, rear);
        parts.tangential += (self.moduli.viscous + self.moduli.carried) * self.tip_excess(line);
        if has_steep_kinks(line) {
            let at_kinks = self.at_steep_kinks();
            parts.tangential += at_kinks.tangential;
            parts.normal += at_kinks.normal;
        }
        SubgridForces {
            tangential: 4.0 * parts.tangential / self.normal_force,
            normal: 4.0 * parts.normal / self.normal_force,
        }
    }

    /// Contribution of the contact behind the rearmost element; none at the rear end of the line.
    fn behind_rearmost(&self, line: &dyn RigidLine, rear: usize) -> SubgridForces {
        let position = self.elements.position(rear);
        let [slope, slope_behind] = [position, position.next_down()].map(|x| line.slope(x));
        let mean = self.rise(rear) / self.elements.spacing;
        if rear == 0 || !(slope.is_finite() && slope_behind.is_finite() && mean.is_finite()) {
            return SubgridForces::default();
        }
        let per_slope = self.moduli.viscous + self.moduli.carried;
        let load = (self.loads[rear] - per_slope * (mean - slope_behind)).max(0.0);
        let spacing = self.elements.spacing;
        // A decaying load is a convex function of the distance, so that its mean is at most half of its first value.
        let fading = self.moduli.left * (slope - slope_behind).abs();
        let carried = 0.5 * load * spacing + fading.min(0.5 * self.loads[rear] * spacing);
        SubgridForces {
            tangential: carried * slope_behind.abs(),
            normal: carried + self.moduli.left * (mean - slope).abs(),
        }
    }

    /// ∫ h̃'² dx beyond that of the mean slopes, in the loaded elements next to the lowest point, \[m].
    ///
    /// It is summed over chords that become shorter towards that point.
    fn tip_excess(&self, line: &dyn RigidLine) -> f64 {
        let ElementHeights {
            anchor_index,
            lowest_height,
            spacing,
            ..
        } = *self.elements;
        let anchor = self.elements.position(anchor_index);
        let sides = [
            (Some(anchor_index), spacing),
            (anchor_index.checked_sub(1), -spacing),
        ];
        let loaded = sides.into_iter().filter(|(element, _)| {
            let load = element.and_then(|element| self.loads.get(element));
            load.is_some_and(|load| *load > 0.0)
        });
        let excess = |step: f64| {
            let rise = |part: f64| line.height(anchor + part * step) - lowest_height;
            let (mut part, mut above) = (1.0, rise(1.0));
            let mut squares = -above * above;
            for _ in 0..N_TIP_CHORDS {
                let (nearer, below) = (TIP_CHORD_RATIO * part, rise(TIP_CHORD_RATIO * part));
                squares += (above - below).powi(2) / (part - nearer);
                (part, above) = (nearer, below);
            }
            (squares + above * above / part) / spacing
        };
        loaded
            .map(|(_, step)| TIP_EXCESS_FACTOR * excess(step).max(0.0))
            .sum()
    }

    /// Contribution of elements whose rise differs from that in the step before.
    fn at_steep_kinks(&self) -> SubgridForces {
        let (mut beyond, mut jumps, mut squares) = (0.0, 0.0, 0.0);
        let n_elements = self.elements.heights.len();
        let loaded = self.loads.iter().enumerate().take(n_elements - 1);
        for (element, load) in loaded.filter(|(_, load)| **load > 0.0) {
            let before = if element > 0 {
                self.rise(element - 1)
            } else {
                0.0
            };
            let jump = self.rise(element) - before;
            jumps += jump.abs();
            squares += jump * jump;
            beyond = load * (self.elements.heights[element + 1] - self.depth).max(0.0);
        }
        SubgridForces {
            tangential: beyond + 0.5 * self.moduli.stored * squares,
            normal: 2.0 * self.moduli.carried * jumps,
        }
    }

    /// Rise of the line over an element during the step, up to the depth, \[m].
    fn rise(&self, element: usize) -> f64 {
        let heights = &self.elements.heights;
        let next = heights
            .get(element + 1)
            .map_or(self.depth, |height| height.min(self.depth));
        next - heights[element]
    }
}
