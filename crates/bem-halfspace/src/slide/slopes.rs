//! The slope that the pressure of a step meets.
//!
//! ```text
//! F_h = Σ P ∂h/∂x ΔA,      ∂h/∂x at x + θ v Δt,      θ = ½ (1 − E G'(ω)),      ω = 2πv/L
//! E = J₀ + Σ J_k ℒ(Δt/2λ_k)/(1 + ω²λ_k²),      ℒ(y) = coth y − 1/y
//! ```
//! The pressure that moves a dashpot belongs to the motion during the step, that of a spring to its end, and so does
//! that of an element that yields within the step. Between them the moduli at the frequency decide with which a contact
//! of length L passes; `docs/theory/transient-half-space.md` has the derivation. A chord over an element, or over the
//! way of a longer step, stands for the slope, so that a cusp has one too.

use std::f64::consts::PI;

use indenters::Surface;

use crate::BemError;
use crate::stepping::{Instant, Leg, Stepping};

/// Slopes of the loaded elements, weighted with their pressure; zero without contact.
#[derive(Debug, Clone, Copy)]
pub(super) struct Slopes {
    /// Mean of the slope that the pressure of the step meets: F_h / F_N.
    pub(super) mean: f64,
    /// Mean of ∂h/∂x at the end of the step.
    pub(super) end: f64,
    /// Mean of the modulus of the slope.
    pub(super) steepness: f64,
    /// Largest slope.
    pub(super) largest: f64,
}

impl Slopes {
    /// Slopes over the step that has been made.
    pub(super) fn over<S: Surface + ?Sized>(
        surface: &S,
        stepping: &Stepping<'_, S>,
        instant: &Instant,
    ) -> Result<Self, BemError> {
        let leg = &instant.leg;
        let chord = Chord::new(elastic_share(stepping, instant)?, leg);
        let spacing = stepping.resolution.spacing[0];
        let (mut along, mut end, mut uphill, mut normal) = (0.0, 0.0, 0.0, 0.0);
        let mut largest = 0.0_f64;
        for ([row, column], load) in stepping.loaded_elements() {
            let [here, across] = [stepping.along(row, leg.offset), stepping.across(column)];
            let height = |place: f64| surface.height([place * spacing, across]);
            let slope = chord.slope(here, height) / spacing;
            let position = [here * spacing, across];
            if !slope.is_finite() {
                let [x, y] = position;
                return Err(BemError::VerticalWall { x, y });
            }
            along += load * slope;
            uphill += load * slope.abs();
            end += load * checked_gradient(surface, position)?;
            normal += load;
            largest = largest.max(slope);
        }
        let normal = if normal > 0.0 { normal } else { 1.0 };
        Ok(Self {
            mean: along / normal,
            end: end / normal,
            steepness: uphill / normal,
            largest,
        })
    }
}

fn checked_gradient(
    surface: &(impl Surface + ?Sized),
    position: [f64; 2],
) -> Result<f64, BemError> {
    let slope = surface.gradient(position)[0];
    if slope.is_nan() {
        return Err(BemError::InvalidParameter {
            parameter: "slope of the surface",
            value: slope,
            allowed: "a number",
        });
    }
    Ok(slope)
}

/// E G' at the frequency with which the contact passes: 1 on an elastic half space, 0 on a dashpot.
fn elastic_share<S: Surface + ?Sized>(
    stepping: &Stepping<'_, S>,
    instant: &Instant,
) -> Result<f64, BemError> {
    let creep = &stepping.material.creep;
    let Leg {
        advance, time_step, ..
    } = instant.leg;
    let mut elastic = creep.instantaneous_compliance();
    let n_rows = instant.bounds.map_or(1, |bounds| bounds.shape()[0]);
    let frequency = 2.0 * PI * (advance.abs() / time_step / n_rows as f64);
    for element in creep.elements() {
        let within = langevin(0.5 * time_step / element.retardation_time);
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

/// ℒ(y) = coth y − 1/y for y > 0.
fn langevin(y: f64) -> f64 {
    if y < 0.02 {
        // The next term is below rounding.
        let square = y * y;
        return y / 3.0 * (1.0 - square / 15.0 * (1.0 - 2.0 * square / 21.0));
    }
    y.tanh().recip() - y.recip()
}

/// A piece of the body around the place that an element meets, in elements.
#[derive(Debug, Clone, Copy)]
struct Chord {
    centre: f64,
    length: f64,
}

impl Chord {
    fn new(elastic_share: f64, leg: &Leg) -> Self {
        let part = 0.5 * (1.0 - elastic_share);
        Self {
            centre: part * leg.advance,
            // The mean over the way of a dashpot; the element alone for a spring.
            length: (2.0 * part * leg.advance.abs()).max(1.0),
        }
    }

    /// Rise of the body per element.
    fn slope(&self, here: f64, height: impl Fn(f64) -> f64) -> f64 {
        let centre = here + self.centre;
        let half = 0.5 * self.length;
        (height(centre + half) - height(centre - half)) / self.length
    }
}
