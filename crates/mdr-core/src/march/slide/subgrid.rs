//! Sub-grid errors: contributions of lengths below one element, which may be equal on all resolutions.
//!
//! ```text
//! F' = 4 [w' Δx/2 + Σ_k G_k l_k² |r/Δx − h̃'|],   l_k = min(Δx, v τ_k)
//! H' = 4 [w' Δx/2 |h̃'| + (η₀ v + Σ_k G_k l_k) (∫ h̃'² dx − r²/Δx) + Σ_k ½ G_k min(1, Δx/(v τ_k)) Σ_j (r_j − r_(j−1))²]
//! δd = d F'/F_N,   δμ = H'/F_N + 2 μ F'/F_N
//! ```
//! F' and H' bound the normal and tangential force that one resolution misses; G_k, τ_k are the branches of the material, over
//! 2 (1 − ν), and η₀ is its parallel dashpot; r_j is the rise of the line over element j up to the depth, r that of a single element.
//!
//! - The contact may continue behind its rearmost element, where the slope h̃' is not the mean slope of the element behind.
//!   The load that this difference δh̃' gives is w' = (η₀ v + Σ_k G_k l_k) |δh̃'|, at most that of the rearmost element. The
//!   contact ends at the slope h̃' there and not at the mean r/Δx over the last element.
//! - A tip inside an element is steeper than the mean.
//! - At steep kinks branches that relax within a step may store half of G_k r² while an element rises by r. Of an even rise
//!   r_j = r_(j−1), so that only the difference counts.

use indenters::RigidLine;
use numerics::whole_part;
use rheology::Material;

use crate::line::{ElementHeights, has_steep_kinks};

/// Number of chords that approximate the profile on either side of the lowest point over one element. Derived: the innermost ends
/// at 0.75⁶⁴, or 1e-8, of the element.
const N_TIP_CHORDS: usize = 64;
/// Ratio of the distances from the lowest point to the inner and to the outer end of a chord. Chosen: a ratio closer to 1 takes
/// more chords and leaves out less, for which [`TIP_EXCESS_FACTOR`] stands.
const TIP_CHORD_RATIO: f64 = 0.75;
/// Factor on the sum over the chords of a tip, for the part of the integral that chords leave out. Derived for chords of the
/// ratio 0.75: this part is a tenth of the excess of a power x⁴ and a fifth of that of x⁶, for which the factor is exact.
const TIP_EXCESS_FACTOR: f64 = 1.25;

/// Moduli of a material that act within a step; η₀ and G_k are those of the material over 2 (1 − ν).
struct StepScaleModuli {
    /// 4 (η₀ v + Σ G_k l_k), \[N/m]: load per length and slope.
    load_per_slope: f64,
    /// 4 Σ G_k min(1, Δx/(v τ_k)), \[Pa]: modulus of the energy that branches may store within a step.
    stored_modulus: f64,
    /// 4 Σ G_k l_k², \[N]: force per change of the slope at the rear end of the contact.
    force_per_slope: f64,
}

/// The contact at the end of sliding.
pub(super) struct LastContact<'a> {
    /// Rigid line that slides.
    pub(super) line: &'a dyn RigidLine,
    /// Elements under the line, with their spacing.
    pub(super) elements: &'a ElementHeights,
    /// Positions \[m] and loads per length \[N/m].
    pub(super) load: &'a [[f64; 2]],
    /// Indentation depth, \[m].
    pub(super) depth: f64,
    /// Velocity, \[m/s].
    pub(super) velocity: f64,
}

/// Bounds of the forces that one resolution misses.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct SubgridForces {
    /// Tangential force H', \[N].
    pub(super) tangential: f64,
    /// Normal force F', \[N].
    pub(super) normal: f64,
}

impl StepScaleModuli {
    /// Moduli of a material that act within a step of one `spacing` \[m] at a velocity \[m/s].
    fn new(material: &dyn Material, velocity: f64, spacing: f64) -> Self {
        let relaxation = material.relaxation();
        let unit = 4.0 / material.half_space_factor();
        let sum = |weight: fn(f64, f64) -> f64| -> f64 {
            let branches = relaxation.branches().iter();
            let terms = branches.map(|b| b.modulus * weight(spacing, velocity * b.relaxation_time));
            unit * terms.sum::<f64>()
        };
        Self {
            load_per_slope: unit * relaxation.viscosity() * velocity + sum(f64::min),
            stored_modulus: sum(|spacing, length| (spacing / length).min(1.0)),
            force_per_slope: sum(|spacing, length| spacing.min(length).powi(2)),
        }
    }
}

impl LastContact<'_> {
    /// Bounds H' and F' of the forces that this resolution misses, on a material with relaxation branches.
    pub(super) fn subgrid_forces(&self, material: &dyn Material) -> SubgridForces {
        let spacing = self.elements.spacing;
        let moduli = StepScaleModuli::new(material, self.velocity, spacing);
        // `loads` extends the loads around the last contact to all elements; the others carry nothing.
        let mut loads = vec![0.0; self.elements.heights.len()];
        for [x, load] in self.load.iter().filter(|[_, load]| *load > 0.0) {
            let element = whole_part((x - self.elements.position(0)) / spacing + 0.5);
            if let Some(slot) = loads.get_mut(element) {
                *slot = *load;
            }
        }
        // Add the three contributions; the last one matters at steep kinks only.
        let mut forces = self.behind_rearmost(&moduli, &loads);
        forces.tangential += moduli.load_per_slope * self.tip_excess(&loads);
        if has_steep_kinks(self.line) {
            forces.tangential += 0.5 * moduli.stored_modulus * self.squared_jumps_of_rise(&loads);
        }
        forces
    }

    /// Contribution of the contact behind the rearmost loaded element; 0 at the rear end of the line.
    ///
    /// `loads` are the loads per length \[N/m] of all elements, 0 of free ones.
    fn behind_rearmost(&self, moduli: &StepScaleModuli, loads: &[f64]) -> SubgridForces {
        let Some(rear) = loads
            .iter()
            .position(|load| *load > 0.0)
            .filter(|rear| *rear > 0)
        else {
            return SubgridForces::default();
        };
        let spacing = self.elements.spacing;
        let heights = &self.elements.heights;
        let position = self.elements.position(rear);
        // The slopes of the line on both sides of the rearmost element are compared with its mean slopes over that element and
        // over the one behind.
        let [slope, slope_behind] = [position, position.next_down()].map(|x| self.line.slope(x));
        let mean = self.rise(rear) / spacing;
        let mean_behind = (heights[rear] - heights[rear - 1]) / spacing;
        if !(slope.is_finite() && slope_behind.is_finite() && mean.is_finite()) {
            return SubgridForces::default();
        }
        // `load` is what the rearmost element would carry on the slope behind it; the missing load is at most that.
        let load = (loads[rear] - moduli.load_per_slope * (mean - slope_behind)).max(0.0);
        let difference = moduli.load_per_slope * (slope_behind - mean_behind).abs();
        let carried = 0.5 * spacing * load.min(difference);
        SubgridForces {
            tangential: carried * slope_behind.abs(),
            normal: carried + moduli.force_per_slope * (mean - slope).abs(),
        }
    }

    /// ∫ h̃'² dx beyond that of the mean slopes, in the loaded elements next to the lowest point, \[m].
    ///
    /// It is summed over chords that become shorter towards that point. `loads` are those per length of all elements.
    fn tip_excess(&self, loads: &[f64]) -> f64 {
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
            let load = element.and_then(|element| loads.get(element));
            load.is_some_and(|load| *load > 0.0)
        });
        let excess = |step: f64| {
            let rise = |part: f64| self.line.height(anchor + part * step) - lowest_height;
            // Sum the squared slopes of the chords, less that of the mean slope over the element.
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

    /// Σ (r_j − r_(j−1))² over the loaded elements, \[m²].
    fn squared_jumps_of_rise(&self, loads: &[f64]) -> f64 {
        let loaded = (0..loads.len()).filter(|element| loads[*element] > 0.0);
        let jump = |element: usize| {
            let before = element
                .checked_sub(1)
                .map_or(0.0, |before| self.rise(before));
            self.rise(element) - before
        };
        loaded.map(|element| jump(element).powi(2)).sum()
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
