//! The chain in motion.

use indenters::{RigidLine, SlidingLoad};
use rheology::Material;

use super::row::{MIN_CONTACT, SlideRow};
use crate::MdrError;
use crate::chain::Chain;
use crate::compensated::CompensatedSum;
use crate::contact::Contact;
use crate::element_heights::ElementHeights;
use crate::error::{finite, positive};

/// A line moving over a chain. All lists run from the rear to the front of the line.
pub(super) struct March {
    line: ElementHeights,
    chain: Chain,
    /// Mean slope that an element meets during the step to which its force belongs.
    mean_slopes: Vec<f64>,
    /// h̃'(x) at the end of a step.
    end_slopes: Vec<f64>,
    /// Σ G_k min(1, Δx/(v τ_k)) \[Pa] and Σ G_k min(Δx, v τ_k) \[Pa m], of what is relaxed after a step.
    fast_moduli: [f64; 2],
    normal_force: f64,
    time_step: f64,
    spacing: f64,
    n_steps: usize,
    depth: f64,
}

/// What a step has led to.
pub(super) enum Advance {
    /// The state at its end.
    Stepped(Stepped),
    /// A depth at which elements would be needed that the chain has not.
    TooDeep,
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

impl March {
    /// A chain at rest under the elements of the line, touched at the lowest one.
    pub(super) fn from_first_touch(
        line: &(impl RigidLine + ?Sized),
        sampled: ElementHeights,
        material: &(impl Material + ?Sized),
        load: &SlidingLoad,
        spacing: f64,
    ) -> Result<Self, MdrError> {
        let n_elements = sampled.heights.len();
        let time_step = spacing / load.velocity();
        let chain = Chain::new(material, n_elements, spacing, time_step)?;
        let normal_force = load.require_normal_force()?;
        let compression = chain.element().compression(normal_force);
        positive("compression", compression)?;
        let end_slopes = (0..n_elements)
            .map(|element| line.slope(sampled.position(element)))
            .collect();
        let pairs = sampled.heights.windows(2);
        let slopes: Vec<f64> = pairs.map(|h| (h[1] - h[0]) / spacing).collect();
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
            spacing,
            n_steps: 0,
            depth: 0.0,
            line: sampled,
        })
    }

    /// Distance slid at the end of the step to come, \[m].
    pub(super) fn next_sliding_distance(&self) -> f64 {
        (self.n_steps + 1) as f64 * self.spacing
    }

    /// One step.
    pub(super) fn advance(&mut self) -> Result<Advance, MdrError> {
        self.n_steps += 1;
        let time = self.n_steps as f64 * self.time_step;
        self.chain.travel();
        self.chain.relax();
        let instant = self.chain.instant(&self.line.heights);
        let contact = instant.solve(self.normal_force, self.depth);
        let depth = finite("indentation depth", contact.indentation_depth, time)?;
        if depth > self.line.ceiling {
            return Ok(Advance::TooDeep);
        }
        if contact.n_contact == 0 {
            return Err(MdrError::TooCoarse {
                n_contact: 0,
                needed: MIN_CONTACT,
                spacing: self.spacing,
            });
        }
        let loaded = self.settle(depth);
        if loaded.front + 1 == self.line.heights.len() {
            return Err(MdrError::ContactReachesEdge {
                position: self.line.position(loaded.front),
                indentation_depth: depth,
                time,
            });
        }
        let row = self.row(contact, loaded, time)?;
        self.depth = depth;
        Ok(Advance::Stepped(Stepped {
            row,
            span: loaded.front + 1 - loaded.rear,
            steepness: loaded.steepness,
        }))
    }

    /// Moves every element to the end of the step, and sums what the loaded ones exert on the line.
    fn settle(&mut self, depth: f64) -> Loaded {
        let mut loaded = Loaded::new(self.line.heights.len());
        let (mean_slopes, end_slopes) = (&self.mean_slopes, &self.end_slopes);
        let whole = self.chain.element().compression(self.normal_force);
        self.chain
            .load(&self.line.heights, depth, |here, compression| {
                loaded.rear = loaded.rear.min(here);
                loaded.front = here;
                // The product of a compression and a slope may be too small for a number where its part of the force is not.
                let part = compression / whole;
                loaded.mean_slope.add(part * mean_slopes[here]);
                loaded.steepness += part * mean_slopes[here].abs();
                loaded.end_slope.add(part * end_slopes[here]);
            });
        loaded
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
        let heights = &self.line.heights;
        let rise = |element: usize| heights[element + 1].min(self.depth) - heights[element];
        let (mut beyond, mut jumps, mut squares) = (0.0, 0.0, 0.0);
        for (element, part) in self.chain.forces().enumerate() {
            if part > 0.0 && element + 1 < heights.len() {
                let before = if element > 0 { rise(element - 1) } else { 0.0 };
                let jump = rise(element) - before;
                jumps += jump.abs();
                squares += jump * jump;
                beyond = part * (heights[element + 1] - self.depth).max(0.0) / self.spacing;
            }
        }
        let [stored, carried] = self.fast_moduli;
        Unresolved {
            friction_coefficient: (beyond + 2.0 * stored * squares) / self.normal_force,
            indentation_depth: self.depth * (8.0 * carried * jumps / self.normal_force),
        }
    }

    fn row(&self, contact: Contact, loaded: Loaded, time: f64) -> Result<SlideRow, MdrError> {
        // The slopes of a contact that ends inside the line sum up to nothing on springs.
        let friction = if self.chain.is_elastic() && loaded.rear > 0 {
            0.0
        } else {
            loaded.mean_slope.value()
        };
        let end_of_step = loaded.end_slope.value();
        let depth = contact.indentation_depth;
        Ok(SlideRow {
            sliding_distance: self.n_steps as f64 * self.spacing,
            time,
            indentation_depth: depth,
            friction_coefficient: finite("friction coefficient", friction, time)?,
            friction_coefficient_end_of_step: end_of_step.is_finite().then_some(end_of_step),
            sinking_velocity: (depth - self.depth) / self.time_step,
            contact: [loaded.rear, loaded.front].map(|element| self.line.position(element)),
            n_contact: contact.n_contact,
            contact_length: contact.n_contact as f64 * self.spacing,
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

/// What the loaded elements of a step sum up to.
#[derive(Debug, Clone, Copy)]
struct Loaded {
    rear: usize,
    front: usize,
    /// Σ part of the force · mean slope that the element meets during the step.
    mean_slope: CompensatedSum,
    /// The same with the modulus of the slope.
    steepness: f64,
    /// Σ part of the force · slope of the line at the end of the step.
    end_slope: CompensatedSum,
}

impl Loaded {
    fn new(n_elements: usize) -> Self {
        Self {
            rear: n_elements,
            front: 0,
            mean_slope: CompensatedSum::default(),
            steepness: 0.0,
            end_slope: CompensatedSum::default(),
        }
    }
}
