//! The chain in motion.

use indenters::{Control, RigidLine, SlidingLoad};
use numerics::positive;
use rheology::Material;

use super::row::SlideRow;
use crate::MdrError;
use crate::chain::{Chain, Contact, is_elastic};
use crate::compensated::CompensatedSum;
use crate::element_heights::ElementHeights;
use crate::error::{enough_elements, finite};

/// A line moving over a chain. All lists run from the rear to the front of the line.
pub(super) struct March {
    chain: Chain,
    /// Mean slope that an element meets during the step to which its force belongs.
    mean_slopes: Vec<f64>,
    /// h̃'(x) at the end of a step.
    end_slopes: Vec<f64>,
    /// Σ G_k min(1, Δx/(v τ_k)) \[Pa] and Σ G_k min(Δx, v τ_k) \[Pa m], of what is relaxed after a step.
    fast_moduli: [f64; 2],
    normal_force: f64,
    time_step: f64,
    n_steps: usize,
}

/// Errors that all resolutions may have in common.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub(super) struct Unresolved {
    pub(super) friction_coefficient: f64,
    /// \[m].
    pub(super) indentation_depth: f64,
}

/// The state at the end of a step.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stepped {
    pub(super) row: SlideRow,
    /// Number of elements from the rearmost to the foremost loaded one.
    pub(super) span: usize,
    /// Friction coefficient if all slopes were uphill, which says what rounding is.
    pub(super) steepness: f64,
}

/// What the loaded elements of a step sum up to: parts of the force times slopes.
#[derive(Debug, Clone, Copy, Default)]
struct Sums {
    /// With the mean slope that an element meets during the step.
    mean_slope: CompensatedSum,
    /// The same with the modulus of the slope.
    steepness: f64,
    /// With the slope of the line at the end of the step.
    end_slope: CompensatedSum,
}

impl March {
    /// A chain at rest under the elements of the line, touched at the lowest one.
    pub(super) fn from_first_touch(
        line: &(impl RigidLine + ?Sized),
        sampled: ElementHeights,
        material: &(impl Material + ?Sized),
        load: &SlidingLoad,
    ) -> Result<Self, MdrError> {
        let (n_elements, spacing) = (sampled.heights.len(), sampled.spacing);
        let time_step = spacing / load.velocity();
        let chain = Chain::new(sampled, material, time_step)?;
        let normal_force = load.require_normal_force()?;
        positive("compression", chain.element.compression(normal_force))?;
        let pairs = chain.line.heights.windows(2);
        let slopes: Vec<f64> = pairs.map(|h| (h[1] - h[0]) / spacing).collect();
        let positions = (0..n_elements).map(|element| chain.line.position(element));
        let end_slopes = positions.map(|x| line.slope(x)).collect();
        let mut mean_slopes = mean_slopes(&slopes, chain.elastic_share());
        // The last element never carries load: see `advance`.
        mean_slopes.push(f64::INFINITY);
        Ok(Self {
            mean_slopes,
            end_slopes,
            chain,
            fast_moduli: fast_moduli(material, load.velocity(), spacing),
            normal_force,
            time_step,
            n_steps: 0,
        })
    }

    /// Distance slid at the end of the step to come, \[m].
    pub(super) fn next_sliding_distance(&self) -> f64 {
        (self.n_steps + 1) as f64 * self.chain.line.spacing
    }

    /// One step; nothing at a depth at which elements would be needed that the chain has not.
    pub(super) fn advance(&mut self) -> Result<Option<Stepped>, MdrError> {
        self.n_steps += 1;
        let time = self.n_steps as f64 * self.time_step;
        self.chain.travel();
        let depth_before = self.chain.depth;
        let (mean_slopes, end_slopes) = (&self.mean_slopes, &self.end_slopes);
        let whole = self.chain.element.compression(self.normal_force);
        let mut sums = Sums::default();
        let add = |here: usize, compression: f64| {
            // The product of a compression and a slope may be too small for a number where its part of the force is not.
            let part = compression / whole;
            sums.mean_slope.add(part * mean_slopes[here]);
            sums.steepness += part * mean_slopes[here].abs();
            sums.end_slope.add(part * end_slopes[here]);
        };
        let control = Control::NormalForce(self.normal_force);
        let contact = self.chain.press(control, time, add)?;
        if contact.indentation_depth > self.chain.line.ceiling {
            return Ok(None);
        }
        let Some([rear, front]) = contact.ends else {
            return enough_elements(0, self.chain.line.spacing).map(|()| None);
        };
        if front + 1 == self.chain.line.heights.len() {
            return Err(self.chain.reaches_edge(front, time));
        }
        // The slopes of a contact that ends inside the line sum up to nothing on springs.
        if is_elastic(&self.chain.creep) && rear > 0 {
            sums.mean_slope = CompensatedSum::default();
        }
        Ok(Some(Stepped {
            row: self.row(&contact, [rear, front], &sums, depth_before)?,
            span: front + 1 - rear,
            steepness: sums.steepness,
        }))
    }

    /// What a line that rises by more than its neighbours do within one element may do to the last step.
    ///
    /// ```text
    /// δμ = w_f (h_(f+1) − d)⁺/Δx · 4 Δx/F_N + (2/F_N) Σ_k G_k min(1, Δx/(v τ_k)) Σ_j (r_j − r_(j−1))²
    /// δd/d = (8/F_N) Σ_k G_k min(Δx, v τ_k) Σ_j |r_j − r_(j−1)|
    /// ```
    /// The foremost element f meets the slope up to its neighbour, although the contact ends at the depth d; and branches
    /// that relax within a step may store half of G_k r², and carry G_k r over v τ_k, while an element rises by r, which is
    /// r_(j−1) where it rises evenly, and which the step does not see.
    pub(super) fn unresolved(&self) -> Unresolved {
        let (heights, depth) = (&self.chain.line.heights, self.chain.depth);
        let rise = |element: usize| heights[element + 1].min(depth) - heights[element];
        let (mut beyond, mut jumps, mut squares) = (0.0, 0.0, 0.0);
        for (element, part) in self.chain.forces().enumerate() {
            if part > 0.0 && element + 1 < heights.len() {
                let before = if element > 0 { rise(element - 1) } else { 0.0 };
                let jump = rise(element) - before;
                jumps += jump.abs();
                squares += jump * jump;
                beyond = part * (heights[element + 1] - depth).max(0.0) / self.chain.line.spacing;
            }
        }
        let [stored, carried] = self.fast_moduli;
        Unresolved {
            friction_coefficient: (beyond + 2.0 * stored * squares) / self.normal_force,
            indentation_depth: depth * (8.0 * carried * jumps / self.normal_force),
        }
    }

    fn row(
        &self,
        contact: &Contact,
        ends: [usize; 2],
        sums: &Sums,
        depth_before: f64,
    ) -> Result<SlideRow, MdrError> {
        let line = &self.chain.line;
        let time = self.n_steps as f64 * self.time_step;
        let friction = sums.mean_slope.value();
        let end_of_step = sums.end_slope.value();
        let depth = contact.indentation_depth;
        Ok(SlideRow {
            sliding_distance: self.n_steps as f64 * line.spacing,
            time,
            indentation_depth: depth,
            friction_coefficient: finite("friction coefficient", friction, time)?,
            friction_coefficient_end_of_step: end_of_step.is_finite().then_some(end_of_step),
            sinking_velocity: (depth - depth_before) / self.time_step,
            contact: ends.map(|element| line.position(element)),
            n_contact: contact.n_contact,
            contact_length: contact.n_contact as f64 * line.spacing,
        })
    }
}

fn fast_moduli(material: &(impl Material + ?Sized), velocity: f64, spacing: f64) -> [f64; 2] {
    let relaxation = material.relaxation();
    let sum = |weight: fn(f64, f64) -> f64| -> f64 {
        let branches = relaxation.branches().iter();
        let terms = branches.map(|b| b.modulus * weight(spacing, velocity * b.relaxation_time));
        terms.sum::<f64>() / material.half_space_factor()
    };
    [
        sum(|spacing, length| (spacing / length).min(1.0)),
        sum(f64::min),
    ]
}

/// Slopes [h̃(x + Δx) − h̃(x)]/Δx during a step that ends at x, and for the elastic share those around its end.
///
/// The force of a dashpot belongs to the motion during the step, that of a spring to where the step ends.
fn mean_slopes(slopes: &[f64], elastic_share: f64) -> Vec<f64> {
    let rear = slopes.first().into_iter();
    let before = rear.chain(slopes);
    let mean = |(slope, before): (&f64, &f64)| slope - 0.5 * elastic_share * (slope - before);
    slopes.iter().zip(before).map(mean).collect()
}
