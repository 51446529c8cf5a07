//! Slope of the body under the pressure of a step, at the time level at which the two belong together.
//!
//! ```text
//! F_h = Σ P ∂h/∂x ΔA,      ∂h/∂x at x + θ v Δt,      θ = ½ (1 − E G'(ω)),      ω = 2πv/L
//! E = J₀ + Σ J_k (1 − 2 m_k)/(1 + ω²λ_k²),      m_k = λ_k/Δt − 1/(e^(Δt/λ_k) − 1)
//! ```
//! J₀ is the instantaneous compliance, J_k and λ_k are the compliance and the retardation time of element k, G' is the storage
//! modulus, v the velocity and Δt the duration of the step.
//!
//! The pressure on a dashpot belongs to the motion during the step (θ = ½). The pressure on a spring, or on a retardation
//! element that relaxes within the step, belongs to the end of the step (θ = 0). In between, θ follows from the moduli at the
//! frequency ω with which a contact of length L passes. A load that is linear over the step belongs to its end.
//!
//! The slope is that of a chord over one element, or over the distance 2 θ v Δt of a longer step, so that it exists at a cusp.
//!
//! Theory: docs/theory/transient-half-space.md, "Time level of the slope" and "Linear loads".

use std::f64::consts::PI;

use numerics::in_range;

use crate::BemError;
use crate::march::free::{March, ScheduledStep};

/// Mean slopes ∂h/∂x of the body over the loaded elements, weighted with their pressure; all zero without contact.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct MeanSlopes {
    /// Time level θ: pressure and forces belong to the time θ Δt before the end of the step, from 0 to ½.
    pub(super) time_level: f64,
    /// Mean slope at the time level θ: F_h / F_N.
    pub(super) at_time_level: f64,
    /// Mean of ∂h/∂x at the end of the step.
    pub(super) end_of_step: f64,
    /// Mean modulus of the slope at the time level θ.
    pub(super) mean_slope_modulus: f64,
    /// Largest slope at the time level θ; largest modulus of the slope if a mirror at x = 0 leaves only the half x ≥ 0.
    pub(super) largest: f64,
}

impl MeanSlopes {
    /// Mean slopes under the pressure of the step that was solved last, which is `step`. Fails at a vertical wall in contact.
    pub(super) fn over(march: &March<'_>, step: &ScheduledStep) -> Result<Self, BemError> {
        let time_level = time_level(march, step)?;
        let mut sum = Self {
            time_level,
            ..Self::default()
        };
        // Add up the slopes of the loaded elements, weighted with their loads, for the means over the total load.
        let mut total_load = 0.0;
        // If x = 0 is a mirror, each element has an image of the opposite slope, so that the mean slopes vanish.
        let has_image = !march.layout.mirrors[0].is_none();
        for (element, load) in march.loaded_elements() {
            let [slope, end] = slopes_at(march, time_level, step, element)?;
            if !has_image {
                sum.at_time_level += load * slope;
                sum.end_of_step += load * end;
            }
            sum.mean_slope_modulus += load * slope.abs();
            sum.largest = sum.largest.max(if has_image { slope.abs() } else { slope });
            total_load += load;
        }
        if total_load == 0.0 {
            return Ok(sum);
        }
        Ok(Self {
            at_time_level: sum.at_time_level / total_load,
            end_of_step: sum.end_of_step / total_load,
            mean_slope_modulus: sum.mean_slope_modulus / total_load,
            ..sum
        })
    }
}

/// Slopes [∂h/∂x at the time level θ, ∂h/∂x at the end of the step] of the body over an element [row, column] of the footprint.
///
/// # Errors
/// [`BemError::VerticalWall`] for a chord that leaves the body; [`BemError::InvalidParameter`] for a slope that is not a number.
fn slopes_at(
    march: &March<'_>,
    time_level: f64,
    step: &ScheduledStep,
    element: [usize; 2],
) -> Result<[f64; 2], BemError> {
    let spacing = march.options.spacing[0];
    let centre_of_element = march.x_in_elements(element[0], march.sampled_offset);
    let y = march.y_of_column(element[1]);
    let height = |x: f64| march.surface.height([x * spacing, y]);
    // The chord at the time level is as long as an element, or on a dashpot (θ = ½) as the distance of the step.
    let centre = centre_of_element + time_level * step.advance;
    let length = (2.0 * time_level * step.advance.abs()).max(1.0);
    let half = 0.5 * length;
    let slope = (height(centre + half) - height(centre - half)) / length / spacing;
    let x = centre_of_element * spacing;
    if !slope.is_finite() {
        return Err(BemError::VerticalWall { x, y });
    }
    // At the end of the step the slope is that of the surface at the centre of the element, without a chord.
    let end = march.surface.gradient([x, y])[0];
    in_range("slope of the surface", end, !end.is_nan(), "a number")?;
    Ok([slope, end])
}

/// Time level θ = ½ (1 − E G'), from 0 at the end of the step to ½ in its middle, times the part of the step over which the load is
/// held.
fn time_level(march: &March<'_>, step: &ScheduledStep) -> Result<f64, BemError> {
    let held_share = 1.0 - march.creep_step.linear_share();
    if held_share == 0.0 {
        return Ok(0.0);
    }
    Ok(0.5 * held_share * (1.0 - elastic_share(march, step)?))
}

/// Elastic share E G' of the response, at the frequency ω = 2πv/L \[rad/s] with which a contact of the length L passes: 1 on an elastic
/// half space, 0 on a dashpot. E is defined at the head of this file.
fn elastic_share(march: &March<'_>, step: &ScheduledStep) -> Result<f64, BemError> {
    let (creep, advance, time_step) = (&march.creep, step.advance, step.time_step);
    let mut elastic = creep.instantaneous_compliance();
    // Compute ω = 2πv/L for the length L of the present contact, and E as a sum over retardation elements (head of this file).
    let n_rows = march.contact_bounds().shape()[0];
    let frequency = 2.0 * PI * (advance.abs() / time_step / n_rows as f64);
    for element in creep.elements() {
        let within = 1.0 - 2.0 * element.lead(time_step);
        let lag = frequency * element.retardation_time;
        elastic += element.compliance * within / (1.0 + lag * lag);
    }
    if elastic == 0.0 {
        return Ok(0.0);
    }
    let compliance = creep.complex_compliance(frequency)?;
    // The storage modulus is G' = J'/(J'² + J''²). The compliances are divided by E first, because their squares may underflow.
    let [storage, loss] = [compliance.storage, compliance.loss].map(|part| part / elastic);
    Ok(storage / (storage * storage + loss * loss))
}
