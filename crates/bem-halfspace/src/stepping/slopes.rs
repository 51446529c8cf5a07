//! The slope that the pressure of a step meets.
//!
//! ```text
//! F_h = Σ P ∂h/∂x ΔA,      ∂h/∂x at x + θ v Δt,      θ = ½ (1 − E G'(ω)),      ω = 2πv/L
//! E = J₀ + Σ J_k (1 − 2 m_k)/(1 + ω²λ_k²),      m_k = λ_k/Δt − 1/(e^(Δt/λ_k) − 1)
//! ```
//! The pressure that moves a dashpot belongs to the motion during the step, that of a spring to its end, and so does
//! that of an element that yields within the step. Between them the moduli at the frequency decide with which a contact
//! of length L passes; `docs/theory/transient-half-space.md` has the derivation. A chord over an element, or over the
//! way of a longer step, stands for the slope, so that a cusp has one too. A load that is linear over the step belongs to its end.

use std::f64::consts::PI;

use numerics::in_range;

use crate::BemError;
use crate::stepping::{March, ScheduledStep};

/// Slopes of the loaded elements, weighted with their pressure; zero without contact.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct MeanSlopes {
    /// θ, the part of the step by which pressure and forces belong before its end.
    pub(super) time_level: f64,
    /// Mean of the slope that the pressure of the step meets: F_h / F_N.
    pub(super) met: f64,
    /// Mean of ∂h/∂x at the end of the step.
    pub(super) end: f64,
    /// Mean of the modulus of the slope.
    pub(super) mean_slope_modulus: f64,
    /// Largest slope.
    pub(super) largest: f64,
}

impl MeanSlopes {
    /// Over the step that has been made.
    pub(super) fn over(march: &March<'_>, step: &ScheduledStep) -> Result<Self, BemError> {
        let time_level = time_level(march, step)?;
        let chord = Chord::new(time_level, step);
        let mut sum = Self {
            time_level,
            ..Self::default()
        };
        let mut normal = 0.0;
        // Images fore and aft have the opposite slope.
        let has_image = !march.layout.mirrors[0].is_none();
        for (element, load) in march.loaded_elements() {
            let [met, end] = slopes_at(march, &chord, element)?;
            if !has_image {
                sum.met += load * met;
                sum.end += load * end;
            }
            sum.mean_slope_modulus += load * met.abs();
            sum.largest = sum.largest.max(if has_image { met.abs() } else { met });
            normal += load;
        }
        if normal == 0.0 {
            return Ok(sum);
        }
        Ok(Self {
            met: sum.met / normal,
            end: sum.end / normal,
            mean_slope_modulus: sum.mean_slope_modulus / normal,
            ..sum
        })
    }
}

/// The slope that an element meets and that at the end of the step.
fn slopes_at(
    march: &March<'_>,
    chord: &Chord,
    [row, column]: [usize; 2],
) -> Result<[f64; 2], BemError> {
    let spacing = march.options.spacing[0];
    let here = march.x_in_elements(row, march.sampled_offset);
    let y = march.y_of_column(column);
    let height = |place: f64| march.surface.height([place * spacing, y]);
    let met = chord.rise(here, height) / spacing;
    let x = here * spacing;
    if !met.is_finite() {
        return Err(BemError::VerticalWall { x, y });
    }
    let end = march.surface.gradient([x, y])[0];
    in_range("slope of the surface", end, !end.is_nan(), "a number")?;
    Ok([met, end])
}

/// θ, from 0 at the end of the step to ½ in its middle.
fn time_level(march: &March<'_>, step: &ScheduledStep) -> Result<f64, BemError> {
    let held = 1.0 - march.creep_step.linear_share();
    if held == 0.0 {
        return Ok(0.0);
    }
    Ok(0.5 * held * (1.0 - elastic_share(march, step)?))
}

/// E G' at the frequency with which the contact passes: 1 on an elastic half space, 0 on a dashpot.
fn elastic_share(march: &March<'_>, step: &ScheduledStep) -> Result<f64, BemError> {
    let (creep, advance, time_step) = (&march.creep, step.advance, step.time_step);
    let mut elastic = creep.instantaneous_compliance();
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
    // Relative to E, because squares of compliances may underflow.
    let [storage, loss] = [compliance.storage, compliance.loss].map(|part| part / elastic);
    Ok(storage / (storage * storage + loss * loss))
}

/// A piece of the body around the place that an element meets, in elements.
struct Chord {
    centre: f64,
    length: f64,
}

impl Chord {
    fn new(time_level: f64, step: &ScheduledStep) -> Self {
        Self {
            centre: time_level * step.advance,
            // The mean over the way of a dashpot; the element alone for a spring.
            length: (2.0 * time_level * step.advance.abs()).max(1.0),
        }
    }

    /// Rise of the body per element.
    fn rise(&self, here: f64, height: impl Fn(f64) -> f64) -> f64 {
        let centre = here + self.centre;
        let half = 0.5 * self.length;
        (height(centre + half) - height(centre - half)) / self.length
    }
}
